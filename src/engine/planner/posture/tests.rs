//! The arm among single boxes: poses on the way to trouble and out of it.

use super::follow::Follower;
use super::potential::{direction, field};
use super::settings::Posture;
use super::*;
use crate::planner::{Counts, Stage};
use base::settings::Settings;
use std::path::Path;
use world::geometry::{Aabb, Convex, Frame};
use world::kinematics::Robot;
use world::space::{Support, World};

mod options;
pub(in crate::planner) use options::followed;

const RECIPE: &str = "adjust = true\nsign = 'down'\nclamp = 'floor'\ndistance = 'exact'\npose = 'inverse'\n\
    damping = 0.02\nact_cm = 2.0\nd0_cm = 5.0\nstep_rad = 0.03\niterations = 20\nbounds_rad = [0.2, 0.2, 0.1]\n\
    bounds = 'per_node'\nrecovery_rad = 0.02\nbranches = 'all'\ndiagnose = true\n";

fn posture(change: (&str, &str)) -> Result<Posture, String> {
    let text = RECIPE.replace(change.0, change.1);
    Posture::read(&Settings::composed("test", toml::from_str(&text).unwrap())).map_err(|e| e.to_string())
}

fn world(boxes: &[([f64; 3], [f64; 3])]) -> World {
    let robot =
        Robot::load(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/robots/aubo_i10.toml")).unwrap();
    let bodies = boxes.iter().map(|(c, s)| Convex::cuboid((*c).into(), (*s).into()).unwrap()).collect();
    let domain = Aabb { min: Vec3::new(-100.0, -100.0, 0.0), max: Vec3::new(100.0, 100.0, 150.0) };
    let world = PolyhedraWorld::new(bodies, domain, 1.0, 0.0).unwrap();
    World::Polyhedra(Box::new(
        world.with_arm(CarriedArm::new(&robot, "paper", &Support::on_floor(Frame::IDENTITY)).unwrap()),
    ))
}

/// The stage along the straight line, tool down.
fn along(settings: &Posture, world: &World, start: [f64; 3], goal: [f64; 3]) -> Plan {
    let request = Request { world, start: &start, goal: &goal, expansions: 1, seed: 0, trace: false };
    let path = vec![start.to_vec(), goal.to_vec()];
    let plan = Plan {
        ending: Ending::Solved,
        path,
        cost: None,
        counts: Counts::new(),
        traces: Vec::new(),
        reason: None,
    };
    settings.refine(&request, plan)
}

#[test]
fn without_obstacles_the_tip_follows_the_line_and_never_turns() {
    let world = world(&[]);
    let (start, goal) = ([60.0, -30.0, 40.0], [60.0, 30.0, 45.0]);
    let plan = along(&posture(("", "")).unwrap(), &world, start, goal);
    assert_eq!(plan.ending, Ending::Solved);
    let straight = (Vec3::from(start) - Vec3::from(goal)).norm();
    assert!((plan.cost.unwrap() - straight).abs() < 1e-6, "{:?}", plan.cost);
    assert_eq!(plan.counts["adjustments"], Value::Count(0));
    let arm = world.as_polyhedra().unwrap().arm().unwrap();
    for q in &plan.path {
        let q: Joints = std::array::from_fn(|i| q[i]);
        assert!((arm.arm().chain().forward(&q).rotation - DOWN).norm() < 1e-9, "{q:?}");
    }
}

#[test]
fn turning_goes_down_the_potential_and_the_printed_sign_up() {
    let world = world(&[([56.0, 0.0, 62.0], [10.0, 10.0, 10.0])]);
    let polyhedra = world.as_polyhedra().unwrap();
    let arm = polyhedra.arm().unwrap();
    let mut compared = 0;
    for (i, y) in [-14.0, -10.0, 10.0, 14.0, 18.0].into_iter().enumerate() {
        let tip = Vec3::new(58.0, y, 48.0);
        let solved = arm.arm().inverse(&CarriedArm::target(&tip, &DOWN), &[0.0; 6]);
        for (branch, q) in solved.iter() {
            let settings = posture(("damping = 0.02", "damping = 0.0")).unwrap();
            let printed = posture(("sign = 'down'", "sign = 'as_printed'")).unwrap();
            let around =
                |q: &Joints| field(&settings, polyhedra, arm, &arm.rods(q), &arm.apart(polyhedra.bodies()));
            let now = around(q);
            if now.potential == 0.0 || now.clearance < 0.3 {
                continue;
            }
            let Some(way) = direction(&settings, arm, &arm.arm().chain().frames(q), &now) else { continue };
            let then = |by: f64| {
                let turned = rotation::exp(&(way * by)) * DOWN;
                let q = arm.arm().inverse_on(&CarriedArm::target(&tip, &turned), branch, q).unwrap();
                around(&q).potential
            };
            assert!(then(1e-4) < now.potential && then(-1e-4) > now.potential, "case {i}");
            let up = direction(&printed, arm, &arm.arm().chain().frames(q), &now).unwrap();
            assert!(up.dot(&way) < -0.9, "case {i}: the printed sign points the other way");
            compared += 1;
        }
    }
    assert!(compared >= 3, "only {compared} postures were near the box");
}

#[test]
fn a_box_beside_the_line_is_passed_with_adjustment_only_and_never_touched() {
    let world = world(&[([70.0, 15.0, 48.0], [10.0, 14.0, 22.0])]);
    let arm = world.as_polyhedra().unwrap().arm().unwrap().clone();
    let on = posture(("", "")).unwrap();
    let off = posture(("adjust = true", "adjust = false")).unwrap();
    let mut helped = 0;
    let mut hindered = 0;
    for (x, z) in (52..62).flat_map(|x| (34..64).step_by(5).map(move |z| (f64::from(x), f64::from(z)))) {
        let ends = ([x, -15.0, z], [x, 40.0, z]);
        let [with, without] = [&on, &off].map(|settings| along(settings, &world, ends.0, ends.1));
        helped += u32::from(with.ending == Ending::Solved && without.ending != Ending::Solved);
        hindered += u32::from(with.ending != Ending::Solved && without.ending == Ending::Solved);
        for q in &with.path {
            let q: Joints = std::array::from_fn(|i| q[i]);
            assert!(arm.clearance(&q, world.as_polyhedra().unwrap().bodies(), 5.0, false) >= 0.1);
        }
    }
    assert!(helped > 0 && hindered == 0, "helped {helped}, hindered {hindered}");
}

#[test]
fn a_singular_pose_is_solved_and_an_unreachable_one_ends_without_a_path() {
    let world = world(&[]);
    let arm = world.as_polyhedra().unwrap().arm().unwrap();
    // q5 = 0 puts axes 4 and 6 in line; the tip's posture there leaves joint 6 free.
    let q: Joints = [0.4, -0.6, 0.9, 0.3, 0.0, 0.5];
    let pose = arm.arm().chain().forward(&q);
    let branch = arm.arm().branch_of(&q);
    let settings = posture(("", "")).unwrap();
    let polyhedra = world.as_polyhedra().unwrap();
    let mut follower = Follower::new((&settings, polyhedra, arm), branch, q, pose.rotation);
    let tip = pose.origin * 100.0;
    assert_eq!(follower.follow(&[tip, tip]), Ok(()));
    assert!((arm.tip(&follower.here.q) - tip).norm() < 1e-9);
    let plan = along(&settings, &world, [60.0, 0.0, 40.0], [99.0, 99.0, 140.0]);
    assert_eq!(plan.ending, Ending::NoPath);
    let share = plan.counts["followed_share"].as_f64();
    assert!(share > 0.2 && share < 1.0, "{share}");
}

#[test]
fn settings_that_cannot_be_are_refused() {
    for (change, part) in [
        (("act_cm = 2.0", "act_cm = 0.0"), "act_cm is 0; more than 0 is accepted"),
        (("damping = 0.02", "damping = -1.0"), "damping is -1; 0 or more is accepted"),
        (("bounds_rad = [0.2, 0.2, 0.1]", "bounds_rad = [0.2, 0.0, 0.1]"), "bounds_rad is 0"),
        (("sign = 'down'", "sign = 'up'"), "as_printed"),
    ] {
        let error = posture(change).unwrap_err();
        assert!(error.contains(part), "{error}");
    }
}
