//! Whether a printed number of nodes is at most what A* can open or close on any map.

use super::{Entry, Rule};
use crate::analysis::class::Outcome;
use crate::analysis::context::Context;
use crate::analysis::evidence::Evidence;
use crate::analysis::found::Found;
use audit::fvalues::{CountBound, astar_count_bound};
use audit::lattice::Octile;
use audit::printed::{Digits, Printed};
use base::settings::{Accepted, SettingsError};
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "count_bound",
    about: "is a printed count at most what A* with the Euclidean heuristic can open or close on any map?",
    settings: Accepted::of::<Settings>(),
    example: r#"
size = [30, 30]
start = [22, 15]
goal = [26, 28]
optimum = [9, 4]
metric = "nodes"
opened = "opened"
closed = "closed"
"#,
    build: |context| Ok(Box::new(Bound::new(context)?)),
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
    /// What the printed number counts, as readings name it.
    metric: String,
    /// The metric that counts opened nodes.
    opened: String,
    /// The metric that counts closed nodes.
    closed: String,
}

struct Bound {
    settings: Settings,
    printed: Printed,
    digits: Digits,
    /// Which bound holds for the metric under the reading.
    applies: Option<fn(CountBound) -> usize>,
}

impl Bound {
    fn new(context: &Context<'_>) -> Result<Self, SettingsError> {
        let settings: Settings = context.settings.read()?;
        for name in [&settings.opened, &settings.closed] {
            context.known_metric(name)?;
        }
        let metric = context.known_metric(&settings.metric)?.name;
        let applies = if metric == settings.opened {
            Some((|bound| bound.opened) as fn(CountBound) -> usize)
        } else if metric == settings.closed {
            Some((|bound| bound.closed) as fn(CountBound) -> usize)
        } else {
            None
        };
        Ok(Self { settings, printed: context.printed()?, digits: context.digits(), applies })
    }
}

impl Rule for Bound {
    fn find(&self, _evidence: &Evidence<'_>) -> Found {
        let Settings { size, start, goal, optimum: [straight, diagonal], .. } = self.settings;
        let optimum = Octile { straight, diagonal };
        let bound = astar_count_bound(size, start, goal, optimum.length());
        let least = self.printed.interval(self.digits).low;
        let said = |what: &str, most: usize| {
            let compared =
                if least > most as f64 { "so it cannot count them" } else { "so it may count them" };
            format!("at most {most} nodes are {what}, {compared}")
        };
        let exceeded = self.applies.is_some_and(|applies| least > applies(bound) as f64);
        Found {
            outcome: exceeded.then_some(Outcome::Proved),
            because: vec![
                format!("{} on any map of {} × {} cells", self.printed, size[0], size[1]),
                said("closed", bound.closed),
                said("ever opened", bound.opened),
            ],
            premises: vec![
                format!(
                    "A* from cell {start:?} to cell {goal:?} with the Euclidean heuristic, stopped at the goal"
                ),
                format!("its path costs {straight} + {diagonal}√2 = {:.4}", optimum.length()),
            ],
            ..Found::default()
        }
    }
}
