//! An arm's path before the verifier.

use super::{Verified, outcome};
use crate::contender::Pipeline;
use engine::geometry::planar::Touch;
use engine::kinematics::planar_2r::ElbowRule;
use engine::planner::{Counts, Ending, Plan, Request, Value};
use engine::shorten::{TurnAngle, bends, turn_sum_deg};
use engine::space::{ArmWorld, HopRule, Obstacle};
use verify::arm::{Answer, Audit, Body, Case, Hops};

/// The columns of every trial of an arm.
pub const ARM_COLUMNS: &[&str] = &[
    "path_length_cm",
    "optimal_length_cm",
    "hops",
    "bends",
    "sharp_edges",
    "turn_exterior_deg",
    "largest_turn_deg",
    "joint1_travel_deg",
    "joint2_travel_deg",
    "largest_joint_step_deg",
    "unsafe_hops",
    "is_unsafe",
    "deepest_cm",
];

/// A bend of at least this much is a sharp edge: the least that an 8-connected path can make.
const SHARP_DEG: f64 = 45.0 - 1e-6;

pub(super) fn verify(world: &ArmWorld, request: &Request<'_>, plan: &Plan, pipeline: &Pipeline) -> Verified {
    let case = case(world, request.start, request.goal);
    let untouched = pipeline.stages.is_empty();
    let steps = pipeline.planner.steps().filter(|_| untouched);
    let answer = Answer {
        path: &plan.path,
        cost: plan.cost,
        steps,
        optimal: untouched && pipeline.planner.is_optimal(),
    };
    let mut values = Counts::new();
    let refusal = match (plan.ending, steps) {
        (Ending::Solved, _) => match case.audit(&answer) {
            Ok(audit) => {
                measure(plan, &audit, &mut values);
                None
            }
            Err(refusal) => Some(refusal),
        },
        (Ending::NoPath, Some(steps)) if pipeline.planner.is_complete() => case.refuse_no_path(steps),
        _ => None,
    };
    Verified { outcome: outcome(request, plan, refusal), values, traces: Vec::new() }
}

fn measure(plan: &Plan, audit: &Audit, values: &mut Counts) {
    let turns: Vec<f64> =
        plan.path.windows(3).map(|three| turn_sum_deg(three, TurnAngle::Exterior)).collect();
    let mut real = |column, value| values.insert(column, Value::Real(value));
    real("path_length_cm", audit.length_cm);
    real("turn_exterior_deg", turn_sum_deg(&plan.path, TurnAngle::Exterior));
    real("largest_turn_deg", turns.iter().copied().fold(0.0, f64::max));
    real("joint1_travel_deg", audit.joint_travel_deg[0]);
    real("joint2_travel_deg", audit.joint_travel_deg[1]);
    real("largest_joint_step_deg", audit.largest_joint_step_deg);
    real("deepest_cm", audit.deepest_cm);
    if let Some(optimal) = audit.optimal_cm {
        real("optimal_length_cm", optimal);
    }
    let mut count = |column, value: usize| values.insert(column, Value::Count(value as u64));
    count("hops", plan.path.len().saturating_sub(1));
    count("bends", bends(&plan.path).len().saturating_sub(2));
    count("sharp_edges", turns.iter().filter(|turn| **turn >= SHARP_DEG).count());
    count("unsafe_hops", audit.unsafe_hops as usize);
    count("is_unsafe", usize::from(audit.unsafe_hops > 0));
}

/// The world in the verifier's own terms.
fn case<'a>(world: &ArmWorld, start: &'a [f64], goal: &'a [f64]) -> Case<'a> {
    let rules = world.rules();
    Case {
        links_cm: rules.arm.links(),
        higher_elbow: rules.elbow == ElbowRule::HigherElbow,
        low_cm: rules.lattice.low_cm(),
        step_cm: rules.lattice.step_cm(),
        size: rules.lattice.size(),
        inner_radius_cm: rules.inner_radius_cm,
        touching_is_contact: rules.touch == Touch::Contact,
        corner_rule: rules.corner_rule,
        q2_limit_rad: rules.q2_limit_rad,
        hops: match rules.hop {
            HopRule::EndPoints => Hops::EndPoints,
            HopRule::Continuous => Hops::EvenJoints,
            HopRule::TipLine => Hops::TipLine,
        },
        bodies: world.obstacles().iter().map(body).collect(),
        start,
        goal,
    }
}

fn body(obstacle: &Obstacle) -> Body {
    match obstacle {
        Obstacle::Circle(circle) => Body::disc(circle.center.into(), circle.radius),
        Obstacle::Polygon(polygon) => {
            Body::polygon(polygon.vertices().iter().map(|corner| (*corner).into()).collect())
        }
    }
}
