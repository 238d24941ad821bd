//! Whether a printed time is a whole number of ticks of a coarse clock. A time of an unknown program on an unknown
//! machine stays untestable; this says what can be said of its digits.

use super::{Entry, Rule};
use crate::analysis::evidence::Evidence;
use crate::analysis::found::Found;
use audit::clock::Tick;
use audit::printed::{Digits, Printed};
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "clock_ticks",
    about: "is a printed time a whole number of ticks of a clock, and how likely is that by chance?",
    settings: Accepted::of::<Settings>(),
    example: r#"
tick_s = [1, 64]
with = ["case2.time"]
chosen = "read off these two times (it is also the period of a PC's clock interrupt), so that the probability is that of a tick named in advance and no evidence"
"#,
    build: |context| {
        let settings: Settings = context.settings.read()?;
        let [numerator, denominator] = settings.tick_s;
        if numerator == 0 || denominator == 0 {
            let message = format!("tick_s is {numerator}/{denominator}; two numbers above 0 are accepted");
            return Err(context.settings.error_at("tick_s", message));
        }
        let printed = context.printed()?;
        if printed.decimals() > 6 {
            return Err(context.settings.error("the time has more than 6 decimals; at most 6 are accepted"));
        }
        let with = settings.with.iter().map(|id| Ok(context.printed_of(id)?.0));
        let all = with.chain([Ok(printed)]).collect::<Result<Vec<_>, _>>()?;
        let tick = Tick { numerator, denominator };
        Ok(Box::new(ClockTicks { tick, chosen: settings.chosen, printed, all, digits: context.digits() }))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The tick, as numerator and denominator of a fraction of a second.
    tick_s: [u32; 2],
    /// How the tick came to be asked about: one read off the times themselves proves nothing.
    chosen: String,
    /// Other claims whose times should be ticks of the same clock.
    #[serde(default)]
    with: Vec<String>,
}

struct ClockTicks {
    tick: Tick,
    chosen: String,
    printed: Printed,
    all: Vec<Printed>,
    digits: Digits,
}

impl Rule for ClockTicks {
    fn find(&self, _evidence: &Evidence<'_>) -> Found {
        let Tick { numerator, denominator } = self.tick;
        let mut found = Found::default();
        let count = self.tick.count(self.printed, self.digits);
        let spelled = format!("{numerator}/{denominator} s");
        match count {
            Some(ticks) => {
                found.because.push(format!("{} s prints {ticks} ticks of {spelled}", self.printed));
            }
            None => {
                found.because.push(format!("{} s is no whole number of ticks of {spelled}", self.printed));
            }
        }
        let both = self.all.iter().filter(|time| self.tick.count(**time, self.digits).is_some()).count();
        found.because.push(format!(
            "{both} of {} printed times are; random digits would all be with probability {:.6}",
            self.all.len(),
            self.tick.chance(&self.all, self.digits)
        ));
        found.premises.push(format!("the tick of {spelled}: {}", self.chosen));
        found
    }
}
