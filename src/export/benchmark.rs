//! Records in the form of OMPL's benchmarks: experiments, planners, and runs with typed properties.
//!
//! An experiment is a query of a problem group at one point of the sweeps over it, under one interpretation. A
//! contender at one point of the other sweeps is a planner, and each of its trials is a run. Times are in seconds, from
//! the first session; a run without a clock has none. Every other property keeps the name of its column, which ends in
//! the unit.

use base::text::one_line;
use replan::analysis::compare::StoredRun;
use std::collections::{BTreeMap, BTreeSet};
use study::column::{self, Kind};
use study::key::TrialKey;
use study::manifest::Manifest;
use study::name;
use study::record::{Row, Status, Timing};

/// What OMPL's `PlannerStatus` can be, in its order.
pub const STATUSES: [&str; 10] = [
    "Unknown status",
    "Invalid start",
    "Invalid goal",
    "Unrecognized goal type",
    "Timeout",
    "Approximate solution",
    "Exact solution",
    "Crash",
    "Abort",
    "Infeasible",
];

/// The place among [`STATUSES`] of what stands for ours. A path that the verifier refused is none that OMPL has a word for.
fn ompl_status(status: Status) -> u8 {
    match status {
        Status::Rejected => 0,
        Status::InvalidProblem => 1,
        Status::BudgetSpent | Status::TimeSpent => 4,
        Status::Solved => 6,
        Status::Crashed => 7,
        Status::NoPath => 9,
    }
}

/// A property of runs.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Property {
    /// Its name: letters, digits and `_`.
    pub name: String,
    /// Its type in OMPL's logs and in SQL.
    pub kind: &'static str,
}

/// The runs of one planner on one problem group.
pub struct PlannerRuns {
    /// The contender, with its point of the sweeps.
    pub name: String,
    /// Its properties, in the order of the values.
    pub properties: Vec<Property>,
    /// The values of each run; `None` where a property was not measured.
    pub runs: Vec<Vec<Option<f64>>>,
}

/// One query of a problem group.
pub struct Experiment {
    /// `study/group[/sweep][/query][/interpretation]`.
    pub name: String,
    /// The root of the run's seeds.
    pub seed: u64,
    /// The program and the command that made the records.
    pub setup: String,
    /// The processor that read the clock, if it is known.
    pub cpu: String,
    /// The contenders with their runs; OMPL's format calls them planners.
    pub planners: Vec<PlannerRuns>,
}

impl Experiment {
    /// The most runs that a planner has.
    pub fn most_runs(&self) -> usize {
        self.planners.iter().map(|planner| planner.runs.len()).max().unwrap_or_default()
    }
}

/// Every experiment of a stored run, in the order of records.
pub fn experiments(run: &StoredRun) -> Vec<Experiment> {
    let mut all = Vec::new();
    for (study, (manifest, records)) in &run.studies {
        let times = first_times(&records.times);
        let rows: Vec<&Row> = records.batch.rows.iter().collect();
        let groups = grouped(&rows, |row| group_name(study, manifest, &row.key));
        all.extend(groups.into_iter().map(|(name, rows)| Experiment {
            name,
            seed: manifest.seed,
            setup: setup(manifest),
            cpu: manifest.made_by.cpu.clone().unwrap_or_default(),
            planners: planners(&rows, &times),
        }));
    }
    all
}

/// Rows by their names, in the order in which the names come first: instances of one name need not follow each other.
fn grouped<'r>(rows: &[&'r Row], name: impl Fn(&Row) -> String) -> Vec<(String, Vec<&'r Row>)> {
    let mut groups: Vec<(String, Vec<&Row>)> = Vec::new();
    let mut places = BTreeMap::new();
    for row in rows {
        let name = name(row);
        let place = *places.entry(name.clone()).or_insert(groups.len());
        match groups.get_mut(place) {
            Some((_, own)) => own.push(row),
            None => groups.push((name, vec![row])),
        }
    }
    groups
}

fn group_name(study: &str, manifest: &Manifest, key: &TrialKey) -> String {
    let on = &key.on;
    let mut name = format!("{study}/{}", name::group(&on.group, &on.sweep));
    if let Some(query) = &key.query {
        name += &format!("/{query}");
    }
    let defaults = manifest.interpretations.first().into_iter().flatten();
    let is_other = |((id, option), default): &(&(study::key::Text, study::key::Text), &String)| {
        let _ = id;
        **option != ***default
    };
    let options = on.interpretation.options().iter().zip(defaults).filter(is_other);
    let others = options.map(|((id, option), _)| format!("{id}={option}")).collect::<Vec<_>>();
    if !others.is_empty() {
        name += &format!("/{}", others.join(","));
    }
    one_line(&name)
}

fn setup(manifest: &Manifest) -> String {
    let quick = if manifest.quick { "a quick run with few instances\n" } else { "" };
    let command = one_line(&manifest.command);
    format!(
        "replan {}: {command}\n{quick}sha256 of what the spec runs: {}\n",
        manifest.made_by.replan, manifest.spec
    )
}

/// The least time of each timed trial in the first session, in seconds.
fn first_times(times: &[Timing]) -> BTreeMap<&TrialKey, f64> {
    let mut least: BTreeMap<&TrialKey, f64> = BTreeMap::new();
    for time in times.iter().filter(|time| time.session == 1) {
        let seconds = time.plan_wall_ns as f64 * 1e-9;
        let kept = least.entry(&time.trial).or_insert(seconds);
        *kept = kept.min(seconds);
    }
    least
}

fn planners(rows: &[&Row], times: &BTreeMap<&TrialKey, f64>) -> Vec<PlannerRuns> {
    let of = |row: &Row| {
        let at = row.key.sweep.after(&row.key.on.sweep);
        one_line(&name::group(&row.key.contender, &at))
    };
    grouped(rows, of).into_iter().map(|(name, rows)| planner(name, &rows, times)).collect()
}

fn planner(name: String, rows: &[&Row], times: &BTreeMap<&TrialKey, f64>) -> PlannerRuns {
    let places: BTreeSet<u16> = rows
        .iter()
        .flat_map(|row| row.values.iter())
        .filter_map(|(column, _)| column::place(column.name))
        .collect();
    let columns = places.iter().map(|place| &column::COLUMNS[usize::from(*place)]);
    let property = |name: &str, kind| Property { name: name.to_owned(), kind };
    let mut properties = vec![
        property("instance", "INTEGER"),
        property("repeat", "INTEGER"),
        property("solved", "BOOLEAN"),
        property("status", "ENUM"),
        property("time", "REAL"),
    ];
    properties
        .extend(columns.map(|column| {
            property(column.name, if column.kind == Kind::Count { "INTEGER" } else { "REAL" })
        }));
    let run = |row: &&Row| {
        let mut values = vec![
            Some(f64::from(row.instance())),
            Some(f64::from(row.key.repeat)),
            Some(f64::from(u8::from(row.is_solved()))),
            Some(f64::from(ompl_status(row.status))),
            times.get(&row.key).copied(),
        ];
        values.extend(places.iter().map(|place| row.values.at(*place).map(engine::planner::Value::as_f64)));
        values
    };
    PlannerRuns { name, properties, runs: rows.iter().map(run).collect() }
}
