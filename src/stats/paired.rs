//! Two measurements of the same units: what one contender changes of another.

use super::bootstrap::{self, Estimate, Resampling};

/// Values that differ by no more are equal: sums of the same steps in another order differ in their last digits.
pub const EQUAL: f64 = 1e-9;

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

/// The mean of `second - first`, bootstrapped over pairs; none below two pairs.
///
/// # Panics
/// If a value is not finite: pairs with a failure have no difference and are counted by the caller.
pub fn mean_difference(pairs: &[(f64, f64)], plan: Resampling) -> Option<Estimate> {
    assert_finite(pairs);
    let mean = |units: &[&(f64, f64)]| {
        (!units.is_empty()).then(|| units.iter().map(|(a, b)| b - a).sum::<f64>() / units.len() as f64)
    };
    bootstrap::percentile(pairs, mean, plan)
}

/// The ratio of the means, `Σ second / Σ first`, bootstrapped over pairs; none below two pairs or where the
/// first sum is not positive.
///
/// # Panics
/// If a value is not finite.
pub fn ratio_of_means(pairs: &[(f64, f64)], plan: Resampling) -> Option<Estimate> {
    assert_finite(pairs);
    let ratio = |units: &[&(f64, f64)]| {
        let first: f64 = units.iter().map(|(a, _)| a).sum();
        (first > 0.0).then(|| units.iter().map(|(_, b)| b).sum::<f64>() / first)
    };
    bootstrap::percentile(pairs, ratio, plan)
}

/// By how many per cent the sum of the second values of all pairs differs from that of the first, with its interval over
/// draws of several pairs.
///
/// None below two draws, or if the sum of the first is not positive.
pub fn change_of_sums_percent(draws: &[Vec<(f64, f64)>], plan: Resampling) -> Option<Estimate> {
    bootstrap::percentile(draws, change_percent, plan)
}

fn change_percent(draws: &[&Vec<(f64, f64)>]) -> Option<f64> {
    let sum = |get: fn(&(f64, f64)) -> f64| draws.iter().flat_map(|draw| draw.iter()).map(get).sum::<f64>();
    let (base, other) = (sum(|pair| pair.0), sum(|pair| pair.1));
    (base > 0.0).then(|| 100.0 * (other / base - 1.0))
}

fn assert_finite(pairs: &[(f64, f64)]) {
    assert!(pairs.iter().all(|(a, b)| a.is_finite() && b.is_finite()), "a pair without a difference");
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLAN: Resampling = Resampling { resamples: 1000, level: 0.95, seed: 3 };

    #[test]
    fn pairing_removes_what_the_units_share() {
        // Units differ by thousands, the change is 5 ± 1: the interval knows only the change.
        let pairs: Vec<(f64, f64)> =
            (0..50).map(|i| f64::from(i * i)).map(|x| (x, x + 5.0 + f64::from(x as i32 % 3) - 1.0)).collect();
        let found = mean_difference(&pairs, PLAN).unwrap();
        let exact = pairs.iter().map(|(a, b)| b - a).sum::<f64>() / 50.0;
        assert!((found.value - exact).abs() < 1e-9 && found.interval.contains(exact), "{found:?}");
        assert!(found.interval.half_width() < 0.4, "{found:?}");
    }

    #[test]
    fn a_constant_factor_is_found_without_spread() {
        let pairs = [(1.0, 0.5), (8.0, 4.0), (3.0, 1.5)];
        let found = ratio_of_means(&pairs, PLAN).unwrap();
        assert_eq!((found.value, found.interval.low, found.interval.high), (0.5, 0.5, 0.5));
        assert_eq!(ratio_of_means(&[(0.0, 1.0), (0.0, 2.0)], PLAN), None);
        assert_eq!(mean_difference(&pairs[..1], PLAN), None);
    }

    #[test]
    fn the_ratio_weighs_units_by_their_size() {
        let found = ratio_of_means(&[(1.0, 2.0), (9.0, 3.0)], PLAN).unwrap();
        assert_eq!(found.value, 0.5);
    }

    #[test]
    fn long_queries_weigh_more_than_short_ones() {
        let draws = [vec![(100.0, 50.0), (10.0, 20.0)], vec![(90.0, 90.0)]];
        assert!((change_of_sums_percent(&draws, PLAN).unwrap().value + 20.0).abs() < 1e-12);
        assert_eq!(change_of_sums_percent(&[vec![(0.0, 1.0)], vec![(0.0, 1.0)]], PLAN), None);
        assert_eq!(change_of_sums_percent(&[], PLAN), None);
    }

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
