//! The fast A* for 8-connected grids with the octile heuristic.

use super::lattice::{self, COLUMNS, Posed};
use super::{Build, Entry, Invalid, Plan, Planner, Request};
use crate::search::OctileAstar;
use crate::space::WorldKind;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "astar_octile",
    about: "A* with the octile heuristic in integers and buckets: least cost, fast, and of equal f the last offered",
    revision: 1,
    needs: WorldKind::Lattice,
    columns: COLUMNS,
    build: Build::Planner(|settings| {
        let read: AstarOctile = settings.read()?;
        Ok(Box::new(read))
    }),
};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct AstarOctile {}

impl Planner for AstarOctile {
    fn plan(&self, request: &Request<'_>) -> Result<Plan, Invalid> {
        let Posed { world, start, goal } = Posed::new(request)?;
        let mut search = OctileAstar::new(world.moves()).map_err(|e| Invalid(e.to_string()))?;
        let report = search.solve(start, goal, request.expansions);
        Ok(lattice::plan(world.grid(), &report.outcome, &[report.counters], Vec::new()))
    }

    fn is_optimal(&self) -> bool {
        true
    }

    fn is_complete(&self) -> bool {
        true
    }
}
