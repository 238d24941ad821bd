//! The record: one row a trial, a failed trial is a row, unknown is null.

use super::column::{self, Column};
use super::key::{InstanceKey, Owner, SweepKey, Text, TrialKey};
use engine::planner::{Trace, Value};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;

/// How a trial ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    /// A path was found and the verifier accepts it.
    Solved,
    /// There is no path, or the planner had nothing left to try.
    NoPath,
    /// The budget ran out.
    BudgetSpent,
    /// The time ran out, for a planner that is given one.
    TimeSpent,
    /// A result came back and the verifier refused it.
    Rejected,
    /// The problem cannot be posed.
    InvalidProblem,
    /// The planner panicked or, if it is from outside, broke down or broke its rules.
    Crashed,
}

impl Status {
    /// Every status.
    pub const ALL: [Self; 7] = [
        Self::Solved,
        Self::NoPath,
        Self::BudgetSpent,
        Self::TimeSpent,
        Self::Rejected,
        Self::InvalidProblem,
        Self::Crashed,
    ];

    /// Its name in records.
    pub fn name(self) -> &'static str {
        match self {
            Self::Solved => "solved",
            Self::NoPath => "no_path",
            Self::BudgetSpent => "budget_spent",
            Self::TimeSpent => "time_spent",
            Self::Rejected => "rejected",
            Self::InvalidProblem => "invalid_problem",
            Self::Crashed => "crashed",
        }
    }

    /// The status called `name`.
    pub fn find(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|status| status.name() == name)
    }
}

impl fmt::Display for Status {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// The numbers of a row: those that were measured, in the order of [`COLUMNS`](column::COLUMNS).
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "BTreeMap<String, Value>", into = "BTreeMap<String, Value>")]
pub struct Values(Vec<(u16, Value)>);

impl Values {
    /// Without a number, with room for `count`.
    pub fn with_capacity(count: usize) -> Self {
        Self(Vec::with_capacity(count))
    }

    /// The number in the column of this place.
    pub fn at(&self, place: u16) -> Option<Value> {
        self.0.binary_search_by_key(&place, |(of, _)| *of).ok().map(|at| self.0[at].1)
    }

    /// The number in the column called `name`.
    pub fn get(&self, name: &str) -> Option<Value> {
        self.at(column::place(name)?)
    }

    /// Puts `value` in the column of this place.
    pub fn put(&mut self, place: u16, value: Value) {
        match self.0.last() {
            Some((last, _)) if *last >= place => match self.0.binary_search_by_key(&place, |(of, _)| *of) {
                Ok(at) => self.0[at].1 = value,
                Err(at) => self.0.insert(at, (place, value)),
            },
            _ => self.0.push((place, value)),
        }
    }

    /// Every column that has a number, and the number.
    pub fn iter(&self) -> impl Iterator<Item = (&'static Column, Value)> {
        self.0.iter().map(|(place, value)| (&column::COLUMNS[usize::from(*place)], *value))
    }
}

/// # Panics
/// If there is no such column: entries declare what they fill, and a test holds that it is listed.
impl<'a> Extend<(&'a str, Value)> for Values {
    fn extend<T: IntoIterator<Item = (&'a str, Value)>>(&mut self, values: T) {
        for (name, value) in values {
            self.put(column::place(name).expect("what an entry declares is listed among the columns"), value);
        }
    }
}

impl<'a> FromIterator<(&'a str, Value)> for Values {
    fn from_iter<T: IntoIterator<Item = (&'a str, Value)>>(values: T) -> Self {
        let mut all = Self::default();
        all.extend(values);
        all
    }
}

impl TryFrom<BTreeMap<String, Value>> for Values {
    type Error = String;

    fn try_from(values: BTreeMap<String, Value>) -> Result<Self, String> {
        let mut all = Self::default();
        for (name, value) in values {
            let place = column::place(&name).ok_or_else(|| format!("there is no column `{name}`"))?;
            all.put(place, value);
        }
        Ok(all)
    }
}

impl From<Values> for BTreeMap<String, Value> {
    fn from(values: Values) -> Self {
        values.iter().map(|(column, value)| (column.name.to_owned(), value)).collect()
    }
}

/// One trial.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// What names it, unique in the study.
    pub key: TrialKey,
    /// The contender's seed; unknown of a trial that was recorded elsewhere.
    pub seed: Option<u64>,
    /// How it ended.
    pub status: Status,
    /// Why, unless solved.
    pub reason: Option<String>,
    /// What was measured.
    pub values: Values,
}

impl Row {
    /// The number in `column`, if it was measured.
    pub fn value(&self, column: &str) -> Option<f64> {
        self.values.get(column).map(Value::as_f64)
    }

    /// Whether it was solved.
    pub fn is_solved(&self) -> bool {
        self.status == Status::Solved
    }

    /// Whether a path came back, refused by the verifier or not.
    pub fn is_returned(&self) -> bool {
        matches!(self.status, Status::Solved | Status::Rejected)
    }

    /// Which instance of its problem group it belongs to.
    pub fn instance(&self) -> u32 {
        self.key.on.instance
    }

    /// The query; empty where an instance has one query only.
    pub fn query(&self) -> &str {
        self.key.query.as_deref().unwrap_or_default()
    }

    /// The part of its key that it shares with other contenders' trials: instance, query, sweep and repeat.
    pub fn case(&self) -> (&Arc<InstanceKey>, &Option<Text>, &SweepKey, u32) {
        (&self.key.on, &self.key.query, &self.key.sweep, self.key.repeat)
    }
}

/// One preprocessed object.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PreprocessingRow {
    /// What names it, unique in the study.
    pub key: Arc<InstanceKey>,
    /// The kind of preprocessed object.
    pub kind: String,
    /// The seed it was built from.
    pub seed: u64,
    /// Why it could not be built.
    pub reason: Option<String>,
    /// What was measured.
    pub values: Values,
}

/// A trace and the trial or preprocessed object it belongs to.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Kept {
    /// Whose it is.
    pub owner: Owner,
    /// Its numbers.
    pub trace: Trace,
}

/// One time of one trial.
#[derive(Debug, Clone, PartialEq)]
pub struct Timing {
    /// The trial whose planning was timed.
    pub trial: TrialKey,
    /// The session in which the clock was read, from 1; times of different sessions are never pooled.
    pub session: u32,
    /// Which reading of the clock in its session, from 0.
    pub clock_repeat: u32,
    /// Planning time.
    pub plan_wall_ns: u64,
}

/// Everything that one unit of work (a preprocessed object and its trials) gives.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Batch {
    /// The preprocessed objects.
    pub preprocessing: Vec<PreprocessingRow>,
    /// The trials.
    pub rows: Vec<Row>,
    /// What figures need.
    pub kept: Vec<Kept>,
}

impl Batch {
    /// Its entries, followed by those of `other`.
    #[must_use]
    pub fn with(mut self, other: Self) -> Self {
        self.preprocessing.extend(other.preprocessing);
        self.rows.extend(other.rows);
        self.kept.extend(other.kept);
        self
    }
}
