//! The verifier of joint paths against paths that planners made and someone bent.

use crate::worlds::polyhedra::solids;
use crate::worlds::rods::{aubo, carried};
use base::settings::Settings;
use engine::planner::{self, Build, Ending, Planner, Request, Stage};
use engine::space::polyhedra::read_scene;
use engine::space::{PolyhedraWorld, World};
use std::path::Path;
use verify::rods;

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

/// The arm among the boxes of the scene C1, its tip 7 cm clear of them.
fn scene() -> World {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("data");
    let scene = read_scene(&data.join("scenes/tang_c1.toml")).unwrap();
    let world = PolyhedraWorld::new(scene.bodies, scene.domain, 1.0, 7.0).unwrap();
    World::Polyhedra(Box::new(world.with_arm(carried())))
}

#[test]
fn the_verifier_accepts_the_arms_paths_and_none_with_an_angle_bent() {
    let (world, arm) = (scene(), aubo());
    let posture = "adjust = true\nsign = 'down'\nclamp = 'floor'\ndistance = 'exact'\npose = 'inverse'\n\
        damping = 0.02\nact_cm = 2.0\nd0_cm = 5.0\nstep_rad = 0.03\niterations = 20\n\
        bounds_rad = [0.2, 0.2, 0.1]\nbounds = 'per_node'\nrecovery_rad = 0.02\nbranches = 'all'\ndiagnose = false";
    let solids = solids(world.as_polyhedra().unwrap().bodies());
    let (start, goal) = ([70.0, -46.0, 36.0], [70.0, 41.0, 51.0]);
    let case = rods::Case { arm: &arm, solids: &solids, start, goal };
    let request =
        Request { world: &world, start: &start, goal: &goal, expansions: 60_000, seed: 0, trace: false };
    let keynode = "search = 'open_list'\ncluster = true\nlast_resort = true";
    let tip_path = built("keynode_astar", keynode).plan(&request).unwrap();
    let followed = stage("posture", posture).refine(&request, tip_path);
    let jia = built("joint_astar", "delta_deg = 12.0\nneighbours = 12").plan(&request).unwrap();
    for plan in [followed, jia] {
        assert_eq!(plan.ending, Ending::Solved);
        assert_eq!(case.refuse_path(&plan.path, plan.cost), None);
        let (middle, last) = (plan.path.len() / 2, plan.path.len() - 1);
        for (at, by) in [(0, 1e-3), (last, 1e-3), (middle, 1e-2), (middle, 4.0), (middle, f64::NAN)] {
            let mut bent = plan.path.clone();
            bent[at][1] += by;
            assert!(case.refuse_path(&bent, plan.cost).is_some(), "configuration {at} bent by {by}");
        }
    }
}
