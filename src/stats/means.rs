//! A printed mean of some instances, and a table of such means, held against instances of our own.
//!
//! Both sides draw from one distribution if the print describes what we ran. The mean of N of their instances then differs from that of M
//! of ours by a number with the variance σ² (1/N + 1/M); σ is estimated from ours, which are all that is known.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};
use rand::RngExt as _;

use super::beta::{f_above, student_multiplier};
use super::bootstrap::{Estimate, Resampling};
use super::summary;
use crate::interval::Interval;
use base::seed;

/// Fewest instances on either side of which a mean is taken to be normal; below, a bootstrap stands for the distribution.
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
        let error = deviation * (1.0 / printed_of as f64 + 1.0 / units as f64).sqrt();
        let half = student_multiplier(plan.level, (units - 1) as f64) * error;
        Interval::new(value - half, value + half)
    };
    let value = if is_agreed { values[0] } else { value };
    Some(Estimate { value, interval, is_agreed, units, undefined: 0 })
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

/// Where the mean of all instances lies with probability `level`, from `values`; none below two.
pub fn interval_of_mean(values: &[f64], level: f64) -> Option<Interval> {
    let deviation = summary::standard_deviation(values)?;
    let half =
        student_multiplier(level, (values.len() - 1) as f64) * deviation / (values.len() as f64).sqrt();
    summary::mean(values).map(|value| Interval::new(value - half, value + half))
}

/// How far a printed mean is from ours, in standard errors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Apart {
    /// The cell.
    pub cell: usize,
    /// The cell that it is taken from, where the difference of two is meant.
    pub from: Option<usize>,
    /// The number of standard errors, above 0 where more is printed.
    pub errors: f64,
}

/// The joint test of printed means that share their instances.
pub struct JointTest {
    /// Our means, by cell.
    pub means: Vec<f64>,
    covariance: DMatrix<f64>,
    root: Cholesky<f64, Dyn>,
    units: usize,
}

impl JointTest {
    /// That of `instances`, the cells of each of ours in one order, against means of `printed_of` instances that are rounded by up to
    /// `rounding` in each cell. None if there are not more instances than cells by [`FEWEST_NORMAL`].
    ///
    /// # Panics
    /// If an instance lacks a cell.
    pub fn new(instances: &[Vec<f64>], printed_of: usize, rounding: &[f64]) -> Option<Self> {
        let (units, cells) = (instances.len(), rounding.len());
        if cells == 0 || printed_of == 0 || units < cells + FEWEST_NORMAL {
            return None;
        }
        let means: Vec<f64> = (0..cells)
            .map(|cell| instances.iter().map(|instance| instance[cell]).sum::<f64>() / units as f64)
            .collect();
        let centred = DMatrix::from_fn(units, cells, |unit, cell| instances[unit][cell] - means[cell]);
        let scale = (1.0 / printed_of as f64 + 1.0 / units as f64) / (units - 1) as f64;
        let rounded = DVector::from_iterator(cells, rounding.iter().map(|half| half * half / 3.0));
        let covariance = centred.tr_mul(&centred) * scale + DMatrix::from_diagonal(&rounded);
        let root = covariance.clone().cholesky()?;
        Some(Self { means, covariance, root, units })
    }

    /// T² of printed means that are `apart` from ours: δᵀ [(1/N + 1/M) S + ρ²/3 I]⁻¹ δ.
    pub fn statistic(&self, apart: &[f64]) -> f64 {
        let apart = DVector::from_column_slice(apart);
        apart.dot(&self.root.solve(&apart))
    }

    /// The probability of a T² as large as this one: that of an F with k and M − k degrees of freedom.
    ///
    /// # Source
    /// Hotelling, "The generalization of Student's ratio", Annals of Mathematical Statistics 2 (1931) 360–378.
    pub fn probability(&self, statistic: f64) -> f64 {
        let (cells, units) = (self.means.len() as f64, self.units as f64);
        f_above(statistic * (units - cells) / (cells * (units - 1.0)), cells, units - cells)
    }

