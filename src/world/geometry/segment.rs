//! Segments in space: the closed forms that everything round is built on.

use super::Vec3;

/// The points from `a` to `b`; a point if they coincide.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// One end.
    pub a: Vec3,
    /// The other end.
    pub b: Vec3,
}

impl Segment {
    /// The segment from `a` to `b`.
    pub fn new(a: Vec3, b: Vec3) -> Self {
        Self { a, b }
    }

    /// The point at `share` of the way from `a` to `b`.
    #[inline]
    pub fn at(&self, share: f64) -> Vec3 {
        self.a + (self.b - self.a) * share
    }
}

/// A distance and where it is attained.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nearest {
    /// The distance; 0 when the shapes touch or overlap.
    pub distance: f64,
    /// A nearest point of the first shape.
    pub on_a: Vec3,
    /// A nearest point of the second shape; equal to `on_a` when the shapes overlap.
    pub on_b: Vec3,
}

impl Nearest {
    /// The distance between two points that are known to be nearest.
    #[inline]
    pub(super) fn between(on_a: Vec3, on_b: Vec3) -> Self {
        Self { distance: (on_a - on_b).norm(), on_a, on_b }
    }
}

/// The share of the way along `segment` at which it comes nearest to `point`.
#[inline]
pub(super) fn share_nearest(point: &Vec3, segment: &Segment) -> f64 {
    let d = segment.b - segment.a;
    let length2 = d.dot(&d);
    if length2 > 0.0 { ((point - segment.a).dot(&d) / length2).clamp(0.0, 1.0) } else { 0.0 }
}

/// The nearest point of a segment to a point.
#[inline]
pub fn nearest_point_segment(point: &Vec3, segment: &Segment) -> Nearest {
    Nearest::between(*point, segment.at(share_nearest(point, segment)))
}

/// The distance from a point to a segment.
#[inline]
pub fn distance_point_segment(point: &Vec3, segment: &Segment) -> f64 {
    (point - segment.at(share_nearest(point, segment))).norm()
}

/// The shares `(s, t)` along `p` and `q` at which they are nearest.
///
/// The unconstrained minimum is written with cross products, not with the determinant `a·c − b²`: that one
/// loses half its digits at angles near 1e-8 rad, and the distance with it. Segments closer to parallel
/// than 1e-15 rad are treated as parallel; any start on `p` then leads to a nearest pair, because each
/// share is clamped after the other.
#[inline]
fn shares_segment_segment(p: &Segment, q: &Segment) -> (f64, f64) {
    let (d1, d2, r) = (p.b - p.a, q.b - q.a, q.a - p.a);
    let (a, e) = (d1.dot(&d1), d2.dot(&d2));
    if a == 0.0 {
        return (0.0, share_nearest(&p.a, q));
    }
    if e == 0.0 {
        return (share_nearest(&q.a, p), 0.0);
    }
    let normal = d1.cross(&d2);
    let normal2 = normal.dot(&normal);
    let start =
        if normal2 > 1e-30 * a * e { (r.cross(&d2).dot(&normal) / normal2).clamp(0.0, 1.0) } else { 0.0 };
    let t = ((d1 * start - r).dot(&d2) / e).clamp(0.0, 1.0);
    let s = ((r + d2 * t).dot(&d1) / a).clamp(0.0, 1.0);
    (s, t)
}

/// The nearest points of two segments; either may be a point.
///
/// When the segments are parallel and overlap, one of the many nearest pairs is returned.
///
/// # Source
/// Ericson, *Real-Time Collision Detection* (2005), section 5.1.9, with cross products for the minimum.
#[inline]
pub fn nearest_segment_segment(p: &Segment, q: &Segment) -> Nearest {
    let (s, t) = shares_segment_segment(p, q);
    Nearest::between(p.at(s), q.at(t))
}

/// The square of the distance between two segments: what a comparison with a radius needs.
#[inline]
pub fn squared_distance_segment_segment(p: &Segment, q: &Segment) -> f64 {
    let (s, t) = shares_segment_segment(p, q);
    (p.at(s) - q.at(t)).norm_squared()
}

/// The distance between two segments; either may be a point.
#[inline]
pub fn distance_segment_segment(p: &Segment, q: &Segment) -> f64 {
    squared_distance_segment_segment(p, q).sqrt()
}
