//! The data of pictures of a robot among solids, millimetres, in the form of cells: boxes by their corners, all else by
//! capsules.

use super::super::cell_queries::picture::{at_ends, round, stills};
use super::{ArmPlacement, Query};
use base::robot::{Joint, Kind};
use base::solid::{Form, Solid};
use engine::geometry::{Capsule, Frame};
use engine::kinematics::robot::capsule_around;
use engine::planner::Trace;
use engine::space::JointSpace;

/// Obstacles, the first being the floor if there is one, and the robot and its tip at each query's ends.
pub(in crate::family) fn traces(space: &JointSpace, floor_m: Option<f64>, queries: &[Query]) -> Vec<Trace> {
    let mut boxes = Vec::new();
    let mut rounds = Vec::new();
    for solid in space.obstacles().iter().skip(usize::from(floor_m.is_some())) {
        match solid.form {
            Form::Box(_) => boxes.extend(corners(solid)),
            _ => rounds.extend(capsule_around(solid, &Frame::IDENTITY).ok().as_ref().map(capsule_mm)),
        }
    }
    let height_mm = floor_m.map(|height| height * 1e3).into_iter().collect();
    let floor = Trace { name: "floor".to_owned(), width: 1, values: height_mm };
    let arms = at_ends(queries, |q| stance(space, q), |q| pose(space, q));
    stills(boxes, rounds.concat()).into_iter().chain([floor]).chain(arms).collect()
}

/// The corners of a box, x before y before z.
fn corners(solid: &Solid) -> Vec<f64> {
    let Form::Box(half) = solid.form else { return Vec::new() };
    let corner =
        |i: usize| std::array::from_fn(|axis| if i >> axis & 1 == 1 { half[axis] } else { -half[axis] });
    (0..8).flat_map(|i| solid.pose.point(corner(i)).map(|x| x * 1e3)).collect()
}

fn capsule_mm(capsule: &Capsule) -> [f64; 7] {
    round(&capsule.segment.a, &capsule.segment.b, capsule.radius)
}

/// Where the robot is at `q`, every part by the capsule around it; `None` for another number of angles.
pub(super) fn stance(space: &JointSpace, q: &[f64]) -> Option<ArmPlacement> {
    if q.len() != space.chain().joints().len() {
        return None;
    }
    let frames = space.chain().frames(q);
    let capsules =
        space.robot().solids.iter().filter_map(|(link, solid)| capsule_around(solid, &frames[*link]).ok());
    let capsules_mm = capsules.map(|capsule| capsule_mm(&capsule)).collect();
    let tip = space.chain().forward(q).origin * 1e3;
    Some(ArmPlacement { capsules_mm, tip_mm: [tip.x, tip.y, tip.z], clearance_mm: None })
}

/// Joint angles in degrees and slides in millimetres, last joint and tip in millimetres, and the tip's direction.
fn pose(space: &JointSpace, q: &[f64]) -> Vec<f64> {
    let frames = space.chain().frames(q);
    let tip = space.chain().forward(q);
    let last = frames[frames.len() - 1].origin * 1e3;
    let at = tip.origin * 1e3;
    let direction = tip.axis(2);
    let shown = |(joint, value): (&Joint, &f64)| {
        if joint.kind == Kind::Slides { value * 1e3 } else { value.to_degrees() }
    };
    let mut values: Vec<f64> = space.robot().joints.iter().zip(q).map(shown).collect();
    values.extend([last, at, direction].iter().flat_map(|v| [v.x, v.y, v.z]));
    values
}
