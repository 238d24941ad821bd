//! Statistics of all that was measured on instances of several cases each, with intervals over whole instances.

use rand::RngExt as _;

use super::bootstrap::{self, Estimate, Resampling};
use super::interval::Interval;
use super::summary::quantile_type7;
use super::{proportion, summary};
use base::seed;

/// The sum of the first numbers over the sum of the second, one pair an instance: a ratio of means, a share, a mean over cases.
///
/// None below two instances, or where the second sum is not positive.
pub fn ratio_of_sums(instances: &[[f64; 2]], plan: Resampling) -> Option<Estimate> {
    let ratio = |picks: &[usize]| {
        let sum = |sum: (f64, f64), pick: &usize| (sum.0 + instances[*pick][0], sum.1 + instances[*pick][1]);
        let (above, below) = picks.iter().fold((0.0, 0.0), sum);
        (below > 0.0).then(|| above / below)
    };
    bootstrap::of_indices(instances.len(), &ratio, plan)
}

/// The interval of a share from `instances` of hits and chances, whatever they are drawn from. It is that of the instances with
/// one more, a hit throughout at the upper end and a miss throughout at the lower, all weighted at random. None without
/// instances.
///
/// The weights are exponential, so that their shares are spacings of uniform numbers. Where every instance has one chance this is
/// Clopper and Pearson's interval, and where all agree [`proportion::mean_of_agreed`], but for what `resamples` leave to chance:
/// the fewer hits, the lower either end. The instance that is added has the `most` chances that an instance can have, or that one has. That
/// the bounds hold whatever is drawn is proved for the closed forms and a conjecture else; no counterexample is known.
///
/// # Source
/// Gaffke, Mathematical Methods of Statistics 14 (2005) 451–467; Learned-Miller & Thomas, arXiv:1905.06208 (2019).
pub fn share(instances: &[[f64; 2]], most: f64, plan: Resampling) -> Option<Interval> {
    let most = instances.iter().fold(most, |most: f64, [_, chances]| most.max(*chances));
    let mut stream = seed::stream(plan.seed);
    let weighted = |_| {
        let mut weight = || -libm::log1p(-stream.random::<f64>());
        let [hits, chances] = instances.iter().fold([0.0, 0.0], |sum, instance| {
            let weight = weight();
            [sum[0] + weight * instance[0], sum[1] + weight * instance[1]]
        });
        let more = weight() * most;
        (hits / (chances + more), (hits + more) / (chances + more))
    };
    let (lows, highs): (Vec<f64>, Vec<f64>) = (0..plan.resamples).map(weighted).unzip();
    let tail = (1.0 - plan.level) / 2.0;
    (instances.iter().any(|[_, chances]| *chances > 0.0))
        .then(|| Some(Interval::new(quantile_type7(&lows, tail)?, quantile_type7(&highs, 1.0 - tail)?)))
        .flatten()
}

/// [`ratio_of_sums`] of two contenders' numbers: where every instance has the same ratio, the interval allows for instances that differ
/// ([`proportion::ratio_of_agreed`]).
pub fn ratio_of_pairs(instances: &[[f64; 2]], plan: Resampling) -> Option<Estimate> {
    let Some(interval) = proportion::ratio_of_agreed(instances, plan.level) else {
        return ratio_of_sums(instances, plan);
    };
    let [above, below] = instances.iter().fold([0.0, 0.0], |sum, [a, b]| [sum[0] + a, sum[1] + b]);
    Some(Estimate { value: above / below, interval, is_agreed: true, units: instances.len(), undefined: 0 })
}

/// The mean of one number an instance that cannot leave `[least, most]`: where all agree, the interval allows for instances that differ by
/// as much as the ends let them ([`proportion::agreed_between`]). None below two instances.
pub fn mean_between(values: &[f64], ends: [f64; 2], plan: Resampling) -> Option<Estimate> {
    let found = bootstrap::mean(values, plan)?;
    Some(match proportion::agreed_between(values, ends, plan.level) {
        Some(interval) => Estimate { value: values[0], interval, is_agreed: true, ..found },
        None => found,
    })
}

/// The median of all numbers of all instances; failures may be infinite. None below two instances.
///
/// # Panics
/// If a number is NaN.
pub fn median(instances: &[Vec<f64>], plan: Resampling) -> Option<Estimate> {
    quantile(instances, 0.5, plan)
}

/// The number that a `share` of all numbers of all instances lie below; failures may be infinite. None below two instances.
///
/// # Panics
/// If a number is NaN.
pub fn quantile(instances: &[Vec<f64>], share: f64, plan: Resampling) -> Option<Estimate> {
    of_all(instances, |all| quantile_type7(all, share), plan)
}

/// The standard deviation of all numbers of all instances. None below two instances.
///
/// # Panics
/// If a number is NaN.
pub fn deviation(instances: &[Vec<f64>], plan: Resampling) -> Option<Estimate> {
    of_all(instances, summary::standard_deviation, plan)
}

fn of_all(instances: &[Vec<f64>], of: impl Fn(&[f64]) -> Option<f64>, plan: Resampling) -> Option<Estimate> {
    let all = |instances: &[&Vec<f64>]| {
        let numbers: Vec<f64> = instances.iter().flat_map(|instance| instance.iter().copied()).collect();
        of(&numbers)
    };
    bootstrap::percentile(instances, all, plan)
}

