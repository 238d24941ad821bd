//! Straight ways of a tool: its place on a line, its orientation about one axis.

use crate::geometry::lanes::{self, Frames, Lane, Point, PoseRows, Row, Simd, SimdBase};
use crate::geometry::{Frame, Vec3};
use nalgebra::Matrix3;

/// The tool's way from one pose to another: `R(t) = even + cos · cos(tθ) + sin · sin(tθ)`.
pub(super) struct Way {
    from: Vec3,
    /// The tip's whole way.
    pub(super) along: Vec3,
    even: Matrix3<f64>,
    cos: Matrix3<f64>,
    sin: Matrix3<f64>,
    /// The whole turn of the orientation.
    pub(super) turn_rad: f64,
}

impl Way {
    pub(super) fn between(from: &Frame, to: &Frame) -> Self {
        let (axis, turn_rad) = axis_angle(&(to.rotation * from.rotation.transpose()));
        let sin = axis.cross_matrix() * from.rotation;
        let even = axis * (axis.transpose() * from.rotation);
        Self {
            from: from.origin,
            along: to.origin - from.origin,
            cos: from.rotation - even,
            even,
            sin,
            turn_rad,
        }
    }

    #[inline]
    pub(super) fn at(&self, share: f64) -> Frame {
        let (s, c) = libm::sincos(self.turn_rad * share);
        Frame { rotation: self.even + self.cos * c + self.sin * s, origin: self.from + self.along * share }
    }

    /// The tool at four shares.
    #[expect(clippy::inline_always, reason = "lanes are compiled for the instructions of their caller")]
    #[inline(always)]
    pub(super) fn at_lanes<S: Simd>(&self, simd: S, shares: Row) -> PoseRows {
        let share = Lane::load_array(simd, shares);
        let (s, c) = lanes::sincos(share * self.turn_rad);
        let [even, cos, sin] =
            [&self.even, &self.cos, &self.sin].map(|m| Frame { rotation: *m, origin: Vec3::zeros() });
        let [even, cos, sin] =
            [Frames::splat(simd, &even), Frames::splat(simd, &cos), Frames::splat(simd, &sin)];
        let origin = Point::splat(simd, &self.from).plus(share, Point::splat(simd, &self.along));
        let mut axes = even.axes;
        for (i, axis) in axes.iter_mut().enumerate() {
            *axis = axis.plus(c, cos.axes[i]).plus(s, sin.axes[i]);
        }
        Frames { axes, origin }.to_rows()
    }
}

/// The axis and the angle in `[0, π]` of a rotation; of half turns one of the two axes.
fn axis_angle(r: &Matrix3<f64>) -> (Vec3, f64) {
    let (x, y, z) = (r[(2, 1)] - r[(1, 2)], r[(0, 2)] - r[(2, 0)], r[(1, 0)] - r[(0, 1)]);
    let skew = Vec3::new(x, y, z);
    let trace = r.trace();
    let angle = libm::atan2(skew.norm(), trace - 1.0);
    if skew.norm() > 1e-6 {
        return (skew / skew.norm(), angle);
    }
    if trace > 0.0 {
        return (Vec3::x(), 0.0);
    }
    // Near a half turn (R + I) / 2 is the axis times itself; its longest column is read.
    let outer = (r + Matrix3::identity()) * 0.5;
    let column = (0..3).max_by(|a, b| outer[(*a, *a)].total_cmp(&outer[(*b, *b)])).unwrap_or(0);
    let axis = outer.column(column).into_owned();
    let axis = axis / axis.norm();
    (if axis.dot(&skew) < 0.0 { -axis } else { axis }, angle)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_way_ends_where_it_should_and_turns_evenly_even_by_half_a_turn() {
        let axes = [Vec3::x(), Vec3::new(1.0, 2.0, -2.0) / 3.0, Vec3::new(0.0, 0.6, -0.8)];
        for (axis, angle) in
            axes.iter().flat_map(|axis| [0.0, 1e-8, 0.3, 2.9, std::f64::consts::PI].map(|a| (axis, a)))
        {
            let from = Frame::at(Vec3::new(1.0, 2.0, 3.0)) * Frame::turned(&Vec3::y(), 0.7);
            let to =
                Frame { rotation: Frame::turned(axis, angle).rotation * from.rotation, origin: Vec3::z() };
            let way = Way::between(&from, &to);
            assert!((way.turn_rad - angle).abs() < 1e-6, "{axis:?} {angle}: {}", way.turn_rad);
            for (share, end) in [(0.0, &from), (1.0, &to)] {
                let got = way.at(share);
                assert!((got.rotation - end.rotation).norm() < 1e-6, "{axis:?} {angle} at {share}");
                assert!((got.origin - end.origin).norm() < 1e-12);
            }
            let step = |a: f64, b: f64| (way.at(a).rotation.transpose() * way.at(b).rotation).trace();
            assert!((step(0.1, 0.3) - step(0.6, 0.8)).abs() < 1e-9, "{axis:?} {angle}");
        }
    }
}
