//! Whether a printed length is that of any 8-connected path between the two cells.

use super::{Entry, refused_or, rule};
use base::settings::Accepted;
use proofs::exact::Print;
use proofs::lattice::{Step, lengths_printing};
use proofs::printed::Digits;
use proofs::proof;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "lattice_length",
    about: "is a printed length a + b√2 for any 8-connected path between the cells, rounded or truncated?",
    revision: |_| 1,
    question: |_| None,
    settings: Accepted::shape::<Settings>(),
    example: "start = [2, 2]\ngoal = [36, 30]",
    build: |context| {
        let Settings { start, goal, size } = context.settings.read()?;
        if start.is_some() != goal.is_some() {
            let given = if start.is_some() { "start" } else { "goal" };
            let message = "`start` and `goal` are given together or not at all";
            return Err(context.settings.error_at(given, message).about("start").about("goal"));
        }
        let print = context.print()?;
        let ends = start.zip(goal).map(|(start, goal)| [start, goal]);
        Ok(rule(move |_, _| refused_or(proof::lattice_length(print, ends, size), &possible(print, ends))))
    },
};

/// The lengths that print so, each as straight moves and diagonals, with how its digits then end.
fn possible(print: Print, ends: Option<[[i32; 2]; 2]>) -> String {
    let trip = ends.map(|[start, goal]| [goal[0] - start[0], goal[1] - start[1]]);
    let lengths = |digits| lengths_printing(print.printed, digits, Step::ONE, trip);
    let allowed = lengths(print.digits);
    let spelled = |(how, digits): (&str, Digits)| {
        let own = lengths(digits).into_iter().filter(|length| allowed.contains(length));
        own.map(|own| format!("{} + {}√2, {how}", own.straight, own.diagonal)).collect::<Vec<_>>()
    };
    let spelled = [("rounded", Digits::Rounded), ("cut off", Digits::Truncated)].map(spelled).concat();
    spelled.join(" or ")
}

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
