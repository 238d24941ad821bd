//! What a contender changes over groups of problems, with bootstrap intervals over the maps.

use super::evidence::Run;
use super::metric::Metric;
use super::stats::bootstrap::{Estimate, Plan, percentile};
use super::stats::paired::ratio_of_means;
use crate::seed;

/// The mean of a metric over problems that `contender` solved; none below two.
pub fn mean(run: &Run<'_>, groups: &[String], contender: &str, metric: &Metric) -> Option<Estimate> {
    let rows = groups.iter().flat_map(|group| run.rows(group, contender));
    let values: Vec<f64> = rows.filter_map(|row| run.value(row, metric)).collect();
    let mean =
        |units: &[&f64]| (!units.is_empty()).then(|| units.iter().copied().sum::<f64>() / units.len() as f64);
    percentile(&values, mean, plan(run, contender, metric))
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
    let interval = super::interval::Interval::new(percent(ratio.interval.high), percent(ratio.interval.low));
    Some(Estimate { value: percent(ratio.value), interval, ..ratio })
}

fn plan(run: &Run<'_>, contender: &str, metric: &Metric) -> Plan {
    let seed = seed::derive(0, &[&run.study.paper, &run.study.name, contender, metric.name]);
    Plan { resamples: 1000, level: 0.95, seed }
}
