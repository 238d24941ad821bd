//! Whether a printed length is at least the straight line between its ends.

use super::{Entry, Rule};
use crate::analysis::class::Outcome;
use crate::analysis::evidence::Evidence;
use crate::analysis::found::Found;
use audit::bounds::{shortfall, straight_line, straight_line_between};
use audit::neighbourhood;
use audit::printed::{Digits, Printed};
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "straight_line",
    about: "is a printed length at least the straight line between start and goal?",
    settings: Accepted::of::<Settings>(),
    example: "
start = [22.0, 15.0]
goal = [26.0, 28.0]
",
    build: |context| {
        let settings: Settings = context.settings.read()?;
        Ok(Box::new(StraightLine { settings, printed: context.printed()?, digits: context.digits() }))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// x and y of the start as printed.
    start: [f64; 2],
    /// x and y of the goal as printed.
    goal: [f64; 2],
    /// Columns and rows, if start and goal are cells: then their neighbours are tried as well.
    size: Option<[i32; 2]>,
}

struct StraightLine {
    settings: Settings,
    printed: Printed,
    digits: Digits,
}

impl Rule for StraightLine {
    fn find(&self, _evidence: &Evidence<'_>) -> Found {
        let Settings { start, goal, size } = self.settings;
        let least = straight_line(start, goal);
        let short = shortfall(self.printed.interval(self.digits), least);
        let line = format!("the straight line from {start:?} to {goal:?} is {least:.4} long");
        let found = match short {
            Some(by) => {
                format!("{} is shorter by at least {by:.4}, whatever its digits stand for", self.printed)
            }
            None => format!("{} is not shorter", self.printed),
        };
        let mut because = vec![line, found];
        if let (Some(size), Some(_)) = (size, short) {
            let cells = [start, goal].map(|point| neighbourhood(point.map(|at| at as i32), size));
            let near = straight_line_between(&cells[0], &[goal.map(|at| at as i32)])
                .into_iter()
                .chain(straight_line_between(&[start.map(|at| at as i32)], &cells[1]))
                .fold(f64::INFINITY, f64::min);
            because.push(format!(
                "with the start or the goal moved to one of its eight neighbours the straight line is down to {near:.4}, so \
                 the proof rests on the printed ends"
            ));
        }
        Found {
            outcome: short.map(|_| Outcome::Proved),
            because,
            premises: vec![
                "the path joins the printed start and goal".to_owned(),
                "its printed cost is its length in cells, as A*'s is".to_owned(),
            ],
            ..Found::default()
        }
    }
}
