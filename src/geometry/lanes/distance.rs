//! Distances of segments in lanes: the closed forms of the scalar code, with choices in place of branches.
#![expect(
    clippy::inline_always,
    reason = "lanes are compiled for the instructions of the function they end up in"
)]

use super::{ExtractToken, Frames, Lane, Point, Select, Simd, SimdBase, SimdFloat, SimdMask, splat3};
use crate::geometry::{HalfSpace, OrientedBox, Vec3};

/// The height of a segment above a half-space; negative inside.
#[inline(always)]
pub fn height_half_space<S: Simd>(simd: S, a: Point<S>, b: Point<S>, shape: &HalfSpace) -> Lane<S> {
    let normal = Point::splat(simd, shape.normal());
    let at_origin = shape.height(&Vec3::zeros());
    normal.dot(a).min(normal.dot(b)) + at_origin
}

/// Which balls about two segments `[a, b]` and `[c, d]`, as long as given, are further apart than `reach_m`: one bit a
/// case.
#[inline(always)]
pub fn far_balls<S: Simd>(p: [Point<S>; 2], q: [Point<S>; 2], reach_m: Lane<S>) -> u64 {
    let apart = (p[0] + p[1]) - (q[0] + q[1]);
    apart.dot(apart).simd_gt(reach_m * reach_m * 4.0).to_bitmask()
}

/// The squared distance between segments `p` and `q`; NaN if one is a point.
///
/// # Source
/// As [`squared_distance_segment_segment`](crate::geometry::squared_distance_segment_segment).
#[inline(always)]
pub fn squared_distance_segment_segment_lanes<S: Simd>(p: [Point<S>; 2], q: [Point<S>; 2]) -> Lane<S> {
    let (d1, d2, r) = (p[1] - p[0], q[1] - q[0], q[0] - p[0]);
    let simd = r.x.token();
    let (a, e) = (d1.dot(d1), d2.dot(d2));
    let normal = d1.cross(d2);
    let normal2 = normal.dot(normal);
    let (zero, one) = (Lane::splat(simd, 0.0), Lane::splat(simd, 1.0));
    let start = (r.cross(d2).dot(normal) / normal2).max(zero).min(one);
    let start = normal2.simd_gt(a * e * 1e-30).select(start, zero);
    let t = ((d1.scaled(start) - r).dot(d2) / e).max(zero).min(one);
    let s = ((r.plus(t, d2)).dot(d1) / a).max(zero).min(one);
    let gap = p[0].plus(s, d1) - q[0].plus(t, d2);
    // A share of a point is NaN or was clamped away from it; the lengths say so.
    let sound = a.min(e).simd_gt(0.0);
    sound.select(gap.dot(gap), Lane::splat(simd, f64::NAN))
}

#[inline(always)]
fn excess<S: Simd>(p: Lane<S>, half: Lane<S>) -> Lane<S> {
    p - p.max(-half).min(half)
}

/// Segments from `a` along `d` in the frame of a box whose half sides are `half`.
#[derive(Clone, Copy)]
struct InBox<S: Simd> {
    a: [Lane<S>; 3],
    d: [Lane<S>; 3],
    half: [Lane<S>; 3],
}

impl<S: Simd> InBox<S> {
    /// How far each coordinate is outside at shares `t`.
    #[inline(always)]
    fn outside(&self, t: Lane<S>) -> Point<S> {
        Point {
            x: excess(self.d[0].mul_add(t, self.a[0]), self.half[0]),
            y: excess(self.d[1].mul_add(t, self.a[1]), self.half[1]),
            z: excess(self.d[2].mul_add(t, self.a[2]), self.half[2]),
        }
    }

    /// Half the derivative of the squared distance at shares `t`.
    #[inline(always)]
    fn slope(&self, t: Lane<S>) -> Lane<S> {
        let out = self.outside(t);
        out.x.mul_add(self.d[0], out.y.mul_add(self.d[1], out.z * self.d[2]))
    }
}

/// The squared distance between a segment and a box.
///
/// # Source
/// As [`distance_segment_box`](crate::geometry::distance_segment_box).
#[inline(always)]
pub fn squared_distance_segment_box_lanes<S: Simd>(
    simd: S,
    p: [Point<S>; 2],
    shape: &OrientedBox,
) -> Lane<S> {
    let (frame, half) = (Frames::splat(simd, shape.frame()), shape.half());
    let ([x, y, z], from, along) = (frame.axes, p[0] - frame.origin, p[1] - p[0]);
    let within = InBox {
        a: [x.dot(from), y.dot(from), z.dot(from)],
        d: [x.dot(along), y.dot(along), z.dot(along)],
        half: splat3(simd, [half.x, half.y, half.z]),
    };
    let (zero, one) = (Lane::splat(simd, 0.0), Lane::splat(simd, 1.0));
    let (mut low, mut slope_low, mut high, mut slope_high) =
        (zero, within.slope(zero), one, within.slope(one));
    let (at_start, at_end) = (slope_low.simd_ge(0.0), slope_high.simd_le(0.0));
    for axis in 0..3 {
        let inverse = one / within.d[axis];
        for face in [-within.half[axis], within.half[axis]] {
            // An infinity or NaN lies between no low and high.
            let t = (face - within.a[axis]) * inverse;
            let inside = t.simd_gt(low) & t.simd_lt(high);
            if !inside.any_true() {
                continue;
            }
            let at = within.slope(t);
            let (falls, rises) = (inside & at.simd_lt(0.0), inside & at.simd_ge(0.0));
            (low, slope_low) = (falls.select(t, low), falls.select(at, slope_low));
            (high, slope_high) = (rises.select(t, high), rises.select(at, slope_high));
        }
    }
    let share = (high - low).mul_add(slope_low / (slope_low - slope_high), low);
    let out = within.outside(at_start.select(zero, at_end.select(one, share)));
    out.dot(out)
}
