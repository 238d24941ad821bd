//! How long a path must be to have a printed turn sum, and whether that leaves room under another printed length.

use super::{Entry, refused, rule};
use base::settings::Accepted;
use proofs::proof::{self, Ends, Search};
use proofs::turns::Convention;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "turn_needs_length",
    about: "how long is a polyline through cell centres with a printed turn sum at least, and is that below a printed length?",
    revision: |_| 1,
    question: |_| None,
    settings: Accepted::shape::<Settings>(),
    example: r#"
size = [40, 40]
start = [2, 2]
goal = [9, 7]
turn = "table1.weighted.length"
against = "table1.astar.length"
metric = "turn_exterior_deg"
exterior = "turn_exterior_deg"
longest = 15.0
"#,
    build: |context| {
        let read: Settings = context.settings.read()?;
        let Settings { size, start, goal, longest, shorter, .. } = read;
        let turn = context.print_of("turn", &read.turn)?;
        let against = context.print_of("against", &read.against)?;
        let is_exterior = context.known_metric("metric", &read.metric)?.name == read.exterior;
        let meant = if is_exterior { Convention::Exterior } else { Convention::Interior };
        let ends = Ends { size, start, goal };
        Ok(rule(move |polylines, is_explained| {
            let shortest = &|query: &_| polylines.shortest(query);
            let search = Search { ends, turn, meant, longest, is_explained, shortest };
            refused(proof::turn_needs_length(&search, against, shorter))
        }))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The map's columns and rows.
    #[schemars(inner(range(min = 1, max = 200)))]
    size: [i32; 2],
    /// The column and row of the start cell.
    start: [i32; 2],
    /// The column and row of the goal cell.
    goal: [i32; 2],
    /// The claim that prints the turn sum.
    turn: String,
    /// The claim that prints the length it is set beside, A*'s for one.
    against: String,
    /// Whether the claim is that the path is shorter than that; otherwise nothing is judged.
    #[serde(default)]
    shorter: bool,
    /// What the turn sum is, as interpretations name it.
    metric: String,
    /// The metric that sums changes of heading.
    exterior: String,
    /// How far to look, cells.
    #[schemars(range(min = 0, max = 200))]
    longest: f64,
}
