//! A printed mean of some instances, held against instances of our own.
//!
//! Both sides draw from one distribution if the print describes what we ran. The mean of N of their instances then differs from that of M
//! of ours by a number with the variance σ² (1/N + 1/M); σ is estimated from ours, which are all that is known.

use rand::RngExt as _;

use super::beta::student_multiplier;
use super::bootstrap::{Estimate, Resampling};
use super::summary;
use crate::interval::Interval;
use base::seed;

/// Fewest instances on either side whose mean is taken to be normal; below, a bootstrap stands for the distribution.
pub const FEWEST_NORMAL: usize = 30;

/// The mean of `values`, with the interval in which the mean of `printed_of` more instances lies with probability `plan.level`.
///
/// It is m ± t s √(1/N + 1/M), Student's t with M − 1 degrees of freedom. Where either side has fewer than [`FEWEST_NORMAL`]
/// instances it lies between quantiles of m + √(M/(M − 1)) (the mean of N resampled values − that of M). None below two values, or for
/// no printed instance.
///
/// # Source
/// Hahn & Meeker, *Statistical Intervals* (1991), section 4.8.2.
pub fn predicted_mean(values: &[f64], printed_of: usize, plan: Resampling) -> Option<Estimate> {
    let units = values.len();
    let deviation = summary::standard_deviation(values).filter(|_| printed_of > 0)?;
    let value = summary::mean(values)?;
    let is_agreed = values.iter().all(|other| *other == values[0]);
    let interval = if is_agreed {
        Interval::new(values[0], values[0])
    } else if units.min(printed_of) < FEWEST_NORMAL {
        resampled(values, value, printed_of, plan)
    } else {
        predicted_normal([value, deviation], units, printed_of, plan.level)
    };
    let value = if is_agreed { values[0] } else { value };
    Some(Estimate { value, interval, is_agreed, units, undefined: 0 })
}

/// [`predicted_mean`] from a mean and a standard deviation of `units` instances that are taken to be normal.
pub fn predicted_normal(
    [value, deviation]: [f64; 2],
    units: usize,
    printed_of: usize,
    level: f64,
) -> Interval {
    let error = deviation * (1.0 / printed_of as f64 + 1.0 / units as f64).sqrt();
    let half = student_multiplier(level, (units - 1) as f64) * error;
    Interval::new(value - half, value + half)
}

/// The same where means are not taken to be normal.
fn resampled(values: &[f64], value: f64, printed_of: usize, plan: Resampling) -> Interval {
    let units = values.len();
    let wider = (units as f64 / (units as f64 - 1.0)).sqrt();
    let mut stream = seed::stream(plan.seed);
    let mut mean_of =
        |count: usize| (0..count).map(|_| values[stream.random_range(0..units)]).sum::<f64>() / count as f64;
    let drawn: Vec<f64> =
        (0..plan.resamples).map(|_| value + wider * (mean_of(printed_of) - mean_of(units))).collect();
    let sorted = summary::sorted(&drawn);
    let tail = (1.0 - plan.level) / 2.0;
    let end = |share: f64| summary::quantile_of_sorted(&sorted, share);
    Interval::new(end(tail), end(1.0 - tail))
}

/// Where the mean of all instances lies with probability `level`, from the mean and the standard deviation of `units`, two or more.
pub fn interval_of_mean([value, deviation]: [f64; 2], units: usize, level: f64) -> Interval {
    let half = student_multiplier(level, (units - 1) as f64) * deviation / (units as f64).sqrt();
    Interval::new(value - half, value + half)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::proportion::normal_quantile;
    use base::seed::Stream;

    const PLAN: Resampling = Resampling { resamples: 1000, level: 0.95, seed: 5 };

    fn normal(stream: &mut Stream) -> f64 {
        normal_quantile(stream.random::<f64>().clamp(1e-12, 1.0 - 1e-12))
    }

    #[test]
    fn printed_means_lie_in_their_interval_about_as_often_as_it_says() {
        let mut stream = seed::stream(seed::derive(61, &["means"]));
        for (ours, theirs) in [(500, 500), (2000, 500), (40, 10), (12, 12)] {
            let mut held = 0;
            for run in 0..400 {
                let mut draw = |count| -> Vec<f64> { (0..count).map(|_| normal(&mut stream)).collect() };
                let (own, other) = (draw(ours), draw(theirs));
                let found = predicted_mean(&own, theirs, Resampling { seed: run, ..PLAN }).unwrap();
                held += u32::from(found.interval.contains(summary::mean(&other).unwrap()));
            }
            let least = if ours.min(theirs) < FEWEST_NORMAL { 355 } else { 365 };
            assert!((least..=395).contains(&held), "seed 61: {held} of 400, {theirs} against {ours}");
        }
    }

    #[test]
    fn an_interval_of_a_mean_is_the_formula_and_of_values_that_agree_a_point() {
        let values: Vec<f64> = (0..50).map(f64::from).collect();
        let found = predicted_mean(&values, 100, PLAN).unwrap();
        let half = 2.009_575_237_129_24 * 14.577_379_737_113_25 * (0.01_f64 + 0.02).sqrt();
        assert!((found.interval.half_width() - half).abs() < 1e-9 && found.value == 24.5, "{found:?}");
        let agreed = predicted_mean(&[0.1; 60], 500, PLAN).unwrap();
        assert_eq!((agreed.interval, agreed.is_agreed), (Interval::new(0.1, 0.1), true));
        assert_eq!([predicted_mean(&[1.0], 9, PLAN), predicted_mean(&values, 0, PLAN)], [None, None]);
    }
}
