//! The arm of Tang et al. among boxes, in some worlds with its tip in a cage; the oracle asks the verifier about
//! every step of its joints.

use super::polyhedra::{point, solids};
use super::{Case, Posed, Truth, flood};
use base::seed;
use engine::geometry::{Aabb, Convex, Frame, Vec3};
use engine::kinematics::{Joints, Robot};
use engine::planner::Plan;
use engine::space::polyhedra::{CarriedArm, DOWN};
use engine::space::{PolyhedraWorld, Support, World};
use rand::RngExt as _;
use std::cell::Cell;
use std::collections::BTreeSet;
use std::f64::consts::{FRAC_PI_2, PI};
use std::fs;
use std::path::Path;
use verify::polyhedra::{Point, Solid};
use verify::rods::{Arm, Case as Query, Rod, Row};

/// The step of the joints; the settings of planners must say the same.
const DELTA_DEG: f64 = 12.0;

const STEP_CM: f64 = 5.0;

/// A cage with more states than this has a hole.
const MOST_STATES: u32 = 200;

/// The obstacles, and in how many states a caged arm can be.
pub struct Scene {
    solids: Vec<Solid>,
    caged: Option<u64>,
}

/// The arm of the paper from the maker's table, for the verifier: centimetres.
pub fn aubo() -> Arm {
    let limit = 175.0_f64.to_radians();
    let row =
        |alpha: f64, a: f64, d: f64, offset: f64| Row { alpha, a, d, offset, lower: -limit, upper: limit };
    let rod = |link, from, to, radius| Rod { link, from, to, radius };
    Arm {
        base: nalgebra::Matrix4::identity(),
        rows: [
            row(FRAC_PI_2, 0.0, 16.32, 0.0),
            row(PI, 64.7, 0.0, FRAC_PI_2),
            row(PI, 60.05, 0.0, 0.0),
            row(-FRAC_PI_2, 0.0, 20.13, -FRAC_PI_2),
            row(FRAC_PI_2, 0.0, 10.25, 0.0),
            row(0.0, 0.0, 9.4, 0.0),
        ],
        tip: [0.0; 3],
        rods: vec![
            rod(1, [0.0; 3], [0.0, 0.0, 20.13], 8.0),
            rod(2, [-64.7, 0.0, -20.13], [0.0, 0.0, -20.13], 8.0),
            rod(3, [-60.05, 0.0, 20.13], [0.0, 0.0, 20.13], 6.0),
            rod(4, [0.0; 3], [0.0, 0.0, 10.25], 5.0),
            rod(5, [0.0; 3], [0.0, 0.0, 9.4], 4.5),
        ],
        floor: Some(0.0),
    }
}

/// The same arm as planners have it: the AUBO-i10 with a last rod that reaches beyond the tip, so that a cage can hold it.
pub fn carried() -> CarriedArm {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("data");
    let text = fs::read_to_string(data.join("robots/aubo_i10.toml")).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("long_rod.toml");
    fs::write(&file, text.replace("to_mm = [0, 0, 49]", "to_mm = [0, 0, 94]")).unwrap();
    let robot = Robot::load(&file).unwrap();
    CarriedArm::new(&robot, "paper", &Support::on_floor(Frame::IDENTITY)).unwrap()
}

pub fn rods(number: u64) -> Case {
    let draw = |attempt: u64| {
        let names = ["rods", &number.to_string(), &attempt.to_string()];
        drawn(number, seed::stream(seed::derive(26, &names)))
    };
    (0..200)
        .find_map(draw)
        .unwrap_or_else(|| panic!("rods {number}: 200 instances gave no query of its sort"))
}

/// Boxes with a query that the arm can be posed at both ends of; in every fourth world its tip is caged at the start.
fn drawn(number: u64, mut stream: seed::Stream) -> Option<Case> {
    let is_caged = number % 4 == 3;
    let mut within = |low: [f64; 3], high: [f64; 3]| [0, 1, 2].map(|i| stream.random_range(low[i]..high[i]));
    let mut bodies: Vec<Convex> = (0..=number % 3)
        .map(|_| {
            let center = within([45.0, -8.0, 20.0], [75.0, 8.0, 80.0]);
            let size = within([4.0; 3], [14.0; 3]);
            Convex::cuboid(center.into(), size.into()).unwrap()
        })
        .collect();
    // On the lattice, so that a point finds its way out of the narrow cage.
    let start = within([55.0, -20.0, 35.0], [72.0, -10.0, 60.0]).map(|c| (c / STEP_CM).round() * STEP_CM);
    let across = within([-3.0, 20.0, -3.0], [3.0, 35.0, 3.0]);
    let goal = [0, 1, 2].map(|i| start[i] + across[i]);
    if is_caged {
        bodies.extend(cage(start));
    }
    let growth = if is_caged { 4.0 } else { 7.0 };
    let domain = Aabb { min: Vec3::new(0.0, -90.0, 0.0), max: Vec3::new(100.0, 90.0, 120.0) };
    let arm = carried();
    let mut scene = Scene { solids: solids(&bodies), caged: None };
    let ends = scene.postures(&arm, start, goal);
    let world = PolyhedraWorld::new(bodies, domain, STEP_CM, growth).unwrap();
    let are_free = [start, goal].iter().all(|end| world.is_free(&Vec3::from(*end)));
    if !are_free || ends.is_empty() {
        return None;
    }
    if is_caged {
        // Which branch a planner starts on is its own affair.
        let states: BTreeSet<Option<u64>> = ends.iter().map(|ends| scene.states(*ends)).collect();
        scene.caged = Some(states.into_iter().reduce(|_, _| None)??);
    }
    let [start, goal] = [start, goal].map(|end| end.to_vec());
    let name = format!("rods {number}, {start:?} to {goal:?}");
    let world = World::Polyhedra(Box::new(world.with_arm(arm)));
    Some(Case { name, world, start, goal, posed: Posed::Rods(scene) })
}

