//! A printed percentage reduction, recomputed from the two printed cells it was taken of.

use super::{
    AuditError,
    printed::{Digits, Printed},
};
use stats::interval::Interval;

/// What two printed cells say about the reduction from one to the other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reduction {
    /// Per cent, of the cells exactly as printed.
    pub as_printed: f64,
    /// Per cent, over everything the cells' digits can stand for.
    pub possible: Interval,
}

impl Reduction {
    /// The reduction from `before` to `after`, `100 (before - after) / before`.
    ///
    /// # Errors
    /// [`AuditError::NoReduction`] if `before` can stand for zero or less, or `after` for less than zero by
    /// more than half a unit of its last place.
    pub fn between(before: Printed, after: Printed, digits: Digits) -> Result<Self, AuditError> {
        let (from, to) = (before.interval(digits), after.interval(digits));
        if from.low <= 0.0 || after.units() < 0 {
            return Err(AuditError::NoReduction { before: before.to_string(), after: after.to_string() });
        }
        let percent = |before: f64, after: f64| 100.0 * (before - after) / before;
        Ok(Self {
            as_printed: percent(before.value(), after.value()),
            possible: Interval::new(percent(from.low, to.high), percent(from.high, to.low.max(0.0))),
        })
    }

    /// Whether `percent` is what the cells, exactly as printed, give.
    pub fn gives(self, percent: Printed, digits: Digits) -> bool {
        percent.agrees(self.as_printed, digits)
    }

    /// Whether some true values behind the cells give a reduction that prints as `percent`.
    pub fn allows(self, percent: Printed, digits: Digits) -> bool {
        self.possible.meets(percent.interval(digits))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn printed(text: &str) -> Printed {
        text.parse().unwrap()
    }

    fn reduction(before: &str, after: &str) -> Reduction {
        Reduction::between(printed(before), printed(after), Digits::Unknown).unwrap()
    }

    #[test]
    fn the_grid_papers_eight_reductions_follow_from_its_cells() {
        for (before, after, percent) in [
            ("0.0018", "0.0015", "16.67"),
            ("0.0020", "0.0016", "20"),
            ("270.00", "229.17", "15.12"),
            ("315.00", "309.14", "1.86"),
            ("14.65", "13.40", "8.5"),
            ("17.56", "16.40", "6.6"),
            ("69", "45", "34.78"),
            ("89", "46", "48.31"),
        ] {
            let found = reduction(before, after);
            assert!(found.gives(printed(percent), Digits::Rounded), "{before} {after}: {found:?}");
            assert!(found.allows(printed(percent), Digits::Unknown), "{before} {after}: {found:?}");
        }
        // The length that 12 + 4√2 truncates to would have given another percentage.
        let swapped = reduction("17.65", "16.40");
        assert!(
            !swapped.gives(printed("6.6"), Digits::Unknown)
                && swapped.gives(printed("7.08"), Digits::Rounded)
        );
        assert!(!swapped.allows(printed("6.6"), Digits::Unknown));
        // Four decimals of a millisecond time leave almost any percentage open.
        let time = reduction("0.0018", "0.0015").possible;
        assert!(time.low < 10.0 && time.high > 20.0, "{time:?}");
    }

    #[test]
    fn the_possible_reductions_are_those_of_the_cells_readings() {
        for (before, after) in [("14.65", "13.40"), ("5", "0"), ("2.0", "3.1"), ("1", "9")] {
            let possible = reduction(before, after).possible;
            let (from, to) =
                (printed(before).interval(Digits::Unknown), printed(after).interval(Digits::Unknown));
            let at = |ends: Interval, i: i32| ends.low + (ends.high - ends.low) * f64::from(i) / 40.0;
            let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
            for (i, j) in (0..=40).flat_map(|i| (0..=40).map(move |j| (i, j))) {
                let percent = 100.0 * (1.0 - at(to, j).max(0.0) / at(from, i));
                (least, most) = (least.min(percent), most.max(percent));
            }
            assert!(
                (possible.low - least).abs() < 1e-9 && (possible.high - most).abs() < 1e-9,
                "{possible:?}"
            );
        }
    }

    #[test]
    fn a_reduction_from_nothing_is_refused() {
        for (before, after) in [("0", "1"), ("-3", "1"), ("3", "-1")] {
            let refused = Reduction::between(printed(before), printed(after), Digits::Rounded);
            let says = AuditError::NoReduction { before: before.to_owned(), after: after.to_owned() };
            assert_eq!(refused, Err(says));
        }
    }
}
