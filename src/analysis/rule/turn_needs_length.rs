//! How long a path must be to have a printed turn sum, and whether that leaves room under another printed length.

use super::{Entry, check_search, refused, rule};
use audit::proof::{self, Ends, Search};
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use turns::Convention;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "turn_needs_length",
    about: "how long is a polyline through cell centres with a printed turn sum at least, and is that below a printed length?",
    revision: |_| 1,
    settings: Accepted::of::<Settings>(),
    example: r#"
size = [30, 30]
start = [22, 15]
goal = [26, 28]
turn = "t1.improved.turn"
against = "t1.astar.cost"
metric = "turn_sum"
exterior = "turn_exterior_deg"
longest = 20.0
"#,
    build: |context| {
        let read: Settings = context.settings.read()?;
        let Settings { size, start, goal, longest, shorter, .. } = read;
        check_search(context, size, longest)?;
        let (turn, against) = (context.print_of(&read.turn)?, context.print_of(&read.against)?);
        let is_exterior = context.known_metric(&read.metric)?.name == read.exterior;
        let meant = if is_exterior { Convention::Exterior } else { Convention::Interior };
        let ends = Ends { size, start, goal };
        Ok(rule(move |evidence| {
            let shortest = &|query: &_| evidence.shortest_polyline(query);
            let search = Search { ends, turn, meant, longest, shortest };
            refused(proof::turn_needs_length(&search, against, shorter))
        }))
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
    /// The claim that prints the turn sum.
    turn: String,
    /// The claim that prints the length it is set beside, A*'s for one.
    against: String,
    /// Whether the claim is that the path is shorter than that; otherwise nothing is judged.
    #[serde(default)]
    shorter: bool,
    /// What the turn sum is, as readings name it.
    metric: String,
    /// The metric that sums changes of heading.
    exterior: String,
    /// How far to look, cells.
    longest: f64,
}
