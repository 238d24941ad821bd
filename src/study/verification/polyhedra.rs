//! Plans among polyhedra: tip paths (three numbers a point) and joint paths (six) in the verifier's terms.

use super::{Verified, outcome, refuse_ending};
use engine::geometry::Vec3;
use engine::kinematics::AXES;
use engine::planner::{Counts, Ending, Plan, Request, Value};
use engine::shorten::{TurnAngle, path_length, turn_sum_deg};
use engine::space::PolyhedraWorld;
use engine::space::polyhedra::CarriedArm;
use verify::polyhedra::{Case, Point, Solid};
use verify::rods;

/// The columns of every trial among polyhedra.
pub const POLYHEDRA_COLUMNS: &[&str] =
    &["path_length_cm", "turn_exterior_deg", "bends", "obstacles", "straight_line_cm"];

/// The columns of every trial of an arm among polyhedra, besides.
pub const CARRIED_COLUMNS: &[&str] = &[
    "path_length_cm",
    "turn_exterior_deg",
    "bends",
    "obstacles",
    "straight_line_cm",
    "joint_range_rad",
    "joint_travel_rad",
    "tip_jitter_cm",
    "posture_jitter_rad",
    "joint_jitter_rad",
];

/// How many equal spans of time a joint path is looked at in, so that paths of other step lengths compare.
const SPANS: usize = 200;

/// A path turns where its direction changes by more than this.
const BEND_DEG: f64 = 1e-3;

/// The scene as the verifier sees it.
#[derive(Debug, Clone)]
pub struct Truth {
    solids: Vec<Solid>,
    growth: f64,
    arm: Option<rods::Arm>,
}

/// The truth about `world`.
pub fn truth(world: &PolyhedraWorld) -> Truth {
    let solid = |convex: &engine::geometry::Convex| {
        let vertices: Vec<Point> = convex.vertices().iter().map(|v| (*v).into()).collect();
        Solid::new(&vertices).expect("a checked polyhedron encloses something")
    };
    Truth {
        solids: world.bodies().iter().map(solid).collect(),
        growth: world.growth(),
        arm: world.arm().map(arm),
    }
}

/// Verifies `plan`.
pub fn verify(world: &PolyhedraWorld, request: &Request<'_>, plan: &Plan, truth: &Truth) -> Verified {
    let [start, goal] = [request.start, request.goal].map(|p| [p[0], p[1], p[2]]);
    let is_joints = plan.path.first().is_some_and(|point| point.len() == AXES);
    let refusal = refuse_ending(request, plan).or_else(|| match (plan.ending, &truth.arm) {
        (Ending::Solved, Some(arm)) if is_joints => {
            rods::Case { arm, solids: &truth.solids, start, goal }.refuse_path(&plan.path, plan.cost)
        }
        (Ending::Solved, _) => {
            let domain = [world.domain().min.into(), world.domain().max.into()];
            let case = Case { solids: &truth.solids, growth: truth.growth, domain, start, goal };
            case.refuse_path(&plan.path, plan.cost)
        }
        _ => None,
    });
    let straight = (Vec3::from(start) - Vec3::from(goal)).norm();
    let mut values = Counts::from([
        ("obstacles", Value::Count(world.obstacles().len() as u64)),
        ("straight_line_cm", Value::Real(straight)),
    ]);
    if plan.ending == Ending::Solved && refusal.is_none() {
        let tips: Vec<Vec<f64>> = match (is_joints, world.arm()) {
            (true, Some(arm)) => {
                motion(arm, &plan.path, &mut values);
                plan.path.iter().map(|q| arm.tip(&joints(q)).as_slice().to_vec()).collect()
            }
            _ => plan.path.clone(),
        };
        values.insert("path_length_cm", Value::Real(path_length(&tips)));
        values.insert("turn_exterior_deg", Value::Real(turn_sum_deg(&tips, TurnAngle::Exterior)));
        if !is_joints {
            values.insert("bends", Value::Count(bends(&tips)));
        }
    }
    Verified { outcome: outcome(request, plan, refusal), values, exhibits: Vec::new() }
}

/// Points at which a path turns; steps along a straight line that are off it by rounding do not.
fn bends(tips: &[Vec<f64>]) -> u64 {
    let turns = tips.windows(3).map(|three| turn_sum_deg(three, TurnAngle::Exterior));
    turns.filter(|turn_deg| *turn_deg > BEND_DEG).count() as u64
}

