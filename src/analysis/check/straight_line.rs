//! Whether a printed length is at least the straight line between its ends.

use super::{Check, Entry};
use crate::analysis::audit::bounds::{shortfall, straight_line};
use crate::analysis::audit::printed::{Digits, Printed};
use crate::analysis::evidence::Evidence;
use crate::analysis::verdict::{Finding, Verdict};
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "straight_line",
    about: "is a printed length at least the straight line between start and goal?",
    build: |context| {
        let settings: Settings = context.settings.read()?;
        Ok(Box::new(StraightLine { settings, printed: context.printed()?, digits: context.digits() }))
    },
};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Settings {
    start: [f64; 2],
    goal: [f64; 2],
}

struct StraightLine {
    settings: Settings,
    printed: Printed,
    digits: Digits,
}

impl Check for StraightLine {
    fn judge(&self, _evidence: &Evidence<'_>) -> Finding {
        let Settings { start, goal } = self.settings;
        let least = straight_line(start, goal);
        let short = shortfall(self.printed.interval(self.digits), least);
        let line = format!("the straight line from {start:?} to {goal:?} is {least:.4} long");
        let found = match short {
            Some(by) => {
                format!("{} is shorter by at least {by:.4}, whatever its digits stand for", self.printed)
            }
            None => format!("{} is not shorter", self.printed),
        };
        Finding {
            check: ENTRY.name.to_owned(),
            verdict: short.map(|_| Verdict::Impossible),
            because: vec![line, found],
            premises: vec![
                "the path joins the printed start and goal".to_owned(),
                "its printed cost is its length in cells, as A*'s is".to_owned(),
            ],
            ..Finding::default()
        }
    }
}
