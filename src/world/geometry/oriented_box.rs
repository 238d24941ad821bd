//! Boxes in any orientation.
//!
//! In the box's own frame the squared distance to the box along a segment is a convex, piecewise quadratic function of
//! the share. It has at most six breaks, where the segment crosses the six face planes. Its derivative is piecewise
//! linear and rises, so the minimum is found exactly, by bracketing the derivative's root between breaks. No iteration
//! to a tolerance is needed, and no case for faces, edges and corners.

use super::{
    Aabb, Frame, Segment, Vec3,
    error::{GeometryError, finite_point, positive},
};

/// A solid box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OrientedBox {
    frame: Frame,
    half: Vec3,
}

impl OrientedBox {
    /// The box centred on `frame`'s origin, with `size` along its axes.
    ///
    /// # Errors
    /// [`GeometryError::NotFinite`] or [`GeometryError::NotPositive`] if a number is not one or a side is
    /// not above 0.
    pub fn new(frame: Frame, size: Vec3) -> Result<Self, GeometryError> {
        finite_point("the box's center", frame.origin.as_slice())?;
        finite_point("the box's axes", frame.rotation.as_slice())?;
        positive("the box's size along x", size.x)?;
        positive("the box's size along y", size.y)?;
        positive("the box's size along z", size.z)?;
        Ok(Self { frame, half: size * 0.5 })
    }

    /// The frame of the box, at its centre.
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    /// Half the side along each axis of the box.
    pub fn half(&self) -> &Vec3 {
        &self.half
    }

    /// The eight corners; bit 0, 1 and 2 of the index are the sides along x, y and z.
    pub fn corners(&self) -> [Vec3; 8] {
        std::array::from_fn(|i| {
            let sign = |bit: usize| if i >> bit & 1 == 1 { 1.0 } else { -1.0 };
            self.frame.point(&self.half.component_mul(&Vec3::new(sign(0), sign(1), sign(2))))
        })
    }

    /// The smallest axis-aligned box about this one.
    pub fn aabb(&self) -> Aabb {
        let reach = self.frame.rotation.abs() * self.half;
        Aabb { min: self.frame.origin - reach, max: self.frame.origin + reach }
    }
}

/// How far each coordinate of `p` is outside `-half..half`, with its sign.
#[inline]
fn excess(p: &Vec3, half: &Vec3) -> Vec3 {
    p - p.sup(&-half).inf(half)
}

/// The share at which the segment `a + t d`, in the box's frame, comes nearest to the box.
#[inline]
fn share_nearest_box(a: &Vec3, d: &Vec3, half: &Vec3) -> f64 {
    // Half the derivative of the squared distance at share t.
    let slope = |t: f64| excess(&(a + d * t), half).dot(d);
    let mut low = 0.0;
    let mut slope_low = slope(0.0);
    if slope_low >= 0.0 {
        return 0.0;
    }
    let mut high = 1.0;
    let mut slope_high = slope(1.0);
    if slope_high <= 0.0 {
        return 1.0;
    }
    for axis in 0..3 {
        for face in [-half[axis], half[axis]] {
            // Division by 0 gives an infinity or NaN, and neither lies between low and high.
            let t = (face - a[axis]) / d[axis];
            if t > low && t < high {
                let at = slope(t);
                if at < 0.0 {
                    (low, slope_low) = (t, at);
                } else {
                    (high, slope_high) = (t, at);
                }
            }
        }
    }
    low + (high - low) * (slope_low / (slope_low - slope_high))
}

/// The distance between a segment and a box.
#[inline]
pub fn distance_segment_box(segment: &Segment, shape: &OrientedBox) -> f64 {
    let a = shape.frame.local(&segment.a);
    let d = shape.frame.local(&segment.b) - a;
    let share = share_nearest_box(&a, &d, &shape.half);
    excess(&(a + d * share), &shape.half).norm()
}
