//! Search by jump points against the octile A* and the crate `pathfinding`, on maps of 512 × 512 cells, no corner cut.
//!
//! Groups: `random` (30 % of the cells blocked), `rectangles`, `rooms`, `streets`, and `map` for a `MovingAI` map named by
//! `REPLAN_BENCH_MAP`. In each group every entry answers the same queries, drawn among cells that are joined, and all are
//! held to equal costs before anything is timed:
//!
//! - `astar_octile`: [`OctileAstar`] on a map it has seen before;
//! - `jps`: [`JumpSearch`] over [`JumpLines`], made before;
//! - `jps_plus`: [`JumpSearch`] over a [`JumpTable`], made before;
//! - `planner_…`: the planners of those names as studies call them, from request to plan;
//! - `prepare_…`: what each needs of a map, made once: the legal moves' arrays, the lines, the table;
//! - `pathfinding`: the crate with `u32` nodes and costs and successors from legal-move masks, unallocated.
//!
//! On random cells every other cell is a jump point and little is jumped over: that group shows what the method costs
//! where it has nothing to gain.

mod cpu;

use base::grid::{
    CornerRule, Grid2, components, independent_cells, read_movingai_map, rectangles, rooms, streets,
};
use base::seed;
use base::settings::Settings;
use cpu::CpuTime;
use criterion::{BenchmarkGroup, Criterion, criterion_group, criterion_main};
use pathfinding::prelude::astar;
use rand::RngExt as _;
use replan_engine::planner::{self, Build, Planner, Request};
use replan_engine::search::{Counters, JumpSearch, Octile, OctileAstar, Report, ScaledOctile};
use replan_engine::space::{JumpLines, JumpTable, Jumps, LatticeWorld, World};
use std::{hint::black_box, path::Path, time::Duration};

const SIZE_CELLS: [u32; 2] = [512, 512];
const QUERIES: usize = 40;

/// A map and queries on it; each solver returns the sum of their costs in units of 985 and 1393.
struct Posed {
    world: World,
    queries: Vec<[u32; 2]>,
    /// The queries' ends as planners take them.
    ends: Vec<[Vec<f64>; 2]>,
}

impl Posed {
    fn new(grid: Grid2) -> Self {
        let lattice = LatticeWorld::new(grid, CornerRule::ForbidAny);
        let grid = lattice.grid();
        let mut stream = seed::stream(30);
        let mut queries = Vec::new();
        let parts = components(grid, lattice.moves());
        while queries.len() < QUERIES {
            let ends = [0, 1].map(|_| stream.random_range(0..grid.cell_count()));
            if ends[0] != ends[1] && parts.are_joined(ends[0], ends[1]) {
                queries.push(ends);
            }
        }
        let point = |cell: u32| grid.xy(cell).map(f64::from).to_vec();
        let ends = queries.iter().map(|ends| ends.map(point)).collect();
        Self { world: World::Lattice(lattice), queries, ends }
    }

    fn lattice(&self) -> &LatticeWorld {
        self.world.as_lattice().unwrap()
    }

    /// The sum of costs, and what was counted in all.
    fn sum(&self, mut solve: impl FnMut(u32, u32) -> Report<Octile>) -> (u64, Counters) {
        let mut sum = 0;
        let mut counted = Counters::default();
        for &[start, goal] in &self.queries {
            let report = solve(start, goal);
            sum += u64::from(ScaledOctile::scaled(report.outcome.route().unwrap().cost));
            counted.expansions += report.counters.expansions;
            counted.generated += report.counters.generated;
        }
        (sum, counted)
    }

    fn walked(&self, search: &mut OctileAstar) -> (u64, Counters) {
        self.sum(|start, goal| search.solve(start, goal, u64::MAX))
    }

    fn jumped(&self, search: &mut JumpSearch, jumps: &impl Jumps) -> (u64, Counters) {
        self.sum(|start, goal| search.solve(jumps, start, goal, u64::MAX))
    }

