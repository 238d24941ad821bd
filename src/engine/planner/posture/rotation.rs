//! Rotations as vectors: axis times angle, in the world's axes.

use nalgebra::Matrix3;
use world::geometry::{Frame, Vec3};

/// The rotation by the vector `w`.
pub(super) fn exp(w: &Vec3) -> Matrix3<f64> {
    let angle = w.norm();
    if angle > 0.0 { Frame::turned(&(w / angle), angle).rotation } else { Matrix3::identity() }
}

/// The vector of `rotation`, no longer than π.
pub(super) fn log(rotation: &Matrix3<f64>) -> Vec3 {
    let r = rotation;
    let axis = Vec3::new(r[(2, 1)] - r[(1, 2)], r[(0, 2)] - r[(2, 0)], r[(1, 0)] - r[(0, 1)]) / 2.0;
    let sine = axis.norm();
    let angle = libm::atan2(sine, (r.trace() - 1.0) / 2.0);
    if sine > 1e-12 { axis * (angle / sine) } else { Vec3::zeros() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponential_and_logarithm_go_round() {
        for w in [[0.1, -0.2, 0.3], [0.0, 0.0, 0.0], [1.5, 1.0, -0.7], [1e-7, 0.0, 0.0]].map(Vec3::from) {
            assert!((log(&exp(&w)) - w).norm() < 1e-12, "{w}");
            assert!((exp(&w) * exp(&-w) - Matrix3::identity()).norm() < 1e-14);
        }
        let turned = exp(&Vec3::new(0.0, 0.0, std::f64::consts::FRAC_PI_2)) * Vec3::x();
        assert!((turned - Vec3::y()).norm() < 1e-15, "counter-clockwise about z");
    }
}
