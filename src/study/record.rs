//! The record: one row a trial, a failed trial is a row, unknown is null.

use engine::planner::{Exhibit, Value};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fmt;

/// How a trial ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    /// A path was found and the verifier accepts it.
    Solved,
    /// There is no path, or the planner had nothing left to try.
    NoPath,
    /// The budget ran out.
    BudgetSpent,
    /// A result came back and the verifier refused it.
    Rejected,
    /// The problem cannot be posed.
    InvalidProblem,
    /// The planner panicked.
    Crashed,
}

impl Status {
    /// Every status.
    pub const ALL: [Self; 6] =
        [Self::Solved, Self::NoPath, Self::BudgetSpent, Self::Rejected, Self::InvalidProblem, Self::Crashed];

    /// Its name in records.
    pub fn name(self) -> &'static str {
        match self {
            Self::Solved => "solved",
            Self::NoPath => "no_path",
            Self::BudgetSpent => "budget_spent",
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

/// The numbers of a row, by column name.
pub type Values = BTreeMap<String, Value>;

/// One trial.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Its name, unique in the study.
    pub trial: String,
    /// The problem: group, draw and query.
    pub problem: String,
    /// The problem group's label.
    pub group: String,
    /// The independent draw it belongs to: the unit of replication within the group.
    pub replicate: u32,
    /// The contender's label.
    pub contender: String,
    /// The sweep's values; empty without sweeps.
    pub sweep: String,
    /// The reading.
    pub reading: String,
    /// Which of the contender's seeds.
    pub repeat: u32,
    /// The contender's seed.
    pub seed: u64,
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
        self.values.get(column).map(|value| value.as_f64())
    }
}

/// One prepared object.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PreparedRow {
    /// Its name, unique in the study.
    pub prepared: String,
    /// The kind of prepared object.
    pub kind: String,
    /// The problem group's label.
    pub group: String,
    /// Which draw of the group.
    pub replicate: u32,
    /// The reading.
    pub reading: String,
    /// The seed it was built from.
    pub seed: u64,
    /// Why it could not be built.
    pub reason: Option<String>,
    /// What was measured.
    pub values: Values,
}

/// An exhibit and the trial or prepared object it belongs to.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Kept {
    /// The trial's or the prepared object's name.
    pub of: String,
    /// The exhibit.
    pub exhibit: Exhibit,
}

/// One clock reading of one trial.
#[derive(Debug, Clone, PartialEq)]
pub struct Timing {
    /// The trial.
    pub trial: String,
    /// The problem group's label.
    pub group: String,
    /// The contender's label.
    pub contender: String,
    /// Which draw of the group.
    pub replicate: u32,
    /// Which reading of the clock.
    pub repeat: u32,
    /// Planning time.
    pub plan_wall_ns: u64,
}

/// Everything that one unit of work (a prepared object and its trials) gives.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Batch {
    /// The prepared objects.
    pub prepared: Vec<PreparedRow>,
    /// The trials.
    pub rows: Vec<Row>,
    /// What figures need.
    pub kept: Vec<Kept>,
}
