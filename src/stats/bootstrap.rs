//! Percentile bootstrap over units that were drawn independently.

use rand::RngExt as _;

use super::summary;
use crate::interval::Interval;
use base::seed;

/// How a bootstrap is made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resampling {
    /// How many times the units are drawn again; B.
    pub resamples: usize,
    /// Probability that the interval is to hold.
    pub level: f64,
    /// Where the stream of instances starts.
    pub seed: u64,
}

/// A statistic with its bootstrap interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// The statistic of the sample itself.
    pub value: f64,
    /// Percentile interval over the resamples that had a value; of units that all agree, what allows for others.
    pub interval: Interval,
    /// Whether all units agree, so that the interval is no bootstrap's.
    pub is_agreed: bool,
    /// Units in the sample.
    pub units: usize,
    /// Resamples for which the statistic has no value; left out of the interval.
    pub undefined: usize,
}

/// `statistic` of the units, with the interval between the type-7 quantiles of its values over resamples.
///
/// A unit is what was drawn independently (a roadmap with all its queries, a map with all contenders), so that
/// dependence within a unit is kept. The sampling order of units does not matter, their order in `units` does
/// to the last bit. None if the sample has fewer than two units or no value, or no resample has one.
///
/// # Panics
/// If the statistic gives NaN.
///
/// # Source
/// Efron, *The Jackknife, the Bootstrap and Other Resampling Plans* (1982), section 10.4.
pub fn percentile<T>(
    units: &[T],
    statistic: impl Fn(&[&T]) -> Option<f64>,
    plan: Resampling,
) -> Option<Estimate> {
    let of_picks = |picks: &[usize]| statistic(&picks.iter().map(|&pick| &units[pick]).collect::<Vec<_>>());
    of_indices(units.len(), &of_picks, plan)
}

/// [`percentile`] of the mean of `values`.
pub fn mean(values: &[f64], plan: Resampling) -> Option<Estimate> {
    of_values(values, summary::mean, plan)
}

/// [`percentile`] of the median of `values`.
pub fn median(values: &[f64], plan: Resampling) -> Option<Estimate> {
    of_values(values, summary::median, plan)
}

fn of_values(values: &[f64], statistic: fn(&[f64]) -> Option<f64>, plan: Resampling) -> Option<Estimate> {
    percentile(values, |picks| statistic(&picks.iter().map(|value| **value).collect::<Vec<_>>()), plan)
}

/// [`percentile`] for a statistic that takes the indices of units.
///
/// Nothing here depends on the type of a unit, so the many instances are made by this crate's optimised code, whoever asks.
pub(super) fn of_indices(
    units: usize,
    statistic: &dyn Fn(&[usize]) -> Option<f64>,
    plan: Resampling,
) -> Option<Estimate> {
    let all: Vec<usize> = (0..units).collect();
    let value = statistic(&all).filter(|_| units > 1)?;
    let values: Vec<f64> = resamples(units, plan).filter_map(|picks| statistic(&picks)).collect();
    let sorted = summary::sorted(&values);
    let tail = (1.0 - plan.level) / 2.0;
    let end = |share: f64| summary::quantile_of_sorted(&sorted, share);
    (!sorted.is_empty()).then(|| Estimate {
        value,
        interval: Interval::new(end(tail), end(1.0 - tail)),
        is_agreed: false,
        units,
        undefined: plan.resamples - sorted.len(),
    })
}

/// The resamples of a plan: indices of the units drawn, with replacement.
pub(super) fn resamples(units: usize, plan: Resampling) -> impl Iterator<Item = Vec<usize>> {
    let mut stream = seed::stream(plan.seed);
    (0..plan.resamples).map(move |_| (0..units).map(|_| stream.random_range(0..units)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLAN: Resampling = Resampling { resamples: 2000, level: 0.95, seed: 17 };

    #[test]
    fn the_interval_of_a_mean_is_near_the_normal_one() {
        let sample: Vec<f64> = (0..200).map(|i| f64::from(i * 37 % 101)).collect();
        let found = mean(&sample, PLAN).unwrap();
        let error = summary::standard_deviation(&sample).unwrap() / 200.0_f64.sqrt();
        let half = 1.96 * error;
        assert!((found.interval.half_width() / half - 1.0).abs() < 0.06, "{found:?} against ±{half}");
        assert!(found.interval.contains(found.value) && found.units == 200 && found.undefined == 0);
        assert_eq!(mean(&sample, PLAN), Some(found), "the same seed gives the same interval");
        assert_ne!(mean(&sample, Resampling { seed: 18, ..PLAN }), Some(found));
    }

    #[test]
    fn units_that_repeat_themselves_inside_say_no_more_for_it() {
        // Ten roadmaps of ten equal queries each: over units the interval is √10 wider than over queries.
        let roadmaps: Vec<[f64; 10]> = (0..10).map(|i| [f64::from(i % 2); 10]).collect();
        let share = |units: &[&[f64; 10]]| Some(units.iter().flat_map(|u| u.iter()).sum::<f64>() / 100.0);
        let wide = percentile(&roadmaps, share, PLAN).unwrap().interval.half_width();
        let queries: Vec<f64> = roadmaps.concat();
        let narrow = mean(&queries, PLAN).unwrap().interval.half_width();
        assert!((wide / narrow - 10.0_f64.sqrt()).abs() < 0.4, "{wide} against {narrow}");
    }

    #[test]
    fn intervals_cover_the_truth_about_as_often_as_they_say() {
        let mut stream = seed::stream(seed::derive(23, &["coverage"]));
        let mut covered = 0;
        for run in 0..400 {
            let sample: Vec<f64> = (0..40).map(|_| stream.random::<f64>()).collect();
            let plan = Resampling { resamples: 400, level: 0.9, seed: run };
            covered += u32::from(mean(&sample, plan).unwrap().interval.contains(0.5));
        }
        assert!((330..=380).contains(&covered), "seed 23: {covered} of 400 at level 0.9");
    }

    #[test]
    fn what_has_no_value_is_counted_and_left_out() {
        let sample = [1.0, 2.0, 3.0];
        let first_if_mixed = |units: &[&f64]| units.iter().any(|u| *u != units[0]).then(|| *units[0]);
        let found = percentile(&sample, first_if_mixed, PLAN).unwrap();
        // All alike in one of nine resamples.
        assert!((150..300).contains(&found.undefined), "{found:?}");
        assert_eq!(mean(&sample[..1], PLAN), None);
        assert_eq!(percentile(&sample, |_| None, PLAN), None);
    }
}
