//! Whether a printed length is that of any 8-connected path between the two cells.

use super::{Entry, Rule};
use crate::analysis::class::Outcome;
use crate::analysis::evidence::Evidence;
use crate::analysis::found::Found;
use audit::lattice::{Octile, Step, lengths_printing, nearest_lengths};
use audit::printed::{Digits, Printed};
use audit::with_an_end_moved;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "lattice_length",
    about: "is a printed length a + b√2 for any 8-connected path between the cells, rounded or truncated?",
    settings: Accepted::of::<Settings>(),
    example: "start = [22, 15]\ngoal = [26, 28]",
    build: |context| {
        let settings: Settings = context.settings.read()?;
        if settings.start.is_some() != settings.goal.is_some() {
            let given = if settings.start.is_some() { "start" } else { "goal" };
            let message = "`start` and `goal` are given together or not at all";
            return Err(context.settings.error_at(given, message));
        }
        Ok(Box::new(LatticeLength { settings, printed: context.printed()?, digits: context.digits() }))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The ends, where the paper prints them; without, any 8-connected path counts.
    start: Option<[i32; 2]>,
    /// The column and row of the goal; given with `start` or not at all.
    goal: Option<[i32; 2]>,
    /// Columns and rows, if the ends' neighbours are to be tried as well.
    size: Option<[i32; 2]>,
}

struct LatticeLength {
    settings: Settings,
    printed: Printed,
    digits: Digits,
}

impl LatticeLength {
    /// Whether a path has the length where one end is moved to a neighbour.
    fn moved(&self) -> Option<String> {
        let Settings { start, goal, size } = self.settings;
        let rescues = |ends: &[[i32; 2]; 2]| {
            let displacement = [ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]];
            !lengths_printing(self.printed, self.digits, Step::ONE, Some(displacement)).is_empty()
        };
        Some(match with_an_end_moved([start?, goal?], size?).into_iter().find(rescues) {
            Some([from, to]) => format!(
                "from {from:?} to {to:?}, one end moved to a neighbour, there is one, so the proof rests on the printed ends"
            ),
            None => {
                "nor is there one with the start or the goal moved to any of its eight neighbours".to_owned()
            }
        })
    }
}

impl Rule for LatticeLength {
    fn find(&self, _evidence: &Evidence<'_>) -> Found {
        let ends = self.settings.start.zip(self.settings.goal);
        let displacement = ends.map(|(start, goal)| [0, 1].map(|axis| goal[axis] - start[axis]));
        let lengths = |digits| lengths_printing(self.printed, digits, Step::ONE, displacement);
        let (rounded, truncated) = (lengths(Digits::Rounded), lengths(Digits::Truncated));
        let mut because = Vec::new();
        for (how, found) in [("rounded", &rounded), ("truncated", &truncated)] {
            let listed: Vec<String> = found.iter().map(|moves| spelled(*moves)).collect();
            let said = if listed.is_empty() { "no such length".to_owned() } else { listed.join(", ") };
            because.push(format!("{} read as {how}: {said}", self.printed));
        }
        let is_possible = !lengths(self.digits).is_empty();
        if let (false, Some(displacement)) = (is_possible, displacement) {
            let (below, above) = nearest_lengths(self.printed, displacement);
            let near: Vec<String> = [below, above].into_iter().flatten().map(spelled).collect();
            because.push(format!("the nearest lengths there are: {}", near.join(" and ")));
            because.extend(self.moved());
        }
        Found {
            outcome: (!is_possible).then_some(Outcome::Proved),
            because,
            premises: vec![joined(ends), "a straight move costs 1 and a diagonal one √2".to_owned()],
            ..Found::default()
        }
    }
}

fn joined(ends: Option<([i32; 2], [i32; 2])>) -> String {
    match ends {
        Some((start, goal)) => {
            format!("the path goes from cell {start:?} to cell {goal:?} by moves to one of eight neighbours")
        }
        None => "the path goes by moves to one of eight neighbours, from and to any cells".to_owned(),
    }
}

fn spelled(moves: Octile) -> String {
    format!("{} + {}√2 = {:.4}", moves.straight, moves.diagonal, moves.length())
}
