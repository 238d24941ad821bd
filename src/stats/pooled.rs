//! Statistics of all that was measured on draws of several cases each, with intervals over whole draws.

use super::bootstrap::{self, Estimate, Resampling};
use super::summary;

/// The sum of the first numbers over the sum of the second, one pair a draw: a ratio of means, a share, a mean over cases.
///
/// None below two draws, or where the second sum is not positive.
pub fn ratio_of_sums(draws: &[[f64; 2]], plan: Resampling) -> Option<Estimate> {
    let ratio = |picks: &[usize]| {
        let sum = |sum: (f64, f64), pick: &usize| (sum.0 + draws[*pick][0], sum.1 + draws[*pick][1]);
        let (above, below) = picks.iter().fold((0.0, 0.0), sum);
        (below > 0.0).then(|| above / below)
    };
    bootstrap::of_indices(draws.len(), &ratio, plan)
}

/// The median of all numbers of all draws; failures may be infinite. None below two draws.
///
/// # Panics
/// If a number is NaN.
pub fn median(draws: &[Vec<f64>], plan: Resampling) -> Option<Estimate> {
    of_all(draws, summary::median, plan)
}

/// The standard deviation of all numbers of all draws. None below two draws.
///
/// # Panics
/// If a number is NaN.
pub fn deviation(draws: &[Vec<f64>], plan: Resampling) -> Option<Estimate> {
    of_all(draws, summary::standard_deviation, plan)
}

fn of_all(draws: &[Vec<f64>], of: fn(&[f64]) -> Option<f64>, plan: Resampling) -> Option<Estimate> {
    let all = |draws: &[&Vec<f64>]| {
        let numbers: Vec<f64> = draws.iter().flat_map(|draw| draw.iter().copied()).collect();
        of(&numbers)
    };
    bootstrap::percentile(draws, all, plan)
}

/// The slope of the least-squares line through all `(place, number)` of all draws. None below two draws, or if all lie at
/// one place.
pub fn slope(draws: &[Vec<(f64, f64)>], plan: Resampling) -> Option<Estimate> {
    let of = |draws: &[&Vec<(f64, f64)>]| {
        let points = || draws.iter().flat_map(|draw| draw.iter());
        let sums = points().fold((0.0, 0.0, 0.0), |sum, (x, y)| (sum.0 + 1.0, sum.1 + x, sum.2 + y));
        let (mean_x, mean_y) = (sums.1 / sums.0, sums.2 / sums.0);
        let (spread, joint) = points().fold((0.0, 0.0), |sum, (x, y)| {
            (sum.0 + (x - mean_x) * (x - mean_x), sum.1 + (x - mean_x) * (y - mean_y))
        });
        (spread > 0.0).then(|| joint / spread)
    };
    bootstrap::percentile(draws, of, plan)
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLAN: Resampling = Resampling { resamples: 1000, level: 0.95, seed: 3 };

    #[test]
    fn a_constant_factor_is_found_without_spread() {
        let found = ratio_of_sums(&[[0.5, 1.0], [4.0, 8.0], [1.5, 3.0]], PLAN).unwrap();
        assert_eq!((found.value, found.interval.low, found.interval.high, found.units), (0.5, 0.5, 0.5, 3));
        assert_eq!(ratio_of_sums(&[[1.0, 0.0], [2.0, 0.0]], PLAN), None);
        assert_eq!(ratio_of_sums(&[[1.0, 2.0]], PLAN), None);
    }

    #[test]
    fn draws_that_agree_within_themselves_count_as_one_number_each() {
        let draws: Vec<Vec<f64>> = (0..10).map(|draw| vec![f64::from(draw); 100]).collect();
        let of_draws = median(&draws, PLAN).unwrap();
        let cases: Vec<Vec<f64>> = draws.iter().flatten().map(|number| vec![*number]).collect();
        let of_cases = median(&cases, PLAN).unwrap();
        assert_eq!((of_draws.value, of_cases.value), (4.5, 4.5));
        assert!(of_draws.interval.half_width() > 3.0 * of_cases.interval.half_width(), "{of_draws:?}");
        let spread = deviation(&draws, PLAN).unwrap();
        assert!((spread.value - 2.874).abs() < 1e-3, "{spread:?}");
    }

    #[test]
    fn the_slope_of_points_on_a_line_is_the_lines() {
        let draws: Vec<Vec<(f64, f64)>> =
            (0..5).map(f64::from).map(|x| vec![(x, 3.0 - 0.5 * x), (x + 9.0, -1.5 - 0.5 * x)]).collect();
        let found = slope(&draws, PLAN).unwrap();
        assert!((found.value + 0.5).abs() < 1e-12 && found.interval.half_width() < 1e-12, "{found:?}");
        assert_eq!(slope(&[vec![(1.0, 2.0)], vec![(1.0, 3.0)]], PLAN), None);
    }
}
