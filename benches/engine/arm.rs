//! The six-axis arm in the cell of fu2018: what studies ask of it, against parry3d where parry3d can be asked the same.
//!
//! - `configuration/ours` and `/parry3d`: is a random configuration free? Both place the same capsules by the same forward
//!   kinematics; parry3d's capsules are asked behind the same axis-aligned boxes. The two are held to equal answers
//!   first, but for the false contacts between capsules that parry3d 0.31 reports, which are counted and printed.
//! - `configuration/mujoco`: the same from MuJoCo's Python package, which makes contacts of them: boxes are meshes there.
//! - `configuration/ours_4096` and `/ours_4096_at_once`: 4096 of them, one by one with their limits and all at once, in lanes.
//! - `motion/ours` and `/parry3d`: a straight motion in joint space between near configurations, every state at even steps of
//!   1/32 rad. Ours also covers what lies between the states (see `space::cell`), parry3d's states alone are asked, so
//!   neither is a proof, and ours does more.
//! - `motion/tool_line`: a local path with inverse kinematics between neighbours within 500 mm, contacts and all.
//! - `forward`, `inverse_on`, `inverse_all`: kinematics.
//! - `roadmap/task_space_1500`: 1500 samples, edges up to 500 mm that end in their own configuration.
//! - `roadmap/joint_space_1500`: 1500 samples, each tried with its 12 nearest in joint space on a straight line there at steps
//!   of 1/32 rad; the search for neighbours is part of it. `roadmap/parry3d_1500`: the same pairs, given, and parry3d's states.
//! - `query/original` and `/improved`: one query on that roadmap, its local paths already known.

mod cpu;
#[path = "../peer/mod.rs"]
mod peer;

use base::seed;
use base::settings::Settings;
use cpu::CpuTime;
use criterion::{Criterion, criterion_group, criterion_main};
use parry3d::math::{Pose as ParryPose, Vector};
use parry3d::query::intersection_test;
use parry3d::shape::{self, SharedShape};
use peer::Peer;
use rand::RngExt as _;
use replan_engine::geometry::{Aabb, Capsule, Solid, Vec3};
use replan_engine::kinematics::{Joints, Robot};
use replan_engine::planner::{self, Build, Planner, Request};
use replan_engine::space::World;
use replan_engine::space::cell::{Cell, EdgeEnd, LineRules, Lines, Path, Pose, Scene, Scratch, Standing};
use replan_engine::space::roadmap::{Counted, Local, Near, Roadmap, Sample};
use std::f64::consts::PI;
use std::hint::black_box;
use std::time::Duration;

const SEED: u64 = 5;

fn cell() -> Cell {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data");
    let robot = Robot::load(&root.join("robots/motoman_up6.toml")).expect("the robot is there");
    let scene = Scene::load(&root.join("scenes/fu2018_cell.toml")).expect("the scene is there");
    Cell::new(robot, scene, true)
}

fn rules() -> LineRules {
    LineRules {
        path: Path::Tool,
        step_m: 0.02,
        step_rad: 4_f64.to_radians(),
        jump_rad: 20_f64.to_radians(),
        turn_rad: PI,
        speed: None,
        end: EdgeEnd::Own,
    }
}

/// Straight lines in joint space at steps of at most 1/32 rad.
fn joint_rules() -> LineRules {
    LineRules { path: Path::Joints, step_rad: 1.0 / 32.0, ..rules() }
}

fn draw(stream: &mut seed::Stream) -> Joints {
    let ranges =
        [[-170.0, 170.0], [-180.0, 65.0], [-190.0, 170.0], [-180.0, 180.0], [-135.0, 135.0], [-180.0, 180.0]];
    ranges.map(|[low, high]: [f64; 2]| stream.random_range(low..high).to_radians())
}

fn samples(cell: &Cell, count: usize) -> Vec<Sample> {
    let mut stream = seed::stream(SEED);
    let mut found = Vec::new();
    while found.len() < count {
        let q = draw(&mut stream);
        if cell.is_free(&q) {
            found.push(Sample { config: q.to_vec(), drawn_after: found.len() as u32 });
        }
    }
    found
}

/// The cell's obstacles as parry3d has them, behind their boxes.
struct Parry {
    obstacles: Vec<(Aabb, ParryPose, SharedShape)>,
}

fn vector(v: &Vec3) -> Vector {
    Vector::new(v.x, v.y, v.z)
}

