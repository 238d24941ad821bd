//! Whether a printed time is a whole number of ticks of a coarse clock. A time of an unknown program on an unknown
//! machine is not testable; this looks at its digits alone.

use super::{Entry, refused, rule};
use base::settings::Accepted;
use proofs::clock::Tick;
use proofs::proof;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "clock_ticks",
    about: "is a printed time a whole number of ticks of a clock, and how likely is that by chance?",
    revision: |_| 1,
    question: |_| None,
    settings: Accepted::shape::<Settings>(),
    example: r#"
tick_s = [1, 100]
with = ["table1.astar.length"]
chosen = "named by the paper, before its times were looked at"
"#,
    build: |context| {
        let Settings { tick_s: [numerator, denominator], chosen, with } = context.settings.read()?;
        if numerator == 0 || denominator == 0 {
            let message = format!("tick_s is {numerator}/{denominator}; two numbers above 0 are accepted");
            return Err(context.settings.error_at("tick_s", message));
        }
        let own = context.print()?;
        if own.printed.decimals() > 6 {
            return Err(context.settings.error("the time has more than 6 decimals; at most 6 are accepted"));
        }
        let times = with.iter().map(|id| context.print_of("with", id)).chain([Ok(own)]);
        let times = times.collect::<Result<Vec<_>, _>>()?;
        let tick = Tick { numerator, denominator };
        Ok(rule(move |_, _| refused(proof::clock_ticks(tick, &times, &chosen))))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The tick, as numerator and denominator of a fraction of a second.
    tick_s: [u32; 2],
    /// How the tick was chosen: one read off the times themselves proves nothing.
    chosen: String,
    /// Other claims whose times should be ticks of the same clock.
    #[serde(default)]
    with: Vec<String>,
}
