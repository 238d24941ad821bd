//! A cubic B-spline through the joint angles of an arm's trail as a stage: smoothing as the last step.
//!
//! The trail's configurations are the control points, so that the curve rounds what posture adjustment did as well. It
//! leaves the tip's path a little; `guarded` raises the multiplicity of the control points where a rod would touch, up to
//! three, at which the curve follows the trail itself.
//!
//! # Source
//! Tang, Zhou & Xu (2023), section 4.1.3: "Finally, cubic spline processing is applied to the planned path".

use super::bspline::raise;
use super::entry::stage;
use super::polyhedra::polyhedra;
use super::posture::trails;
use super::{Build, Entry, Plan, Request, Stage, Value};
use crate::shorten::{cubic_spline, path_length};
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use world::kinematics::{AXES, Joints};
use world::space::polyhedra::{Apart, CarriedArm};
use world::space::{PolyhedraWorld, WorldKind};

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "joint_bspline",
    about: "a cubic B-spline over the configurations of an arm's trail, checked against the obstacles",
    revision: 1,
    needs: WorldKind::ArmAmongPolyhedra,
    columns: &["raised_points"],
    settings: Accepted::shape::<JointSpline>(),
    example: r#"
control = "trail"
guarded = true
points_per_span = 2
"#,
    build: Build::Stage(stage::<JointSpline>),
};

/// Between two points of the curve rods are checked at least this often.
const CHECK_RAD: f64 = 0.01;
/// Rods nearer than this are taken to touch.
const LEAST_CM: f64 = 0.1;

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct JointSpline {
    /// What the control points are.
    control: Control,
    /// Whether control points count more often where a rod would touch.
    guarded: bool,
    /// Points of the curve returned for each of its spans.
    #[schemars(range(min = 1, max = 64))]
    points_per_span: u32,
}

#[derive(Deserialize, JsonSchema, Clone, Copy, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
enum Control {
    /// The configurations of the trail.
    Trail,
    /// None: the trail stays as it is.
    Off,
}

impl Stage for JointSpline {
    fn tidied(&self, request: &Request<'_>, mut plan: Plan) -> Plan {
        if self.control == Control::Off {
            return plan;
        }
        let world = polyhedra(request.world);
        let arm = world.arm().expect("a checked study gives this stage an arm");
        let trail: Vec<Joints> = plan.path.iter().map(|q| std::array::from_fn(|i| q[i])).collect();
        let mut multiplicity = vec![1; trail.len()];
        let apart = arm.apart(world.bodies());
        let mut curve = self.curve(&trail, &multiplicity);
        while self.guarded && raise(&curve, &mut multiplicity, |a, b| is_clear(world, arm, a, b, &apart)) {
            curve = self.curve(&trail, &multiplicity);
        }
        let raised = multiplicity.iter().filter(|times| **times > 1).count();
        plan.counts.insert("raised_points", Value::Count(raised as u64));
        let mut smooth: Vec<Joints> = curve.into_iter().map(|(_, q)| q).collect();
        smooth.dedup();
        if request.trace {
            let made = trails(arm, &smooth);
            plan.traces.retain(|old| made.iter().all(|new| new.name != old.name));
            plan.traces.extend(made);
        }
        let tips: Vec<Vec<f64>> = smooth.iter().map(|q| arm.tip(q).as_slice().to_vec()).collect();
        plan.cost = Some(path_length(&tips));
        plan.path = smooth.iter().map(|q| q.to_vec()).collect();
        plan
    }
}

impl JointSpline {
    /// The curve as control point and configuration, in order; three joints at a time, since the weights are the same for all.
    fn curve(&self, trail: &[Joints], multiplicity: &[u8]) -> Vec<(usize, Joints)> {
        let half = |first: usize| {
            let control: Vec<[f64; 3]> =
                trail.iter().map(|q| [q[first], q[first + 1], q[first + 2]]).collect();
            cubic_spline(&control, multiplicity, self.points_per_span)
        };
        let joined = half(0).into_iter().zip(half(3));
        joined.map(|((place, a), (_, b))| (place, [a[0], a[1], a[2], b[0], b[1], b[2]])).collect()
    }
}

/// Whether no rod touches from `a` to `b`.
fn is_clear(world: &PolyhedraWorld, arm: &CarriedArm, a: &Joints, b: &Joints, apart: &Apart) -> bool {
    let most = (0..AXES).map(|i| (b[i] - a[i]).abs()).fold(0.0, f64::max);
    let count = (most / CHECK_RAD).ceil().max(1.0) as u32;
    arm.arm().chain().allows(b)
        && (1..=count).all(|k| {
            let share = f64::from(k) / f64::from(count);
            let between = std::array::from_fn(|i| a[i] + (b[i] - a[i]) * share);
            arm.is_clear(&between, world.bodies(), LEAST_CM, false, apart)
        })
}

#[cfg(test)]
mod tests;
