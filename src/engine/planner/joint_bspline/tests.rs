//! Curves through a trail with a corner, with and without a box that the corner goes round.

use super::*;
use crate::planner::{Counts, Ending};
use std::path::Path;
use world::geometry::{Aabb, Convex, Frame, Vec3};
use world::kinematics::Robot;
use world::space::{Support, World};

/// From one configuration of the trail to the next, radians.
const STEP: f64 = 0.4;
/// Where the trail has its corner.
const CORNER: usize = 3;

/// Turns about the base, then bends the elbow: a right angle among joint angles.
fn corner() -> Vec<Joints> {
    let at = |base: f64, elbow: f64| [base, 0.3, elbow, 0.2, -1.2, 0.0];
    let turned = (0..=3).map(|k| at(-1.2 + STEP * f64::from(k), 1.6));
    turned.chain((1..=3).map(|k| at(0.0, 1.6 - STEP * f64::from(k)))).collect()
}

fn world(bodies: Vec<Convex>) -> World {
    let robot =
        Robot::load(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/robots/aubo_i10.toml")).unwrap();
    let domain = Aabb { min: Vec3::repeat(-150.0), max: Vec3::repeat(150.0) };
    let world = PolyhedraWorld::new(bodies, domain, 5.0, 0.0).unwrap();
    World::Polyhedra(Box::new(
        world.with_arm(CarriedArm::new(&robot, "paper", &Support::on_floor(Frame::IDENTITY)).unwrap()),
    ))
}

fn smoothed(world: &World, guarded: bool, trail: &[Joints]) -> Plan {
    let stage = JointSpline { control: Control::Trail, guarded, points_per_span: 4 };
    let ends = [trail[0], trail[trail.len() - 1]];
    let request = Request { world, start: &ends[0], goal: &ends[1], expansions: 1, seed: 0, trace: false };
    let plan = Plan {
        ending: Ending::Solved,
        path: trail.iter().map(|q| q.to_vec()).collect(),
        cost: None,
        counts: Counts::new(),
        traces: Vec::new(),
        reason: None,
    };
    stage.refine(&request, plan)
}

fn joints(plan: &Plan) -> Vec<Joints> {
    plan.path.iter().map(|q| std::array::from_fn(|i| q[i])).collect()
}

/// Whether no rod touches a body on the way along `path`.
fn is_free(world: &World, path: &[Joints]) -> bool {
    let polyhedra = world.as_polyhedra().unwrap();
    let arm = polyhedra.arm().unwrap();
    path.windows(2).all(|pair| is_clear(polyhedra, arm, &pair[0], &pair[1], &arm.apart(polyhedra.bodies())))
}

#[test]
fn a_curve_keeps_the_ends_of_a_trail_and_rounds_its_corner() {
    let world = world(Vec::new());
    let trail = corner();
    let smooth = joints(&smoothed(&world, true, &trail));
    assert!(greatest(&smooth[0], &trail[0]) < 1e-12);
    assert!(greatest(&smooth[smooth.len() - 1], &trail[trail.len() - 1]) < 1e-12);
    assert!(smooth.iter().all(|q| greatest(q, &trail[CORNER]) > STEP / 10.0), "the corner is cut");
    let near = |q: &Joints| trail.iter().map(|of| greatest(q, of)).fold(f64::INFINITY, f64::min);
    assert!(smooth.iter().all(|q| near(q) <= STEP), "the curve stays within a step of its control points");
}

#[test]
fn where_a_rounded_corner_touches_a_box_a_guarded_curve_returns_to_the_trail() {
    let trail = corner();
    let arm = world(Vec::new()).as_polyhedra().unwrap().arm().unwrap().clone();
    let tip = arm.tip(&trail[CORNER]);
    let grid = || (-8..=8).map(|k| 3.0 * f64::from(k));
    let beside = grid().flat_map(|x| grid().flat_map(move |y| grid().map(move |z| Vec3::new(x, y, z))));
    let mut guarded_for = 0;
    for off in beside {
        let world = world(vec![Convex::cuboid(tip + off, Vec3::repeat(1.0)).unwrap()]);
        let loose = joints(&smoothed(&world, false, &trail));
        if !is_free(&world, &trail) || is_free(&world, &loose) {
            continue;
        }
        let plan = smoothed(&world, true, &trail);
        assert!(is_free(&world, &joints(&plan)), "a box {off} off the corner");
        assert!(plan.counts["raised_points"].as_f64() > 0.0);
        guarded_for += 1;
        if guarded_for == 3 {
            return;
        }
    }
    panic!("only {guarded_for} boxes stood where only the curve goes");
}

#[test]
fn switched_off_or_without_a_path_nothing_changes() {
    let world = world(Vec::new());
    let trail = corner();
    let off = JointSpline { control: Control::Off, guarded: true, points_per_span: 4 };
    let before = smoothed(&world, true, &trail);
    let request = Request { world: &world, start: &[], goal: &[], expansions: 1, seed: 0, trace: false };
    assert_eq!(off.refine(&request, before.clone()).path, before.path);
    let none = Plan { ending: Ending::NoPath, ..before.clone() };
    let on = JointSpline { control: Control::Trail, guarded: true, points_per_span: 4 };
    assert_eq!(on.refine(&request, none).path, before.path);
}

fn greatest(a: &Joints, b: &Joints) -> f64 {
    (0..AXES).map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max)
}
