//! What a contender changes over groups of problems, with bootstrap intervals over the maps.

use super::evidence::Run;
use super::metric::Metric;
use crate::study::record::{Row, Status};
use base::seed;
use stats::bootstrap::{self, Estimate, Resampling};
use stats::interval::Interval;
use stats::paired::ratio_of_means;
use std::collections::BTreeMap;

/// The trials of each of `contenders`, in the order of draws, on the problems that all of them solved.
pub fn solved_by_all<'r>(
    run: &'r Run<'_>,
    groups: &[String],
    contenders: &[String],
) -> BTreeMap<String, Vec<&'r Row>> {
    let solved = |contender: &String| {
        let rows = groups.iter().flat_map(|group| run.rows(group, contender));
        rows.filter(|row| row.status == Status::Solved).collect::<Vec<_>>()
    };
    let all: Vec<(String, Vec<&Row>)> =
        contenders.iter().map(|contender| (contender.clone(), solved(contender))).collect();
    let mut counts: BTreeMap<_, usize> = BTreeMap::new();
    for row in all.iter().flat_map(|(_, rows)| rows) {
        *counts.entry(row.case()).or_default() += 1;
    }
    let common = |rows: Vec<&'r Row>| {
        rows.into_iter().filter(|row| counts[&row.case()] == contenders.len()).collect::<Vec<_>>()
    };
    all.into_iter().map(|(contender, rows)| (contender, common(rows))).collect()
}

/// The mean of a metric over `rows` of one contender; none below two.
pub fn mean(run: &Run<'_>, rows: &[&Row], contender: &str, metric: &Metric) -> Option<Estimate> {
    let values: Vec<f64> = rows.iter().filter_map(|row| run.value(row, metric)).collect();
    bootstrap::mean(&values, plan(run, contender, metric))
}

/// The reduction of the mean of a metric from `against` to `contender` in per cent, over problems that both solved;
/// none below two.
pub fn reduction_percent(
    run: &Run<'_>,
    groups: &[String],
    [contender, against]: [&str; 2],
    metric: &Metric,
) -> Option<Estimate> {
    let pairs = groups.iter().flat_map(|group| run.pairs(group, against, contender));
    let values = pairs.filter_map(|pair| run.value(pair.base, metric).zip(run.value(pair.other, metric)));
    let ratio = ratio_of_means(&values.collect::<Vec<_>>(), plan(run, contender, metric))?;
    let percent = |ratio: f64| 100.0 * (1.0 - ratio);
    let interval = Interval::new(percent(ratio.interval.high), percent(ratio.interval.low));
    Some(Estimate { value: percent(ratio.value), interval, ..ratio })
}

fn plan(run: &Run<'_>, contender: &str, metric: &Metric) -> Resampling {
    let seed = seed::derive(0, &[&run.study.paper, &run.study.name, contender, metric.name]);
    Resampling { resamples: 1000, level: 0.95, seed }
}