fn joints(q: &[f64]) -> [f64; AXES] {
    std::array::from_fn(|i| q[i])
}

/// The arm in the verifier's terms: centimetres and radians.
fn arm(carried: &CarriedArm) -> rods::Arm {
    let chain = carried.arm().chain();
    let row = |joint: &engine::kinematics::Joint| rods::Row {
        alpha: joint.alpha_rad,
        a: joint.a_m * 100.0,
        d: joint.d_m * 100.0,
        offset: joint.offset_rad,
        lower: joint.lower_rad,
        upper: joint.upper_rad,
    };
    let mut base = nalgebra::Matrix4::identity();
    base.fixed_view_mut::<3, 3>(0, 0).copy_from(&chain.base().rotation);
    base.fixed_view_mut::<3, 1>(0, 3).copy_from(&(chain.base().origin * 100.0));
    let rod = |part: &engine::kinematics::robot::Part| rods::Rod {
        link: part.link(),
        from: (part.capsule().segment.a * 100.0).into(),
        to: (part.capsule().segment.b * 100.0).into(),
        radius: part.capsule().radius * 100.0,
    };
    rods::Arm {
        base,
        rows: chain.joints().each_ref().map(row),
        tip: (chain.tool().origin * 100.0).into(),
        rods: carried.parts().iter().map(rod).collect(),
        floor: carried.floor_cm(),
    }
}

/// What the joints, the tip and its posture do, configurations following each other at equal times.
fn motion(arm: &CarriedArm, path: &[Vec<f64>], values: &mut Counts) {
    let travel: f64 =
        path.windows(2).map(|pair| (0..AXES).map(|i| (pair[1][i] - pair[0][i]).abs()).sum::<f64>()).sum();
    let range = |i: usize| {
        let angles = path.iter().map(|q| q[i]);
        angles.clone().fold(f64::NEG_INFINITY, f64::max) - angles.fold(f64::INFINITY, f64::min)
    };
    values.insert("joint_travel_rad", Value::Real(travel));
    values.insert("joint_range_rad", Value::Real((0..AXES).map(range).sum()));
    let even = resampled(path);
    let tips: Vec<Vec3> = even.iter().map(|q| arm.tip(q)).collect();
    let turns: Vec<Vec3> = even.windows(2).map(|pair| turn(arm, &pair[0], &pair[1])).collect();
    let second = |a: f64, b: f64, c: f64| a - 2.0 * b + c;
    let tip: f64 = tips.windows(3).map(|t| (t[0] - t[1] * 2.0 + t[2]).norm()).sum();
    let posture: f64 = turns.windows(2).map(|t| (t[1] - t[0]).norm()).sum();
    let joint: f64 = even
        .windows(3)
        .map(|q| (0..AXES).map(|i| second(q[0][i], q[1][i], q[2][i]).abs()).sum::<f64>())
        .sum();
    values.insert("tip_jitter_cm", Value::Real(tip));
    values.insert("posture_jitter_rad", Value::Real(posture));
    values.insert("joint_jitter_rad", Value::Real(joint));
}

/// The path at the ends of equal spans of time.
fn resampled(path: &[Vec<f64>]) -> Vec<[f64; AXES]> {
    let last = path.len() - 1;
    let at = |k: usize| {
        let place = k as f64 * last as f64 / SPANS as f64;
        let index = (place as usize).min(last.saturating_sub(1));
        let (from, to) = (&path[index], &path[(index + 1).min(last)]);
        std::array::from_fn(|i| from[i] + (to[i] - from[i]) * (place - index as f64))
    };
    (0..=SPANS).map(at).collect()
}

/// The rotation vector from the tip's posture at `a` to that at `b`.
fn turn(arm: &CarriedArm, a: &[f64; AXES], b: &[f64; AXES]) -> Vec3 {
    let [from, to] = [a, b].map(|q| arm.arm().chain().forward(q).rotation);
    let between = to * from.transpose();
    let axis = Vec3::new(
        between[(2, 1)] - between[(1, 2)],
        between[(0, 2)] - between[(2, 0)],
        between[(1, 0)] - between[(0, 1)],
    );
    let sine = axis.norm() / 2.0;
    let angle = libm::atan2(sine, (between.trace() - 1.0) / 2.0);
    if sine > 1e-12 { axis * (angle / (2.0 * sine)) } else { Vec3::zeros() }
}
