//! Distances of segments in rough lanes: the closed forms of the scalar code, with choices in place of branches.
//!
//! The rounding error of the squared distance of two segments is about the last digit of an f32 times the square of the
//! lengths involved. This holds for nearly parallel segments too: their nearest points are ill-determined, but the distance
//! hardly depends on them. Its root is as good as [`ROUGHNESS`](super::ROUGHNESS) asks only above [`ROUGH_LEAST`](super::ROUGH_LEAST).
#![expect(
    clippy::inline_always,
    reason = "lanes are compiled for the instructions of the function they end up in"
)]

use super::{ExtractToken, Point, Rough, Select, Simd, SimdBase, SimdFloat, SimdMask};
use crate::geometry::{OrientedBox, Solid, Vec3};

/// The nearest f32 to each coordinate.
fn rough(v: &Vec3) -> [f32; 3] {
    [v.x as f32, v.y as f32, v.z as f32]
}

/// A solid that has lanes.
#[derive(Debug, Clone, PartialEq)]
pub enum RoughSolid {
    /// A box.
    Box(RoughBox),
    /// All points `x` with `normal · x <= offset`.
    HalfSpace {
        /// The unit vector out of it.
        normal: [f32; 3],
        /// How far its boundary is from the origin along the normal.
        offset: f32,
    },
    /// All points within `radius` of the segment between two ends.
    Capsule {
        /// The ends of the axis.
        ends: [[f32; 3]; 2],
        /// The radius.
        radius: f32,
    },
}

impl RoughSolid {
    /// `solid` in f32; `None` if it has no lanes.
    pub fn from_solid(solid: &Solid) -> Option<Self> {
        match solid {
            Solid::Box(shape) => Some(Self::Box(RoughBox::from_box(shape))),
            Solid::HalfSpace(shape) => {
                let offset = -shape.height(&Vec3::zeros()) as f32;
                Some(Self::HalfSpace { normal: rough(shape.normal()), offset })
            }
            Solid::Capsule(capsule) => {
                let ends = [rough(&capsule.segment.a), rough(&capsule.segment.b)];
                Some(Self::Capsule { ends, radius: capsule.radius as f32 })
            }
            Solid::Sphere(_) | Solid::Convex(_) => None,
        }
    }

    /// How far axes are from the solid; 0 or less in it.
    #[inline(always)]
    pub fn distance<S: Simd>(&self, simd: S, axis: [Point<Rough<S>>; 2]) -> Rough<S> {
        match self {
            Self::Box(shape) => squared_distance_segment_box_lanes(simd, axis, shape).sqrt(),
            Self::HalfSpace { normal, offset } => height_half_space(simd, axis, *normal, *offset),
            Self::Capsule { ends, radius } => {
                let own = [Point::splat_rough(simd, ends[0]), Point::splat_rough(simd, ends[1])];
                squared_distance_segment_segment_lanes(axis, own).sqrt() - *radius
            }
        }
    }
}

/// A box in f32.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RoughBox {
    axes: [[f32; 3]; 3],
    origin: [f32; 3],
    half: [f32; 3],
}

impl RoughBox {
    /// `shape` in f32.
    pub fn from_box(shape: &OrientedBox) -> Self {
        let frame = shape.frame();
        Self {
            axes: [0, 1, 2].map(|axis| rough(&frame.axis(axis))),
            origin: rough(&frame.origin),
            half: rough(shape.half()),
        }
    }
}

/// The height of a segment above a half-space; negative inside.
#[inline(always)]
pub fn height_half_space<S: Simd>(
    simd: S,
    [a, b]: [Point<Rough<S>>; 2],
    normal: [f32; 3],
    offset: f32,
) -> Rough<S> {
    let normal = Point::splat_rough(simd, normal);
    normal.dot(a).min(normal.dot(b)) - offset
}

/// Which balls about two segments `[a, b]` and `[c, d]`, as long as given, are further apart than `reach_m`: one bit a
/// case.
#[inline(always)]
pub fn far_balls<S: Simd>(p: [Point<Rough<S>>; 2], q: [Point<Rough<S>>; 2], reach_m: Rough<S>) -> u64 {
    let apart = (p[0] + p[1]) - (q[0] + q[1]);
    apart.dot(apart).simd_gt(reach_m * reach_m * 4.0).to_bitmask()
}

/// The squared distance between segments `p` and `q`; NaN if one is a point.
///
/// # Source
/// As [`squared_distance_segment_segment`](crate::geometry::squared_distance_segment_segment).
#[inline(always)]
pub fn squared_distance_segment_segment_lanes<S: Simd>(
    p: [Point<Rough<S>>; 2],
    q: [Point<Rough<S>>; 2],
) -> Rough<S> {
    let (d1, d2, r) = (p[1] - p[0], q[1] - q[0], q[0] - p[0]);
    let simd = r.x.token();
    let (a, e) = (d1.dot(d1), d2.dot(d2));
    let normal = d1.cross(d2);
    let normal2 = normal.dot(normal);
    let zero = Rough::splat(simd, 0.0);
    let one = Rough::splat(simd, 1.0);
    let start = (r.cross(d2).dot(normal) / normal2).max(zero).min(one);
    let start = normal2.simd_gt(a * e * 1e-12).select(start, zero);
    let t = ((d1.scaled(start) - r).dot(d2) / e).max(zero).min(one);
    let s = ((r.plus(t, d2)).dot(d1) / a).max(zero).min(one);
    let gap = p[0].plus(s, d1) - q[0].plus(t, d2);
    // A share of a point is NaN or was clamped away from it; the lengths say so.
    let sound = a.min(e).simd_gt(0.0);
    sound.select(gap.dot(gap), Rough::splat(simd, f32::NAN))
}

#[inline(always)]
fn excess<S: Simd>(p: Rough<S>, half: Rough<S>) -> Rough<S> {
    p - p.max(-half).min(half)
}

/// Segments from `a` along `d` in the frame of a box whose half sides are `half`.
#[derive(Clone, Copy)]
struct InBox<S: Simd> {
    a: [Rough<S>; 3],
    d: [Rough<S>; 3],
    half: [Rough<S>; 3],
}

impl<S: Simd> InBox<S> {
    /// How far each coordinate is outside at shares `t`.
    #[inline(always)]
    fn outside(&self, t: Rough<S>) -> Point<Rough<S>> {
        Point {
            x: excess(self.d[0].mul_add(t, self.a[0]), self.half[0]),
            y: excess(self.d[1].mul_add(t, self.a[1]), self.half[1]),
            z: excess(self.d[2].mul_add(t, self.a[2]), self.half[2]),
        }
    }

    /// Half the derivative of the squared distance at shares `t`.
    #[inline(always)]
    fn slope(&self, t: Rough<S>) -> Rough<S> {
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
    p: [Point<Rough<S>>; 2],
    shape: &RoughBox,
) -> Rough<S> {
    let [x, y, z] = shape.axes;
    let (x, y, z) = (Point::splat_rough(simd, x), Point::splat_rough(simd, y), Point::splat_rough(simd, z));
    let half = Point::splat_rough(simd, shape.half);
    let from = p[0] - Point::splat_rough(simd, shape.origin);
    let along = p[1] - p[0];
    let within = InBox {
        a: [x.dot(from), y.dot(from), z.dot(from)],
        d: [x.dot(along), y.dot(along), z.dot(along)],
        half: [half.x, half.y, half.z],
    };
    let zero = Rough::splat(simd, 0.0);
    let one = Rough::splat(simd, 1.0);
    let mut low = zero;
    let mut slope_low = within.slope(zero);
    let mut high = one;
    let mut slope_high = within.slope(one);
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
