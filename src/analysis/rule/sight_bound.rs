//! Whether a printed length, or a saving, is possible for a straightened path, given the cost of A*'s.

use super::{Entry, Rule};
use crate::analysis::class::Outcome;
use crate::analysis::context::Context;
use crate::analysis::evidence::Evidence;
use crate::analysis::found::Found;
use audit::lattice::{Octile, octile_distance};
use audit::printed::{Digits, Printed};
use audit::sight::shortest_seen;
use audit::{at_most, with_an_end_moved};
use base::settings::{Accepted, SettingsError};
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "sight_bound",
    about: "can a path with free lines of sight be so short, or save so much, where the 8-connected optimum is known?",
    settings: Accepted::of::<Settings>(),
    example: r#"
size = [30, 30]
start = [28, 19]
goal = [13, 16]
optimum = [12, 4]
because = "A*'s path costs 12 + 4√2: no path has the printed 17.56, and 17.65, with two digits swapped, is this cost cut off"
of = "length"
holds_when = { corner_cutting = ["allow"] }
"#,
    build: |context| Ok(Box::new(SightBound::new(context)?)),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The map's columns and rows.
    size: [i32; 2],
    /// The column and row of the start cell.
    start: [i32; 2],
    /// The column and row of the goal cell.
    goal: [i32; 2],
    /// Straight and diagonal moves of A*'s path.
    optimum: [u32; 2],
    /// Why A*'s path is taken to have these moves.
    because: String,
    /// What the bound is on.
    of: Of,
    /// Readings with the options under which the bound holds.
    holds_when: BTreeMap<String, Vec<String>>,
}

/// What is printed.
#[derive(Deserialize, JsonSchema, Clone, Copy, PartialEq, Eq)]
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
        for (id, options) in &settings.holds_when {
            let known = readings.iter().find(|reading| reading.id == *id);
            let known =
                known.map(|reading| reading.options.keys().cloned().collect::<Vec<_>>()).unwrap_or_default();
            if let Some(unknown) = options.iter().find(|option| !known.contains(option)) {
                let message =
                    format!("`holds_when` asks for {id}={unknown}; the options are {}", known.join(", "));
                return Err(context.settings.error_at(&format!("holds_when.{id}"), message));
            }
        }
        let choices = context.point.choices();
        let holds = settings.holds_when.iter().all(|(id, options)| options.contains(&choices[id]));
        Ok(Self { settings, printed: context.printed()?, digits: context.digits(), holds })
    }
}

impl SightBound {
    fn optimum(&self) -> Octile {
        let [straight, diagonal] = self.settings.optimum;
        Octile { straight, diagonal }
    }

    /// Whether the printed number is beyond what a path of `shortest` cells at least allows, and how that is said.
    fn against(&self, shortest: f64) -> (bool, String) {
        let most = 100.0 * (1.0 - shortest / self.optimum().length());
        let printed = self.printed.interval(self.digits);
        let (number, up_to) = (self.printed, at_most(most, 2));
        match self.settings.of {
            Of::Length if printed.high < shortest => (true, format!("{number} is shorter")),
            Of::Length => (false, format!("{number} is not shorter")),
            Of::SavingPercent if printed.low > most => {
                (true, format!("it saves at most {up_to} %, less than {number} %"))
            }
            Of::SavingPercent => (false, format!("it saves up to {up_to} %, no less than {number} %")),
        }
    }

    /// What is left of the proof where one end is moved to a neighbour and A*'s path still has its moves.
    fn moved(&self) -> String {
        let Settings { size, start, goal, .. } = self.settings;
        let joined = |ends: &[[i32; 2]; 2]| {
            let apart = [ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]];
            octile_distance(apart).compare(self.optimum()).is_le()
        };
        let moved = with_an_end_moved([start, goal], size).into_iter().filter(joined);
        let shortest = moved.map(|ends| shortest_seen(size, ends, self.optimum()).length);
        let least = shortest.fold(f64::INFINITY, f64::min);
        let rests = if self.against(least).0 {
            "so the proof does not rest on the printed ends"
        } else {
            "so the proof rests on the printed ends"
        };
        format!(
            "with the start or the goal moved to one of its eight neighbours the bound is down to {least:.4}, {rests}"
        )
    }
}

impl Rule for SightBound {
    fn find(&self, _evidence: &Evidence<'_>) -> Found {
        let Settings { size, start, goal, .. } = self.settings;
        let optimum = self.optimum();
        let shortest = shortest_seen(size, [start, goal], optimum);
        let (is_beyond, found) = self.against(shortest.length);
        let mut because = vec![
            format!(
                "with an 8-connected optimum of {} + {}√2 = {:.4}, a path of free segments is at least {:.4} long on any \
                 map (as {:?})",
                optimum.straight,
                optimum.diagonal,
                optimum.length(),
                shortest.length,
                shortest.cells
            ),
            found,
        ];
        if is_beyond {
            because.push(self.moved());
        }
        if !self.holds {
            because.push("the bound does not hold under this reading".to_owned());
        }
        let listed = |(id, options): (&String, &Vec<String>)| format!("{id} is {}", options.join(" or "));
        let mut premises = vec![
            self.settings.because.clone(),
            "bends are cell centres".to_owned(),
            "every segment is free in all cells whose inside it crosses, or in all cells of Bresenham's line"
                .to_owned(),
        ];
        premises.extend(self.settings.holds_when.iter().map(listed));
        let outcome = is_beyond.then_some(Outcome::Proved);
        Found { outcome, because, premises, without_premises: !self.holds, ..Found::default() }
    }
}
