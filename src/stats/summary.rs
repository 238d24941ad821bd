//! Mean, standard deviation and quantiles of a sample.

use std::collections::BTreeMap;

/// Arithmetic mean; none for an empty sample.
pub fn mean(sample: &[f64]) -> Option<f64> {
    (!sample.is_empty()).then(|| sample.iter().sum::<f64>() / sample.len() as f64)
}

/// Standard deviation with the divisor n − 1; none below two values or where a value is infinite.
pub fn standard_deviation(sample: &[f64]) -> Option<f64> {
    let centre = mean(sample).filter(|centre| centre.is_finite() && sample.len() > 1)?;
    let squares: f64 = sample.iter().map(|x| (x - centre) * (x - centre)).sum();
    Some((squares / (sample.len() - 1) as f64).sqrt())
}

/// The quantile of type 7: linear between order statistics, the least at `share` 0 and the greatest at 1.
///
/// Between a finite value and an infinite one it is infinite. None for an empty sample.
///
/// # Panics
/// If `share` is outside [0, 1] or a value is NaN.
///
/// # Source
/// Hyndman & Fan, "Sample quantiles in statistical packages", The American Statistician 50 (1996) 361–365,
/// definition 7; the default of R's `quantile`.
pub fn quantile_type7(sample: &[f64], share: f64) -> Option<f64> {
    if sample.is_empty() {
        return None;
    }
    let place = place(sample.len(), share);
    let mut rest = sample.to_vec();
    assert_numbers(sample);
    // The two order statistics that are needed, without sorting the others.
    let (_, low, above) = rest.select_nth_unstable_by(place.floor() as usize, f64::total_cmp);
    let high = above.iter().copied().min_by(f64::total_cmp).filter(|_| place > place.floor());
    Some(between(*low, high.unwrap_or(*low), place))
}

/// The median: [`quantile_type7`] at a half.
pub fn median(sample: &[f64]) -> Option<f64> {
    quantile_type7(sample, 0.5)
}

/// The sample in rising order.
///
/// # Panics
/// If a value is NaN.
pub(super) fn sorted(sample: &[f64]) -> Vec<f64> {
    assert_numbers(sample);
    let mut sorted = sample.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted
}

/// [`quantile_type7`] of a sample that is sorted and not empty.
pub(super) fn quantile_of_sorted(sorted: &[f64], share: f64) -> f64 {
    let place = place(sorted.len(), share);
    between(sorted[place.floor() as usize], sorted[place.ceil() as usize], place)
}

fn assert_numbers(sample: &[f64]) {
    assert!(sample.iter().all(|x| !x.is_nan()), "NaN in a sample of {}", sample.len());
}

/// Where the quantile lies among so many values in rising order, counted from 0.
fn place(count: usize, share: f64) -> f64 {
    assert!((0.0..=1.0).contains(&share), "a quantile at {share}; shares lie in [0, 1]");
    (count - 1) as f64 * share
}

/// What lies at `place` between the order statistics below and above it.
fn between(low: f64, high: f64, place: f64) -> f64 {
    if low == high { low } else { low + (high - low) * (place - place.floor()) }
}

/// Medians of the second numbers where the first lies in the lower, middle and upper third of its sample; thirds that hold
/// nothing are left out.
pub fn medians_by_thirds(points: &[(f64, f64)]) -> Vec<f64> {
    let places: Vec<f64> = points.iter().map(|(x, _)| *x).collect();
    let cuts: Vec<f64> =
        [1.0, 2.0].into_iter().filter_map(|third| quantile_type7(&places, third / 3.0)).collect();
    let mut thirds = [Vec::new(), Vec::new(), Vec::new()];
    for (x, y) in points {
        thirds[cuts.iter().filter(|cut| x > cut).count()].push(*y);
    }
    thirds.iter().filter_map(|numbers| median(numbers)).collect()
}

/// The mean of the second numbers that go with each first.
pub fn means_along(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut along: BTreeMap<u64, Vec<f64>> = BTreeMap::new();
    for [x, y] in points {
        along.entry(x.to_bits()).or_default().push(*y);
    }
    along.iter().filter_map(|(x, ys)| Some([f64::from_bits(*x), mean(ys)?])).collect()
}

/// Where a box of `values` stands: the ends of its whiskers (5 and 95 %), quartiles and median; NaN without values.
pub fn box_of(values: &[f64]) -> [f64; 5] {
    [0.05, 0.25, 0.5, 0.75, 0.95].map(|share| quantile_type7(values, share).unwrap_or(f64::NAN))
}

/// Below which number each share of `values` lies: quantiles at every half per cent, as good as every step to the eye and a
/// tenth of the bytes.
pub fn cumulative(values: &[f64]) -> Vec<[f64; 2]> {
    let shares = (0..=200).map(|step| f64::from(step) / 200.0);
    shares.filter_map(|share| Some([quantile_type7(values, share)?, share])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_those_that_r_prints() {
        // R: quantile(c(1, 2, 4, 8, 16)) and quantile(1:10, c(.1, .25, .9)).
        let powers = [8.0, 1.0, 16.0, 2.0, 4.0];
        for (share, value) in [(0.0, 1.0), (0.25, 2.0), (0.5, 4.0), (0.75, 8.0), (1.0, 16.0), (0.9, 12.8)] {
            let found = quantile_type7(&powers, share).unwrap();
            assert!((found - value).abs() < 1e-12, "{share}: {found}");
        }
        let ten: Vec<f64> = (1..=10).map(f64::from).collect();
        for (share, value) in [(0.1, 1.9), (0.25, 3.25), (0.9, 9.1)] {
            assert!((quantile_type7(&ten, share).unwrap() - value).abs() < 1e-12);
        }
        assert_eq!(median(&ten), Some(5.5));
        assert_eq!(median(&[]), None);
    }

    #[test]
    fn failures_are_infinite_and_move_a_median_as_such() {
        let inf = f64::INFINITY;
        assert_eq!(median(&[1.0, inf, 2.0]), Some(2.0));
        assert_eq!(median(&[1.0, inf, inf]), Some(inf));
        assert_eq!(median(&[1.0, inf]), Some(inf));
        assert_eq!(mean(&[1.0, inf]), Some(inf));
        assert_eq!(standard_deviation(&[1.0, inf]), None);
    }

    #[test]
    fn the_deviation_divides_by_n_minus_one() {
        // NIST StRD "NumAcc1": mean 10000002, standard deviation 1.
        let sample = [10_000_001.0, 10_000_003.0, 10_000_002.0];
        assert_eq!(mean(&sample), Some(10_000_002.0));
        assert_eq!(standard_deviation(&sample), Some(1.0));
        assert_eq!(standard_deviation(&[3.0]), None);
        assert_eq!(mean(&[]), None);
    }
}
