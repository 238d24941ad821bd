//! 8-connected A* without corner cutting against the crate `pathfinding`, in its best form and as people use it, and other peers.
//!
//! Groups: `30x30` (20 % blocked), `512_random` (30 % blocked), `512_rectangles`, and `map` for a `MovingAI` map
//! named by `REPLAN_BENCH_MAP`. In each group every entry answers the same queries, drawn among cells that are
//! joined, and all are held to equal costs before anything is timed:
//!
//! - `astar_octile`: [`OctileAstar`] on a map it has seen before;
//! - `planner`: the planner of that name as studies call it, from request to plan, over the same search;
//! - `pathfinding_u32`: the crate with `u32` nodes and costs and successors from legal-move masks, unallocated;
//! - `pathfinding_typical`: the crate with `(x, y)` nodes, `f64` costs and a `Vec` of successors;
//! - `petgraph`: that crate's A* on a graph made before, `u32` costs;
//! - `networkx` and `pathfinding_python`, on `30x30` alone: the Python packages, on a graph and a grid made before.

#[path = "shared/grid_queries.rs"]
mod grid_queries;
#[path = "peer/mod.rs"]
mod peer;
#[path = "shared/total.rs"]
mod total;

use base::grid::{DIRECTIONS, independent_cells, read_movingai_map, rectangles};
use base::seed;
use criterion::{BenchmarkGroup, Criterion, criterion_group, criterion_main, measurement::WallTime};
use engine as ours;
use grid_queries::{Posed, planner};
use ours::search::{OctileAstar, ScaledOctile};
use pathfinding::prelude::astar;
use peer::Peer;
use petgraph::graph::{NodeIndex, UnGraph};
use serde_json::json;
use std::{hint::black_box, path::Path, time::Duration};
use total::Total;

impl Posed {
    fn octile(&self, search: &mut OctileAstar) -> u64 {
        let solve = |&[start, goal]: &[u32; 2]| search.solve(start, goal, u64::MAX);
        self.queries
            .iter()
            .map(solve)
            .map(|report| u64::from(ScaledOctile::scaled(report.outcome.route().unwrap().cost)))
            .sum()
    }

    /// Every cell as a node and every legal step as an edge.
    fn graph(&self) -> UnGraph<(), u32> {
        let mut graph = UnGraph::default();
        let cells: Vec<NodeIndex> =
            (0..self.lattice().grid().cell_count()).map(|_| graph.add_node(())).collect();
        for [from, to] in self.steps() {
            let [x, y] = [from, to].map(|cell| self.lattice().grid().xy(cell));
            let cost = ScaledOctile::distance([x[0].abs_diff(y[0]), x[1].abs_diff(y[1])]);
            // A legal step is legal back: each pair once.
            if from < to {
                graph.add_edge(cells[from as usize], cells[to as usize], cost);
            }
        }
        graph
    }

    fn steps(&self) -> impl Iterator<Item = [u32; 2]> {
        let moves = self.lattice().moves();
        (0..self.lattice().grid().cell_count())
            .filter(|cell| self.lattice().grid().is_free(*cell))
            .flat_map(|from| moves.from_cell(from).map(move |(to, _)| [from, to]))
    }

    fn petgraph(&self, graph: &UnGraph<(), u32>) -> u64 {
        let place = |cell: u32| self.lattice().grid().xy(cell);
        let solve = |&[start, goal]: &[u32; 2]| {
            let [x, y] = place(goal);
            let estimate = |node: NodeIndex| {
                let at = place(node.index() as u32);
                ScaledOctile::distance([at[0].abs_diff(x), at[1].abs_diff(y)])
            };
            let start = NodeIndex::new(start as usize);
            let is_goal = |node: NodeIndex| node.index() == goal as usize;
            let (cost, path) =
                petgraph::algo::astar(graph, start, is_goal, |edge| *edge.weight(), estimate).unwrap();
            black_box(path);
            u64::from(cost)
        };
        self.queries.iter().map(solve).sum()
    }

    /// The map and the queries as `peer/grids.py` reads them.
    fn question(&self, package: &str) -> serde_json::Value {
        let grid = self.lattice().grid();
        let row = |y| (0..grid.width()).map(|x| u8::from(grid.is_free(y * grid.width() + x))).collect();
        let rows: Vec<Vec<u8>> = (0..grid.height()).map(row).collect();
        let moves: Vec<_> = self.steps().collect();
        json!({ "package": package, "rows": rows, "moves": moves, "queries": self.queries })
    }

