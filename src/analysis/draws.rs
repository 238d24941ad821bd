//! What each independent draw of a problem group says: the unit that intervals rest on.

use super::evidence::Run;
use super::metric::Metric;
use crate::study::key::SweepKey;
use crate::study::record::{Row, Status};
use std::collections::BTreeMap;

/// The share of a draw's posed queries that `contender` solves at `sweep`, in percent, in the order of draws.
///
/// A query that could not be posed is left out; a draw without any other has no share and is left out.
pub fn solved_percents(run: &Run<'_>, group: &str, contender: &str, sweep: &SweepKey) -> Vec<f64> {
    let mut counts: BTreeMap<u32, [u32; 2]> = BTreeMap::new();
    for row in run.rows_at(group, contender, sweep) {
        if row.status != Status::InvalidProblem {
            let [solved, posed] = counts.entry(row.draw()).or_default();
            *posed += 1;
            *solved += u32::from(row.status == Status::Solved);
        }
    }
    counts.values().map(|[solved, posed]| 100.0 * f64::from(*solved) / f64::from(*posed)).collect()
}

/// How many queries of the group can be posed on its first draw, and how many it has.
pub fn posed(run: &Run<'_>, group: &str) -> [usize; 2] {
    let mut queries: BTreeMap<&str, bool> = BTreeMap::new();
    for contender in &run.study.contenders {
        for row in run.rows(group, &contender.label).iter().filter(|row| row.draw() == 0) {
            *queries.entry(row.query()).or_default() |= row.status != Status::InvalidProblem;
        }
    }
    [queries.values().filter(|is_posed| **is_posed).count(), queries.len()]
}

/// By how many points the share that `contender` solves of a group's queries differs from that of the same queries of
/// another group, draw by draw; queries that cannot be posed in either are left out of both.
pub fn differences_percent(
    run: &Run<'_>,
    [base, other]: [&str; 2],
    contender: &str,
    sweep: &SweepKey,
) -> Vec<f64> {
    let status = |group: &str| -> BTreeMap<(u32, String), Status> {
        let rows = run.rows_at(group, contender, sweep).into_iter();
        rows.map(|row| ((row.draw(), row.query().to_owned()), row.status)).collect()
    };
    let (bases, others) = (status(base), status(other));
    let mut draws: BTreeMap<u32, [f64; 2]> = BTreeMap::new();
    for (key, base) in &bases {
        let Some(other) = others.get(key) else { continue };
        if [base, other].iter().all(|status| **status != Status::InvalidProblem) {
            let [difference, posed] = draws.entry(key.0).or_default();
            let solved = |status: &Status| f64::from(u8::from(*status == Status::Solved));
            *difference += solved(other) - solved(base);
            *posed += 1.0;
        }
    }
    draws.values().map(|[difference, posed]| 100.0 * difference / posed).collect()
}

/// Trials of two contenders on the same problem at the same point of the sweeps, solved or not, by draw.
pub fn both<'r>(run: &'r Run<'_>, group: &str, base: &str, other: &str) -> BTreeMap<u32, Vec<[&'r Row; 2]>> {
    let bases: BTreeMap<_, &Row> = run.rows(group, base).into_iter().map(|row| (row.case(), row)).collect();
    let mut pairs: BTreeMap<u32, Vec<[&Row; 2]>> = BTreeMap::new();
    for row in run.rows(group, other) {
        if let Some(base) = bases.get(&row.case()) {
            pairs.entry(row.draw()).or_default().push([base, row]);
        }
    }
    pairs
}

/// Which trials of two contenders are compared.
#[derive(Debug, Clone, Copy)]
pub struct Compared<'a> {
    /// The problem group.
    pub group: &'a str,
    /// The contender that the other is compared with, and the other.
    pub contenders: [&'a str; 2],
    /// One query of each draw; all of them if absent.
    pub query: Option<&'a str>,
    /// Whether a draw counts only if both solve all of its queries.
    pub whole: bool,
}

impl Compared<'_> {
    /// The values of `metric` on the problems that both solve, by draw; a draw without such a problem is left out.
    pub fn values(&self, run: &Run<'_>, metric: &Metric) -> Vec<Vec<(f64, f64)>> {
        let [base, other] = self.contenders;
        let solved = |row: &Row| row.status == Status::Solved;
        let of_draw = |pairs: &Vec<[&Row; 2]>| {
            let asked: Vec<_> =
                pairs.iter().filter(|[a, _]| self.query.is_none_or(|name| a.query() == name)).collect();
            let measured = asked.iter().filter(|[a, b]| solved(a) && solved(b));
            let values: Vec<(f64, f64)> =
                measured.filter_map(|[a, b]| Some((run.value(a, metric)?, run.value(b, metric)?))).collect();
            if self.whole && values.len() < asked.len() { Vec::new() } else { values }
        };
        let all = both(run, self.group, base, other);
        all.values().map(of_draw).filter(|values| !values.is_empty()).collect()
    }

    /// The savings of the other in percent, by draw.
    pub fn savings_percent(&self, run: &Run<'_>, metric: &Metric) -> Vec<Vec<f64>> {
        let saving = |(base, other): &(f64, f64)| 100.0 * (1.0 - other / base);
        self.values(run, metric).iter().map(|draw| draw.iter().map(saving).collect()).collect()
    }
}
