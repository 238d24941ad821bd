//! Printed lengths and savings against the straight line between two points.
//!
//! Premises of every bound here: the path starts and ends at the given points, its printed length is its Euclidean
//! length in the same unit, and a saving is relative to the printed baseline. No map is assumed.

use super::exact::{Exact, Print, add, mul, sub, whole};
use stats::interval::Interval;
use std::cmp::Ordering;

/// Length of the straight line between two points, in the points' unit.
pub fn straight_line(a: [f64; 2], b: [f64; 2]) -> f64 {
    let (dx, dy) = (a[0] - b[0], a[1] - b[1]);
    (dx * dx + dy * dy).sqrt()
}

/// Which moves there are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Moves {
    /// Along any line.
    Any,
    /// To one of eight neighbours, at the cost of 1 and √2.
    Eight,
    /// To one of four neighbours.
    Four,
}

impl Moves {
    /// Its name in certificates.
    pub fn name(self) -> &'static str {
        match self {
            Self::Any => "any",
            Self::Eight => "eight",
            Self::Four => "four",
        }
    }
}

/// How far two points are apart along each axis.
pub fn apart(from: [Exact; 2], to: [Exact; 2]) -> [Exact; 2] {
    [0, 1].map(|at| if to[at] > from[at] { to[at] - from[at] } else { from[at] - to[at] })
}

/// How the longest value that prints so compares with the least length `a + √b` between ends that are `apart`, exactly; with
/// a and b. None if 128 bits do not suffice.
pub fn against(print: Print, apart: [Exact; 2], moves: Moves) -> Option<(Ordering, [Exact; 2])> {
    let high = print.span().high;
    let [dx, dy] = apart;
    let [a, b] = match moves {
        Moves::Any => [whole(0), add(mul(dx, dx)?, mul(dy, dy)?)?],
        Moves::Four => [add(dx, dy)?, whole(0)],
        Moves::Eight => {
            let (short, long) = (dx.min(dy), dx.max(dy));
            [sub(long, short)?, mul(whole(2), mul(short, short)?)?]
        }
    };
    let rest = sub(high, a)?;
    let order = if rest < whole(0) { Ordering::Less } else { mul(rest, rest)?.cmp(&b) };
    Some((order, [a, b]))
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

#[cfg(test)]
mod tests {
    use super::{super::neighbourhood, super::printed::Digits, super::printed::Printed, *};
    use crate::turns::straight_line_between;

    fn interval(text: &str) -> Interval {
        text.parse::<Printed>().unwrap().interval(Digits::Unknown)
    }

    fn is_short(text: &str, apart: [i128; 2]) -> bool {
        let print = Print { printed: text.parse().unwrap(), digits: Digits::Unknown };
        against(print, apart.map(whole), Moves::Any).unwrap().0.is_lt()
    }

    #[test]
    fn the_grid_papers_impossible_numbers_are_impossible() {
        let straight = straight_line([22.5, 15.5], [26.5, 28.5]);
        assert!((straight - 185.0_f64.sqrt()).abs() < 1e-12 && (straight - 13.6015).abs() < 5e-5);
        assert!(is_short("13.40", [4, 13]) && !is_short("13.60", [4, 13]));
        let exact = 9.0 + 4.0 * std::f64::consts::SQRT_2;
        let largest = largest_saving_percent(Interval::new(exact, exact), straight);
        assert!((largest - 7.20).abs() < 5e-3, "{largest}");
        let printed = largest_saving_percent(interval("14.65"), straight);
        assert!(interval("8.5").low > printed + 1.2 && interval("7.2").low < printed);
        // 17.657 against a shortest 16.524, where corner cutting is allowed and the line of sight exact.
        assert!((largest_saving_percent(Interval::new(17.6569, 17.6569), 16.524) - 6.42).abs() < 5e-3);
    }

    #[test]
    fn neighbouring_ends_rescue_the_shortest_printed_length() {
        let size = [30, 30];
        let shortest = straight_line_between(&neighbourhood([22, 15], size), &[[26, 28]]).unwrap();
        assert!((shortest - 12.37).abs() < 5e-3, "{shortest}");
        assert!(interval("13.40").high >= shortest && !is_short("13.40", [3, 12]));
        assert_eq!(neighbourhood([0, 29], size), [[0, 28], [1, 28], [0, 29], [1, 29]]);
        assert_eq!(straight_line_between(&[], &[[0, 0]]), None);
    }

    #[test]
    fn no_path_saves_more_than_the_largest_saving() {
        // Law: the saving of any length in any reading of the baseline is at most the bound, which is reached.
        let baseline = Interval::new(14.645, 14.66);
        let least = 13.6;
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
