//! What the straight line between two points forbids.
//!
//! Premises of every bound here: the path starts and ends at the given points, its printed length is its
//! Euclidean length in the same unit, and a saving is relative to the printed baseline. No map is assumed.

use super::{Cell, distance};
use stats::interval::Interval;

/// Length of the straight line between two points, in the points' unit.
pub fn straight_line(a: [f64; 2], b: [f64; 2]) -> f64 {
    let (dx, dy) = (a[0] - b[0], a[1] - b[1]);
    (dx * dx + dy * dy).sqrt()
}

/// The shortest straight line from any of `starts` to any of `goals`, in cells; none if either is empty.
///
/// With a cell's [neighbourhood](super::neighbourhood) on either side this is the bound that survives when
/// the printed ends are off by one cell.
pub fn straight_line_between(starts: &[Cell], goals: &[Cell]) -> Option<f64> {
    let pairs = starts.iter().flat_map(|&start| goals.iter().map(move |&goal| distance(start, goal)));
    pairs.min_by(f64::total_cmp)
}

/// By how much the longest value that `printed` can stand for falls short of `least`; none if it does not.
pub fn shortfall(printed: Interval, least: f64) -> Option<f64> {
    (printed.high < least).then_some(least - printed.high)
}

/// The largest saving, in per cent of the baseline, that any path no shorter than `least` can make.
///
/// The baseline's own slack is used in the paper's favour: its longest reading allows most. Negative when
/// even that is below `least`.
///
/// # Panics
/// If the baseline's longest reading is not positive.
pub fn largest_saving_percent(baseline: Interval, least: f64) -> f64 {
    assert!(baseline.high > 0.0, "a saving on a baseline of at most {}", baseline.high);
    100.0 * (1.0 - least / baseline.high)
}

/// By how many percentage points the smallest saving that `printed_percent` can stand for exceeds the
/// [largest](largest_saving_percent); none if it does not.
pub fn excess_saving(printed_percent: Interval, baseline: Interval, least: f64) -> Option<f64> {
    let largest = largest_saving_percent(baseline, least);
    (printed_percent.low > largest).then_some(printed_percent.low - largest)
}

#[cfg(test)]
mod tests {
    use super::{super::neighbourhood, super::printed::Digits, super::printed::Printed, *};

    fn interval(text: &str) -> Interval {
        text.parse::<Printed>().unwrap().interval(Digits::Unknown)
    }

    #[test]
    fn the_grid_papers_impossible_numbers_are_impossible() {
        let straight = straight_line([22.5, 15.5], [26.5, 28.5]);
        assert!((straight - 185.0_f64.sqrt()).abs() < 1e-12 && (straight - 13.6015).abs() < 5e-5);
        assert!(shortfall(interval("13.40"), straight).unwrap() > 0.19);
        assert_eq!(shortfall(interval("13.60"), straight), None);
        let exact = 9.0 + 4.0 * std::f64::consts::SQRT_2;
        let largest = largest_saving_percent(Interval::new(exact, exact), straight);
        assert!((largest - 7.20).abs() < 5e-3, "{largest}");
        assert!(excess_saving(interval("8.5"), interval("14.65"), straight).unwrap() > 1.2);
        assert_eq!(excess_saving(interval("7.2"), interval("14.65"), straight), None);
        // 17.657 against a shortest 16.524, where corner cutting is allowed and the line of sight exact.
        assert!((largest_saving_percent(Interval::new(17.6569, 17.6569), 16.524) - 6.42).abs() < 5e-3);
    }

    #[test]
    fn neighbouring_ends_rescue_the_shortest_printed_length() {
        let size = [30, 30];
        let shortest = straight_line_between(&neighbourhood([22, 15], size), &[[26, 28]]).unwrap();
        assert!((shortest - 12.37).abs() < 5e-3, "{shortest}");
        assert_eq!(shortfall(interval("13.40"), shortest), None);
        assert_eq!(neighbourhood([0, 29], size), [[0, 28], [1, 28], [0, 29], [1, 29]]);
        assert_eq!(straight_line_between(&[], &[[0, 0]]), None);
    }

    #[test]
    fn no_path_saves_more_than_the_largest_saving() {
        // Law: the saving of any length in any reading of the baseline is at most the bound, which is reached.
        let (baseline, least) = (Interval::new(14.645, 14.66), 13.6);
        let bound = largest_saving_percent(baseline, least);
        let mut closest = f64::INFINITY;
        for i in 0..=20 {
            for j in 0..=20 {
                let from = baseline.low + (baseline.high - baseline.low) * f64::from(i) / 20.0;
                let saving = 100.0 * (from - (least + f64::from(j) / 10.0)) / from;
                assert!(saving <= bound + 1e-12);
                closest = closest.min(bound - saving);
            }
        }
        assert!(closest < 1e-9, "the bound is loose by {closest}");
    }
}
