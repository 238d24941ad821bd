//! Any obstacle, and how far a segment is from it.

use super::{
    Aabb, Capsule, Convex, HalfSpace, OrientedBox, Segment, Sphere, distance_segment_box,
    distance_segment_convex, distance_segment_half_space, distance_segment_segment, nearest_point_segment,
};

/// A still obstacle.
#[derive(Debug, Clone, PartialEq)]
pub enum Solid {
    /// A ball.
    Sphere(Sphere),
    /// A capsule.
    Capsule(Capsule),
    /// A box in any orientation.
    Box(OrientedBox),
    /// A convex polyhedron.
    Convex(Convex),
    /// A floor or wall.
    HalfSpace(HalfSpace),
}

impl Solid {
    /// The smallest axis-aligned box about the solid; everything for a half-space.
    pub fn aabb(&self) -> Aabb {
        match self {
            Self::Sphere(s) => Aabb { min: s.center, max: s.center }.grown(s.radius),
            Self::Capsule(c) => Aabb::of_capsule(c),
            Self::Box(b) => b.aabb(),
            Self::Convex(c) => *c.aabb(),
            Self::HalfSpace(_) => Aabb::ALL,
        }
    }
}

/// The distance between a segment and a solid.
pub fn distance_segment_solid(segment: &Segment, solid: &Solid) -> f64 {
    match solid {
        Solid::Sphere(s) => (nearest_point_segment(&s.center, segment).distance - s.radius).max(0.0),
        Solid::Capsule(c) => (distance_segment_segment(segment, &c.segment) - c.radius).max(0.0),
        Solid::Box(b) => distance_segment_box(segment, b),
        Solid::Convex(c) => distance_segment_convex(segment, c),
        Solid::HalfSpace(h) => distance_segment_half_space(segment, h),
    }
}
