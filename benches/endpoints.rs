//! The planar arm: workspace analysis, the enumeration of end points, and A* over tip positions against the crate
//! `pathfinding`.
//!
//! The workspace is that of the study (101 × 51 points, 4 discs). `workspace/identify` is the enumeration of all pairs of
//! end points in both cases under one reading on one thread: worlds, hops, and a flood from every point. In group
//! `astar/<neighbourhood>` both solve the study's query, over the same free points and steps with Euclidean costs and
//! heuristic, and are held to equal costs before anything is timed; the throughput is in expansions of ours, so that the
//! time of one expansion is its inverse, and the crate's time for the same query is on the same footing. `ours` is the planner
//! that studies call; it also counts what plain lists would compare. The crate gets `u32` nodes, totally ordered `f64`
//! costs and successors from an unallocated iterator.

use base::grid::{CornerRule, Offsets};
use base::settings::Settings;
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use engine::geometry::planar::Touch;
use engine::kinematics::planar_2r::{ElbowRule, Planar2r};
use engine::length_inversion::{Match, pairs};
use engine::planner::{self, Build, Planner, Request};
use engine::search::OctileAstar;
use engine::space::{ArmRules, ArmWorld, HopRule, TipLattice, World};
use pathfinding::{num_traits::Zero, prelude::astar};
use replan::study::endpoint_variants::{Case, Variant};
use replan::study::prepared::workspace_map::ShapeSetting;
use std::{cmp::Ordering, hint::black_box, ops::Add, time::Duration};

/// An `f64` in total order, as the crate asks of costs.
#[derive(Clone, Copy, PartialEq)]
struct Total(f64);

impl Eq for Total {}

impl PartialOrd for Total {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Total {
    fn cmp(&self, other: &Self) -> Ordering {
        self.0.total_cmp(&other.0)
    }
}

impl Add for Total {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}

impl Zero for Total {
    fn zero() -> Self {
        Self(0.0)
    }

    fn is_zero(&self) -> bool {
        self.0 == 0.0
    }
}

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
    let obstacles = discs.map(|at| ShapeSetting::Circle.obstacle(at, 10.0).expect("a disc has a size"));
    ArmWorld::new(rules, obstacles.to_vec())
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

fn against_the_crate(criterion: &mut Criterion) {
    let arm = workspace(HopRule::EndPoints);
    let world = World::Arm(workspace(HopRule::EndPoints));
    let [start, goal] = ENDS;
    for (name, shape, radius) in [
        ("8", "square", 1),
        ("24", "square", 2),
        ("48", "square", 3),
        ("80", "square", 4),
        ("chs_4", "disc", 4),
        ("chs_6", "disc", 6),
    ] {
        let offsets = if shape == "disc" { Offsets::disc(radius) } else { Offsets::square(radius) };
        let planner = planner(shape, radius);
        let request = Request {
            world: &world,
            start: &start,
            goal: &goal,
            expansions: u64::MAX,
            seed: 0,
            trace: false,
        };
        let plan = planner.plan(&request).expect("start and goal are free");
        let ours = plan.cost.expect("the goal can be reached");
        let theirs = crate_cost(&arm, &offsets);
        assert!((ours - theirs).abs() < 1e-9, "{name}: {ours}, not {theirs}");
        let expansions = plan.counts["expansions"].as_f64() as u64;
        let mut group = criterion.benchmark_group(format!("astar/{name}"));
        group
            .sample_size(20)
            .measurement_time(Duration::from_secs(2))
            .warm_up_time(Duration::from_millis(500))
            .throughput(Throughput::Elements(expansions));
        group.bench_function("ours", |b| b.iter(|| planner.plan(black_box(&request))));
        group.bench_function("pathfinding", |b| b.iter(|| crate_cost(black_box(&arm), black_box(&offsets))));
        group.finish();
    }
}

fn analysis(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("workspace");
    group.sample_size(20).measurement_time(Duration::from_secs(2)).warm_up_time(Duration::from_millis(500));
    group.bench_function("end_points", |b| b.iter(|| workspace(black_box(HopRule::EndPoints))));
    group.bench_function("continuous", |b| b.iter(|| workspace(black_box(HopRule::Continuous))));
    let moves = workspace(HopRule::EndPoints).eight_moves();
    let mut search = OctileAstar::new(&moves).expect("a workspace is small");
    let start = workspace(HopRule::EndPoints).rules().lattice.cell(&ENDS[0]).expect("a point of the lattice");
    group.bench_function("flood", |b| {
        b.iter(|| {
            let mut sum = 0_u64;
            search.flood(black_box(start), u32::MAX, |_, cost| sum += u64::from(cost));
            sum
        });
    });
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("one thread can be had");
    let base = *workspace(HopRule::EndPoints).rules();
    let cases = cases();
    group.sample_size(10).measurement_time(Duration::from_secs(20));
    for (name, shape) in
        [("circles", "'circle'"), ("any_shape", "['circle', 'square', 'hexagon', 'triangle']")]
    {
        let variant = format!("label = '{name}'\nshape = {shape}\ndiameter_cm = 10");
        let variant: Variant = toml::from_str(&variant).expect("it is TOML");
        group.bench_function(format!("identify/{name}"), |b| {
            b.iter(|| pool.install(|| identified(&variant, &base, black_box(&cases))));
        });
    }
    group.finish();
}

fn cases() -> [Case; 2] {
    [
        Case { obstacles_cm: vec![[35.0, 18.0], [7.0, 35.0], [-13.0, 35.0], [-30.0, 20.0]], hops: [29, 31] },
        Case { obstacles_cm: vec![[41.0, 10.0], [7.0, 40.0], [-16.0, 33.0]], hops: [17, 38] },
    ]
}

fn identified(variant: &Variant, base: &ArmRules, cases: &[Case; 2]) -> usize {
    let grids = variant.grids(base, cases).expect("a disc has a size");
    let rule = if variant.is_free() { Match::Freely } else { Match::ByPlace };
    pairs(&grids, &cases.each_ref().map(Case::target), rule)[0].len()
}

criterion_group!(benches, analysis, against_the_crate);
criterion_main!(benches);
