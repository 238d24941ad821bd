//! Whether a printed saving on a printed path length is possible for any path between the two cells.

use super::{Entry, refused, rule};
use base::settings::Accepted;
use proofs::proof::{self, Ends};
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "largest_saving",
    about: "is a printed saving on a printed length possible for any path between start and goal?",
    revision: |_| 1,
    question: |_| None,
    settings: Accepted::shape::<Settings>(),
    example: r#"
baseline = "table1.astar.length"
start = [2, 2]
goal = [36, 30]
size = [40, 40]
"#,
    build: |context| {
        let Settings { baseline, start, goal, size } = context.settings.read()?;
        let baseline = context.print_of("baseline", &baseline)?;
        let print = context.print()?;
        let ends = Ends { size, start, goal };
        Ok(rule(move |_, _| refused(proof::largest_saving(print, baseline, ends))))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The claim that prints the length that is saved from.
    baseline: String,
    /// The column and row of the printed start.
    start: [i32; 2],
    /// The column and row of the printed goal.
    goal: [i32; 2],
    /// Columns and rows: the ends' neighbours are tried as well.
    size: [i32; 2],
}
