//! Whether one path can have both the printed length and the printed turn sum.

use super::{Entry, refused, rule};
use base::settings::Accepted;
use proofs::proof::{self, Ends, Search};
use proofs::turns::Convention;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "joint_length_turn",
    about: "has any polyline through cell centres both a printed length and a printed turn sum?",
    revision: |_| 1,
    question: |_| None,
    settings: Accepted::shape::<Settings>(),
    example: r#"
size = [40, 40]
start = [2, 2]
goal = [9, 7]
length = "table1.astar.length"
turn = "table1.weighted.length"
metric = "turn_exterior_deg"
exterior = "turn_exterior_deg"
interior = "turn_interior_deg"
longest = 15.0
"#,
    build: |context| {
        let read: Settings = context.settings.read()?;
        let Settings { size, start, goal, longest, .. } = read;
        let length = context.print_of("length", &read.length)?;
        let turn = context.print_of("turn", &read.turn)?;
        let meant = match context.known_metric("metric", &read.metric)?.name {
            name if name == read.interior => Convention::Interior,
            name if name == read.exterior => Convention::Exterior,
            name => {
                let message = format!(
                    "`{}` stands for `{name}` under this interpretation; `{}` or `{}` is accepted",
                    read.metric, read.exterior, read.interior
                );
                return Err(context.settings.error_at("metric", message));
            }
        };
        let ends = Ends { size, start, goal };
        Ok(rule(move |polylines, is_explained| {
            let shortest = &|query: &_| polylines.shortest(query);
            refused(proof::joint_length_turn(
                &Search { ends, turn, meant, longest, is_explained, shortest },
                length,
            ))
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
    /// The claim that prints the length.
    length: String,
    /// The claim that prints the turn sum.
    turn: String,
    /// What the turn sum is, as interpretations name it.
    metric: String,
    /// The metric that sums changes of heading.
    exterior: String,
    /// The metric that sums angles between segments.
    interior: String,
    /// How far to look for a path with the turn sum alone, cells.
    #[schemars(range(min = 0, max = 200))]
    longest: f64,
}
