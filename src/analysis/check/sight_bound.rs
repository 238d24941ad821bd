//! Whether a printed length, or a saving, is possible for a straightened path, given the cost of A*'s.

use super::{Check, Context, Entry};
use crate::analysis::audit::lattice::Octile;
use crate::analysis::audit::printed::{Digits, Printed};
use crate::analysis::audit::sight::shortest_seen;
use crate::analysis::evidence::Evidence;
use crate::analysis::verdict::{Finding, Verdict};
use crate::settings::SettingsError;
use serde::Deserialize;
use std::collections::BTreeMap;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "sight_bound",
    about: "can a path with free lines of sight be so short, or save so much, where the 8-connected optimum is known?",
    build: |context| Ok(Box::new(SightBound::new(context)?)),
};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Settings {
    size: [i32; 2],
    start: [i32; 2],
    goal: [i32; 2],
    /// Straight and diagonal moves of A*'s path.
    optimum: [u32; 2],
    /// Why A*'s path is taken to have these moves.
    because: String,
    of: Of,
    /// Readings with the options under which the bound holds.
    under: BTreeMap<String, Vec<String>>,
}

/// What is printed.
#[derive(Deserialize, Clone, Copy, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
enum Of {
    /// A length in cells.
    Length,
    /// A saving in per cent of the optimum.
    SavingPercent,
}

struct SightBound {
    settings: Settings,
    printed: Printed,
    digits: Digits,
    holds: bool,
}

impl SightBound {
    fn new(context: &Context<'_>) -> Result<Self, SettingsError> {
        let settings: Settings = context.settings.read()?;
        let readings = context.paper.readings();
        for (id, options) in &settings.under {
            let known = readings.iter().find(|reading| reading.id == *id);
            let known =
                known.map(|reading| reading.options.keys().cloned().collect::<Vec<_>>()).unwrap_or_default();
            if let Some(unknown) = options.iter().find(|option| !known.contains(option)) {
                let message =
                    format!("`under` asks for {id}={unknown}; the options are {}", known.join(", "));
                return Err(context.settings.error(message));
            }
        }
        let choices = context.point.choices();
        let holds = settings.under.iter().all(|(id, options)| options.contains(&choices[id]));
        Ok(Self { settings, printed: context.printed()?, digits: context.digits(), holds })
    }
}

impl Check for SightBound {
    fn judge(&self, _evidence: &Evidence<'_>) -> Finding {
        let Settings { size, start, goal, optimum: [straight, diagonal], of, .. } = self.settings;
        let optimum = Octile { straight, diagonal };
        let shortest = shortest_seen(size, [start, goal], optimum);
        let most = 100.0 * (1.0 - shortest.length / optimum.length());
        let printed = self.printed.interval(self.digits);
        let is_beyond = match of {
            Of::Length => printed.high < shortest.length,
            Of::SavingPercent => printed.low > most,
        };
        let found = match (of, is_beyond) {
            (Of::Length, true) => format!("{} is shorter", self.printed),
            (Of::Length, false) => format!("{} is not shorter", self.printed),
            (Of::SavingPercent, true) => {
                format!("it saves at most {most:.2} %, less than {} %", self.printed)
            }
            (Of::SavingPercent, false) => {
                format!("it saves up to {most:.2} %, no less than {} %", self.printed)
            }
        };
        let mut because = vec![
            format!(
                "with an 8-connected optimum of {straight} + {diagonal}√2 = {:.4}, a path of free segments is at least \
                 {:.4} long on any map (as {:?})",
                optimum.length(),
                shortest.length,
                shortest.cells
            ),
            found,
        ];
        if !self.holds {
            because.push("the bound does not hold under this reading".to_owned());
        }
        let listed = |(id, options): (&String, &Vec<String>)| format!("{id} is {}", options.join(" or "));
        let mut premises = vec![self.settings.because.clone(), "bends are cell centres".to_owned()];
        premises.extend(self.settings.under.iter().map(listed));
        let verdict = (is_beyond && self.holds).then_some(Verdict::Impossible);
        Finding { check: ENTRY.name.to_owned(), verdict, because, premises, ..Finding::default() }
    }
}
