//! Whether a printed saving on a printed path length is possible for any path between the two cells.

use super::{Entry, Rule};
use crate::analysis::class::Outcome;
use crate::analysis::evidence::Evidence;
use crate::analysis::found::Found;
use audit::bounds::{largest_saving_percent, straight_line};
use audit::lattice::{Octile, Step, lengths_printing};
use audit::printed::{Digits, Printed};
use audit::{at_most, with_an_end_moved};
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use stats::interval::Interval;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "largest_saving",
    about: "is a printed saving on a printed length possible for any path between start and goal?",
    settings: Accepted::of::<Settings>(),
    example: r#"
baseline = "t1.astar.cost"
start = [22, 15]
goal = [26, 28]
size = [30, 30]
"#,
    build: |context| {
        let settings: Settings = context.settings.read()?;
        let baseline = context.printed_of(&settings.baseline)?;
        let printed = context.printed()?;
        Ok(Box::new(LargestSaving { settings, printed, digits: context.digits(), baseline }))
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

struct LargestSaving {
    settings: Settings,
    printed: Printed,
    digits: Digits,
    baseline: (Printed, Digits),
}

impl LargestSaving {
    /// The most that a path between two cells can save, in per cent, and what it is measured against.
    fn most(&self, [start, goal]: [[i32; 2]; 2]) -> (f64, String) {
        let least = straight_line(start.map(f64::from), goal.map(f64::from));
        let displacement = [goal[0] - start[0], goal[1] - start[1]];
        let (printed, digits) = self.baseline;
        let lengths = lengths_printing(printed, digits, Step::ONE, Some(displacement));
        let longest = lengths.iter().copied().map(Octile::length).max_by(f64::total_cmp);
        let (baseline, which) = match longest {
            Some(length) => (
                Interval::new(length, length),
                format!("the longest 8-connected length that prints as {printed} is {length:.4}"),
            ),
            None => (
                printed.interval(digits),
                format!("no 8-connected length prints as {printed}, so it is taken as printed"),
            ),
        };
        (largest_saving_percent(baseline, least), which)
    }

    /// What is left of the proof where one end is moved to a neighbour.
    fn moved(&self, claimed: f64) -> String {
        let Settings { start, goal, size, .. } = self.settings;
        let moved = with_an_end_moved([start, goal], size).into_iter().map(|ends| self.most(ends).0);
        let most = moved.fold(f64::NEG_INFINITY, f64::max);
        let rests = if claimed <= most { "rests" } else { "does not rest" };
        format!(
            "with the start or the goal moved to one of its eight neighbours it saves at most {} %, so the proof {rests} \
             on the printed ends",
            at_most(most, 2)
        )
    }
}

impl Rule for LargestSaving {
    fn find(&self, _evidence: &Evidence<'_>) -> Found {
        let Settings { start, goal, .. } = self.settings;
        let least = straight_line(start.map(f64::from), goal.map(f64::from));
        let (most, which) = self.most([start, goal]);
        let claimed = self.printed.interval(self.digits).low;
        let is_possible = claimed <= most;
        let compared = if is_possible { "not more than that" } else { "more than any path can save" };
        let mut because = vec![
            which,
            format!(
                "no path is shorter than the straight line of {least:.4}, so it saves at most {} %",
                at_most(most, 2)
            ),
            format!("{} % is {compared}", self.printed),
        ];
        if !is_possible {
            because.push(self.moved(claimed));
        }
        Found {
            outcome: (!is_possible).then_some(Outcome::Proved),
            because,
            premises: vec![
                format!("both paths go from cell {start:?} to cell {goal:?}"),
                "costs are lengths; the baseline's is that of an 8-connected path".to_owned(),
            ],
            ..Found::default()
        }
    }
}
