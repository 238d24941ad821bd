//! A* on a lattice with the Euclidean heuristic.

use super::lattice::{self, COLUMNS, Posed, TiesSetting, UPDATE};
use super::{Build, Entry, Invalid, Plan, Planner, Request};
use crate::search::{Combined, GridGraph, Heap, Rules, Search, Stop, Terms, euclidean_to, weighted};
use crate::space::WorldKind;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "astar",
    about: "A* with f = g + weight · h, h the Euclidean distance; the goal is accepted when it is popped",
    revision: 1,
    needs: WorldKind::Lattice,
    columns: COLUMNS,
    build: Build::Planner(|settings| {
        let read: Astar = settings.read()?;
        if !read.weight.is_finite() || read.weight < 0.0 {
            let message =
                format!("weight is {}; 0 (Dijkstra), 1 (A*) or any larger number is accepted", read.weight);
            return Err(settings.error(message));
        }
        Ok(Box::new(read))
    }),
};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Astar {
    /// What h is multiplied by.
    weight: f64,
    /// The order among equal f.
    ties: TiesSetting,
}

impl Planner for Astar {
    fn plan(&self, request: &Request<'_>) -> Result<Plan, Invalid> {
        let Posed { world, start, goal } = Posed::new(request)?;
        let grid = world.grid();
        let mut search = Search::new(Heap::new(self.ties.into()));
        let estimate = Combined { h: euclidean_to(grid, goal), combine: weighted(self.weight) };
        let terms = Terms {
            graph: &mut GridGraph::new(world.moves()),
            estimate: &estimate,
            observer: &mut (),
            update: UPDATE,
        };
        let rules = Rules { stop: Stop::GoalPopped, max_expansions: request.expansions };
        let report = search.run(terms, start, |cell| cell == goal, rules, &mut ());
        let mut exhibits = Vec::new();
        if request.trace {
            exhibits.push(lattice::cells(grid, "opened_start_side", search.opened()));
        }
        Ok(lattice::plan(grid, &report.outcome, &[report.counters], exhibits))
    }

    fn is_optimal(&self) -> bool {
        self.weight <= 1.0
    }

    fn is_complete(&self) -> bool {
        true
    }
}