fn parry_capsule(c: &Capsule) -> shape::Capsule {
    shape::Capsule::new(vector(&c.segment.a), vector(&c.segment.b), c.radius)
}

impl Parry {
    fn new(cell: &Cell) -> Self {
        let obstacle = |solid: &Solid| {
            let (at, shape) = match solid {
                Solid::Box(b) => {
                    let middle = vector(&b.frame().origin);
                    (
                        ParryPose::from_translation(middle),
                        SharedShape::new(shape::Cuboid::new(vector(b.half()))),
                    )
                }
                _ => {
                    (ParryPose::IDENTITY, SharedShape::new(shape::HalfSpace::new(Vector::new(0.0, 0.0, 1.0))))
                }
            };
            (solid.aabb(), at, shape)
        };
        Self { obstacles: cell.scene().obstacles().iter().map(|o| obstacle(&o.solid)).collect() }
    }

    fn touches(&self, cell: &Cell, placed: &[Capsule]) -> bool {
        let parts = cell.body().parts().iter().zip(placed).filter(|(part, _)| !part.is_self_only());
        let with_scene = parts.into_iter().any(|(_, capsule)| {
            let bounds = Aabb::of_capsule(capsule);
            let own = parry_capsule(capsule);
            self.obstacles.iter().any(|(reach, at, shape)| {
                reach.overlaps(&bounds)
                    && intersection_test(&ParryPose::IDENTITY, &own, at, &**shape)
                        .expect("parry knows these")
                        .intersecting
            })
        });
        with_scene
            || cell.self_pairs().iter().any(|[a, b]| {
                let overlap = Aabb::of_capsule(&placed[*a]).overlaps(&Aabb::of_capsule(&placed[*b]));
                let [p, q] = [a, b].map(|i| parry_capsule(&placed[*i]));
                overlap
                    && intersection_test(&ParryPose::IDENTITY, &p, &ParryPose::IDENTITY, &q)
                        .expect("parry knows these")
                        .intersecting
            })
    }
}

impl Parry {
    /// Whether no state at even steps of at most 1/32 rad is in contact, from the middle outwards.
    fn is_free_along(&self, cell: &Cell, from: &Joints, to: &Joints) -> bool {
        let longest = from.iter().zip(to).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let steps = (longest * 32.0).ceil().max(1.0) as usize;
        let mut placed = Vec::new();
        let middle = steps.div_ceil(2);
        (0..=steps).all(|i| {
            let state = if i % 2 == 0 { middle + i / 2 } else { middle - i.div_ceil(2) };
            let share = state as f64 / steps as f64;
            let q = std::array::from_fn(|joint| from[joint] + (to[joint] - from[joint]) * share);
            cell.place(&q, &mut placed);
            !self.touches(cell, &placed)
        })
    }
}

fn configurations(c: &mut Criterion<CpuTime>) {
    let cell = cell();
    let mut stream = seed::stream(SEED);
    let parry = Parry::new(&cell);
    let drawn: Vec<Joints> = (0..4096).map(|_| draw(&mut stream)).collect();
    let mut placed = Vec::new();
    let mut differ = 0;
    let mut free = 0;
    for q in &drawn {
        cell.place(q, &mut placed);
        let ours = cell.standing(&placed, |_| 0.0) == Standing::Contact;
        free += u32::from(!ours);
        differ += u32::from(ours != parry.touches(&cell, &placed));
    }
    println!("configuration: {free} of {} free; parry3d differs on {differ}", drawn.len());
    assert!(differ < 60, "{differ} answers differ");
    let mut group = c.benchmark_group("configuration");
    let mut next = (0..drawn.len()).cycle();
    group.bench_function("ours", |b| {
        b.iter(|| {
            cell.place(&drawn[next.next().expect("endless")], &mut placed);
            black_box(cell.standing(&placed, |_| 0.0))
        });
    });
    group.bench_function("parry3d", |b| {
        b.iter(|| {
            cell.place(&drawn[next.next().expect("endless")], &mut placed);
            black_box(parry.touches(&cell, &placed))
        });
    });
    if let Some(mut mujoco) = mujoco(&cell, &drawn) {
        group.bench_function("mujoco", |b| b.iter_custom(|rounds| mujoco.time(rounds)));
    }
    let singly = || drawn.iter().map(|q| cell.is_free(q)).collect::<Vec<_>>();
    assert_eq!(cell.are_free(&drawn), singly());
    group.bench_function("ours_4096", |b| b.iter(|| black_box(singly())));
    group.bench_function("ours_4096_at_once", |b| b.iter(|| black_box(cell.are_free(&drawn))));
    group.finish();
}

