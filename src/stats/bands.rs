//! Simultaneous bands for the mean of curves, one curve per unit.

use super::{
    bootstrap::{self, Resampling},
    proportion, summary,
};
use crate::interval::Interval;

/// The mean curve with a band that holds all of it at once.
#[derive(Debug, Clone, PartialEq)]
pub struct Band {
    /// Mean over the units, by point.
    pub mean: Vec<f64>,
    /// The band, by point; a point at which no resample moves the mean has no width.
    pub band: Vec<Interval>,
    /// What the pointwise standard errors were multiplied by; about 1.96 for one point at 0.95.
    pub multiplier: f64,
}

/// The sup-t band of the mean of `curves`, each a unit's values at the same points.
///
/// Over resamples of whole curves, the greatest deviation of the mean in standard errors of its point is at
/// most the multiplier with probability `plan.level`. Points of one curve may depend on each other in any way
/// (nested sample sizes). None for fewer than two curves or no resamples.
///
/// # Panics
/// If curves differ in length or a value is not finite.
///
/// # Source
/// Montiel Olea & Plagborg-Møller, "Simultaneous confidence bands", Journal of Applied Econometrics 34 (2019)
/// 1–17, the plug-in sup-t band, with standard errors and critical value from the bootstrap.
pub fn sup_t(curves: &[Vec<f64>], plan: Resampling) -> Option<Band> {
    let points = curves.first()?.len();
    let fits = |curve: &Vec<f64>| curve.len() == points && curve.iter().all(|y| y.is_finite());
    assert!(curves.iter().all(fits), "curves of {points} finite points are wanted");
    let everyone: Vec<usize> = (0..curves.len()).collect();
    let mean = mean_curve(curves, &everyone, points);
    let means: Vec<Vec<f64>> =
        bootstrap::resamples(curves.len(), plan).map(|picks| mean_curve(curves, &picks, points)).collect();
    let errors: Vec<f64> = (0..points)
        .map(|point| summary::standard_deviation(&means.iter().map(|m| m[point]).collect::<Vec<_>>()))
        .collect::<Option<_>>()?;
    let greatest: Vec<f64> = means.iter().map(|drawn| greatest_deviation(drawn, &mean, &errors)).collect();
    let multiplier = summary::quantile_type7(&greatest, plan.level).filter(|_| curves.len() > 1)?;
    let band = mean.iter().zip(&errors).map(|(m, e)| Interval::new(m - multiplier * e, m + multiplier * e));
    Some(Band { band: band.collect(), multiplier, mean })
}

/// [`sup_t`] of curves whose values cannot leave `ends`: where all units have the same value, the band allows for units that differ
/// ([`proportion::agreed_between`]).
///
/// One bound on how many differ serves all such points at once, since a unit that differs at two of them is still one.
pub fn sup_t_between(curves: &[Vec<f64>], ends: [f64; 2], plan: Resampling) -> Option<Band> {
    let mut found = sup_t(curves, plan)?;
    for (point, band) in found.band.iter_mut().enumerate() {
        let values: Vec<f64> = curves.iter().map(|curve| curve[point]).collect();
        if let Some(allowing) = proportion::agreed_between(&values, ends, plan.level) {
            (found.mean[point], *band) = (values[0], allowing);
        }
    }
    Some(found)
}

fn mean_curve(curves: &[Vec<f64>], picks: &[usize], points: usize) -> Vec<f64> {
    let at = |point: usize| picks.iter().map(|&pick| curves[pick][point]).sum::<f64>() / picks.len() as f64;
    (0..points).map(at).collect()
}

fn greatest_deviation(drawn: &[f64], mean: &[f64], errors: &[f64]) -> f64 {
    let in_errors = drawn.iter().zip(mean).zip(errors).filter(|(_, error)| **error > 0.0);
    in_errors.map(|((d, m), error)| (d - m).abs() / error).fold(0.0, f64::max)
}

/// The numbers of `cells` at each place, unit by unit, for as many units as every place has.
pub fn curves_of(cells: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let units = cells.iter().map(Vec::len).min().unwrap_or(0);
    (0..units).map(|unit| cells.iter().map(|cell| cell[unit]).collect()).collect()
}

