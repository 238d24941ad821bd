//! Statistics, each defined once: of one instance, and of all instances of a selection with their intervals.
//!
//! What was drawn independently is the unit: intervals resample whole instances with all their queries.

use super::censored::{ended, filled};
use super::criterion_result::Narrows;
use super::evidence::Run;
use super::metric::Metric;
use super::number::Number;
use super::selection::{Case, Instance, Selection, by_instance, cases, is_unended, unended};
use super::verdict::{Estimate as VerdictEstimate, Quantity};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
pub use stats::bootstrap::Estimate;
use stats::bootstrap::Resampling;
pub use stats::interval::Interval;
use stats::pooled;
use stats::proportion::{clopper_pearson, mean_of_agreed};
use stats::summary;
pub(super) use stats::summary::{mean, median, quantile_type7 as quantile, standard_deviation};
use std::collections::BTreeMap;
use study::record::Row;

/// Level of every interval.
pub const LEVEL: f64 = 0.95;

/// Fewest instances with which a bootstrap interval decides anything. One end of the percentile interval of a mean of
/// normal instances then lies on the wrong side of the truth with a probability of 4.8 %, not 2.5 %. With 5 instances
/// it is 7.7 %.
pub const FEWEST_INSTANCES: usize = 10;

/// How the interval of an estimate was made, as sentences and captions say it.
pub fn how(is_agreed: bool) -> &'static str {
    if is_agreed { AGREED } else { "bootstrap" }
}

/// What the interval of instances that all agree is.
const AGREED: &str = "all instances agree: what allows for others";

/// The words about the interval of a share, after those of the share.
pub const SHARE_INTERVAL: &str = ", 95 %";

/// The words for intervals where all instances may agree.
pub const INTERVALS: &str = "bootstrap, or where all instances agree what allows for others";

/// How the interval narrows with more instances.
pub fn narrows(is_agreed: bool) -> Narrows {
    if is_agreed { Narrows::AsTheNumber } else { Narrows::AsTheRoot }
}

/// The instances that are needed, where there are fewer.
pub fn needs(instances: usize) -> Option<usize> {
    (instances < FEWEST_INSTANCES).then_some(FEWEST_INSTANCES)
}

/// The number of instances needed before a property that held on all `drawn` ones is firm, if fewer were drawn.
pub fn too_few(drawn: Option<usize>) -> Option<usize> {
    drawn.and_then(needs)
}

/// The meaning of `instances` ties: how many more instances might not tie.
pub fn tied(instances: usize) -> Option<String> {
    let bound = clopper_pearson(0, instances, LEVEL)?;
    Some(format!("every case ties: at most {:.1} % of instances could differ (95 %)", 100.0 * bound.high))
}

/// The bootstrap of every number. All draw the same stream of instances, so that an estimate has one interval wherever it stands,
/// whatever its claim is called.
pub const PLAN: Resampling = Resampling { resamples: 2000, level: LEVEL, seed: 0 };

/// A metric of a trial as medians take it: infinite where the trial failed, `unended` where it did not come to an end.
pub fn or_infinite(run: &Run<'_>, row: &Row, metric: &Metric, unended: Option<f64>) -> Option<f64> {
    match (row.status, run.value(row, metric)) {
        // The clock is read for some seeds only: one that was not timed has not failed.
        (_, None) if metric.is_clock() => None,
        (_, Some(value)) if metric.is_given_by(row) => Some(value),
        (_, _) if is_unended(row) => unended,
        (_, _) => Some(f64::INFINITY),
    }
}

/// What one instance gives.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum InstanceStatistic {
    /// The mean over its solved queries.
    #[default]
    Mean,
    /// The least over its solved queries.
    Least,
    /// The greatest over its solved queries.
    Greatest,
    /// The share of its queries that are solved, in per cent.
    SolvedPercent,
}