/// MuJoCo on the cross-check's model of the same cell, once it has given the same answers.
fn mujoco(cell: &Cell, drawn: &[Joints]) -> Option<Peer> {
    const SCRIPT: [&str; 3] =
        ["crosscheck/venv", "mujoco_states.py", "`cargo run -- crosscheck fu2018` makes it"];
    const MODEL: &str = "crosscheck/fu2018/up6-in-cell/scene.xml";
    let (peer, touching) = Peer::start(SCRIPT, &[MODEL], &serde_json::json!(drawn))?;
    let touching: Vec<bool> = serde_json::from_value(touching).expect("one answer a configuration");
    let mut placed = Vec::new();
    let mut touches = |q: &Joints| {
        cell.place(q, &mut placed);
        cell.standing(&placed, |_| 0.0) == Standing::Contact
    };
    let differ = drawn.iter().zip(&touching).filter(|(q, touching)| touches(q) != **touching).count();
    println!("configuration: MuJoCo differs on {differ}");
    assert!(touching.len() == drawn.len() && differ < 10, "{differ} answers differ");
    Some(peer)
}

fn kinematics(c: &mut Criterion<CpuTime>) {
    let cell = cell();
    let mut stream = seed::stream(SEED);
    let arm = cell.robot().arm();
    let drawn: Vec<Joints> = (0..1024).map(|_| draw(&mut stream)).collect();
    let mut next = (0..drawn.len()).cycle();
    let mut group = c.benchmark_group("kinematics");
    group.bench_function("forward", |b| {
        b.iter(|| black_box(arm.chain().forward(&drawn[next.next().expect("endless")])));
    });
    let poses: Vec<_> = drawn.iter().map(|q| (arm.chain().forward(q), arm.branch_of(q), *q)).collect();
    group.bench_function("inverse_on", |b| {
        b.iter(|| {
            let (tool, branch, q) = &poses[next.next().expect("endless")];
            black_box(arm.inverse_on(tool, *branch, q))
        });
    });
    group.bench_function("inverse_all", |b| {
        b.iter(|| {
            let (tool, _, q) = &poses[next.next().expect("endless")];
            black_box(arm.inverse(tool, q))
        });
    });
    group.finish();
}

fn motions(c: &mut Criterion<CpuTime>) {
    let lines = Lines::new(cell(), rules());
    let samples = samples(lines.cell(), 400);
    let poses: Vec<Pose> =
        samples.iter().map(|s| lines.pose(&s.config.as_slice().try_into().expect("six angles"))).collect();
    let near = |a: &Pose, b: &Pose| (a.tool.origin - b.tool.origin).norm() <= 0.5;
    let mut scratch = Scratch::default();
    let mut joined = Vec::new();
    for (i, a) in poses.iter().enumerate() {
        for b in poses[..i].iter().filter(|b| near(a, b)) {
            if lines.join(a, b, &mut scratch).is_ok() {
                joined.push((*a, *b));
            }
        }
    }
    println!("motion: {} free local paths", joined.len());
    let mut next = (0..joined.len()).cycle();
    let mut group = c.benchmark_group("motion");
    group.bench_function("tool_line", |b| {
        b.iter(|| {
            let (from, to) = &joined[next.next().expect("endless")];
            black_box(lines.join(from, to, &mut scratch))
        });
    });
    let lines = Lines::new(cell(), joint_rules());
    let parry = Parry::new(lines.cell());
    let pairs = neighbours(&samples);
    let mut next = (0..pairs.len()).cycle();
    let ends = |pair: usize| pairs[pair].map(|i| poses[i]);
    let free = pairs.iter().filter(|[a, b]| lines.join(&poses[*a], &poses[*b], &mut scratch).is_ok()).count();
    println!("motion: {free} of {} straight motions in joint space are free", pairs.len());
    group.bench_function("ours", |b| {
        b.iter(|| {
            let [from, to] = ends(next.next().expect("endless"));
            black_box(lines.join(&from, &to, &mut scratch))
        });
    });
    group.bench_function("parry3d", |b| {
        b.iter(|| {
            let [from, to] = ends(next.next().expect("endless"));
            black_box(parry.is_free_along(lines.cell(), &from.q, &to.q))
        });
    });
    group.finish();
}

