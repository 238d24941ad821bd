//! A map with queries on it, as the benches of searches on grids pose them. They name the engine `ours`.

use super::ours::planner::{self, Build, Planner, Request};
use super::ours::search::ScaledOctile;
use super::ours::space::{LatticeWorld, World};
use base::grid::{CornerRule, Grid2, components};
use base::seed;
use base::settings::Settings;
use pathfinding::prelude::astar;
use rand::RngExt as _;
use std::hint::black_box;

/// A map and queries on it; each solver returns the sum of their costs, in units of 985 and 1393 or in cells.
pub struct Posed {
    world: World,
    /// Start and goal of each query.
    pub queries: Vec<[u32; 2]>,
    /// The queries' ends as planners take them.
    pub ends: Vec<[Vec<f64>; 2]>,
}

impl Posed {
    /// Queries between cells of `grid` that are joined.
    pub fn new(grid: Grid2, query_count: usize) -> Self {
        let lattice = LatticeWorld::new(grid, CornerRule::ForbidAny);
        let grid = lattice.grid();
        let parts = components(grid, lattice.moves());
        let mut stream = seed::stream(30);
        let mut queries = Vec::new();
        while queries.len() < query_count {
            let ends = [0, 1].map(|_| stream.random_range(0..grid.cell_count()));
            if ends[0] != ends[1] && parts.are_joined(ends[0], ends[1]) {
                queries.push(ends);
            }
        }
        let point = |cell: u32| grid.xy(cell).map(f64::from).to_vec();
        let ends = queries.iter().map(|ends| ends.map(point)).collect();
        Self { world: World::Lattice(lattice), queries, ends }
    }

    /// The map.
    pub fn lattice(&self) -> &LatticeWorld {
        self.world.as_lattice().unwrap()
    }

    /// What a planner finds, from request to plan.
    pub fn planned(&self, planner: &dyn Planner) -> f64 {
        let plan = |[start, goal]: &[Vec<f64>; 2]| {
            let request =
                Request { world: &self.world, start, goal, expansions: u64::MAX, seed: 0, trace: false };
            planner.plan(&request).unwrap().cost.unwrap()
        };
        self.ends.iter().map(plan).sum()
    }

    /// What the crate finds with successors from legal-move masks.
    pub fn crate_best(&self) -> u64 {
        let width = self.lattice().grid().width();
        let moves = self.lattice().moves();
        let successors =
            |&cell: &u32| moves.from_cell(cell).map(|(to, diagonal)| (to, if diagonal { 1393 } else { 985 }));
        let solve = |&[start, goal]: &[u32; 2]| {
            let [x, y] = [goal % width, goal / width];
            let h = |&cell: &u32| {
                ScaledOctile::distance([(cell % width).abs_diff(x), (cell / width).abs_diff(y)])
            };
            let (path, cost) = astar(&start, successors, h, |&cell| cell == goal).unwrap();
            black_box(path);
            u64::from(cost)
        };
        self.queries.iter().map(solve).sum()
    }
}

/// The planner called `name` with its defaults.
pub fn planner(name: &str) -> Box<dyn Planner> {
    let Build::Planner(build) = planner::find(name).unwrap().build else { panic!("it is a planner") };
    build(&Settings::composed("a bench", toml::Table::new())).unwrap()
}
