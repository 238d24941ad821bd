//! The planar arm: A* over tip positions against the crate `pathfinding`.
//!
//! The workspace is that of the study (101 × 51 points, 4 discs). In group `astar/<neighbourhood>` both solve the study's
//! query with hops judged by their ends, and in `swept/<neighbourhood>` with every hop swept, over the same free points and
//! steps with Euclidean costs and heuristic; they are held to equal costs before anything is timed. The throughput is in
//! expansions of ours, so that the time of one expansion is its inverse, and the crate's time for the same query is on the
//! same footing. `ours` is the planner that studies call; it also counts what plain lists would compare. The crate gets
//! `u32` nodes, totally ordered `f64` costs and successors from an unallocated iterator.

mod cpu;
#[path = "../shared/total.rs"]
mod total;

use base::grid::{CornerRule, Offsets};
use base::settings::Settings;
use cpu::CpuTime;
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use pathfinding::prelude::astar;
use replan_engine::geometry::Vec2;
use replan_engine::geometry::planar::{Circle, Touch};
use replan_engine::kinematics::planar_2r::{ElbowRule, Planar2r};
use replan_engine::planner::{self, Build, Planner, Request};
use replan_engine::space::{ArmRules, ArmWorld, HopRule, Obstacle, TipLattice, World};
use std::{hint::black_box, time::Duration};
use total::Total;

const ENDS: [[f64; 2]; 2] = [[49.0, 3.0], [0.0, 45.0]];

fn workspace(hop: HopRule) -> ArmWorld {
    let rules = ArmRules {
        arm: Planar2r::new(30.0, 20.0).expect("links have lengths"),
        elbow: ElbowRule::NegativeQ2,
        lattice: TipLattice::new([-50.0, 50.0], [0.0, 50.0], 1.0).expect("1 divides 100 and 50"),
        inner_radius_cm: 20.0,
        q2_limit_rad: f64::INFINITY,
        touch: Touch::Contact,
        corner_rule: CornerRule::Allow,
        hop,
    };
    let discs = [[35.0, 18.0], [7.0, 35.0], [-13.0, 35.0], [-30.0, 20.0]];
    let disc = |[x, y]: [f64; 2]| Circle::new(Vec2::new(x, y), 5.0).expect("a disc has a size");
    ArmWorld::new(rules, discs.map(|at| Obstacle::Circle(disc(at))).to_vec())
}

fn planner(shape: &str, radius: u8) -> Box<dyn Planner> {
    let text = format!(
        "neighbourhood = {{ shape = '{shape}', radius_cells = {radius} }}\nopen_node = 'lowered'\nties = 'fifo'"
    );
    let settings = Settings::composed("a bench", toml::from_str(&text).expect("the text is TOML"));
    let Build::Planner(build) = planner::find("lattice_astar").expect("it is registered").build else {
        panic!("lattice_astar is a planner");
    };
    build(&settings).expect("the settings are right")
}

fn crate_cost(world: &ArmWorld, offsets: &Offsets) -> f64 {
    let grid = world.grid();
    let [start, goal] = ENDS.map(|at| world.rules().lattice.cell(&at).expect("a point of the lattice"));
    let [gx, gy] = grid.xy(goal);
    let length = |dx: i32, dy: i32| Total(f64::from(dx * dx + dy * dy).sqrt());
    let successors = |&cell: &u32| {
        let [x, y] = grid.xy(cell);
        offsets.steps().iter().filter_map(move |&[dx, dy]| {
            let to = grid.cell(x + dx, y + dy)?;
            (grid.is_free(to) && world.may_hop(cell, to)).then(|| (to, length(dx, dy)))
        })
    };
    let heuristic = |&cell: &u32| {
        let [x, y] = grid.xy(cell);
        length(gx - x, gy - y)
    };
    astar(&start, successors, heuristic, |cell| *cell == goal).expect("the goal can be reached").1.0
}

/// A neighbourhood by its name: the shape and the radius in cells.
const NEIGHBOURHOODS: [(&str, &str, u8); 6] = [
    ("8", "square", 1),
    ("24", "square", 2),
    ("48", "square", 3),
    ("80", "square", 4),
    ("chs_4", "disc", 4),
    ("chs_6", "disc", 6),
];

fn against_the_crate(criterion: &mut Criterion<CpuTime>) {
    for (family, hop) in [("astar", HopRule::EndPoints), ("swept", HopRule::Continuous)] {
        let arm = workspace(hop);
        let world = World::Arm(workspace(hop));
        for (name, shape, radius) in NEIGHBOURHOODS {
            compare(criterion, &format!("{family}/{name}"), (&arm, &world), (shape, radius));
        }
    }
}

fn compare(
    criterion: &mut Criterion<CpuTime>,
    name: &str,
    (arm, world): (&ArmWorld, &World),
    (shape, radius): (&str, u8),
) {
    let offsets = if shape == "disc" { Offsets::disc(radius) } else { Offsets::square(radius) };
    let planner = planner(shape, radius);
    let [start, goal] = &ENDS;
    let request = Request { world, start, goal, expansions: u64::MAX, seed: 0, trace: false };
    let plan = planner.plan(&request).expect("start and goal are free");
    let ours = plan.cost.expect("the goal can be reached");
    let theirs = crate_cost(arm, &offsets);
    assert!((ours - theirs).abs() < 1e-9, "{name}: {ours}, not {theirs}");
    let mut group = criterion.benchmark_group(name);
    group.throughput(Throughput::Elements(plan.counts["expansions"].as_f64() as u64));
    group.bench_function("ours", |b| b.iter(|| planner.plan(black_box(&request))));
    group.bench_function("pathfinding", |b| b.iter(|| crate_cost(black_box(arm), black_box(&offsets))));
    group.finish();
}

criterion_group! {
    name = benches;
    config = cpu::criterion().sample_size(20).measurement_time(Duration::from_secs(2)).warm_up_time(Duration::from_millis(500));
    targets = against_the_crate
}
criterion_main!(benches);
