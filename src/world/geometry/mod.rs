//! Shapes and exact distances on the hot path.
//!
//! Pair functions are `distance_<a>_<b>`, `nearest_<a>_<b>` (the distance and where it is attained) and
//! `intersects_<a>_<b>`. Shapes are solid and closed: a distance is 0 when shapes touch or overlap, never
//! negative, and in three dimensions touching is contact. In the plane ([`planar`]) the caller says what
//! touching is, because reproduced papers differ there and lattice points do touch.
//!
//! Lengths are in any one unit; results are in that unit. Nothing here moves: sweeping a shape along a
//! motion is left to the floor that knows motions.

mod aabb;
mod convex;
mod error;
mod frame;
pub mod lanes;
mod oriented_box;
pub mod planar;
mod points;
mod round;
mod rounded;
mod segment;
mod solid;
#[cfg(test)]
pub(crate) mod tests;

pub use aabb::{Aabb, BroadPhase};
pub use convex::{
    Axis, Convex, Edge, Face, Plane, distance_segment_convex, nearest_by_edge, nearest_segment_convex,
    nearest_segment_convex_listed, nearest_segment_convex_listed_first, nearest_segment_convex_printed,
    nearest_segment_segment_literal, nearest_segment_segment_printed,
};
pub use error::GeometryError;
pub use frame::Frame;
pub use oriented_box::{OrientedBox, distance_segment_box};
pub use points::heights_over;
pub use round::{
    Capsule, HalfSpace, Sphere, distance_capsule_capsule, distance_segment_half_space,
    intersects_capsule_capsule, nearest_segment_half_space,
};
pub use rounded::{Placed, Rounded, intersects_placed_placed};
pub use segment::{
    Nearest, Segment, distance_point_segment, distance_segment_segment, nearest_point_segment,
    nearest_segment_segment, squared_distance_segment_segment,
};
pub use solid::{Solid, distance_segment_solid};

/// A point or a direction in space.
pub type Vec3 = nalgebra::Vector3<f64>;

/// A point or a direction in the plane.
pub type Vec2 = nalgebra::Vector2<f64>;