/// How many of the nearest samples in joint space each is tried with.
const NEIGHBOURS: usize = 12;

/// Each sample with its nearest in joint space, every pair once.
fn neighbours(samples: &[Sample]) -> Vec<[usize; 2]> {
    let square = |a: &Sample, b: &Sample| -> f64 {
        a.config.iter().zip(&b.config).map(|(a, b)| (a - b) * (a - b)).sum()
    };
    let mut pairs = Vec::new();
    for (i, sample) in samples.iter().enumerate() {
        let mut others: Vec<usize> = (0..samples.len()).filter(|other| *other != i).collect();
        others.sort_by(|a, b| square(sample, &samples[*a]).total_cmp(&square(sample, &samples[*b])));
        pairs.extend(others[..NEIGHBOURS].iter().map(|j| [i.min(*j), i.max(*j)]));
    }
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}

fn joint_roadmap(c: &mut Criterion<CpuTime>) {
    let lines = Lines::new(cell(), joint_rules());
    let samples = samples(lines.cell(), 1500);
    let built = || {
        let local = Local::Arm(Box::new(lines.clone()));
        Roadmap::build(local, samples.clone(), Near::Nearest(NEIGHBOURS), Counted::Accepted)
    };
    let pairs = neighbours(&samples);
    let tally = *built().tally();
    assert_eq!(tally.pairs, pairs.len() as u64);
    let parry = Parry::new(lines.cell());
    let places: Vec<Joints> =
        samples.iter().map(|s| s.config.as_slice().try_into().expect("six angles")).collect();
    let by_parry = || {
        let is_edge = |[a, b]: &&[usize; 2]| parry.is_free_along(lines.cell(), &places[*a], &places[*b]);
        pairs.iter().filter(is_edge).count()
    };
    println!(
        "joint-space roadmap: {} of {} pairs are edges, {} by parry3d",
        tally.edges,
        pairs.len(),
        by_parry()
    );
    let mut group = c.benchmark_group("roadmap");
    group.sample_size(10).measurement_time(Duration::from_secs(4));
    group.bench_function("joint_space_1500", |b| b.iter(|| black_box(built())));
    group.bench_function("parry3d_1500", |b| b.iter(|| black_box(by_parry())));
    group.finish();
}

fn roadmaps(c: &mut Criterion<CpuTime>) {
    let lines = Lines::new(cell(), rules());
    let samples = samples(lines.cell(), 1500);
    let built = || {
        Roadmap::build(
            Local::Arm(Box::new(lines.clone())),
            samples.clone(),
            Near::Places(500.0),
            Counted::Accepted,
        )
    };
    let mut group = c.benchmark_group("roadmap");
    group.sample_size(10).measurement_time(Duration::from_secs(4));
    group.bench_function("task_space_1500", |b| b.iter(|| black_box(built())));
    group.finish();
    let world = World::Roadmap(Box::new(built()));
    let pose = |degrees: [f64; 6]| degrees.map(f64::to_radians).to_vec();
    let (start, goal) =
        (pose([-41.0, -49.0, 2.0, -7.0, 47.0, -41.0]), pose([56.0, -78.0, 45.0, -7.0, 33.0, 56.0]));
    let mut group = c.benchmark_group("query");
    for (name, shot) in [("original", "never"), ("improved", "before_expansion")] {
        let planner = planner(shot);
        let request =
            Request { world: &world, start: &start, goal: &goal, expansions: 10_000, seed: 0, trace: false };
        group.bench_function(name, |b| b.iter(|| black_box(planner.plan(&request))));
    }
    group.finish();
}

fn planner(shot: &str) -> Box<dyn Planner> {
    let text = format!(
        "samples = 1500\nneighbour_mm = 500\ncost = 'hops'\ngoal_shot = '{shot}'\npath = 'parents'\n"
    );
    let Some(Build::Planner(build)) = planner::find("roadmap_astar").map(|entry| entry.build) else {
        unreachable!("the registry has the planner");
    };
    let table = text.parse().expect("the settings are TOML");
    build(&Settings::composed("a bench", table)).expect("the settings are the planner's")
}

criterion_group! {
    name = benches;
    config = cpu::criterion().measurement_time(Duration::from_secs(2)).warm_up_time(Duration::from_millis(500));
    targets = configurations, kinematics, motions, roadmaps, joint_roadmap
}
criterion_main!(benches);