    /// The cells, and the differences of two cells, that are farthest from what is printed; the farthest first.
    pub fn loudest(&self, apart: &[f64], count: usize) -> Vec<Apart> {
        let cells = apart.len();
        let variance = |one: usize, other: usize| self.covariance[(one, other)];
        let alone = (0..cells).map(|cell| Apart {
            cell,
            from: None,
            errors: apart[cell] / variance(cell, cell).sqrt(),
        });
        let pairs = (0..cells).flat_map(|cell| (0..cell).map(move |from| (cell, from)));
        let differences = pairs.map(|(cell, from)| {
            let variance = variance(cell, cell) + variance(from, from) - 2.0 * variance(cell, from);
            Apart { cell, from: Some(from), errors: (apart[cell] - apart[from]) / variance.sqrt() }
        });
        let mut all: Vec<Apart> = alone.chain(differences).collect();
        all.sort_by(|one, other| other.errors.abs().total_cmp(&one.errors.abs()));
        all.truncate(count);
        all
    }
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

    /// Instances of three cells that correlate: two up to 0.99, one of another size.
    fn correlated(stream: &mut Stream, count: usize) -> Vec<Vec<f64>> {
        let one = |_| {
            let shared = normal(stream);
            vec![
                100.0 + 10.0 * shared,
                101.0 + 10.0 * shared + normal(stream),
                1000.0 + 50.0 * shared + 200.0 * normal(stream),
            ]
        };
        (0..count).map(one).collect()
    }

    fn mean_row(instances: &[Vec<f64>]) -> Vec<f64> {
        let mean = |cell: usize| instances.iter().map(|one| one[cell]).sum::<f64>() / instances.len() as f64;
        (0..3).map(mean).collect()
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

    #[test]
    fn a_joint_test_of_correlated_cells_refuses_as_often_as_it_says_and_sees_differences() {
        let mut stream = seed::stream(seed::derive(62, &["means"]));
        let (mut refused, mut seen, mut cells_seen) = (0, 0, 0);
        for _ in 0..400 {
            let theirs = mean_row(&correlated(&mut stream, 100));
            let test = JointTest::new(&correlated(&mut stream, 200), 100, &[0.005; 3]).unwrap();
            let apart: Vec<f64> = theirs.iter().zip(&test.means).map(|(own, mean)| own - mean).collect();
            refused += u32::from(test.probability(test.statistic(&apart)) < 0.05);
            // The second cell less the first is off by half a unit; each cell by itself hides it.
            let shifted = [apart[0], apart[1] + 0.7, apart[2]];
            seen += u32::from(test.probability(test.statistic(&shifted)) < 0.05);
            let loudest = test.loudest(&shifted, 1)[0];
            cells_seen += u32::from((loudest.cell, loudest.from) == (1, Some(0)));
        }
        assert!((8..=36).contains(&refused), "seed 62: {refused} of 400 at 5 %");
        assert!(seen > 380 && cells_seen > 380, "seed 62: {seen} and {cells_seen} of 400");
    }

    #[test]
    fn cells_that_are_equal_on_every_instance_are_apart_by_rounding_alone() {
        let instances: Vec<Vec<f64>> = (0..100).map(|i| vec![f64::from(i); 2]).collect();
        let test = JointTest::new(&instances, 100, &[0.005; 2]).unwrap();
        let p = |apart: [f64; 2]| test.probability(test.statistic(&apart));
        assert!(p([1.0, 1.0]) > 0.9, "{}", p([1.0, 1.0]));
        assert!(p([1.0, 1.004]) > 0.05 && p([1.0, 1.1]) < 1e-6, "{} {}", p([1.0, 1.004]), p([1.0, 1.1]));
        assert!(JointTest::new(&instances[..31], 100, &[0.005; 2]).is_none());
    }
}
