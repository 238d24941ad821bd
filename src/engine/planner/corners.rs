//! What the planners that plan between corners of cells alone share.

use super::lattice::{self, Posed};
use super::{Plan, Request, Trace};
use crate::search::{Closings, Cornered, Observer, Report, VisitOrder};
use crate::space::LatticeWorld;

/// The corners of the cells of `world`; a checked study gives these planners no other lattice.
pub(super) fn cornered(world: &LatticeWorld) -> Cornered<'_> {
    let cells = world.cornered().expect("a checked study gives a planner the kind of world it needs");
    Cornered { cells, grid: world.grid(), moves: world.moves() }
}

/// What `run` gives, and the traces of what it did if the request asks for them.
pub(super) fn watched<T>(
    request: &Request<'_>,
    posed: &Posed<'_>,
    run: impl FnOnce(&mut dyn Observer) -> T,
) -> (T, Vec<Trace>) {
    if !request.trace {
        return (run(&mut ()), Vec::new());
    }
    let closings = Closings::default();
    let mut watching = (VisitOrder::default(), closings.one_side(0));
    let found = run(&mut watching);
    let grid = posed.world.grid();
    let opened = lattice::cells(grid, "opened_start_side", &watching.0.opened);
    (found, vec![opened, lattice::closings(grid, closings)])
}

/// The plan of a search from one side.
pub(super) fn plan(posed: &Posed<'_>, report: &Report<f64>, traces: Vec<Trace>) -> Plan {
    let plan = lattice::plan(posed.world.grid(), &report.outcome, &[report.counters], traces);
    lattice::with_distinct(plan, report.counters.opened)
}
