//! Statistics of instances that figures show, so that a figure only draws them.

use super::evidence::Evidence;
use super::selection::{Case, Selection, by_instance, cases};
use super::statistic::{
    Estimate, InstanceStatistic, Interval, LEVEL, OverallStatistic, PLAN, differences_percent,
};
use stats::bands::{curves_of, distance_of_mean, sup_t_between};
use stats::summary::means_along;
use stats::{pooled, proportion, summary};
use std::collections::BTreeMap;
use study::record::Row;

/// The share of queries that are solved on each instance, in per cent.
pub fn solved_percents(selection: &Selection<'_>, evidence: &Evidence<'_>) -> Vec<f64> {
    selection
        .instances(evidence)
        .iter()
        .filter_map(|instance| InstanceStatistic::SolvedPercent.value(instance))
        .collect()
}

/// The mean over instances of the share solved, in per cent; none below two instances.
pub fn mean_solved(selection: &Selection<'_>, evidence: &Evidence<'_>) -> Option<Estimate> {
    pooled::mean_between(&solved_percents(selection, evidence), [0.0, 100.0], PLAN)
}

/// The mean over instances of the difference between the share solved and that of `base`, in percentage points; none
/// below two instances.
pub fn mean_difference([base, selection]: [&Selection<'_>; 2], evidence: &Evidence<'_>) -> Option<Estimate> {
    let [base, own] = [base, selection].map(|one| one.instances(evidence));
    pooled::mean_between(&differences_percent([&base, &own]), [-100.0, 100.0], PLAN)
}

/// What all instances of a selection give.
pub fn of_all(all: OverallStatistic, selection: &Selection<'_>, evidence: &Evidence<'_>) -> Option<Estimate> {
    all.estimate(&selection.instances(evidence))
}

/// The point whose coordinates are the medians of those of `points`; failures may be infinite.
pub fn median_point(points: &[[f64; 2]]) -> Option<[f64; 2]> {
    let median = |axis: usize| summary::median(&points.iter().map(|point| point[axis]).collect::<Vec<_>>());
    Some([median(0)?, median(1)?])
}

/// What each instance of a selection saves against the other contender, in per cent, and the median over instances.
#[derive(Default)]
pub struct Savings {
    /// The last saving of each instance that has one.
    pub by_instance: BTreeMap<u32, f64>,
    /// Their median.
    pub median: Option<f64>,
}

impl Savings {
    /// The savings of `selection`.
    pub fn new(selection: &Selection<'_>, evidence: &Evidence<'_>) -> Self {
        let instances = selection.instances(evidence);
        let saved = |case: &Case<'_>| Some((case.row.instance(), case.saving_percent()?));
        let by_instance: BTreeMap<u32, f64> = cases(&instances).filter_map(saved).collect();
        let median = summary::median(&by_instance.values().copied().collect::<Vec<_>>());
        Self { by_instance, median }
    }

    /// How far an instance's saving is from the median; infinite without either.
    pub fn off_median(&self, instance: u32) -> f64 {
        let both = self.median.zip(self.by_instance.get(&instance));
        both.map_or(f64::INFINITY, |(median, saving)| (saving - median).abs())
    }

    /// An instance's saving and its rank among all; none if the instance has no saving.
    pub fn rank(&self, instance: u32) -> Option<(f64, proportion::Rank)> {
        let own = *self.by_instance.get(&instance)?;
        Some((own, proportion::Rank::new(own, &self.by_instance.values().copied().collect::<Vec<_>>())))
    }
}

/// Numbers as a box shows them, and as a table does.
#[derive(Default)]
pub struct Spread {
    /// The numbers.
    pub values: Vec<f64>,
    /// Their mean.
    pub mean: Option<f64>,
    /// The ends of the whiskers (5 and 95 %), quartiles and median.
    pub quantiles: Option<[f64; 5]>,
}

impl Spread {
    /// The distribution of `values`.
    pub fn new(values: Vec<f64>) -> Self {
        let quantiles = (!values.is_empty()).then(|| summary::box_of(&values));
        Self { mean: summary::mean(&values), quantiles, values }
    }

    /// The median.
    pub fn median(&self) -> Option<f64> {
        self.quantiles.map(|quantiles| quantiles[2])
    }

    /// The least and the greatest.
    pub fn ends(&self) -> Option<[f64; 2]> {
        let [low, high] = [0.0, 1.0].map(|share| summary::quantile_type7(&self.values, share));
        Some([low?, high?])
    }
}

/// By query, in the order of the records: of each contender the metric over the instances on which all of them solve the query.
pub fn spreads_by_query(selection: &Selection<'_>, evidence: &Evidence<'_>) -> Vec<(String, Vec<Spread>)> {
    by_query(selection, evidence, |own| {
        let instances = own.instances(evidence);
        let values =
            |label: &String| instances.iter().flat_map(|instance| instance.by(label).values()).collect();
        own.contenders.iter().map(|label| Spread::new(values(label))).collect()
    })
}

/// By query, and then over all queries: what the last contender saves, in per cent.
pub fn savings_by_query(selection: &Selection<'_>, evidence: &Evidence<'_>) -> Vec<(String, Spread)> {
    let Some(last) = selection.contenders.last() else { return Vec::new() };
    let mut savings = by_query(selection, evidence, |own| {
        let instances = own.instances(evidence);
        let by_last = cases(&instances).filter(|case| case.is_by(last));
        Spread::new(by_last.filter_map(Case::saving_percent).collect())
    });
    let all = savings.iter().flat_map(|(_, saving)| saving.values.iter().copied()).collect();
    savings.push(("all".to_owned(), Spread::new(all)));
    savings
}

fn by_query<T>(
    selection: &Selection<'_>,
    evidence: &Evidence<'_>,
    take: impl Fn(&Selection<'_>) -> T,
) -> Vec<(String, T)> {
    let instances = Selection { whole_instances: false, ..selection.clone() }.instances(evidence);
    let mut order: Vec<&str> = Vec::new();
    for case in
        selection.contenders.iter().flat_map(|label| cases(&instances).filter(|case| case.is_by(label)))
    {
        if !order.contains(&case.row.query()) {
            order.push(case.row.query());
        }
    }
    let of_query = |name: &&str| {
        let query = Some((*name).to_owned());
        ((*name).to_owned(), take(&Selection { query: query.map(|query| vec![query]), ..selection.clone() }))
    };
    order.iter().map(of_query).collect()
}

/// Below which number each share of some instances lies.
pub struct Distribution {
    /// The curve.
    pub steps: Vec<[f64; 2]>,
    /// Between which numbers all but the outermost hundredth on either side lie.
    pub bulk: Vec<f64>,
}

impl Distribution {
    /// The summary of `values`.
    pub fn new(values: &[f64]) -> Self {
        let bulk = [0.01, 0.99].iter().filter_map(|share| summary::quantile_type7(values, *share));
        Self { steps: summary::cumulative(values), bulk: bulk.collect() }
    }
}

/// One curve an instance, at the same places.
pub struct Curves {
    /// The curves.
    pub instances: Vec<Vec<f64>>,
}

/// The mean of curves with a band that holds all of it at once.
pub struct Band {
    /// The mean at each place.
    pub mean: Vec<f64>,
    /// The band there, within 0 and 100.
    pub band: Vec<[f64; 2]>,
}

impl Curves {
    /// Those of the shares solved, one selection a place, for as many instances as every place has.
    pub fn solved(places: &[Selection<'_>], evidence: &Evidence<'_>) -> Self {
        let shares: Vec<Vec<f64>> = places.iter().map(|place| solved_percents(place, evidence)).collect();
        Self { instances: curves_of(&shares) }
    }

    /// Their mean with a simultaneous band; none below two instances.
    pub fn band(&self) -> Option<Band> {
        let found = sup_t_between(&self.instances, [0.0, 100.0], PLAN)?;
        let band = found.band.iter().map(|band| [band.low.max(0.0), band.high.min(100.0)]).collect();
        Some(Band { mean: found.mean, band })
    }

    /// Where one more instance would lie with 95 % probability at each place, as the claims of the printed cells say it; none if
    /// there are too few instances to say.
    pub fn one_more(&self) -> Option<Vec<Interval>> {
        let places = 0..self.instances.first()?.len();
        places.map(|place| proportion::predictive(&self.at(place), LEVEL)).collect()
    }

    /// The mean at each place.
    pub fn means(&self) -> Vec<f64> {
        let places = 0..self.instances.first().map_or(0, Vec::len);
        places.filter_map(|place| summary::mean(&self.at(place))).collect()
    }

    /// How far their mean is from a printed row, as the root of the mean square; none below two instances.
    pub fn distance(&self, printed: &[f64]) -> Option<Estimate> {
        distance_of_mean(&self.instances, printed, PLAN)
    }

    fn at(&self, place: usize) -> Vec<f64> {
        self.instances.iter().map(|instance| instance[place]).collect()
    }
}

/// Of each case of one contender where it stands and its number, or its ratio to the other contender's, where these are above 0.
pub fn numbers_along(
    selection: &Selection<'_>,
    evidence: &Evidence<'_>,
    place: impl Fn(&Row) -> Option<f64>,
) -> Vec<[f64; 2]> {
    let point = |case: &Case<'_>| {
        let value = case.value.filter(|value| *value > 0.0)?;
        let ratio = || Some(value / case.base_value.filter(|base| *base > 0.0)?);
        Some([place(case.row)?, if case.base.is_some() { ratio()? } else { value }])
    };
    by_instance(&selection.instances(evidence), point).concat()
}

/// The geometric mean of the second numbers that go with each first.
pub fn geometric_means(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let logs: Vec<[f64; 2]> = points.iter().map(|[x, y]| [*x, libm::log(*y)]).collect();
    means_along(&logs).into_iter().map(|[x, y]| [x, libm::exp(y)]).collect()
}

/// The costs found in the course of one trial: when, in seconds, and at what cost.
pub type CostHistory = Vec<[f64; 2]>;

/// The least cost of what was found at `passed_s` or before; infinite if nothing was.
fn best_by(found: &CostHistory, passed_s: f64) -> f64 {
    let by_then = found.iter().filter(|[at, _]| *at <= passed_s).map(|[_, cost]| *cost);
    by_then.fold(f64::INFINITY, f64::min)
}

/// The median of the best cost found by each moment, over the queries of all instances; none where it is infinite.
pub fn best_over_time(instances: &[Vec<CostHistory>], moments: &[f64]) -> Vec<Option<Estimate>> {
    let at = |passed_s: &f64| {
        let by = |found: &CostHistory| best_by(found, *passed_s);
        let costs: Vec<Vec<f64>> =
            instances.iter().map(|instance| instance.iter().map(by).collect()).collect();
        pooled::median(&costs, PLAN).filter(|estimate| estimate.value.is_finite())
    };
    moments.iter().map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_more_instance_lies_between_instances_and_nowhere_if_there_are_too_few() {
        let curves = |count: u32| Curves {
            instances: (0..count).map(|instance| vec![f64::from(instance), 7.0]).collect(),
        };
        assert_eq!(curves(200).one_more(), Some(vec![Interval::new(4.0, 195.0), Interval::new(7.0, 7.0)]));
        assert_eq!(curves(38).one_more(), None);
        assert_eq!(curves(0).one_more(), None);
    }

    #[test]
    fn a_query_without_a_path_by_then_costs_infinitely_much() {
        let found = vec![[0.2, 9.0], [0.5, 4.0], [0.7, 5.0]];
        let by = [0.1, 0.2, 0.6, 0.9].map(|passed_s| best_by(&found, passed_s));
        assert_eq!(by, [f64::INFINITY, 9.0, 4.0, 4.0]);
    }

    #[test]
    fn a_curve_begins_where_half_of_the_queries_have_a_path_and_never_rises() {
        let instance = |at: f64| vec![vec![[at, 10.0], [at + 0.3, 8.0]]];
        let instances: Vec<_> = [0.1, 0.2, 0.3, 9.0, 9.0].map(instance).into();
        let moments = [0.15, 0.25, 0.35, 0.45, 0.65];
        let found = best_over_time(&instances, &moments);
        let values: Vec<Option<f64>> = found.iter().map(|median| median.map(|m| m.value)).collect();
        assert_eq!(values, [None, None, Some(10.0), Some(10.0), Some(8.0)]);
        assert!(found[2].unwrap().interval.high.is_infinite(), "two of five never find a path");
    }
}
