//! Plans among polyhedra: tip paths (three numbers a point) and joint paths (six) in the verifier's terms.

use super::{Verified, outcome, refuse_ending};
use engine::geometry::{Segment, Vec3};
use engine::kinematics::AXES;
use engine::planner::{Counts, Ending, Plan, Request, Value};
use engine::shorten::{TurnAngle, path_length, turn_sum_deg};
use engine::space::PolyhedraWorld;
use engine::space::polyhedra::{CarriedArm, Motion, motion};
use verify::polyhedra::{Case, Point, Solid};
use verify::rods;

/// The columns of every trial among polyhedra.
pub const POLYHEDRA_COLUMNS: &[&str] =
    &["path_length_cm", "turn_exterior_deg", "bends", "obstacles", "straight_line_cm", "line_blocked"];

/// The columns of every trial of an arm among polyhedra, besides.
pub const CARRIED_COLUMNS: &[&str] = &[
    "path_length_cm",
    "turn_exterior_deg",
    "bends",
    "obstacles",
    "straight_line_cm",
    "line_blocked",
    "joint_range_rad",
    "joint_travel_rad",
    "tip_jitter_cm",
    "posture_jitter_rad",
    "joint_jitter_rad",
];

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
    let line = Segment::new(start.into(), goal.into());
    let mut values = Counts::from([
        ("obstacles", Value::Count(world.obstacles().len() as u64)),
        ("straight_line_cm", Value::Real(straight)),
        ("line_blocked", Value::Count(u64::from(!world.is_clear(&line)))),
    ]);
    if plan.ending == Ending::Solved && refusal.is_none() {
        let tips: Vec<Vec<f64>> = match (is_joints, world.arm()) {
            (true, Some(arm)) => {
                values.extend(moved(&motion(arm, &plan.path)));
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
    Verified { outcome: outcome(request, plan, refusal), values, traces: Vec::new() }
}

/// What an arm did along its path, by column.
fn moved(motion: &Motion) -> Counts {
    let columns = [
        ("joint_travel_rad", motion.joint_travel_rad),
        ("joint_range_rad", motion.joint_range_rad),
        ("tip_jitter_cm", motion.tip_jitter_cm),
        ("posture_jitter_rad", motion.posture_jitter_rad),
        ("joint_jitter_rad", motion.joint_jitter_rad),
    ];
    columns.into_iter().map(|(name, value)| (name, Value::Real(value))).collect()
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