impl InstanceStatistic {
    /// Its name in captions, tables and reasons.
    pub fn name(self) -> &'static str {
        match self {
            Self::Mean => "mean",
            Self::Least => "least",
            Self::Greatest => "greatest",
            Self::SolvedPercent => "share solved",
        }
    }

    /// The number that `instance` gives, of the metric or, with another contender, of what is saved against it in per cent.
    pub fn value(self, instance: &Instance<'_>) -> Option<f64> {
        if self == Self::SolvedPercent {
            return instance.percent(|case| case.row.is_solved());
        }
        let number = |case: &Case<'_>| if case.base.is_some() { case.saving_percent() } else { case.value };
        let numbers: Vec<f64> = instance.cases.iter().filter_map(number).collect();
        let folded = |from, of: fn(f64, f64) -> f64| {
            (!numbers.is_empty()).then(|| numbers.iter().copied().fold(from, of))
        };
        match self {
            Self::Least => folded(f64::INFINITY, f64::min),
            Self::Greatest => folded(f64::NEG_INFINITY, f64::max),
            Self::Mean | Self::SolvedPercent => summary::mean(&numbers),
        }
    }
}

/// What all instances of a selection give.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum OverallStatistic {
    /// The mean over all solved cases.
    Mean,
    /// The median over all cases, failures infinite.
    Median,
    /// The number that a quarter of all cases lie below, failures infinite.
    LowerQuartile,
    /// The number that three quarters of all cases lie below, failures infinite.
    UpperQuartile,
    /// The number that 95 % of all cases lie below, failures infinite.
    NinetyFifthPercentile,
    /// The standard deviation over all solved cases.
    Deviation,
    /// By how many per cent the sum over the cases that both solve is below the other contender's.
    ReductionPercent,
    /// The sum over the cases that both solve over the other contender's.
    Ratio,
    /// The mean of the instances' ratios, each of the sums over the cases that both solve; one without a sum to divide by is left out.
    MeanOfRatios,
    /// The median on the first of two problem groups over that on the second.
    RatioOfGroups,
}

impl OverallStatistic {
    /// Its name in captions, tables and reasons.
    pub fn name(self) -> &'static str {
        match self {
            Self::Mean => "mean",
            Self::Median => "median, failures infinite,",
            Self::LowerQuartile => "lower quartile, failures infinite,",
            Self::UpperQuartile => "upper quartile, failures infinite,",
            Self::NinetyFifthPercentile => "95th percentile, failures infinite,",
            Self::Deviation => "standard deviation",
            Self::ReductionPercent => "reduction in % of the mean",
            Self::Ratio => "ratio of the means",
            Self::MeanOfRatios => "mean of the instances' ratios",
            Self::RatioOfGroups => "ratio of the medians on two groups",
        }
    }

    /// Whether it sets two contenders beside each other.
    pub fn is_paired(self) -> bool {
        matches!(self, Self::ReductionPercent | Self::Ratio | Self::MeanOfRatios)
    }

    /// The number that means no difference, if it sets two contenders beside each other.
    pub fn no_difference(self) -> Option<f64> {
        match self {
            Self::ReductionPercent => Some(0.0),
            Self::Ratio | Self::MeanOfRatios | Self::RatioOfGroups => Some(1.0),
            _ => None,
        }
    }

    /// The share of cases that lie below it, if it is a quantile.
    fn quantile(self) -> Option<f64> {
        match self {
            Self::LowerQuartile => Some(0.25),
            Self::Median => Some(0.5),
            Self::UpperQuartile => Some(0.75),
            Self::NinetyFifthPercentile => Some(0.95),
            _ => None,
        }
    }

    /// The number with its bootstrap interval over instances; none below two.
    pub fn estimate(self, instances: &[Instance<'_>]) -> Option<Estimate> {
        if self.is_paired() {
            return self.of_pairs(&super::selection::pairs(instances));
        }
        if self == Self::RatioOfGroups {
            return of_groups(instances);
        }
        let quantile = self.quantile();
        let values = by_instance(instances, |case| match (quantile, case.value) {
            (Some(_), None) if !case.row.is_solved() => Some(f64::INFINITY),
            (_, value) => value,
        });
        let sums = || {
            values.iter().map(|instance| [instance.iter().sum(), instance.len() as f64]).collect::<Vec<_>>()
        };
        match (self, quantile) {
            (_, Some(share)) => pooled::quantile(&values, share, PLAN),
            (Self::Deviation, None) => pooled::deviation(&values, PLAN),
            _ => pooled::ratio_of_sums(&sums(), PLAN),
        }
    }

    /// The intervals that it would have if cases without a number had one that they may have had, the least or the greatest;
    /// empty if all cases have numbers.
    pub fn otherwise(self, selection: &Selection<'_>, instances: &[Instance<'_>]) -> Vec<Interval> {
        if self.is_paired() {
            let pairs = filled(selection, instances).into_iter();
            return pairs.filter_map(|pairs| self.of_pairs(&pairs)).map(|found| found.interval).collect();
        }
        let seen: Vec<f64> = cases(instances).filter_map(|case| case.value).collect();
        if seen.is_empty() || unended(instances) == 0 {
            return Vec::new();
        }
        let far = seen.iter().fold(0.0, |most: f64, value| most.max(value.abs())) * seen.len() as f64;
        let least = seen.iter().copied().fold(0.0, f64::min);
        let middle = summary::mean(&seen).unwrap_or_default();
        let [low, high] = match self {
            Self::Deviation => [[middle; 2], [far; 2]],
            _ if self.quantile().is_some() => [[least; 2], [f64::INFINITY; 2]],
            // What lowers a ratio is a lower first group and a higher second one.
            Self::RatioOfGroups => [[least, f64::INFINITY], [f64::INFINITY, least]],
            _ => [[least; 2], [far; 2]],
        };
        let first = instances[0].group;
        let given = |ends: [f64; 2]| ended(instances, |instance| ends[usize::from(instance.group != first)]);
        let anything = Interval::new(f64::NEG_INFINITY, f64::INFINITY);
        [low, high].map(|ends| self.estimate(&given(ends)).map_or(anything, |found| found.interval)).to_vec()
    }

    /// The statistic of pairs by instance, the other contender's number first. Instances that all have the same ratio
    /// leave an interval with width.
    pub fn of_pairs(self, pairs: &[Vec<(f64, f64)>]) -> Option<Estimate> {
        // In a mean of ratios every instance weighs the same.
        let weighed = |[own, base]: [f64; 2]| match self {
            Self::MeanOfRatios => (base > 0.0).then(|| [own / base, 1.0]),
            _ => Some([own, base]),
        };
        let weighed: Vec<[f64; 2]> = pairs.iter().map(|pairs| sums(pairs)).filter_map(weighed).collect();
        let ratio = pooled::ratio_of_pairs(&weighed, PLAN)?;
        if self != Self::ReductionPercent {
            return Some(ratio);
        }
        let percent = |ratio: f64| 100.0 * (1.0 - ratio);
        let interval = Interval::new(percent(ratio.interval.high), percent(ratio.interval.low));
        Some(Estimate { value: percent(ratio.value), interval, ..ratio })
    }
}

