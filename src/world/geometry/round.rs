//! Capsules, spheres and half-spaces: a segment or a point with a radius, and the floor.

use super::{
    Frame, Nearest, Segment, Vec3, distance_segment_segment,
    error::{GeometryError, finite, finite_point, positive},
    squared_distance_segment_segment,
};

/// All points within `radius` of a segment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Capsule {
    /// The axis; a capsule whose axis is a point is a ball.
    pub segment: Segment,
    /// The radius, not negative.
    pub radius: f64,
}

impl Capsule {
    /// The capsule of `radius` about the segment from `a` to `b`.
    ///
    /// # Errors
    /// [`GeometryError::NotFinite`] or [`GeometryError::NotPositive`] if a number is not one or the radius
    /// is not above 0.
    pub fn new(a: Vec3, b: Vec3, radius: f64) -> Result<Self, GeometryError> {
        finite_point("the capsule's first end", a.as_slice())?;
        finite_point("the capsule's second end", b.as_slice())?;
        Ok(Self { segment: Segment::new(a, b), radius: positive("the capsule's radius", radius)? })
    }

    /// The same where `frame` is.
    #[must_use]
    pub fn placed(&self, frame: &Frame) -> Self {
        let [a, b] = [self.segment.a, self.segment.b].map(|end| frame.point(&end));
        Self { segment: Segment::new(a, b), radius: self.radius }
    }
}

/// All points within `radius` of `center`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere {
    /// The centre.
    pub center: Vec3,
    /// The radius, above 0.
    pub radius: f64,
}

impl Sphere {
    /// The ball of `radius` about `center`.
    ///
    /// # Errors
    /// [`GeometryError::NotFinite`] or [`GeometryError::NotPositive`] if a number is not one or the radius
    /// is not above 0.
    pub fn new(center: Vec3, radius: f64) -> Result<Self, GeometryError> {
        finite_point("the sphere's center", center.as_slice())?;
        Ok(Self { center, radius: positive("the sphere's radius", radius)? })
    }
}

/// All points `x` with `normal · x <= offset`: a floor if the normal points up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HalfSpace {
    /// The unit vector out of the solid.
    normal: Vec3,
    /// How far the boundary is from the origin along the normal.
    offset: f64,
}

impl HalfSpace {
    /// Everything below `height` along z.
    ///
    /// # Errors
    /// [`GeometryError::NotFinite`] if the height is not a finite number.
    pub fn below(height: f64) -> Result<Self, GeometryError> {
        Ok(Self { normal: Vec3::z(), offset: finite("the floor's height", height)? })
    }

    /// Everything behind the plane through `point` whose outward direction is `normal`, of any length.
    ///
    /// # Errors
    /// [`GeometryError::NotFinite`] or [`GeometryError::NotPositive`] if a number is not one or the normal
    /// has no length.
    pub fn behind(point: &Vec3, normal: &Vec3) -> Result<Self, GeometryError> {
        finite_point("the plane's point", point.as_slice())?;
        finite_point("the plane's normal", normal.as_slice())?;
        let normal = normal / positive("the length of the plane's normal", normal.norm())?;
        Ok(Self { normal, offset: normal.dot(point) })
    }

    /// The unit vector out of the solid.
    pub fn normal(&self) -> &Vec3 {
        &self.normal
    }

    /// How far `point` is outside the solid; negative inside.
    #[inline]
    pub fn height(&self, point: &Vec3) -> f64 {
        self.normal.dot(point) - self.offset
    }
}

/// The nearest points of a segment and a half-space: the lower end and its foot.
#[inline]
pub fn nearest_segment_half_space(segment: &Segment, half_space: &HalfSpace) -> Nearest {
    let (a, b) = (half_space.height(&segment.a), half_space.height(&segment.b));
    let (height, end) = if b < a { (b, segment.b) } else { (a, segment.a) };
    let distance = height.max(0.0);
    Nearest { distance, on_a: end, on_b: end - half_space.normal * distance }
}

/// The distance from a segment to a half-space.
#[inline]
pub fn distance_segment_half_space(segment: &Segment, half_space: &HalfSpace) -> f64 {
    half_space.height(&segment.a).min(half_space.height(&segment.b)).max(0.0)
}

/// The distance between two capsules.
#[inline]
pub fn distance_capsule_capsule(p: &Capsule, q: &Capsule) -> f64 {
    (distance_segment_segment(&p.segment, &q.segment) - p.radius - q.radius).max(0.0)
}

/// Whether two capsules share a point; touching is sharing.
#[inline]
pub fn intersects_capsule_capsule(p: &Capsule, q: &Capsule) -> bool {
    let reach = p.radius + q.radius;
    squared_distance_segment_segment(&p.segment, &q.segment) <= reach * reach
}
