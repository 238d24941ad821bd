//! Axis-aligned boxes and the broad phase over them.

use super::{Capsule, Segment, Vec3};

/// An axis-aligned box; sides may be infinite.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Aabb {
    /// The corner with the smallest coordinates.
    pub min: Vec3,
    /// The corner with the greatest coordinates.
    pub max: Vec3,
}

impl Aabb {
    /// The box that holds everything.
    pub const ALL: Self = Self {
        min: Vec3::new(f64::NEG_INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY),
        max: Vec3::new(f64::INFINITY, f64::INFINITY, f64::INFINITY),
    };

    /// The smallest box about `points`; of none, a box that overlaps no bounded one.
    pub fn of_points(points: &[Vec3]) -> Self {
        let none = Self { min: Self::ALL.max, max: Self::ALL.min };
        points.iter().fold(none, |b, p| Self { min: b.min.inf(p), max: b.max.sup(p) })
    }

    /// The smallest box about a segment.
    #[inline]
    pub fn of_segment(segment: &Segment) -> Self {
        Self { min: segment.a.inf(&segment.b), max: segment.a.sup(&segment.b) }
    }

    /// The smallest box about a capsule.
    #[inline]
    pub fn of_capsule(capsule: &Capsule) -> Self {
        Self::of_segment(&capsule.segment).grown(capsule.radius)
    }

    /// This box with every side moved out by `margin`.
    #[inline]
    #[must_use]
    pub fn grown(&self, margin: f64) -> Self {
        let margin = Vec3::repeat(margin);
        Self { min: self.min - margin, max: self.max + margin }
    }

    /// Whether the boxes share a point; touching is sharing.
    #[inline]
    pub fn overlaps(&self, other: &Self) -> bool {
        self.min.x <= other.max.x
            && other.min.x <= self.max.x
            && self.min.y <= other.max.y
            && other.min.y <= self.max.y
            && self.min.z <= other.max.z
            && other.min.z <= self.max.z
    }
}

/// Which of a few still shapes may touch a moving one.
///
/// A cell has tens of obstacles, and a linear scan over their boxes then beats every tree.
#[derive(Debug, Clone, Default)]
pub struct BroadPhase {
    boxes: Vec<Aabb>,
}

impl BroadPhase {
    /// A broad phase over `boxes`; shapes are known by their position in it.
    pub fn new(boxes: Vec<Aabb>) -> Self {
        Self { boxes }
    }

    /// The positions of the boxes that share a point with `query`, in ascending order.
    #[inline]
    pub fn candidates(&self, query: &Aabb) -> impl Iterator<Item = usize> {
        self.boxes.iter().enumerate().filter(move |(_, b)| b.overlaps(query)).map(|(i, _)| i)
    }
}
