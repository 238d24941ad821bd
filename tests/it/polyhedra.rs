//! The verifier of joint paths against paths that planners made and someone bent.

use crate::worlds::polyhedra::solids;
use crate::worlds::rods::aubo;
use base::settings::Settings;
use engine::kinematics::Robot;
use engine::planner::{self, Build, Ending, Planner, Request, Stage};
use engine::space::polyhedra::{CarriedArm, read_scene};
use engine::space::{PolyhedraWorld, SupportEntry, World};
use std::path::Path;
use verify::rods::{self, Arm};

fn settings(text: &str) -> Settings {
    Settings::composed("a test", toml::from_str(text).unwrap())
}

fn built(name: &str, text: &str) -> Box<dyn Planner> {
    let Build::Planner(build) = planner::find(name).unwrap().build else { panic!("`{name}` plans") };
    build(&settings(text)).unwrap()
}

fn stage(name: &str, text: &str) -> Box<dyn Stage> {
    let Build::Stage(build) = planner::find(name).unwrap().build else { panic!("`{name}` is a stage") };
    build(&settings(text)).unwrap()
}

/// The arm among the boxes of the scene C1, its tip 7 cm clear of them, the floor elsewhere if `floor_cm` says so.
fn scene(floor_cm: Option<f64>) -> World {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("data");
    let scene = read_scene(&data.join("scenes/tang_c1.toml")).unwrap();
    let domain = scene.domain;
    let (bodies, support) = scene.with_arm().unwrap();
    let robot = Robot::load(&data.join("robots/aubo_i10.toml")).unwrap();
    let entry = |floor_cm: f64| SupportEntry::Pedestal {
        base_mm: [0.0; 3],
        yaw_deg: 0.0,
        floor_mm: floor_cm * 10.0,
        sides_mm: [200.0; 2],
    };
    let support = floor_cm.map_or(support, |floor_cm| entry(floor_cm).support().unwrap());
    let world = PolyhedraWorld::new(bodies, domain, 1.0, 7.0).unwrap();
    World::Polyhedra(Box::new(world.with_arm(CarriedArm::new(&robot, "paper", &support).unwrap())))
}

/// The lowest point of the rods along a path, between its configurations too.
fn lowest_cm(arm: &CarriedArm, path: &[Vec<f64>]) -> f64 {
    let between = |pair: &[Vec<f64>], share: f64| {
        std::array::from_fn(|i| pair[0][i] + (pair[1][i] - pair[0][i]) * share)
    };
    let at = |q: &[f64; 6]| {
        let rods = arm.rods(q).into_iter();
        rods.map(|rod| rod.segment.a.z.min(rod.segment.b.z) - rod.radius).fold(f64::INFINITY, f64::min)
    };
    path.windows(2)
        .flat_map(|pair| (0..=8).map(move |k| at(&between(pair, f64::from(k) / 8.0))))
        .fold(f64::INFINITY, f64::min)
}

const POSTURE: &str = "adjust = true\nsign = 'down'\nclamp = 'floor'\ndistance = 'exact'\npose = 'inverse'\n\
    damping = 0.02\nact_cm = 2.0\nd0_cm = 5.0\nstep_rad = 0.03\niterations = 20\n\
    bounds_rad = [0.2, 0.2, 0.1]\nbounds = 'per_node'\nrecovery_rad = 0.02\nbranches = 'all'\ndiagnose = false";

#[test]
fn no_accepted_path_has_a_rod_below_the_floor() {
    let (start, goal) = ([70.0, -46.0, 36.0], [70.0, 41.0, 51.0]);
    let plan = |world: &World| {
        let request =
            Request { world, start: &start, goal: &goal, expansions: 60_000, seed: 0, trace: false };
        let keynode = "search = 'open_list'\ncluster = true\nlast_resort = true";
        let tip_path = built("keynode_astar", keynode).plan(&request).unwrap();
        stage("posture", POSTURE).refine(&request, tip_path)
    };
    let world = scene(None);
    let carried = world.as_polyhedra().unwrap().arm().unwrap();
    let solids = solids(world.as_polyhedra().unwrap().bodies());
    let free = plan(&world);
    assert_eq!(free.ending, Ending::Solved);
    let lowest = lowest_cm(carried, &free.path);
    assert!(lowest < 0.0, "in C1 rods go below the base, or this test tests nothing: {lowest}");
    // The verifier, with the floor just below the lowest rod and just above it.
    for (floor, is_accepted) in [(lowest - 0.1, true), (lowest + 0.1, false)] {
        let arm = Arm { floor: Some(floor), ..aubo() };
        let refusal =
            rods::Case { arm: &arm, solids: &solids, start, goal }.refuse_path(&free.path, free.cost);
        assert_eq!(refusal.is_none(), is_accepted, "floor at {floor}: {refusal:?}");
    }
    // The planner, with the floor raised: it finds another way or none.
    for raised in [0.5, 3.0, 6.0] {
        let world = scene(Some(lowest + raised));
        let other = plan(&world);
        let above = lowest_cm(carried, &other.path);
        assert!(above >= lowest + raised, "the floor is at {}, a rod at {above}", lowest + raised);
    }
}

#[test]
fn the_verifier_accepts_the_arms_paths_and_none_with_an_angle_bent() {
    let world = scene(None);
    let arm = Arm { floor: Some(-60.0), ..aubo() };
    let solids = solids(world.as_polyhedra().unwrap().bodies());
    let (start, goal) = ([70.0, -46.0, 36.0], [70.0, 41.0, 51.0]);
    let case = rods::Case { arm: &arm, solids: &solids, start, goal };
    let request =
        Request { world: &world, start: &start, goal: &goal, expansions: 60_000, seed: 0, trace: false };
    let keynode = "search = 'open_list'\ncluster = true\nlast_resort = true";
    let tip_path = built("keynode_astar", keynode).plan(&request).unwrap();
    let followed = stage("posture", POSTURE).refine(&request, tip_path);
    let to_the_side = [70.0, -20.0, 36.0];
    let near = Request { goal: &to_the_side, ..request };
    let jia = built("joint_astar", "delta_deg = 12.0\nneighbours = 12").plan(&near).unwrap();
    for (plan, goal) in [(followed, goal), (jia, to_the_side)] {
        let case = rods::Case { goal, ..case };
        assert_eq!(plan.ending, Ending::Solved);
        assert_eq!(case.refuse_path(&plan.path, plan.cost), None);
        let middle = plan.path.len() / 2;
        let last = plan.path.len() - 1;
        for (at, by) in [(0, 1e-3), (last, 1e-3), (middle, 1e-2), (middle, 4.0), (middle, f64::NAN)] {
            let mut bent = plan.path.clone();
            bent[at][1] += by;
            assert!(case.refuse_path(&bent, plan.cost).is_some(), "configuration {at} bent by {by}");
        }
    }
}