/// How far the mean of the units' curves is from `target`, as the root of the mean square; none below two units.
pub fn distance_of_mean(
    curves: &[Vec<f64>],
    target: &[f64],
    plan: Resampling,
) -> Option<bootstrap::Estimate> {
    let distance = |units: &[&Vec<f64>]| {
        let mean = |cell: usize| units.iter().map(|unit| unit[cell]).sum::<f64>() / units.len() as f64;
        let squares = target.iter().enumerate().map(|(cell, value)| (mean(cell) - value).powi(2));
        (!units.is_empty()).then(|| (squares.sum::<f64>() / target.len() as f64).sqrt())
    };
    bootstrap::percentile(curves, distance, plan)
}

#[cfg(test)]
mod tests {
    use rand::RngExt as _;

    use super::{super::proportion::normal_quantile, *};
    use base::seed;

    fn plan(seed: u64) -> Resampling {
        Resampling { resamples: 500, level: 0.9, seed }
    }

    /// `units` curves with independent uniform values at each of `points`.
    fn curves(stream: &mut seed::Stream, units: usize, points: usize) -> Vec<Vec<f64>> {
        (0..units).map(|_| (0..points).map(|_| stream.random()).collect()).collect()
    }

    #[test]
    fn bands_hold_the_whole_truth_about_as_often_as_they_say() {
        let mut stream = seed::stream(seed::derive(41, &["bands"]));
        let mut all = 0;
        let mut pointwise = 0;
        for run in 0..300 {
            let found = sup_t(&curves(&mut stream, 60, 8), plan(run)).unwrap();
            all += u32::from(found.band.iter().all(|band| band.contains(0.5)));
            pointwise += u32::from(found.mean.iter().zip(&found.band).all(|(m, band)| {
                (m - 0.5).abs() <= band.half_width() / found.multiplier * normal_quantile(0.95)
            }));
        }
        assert!((250..=287).contains(&all), "seed 41: {all} of 300 at level 0.9");
        assert!(pointwise < 180, "pointwise bands already hold {pointwise} of 300: too easy a sample");
    }

    #[test]
    fn the_multiplier_knows_how_the_points_depend() {
        let mut stream = seed::stream(seed::derive(42, &["bands"]));
        let apart = sup_t(&curves(&mut stream, 400, 10), plan(1)).unwrap().multiplier;
        let one = curves(&mut stream, 400, 1);
        let alike =
            sup_t(&one.iter().map(|c| vec![c[0]; 10]).collect::<Vec<_>>(), plan(1)).unwrap().multiplier;
        // Ten independent points: the 0.9^(1/10) share of each; ten copies of one point: that of one.
        let expected = normal_quantile(f64::midpoint(1.0, libm::pow(0.9, 0.1)));
        assert!((apart - expected).abs() < 0.2, "{apart}, not {expected}");
        assert!((alike - normal_quantile(0.95)).abs() < 0.2, "{alike}");
    }

    #[test]
    fn a_point_at_which_all_agree_allows_for_units_that_differ() {
        let curves: Vec<Vec<f64>> = (0..20).map(|i| vec![100.0, 0.0, 5.0 * f64::from(i), 40.0]).collect();
        let between = sup_t_between(&curves, [-100.0, 100.0], plan(3)).unwrap();
        let bare = sup_t(&curves, plan(3)).unwrap();
        let differ = 1.0 - libm::pow(0.05, 0.05);
        assert_eq!((between.band[2], &between.mean), (bare.band[2], &bare.mean), "a point that moves");
        for (point, low, high) in [
            (0, 100.0 - 200.0 * differ, 100.0),
            (1, -100.0 * differ, 100.0 * differ),
            (3, 40.0 - 140.0 * differ, 40.0 + 60.0 * differ),
        ] {
            let band = between.band[point];
            assert!((band.low - low).abs() < 1e-9 && (band.high - high).abs() < 1e-9, "{point}: {band:?}");
        }
        assert_eq!(sup_t_between(&curves[..1], [0.0, 100.0], plan(3)), None);
    }

    #[test]
    fn a_point_at_which_all_agree_has_no_width() {
        let found = sup_t(&[vec![0.0, 1.0], vec![0.0, 2.0], vec![0.0, 4.0]], plan(2)).unwrap();
        assert_eq!(found.band[0], Interval::new(0.0, 0.0));
        assert!(found.band[1].half_width() > 0.0);
        assert_eq!(sup_t(&[vec![1.0]], plan(2)), None);
        assert_eq!(sup_t(&[], plan(2)), None);
    }
}
