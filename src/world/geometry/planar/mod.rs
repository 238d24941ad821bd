//! Shapes in the plane, and contact decided exactly.
//!
//! Distances are closed forms in floating point. Contact is another matter: lattice points, integer circles
//! and boxes do touch, and whether touching is contact decides which paths a paper could have printed. So
//! `intersects_*` evaluates the sign of a polynomial of the given coordinates exactly, and the caller says by
//! [`Touch`] what a zero means.

mod contact;
mod exact;
mod polygon;
#[cfg(test)]
mod tests;

pub use contact::{
    intersects_point_circle, intersects_point_polygon, intersects_segment_circle, intersects_segment_polygon,
    intersects_segment_segment,
};
pub use polygon::ConvexPolygon;
use schemars::JsonSchema;
use serde::Deserialize;

use super::{
    Vec2,
    error::{GeometryError, finite_point, positive},
};

/// Whether shapes that only touch are in contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Touch {
    /// Touching is contact: shapes are closed.
    #[serde(rename = "collides")]
    Contact,
    /// Touching is free: only the inside of an obstacle is forbidden.
    Free,
}

/// The points from `a` to `b`; a point if they coincide.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment2 {
    /// One end.
    pub a: Vec2,
    /// The other end.
    pub b: Vec2,
}

impl Segment2 {
    /// The segment from `a` to `b`.
    pub fn new(a: Vec2, b: Vec2) -> Self {
        Self { a, b }
    }
}

/// All points within `radius` of `center`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Circle {
    /// The centre.
    pub center: Vec2,
    /// The radius, above 0.
    pub radius: f64,
}

impl Circle {
    /// The disc of `radius` about `center`.
    ///
    /// # Errors
    /// [`GeometryError::NotFinite`] or [`GeometryError::NotPositive`] if a number is not one or the radius
    /// is not above 0.
    pub fn new(center: Vec2, radius: f64) -> Result<Self, GeometryError> {
        finite_point("the circle's center", center.as_slice())?;
        Ok(Self { center, radius: positive("the circle's radius", radius)? })
    }
}

/// The distance from a point to a segment.
#[inline]
pub fn distance_point_segment(point: &Vec2, segment: &Segment2) -> f64 {
    let d = segment.b - segment.a;
    let length2 = d.dot(&d);
    let share = if length2 > 0.0 { ((point - segment.a).dot(&d) / length2).clamp(0.0, 1.0) } else { 0.0 };
    (point - (segment.a + d * share)).norm()
}

/// The distance between two segments.
///
/// In the plane segments that do not cross are nearest at an end of one of them.
pub fn distance_segment_segment(p: &Segment2, q: &Segment2) -> f64 {
    if intersects_segment_segment(p, q, Touch::Contact) {
        return 0.0;
    }
    distance_point_segment(&p.a, q)
        .min(distance_point_segment(&p.b, q))
        .min(distance_point_segment(&q.a, p))
        .min(distance_point_segment(&q.b, p))
}

/// The distance between a segment and a disc.
pub fn distance_segment_circle(segment: &Segment2, circle: &Circle) -> f64 {
    (distance_point_segment(&circle.center, segment) - circle.radius).max(0.0)
}

/// The distance between a segment and a convex polygon.
pub fn distance_segment_polygon(segment: &Segment2, polygon: &ConvexPolygon) -> f64 {
    if intersects_segment_polygon(segment, polygon, Touch::Contact) {
        return 0.0;
    }
    polygon.sides().map(|side| distance_segment_segment(segment, &side)).fold(f64::INFINITY, f64::min)
}