    fn crate_typical(&self) -> f64 {
        let grid = self.lattice().grid();
        let successors = |&(x, y): &(i32, i32)| {
            let mut found = Vec::new();
            for [dx, dy] in DIRECTIONS {
                if !grid.is_free_xy(x + dx, y + dy) {
                    continue;
                }
                if dx == 0 || dy == 0 {
                    found.push(((x + dx, y + dy), Total(1.0)));
                } else if grid.is_free_xy(x + dx, y) && grid.is_free_xy(x, y + dy) {
                    found.push(((x + dx, y + dy), Total(std::f64::consts::SQRT_2)));
                }
            }
            found
        };
        let solve = |&[start, goal]: &[u32; 2]| {
            let [start, goal] = [start, goal].map(|cell| grid.xy(cell)).map(|[x, y]| (x, y));
            let h = |&(x, y): &(i32, i32)| {
                let (dx, dy) = (f64::from(x.abs_diff(goal.0)), f64::from(y.abs_diff(goal.1)));
                Total(dx.max(dy) + (std::f64::consts::SQRT_2 - 1.0) * dx.min(dy))
            };
            let (path, cost) = astar(&start, successors, h, |&cell| cell == goal).unwrap();
            black_box(path);
            cost.0
        };
        self.queries.iter().map(solve).sum()
    }
}

fn compare(group: &mut BenchmarkGroup<'_, WallTime>, posed: &Posed) {
    let planner = planner("astar_octile");
    let mut fast = OctileAstar::new(posed.lattice().moves()).unwrap();
    let truth = posed.octile(&mut fast);
    assert_eq!(posed.crate_best(), truth);
    let exact = posed.planned(planner.as_ref());
    assert!((exact - posed.crate_typical()).abs() < 1e-6 * exact);
    let in_cells = truth as f64 / f64::from(ScaledOctile::STRAIGHT);
    assert!((exact - in_cells).abs() < 1e-5 * exact, "1393 / 985 is √2 to a millionth");
    let graph = posed.graph();
    assert_eq!(posed.petgraph(&graph), truth);
    group.bench_function("astar_octile", |bencher| bencher.iter(|| posed.octile(&mut fast)));
    group.bench_function("planner", |bencher| bencher.iter(|| posed.planned(planner.as_ref())));
    group.bench_function("pathfinding_u32", |bencher| bencher.iter(|| posed.crate_best()));
    group.bench_function("pathfinding_typical", |bencher| bencher.iter(|| posed.crate_typical()));
    group.bench_function("petgraph", |bencher| bencher.iter(|| posed.petgraph(&graph)));
}

fn compare_python(group: &mut BenchmarkGroup<'_, WallTime>, posed: &Posed) {
    const VENV: [&str; 3] = ["planners/venv", "grids.py", "`planners/python/install` makes it"];
    let truth = posed.octile(&mut OctileAstar::new(posed.lattice().moves()).unwrap());
    for (package, name) in [("networkx", "networkx"), ("pathfinding", "pathfinding_python")] {
        if let Some((mut peer, answer)) = Peer::start(VENV, &[], &posed.question(package)) {
            assert_eq!(answer, json!(truth), "{package}");
            group.bench_function(name, |bencher| bencher.iter_custom(|rounds| peer.time(rounds)));
        }
    }
}

fn grid_astar(criterion: &mut Criterion) {
    let small = independent_cells(&mut seed::stream(1), [30, 30], 0.2, &[]);
    let random = independent_cells(&mut seed::stream(2), [512, 512], 0.3, &[]);
    let boxes = rectangles(&mut seed::stream(3), [512, 512], 250, [4, 40], &[]);
    let mut worlds = vec![
        ("30x30", small.unwrap(), 200),
        ("512_random", random.unwrap(), 8),
        ("512_rectangles", boxes.unwrap(), 8),
    ];
    if let Ok(path) = std::env::var("REPLAN_BENCH_MAP") {
        let grid = read_movingai_map(Path::new(&path)).unwrap_or_else(|error| panic!("{error}"));
        worlds.push(("map", grid, 8));
    }
    for (name, grid, query_count) in worlds {
        let mut group = criterion.benchmark_group(name);
        group
            .sample_size(10)
            .warm_up_time(Duration::from_millis(500))
            .measurement_time(Duration::from_secs(2));
        let posed = Posed::new(grid, query_count);
        compare(&mut group, &posed);
        if name == "30x30" {
            compare_python(&mut group, &posed);
        }
        group.finish();
    }
}

criterion_group!(benches, grid_astar);
criterion_main!(benches);
