//! Workspaces of a planar arm among discs, squares, hexagons and triangles, some with the goal out of reach of any hops.

use super::{Case, Posed, Subject, Truth, flood};
use crate::shapes::{HOPS, Placed, body, hops_of, obstacle, shaped};
use base::grid::CornerRule;
use base::seed;
use engine::geometry::planar::Touch;
use engine::kinematics::planar_2r::{ElbowRule, Planar2r};
use engine::planner::Plan;
use engine::space::{ArmRules, ArmWorld, TipLattice, World};
use rand::RngExt as _;
use study::preprocessing::workspace_map::ShapeSetting;
use verify::arm::{Answer, Case as Query};

const STEP_CM: f64 = 4.0;

/// The widest steps of any planner that is tried.
const WIDE: i32 = 2;

pub fn arm(number: u64) -> Case {
    let draw = |attempt: u64| {
        let names = ["arm", &number.to_string(), &attempt.to_string()];
        drawn(number, seed::stream(seed::derive(1968, &names)))
    };
    (0..200).find_map(draw).unwrap_or_else(|| panic!("arm {number}: 200 instances gave no query of its sort"))
}

/// A workspace with a query; in every fourth one, no hops lead to the goal.
fn drawn(number: u64, mut stream: seed::Stream) -> Option<Case> {
    let rules = ArmRules {
        arm: Planar2r::new(30.0, 20.0).unwrap(),
        elbow: [ElbowRule::NegativeQ2, ElbowRule::HigherElbow][(number / 2 % 2) as usize],
        lattice: TipLattice::new([-48.0, 48.0], [0.0, 48.0], STEP_CM).unwrap(),
        inner_radius_cm: 14.0,
        q2_limit_rad: f64::INFINITY,
        touch: Touch::Contact,
        corner_rule: [CornerRule::Allow, CornerRule::ForbidBoth, CornerRule::ForbidAny]
            [(number % 3) as usize],
        hop: HOPS[(number % 8) as usize],
    };
    let places: Vec<[f64; 2]> = (0..stream.random_range(2..7))
        .map(|_| [0, 1].map(|axis| f64::from(stream.random_range([-40, 8][axis]..44_i32))))
        .collect();
    let solids = shaped(number, places);
    let world = ArmWorld::new(rules, solids.iter().map(obstacle).collect());
    let free: Vec<u32> = (0..world.grid().cell_count()).filter(|&cell| world.grid().is_free(cell)).collect();
    let ends = [0, 1].map(|_| free[stream.random_range(0..free.len())]);
    let steps: Vec<[i32; 2]> = (-WIDE..=WIDE).flat_map(|x| (-WIDE..=WIDE).map(move |y| [x, y])).collect();
    let is_shut = !flood(ends[0], |cell| hops(&world, cell, &steps)).0.contains_key(&ends[1]);
    if is_shut != (number % 4 == 3) {
        return None;
    }
    let [start, goal] = ends.map(|cell| <[f64; 2]>::from(rules.lattice.point(cell)).to_vec());
    let name = format!("arm {number}, {solids:?}, {start:?} to {goal:?}");
    Some(Case { name, world: World::Arm(world), start, goal, posed: Posed::Arm(solids) })
}

/// Where `steps` lead from a cell, as the workspace answers, and how far each goes.
fn hops(world: &ArmWorld, cell: u32, steps: &[[i32; 2]]) -> Vec<(u32, f64)> {
    let grid = world.grid();
    let [x, y] = world.grid().xy(cell);
    let hop = |&[dx, dy]: &[i32; 2]| {
        let to = grid.cell(x + dx, y + dy).filter(|to| *to != cell && grid.is_free(*to))?;
        world.may_hop(cell, to).then(|| (to, STEP_CM * f64::from(dx * dx + dy * dy).sqrt()))
    };
    steps.iter().filter_map(hop).collect()
}

/// What is true in the graph of the subject's steps; of steps that are drawn at random it is only a bound.
pub fn truth(case: &Case, subject: &Subject) -> Truth {
    let world = case.world.as_arm().unwrap();
    let [start, goal] =
        [&case.start, &case.goal].map(|end| world.free_cell("end", end).expect("ends are free"));
    let (found, moves) = flood(start, |cell| hops(world, cell, subject.planner.steps().unwrap()));
    let is_exact = subject.planner.is_complete();
    let optimum = found.get(&goal).copied();
    Truth { optimum, is_exact, reachable: is_exact.then_some((found.len() as u64, moves)) }
}

/// Why the verifier refuses `plan`'s path.
pub fn refusal(
    case: &Case,
    solids: &[Placed],
    plan: &Plan,
    steps: Option<&[[i32; 2]]>,
    optimal: bool,
) -> Option<String> {
    let rules = case.world.as_arm().unwrap().rules();
    let query = Query {
        links_cm: [30.0, 20.0],
        higher_elbow: rules.elbow == ElbowRule::HigherElbow,
        low_cm: [-48.0, 0.0],
        step_cm: STEP_CM,
        size: [25, 13],
        inner_radius_cm: 14.0,
        touching_is_contact: true,
        corner_rule: rules.corner_rule,
        q2_limit_rad: rules.q2_limit_rad,
        hops: hops_of(rules.hop),
        bodies: solids.iter().map(body).collect(),
        start: &case.start,
        goal: &case.goal,
    };
    query.audit(&Answer { path: &plan.path, cost: plan.cost, steps, optimal }).err()
}

/// In an obstacle, outside, between lattice points, of another dimension.
pub fn impossible(solids: &[Placed]) -> Vec<Vec<f64>> {
    let on_lattice = |(_, at): &Placed| at.iter().map(|x| (x / STEP_CM).round() * STEP_CM).collect();
    let mut points = vec![vec![-52.0, 0.0], vec![0.0, 0.0], vec![1.0, 40.0], vec![20.0]];
    // A triangle may be too slim to hold the lattice point nearest to its centre.
    let wide = solids.iter().filter(|(shape, _)| *shape != ShapeSetting::Triangle);
    points.extend(wide.map(on_lattice));
    points
}
