//! The data of pictures and tables of a cell: obstacles and the robot at the queries' ends, millimetres.

use super::{ArmPlacement, Query};
use engine::geometry::{Solid, Vec3};
use engine::planner::Trace;
use engine::space::cell::{Cell, Lines, Scratch};
use engine::space::roadmap::joints;

fn mm(point: &Vec3) -> [f64; 3] {
    (point * 1e3).into()
}

/// Boxes by their eight corners, round obstacles by ends and radius, and the robot's capsules and pose at each query's
/// ends, and how clear the straight line between them is.
pub(super) fn traces(lines: &Lines, queries: &[Query]) -> Vec<Trace> {
    let cell = lines.cell();
    let mut boxes = Vec::new();
    let mut rounds = Vec::new();
    for obstacle in cell.scene().obstacles() {
        match &obstacle.solid {
            Solid::Box(solid) => boxes.extend(solid.corners().iter().flat_map(mm)),
            Solid::Sphere(ball) => rounds.extend(round(&ball.center, &ball.center, ball.radius)),
            Solid::Capsule(capsule) => {
                rounds.extend(round(&capsule.segment.a, &capsule.segment.b, capsule.radius));
            }
            // Polyhedra are drawn as the boxes about them.
            Solid::HalfSpace(_) => {}
            Solid::Convex(solid) => {
                let bounds = solid.aabb();
                let corner = |i: usize| {
                    Vec3::from_fn(
                        |axis, _| if i >> axis & 1 == 1 { bounds.max[axis] } else { bounds.min[axis] },
                    )
                };
                boxes.extend((0..8).flat_map(|i| mm(&corner(i))));
            }
        }
    }
    let floor = floor(cell);
    let arms = at_ends(queries, |q| stance(cell, q), |q| pose(cell, q));
    let lines = straight_lines(lines, queries);
    stills(boxes, rounds).into_iter().chain(floor).chain(arms).chain(lines).collect()
}

/// Boxes, by their corners, and all that is drawn as capsules.
pub(in crate::family) fn stills(boxes: Vec<f64>, rounds: Vec<f64>) -> [Trace; 2] {
    [("boxes", 24, boxes), ("rounds", 7, rounds)].map(|(name, width, values)| Trace {
        name: name.to_owned(),
        width,
        values,
    })
}

/// The robot at the ends of queries: the capsules of its stance, and its pose in numbers.
pub(in crate::family) fn at_ends(
    queries: &[Query],
    stance: impl Fn(&[f64]) -> Option<ArmPlacement>,
    pose: impl Fn(&[f64]) -> Vec<f64>,
) -> Vec<Trace> {
    let ends = |query: &Query| {
        [("start", &query.start), ("goal", &query.goal)].map(|(end, q)| {
            let end = format!("{}/{end}", query.name);
            let stance = stance(q).expect("a query has as many numbers as the robot has joints");
            let values = pose(q);
            let body = Trace { name: format!("body {end}"), width: 7, values: stance.capsules_mm.concat() };
            [body, Trace { name: format!("pose {end}"), width: values.len(), values }]
        })
    };
    queries.iter().flat_map(ends).flatten().collect()
}

/// Of each query in turn, named after it and what is nearest: whether the local path from start to goal is free, and how far from
/// everything it stays, in mm. That is NaN where the joints cannot follow it.
fn straight_lines(lines: &Lines, queries: &[Query]) -> Vec<Trace> {
    let mut scratch = Scratch::default();
    let mut line = |query: &Query| {
        let [start, goal] = [&query.start, &query.goal]
            .map(|end| lines.pose(&joints(end).expect("a query of an arm has six angles")));
        let (clearance_m, near) = lines.clearance_m(&start, &goal, &mut scratch).unwrap_or((f64::NAN, None));
        let is_free = lines.join(&start, &goal, &mut scratch).is_ok();
        let near = near.map_or("the robot itself", |obstacle| &obstacle.name);
        let values = vec![f64::from(u8::from(is_free)), clearance_m * 1e3];
        Trace { name: format!("line {}/{near}", query.name), width: 2, values }
    };
    queries.iter().map(&mut line).collect()
}

/// Where the floor is, if it is not at 0: its height, or no number if there is none.
fn floor(cell: &Cell) -> Option<Trace> {
    let floors = cell.scene().obstacles().iter().filter_map(|obstacle| match &obstacle.solid {
        Solid::HalfSpace(half) => Some(-half.height(&Vec3::zeros()) * 1e3),
        _ => None,
    });
    let values: Vec<f64> = floors.collect();
    (values != [0.0]).then(|| Trace { name: "floor".to_owned(), width: 1, values })
}

/// Where the robot is at `q_rad`; `None` unless it has six angles.
pub(super) fn stance(cell: &Cell, q_rad: &[f64]) -> Option<ArmPlacement> {
    let q = joints(q_rad)?;
    let mut placed = Vec::new();
    cell.place(&q, &mut placed);
    let capsules_mm = placed.iter().map(|c| round(&c.segment.a, &c.segment.b, c.radius)).collect();
    let tip_mm = mm(&cell.robot().arm().chain().forward(&q).origin);
    Some(ArmPlacement { capsules_mm, tip_mm, clearance_mm: Some(cell.clearance_m(&q).0 * 1e3) })
}

/// Joint angles in degrees, flange and tip in millimetres, and the tool's direction.
fn pose(cell: &Cell, config: &[f64]) -> Vec<f64> {
    let q = joints(config).expect("a query of an arm has six angles");
    let chain = cell.robot().arm().chain();
    let tip = chain.forward(&q);
    let direction: [f64; 3] = tip.rotation.column(2).into_owned().into();
    let places = [mm(&chain.flange(&q).origin), mm(&tip.origin), direction];
    q.map(f64::to_degrees).into_iter().chain(places.concat()).collect()
}

/// A capsule about the segment between two points.
pub(in crate::family) fn round(a: &Vec3, b: &Vec3, radius_m: f64) -> [f64; 7] {
    let ([ax, ay, az], [bx, by, bz]) = (mm(a), mm(b));
    [ax, ay, az, bx, by, bz, radius_m * 1e3]
}
