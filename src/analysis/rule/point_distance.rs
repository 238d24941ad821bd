//! Whether a printed distance is that between the two printed points.

use super::{Entry, Rule};
use crate::analysis::class::Outcome;
use crate::analysis::evidence::Evidence;
use crate::analysis::found::Found;
use crate::analysis::verdict::Estimate;
use audit::bounds::straight_line;
use audit::printed::{Digits, Printed};
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "point_distance",
    about: "is a printed distance that between two printed points?",
    settings: Accepted::of::<Settings>(),
    example: "
from = [22.5, 15.5]
to = [26.5, 28.5]
",
    build: |context| {
        let settings: Settings = context.settings.read()?;
        Ok(Box::new(PointDistance { settings, printed: context.printed()?, digits: context.digits() }))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// x and y of the first point as printed.
    from: [f64; 2],
    /// x and y of the second point as printed.
    to: [f64; 2],
}

struct PointDistance {
    settings: Settings,
    printed: Printed,
    digits: Digits,
}

impl Rule for PointDistance {
    fn find(&self, _evidence: &Evidence<'_>) -> Found {
        let Settings { from, to } = self.settings;
        let distance = straight_line(from, to);
        let agrees = |digits| self.printed.agrees(distance, digits);
        let how = match (agrees(Digits::Rounded), agrees(Digits::Truncated)) {
            (true, true) => "which prints so, rounded and truncated",
            (true, false) => "which prints so if rounded, and not if truncated",
            (false, true) => "which prints so if truncated, and not if rounded",
            (false, false) => "which does not print so",
        };
        let outcome = if agrees(self.digits) { Outcome::Holds } else { Outcome::Proved };
        Found {
            outcome: Some(outcome),
            ours: Some(Estimate::bare(distance, "computed from the printed points", 1)),
            because: vec![format!("from {from:?} to {to:?} it is {distance:.4}, {how}")],
            premises: vec!["the distance is Euclidean, in the unit of the coordinates".to_owned()],
            ..Found::default()
        }
    }
}
