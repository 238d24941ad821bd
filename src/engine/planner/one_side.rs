//! The steps that planners share that search a lattice from its start alone: the observer, and the plan made of the
//! outcome.

use super::lattice::{self, Posed};
use super::{Plan, Planner, Request, Value};
use crate::search::{Closings, Cost, Observer, Parents, Report, VisitOrder};

/// What a search found.
pub(super) struct Found<C> {
    /// How it ended, and its counters.
    pub(super) report: Report<C>,
    /// The path, where it is not along the nodes of the route.
    pub(super) path: Option<Vec<Vec<f64>>>,
    /// Lines of sight that were looked at, by searches that look at any.
    pub(super) sight_checks: Option<u64>,
}

impl<C> From<Report<C>> for Found<C> {
    fn from(report: Report<C>) -> Self {
        Self { report, path: None, sight_checks: None }
    }
}

/// A search of a lattice from its start.
pub(super) trait OneSided: Planner {
    /// What a step costs.
    type Cost: Cost;

    /// What it finds of the posed query; `observer` watches.
    fn search<O: Observer>(&self, posed: &Posed<'_>, expansions: u64, observer: &mut O) -> Found<Self::Cost>;

    /// The plan that this amounts to, with the traces of what was opened and closed if the request asks for them, and over which
    /// parents where they may be far.
    fn planned(&self, request: &Request<'_>, posed: &Posed<'_>) -> Plan {
        let grid = posed.world.grid();
        let mut traces = Vec::new();
        let found = if request.trace {
            let closings = Closings::default();
            let mut visits = VisitOrder::default();
            let mut parents = Parents::default();
            let mut watching = ((&mut visits, closings.one_side(0)), &mut parents);
            let found = self.search(posed, request.expansions, &mut watching);
            traces.push(lattice::cells(grid, "opened_start_side", &visits.opened));
            traces.push(lattice::closings(grid, closings));
            if self.is_any_angle() || posed.world.cornered().is_some() {
                // Elsewhere, parents are neighbours, which closings show.
                traces.push(lattice::cells(grid, "parents", &parents.closed));
            }
            found
        } else {
            self.search(posed, request.expansions, &mut ())
        };
        let Found { report, path, sight_checks } = found;
        let plan = lattice::plan(grid, &report.outcome, &[report.counters], traces);
        let mut plan = lattice::with_distinct(plan, report.counters.opened);
        if let Some(path) = path {
            plan.path = path;
        }
        plan.counts.extend(sight_checks.map(|count| ("sight_checks", Value::Count(count))));
        plan
    }
}
