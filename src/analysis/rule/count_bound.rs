//! Whether a printed number of nodes is at most what A* can open or close on any map.

use super::{Entry, refused, rule};
use base::settings::Accepted;
use proofs::fvalues::CountBound;
use proofs::lattice::Octile;
use proofs::proof::{self, Ends};
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "count_bound",
    about: "is a printed count at most what A* with the Euclidean heuristic can open or close on any map?",
    revision: |_| 1,
    question: |_| None,
    settings: Accepted::shape::<Settings>(),
    example: r#"
size = [40, 40]
start = [2, 2]
goal = [36, 30]
optimum = [6, 28]
metric = "opened"
opened = "opened"
closed = "closed"
"#,
    build: |context| {
        let Settings { size, start, goal, optimum: [straight, diagonal], metric, opened, closed } =
            context.settings.read()?;
        let metric = context.known_metric("metric", &metric)?;
        let opened = context.known_metric("opened", &opened)?;
        let closed = context.known_metric("closed", &closed)?;
        // Which bound holds for the metric under the interpretation.
        let applies: Option<fn(CountBound) -> usize> = match metric.name {
            name if name == opened.name => Some(|bound| bound.opened),
            name if name == closed.name => Some(|bound| bound.closed),
            _ => None,
        };
        let print = context.print()?;
        let ends = Ends { size, start, goal };
        let optimum = Octile { straight, diagonal };
        Ok(rule(move |_, _| refused(proof::count_bound(print, ends, optimum, applies))))
    },
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
    /// What the printed number counts, as interpretations name it.
    metric: String,
    /// The metric that counts opened nodes.
    opened: String,
    /// The metric that counts closed nodes.
    closed: String,
}
