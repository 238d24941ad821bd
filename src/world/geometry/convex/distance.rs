//! The distance between a segment and a convex polyhedron.
//!
//! The segment is first clipped by the planes; if something is left, they overlap. Otherwise a nearest pair
//! is a point of an edge and a point of the segment, or the foot of an end of the segment in a face. Only
//! faces with an end in front of them, and their edges, can hold one. An end whose foot lies in a face and
//! which is not above the other end is nearest at once: its height bounds every distance from below.

use super::{Convex, Edge, Face};
use crate::geometry::{Nearest, Segment, Vec3, nearest_segment_segment};

/// The share at which the segment enters the solid; `None` if it passes by.
///
/// Also collects, one bit a face, which faces have an end of the segment in front of them.
#[inline]
fn entry(segment: &Segment, convex: &Convex) -> (Option<f64>, u128) {
    let mut enter = 0.0_f64;
    let mut leave = 1.0_f64;
    let mut visible = 0_u128;
    for (index, face) in convex.faces.iter().enumerate() {
        let (a, b) = (face.plane.height(&segment.a), face.plane.height(&segment.b));
        if a <= 0.0 && b <= 0.0 {
            continue;
        }
        visible |= 1 << index;
        if a > 0.0 && b > 0.0 {
            leave = f64::NEG_INFINITY;
        } else if a > 0.0 {
            enter = enter.max(a / (a - b));
        } else {
            leave = leave.min(a / (a - b));
        }
    }
    ((enter <= leave).then_some(enter), visible)
}

/// Whether the foot of `point` in the face's plane lies within the face.
#[inline]
fn is_over(point: &Vec3, face: &Face, vertices: &[Vec3]) -> bool {
    let last = face.corners[face.corners.len() - 1];
    let mut from = vertices[last];
    face.corners.iter().all(|&corner| {
        let to = vertices[corner];
        let inside = (to - from).cross(&(point - from)).dot(&face.plane.normal) >= 0.0;
        from = to;
        inside
    })
}

/// The nearest points of a segment, which may be a point, and a convex polyhedron.
pub fn nearest_segment_convex(segment: &Segment, convex: &Convex) -> Nearest {
    nearest_by_edge(segment, convex, None).0
}

/// [`nearest_segment_convex`], with the edge on which the nearest point lies; none if it lies in a face or inside. The
/// answer is found sooner if `likely` is that edge, and is the same for any.
pub fn nearest_by_edge(
    segment: &Segment,
    convex: &Convex,
    likely: Option<usize>,
) -> (Nearest, Option<usize>) {
    let (inside, visible) = entry(segment, convex);
    if let Some(share) = inside {
        let common = segment.at(share);
        return (Nearest { distance: 0.0, on_a: common, on_b: common }, None);
    }
    let is_visible = |edge: &Edge| visible & (1 << edge.faces[0] | 1 << edge.faces[1]) != 0;
    let first = likely.or_else(|| convex.edges.iter().position(is_visible));
    let first = first.map(|index| (index, nearest_segment_segment(segment, &convex.side(index))));
    let beyond = first.map(|(_, found)| Beyond::new(segment, &found));
    let (mut best, is_least) = over_face(segment, convex, visible, beyond.as_ref());
    if is_least {
        return (best, None);
    }
    let mut nearest = None;
    for (index, edge) in convex.edges.iter().enumerate() {
        if !is_visible(edge) {
            continue;
        }
        let found = match first {
            Some((known, found)) if known == index => found,
            _ => {
                let side = convex.side(index);
                if beyond.as_ref().is_some_and(|beyond| beyond.holds(&side)) {
                    continue;
                }
                nearest_segment_segment(segment, &side)
            }
        };
        if found.distance < best.distance {
            (best, nearest) = (found, Some(index));
        }
    }
    (best, nearest)
}

/// The nearest foot of an end in one of the `visible` faces, and whether nothing can be nearer; what is `beyond` is left out.
#[inline]
fn over_face(segment: &Segment, convex: &Convex, visible: u128, beyond: Option<&Beyond>) -> (Nearest, bool) {
    let mut best = Nearest { distance: f64::INFINITY, on_a: segment.a, on_b: segment.a };
    for (index, face) in convex.faces.iter().enumerate() {
        if visible >> index & 1 == 0 {
            continue;
        }
        let (a, b) = (face.plane.height(&segment.a), face.plane.height(&segment.b));
        for (height, other, end) in [(a, b, segment.a), (b, a, segment.b)] {
            let may_be_nearest = height >= 0.0 && height < best.distance;
            let is_farther = beyond.is_some_and(|beyond| height > beyond.distance);
            if may_be_nearest && !is_farther && is_over(&end, face, &convex.vertices) {
                best = Nearest { distance: height, on_a: end, on_b: end - face.plane.normal * height };
                if height <= other {
                    return (best, true);
                }
            }
        }
    }
    (best, false)
}

/// What is farther from a segment than a certain edge, by extents along the line of their nearest points.
struct Beyond {
    direction: Vec3,
    /// A point whose coordinate along the direction is below this is farther away than the edge.
    below: f64,
    /// A point at a greater distance than this is farther away than the edge.
    distance: f64,
}

impl Beyond {
    fn new(segment: &Segment, Nearest { distance, on_a, on_b }: &Nearest) -> Self {
        let direction = (on_a - on_b) / distance.max(f64::MIN_POSITIVE);
        let least = direction.dot(&segment.a).min(direction.dot(&segment.b));
        // More than rounding can do to what is as far away, so that of equals the first is still found.
        let slack = 1e-6 * (1.0 + least.abs());
        Self { direction, below: least - distance - slack, distance: distance + slack }
    }

    fn holds(&self, edge: &Segment) -> bool {
        self.direction.dot(&edge.a).max(self.direction.dot(&edge.b)) < self.below
    }
}

/// The distance between a segment and a convex polyhedron.
pub fn distance_segment_convex(segment: &Segment, convex: &Convex) -> f64 {
    nearest_segment_convex(segment, convex).distance
}
