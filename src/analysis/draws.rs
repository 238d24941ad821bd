//! What each independent draw of a problem group says: the unit that intervals rest on.

use super::evidence::Run;
use super::metric::Metric;
use crate::study::record::{Row, Status};
use std::collections::BTreeMap;

/// The share of a draw's posed queries that `contender` solves at `sweep`, in percent, in the order of draws.
///
/// A query that could not be posed is left out; a draw without any other has no share and is left out.
pub fn solved_percents(run: &Run<'_>, group: &str, contender: &str, sweep: &str) -> Vec<f64> {
    let mut counts: BTreeMap<u32, [u32; 2]> = BTreeMap::new();
    for row in run.rows(group, contender) {
        if row.sweep == sweep && row.status != Status::InvalidProblem {
            let [solved, posed] = counts.entry(row.replicate).or_default();
            *posed += 1;
            *solved += u32::from(row.status == Status::Solved);
        }
    }
    counts.values().map(|[solved, posed]| 100.0 * f64::from(*solved) / f64::from(*posed)).collect()
}

/// Trials of two contenders on the same problem at the same point of the sweeps, solved or not, by draw.
pub fn both<'r>(run: &'r Run<'_>, group: &str, base: &str, other: &str) -> BTreeMap<u32, Vec<[&'r Row; 2]>> {
    let key = |row: &Row| (row.problem.clone(), row.sweep.clone(), row.repeat);
    let bases: BTreeMap<_, &Row> = run.rows(group, base).into_iter().map(|row| (key(row), row)).collect();
    let mut pairs: BTreeMap<u32, Vec<[&Row; 2]>> = BTreeMap::new();
    for row in run.rows(group, other) {
        if let Some(base) = bases.get(&key(row)) {
            pairs.entry(row.replicate).or_default().push([base, row]);
        }
    }
    pairs
}

/// The values of `metric` of two contenders on the problems that both solve, by draw; a draw without such a problem is left
/// out.
pub fn values(run: &Run<'_>, group: &str, base: &str, other: &str, metric: &Metric) -> Vec<Vec<(f64, f64)>> {
    let solved = |row: &Row| row.status == Status::Solved;
    let of_draw = |pairs: &Vec<[&Row; 2]>| {
        let measured = pairs.iter().filter(|[a, b]| solved(a) && solved(b));
        measured.filter_map(|[a, b]| Some((run.value(a, metric)?, run.value(b, metric)?))).collect::<Vec<_>>()
    };
    let all = both(run, group, base, other);
    all.values().map(of_draw).filter(|values| !values.is_empty()).collect()
}
