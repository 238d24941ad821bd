//! Settings, memory and plans that the planners by jump points share.

use super::lattice::{self, Posed};
use super::pool::Pool;
use super::{Invalid, Plan, Request, Value};
use crate::search::JumpSearch;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::space::Jumps;

/// The columns that every search by jump points fills.
pub(super) const COLUMNS: &[&str] = &["opened", "closed", "expansions", "generated", "preprocessing_bytes"];

/// When what a planner needs of a map is made.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(super) enum Preparation {
    /// Once for each map, in the first query on it, which no clock times.
    #[default]
    Kept,
    /// In every query anew, so that every clock reading counts it.
    EachQuery,
}

/// A planner by jump points with its settings.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct JumpPoints {
    /// When what it needs of a map is made.
    #[serde(default)]
    pub(super) preparation: Preparation,
    #[serde(skip)]
    pool: Pool<JumpSearch>,
}

impl JumpPoints {
    /// The plan over `jumps`, which take that many bytes.
    pub(super) fn plan(
        &self,
        posed: &Posed<'_>,
        request: &Request<'_>,
        jumps: &impl Jumps,
        bytes: usize,
    ) -> Result<Plan, Invalid> {
        let grid = posed.world.grid();
        let size = [grid.width(), grid.height()];
        let mut search = match self.pool.take(|search| search.size() == size) {
            Some(search) => search,
            None => JumpSearch::new(size).map_err(|e| Invalid(e.to_string()))?,
        };
        let report = search.solve(jumps, posed.start, posed.goal, request.expansions);
        self.pool.keep(search);
        let mut plan = lattice::plan(grid, &report.outcome, &[report.counters], Vec::new());
        plan.counts.insert("preprocessing_bytes", Value::Count(bytes as u64));
        Ok(plan)
    }
}
