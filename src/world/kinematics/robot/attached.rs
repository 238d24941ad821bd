//! Whether the capsules of a body are on their links.
//!
//! A capsule in the wrong frame, or of the wrong link, floats beside the arm and collides where the arm is not. So a capsule must
//! reach its link: one of the two axes that the link joins, the straight line between them, or another capsule of the link
//! that does. The tool's own capsules lie on the tool by construction.

use super::Part;
use crate::geometry::{Segment, Vec3, distance_capsule_capsule, distance_segment_segment};
use crate::kinematics::Chain;

/// As far along an axis as any link is long.
const FAR_M: f64 = 1e3;

/// The first part that is off its link, by index, and by how much.
pub(super) fn first_off(parts: &[Part], chain: &Chain) -> Option<(usize, f64)> {
    let off_m: Vec<f64> = parts.iter().map(|part| off_link_m(part, chain)).collect();
    let mut is_on: Vec<bool> =
        parts.iter().zip(&off_m).map(|(part, off_m)| part.tool_share.is_some() || *off_m <= 0.0).collect();
    let reaches = |a: &Part, b: &Part| distance_capsule_capsule(&a.capsule, &b.capsule) <= 0.0;
    while let Some(next) = (0..parts.len()).find(|&i| {
        let mut others = parts.iter().zip(&is_on);
        !is_on[i] && others.any(|(other, on)| *on && other.link == parts[i].link && reaches(other, &parts[i]))
    }) {
        is_on[next] = true;
    }
    is_on.iter().position(|on| !on).map(|index| (index, off_m[index]))
}

/// How far a part is from the axes of its link and the line between them; not above 0 if it reaches one.
fn off_link_m(part: &Part, chain: &Chain) -> f64 {
    let along = |origin: Vec3, axis: Vec3| Segment::new(origin - axis * FAR_M, origin + axis * FAR_M);
    let mut lines = vec![along(Vec3::zeros(), Vec3::z())];
    if let Some(row) = part.link.checked_sub(1) {
        let near = Vec3::x() * -chain.joints()[row].a_m;
        let (s, c) = chain.twists()[row];
        lines.extend([Segment::new(near, Vec3::zeros()), along(near, Vec3::new(0.0, s, c))]);
    }
    let distances = lines.iter().map(|line| distance_segment_segment(line, &part.capsule.segment));
    distances.fold(f64::INFINITY, f64::min) - part.capsule.radius
}
