//! Settings, memory and plans that the planners by jump points share.

use super::lattice::{self, Posed};
use super::pool::Pool;
use super::{Invalid, Plan, Planner, Request, Value};
use crate::search::JumpSearch;
use base::settings::{Settings, SettingsError};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::space::{JumpLines, JumpTable, Jumps};

/// The columns that every search by jump points fills.
pub(super) const COLUMNS: &[&str] = &["opened", "closed", "expansions", "generated", "preprocessing_bytes"];

/// When what a planner needs of a map is made.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
enum Preparation {
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
    preparation: Preparation,
    #[serde(skip)]
    pool: Pool<JumpSearch>,
}

/// The planner that looks jump points up in a table, or else scans lines for them.
pub(super) fn built(settings: &Settings, has_table: bool) -> Result<Box<dyn Planner>, SettingsError> {
    Ok(Box::new(Jumper { settings: settings.read()?, has_table }))
}

/// A planner by jump points.
struct Jumper {
    settings: JumpPoints,
    has_table: bool,
}

impl Planner for Jumper {
    fn plan(&self, request: &Request<'_>) -> Result<Plan, Invalid> {
        let posed = Posed::new(request)?;
        let over_lines = |lines: &JumpLines| self.settings.plan(&posed, request, lines, lines.bytes());
        let over_table = |table: &JumpTable| self.settings.plan(&posed, request, table, table.bytes());
        match (self.has_table, self.settings.preparation) {
            (false, Preparation::Kept) => over_lines(posed.world.jump_lines()),
            (false, Preparation::EachQuery) => over_lines(&JumpLines::new(posed.world)),
            (true, Preparation::Kept) => over_table(posed.world.jump_table()),
            (true, Preparation::EachQuery) => over_table(&JumpTable::new(posed.world)),
        }
    }

    fn is_optimal(&self) -> bool {
        true
    }

    fn is_complete(&self) -> bool {
        true
    }
}

impl JumpPoints {
    /// The plan over `jumps`, which take that many bytes.
    fn plan(
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
