//! Whether one path can have both the printed length and the printed turn sum.

use super::{Entry, Rule};
use crate::analysis::class::Outcome;
use crate::analysis::context::Context;
use crate::analysis::evidence::Evidence;
use crate::analysis::found::Found;
use audit::neighbourhood;
use audit::printed::Printed;
use audit::turns::{Convention, Polyline, TurnQuery};
use base::settings::{Accepted, SettingsError};
use schemars::JsonSchema;
use serde::Deserialize;
use stats::interval::Interval;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "joint_length_turn",
    about: "has any polyline through cell centres both a printed length and a printed turn sum?",
    settings: Accepted::of::<Settings>(),
    example: r#"
size = [30, 30]
start = [22, 15]
goal = [26, 28]
length = "t1.improved.cost"
turn = "t1.improved.turn"
metric = "turn_sum"
exterior = "turn_exterior_deg"
interior = "turn_interior_deg"
longest = 20.0
"#,
    build: |context| Ok(Box::new(Joint::new(context)?)),
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
    /// The claim that prints the length.
    length: String,
    /// The claim that prints the turn sum.
    turn: String,
    /// What the turn sum is, as readings name it.
    metric: String,
    /// The metric that sums changes of heading.
    exterior: String,
    /// The metric that sums angles between segments.
    interior: String,
    /// How far to look for a path with the turn sum alone, cells.
    longest: f64,
}

/// Refuses a grid or a length that a search for polylines would not come to the end of.
pub(super) fn check_search(context: &Context<'_>, size: [i32; 2], longest: f64) -> Result<(), SettingsError> {
    let (key, message) = if !size.iter().all(|side| (1..=200).contains(side)) {
        ("size", format!("size is {size:?}; 1 to 200 columns and rows are accepted"))
    } else if !(0.0..=200.0).contains(&longest) {
        ("longest", format!("longest is {longest}; 0 to 200 cells are accepted"))
    } else {
        return Ok(());
    };
    Err(context.settings.error_at(key, message))
}

struct Joint {
    settings: Settings,
    length: (Printed, Interval),
    turn: (Printed, Interval),
    convention: Convention,
}

impl Joint {
    fn new(context: &Context<'_>) -> Result<Self, SettingsError> {
        let settings: Settings = context.settings.read()?;
        check_search(context, settings.size, settings.longest)?;
        let window =
            |id: &str| context.printed_of(id).map(|(printed, digits)| (printed, printed.interval(digits)));
        let (length, turn) = (window(&settings.length)?, window(&settings.turn)?);
        let metric = context.known_metric(&settings.metric)?.name;
        let convention = if metric == settings.interior {
            Convention::Interior
        } else if metric == settings.exterior {
            Convention::Exterior
        } else {
            let message = format!(
                "`{}` stands for `{metric}` under this reading; `{}` or `{}` is accepted",
                settings.metric, settings.exterior, settings.interior
            );
            return Err(context.settings.error_at("metric", message));
        };
        Ok(Self { settings, length, turn, convention })
    }

    fn shortest(
        &self,
        evidence: &Evidence<'_>,
        convention: Convention,
        length: Interval,
        near: [bool; 2],
    ) -> Option<Polyline> {
        let Settings { size, start, goal, .. } = self.settings;
        let ends = |cell, near| if near { neighbourhood(cell, size) } else { vec![cell] };
        let (starts, goals) = (ends(start, near[0]), ends(goal, near[1]));
        evidence.shortest_polyline(&TurnQuery {
            size,
            starts,
            goals,
            convention,
            turn_deg: self.turn.1,
            length,
        })
    }

    /// Whether the pair is impossible under `convention`, and how that was found.
    fn under(&self, evidence: &Evidence<'_>, convention: Convention, because: &mut Vec<String>) -> bool {
        let name = match convention {
            Convention::Exterior => "exterior",
            Convention::Interior => "interior",
        };
        let alone = Interval::new(0.0, self.settings.longest);
        because.push(match self.shortest(evidence, convention, alone, [false, false]) {
            Some(found) => format!(
                "{name} angles: a turn sum of {} needs a length of {:.4} at least, on any map",
                self.turn.0, found.length
            ),
            None => format!(
                "{name} angles: no path of up to {} cells has a turn sum of {}",
                self.settings.longest, self.turn.0
            ),
        });
        let pair = |near| self.shortest(evidence, convention, self.length.1, near);
        let both = format!("{} and {}", self.length.0, self.turn.0);
        if let Some(found) = pair([false, false]) {
            because.push(format!("{name} angles: {both} are met together by {:?}", found.cells));
            return false;
        }
        let rescued: Vec<&str> = [("start", [true, false]), ("goal", [false, true])]
            .into_iter()
            .filter(|(_, near)| pair(*near).is_some())
            .map(|(what, _)| what)
            .collect();
        let ends = if rescued.is_empty() {
            "nor with the start or the goal moved to any of its eight neighbours".to_owned()
        } else {
            format!("but moving the {} to a neighbour would allow it", rescued.join(" or the "))
        };
        because.push(format!("{name} angles: no polyline has {both}, {ends}"));
        true
    }
}

impl Rule for Joint {
    fn find(&self, evidence: &Evidence<'_>) -> Found {
        let mut because = Vec::new();
        let exterior = self.under(evidence, Convention::Exterior, &mut because);
        let interior = self.under(evidence, Convention::Interior, &mut because);
        let is_impossible = if self.convention == Convention::Exterior { exterior } else { interior };
        let Settings { start, goal, .. } = self.settings;
        Found {
            outcome: is_impossible.then_some(Outcome::Proved),
            because,
            premises: vec![
                format!(
                    "the path is a polyline from cell {start:?} to cell {goal:?} whose bends are cell centres"
                ),
                "its cost is its Euclidean length in cells; its turn sum adds one angle at every bend"
                    .to_owned(),
            ],
            ..Found::default()
        }
    }
}
