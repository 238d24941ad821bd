//! How long a path must be to have a printed turn sum, and whether that leaves room under another printed length.

use super::{Entry, Rule};
use crate::analysis::class::Outcome;
use crate::analysis::context::Context;
use crate::analysis::evidence::Evidence;
use crate::analysis::found::Found;
use audit::neighbourhood;
use audit::printed::Printed;
use audit::turns::{Convention, TurnQuery};
use base::settings::{Accepted, SettingsError};
use schemars::JsonSchema;
use serde::Deserialize;
use stats::interval::Interval;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "turn_needs_length",
    about: "how long is a polyline through cell centres with a printed turn sum at least, and is that below a printed length?",
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
    build: |context| Ok(Box::new(TurnNeedsLength::new(context)?)),
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

struct TurnNeedsLength {
    settings: Settings,
    turn: (Printed, Interval),
    against: (Printed, Interval),
    is_exterior: bool,
}

impl TurnNeedsLength {
    fn new(context: &Context<'_>) -> Result<Self, SettingsError> {
        let settings: Settings = context.settings.read()?;
        super::joint_length_turn::check_search(context, settings.size, settings.longest)?;
        let window =
            |id: &str| context.printed_of(id).map(|(printed, digits)| (printed, printed.interval(digits)));
        let (turn, against) = (window(&settings.turn)?, window(&settings.against)?);
        let is_exterior = context.known_metric(&settings.metric)?.name == settings.exterior;
        Ok(Self { settings, turn, against, is_exterior })
    }

    /// The least length with a turn sum in `turn_deg`.
    fn least(
        &self,
        evidence: &Evidence<'_>,
        convention: Convention,
        turn_deg: Interval,
        near: [bool; 2],
    ) -> Option<f64> {
        let Settings { size, start, goal, longest, .. } = self.settings;
        let ends = |cell, near| if near { neighbourhood(cell, size) } else { vec![cell] };
        let (starts, goals) = (ends(start, near[0]), ends(goal, near[1]));
        let length = Interval::new(0.0, longest);
        let query = TurnQuery { size, starts, goals, convention, turn_deg, length };
        evidence.shortest_polyline(&query).map(|found| found.length)
    }

    /// What is left of the proof where one end is moved to a neighbour.
    fn moved(&self, evidence: &Evidence<'_>, convention: Convention) -> String {
        let least = |near| self.least(evidence, convention, self.turn.1, near);
        let (start, goal) = rayon::join(|| least([true, false]), || least([false, true]));
        let least = [start, goal].into_iter().flatten().fold(f64::INFINITY, f64::min);
        let rests = if least > self.against.1.high { "does not rest" } else { "rests" };
        format!(
            "with the start or the goal moved to one of its eight neighbours such a path is at least {least:.4} cells long, \
             so the proof {rests} on the printed ends"
        )
    }

    /// Whether the path is longer than the printed length can stand for, and how that was found.
    fn under(&self, evidence: &Evidence<'_>, convention: Convention, because: &mut Vec<String>) -> bool {
        let Self { turn: (turn, window), against: (beside, length), .. } = self;
        let name = if convention == Convention::Exterior { "exterior" } else { "interior" };
        let more = Interval { high: f64::INFINITY, ..*window };
        let least = |window| self.least(evidence, convention, window, [false, false]);
        let least: [Option<f64>; 2] = rayon::join(|| least(*window), || least(more)).into();
        let said = |least: Option<f64>| match least {
            Some(least) => {
                let change = 100.0 * (least / beside.value() - 1.0);
                format!("at least {least:.4} ({change:+.1} % from {beside})")
            }
            None => format!("more than {}", self.settings.longest),
        };
        let [exact, any] = least.map(said);
        because.push(format!(
            "{name} angles: a path that turns by {turn} is {exact} cells long on any map; one that turns so far or further, {any}"
        ));
        least[0].is_none_or(|least| least > length.high)
    }
}

impl Rule for TurnNeedsLength {
    fn find(&self, evidence: &Evidence<'_>) -> Found {
        let mut because = Vec::new();
        let exterior = self.under(evidence, Convention::Exterior, &mut because);
        let interior = self.under(evidence, Convention::Interior, &mut because);
        let is_longer = if self.is_exterior { exterior } else { interior };
        if self.settings.shorter && is_longer {
            let meant = if self.is_exterior { Convention::Exterior } else { Convention::Interior };
            because.push(self.moved(evidence, meant));
        }
        let Settings { start, goal, shorter, .. } = self.settings;
        Found {
            outcome: (shorter && is_longer).then_some(Outcome::Proved),
            because,
            premises: vec![
                format!(
                    "the path is a polyline from cell {start:?} to cell {goal:?} whose bends are cell centres"
                ),
                "lengths are Euclidean, in cells; a turn sum adds one angle at every bend".to_owned(),
            ],
            ..Found::default()
        }
    }
}
