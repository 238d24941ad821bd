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
#[path = "../shared/grid_queries.rs"]
mod grid_queries;

use base::grid::{independent_cells, read_movingai_map, rectangles, rooms, streets};
use base::seed;
use cpu::CpuTime;
use criterion::{BenchmarkGroup, Criterion, criterion_group, criterion_main};
use grid_queries::{Posed, planner};
use ours::search::{Counters, JumpSearch, Octile, OctileAstar, Report, ScaledOctile};
use ours::space::{JumpLines, JumpTable, Jumps};
use replan_engine as ours;
use std::{path::Path, time::Duration};

const SIZE_CELLS: [u32; 2] = [512, 512];
const QUERIES: usize = 40;

impl Posed {
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
    assert_eq!([scanned, posed.jumped(&mut jump, &table).0, posed.crate_best()], [truth; 3]);
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
    group.bench_function("pathfinding", |bencher| bencher.iter(|| posed.crate_best()));
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
        compare(&mut group, name, &Posed::new(grid, QUERIES));
        group.finish();
    }
}

criterion_group! {
    name = benches;
    config = cpu::criterion();
    targets = jps
}
criterion_main!(benches);
