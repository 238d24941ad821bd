//! Two measurements of the same units: the change from one contender to another.

/// Values that differ by no more are equal: sums of the same steps in another order differ in their last digits.
pub const EQUAL: f64 = 1e-9;

/// A number, or `limit` where rounding alone may part the two: sums of numbers as large as `size` differ so.
pub fn snapped(number: f64, limit: f64, size: f64) -> f64 {
    if (number - limit).abs() <= size * EQUAL { limit } else { number }
}

/// How many pairs went which way.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Signs {
    /// The second is below the first.
    pub lower: usize,
    /// The two are equal, both infinite included.
    pub equal: usize,
    /// The second is above the first.
    pub higher: usize,
}

/// The directions of `(first, second)` pairs; failures may be infinite.
///
/// # Panics
/// If a value is NaN.
pub fn signs(pairs: &[(f64, f64)]) -> Signs {
    assert!(pairs.iter().all(|(a, b)| !a.is_nan() && !b.is_nan()), "NaN in a pair");
    let lower = pairs.iter().filter(|(a, b)| *b < a - EQUAL).count();
    let higher = pairs.iter().filter(|(a, b)| *b > a + EQUAL).count();
    Signs { lower, equal: pairs.len() - lower - higher, higher }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_sum_in_two_orders_is_equal() {
        let pairs = [(15.485_281_374_238_573, 15.485_281_374_238_571), (1.0, 1.0 + 1e-8), (1.0, 1.0 - 1e-8)];
        assert_eq!(signs(&pairs), Signs { lower: 1, equal: 1, higher: 1 });
    }

    #[test]
    fn signs_count_failures_as_infinite() {
        let inf = f64::INFINITY;
        let pairs = [(1.0, 0.5), (inf, 3.0), (2.0, inf), (inf, inf), (4.0, 4.0), (1.0, 2.0)];
        assert_eq!(signs(&pairs), Signs { lower: 2, equal: 2, higher: 2 });
    }
}
