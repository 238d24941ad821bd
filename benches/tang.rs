//! What the tang2023 studies spend their time on.
//!
//! - `segment_polyhedron`: our exact distance against parry3d's, on the same random segments and solids, whose
//!   answers are held equal first;
//! - `lattice26`: the 26-connected A* on the stand-in Environment 1; the throughput is in expansions, so that the time of
//!   one is its inverse;
//! - `keynode`: the improved A* on the stand-in Environments 1 and 4, whole queries;
//! - `posture/path`: the arm along a path in the stand-in scene C1, adjusted; the throughput is in nodes of the path;
//! - `posture/adjusted_node`: the first step of that path whose end needs another posture than its start, by itself, with
//!   the choice of the branch that every path begins with.

use base::seed;
use base::settings::Settings;
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use engine::geometry::{Convex, Segment, Vec3, distance_segment_convex};
use engine::kinematics::Robot;
use engine::planner::{self, Build, Ending, Plan, Planner, Request, Stage};
use engine::space::polyhedra::{CarriedArm, read_scene};
use engine::space::{PolyhedraWorld, World};
use parry3d::math::{Pose, Vector};
use parry3d::query;
use parry3d::shape::{self, ConvexPolyhedron};
use rand::RngExt as _;
use std::{hint::black_box, path::Path, time::Duration};

fn file(name: &str) -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("data").join(name)
}

fn world(scene: &str, growth: f64) -> PolyhedraWorld {
    let scene = read_scene(&file(&format!("scenes/{scene}.toml"))).unwrap();
    PolyhedraWorld::new(scene.bodies, scene.domain, 1.0, growth).unwrap()
}

fn settings(text: &str) -> Settings {
    Settings::composed("bench", toml::from_str(text).unwrap())
}

fn planner(name: &str, text: &str) -> Box<dyn Planner> {
    let Build::Planner(build) = planner::find(name).unwrap().build else { panic!("{name} is a stage") };
    build(&settings(text)).unwrap()
}

fn stage(name: &str, text: &str) -> Box<dyn Stage> {
    let Build::Stage(build) = planner::find(name).unwrap().build else { panic!("{name} is a planner") };
    build(&settings(text)).unwrap()
}

fn request<'a>(world: &'a World, ends: &'a [[f64; 3]; 2]) -> Request<'a> {
    Request { world, start: &ends[0], goal: &ends[1], expansions: 5_000_000, seed: 0, trace: false }
}

fn distances(criterion: &mut Criterion) {
    let mut stream = seed::stream(31);
    let mut pairs = Vec::new();
    while pairs.len() < 200 {
        let mut point = |reach: f64| Vec3::from_fn(|_, _| stream.random_range(-reach..reach));
        let solid = Convex::cuboid(point(2.0), Vec3::new(3.0, 4.0, 5.0)).unwrap();
        let segment = Segment::new(point(9.0), point(9.0));
        let vector = |v: &Vec3| Vector::new(v.x, v.y, v.z);
        let corners: Vec<Vector> = solid.vertices().iter().map(vector).collect();
        let theirs = (
            shape::Segment::new(vector(&segment.a), vector(&segment.b)),
            ConvexPolyhedron::from_convex_hull(&corners).unwrap(),
        );
        pairs.push((segment, solid, theirs));
    }
    let parry = |(segment, solid): &(shape::Segment, ConvexPolyhedron)| {
        query::distance(&Pose::IDENTITY, segment, &Pose::IDENTITY, solid).unwrap().distance
    };
    for (segment, solid, theirs) in &pairs {
        assert!((distance_segment_convex(segment, solid) - parry(theirs)).abs() < 1e-5);
    }
    let mut group = criterion.benchmark_group("segment_polyhedron");
    group.bench_function("exact_x200", |bencher| {
        bencher.iter(|| {
            pairs.iter().map(|(segment, solid, _)| distance_segment_convex(segment, solid)).sum::<f64>()
        });
    });
    group.bench_function("parry3d_x200", |bencher| {
        bencher.iter(|| pairs.iter().map(|(_, _, theirs)| parry(theirs)).sum::<f64>());
    });
    group.finish();
}

