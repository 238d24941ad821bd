//! Steps, ends and work of the joint-space search.

use super::*;
use crate::planner::Value;
use base::settings::Settings;
use std::path::Path;
use world::geometry::{Aabb, Convex, Frame};
use world::kinematics::Robot;
use world::space::{Support, World};

fn world(bodies: Vec<Convex>) -> World {
    let robot =
        Robot::load(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/robots/aubo_i10.toml")).unwrap();
    let domain = Aabb { min: Vec3::new(0.0, -90.0, 0.0), max: Vec3::new(100.0, 90.0, 120.0) };
    let world = PolyhedraWorld::new(bodies, domain, 5.0, 0.0).unwrap();
    World::Polyhedra(Box::new(
        world.with_arm(CarriedArm::new(&robot, "paper", &Support::on_floor(Frame::IDENTITY)).unwrap()),
    ))
}

fn planner(text: &str) -> Result<Box<dyn Planner>, String> {
    let Build::Planner(build) = ENTRY.build else { panic!("it is a planner") };
    build(&Settings::composed("test", toml::from_str(text).unwrap())).map_err(|e| e.to_string())
}

fn plan(world: &World, text: &str, expansions: u64) -> Plan {
    let (start, goal) = ([60.0, -12.0, 50.0], [60.0, 12.0, 50.0]);
    let request = Request { world, start: &start, goal: &goal, expansions, seed: 0, trace: false };
    planner(text).unwrap().plan(&request).unwrap()
}

#[test]
fn twelve_steps_move_one_joint_and_728_any() {
    let [one, any] = [12, 728].map(|neighbours| steps(neighbours, 0.5));
    assert_eq!((one.len(), any.len()), (12, 728));
    assert!(one.iter().all(|(step, length)| moved(step) == 1 && *length == 0.5));
    assert!(any.contains(&([1, -1, 1, -1, 1, -1], 0.5 * 6_f64.sqrt())));
}

#[test]
fn each_step_of_a_path_is_a_neighbour_and_the_tip_ends_at_the_goal() {
    let world = world(Vec::new());
    let arm = world.as_polyhedra().unwrap().arm().unwrap();
    let mut opened = Vec::new();
    for (text, most) in [("delta_deg = 8.0\nneighbours = 12", 1), ("delta_deg = 8.0\nneighbours = 728", 6)] {
        let plan = plan(&world, text, 20_000);
        assert_eq!(plan.ending, Ending::Solved, "{text}");
        let delta = 8.0_f64.to_radians();
        let last = plan.path.len() - 1;
        let before = plan.path.len() - 2;
        for pair in plan.path[..last].windows(2) {
            let moved = (0..AXES).filter(|i| (pair[1][*i] - pair[0][*i]).abs() > 1e-9).count();
            let lengths = (0..AXES).map(|i| (pair[1][i] - pair[0][i]).abs());
            assert!(moved >= 1 && moved <= most, "{moved} joints moved");
            assert!(lengths.into_iter().all(|length| length < 1e-9 || (length - delta).abs() < 1e-9));
        }
        let rest = (0..AXES).map(|i| (plan.path[last][i] - plan.path[before][i]).abs()).fold(0.0, f64::max);
        assert!(rest <= delta + 1e-9, "the last hop is within a step: {rest}");
        let end: Joints = std::array::from_fn(|i| plan.path[last][i]);
        assert!((arm.tip(&end) - Vec3::new(60.0, 12.0, 50.0)).norm() < 1e-6);
        opened.push(plan.counts["expansions"]);
    }
    let [Value::Count(one), Value::Count(any)] = opened[..] else { panic!("counts are counted") };
    assert!(any < one, "any joints at once take fewer expansions: {any} against {one}");
}

#[test]
fn half_a_step_from_the_goal_takes_a_state_nearer_to_it_and_more_expansions() {
    let world = world(Vec::new());
    let found = [1.0, 0.5].map(|steps| {
        let text = format!("delta_deg = 8.0\nneighbours = 12\ngoal_steps = {steps:.1}");
        let plan = plan(&world, &text, 200_000);
        assert_eq!(plan.ending, Ending::Solved, "{text}");
        let [.., before, goal] = &plan.path[..] else { panic!("a path has two ends") };
        let last_hop = (0..AXES).map(|i| (goal[i] - before[i]).abs()).fold(0.0, f64::max);
        let Value::Count(expansions) = plan.counts["expansions"] else { panic!("expansions are counted") };
        (last_hop.to_degrees() / 8.0, expansions)
    });
    let [(whole, few), (half, more)] = found;
    assert!(half <= 0.5 + 1e-9 && whole > 0.5 && whole <= 1.0 + 1e-9, "{whole} and {half} steps");
    assert!(more > few, "{more} expansions after {few}");
}

#[test]
fn the_nearest_branch_moves_no_joint_farther_than_the_clearest_one_and_sometimes_less() {
    let world = world(vec![Convex::cuboid(Vec3::new(40.0, -40.0, 60.0), Vec3::repeat(10.0)).unwrap()]);
    let polyhedra = world.as_polyhedra().unwrap();
    let arm = polyhedra.arm().unwrap();
    let mut shorter = 0;
    for y in [-30.0, -20.0, -10.0, 10.0, 25.0, 40.0] {
        let (start, goal) = (Vec3::new(60.0, y, 50.0), Vec3::new(45.0, 12.0, 40.0));
        let apart = [BranchSetting::Clearest, BranchSetting::Nearest].map(|rule| {
            let [from, to] = ends(polyhedra, arm, [&start, &goal], rule).unwrap();
            assert!((arm.tip(&from) - start).norm() < 1e-6 && (arm.tip(&to) - goal).norm() < 1e-6);
            greatest_difference(&from, &to)
        });
        assert!(apart[1] <= apart[0], "{apart:?} at {y}");
        shorter += u32::from(apart[1] < apart[0] - 1e-9);
    }
    assert!(shorter > 0, "both rules took the same branch everywhere");
}

#[test]
fn a_small_budget_is_spent_and_a_box_on_the_goal_is_refused() {
    let small = plan(&world(Vec::new()), "delta_deg = 2.0\nneighbours = 12", 3);
    assert_eq!((small.ending, small.counts["expansions"]), (Ending::BudgetSpent, Value::Count(3)));
    let walls = world(vec![Convex::cuboid(Vec3::new(60.0, 12.0, 58.0), Vec3::repeat(4.0)).unwrap()]);
    let (start, goal) = ([60.0, -12.0, 50.0], [60.0, 12.0, 50.0]);
    let request = Request { world: &walls, start: &start, goal: &goal, expansions: 1, seed: 0, trace: false };
    let refusal = planner("delta_deg = 8.0\nneighbours = 12").unwrap().plan(&request).unwrap_err();
    assert!(refusal.to_string().contains("no branch of the arm is free"), "{refusal}");
    for (text, part) in [
        ("delta_deg = 0.0\nneighbours = 12", "`delta_deg` is 0.0"),
        ("delta_deg = 5.0\nneighbours = 26", "12 (one joint) or 728 (any joints)"),
    ] {
        let Err(error) = planner(text) else { panic!("{text} was accepted") };
        assert!(error.contains(part), "{error}");
    }
}