/// Four boxes around the last rod of an arm that points down at `at`, 6 mm off it and thicker than any step.
fn cage([x, y, z]: Point) -> Vec<Convex> {
    let beside = |dx: f64, dy: f64| {
        let size = if dx == 0.0 { [18.2, 4.0, 12.0] } else { [4.0, 18.2, 12.0] };
        Convex::cuboid([x + dx * 7.1, y + dy * 7.1, z - 3.0].into(), size.into()).unwrap()
    };
    vec![beside(-1.0, 0.0), beside(1.0, 0.0), beside(0.0, -1.0), beside(0.0, 1.0)]
}

impl Scene {
    /// Whether the verifier lets the joints go from `a` to `b`.
    fn is_clear(&self, arm: &Arm, a: &Joints, b: &Joints) -> bool {
        let (start, goal) = (arm.tip(a), arm.tip(b));
        let apart = (Vec3::from(start) - Vec3::from(goal)).norm();
        let query = Query { arm, solids: &self.solids, start, goal };
        query.refuse_path(&[a.to_vec(), b.to_vec()], Some(apart)).is_none()
    }

    /// The free configurations at start and goal with the tool down, for each branch that has both.
    fn postures(&self, arm: &CarriedArm, start: Point, goal: Point) -> Vec<[Joints; 2]> {
        let target = |at: Point| CarriedArm::target(&Vec3::from(at), &DOWN);
        let solved = arm.arm().inverse(&target(start), &[0.0; 6]);
        let on_branch = |(branch, from): (_, &Joints)| {
            let to = arm.arm().inverse_on(&target(goal), branch, from)?;
            [*from, to].iter().all(|q| self.is_clear(&aubo(), q, q)).then_some([*from, to])
        };
        solved.iter().filter_map(on_branch).collect()
    }

    /// To how many states steps of one joint lead from `start`, if they are few and none leads to `goal`.
    fn states(&self, [start, goal]: [Joints; 2]) -> Option<u64> {
        let arm = aubo();
        let delta = DELTA_DEG.to_radians();
        let taken = Cell::new(0);
        let hops = |state: Option<[i8; 6]>| {
            let Some(state) = state.filter(|_| taken.replace(taken.get() + 1) < MOST_STATES) else {
                return Vec::new();
            };
            let at = |state: [i8; 6]| -> Joints {
                std::array::from_fn(|i| start[i] + f64::from(state[i]) * delta)
            };
            let here = at(state);
            let is_near = (0..6).all(|i| (here[i] - goal[i]).abs() <= delta + 1e-9);
            let last = (is_near && self.is_clear(&arm, &here, &goal)).then_some((None, delta));
            let turned = |joint: usize, by: i8| {
                let mut to = state;
                to[joint] += by;
                self.is_clear(&arm, &here, &at(to)).then_some((Some(to), delta))
            };
            (0..6).flat_map(|joint| [turned(joint, -1), turned(joint, 1)]).chain([last]).flatten().collect()
        };
        let (found, _) = flood(Some([0; 6]), hops);
        (!found.contains_key(&None) && taken.get() < MOST_STATES).then_some(found.len() as u64)
    }
}

/// In a cage only the last joint turns: each state is reached once, and moves that lower no cost are not generated.
/// Outside, the search over joints is too wide for an oracle, and all that is known is that no path of the tip is
/// shorter than the straight one.
pub fn truth(case: &Case, scene: &Scene) -> Truth {
    let straight = (Vec3::from(point(&case.start)) - Vec3::from(point(&case.goal))).norm();
    let optimum = scene.caged.is_none().then_some(straight);
    Truth { optimum, is_exact: false, reachable: scene.caged.map(|states| (states, states - 1)) }
}

/// Why the verifier refuses `plan`'s path.
pub fn refusal(case: &Case, scene: &Scene, plan: &Plan) -> Option<String> {
    let (start, goal) = (point(&case.start), point(&case.goal));
    Query { arm: &aubo(), solids: &scene.solids, start, goal }.refuse_path(&plan.path, plan.cost)
}

/// In the middle of a box, outside, out of reach, of another dimension, not finite.
pub fn impossible(case: &Case) -> Vec<Vec<f64>> {
    let mut points = super::polyhedra::impossible(case);
    points.push(vec![99.0, 89.0, 119.0]);
    points
}