    fn planned(&self, planner: &dyn Planner) -> f64 {
        let plan = |[start, goal]: &[Vec<f64>; 2]| {
            let request =
                Request { world: &self.world, start, goal, expansions: u64::MAX, seed: 0, trace: false };
            planner.plan(&request).unwrap().cost.unwrap()
        };
        self.ends.iter().map(plan).sum()
    }

    fn by_the_crate(&self) -> u64 {
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

fn planner(name: &str) -> Box<dyn Planner> {
    let Build::Planner(build) = planner::find(name).unwrap().build else { panic!("it is a planner") };
    build(&Settings::composed("a bench", toml::Table::new())).unwrap()
}

fn compare(group: &mut BenchmarkGroup<'_, CpuTime>, name: &str, posed: &Posed) {
    let world = posed.lattice();
    let grid = posed.lattice().grid();
    let lines = JumpLines::new(world);
    let table = JumpTable::new(world);
    let mut walk = OctileAstar::new(world.moves()).unwrap();
    let mut jump = JumpSearch::new([grid.width(), grid.height()]).unwrap();
    let (truth, cells) = posed.walked(&mut walk);
    let (scanned, points) = posed.jumped(&mut jump, &lines);
    assert_eq!([scanned, posed.jumped(&mut jump, &table).0, posed.by_the_crate()], [truth; 3]);
    let planners = ["astar_octile", "jps", "jps_plus"].map(|name| (name, planner(name)));
    let exact = posed.planned(planners[0].1.as_ref());
    assert!(
        planners.iter().all(|(_, planner)| (posed.planned(planner.as_ref()) - exact).abs() < 1e-9 * exact)
    );
    println!(
        "{name}: {} cells and {} jump points expanded, {} generated; {} and {} bytes prepared",
        cells.expansions,
        points.expansions,
        points.generated,
        lines.bytes(),
        table.bytes()
    );
    group.bench_function("astar_octile", |bencher| bencher.iter(|| posed.walked(&mut walk)));
    group.bench_function("jps", |bencher| bencher.iter(|| posed.jumped(&mut jump, &lines)));
    group.bench_function("jps_plus", |bencher| bencher.iter(|| posed.jumped(&mut jump, &table)));
    for (name, planner) in &planners {
        let name = format!("planner_{name}");
        group.bench_function(name, |bencher| bencher.iter(|| posed.planned(planner.as_ref())));
    }
    group.bench_function("prepare_astar_octile", |bencher| {
        bencher.iter(|| OctileAstar::new(world.moves()).unwrap());
    });
    group.bench_function("prepare_jps", |bencher| bencher.iter(|| JumpLines::new(world)));
    group.bench_function("prepare_jps_plus", |bencher| bencher.iter(|| JumpTable::new(world)));
    group.bench_function("pathfinding", |bencher| bencher.iter(|| posed.by_the_crate()));
}

fn jps(criterion: &mut Criterion<CpuTime>) {
    let mut maps = vec![
        ("random", independent_cells(&mut seed::stream(2), SIZE_CELLS, 0.3, &[]).unwrap()),
        ("rectangles", rectangles(&mut seed::stream(3), SIZE_CELLS, 250, [4, 40], &[]).unwrap()),
        ("rooms", rooms(&mut seed::stream(4), SIZE_CELLS, 31, 0.8).unwrap()),
        ("streets", streets(&mut seed::stream(5), SIZE_CELLS, [10, 50], 7, 3).unwrap()),
    ];
    if let Ok(path) = std::env::var("REPLAN_BENCH_MAP") {
        let grid = read_movingai_map(Path::new(&path)).unwrap_or_else(|error| panic!("{error}"));
        maps.push(("map", grid));
    }
    for (name, grid) in maps {
        let mut group = criterion.benchmark_group(name);
        group
            .sample_size(10)
            .warm_up_time(Duration::from_millis(300))
            .measurement_time(Duration::from_secs(2));
        compare(&mut group, name, &Posed::new(grid));
        group.finish();
    }
}

criterion_group! {
    name = benches;
    config = cpu::criterion();
    targets = jps
}
criterion_main!(benches);
