//! The fast A* for 8-connected grids with the octile heuristic.

use super::entry::planner;
use super::lattice::{self, COLUMNS_DISTINCT, Posed};
use super::pool::Pool;
use super::{Build, Entry, Invalid, Plan, Planner, Request};
use crate::search::OctileAstar;
use base::grid::Moves;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use std::sync::Arc;
use world::space::WorldKind;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "astar_octile",
    about: "A* with the octile heuristic in integers and buckets: least cost, fast, and of equal f the last offered",
    revision: 2,
    needs: WorldKind::Lattice,
    columns: COLUMNS_DISTINCT,
    settings: Accepted::shape::<AstarOctile>(),
    example: "",
    build: Build::Planner(planner::<AstarOctile>),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct AstarOctile {
    #[serde(skip)]
    pool: Pool<Built>,
}

/// A search with the moves that it was built for, which takes longer than many a query on them.
struct Built {
    moves: Arc<Moves>,
    search: OctileAstar,
}

impl Planner for AstarOctile {
    fn plan(&self, request: &Request<'_>) -> Result<Plan, Invalid> {
        let Posed { world, start, goal } = Posed::new(request)?;
        let mut built = match self.pool.take(|built| Arc::ptr_eq(&built.moves, world.moves())) {
            Some(built) => built,
            None => Built {
                moves: Arc::clone(world.moves()),
                search: OctileAstar::new(world.moves()).map_err(|e| Invalid(e.to_string()))?,
            },
        };
        let report = built.search.solve(start, goal, request.expansions);
        self.pool.keep(built);
        let plan = lattice::plan(world.grid(), &report.outcome, &[report.counters], Vec::new());
        Ok(lattice::with_distinct(plan, report.counters.opened))
    }

    fn is_optimal(&self) -> bool {
        true
    }

    fn is_complete(&self) -> bool {
        true
    }
}
