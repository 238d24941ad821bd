//! Whether a printed length is at least the straight line between its ends.

use super::{Entry, Rule};
use crate::analysis::class::Outcome;
use crate::analysis::evidence::Evidence;
use crate::analysis::found::Found;
use audit::bounds::{Moves, against, apart, straight_line, straight_line_between};
use audit::exact::{Exact, Print, parse};
use audit::neighbourhood;
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
        let exact = |key: &str, point: [f64; 2]| {
            let read = |at: f64| parse(&at.to_string());
            let message = format!("`{key}` is {point:?}; two coordinates of up to 15 digits are accepted");
            read(point[0]).zip(read(point[1])).ok_or_else(|| context.settings.error_at(key, message))
        };
        let (from, to) = (exact("start", settings.start)?, exact("goal", settings.goal)?);
        let apart = apart(from.into(), to.into());
        let print = Print { printed: context.printed()?, digits: context.digits() };
        Ok(Box::new(StraightLine { settings, apart, print }))
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
    apart: [Exact; 2],
    print: Print,
}

impl Rule for StraightLine {
    fn find(&self, _evidence: &Evidence<'_>) -> Found {
        let Settings { start, goal, size } = self.settings;
        let least = straight_line(start, goal);
        let (printed, longest) = (self.print.printed, self.print.printed.interval(self.print.digits).high);
        let is_short = against(self.print, self.apart, Moves::Any).is_some_and(|(order, _)| order.is_lt());
        let short = is_short.then_some(least - longest);
        let line = format!("the straight line from {start:?} to {goal:?} is {least:.4} long");
        let found = match short {
            Some(by) => {
                format!("{printed} is shorter by at least {by:.4}, whatever its digits stand for")
            }
            None => format!("{printed} is not shorter"),
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
