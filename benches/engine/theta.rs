//! Theta* between corners of cells beside a plain implementation, on grids of 500 × 500 cells, 20 % blocked.
//!
//! Both answer the same queries, from the south-west corner to one in the last column, and are held to equal costs before anything is
//! timed, up to the order of equal vertices:
//!
//! - `planner`: the planner `theta_star` as studies call it, from request to plan;
//! - `plain`: a binary heap of (f, g, vertex) without decrease-key, arrays of g and parents made for each query, and lines of sight
//!   by [`corners_see`].

mod cpu;

use base::grid::{Blocking, Grid2, Moves, blocked_cells, corner_moves, corners_see};
use base::seed;
use base::settings::Settings;
use cpu::CpuTime;
use criterion::{Criterion, criterion_group, criterion_main};
use rand::RngExt as _;
use replan_engine::planner::{self, Build, Planner, Request};
use replan_engine::space::{LatticeWorld, World};
use std::{cmp::Ordering, collections::BinaryHeap, time::Duration};

const SIDE_CELLS: u32 = 500;
const QUERIES: usize = 5;

/// A vertex on the heap: the least f comes first and, of equal ones, the least g.
#[derive(PartialEq)]
struct Waiting {
    f: f64,
    g: f64,
    vertex: u32,
}

impl Eq for Waiting {}

impl PartialOrd for Waiting {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Waiting {
    fn cmp(&self, other: &Self) -> Ordering {
        let by_g = || other.g.total_cmp(&self.g);
        other.f.total_cmp(&self.f).then_with(by_g).then_with(|| other.vertex.cmp(&self.vertex))
    }
}

/// A map and queries on it.
struct Posed {
    world: World,
    cells: Grid2,
    moves: Moves,
    queries: Vec<[Vec<f64>; 2]>,
}

impl Posed {
    fn new() -> Self {
        let mut stream = seed::stream(20);
        let size = [SIDE_CELLS; 2];
        let cells = blocked_cells(&mut stream, size, Blocking::Independent(0.2), 1, &[]).unwrap();
        let mut goal = || f64::from(stream.random_range(0..SIDE_CELLS));
        let queries = (0..QUERIES).map(|_| [vec![0.0, 0.0], vec![f64::from(SIDE_CELLS - 1), goal()]]);
        let queries = queries.collect();
        let world = World::Lattice(LatticeWorld::of_corners(cells.clone()));
        Self { world, moves: corner_moves(&cells), cells, queries }
    }

    /// The sum of costs that the planner finds.
    fn planned(&self, planner: &dyn Planner) -> f64 {
        let plan = |[start, goal]: &[Vec<f64>; 2]| {
            let request =
                Request { world: &self.world, start, goal, expansions: u64::MAX, seed: 0, trace: false };
            planner.plan(&request).unwrap().cost.unwrap()
        };
        self.queries.iter().map(plan).sum()
    }

    /// The sum of costs that the plain implementation finds.
    fn plain(&self) -> f64 {
        let vertex = |at: &[f64]| at[1] as u32 * self.moves.width() + at[0] as u32;
        self.queries.iter().map(|[start, goal]| self.theta_star(vertex(start), vertex(goal))).sum()
    }

    fn theta_star(&self, start: u32, goal: u32) -> f64 {
        let width = self.moves.width();
        let xy = |vertex: u32| [(vertex % width) as i32, (vertex / width) as i32];
        let distance = |one: u32, other: u32| {
            let ([x, y], [u, v]) = (xy(one), xy(other));
            f64::from((x - u).pow(2) + (y - v).pow(2)).sqrt()
        };
        let count = self.moves.cell_count() as usize;
        let mut costs = vec![f64::INFINITY; count];
        let mut parents = vec![u32::MAX; count];
        let mut closed = vec![false; count];
        let mut open = BinaryHeap::new();
        (costs[start as usize], parents[start as usize]) = (0.0, start);
        open.push(Waiting { f: distance(start, goal), g: 0.0, vertex: start });
        while let Some(Waiting { vertex, .. }) = open.pop() {
            if vertex == goal {
                return costs[goal as usize];
            }
            if std::mem::replace(&mut closed[vertex as usize], true) {
                continue;
            }
            let parent = parents[vertex as usize];
            for (to, _) in self.moves.from_cell(vertex).filter(|(to, _)| !closed[*to as usize]) {
                let is_seen = corners_see(&self.cells, xy(parent), xy(to));
                let from = if is_seen { parent } else { vertex };
                let g = costs[from as usize] + distance(from, to);
                if g < costs[to as usize] {
                    (costs[to as usize], parents[to as usize]) = (g, from);
                    open.push(Waiting { f: g + distance(to, goal), g, vertex: to });
                }
            }
        }
        panic!("the border joins all ends")
    }
}

fn theta(criterion: &mut Criterion<CpuTime>) {
    let posed = Posed::new();
    let Build::Planner(build) = planner::find("theta_star").unwrap().build else { panic!("it is a planner") };
    let settings = "line_of_sight = 'exact_interior'\nties = 'smaller_g'".parse().unwrap();
    let planner = build(&Settings::composed("a bench", settings)).unwrap();
    let (own, plain) = (posed.planned(planner.as_ref()), posed.plain());
    assert!((own - plain).abs() < 1e-3 * own, "{own} against {plain}");
    let mut group = criterion.benchmark_group("500x500");
    group.sample_size(10).warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(3));
    group.bench_function("planner", |bencher| bencher.iter(|| posed.planned(planner.as_ref())));
    group.bench_function("plain", |bencher| bencher.iter(|| posed.plain()));
    group.finish();
}

criterion_group! {
    name = benches;
    config = cpu::criterion();
    targets = theta
}
criterion_main!(benches);
