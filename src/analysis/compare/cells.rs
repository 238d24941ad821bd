//! Results of trials, cell by cell: one contender on one problem group at one point of the sweeps under one
//! interpretation.

use super::change::Measured;
use super::pair::Unit;
use super::run::{Seen, StoredRun};
use crate::analysis::metric::{METRICS, Metric};
use crate::analysis::statistic::PLAN;
use serde::Serialize;
use stats::{pooled, summary};
use std::collections::BTreeMap;
use study::key::{InterpretationKey, SweepKey};
use study::name;
use study::record::{Row, Status};

/// One metric of one cell.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Cell {
    /// The study.
    pub study: String,
    /// The interpretation: the options that differ from the defaults.
    pub interpretation: String,
    /// The problem group.
    pub group: String,
    /// The contender.
    pub contender: String,
    /// The point of the sweeps; empty without sweeps.
    pub sweep: String,
    /// The metric.
    pub metric: String,
    /// Its unit; empty for counts.
    pub unit: String,
    /// Trials, without those whose problem could not be posed.
    pub trials: usize,
    /// Those that are solved.
    pub solved: usize,
    /// What was drawn independently among them.
    pub instances: usize,
    /// Solved trials in which the metric was measured.
    pub measured: usize,
    /// The mean over these trials.
    pub mean: Option<Measured>,
    /// The median over all trials, failures infinite; `None` if it was not measured in a solved trial.
    pub median: Option<Measured>,
}

/// What every contender's trials of a run come to, study by study.
pub fn cells(run: &StoredRun) -> Vec<Cell> {
    run.studies.iter().flat_map(|(study, stored)| of_study(study, &Seen::new(stored))).collect()
}

/// The cells of one study, in the order of interpretations, groups, contenders, sweep points and metrics.
fn of_study(study: &str, seen: &Seen<'_>) -> Vec<Cell> {
    let mut cells: BTreeMap<(&InterpretationKey, &str, &str, &SweepKey), Vec<&Row>> = BTreeMap::new();
    for row in seen.rows.values().flatten().filter(|row| row.status != Status::InvalidProblem) {
        let on = &row.key.on;
        cells
            .entry((&on.interpretation, &on.group, &row.key.contender, &row.key.sweep))
            .or_default()
            .push(row);
    }
    let mut found = Vec::new();
    for rows in cells.values() {
        found.extend(METRICS.iter().filter_map(|metric| cell(study, seen, rows, metric)));
    }
    found
}

/// One metric of the trials `rows` of one cell, if any has it.
fn cell(study: &str, seen: &Seen<'_>, rows: &[&Row], metric: &'static Metric) -> Option<Cell> {
    let read = metric.reader(|row| seen.times.get(&row.key).copied());
    let solved = rows.iter().filter(|row| row.status == Status::Solved).count();
    let mut units: BTreeMap<Unit<'_>, (Vec<f64>, usize)> = BTreeMap::new();
    for row in rows {
        let (values, failed) = units.entry(seen.instances.unit(row)).or_default();
        match row.status {
            Status::Solved => values.extend(read(row)),
            _ => *failed += 1,
        }
    }
    let key = &rows.first()?.key;
    let values: Vec<Vec<f64>> =
        units.values().map(|(values, _)| values.clone()).filter(|v| !v.is_empty()).collect();
    let all = values.concat();
    let sums: Vec<[f64; 2]> = values.iter().map(|unit| [unit.iter().sum(), unit.len() as f64]).collect();
    (!all.is_empty()).then(|| Cell {
        study: study.to_owned(),
        interpretation: seen.names.interpretation(&key.on.interpretation),
        group: key.on.group.to_string(),
        contender: key.contender.to_string(),
        sweep: name::sweep(&key.sweep),
        metric: metric.name.to_owned(),
        unit: metric.unit.clone(),
        trials: rows.len(),
        solved,
        instances: units.len(),
        measured: all.len(),
        mean: Measured::new(summary::mean(&all), pooled::ratio_of_sums(&sums, PLAN)),
        median: (all.len() == solved).then(|| median(units.values())).flatten(),
    })
}

/// The median over units, each with what was measured and how often it failed.
fn median<'u>(units: impl Iterator<Item = &'u (Vec<f64>, usize)>) -> Option<Measured> {
    let failing =
        |(values, failed): &(Vec<f64>, usize)| [values.clone(), vec![f64::INFINITY; *failed]].concat();
    let units: Vec<Vec<f64>> = units.map(failing).collect();
    Measured::new(summary::median(&units.concat()), pooled::median(&units, PLAN))
}
