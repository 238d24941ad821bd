//! Ends, plans and steps that the planners among polyhedra share.

use super::{Counts, Ending, Invalid, Plan, Request, Trace};
use crate::shorten::path_length;
use world::geometry::{Segment, Vec3};
use world::space::{PolyhedraWorld, World};

/// The world of a request with its start and goal.
pub(super) struct Posed<'a> {
    pub(super) world: &'a PolyhedraWorld,
    pub(super) start: Vec3,
    pub(super) goal: Vec3,
}

impl<'a> Posed<'a> {
    pub(super) fn new(request: &Request<'a>) -> Result<Self, Invalid> {
        let world = polyhedra(request.world);
        let start = world.free_point("start", request.start).map_err(Invalid)?;
        let goal = world.free_point("goal", request.goal).map_err(Invalid)?;
        Ok(Self { world, start, goal })
    }
}

/// The polyhedra that `world` is; a checked study gives these planners no other kind.
pub(super) fn polyhedra(world: &World) -> &PolyhedraWorld {
    world.as_polyhedra().expect("a checked study gives a planner the kind of world it needs")
}

/// The plan through `points`, or one without a path.
pub(super) fn plan(ending: Ending, points: &[Vec3], counts: Counts) -> Plan {
    let path: Vec<Vec<f64>> = match ending {
        Ending::Solved => points.iter().map(|point| point.as_slice().to_vec()).collect(),
        _ => Vec::new(),
    };
    let cost = (ending == Ending::Solved).then(|| path_length(&path));
    Plan { ending, path, cost, counts, traces: Vec::new(), reason: None }
}

/// The points of a plan's path.
pub(super) fn points(plan: &Plan) -> Vec<Vec3> {
    plan.path.iter().map(|point| Vec3::new(point[0], point[1], point[2])).collect()
}

/// Puts `points` in the place of a plan's path.
pub(super) fn replace(plan: &mut Plan, points: &[Vec3]) {
    plan.path = points.iter().map(|point| point.as_slice().to_vec()).collect();
    plan.cost = Some(path_length(&plan.path));
}

/// `points` as a trace.
pub(super) fn trace(name: &str, points: &[Vec3]) -> Trace {
    let values = points.iter().flat_map(|point| point.as_slice().to_vec()).collect();
    Trace { name: name.to_owned(), width: 3, values }
}

/// Whether `point` is where the point may be at all.
pub(super) fn is_within(world: &PolyhedraWorld, point: &Vec3) -> bool {
    let domain = world.domain();
    (0..3).all(|axis| (domain.min[axis]..=domain.max[axis]).contains(&point[axis]))
}

/// How many steps of `step` cover `length`, the last one shorter.
pub(super) fn steps(length: f64, step: f64) -> u64 {
    (length / step - 1e-9).ceil().max(0.0) as u64
}

/// The polyline through `points` with a point at every `step` along each of its segments.
pub(super) fn densified(points: &[Vec3], step: f64) -> Vec<Vec3> {
    let mut dense: Vec<Vec3> = points.first().into_iter().copied().collect();
    for pair in points.windows(2) {
        let segment = Segment::new(pair[0], pair[1]);
        let length = (pair[1] - pair[0]).norm();
        let inner = steps(length, step).saturating_sub(1);
        dense.extend((1..=inner).map(|k| segment.at(k as f64 * step / length)));
        dense.push(pair[1]);
    }
    dense
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_densified_line_keeps_its_corners_and_has_no_longer_step() {
        let corners = [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [3.0, 2.5, 0.0], [3.0, 2.5, 0.4]].map(Vec3::from);
        let dense = densified(&corners, 1.0);
        assert_eq!(dense.len(), 1 + 3 + 3 + 1);
        assert!(corners.iter().all(|corner| dense.contains(corner)));
        let lengths: Vec<f64> = dense.windows(2).map(|pair| (pair[1] - pair[0]).norm()).collect();
        assert!(lengths.iter().all(|length| *length <= 1.0 + 1e-12), "{lengths:?}");
        assert!((lengths.iter().sum::<f64>() - 5.9).abs() < 1e-12);
    }
}
