//! Whether a printed length is at least the straight line between its ends.

use super::{Entry, refused, rule};
use base::settings::Accepted;
use base::text::listed;
use proofs::bounds::apart;
use proofs::exact::parse;
use proofs::proof;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "straight_line",
    about: "is a printed length at least the straight line between start and goal?",
    revision: |_| 1,
    question: |_| None,
    settings: Accepted::shape::<Settings>(),
    example: "
start = [2.0, 2.0]
goal = [36.0, 30.0]
",
    build: |context| {
        let Settings { start, goal, size } = context.settings.read()?;
        let exact = |key: &str, point: [f64; 2]| {
            let read = |at: f64| parse(&at.to_string());
            let message =
                format!("`{key}` is {}; two coordinates of up to 15 digits are accepted", listed(point));
            read(point[0]).zip(read(point[1])).ok_or_else(|| context.settings.error_at(key, message))
        };
        let apart = apart(exact("start", start)?.into(), exact("goal", goal)?.into());
        let print = context.print()?;
        Ok(rule(move |_, _| refused(proof::straight_line(print, [start, goal], apart, size))))
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