/// The sums of pairs, that of the other contender last.
fn sums(pairs: &[(f64, f64)]) -> [f64; 2] {
    pairs.iter().fold([0.0, 0.0], |[own, base], pair| [own + pair.1, base + pair.0])
}

/// The [ratio](OverallStatistic::Ratio) of pairs without an interval, the other contender's number first; none if its sum is not above 0.
pub fn ratio(pairs: &[(f64, f64)]) -> Option<f64> {
    let [own, base] = sums(pairs);
    (base > 0.0).then(|| own / base)
}

/// The interval of a reduction as that of a change, its sign turned.
pub fn turned(Interval { low, high }: Interval) -> Interval {
    Interval::new(0.0 - high, 0.0 - low)
}

/// The median on the first group over that on the second, the interval from the ends of both; of a single instance the number
/// itself.
fn of_groups(instances: &[Instance<'_>]) -> Option<Estimate> {
    let first = instances.first()?.group;
    let side = |is_first: bool| {
        let own = instances.iter().filter(|instance| (instance.group == first) == is_first);
        let values: Vec<Vec<f64>> = own.map(Instance::values).collect();
        let median = summary::median(&values.concat())?;
        let found = pooled::median(&values, PLAN);
        Some((median, found.map_or(Interval::new(median, median), |found| found.interval)))
    };
    let (above, one) = side(true)?;
    let (below, other) = side(false).filter(|(median, _)| *median > 0.0)?;
    let interval = Interval::new(one.low / other.high, one.high / other.low);
    Some(Estimate { value: above / below, interval, is_agreed: false, units: instances.len(), undefined: 0 })
}

/// By how many points the share solved of an instance's queries differs between two selections; queries that cannot be posed in
/// either are left out of both.
pub fn differences_percent([base, other]: [&[Instance<'_>]; 2]) -> Vec<f64> {
    let solved = |row: &Row| f64::from(u8::from(row.is_solved()));
    let case = |row: &Row| (row.instance(), row.key.repeat, row.query().to_owned());
    let bases: BTreeMap<_, f64> = cases(base).map(|own| (case(own.row), solved(own.row))).collect();
    let mut instances: BTreeMap<(u32, u32), Vec<f64>> = BTreeMap::new();
    for own in cases(other) {
        if let Some(base) = bases.get(&case(own.row)) {
            let unit = (own.row.instance(), own.row.key.repeat);
            instances.entry(unit).or_default().push(100.0 * (solved(own.row) - base));
        }
    }
    instances.values().filter_map(|instance| summary::mean(instance)).collect()
}

/// A share of chances that are hit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Share {
    /// The share.
    pub value: f64,
    /// Its interval; none for a single instance of several chances.
    pub interval: Option<Interval>,
    /// Whether the interval is exact, however few the instances.
    pub is_exact: bool,
    /// Whether all instances agree on it.
    pub is_agreed: bool,
    /// How many instances it rests on.
    pub instances: usize,
}

impl Share {
    /// The share of `counts`, the hits and chances of each instance; none without chances. An instance can have `most` chances, or
    /// as many as were seen. The interval is the same everywhere ([`pooled::share`]). It has a closed form where every instance can
    /// have one chance alone, and where all agree. Differences of shares are not looked at here.
    pub fn new(counts: &[[f64; 2]], most: f64) -> Option<Self> {
        let counts: Vec<[f64; 2]> = counts.iter().copied().filter(|count| count[1] > 0.0).collect();
        let [hits, chances] = counts.iter().fold([0.0, 0.0], |sum, [h, c]| [sum[0] + h, sum[1] + c]);
        let most = counts.iter().fold(most, |most, count| most.max(count[1]));
        let instances = counts.len();
        let is_single = most <= 1.0 && counts.iter().all(|count| count[1] == 1.0);
        let agreed = mean_of_agreed(&counts, most, LEVEL).filter(|_| is_single || instances > 1);
        let interval = if is_single { clopper_pearson(hits as usize, instances, LEVEL) } else { agreed };
        let interval = interval.or_else(|| pooled::share(&counts, most, PLAN).filter(|_| instances > 1));
        let is_agreed = agreed.is_some();
        let is_exact = is_single || is_agreed && (hits == 0.0 || hits == chances);
        (chances > 0.0).then(|| Self { value: hits / chances, interval, is_exact, is_agreed, instances })
    }

    /// `number` with this share of the hits and chances by instance, if there is one.
    pub fn counted(share: Option<Self>, counts: &[[f64; 2]], number: Number) -> Number {
        let [hits, chances] = counts.iter().fold([0.0, 0.0], |sum, [h, c]| [sum[0] + h, sum[1] + c]);
        let Some(Self { value, interval, is_exact, is_agreed, instances }) = share else { return number };
        Number { value: Some(value), interval, is_exact, is_agreed, n: instances, hits, chances, ..number }
    }

    /// The share that `number` is, if it has a value.
    pub fn from_number(number: &Number) -> Option<Self> {
        let &Number { value, interval, is_exact, is_agreed, n, .. } = number;
        Some(Self { value: value?, interval, is_exact, is_agreed, instances: n })
    }

    /// It as our number beside a printed one: the share of `what`.
    pub fn estimate(&self, what: &str) -> VerdictEstimate {
        let bare = VerdictEstimate::bare(self.value, format!("share of {what}"), self.instances);
        let interval = self.interval.map(|interval| [interval.low, interval.high]);
        VerdictEstimate { interval, ..bare }.measures(Quantity::Share, what)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_share_of_single_chances_is_exact_and_instances_of_several_are_units() {
        let exact = Share::new(&[[1.0, 1.0], [0.0, 1.0], [1.0, 1.0], [1.0, 1.0]], 1.0).unwrap();
        let interval = exact.interval.unwrap();
        assert_eq!((exact.value, exact.instances), (0.75, 4));
        assert!((interval.low - 0.1941).abs() < 1e-4 && (interval.high - 0.9937).abs() < 1e-4, "{exact:?}");
        // Instances that agree within themselves: as uncertain as their number says, not as that of their queries.
        let instances: Vec<[f64; 2]> =
            (0..10).map(|i| [if i % 2 == 0 { 100.0 } else { 0.0 }, 100.0]).collect();
        let of_instances = Share::new(&instances, 100.0).unwrap();
        assert!(
            of_instances.value == 0.5 && of_instances.interval.unwrap().half_width() > 0.25,
            "{of_instances:?}"
        );
        let single = Share::new(&[[3.0, 4.0]], 4.0).unwrap();
        assert_eq!((single.value, single.interval), (0.75, None), "one instance has no interval");
        assert!(Share::new(&[[0.0, 0.0]], 1.0).is_none() && Share::new(&[], 1.0).is_none());
    }

    #[test]
    fn instances_that_all_agree_leave_an_interval_with_width() {
        let of = |hits: f64| Share::new(&[[hits, 10.0]; 20], 10.0).unwrap();
        let interval = |hits: f64| of(hits).interval.map(|found| [found.low, found.high]).unwrap();
        assert!((interval(10.0)[0] - 0.831_566_5).abs() < 1e-6 && interval(10.0)[1] == 1.0, "{:?}", of(10.0));
        assert!((interval(0.0)[1] - 0.168_433_5).abs() < 1e-6 && interval(0.0)[0] == 0.0, "{:?}", of(0.0));
        assert!(of(10.0).is_exact && of(0.0).is_exact);
        // Between the ends instances that differ may lie on either side: 0.7 and 0.3 of as much as at the ends.
        let between = interval(7.0);
        let differ = 1.0 - interval(10.0)[0];
        assert!((between[0] - 0.7 + 0.7 * differ).abs() < 1e-12, "{between:?}");
        assert!((between[1] - 0.7 - 0.3 * differ).abs() < 1e-12, "{between:?}");
        assert!(of(7.0).is_agreed && !of(7.0).is_exact, "of fewer than ten instances it is not firm");
    }

    #[test]
    fn failures_are_the_largest_numbers_of_every_quantile() {
        // In the place of the largest of 21 numbers stands a failure: the others keep their quantiles.
        let numbers: Vec<Vec<f64>> =
            (0..21).map(|i| vec![if i == 20 { f64::INFINITY } else { f64::from(i) }]).collect();
        for (statistic, value) in [
            (OverallStatistic::LowerQuartile, 5.0),
            (OverallStatistic::Median, 10.0),
            (OverallStatistic::UpperQuartile, 15.0),
            (OverallStatistic::NinetyFifthPercentile, 19.0),
        ] {
            let share = statistic.quantile().unwrap();
            assert_eq!(pooled::quantile(&numbers, share, PLAN).unwrap().value, value, "{statistic:?}");
            assert_eq!((statistic.is_paired(), statistic.no_difference()), (false, None));
        }
        assert_eq!(OverallStatistic::Deviation.quantile(), None);
    }

    #[test]
    fn a_mean_of_ratios_weighs_every_instance_alike() {
        // Ratios 2, 1/2 and 5/10, of two cases; an instance with nothing to divide by is left out.
        let pairs = [vec![(1.0, 2.0)], vec![(40.0, 20.0)], vec![(4.0, 3.0), (6.0, 2.0)], vec![(0.0, 7.0)]];
        let [of_ratios, of_means] =
            [OverallStatistic::MeanOfRatios, OverallStatistic::Ratio].map(|of| of.of_pairs(&pairs).unwrap());
        assert!((of_ratios.value - 1.0).abs() < 1e-12 && of_ratios.units == 3, "{of_ratios:?}");
        assert!((of_means.value - 34.0 / 51.0).abs() < 1e-12 && of_means.units == 4, "{of_means:?}");
        assert_eq!((of_ratios.interval.low, of_ratios.interval.high), (0.5, 2.0), "{of_ratios:?}");
    }

    #[test]
    fn a_reduction_and_a_ratio_say_the_same() {
        let pairs: Vec<Vec<(f64, f64)>> = (1..20).map(|i| vec![(f64::from(i), 0.5 * f64::from(i))]).collect();
        let [reduction, ratio] = [OverallStatistic::ReductionPercent, OverallStatistic::Ratio]
            .map(|of| of.of_pairs(&pairs).unwrap());
        assert!((reduction.value - 50.0).abs() < 1e-9 && (ratio.value - 0.5).abs() < 1e-9);
        assert!(reduction.interval.low <= reduction.interval.high, "{:?}", reduction.interval);
    }
}
