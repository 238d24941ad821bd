//! The interface of planners: their input, their output, and how an entry describes itself.

use base::grid::CornerRule;
use base::settings::{Accepted, Settings, SettingsError};
use schemars::JsonSchema;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::PathBuf;
use world::space::roadmap::Extent;
use world::space::{World, WorldKind};

/// One query, posed to a planner.
#[derive(Debug, Clone, Copy)]
pub struct Request<'a> {
    /// Where to plan; shared by all contenders.
    pub world: &'a World,
    /// The start configuration, in the world's own coordinates.
    pub start: &'a [f64],
    /// The goal configuration.
    pub goal: &'a [f64],
    /// At most this many expansions.
    pub expansions: u64,
    /// The seed of a planner that draws.
    pub seed: u64,
    /// Whether to keep what figures need ([`Plan::traces`]); it must not change anything else.
    pub trace: bool,
}

/// A number in a record.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Value {
    /// A count.
    Count(u64),
    /// A measured quantity in the unit its column names.
    Real(f64),
}

impl Value {
    /// The number as a float; the sum of nothing, which is -0, as 0.
    pub fn as_f64(self) -> f64 {
        match self {
            Self::Count(count) => count as f64,
            Self::Real(real) => real + 0.0,
        }
    }
}

/// What a planner counted, by column name.
pub type Counts = BTreeMap<&'static str, Value>;

/// A sequence of points that a figure needs: a path, opened cells, a trajectory.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Trace {
    /// What it is, as figures ask for it.
    pub name: String,
    /// How many numbers make one point.
    pub width: usize,
    /// The points, one after another.
    pub values: Vec<f64>,
}

/// How planning ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ending {
    /// A path was found.
    Solved,
    /// It was shown that there is none, or the planner has nothing left to try.
    NoPath,
    /// The budget of expansions, or another limit of the planner's own, ran out.
    BudgetSpent,
    /// The time ran out, for a planner that is given one.
    TimeSpent,
    /// The planner broke down, which only one from outside can do and go on to tell.
    Crashed,
}

/// What a planner returns.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// How it ended.
    pub ending: Ending,
    /// Configurations from start to goal; empty unless solved.
    pub path: Vec<Vec<f64>>,
    /// The cost that the planner claims for its path, in the world's unit; `None` unless solved.
    pub cost: Option<f64>,
    /// What was counted.
    pub counts: Counts,
    /// What figures need, if the request has it.
    pub traces: Vec<Trace>,
    /// Why it ended so, where the ending alone does not say it; of a path, what should be known if it is refused.
    pub reason: Option<String>,
}

/// Why a query cannot be posed in this world (a start in collision, say).
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct Invalid(pub String);

/// A planner with its settings.
pub trait Planner: Send + Sync {
    /// Plans once.
    ///
    /// # Errors
    /// [`Invalid`] if start or goal is not a free configuration of the world.
    fn plan(&self, request: &Request<'_>) -> Result<Plan, Invalid>;

    /// Whether a solved plan has the least cost there is in the world's graph.
    fn is_optimal(&self) -> bool {
        false
    }

    /// Whether [`Ending::NoPath`] proves that the world's graph has no path.
    fn is_complete(&self) -> bool {
        false
    }

    /// Whether what it returns depends on the request's seed: only then does it run on several.
    fn draws(&self) -> bool {
        false
    }

    /// Whether its path may leave the graph of the world for any free segment; the verifier then judges segments and not
    /// moves.
    fn is_any_angle(&self) -> bool {
        false
    }

    /// The steps, in columns and rows, that its graph may have, if it moves over a lattice by steps of its own; the
    /// verifier holds its path to them.
    fn steps(&self) -> Option<&[[i32; 2]]> {
        None
    }

    /// The files that its trials depend on besides its settings.
    fn files(&self) -> &[PathBuf] {
        &[]
    }

    /// What must be installed before it can plan here; `None` if nothing must.
    fn lacks(&self) -> Option<String> {
        None
    }

    /// How large a roadmap must at least be, if it searches a part of one that its settings name; a study is refused if
    /// its problems have less.
    fn asks(&self) -> Option<Extent> {
        None
    }
}

/// A stage that tidies a solved plan.
pub trait Stage: Send + Sync {
    /// A solved plan, tidied; counts are added to, never replaced.
    fn tidied(&self, request: &Request<'_>, plan: Plan) -> Plan;

    /// The plan, tidied if it is solved.
    fn refine(&self, request: &Request<'_>, plan: Plan) -> Plan {
        if plan.ending == Ending::Solved { self.tidied(request, plan) } else { plan }
    }

    /// Which corners its segments on a lattice may pass, if not those that moves may; the verifier then judges a segment by
    /// whichever of the two rules it keeps.
    fn sight_corners(&self) -> Option<CornerRule> {
        None
    }
}

/// A planner that is its settings.
pub(super) fn planner<T: Planner + DeserializeOwned + JsonSchema + 'static>(
    settings: &Settings,
) -> Result<Box<dyn Planner>, SettingsError> {
    Ok(Box::new(settings.read::<T>()?))
}

/// A stage that is its settings.
pub(super) fn stage<T: Stage + DeserializeOwned + JsonSchema + 'static>(
    settings: &Settings,
) -> Result<Box<dyn Stage>, SettingsError> {
    Ok(Box::new(settings.read::<T>()?))
}

/// How an entry is built from its settings.
#[derive(Debug, Clone, Copy)]
pub enum Build {
    /// A planner: first in a contender's pipeline.
    Planner(fn(&Settings) -> Result<Box<dyn Planner>, SettingsError>),
    /// A stage: any later place.
    Stage(fn(&Settings) -> Result<Box<dyn Stage>, SettingsError>),
}

/// A registered planner or stage.
#[derive(Debug)]
pub struct Entry {
    /// The name that specs use; also its file's name.
    pub name: &'static str,
    /// One line for `replan list`.
    pub about: &'static str,
    /// Raised whenever a change moves what it returns, so that stored trials are not reused.
    pub revision: u32,
    /// The world it plans in.
    pub needs: WorldKind,
    /// The columns that its counts fill.
    pub columns: &'static [&'static str],
    /// The shape of its settings, which documents them.
    pub settings: Accepted,
    /// Settings that it can be built from, as TOML: for `replan list`, and for a test that builds it from them.
    pub example: &'static str,
    /// How to build it.
    pub build: Build,
}
