//! Any obstacle, and what a robot's capsules ask of it.

use super::{
    Aabb, Capsule, Convex, HalfSpace, Nearest, OrientedBox, Segment, Sphere, Vec3, distance_segment_box,
    distance_segment_convex, distance_segment_half_space, distance_segment_segment, intersects_capsule_box,
    intersects_capsule_capsule, intersects_segment_convex, nearest_point_segment, nearest_segment_box,
    nearest_segment_convex, nearest_segment_half_space, nearest_segment_segment,
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

/// `nearest` between axes, moved to the surface of the second shape, which is `radius` thick.
fn thicken_second(nearest: Nearest, radius: f64) -> Nearest {
    if nearest.distance <= radius {
        return Nearest { distance: 0.0, on_a: nearest.on_a, on_b: nearest.on_a };
    }
    let share = radius / nearest.distance;
    Nearest {
        distance: nearest.distance - radius,
        on_a: nearest.on_a,
        on_b: nearest.on_b + (nearest.on_a - nearest.on_b) * share,
    }
}

/// The nearest points of a segment and a solid.
pub fn nearest_segment_solid(segment: &Segment, solid: &Solid) -> Nearest {
    match solid {
        Solid::Sphere(s) => {
            let found = nearest_point_segment(&s.center, segment);
            let turned = Nearest { distance: found.distance, on_a: found.on_b, on_b: found.on_a };
            thicken_second(turned, s.radius)
        }
        Solid::Capsule(c) => thicken_second(nearest_segment_segment(segment, &c.segment), c.radius),
        Solid::Box(b) => nearest_segment_box(segment, b),
        Solid::Convex(c) => nearest_segment_convex(segment, c),
        Solid::HalfSpace(h) => nearest_segment_half_space(segment, h),
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

/// The distance from a point to a solid.
pub fn distance_point_solid(point: &Vec3, solid: &Solid) -> f64 {
    distance_segment_solid(&Segment::new(*point, *point), solid)
}

/// The distance between a capsule and a solid.
pub fn distance_capsule_solid(capsule: &Capsule, solid: &Solid) -> f64 {
    (distance_segment_solid(&capsule.segment, solid) - capsule.radius).max(0.0)
}

/// Whether a capsule and a solid share a point; touching is sharing.
pub fn intersects_capsule_solid(capsule: &Capsule, solid: &Solid) -> bool {
    match solid {
        Solid::Capsule(c) => intersects_capsule_capsule(capsule, c),
        Solid::Box(b) => intersects_capsule_box(capsule, b),
        Solid::Convex(c) => intersects_segment_convex(&capsule.segment, c, capsule.radius),
        Solid::Sphere(_) | Solid::HalfSpace(_) => {
            distance_segment_solid(&capsule.segment, solid) <= capsule.radius
        }
    }
}