fn searches(criterion: &mut Criterion) {
    let simple = World::Polyhedra(Box::new(world("tang_e1", 0.0)));
    let many = World::Polyhedra(Box::new(world("tang_e4", 0.0)));
    let simple_ends = [[10.0, 10.0, 10.0], [90.0, 85.0, 80.0]];
    let many_ends = [[6.0, 6.0, 6.0], [94.0, 93.0, 92.0]];
    let star = planner("lattice26_astar", "checked = 'segments'\nties = 'fifo'");
    let key = planner("keynode_astar", "search = 'open_list'\ncluster = true\nlast_resort = true");
    let found = star.plan(&request(&simple, &simple_ends)).unwrap();
    let expansions = found.counts["expansions"].as_f64() as u64;
    let mut group = criterion.benchmark_group("lattice26");
    group.sample_size(10).throughput(Throughput::Elements(expansions));
    group.bench_function("e1", |b| b.iter(|| black_box(star.plan(&request(&simple, &simple_ends)))));
    group.finish();
    let mut group = criterion.benchmark_group("keynode");
    group.sample_size(10);
    group.bench_function("e1", |b| b.iter(|| black_box(key.plan(&request(&simple, &simple_ends)))));
    group.bench_function("e4", |b| b.iter(|| black_box(key.plan(&request(&many, &many_ends)))));
    group.finish();
}

fn postures(criterion: &mut Criterion) {
    let robot = Robot::load(&file("robots/aubo_i10.toml")).unwrap();
    let scene = read_scene(&file("scenes/tang_c1.toml")).unwrap();
    let domain = scene.domain;
    let (bodies, support) = scene.with_arm().unwrap();
    let arm = CarriedArm::new(&robot, "paper", &support).unwrap();
    let world = PolyhedraWorld::new(bodies, domain, 1.0, 7.0).unwrap().with_arm(arm);
    let world = World::Polyhedra(Box::new(world));
    let ends = [[70.0, -46.0, 36.0], [70.0, 41.0, 51.0]];
    let key = planner("keynode_astar", "search = 'open_list'\ncluster = true\nlast_resort = true");
    let posture = stage(
        "posture",
        "adjust = true\nsign = 'down'\nclamp = 'floor'\ndistance = 'exact'\npose = 'inverse'\ndamping = 0.02\n\
         act_cm = 2.0\nd0_cm = 5.0\nstep_rad = 0.03\niterations = 20\nbounds_rad = [0.2, 0.2, 0.1]\n\
         bounds = 'per_node'\nrecovery_rad = 0.02\nbranches = 'all'\ndiagnose = false",
    );
    let request = request(&world, &ends);
    let tip = key.plan(&request).unwrap();
    let nodes = tip.path.len() as u64;
    let steps = tip.path.windows(2).map(|pair| Plan { path: pair.to_vec(), ..tip.clone() });
    let is_adjusted = |step: &Plan| {
        let plan = posture.refine(&request, step.clone());
        plan.ending == Ending::Solved && plan.counts["adjustments"].as_f64() > 0.0
    };
    let step = steps.into_iter().find(is_adjusted).expect("the path passes an obstacle");
    for (name, path, elements) in [("path", tip, nodes), ("adjusted_node", step, 1)] {
        let mut group = criterion.benchmark_group("posture");
        group.sample_size(10).throughput(Throughput::Elements(elements));
        group.bench_function(name, |b| b.iter(|| black_box(posture.refine(&request, path.clone()))));
        group.finish();
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().warm_up_time(Duration::from_millis(500)).measurement_time(Duration::from_secs(2));
    targets = distances, searches, postures
}
criterion_main!(benches);
