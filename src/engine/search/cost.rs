//! Costs of paths: exact pairs a + b√2, or plain numbers.

use std::cmp::Ordering;
use std::f64::consts::SQRT_2;
use std::fmt::Debug;

/// What paths add up and searches compare.
pub trait Cost: Copy + Debug {
    /// The cost of standing still.
    const ZERO: Self;

    /// The sum of both.
    #[must_use]
    fn plus(self, other: Self) -> Self;

    /// The order of the two values, exact for exact costs.
    fn compare(self, other: Self) -> Ordering;

    /// Whether this cost is below `other`.
    fn is_below(self, other: Self) -> bool {
        self.compare(other).is_lt()
    }

    /// The cost as a number.
    fn value(self) -> f64;

    /// What tells costs of one value apart, the smaller first; nothing for most.
    fn tie(self) -> u64 {
        0
    }
}

impl Cost for f64 {
    const ZERO: Self = 0.0;

    fn plus(self, other: Self) -> Self {
        self + other
    }

    fn compare(self, other: Self) -> Ordering {
        self.total_cmp(&other)
    }

    fn is_below(self, other: Self) -> bool {
        self < other
    }

    fn value(self) -> f64 {
        self
    }
}

/// `straight + diagonal · √2`, the length of an 8-connected path in cells, exactly.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Octile {
    /// Moves along x or y.
    pub straight: u32,
    /// Diagonal moves.
    pub diagonal: u32,
}

impl Octile {
    /// The cost of one straight move.
    pub const STRAIGHT: Self = Self { straight: 1, diagonal: 0 };
    /// The cost of one diagonal move.
    pub const DIAGONAL: Self = Self { straight: 0, diagonal: 1 };
}

impl Cost for Octile {
    const ZERO: Self = Self { straight: 0, diagonal: 0 };

    fn plus(self, other: Self) -> Self {
        Self { straight: self.straight + other.straight, diagonal: self.diagonal + other.diagonal }
    }

    fn compare(self, other: Self) -> Ordering {
        // a + b√2 against c + d√2 is (a - c) against (d - b)√2; equal signs leave squares to compare.
        let straight = i64::from(self.straight) - i64::from(other.straight);
        let diagonal = i64::from(other.diagonal) - i64::from(self.diagonal);
        // A lattice path stays far below 2^30 moves, where the squares fit 64 bits.
        let squares = if straight.abs().max(diagonal.abs()) < 1 << 30 {
            (straight * straight).cmp(&(2 * diagonal * diagonal))
        } else {
            i128::from(straight).pow(2).cmp(&(2 * i128::from(diagonal).pow(2)))
        };
        match (straight >= 0, diagonal >= 0) {
            (true, true) => squares,
            (false, false) => squares.reverse(),
            (true, false) => Ordering::Greater,
            (false, true) => Ordering::Less,
        }
    }

    fn value(self) -> f64 {
        f64::from(self.straight) + f64::from(self.diagonal) * SQRT_2
    }
}

/// `value` in units of 1e-9, rounded to the nearest: the key by which floating-point estimates are ordered.
/// Negative values and NaN give 0.
pub fn quantised(value: f64) -> u64 {
    // A cast truncates; `round` would be a call on processors without an instruction for it, and a cast to u64 takes two.
    ((value * 1e9 + 0.5) as i64).max(0) as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_are_ordered_as_their_values_are() {
        let mut equal = 0;
        let mut less = 0;
        for a in 0..30 {
            for b in 0..30 {
                for (c, d) in (0..30).flat_map(|c| (0..30).map(move |d| (c, d))) {
                    let (x, y) = (Octile { straight: a, diagonal: b }, Octile { straight: c, diagonal: d });
                    // Values this small differ by more than 1e-3 unless the pairs are the same.
                    let truth =
                        if (a, b) == (c, d) { Ordering::Equal } else { x.value().total_cmp(&y.value()) };
                    assert_eq!(x.compare(y), truth, "{x:?} against {y:?}");
                    equal += u32::from(truth.is_eq());
                    less += u32::from(truth.is_lt());
                }
            }
        }
        assert_eq!((equal, less), (900, (810_000 - 900) / 2));
    }

    #[test]
    fn pairs_closer_than_floating_point_sees_are_distinguished() {
        // Convergents p / q of √2 straddle it in turn: 1/1 lies below, 3/2 above, 7/5 below …
        let mut p = 1;
        let mut q = 1;
        let mut below = true;
        let mut misjudged = 0;
        while p < u32::MAX / 3 {
            let whole = Octile { straight: p, diagonal: 0 };
            let root = Octile { straight: 0, diagonal: q };
            let truth = if below { Ordering::Less } else { Ordering::Greater };
            assert_eq!((whole.compare(root), root.compare(whole)), (truth, truth.reverse()), "{p} / {q}");
            misjudged += u32::from(whole.value().total_cmp(&root.value()) != truth);
            (p, q, below) = (p + 2 * q, p + q, !below);
        }
        assert!(misjudged > 0, "floating point would have done");
    }

    #[test]
    fn sums_in_another_order_have_the_same_key() {
        let (one, other) = (0.1 + 0.2 + 0.3, 0.3 + 0.2 + 0.1);
        assert_ne!(one, other);
        assert_eq!(quantised(one), quantised(other));
        assert_eq!(quantised(SQRT_2), 1_414_213_562);
    }
}
