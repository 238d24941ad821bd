//! A cubic B-spline through a tip path as a stage.
//!
//! A B-spline leaves its control points behind wherever the path bends. On the few nodes of a straightened path it
//! therefore cuts into the obstacles that the path goes round. With a control point at every step it still cuts
//! corners, by up to a fifth of a step. With `guarded`, control points near a contact are repeated up to three times,
//! at which the curve follows the path itself.

use super::entry::stage;
use super::polyhedra::{densified, points, polyhedra, replace, trace};
use super::{Build, Entry, Plan, Request, Stage, Value};
use crate::shorten::cubic_spline;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use world::geometry::{Segment, Vec3};
use world::space::{PolyhedraWorld, WorldKind};

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "bspline",
    about: "a cubic B-spline over the path's nodes or over one control point a step, checked against the obstacles",
    revision: 1,
    needs: WorldKind::Polyhedra,
    columns: &["cut_in_cm", "raised_points"],
    settings: Accepted::shape::<Spline>(),
    example: r#"
control = "steps"
guarded = true
points_per_span = 4
"#,
    build: Build::Stage(stage::<Spline>),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Spline {
    /// What the control points are.
    control: Control,
    /// Whether control points count more often where the curve touches an obstacle.
    guarded: bool,
    /// Points of the curve returned for each of its spans.
    #[schemars(range(min = 1, max = 64))]
    points_per_span: u32,
}

#[derive(Deserialize, JsonSchema, Clone, Copy, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
enum Control {
    /// The path's nodes.
    Nodes,
    /// A point at every step along the path.
    Steps,
    /// None: the path stays as it is.
    Off,
}

/// A curve as control point and place, in order.
type Curve = Vec<(usize, [f64; 3])>;

impl Stage for Spline {
    fn tidied(&self, request: &Request<'_>, mut plan: Plan) -> Plan {
        if self.control == Control::Off {
            return plan;
        }
        let world = polyhedra(request.world);
        let nodes = points(&plan);
        let control: Vec<[f64; 3]> = match self.control {
            Control::Nodes => nodes.iter().map(|node| (*node).into()).collect(),
            Control::Steps => densified(&nodes, world.step()).iter().map(|node| (*node).into()).collect(),
            Control::Off => Vec::new(),
        };
        let mut multiplicity = vec![1; control.len()];
        let mut curve = cubic_spline(&control, &multiplicity, self.points_per_span);
        plan.counts.insert("cut_in_cm", Value::Real(depth(world, &curve)));
        while self.guarded
            && raise(&curve, &mut multiplicity, |a, b| {
                world.is_clear(&Segment::new((*a).into(), (*b).into()))
            })
        {
            curve = cubic_spline(&control, &multiplicity, self.points_per_span);
        }
        let raised = multiplicity.iter().filter(|times| **times > 1).count();
        plan.counts.insert("raised_points", Value::Count(raised as u64));
        if request.trace {
            plan.traces.push(trace("polyline", &nodes));
        }
        let mut smooth: Vec<Vec3> = curve.into_iter().map(|(_, point)| point.into()).collect();
        smooth.dedup();
        replace(&mut plan, &smooth);
        plan
    }
}

/// Lets the control points of every span that is not clear between two points of the curve count once more; whether any could.
pub(super) fn raise<T>(
    curve: &[(usize, T)],
    multiplicity: &mut [u8],
    is_clear: impl Fn(&T, &T) -> bool,
) -> bool {
    let mut raised = false;
    let mut last = None;
    for pair in curve.windows(2) {
        let span = pair[1].0;
        if last == Some(span) || is_clear(&pair[0].1, &pair[1].1) {
            continue;
        }
        last = Some(span);
        for times in multiplicity.iter_mut().skip(span.saturating_sub(1)).take(4) {
            raised |= *times < 3;
            *times = (*times + 1).min(3);
        }
    }
    raised
}

/// How deep a point of the curve lies in an obstacle.
fn depth(world: &PolyhedraWorld, curve: &Curve) -> f64 {
    let below = |point: &Vec3| {
        let within = |convex: &world::geometry::Convex| {
            convex.faces().iter().map(|face| -face.plane.height(point)).fold(f64::INFINITY, f64::min)
        };
        world.obstacles().iter().map(within).fold(0.0, f64::max)
    };
    curve.iter().map(|(_, point)| below(&(*point).into())).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests;