/// The slope of the least-squares line through all `(place, number)` of all instances. None below two instances, or if all lie at
/// one place.
pub fn slope(instances: &[Vec<(f64, f64)>], plan: Resampling) -> Option<Estimate> {
    let of = |instances: &[&Vec<(f64, f64)>]| {
        let points = || instances.iter().flat_map(|instance| instance.iter());
        let sums = points().fold((0.0, 0.0, 0.0), |sum, (x, y)| (sum.0 + 1.0, sum.1 + x, sum.2 + y));
        let (mean_x, mean_y) = (sums.1 / sums.0, sums.2 / sums.0);
        let (spread, joint) = points().fold((0.0, 0.0), |sum, (x, y)| {
            (sum.0 + (x - mean_x) * (x - mean_x), sum.1 + (x - mean_x) * (y - mean_y))
        });
        (spread > 0.0).then(|| joint / spread)
    };
    bootstrap::percentile(instances, of, plan)
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
    fn a_share_is_clopper_and_pearsons_where_instances_have_one_chance() {
        let plan = Resampling { resamples: 20_000, ..PLAN };
        let near = |found: Interval, exact: Interval| {
            (found.low - exact.low).abs() < 0.006 && (found.high - exact.high).abs() < 0.006
        };
        for hits in [0, 1, 7, 29, 30] {
            let instances: Vec<[f64; 2]> =
                (0..30).map(|instance| [f64::from(u8::from(instance < hits)), 1.0]).collect();
            let found = share(&instances, 1.0, plan).unwrap();
            let exact = proportion::clopper_pearson(hits, 30, PLAN.level).unwrap();
            assert!(near(found, exact), "{hits} of 30: {found:?}, not {exact:?}");
        }
        let agreed = [[3.0, 4.0]; 12];
        assert!(near(
            share(&agreed, 4.0, plan).unwrap(),
            proportion::mean_of_agreed(&agreed, 4.0, PLAN.level).unwrap()
        ));
        // One hit more never lowers an end: a bootstrap's upper end falls from 0.12 to 0.01 with the first.
        let instances = |hits: f64| [vec![[hits, 30.0]], vec![[0.0, 30.0]; 29]].concat();
        let ends: Vec<Interval> =
            [0.0, 1.0, 2.0, 30.0].map(|hits| share(&instances(hits), 30.0, PLAN).unwrap()).to_vec();
        assert!(ends.is_sorted_by(|a, b| a.low <= b.low && a.high <= b.high), "{ends:?}");
        assert!(ends[0].low == 0.0 && (ends[1].high - ends[0].high) < 0.02, "{ends:?}");
        assert_eq!(share(&[], 1.0, PLAN), None);
        assert_eq!(share(&[[0.0, 0.0]], 1.0, PLAN), None);
    }

    #[test]
    fn pairs_of_one_ratio_and_numbers_that_agree_allow_for_others() {
        let pairs: Vec<[f64; 2]> = (0..20).map(|_| [1.0, 2.0]).collect();
        let found = ratio_of_pairs(&pairs, PLAN).unwrap();
        let differ = 1.0 - libm::pow(0.025, 0.05);
        assert!(found.is_agreed && found.units == 20 && found.value == 0.5, "{found:?}");
        assert!((found.interval.half_width() - differ).abs() < 1e-12, "{found:?}");
        let apart = [&pairs[1..], &[[1.5, 2.0]]].concat();
        assert_eq!(ratio_of_pairs(&apart, PLAN), ratio_of_sums(&apart, PLAN));
        let all = mean_between(&[100.0; 20], [0.0, 100.0], PLAN).unwrap();
        assert!(all.is_agreed && all.interval.high == 100.0, "{all:?}");
        assert!((all.interval.low - 100.0 * (1.0 - differ)).abs() < 1e-9, "{all:?}");
        assert_eq!(mean_between(&[1.0, 2.0], [0.0, 9.0], PLAN), bootstrap::mean(&[1.0, 2.0], PLAN));
        assert_eq!(mean_between(&[1.0], [0.0, 9.0], PLAN), None);
    }

    #[test]
    fn instances_that_agree_within_themselves_count_as_one_number_each() {
        let instances: Vec<Vec<f64>> = (0..10).map(|instance| vec![f64::from(instance); 100]).collect();
        let of_instances = median(&instances, PLAN).unwrap();
        let cases: Vec<Vec<f64>> = instances.iter().flatten().map(|number| vec![*number]).collect();
        let of_cases = median(&cases, PLAN).unwrap();
        assert_eq!((of_instances.value, of_cases.value), (4.5, 4.5));
        assert!(
            of_instances.interval.half_width() > 3.0 * of_cases.interval.half_width(),
            "{of_instances:?}"
        );
        let spread = deviation(&instances, PLAN).unwrap();
        assert!((spread.value - 2.874).abs() < 1e-3, "{spread:?}");
    }

    #[test]
    fn the_slope_of_points_on_a_line_is_the_lines() {
        let instances: Vec<Vec<(f64, f64)>> =
            (0..5).map(f64::from).map(|x| vec![(x, 3.0 - 0.5 * x), (x + 9.0, -1.5 - 0.5 * x)]).collect();
        let found = slope(&instances, PLAN).unwrap();
        assert!((found.value + 0.5).abs() < 1e-12 && found.interval.half_width() < 1e-12, "{found:?}");
        assert_eq!(slope(&[vec![(1.0, 2.0)], vec![(1.0, 3.0)]], PLAN), None);
    }
}
