//! Whether a printed saving on a printed path length is possible for any path between the two cells.

use super::{Check, Entry};
use crate::analysis::audit::bounds::{largest_saving_percent, straight_line};
use crate::analysis::audit::lattice::{Octile, Step, lengths_printing};
use crate::analysis::audit::printed::{Digits, Printed};
use crate::analysis::evidence::Evidence;
use crate::analysis::interval::Interval;
use crate::analysis::verdict::{Finding, Verdict};
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "largest_saving",
    about: "is a printed saving on a printed length possible for any path between start and goal?",
    build: |context| {
        let settings: Settings = context.settings.read()?;
        let baseline = context.printed_of(&settings.baseline)?;
        let printed = context.printed()?;
        Ok(Box::new(LargestSaving { settings, printed, digits: context.digits(), baseline }))
    },
};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Settings {
    baseline: String,
    start: [i32; 2],
    goal: [i32; 2],
}

struct LargestSaving {
    settings: Settings,
    printed: Printed,
    digits: Digits,
    baseline: (Printed, Digits),
}

impl Check for LargestSaving {
    fn judge(&self, _evidence: &Evidence<'_>) -> Finding {
        let Settings { start, goal, .. } = self.settings;
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
        let most = largest_saving_percent(baseline, least);
        let claimed = self.printed.interval(self.digits).low;
        let is_possible = claimed <= most;
        let compared = if is_possible { "not more than that" } else { "more than any path can save" };
        Finding {
            check: ENTRY.name.to_owned(),
            verdict: (!is_possible).then_some(Verdict::Impossible),
            because: vec![
                which,
                format!(
                    "no path is shorter than the straight line of {least:.4}, so it saves at most {most:.2} %"
                ),
                format!("{} % is {compared}", self.printed),
            ],
            premises: vec![
                format!("both paths go from cell {start:?} to cell {goal:?}"),
                "costs are lengths; the baseline's is that of an 8-connected path".to_owned(),
            ],
            ..Finding::default()
        }
    }
}
