//! Rigid frames as a rotation matrix and an origin.
//!
//! nalgebra's own isometries turn angles into rotations with std's trigonometry, which differs between
//! platforms; this one takes its sines from `libm`.

use super::Vec3;
use nalgebra::Matrix3;
use std::ops::Mul;

/// A right-handed frame: where its axes point and where its origin is, in a parent frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Columns are the frame's x, y and z axes.
    pub rotation: Matrix3<f64>,
    /// The frame's origin.
    pub origin: Vec3,
}

impl Frame {
    /// The parent frame itself.
    pub const IDENTITY: Self = Self {
        rotation: Matrix3::new(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0),
        origin: Vec3::new(0.0, 0.0, 0.0),
    };

    /// The parent frame moved to `origin`.
    pub fn at(origin: Vec3) -> Self {
        Self { origin, ..Self::IDENTITY }
    }

    /// The parent frame turned by `angle_rad` about the unit vector `axis` through the origin.
    ///
    /// # Source
    /// Rodrigues' formula.
    pub fn turned(axis: &Vec3, angle_rad: f64) -> Self {
        let (s, c) = libm::sincos(angle_rad);
        let cross = axis.cross_matrix();
        let rotation = Matrix3::identity() + cross * s + cross * cross * (1.0 - c);
        Self { rotation, origin: Vec3::zeros() }
    }

    /// The parent coordinates of a point given in this frame.
    #[inline]
    pub fn point(&self, local: &Vec3) -> Vec3 {
        self.rotation * local + self.origin
    }

    /// The coordinates in this frame of a point given in the parent.
    #[inline]
    pub fn local(&self, point: &Vec3) -> Vec3 {
        self.rotation.tr_mul(&(point - self.origin))
    }

    /// The frame in which `self * inverse` is the identity.
    #[must_use]
    pub fn inverse(&self) -> Self {
        let rotation = self.rotation.transpose();
        Self { rotation, origin: -(rotation * self.origin) }
    }

    /// Axis `index` (0 is x, 1 is y, 2 is z) in the parent frame.
    ///
    /// # Panics
    /// If `index` is above 2.
    #[inline]
    pub fn axis(&self, index: usize) -> Vec3 {
        self.rotation.column(index).into_owned()
    }
}

impl Mul for Frame {
    type Output = Self;

    /// `other`, given in `self`, in the parent of `self`.
    #[inline]
    fn mul(self, other: Self) -> Self {
        Self { rotation: self.rotation * other.rotation, origin: self.point(&other.origin) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    #[test]
    fn a_quarter_turn_about_z_takes_x_to_y_and_composition_takes_back_what_the_inverse_gives() {
        let turned = Frame::turned(&Vec3::z(), FRAC_PI_2);
        assert!((turned.axis(0) - Vec3::y()).norm() < 1e-15, "{turned:?}");
        assert!((turned.axis(1) + Vec3::x()).norm() < 1e-15, "{turned:?}");
        let axis = Vec3::new(2.0, -1.0, 2.0) / 3.0;
        let frame = Frame::at(Vec3::new(1.0, 2.0, 3.0)) * Frame::turned(&axis, 4.5);
        let p = Vec3::new(-0.3, 0.7, 0.2);
        assert!((frame.local(&frame.point(&p)) - p).norm() < 1e-15);
        assert!(((frame.inverse() * frame).point(&p) - p).norm() < 1e-15);
        assert!((frame.point(&axis) - frame.origin - axis).norm() < 1e-15, "the axis must stay");
    }
}
