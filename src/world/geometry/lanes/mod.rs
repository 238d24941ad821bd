//! Cases by the lane: the parts of a motion check that run in SIMD lanes.
//!
//! Angles are found in f64, four cases at once ([`Lane`]); places and distances in f32, eight at once ([`Rough`]). The
//! instructions are chosen when the program runs ([`level`], `dispatch!`), and results differ from the scalar code in
//! their last digits: fused multiply-adds, other polynomials, fewer digits. So nothing here decides a close call:
//! callers compare with a band ([`SLACK`] for f64, [`ROUGHNESS`] for f32) and ask the scalar code inside it. Comparisons are
//! written so that a NaN counts as inside the band.
#![expect(
    clippy::inline_always,
    reason = "lanes are compiled for the instructions of the function they end up in"
)]

mod distance;
#[cfg(test)]
mod tests;
mod trig;

pub use distance::{
    RoughBox, RoughSolid, far_balls, height_half_space, squared_distance_segment_box_lanes,
    squared_distance_segment_segment_lanes,
};
pub use fearless_simd::{ExtractToken, Level, Select, Simd, SimdBase, SimdFloat, SimdMask};
pub use trig::{atan2, sincos, sincos_rough};

use super::{Frame, Vec3};
use fearless_simd::{f32x8, f64x4};
use std::ops::{Add, Mul, Sub};

/// How many cases are taken at once in f64.
pub const LANES: usize = 4;

/// How close a comparison of metres or radians may be before the scalar code decides.
///
/// Away from singular poses (the inverse kinematics says which) lanes and scalar code differ by less than 1e-11.
pub const SLACK: f64 = 1e-9;

/// One number a case.
pub type Lane<S> = f64x4<S>;

/// Numbers of four cases between two functions that may be compiled for different instructions.
pub type Row = [f64; LANES];

/// How many cases are taken at once where seven digits will do.
pub const ROUGH_LANES: usize = 8;

/// How far, as a share of the greatest coordinate and length at hand, a distance in f32 may be from the scalar code's.
///
/// Distances stay below half of it where the ends of segments are right to the last digit of a f32; the arms that are
/// placed put theirs off by another tenth.
pub const ROUGHNESS: f64 = 4e-6;

/// The least distance of segments, as the same share, that is as good as that. What is nearer is only known to be near.
pub const ROUGH_LEAST: f64 = 0.02;

/// One number a case, to seven digits.
pub type Rough<S> = f32x8<S>;

/// Rough numbers of eight cases at rest.
pub type RoughRow = [f32; ROUGH_LANES];

/// The instructions that this machine has; in a test, those that it set.
pub fn level() -> Level {
    #[cfg(test)]
    if let Some(level) = tests::FORCED.get() {
        return level;
    }
    Level::new()
}

#[cfg(test)]
pub use tests::{levels, on_level};

/// Runs an expression with the SIMD token of a level, compiled for its instructions.
///
/// On `x86_64` there is one version for AVX2 and one for what every such machine has; the levels between and above
/// would gain nothing here and take as long again to compile each.
#[macro_export]
macro_rules! dispatch {
    ($level:expr, $simd:ident => $op:expr) => {{
        let level: $crate::geometry::lanes::Level = $level;
        #[cfg(target_arch = "x86_64")]
        {
            if let Some($simd) = level.as_avx2() {
                $crate::geometry::lanes::Simd::vectorize(
                    $simd,
                    #[inline(always)]
                    || $op,
                )
            } else {
                let $simd = level.as_sse2().expect("x86_64 has SSE2");
                $crate::geometry::lanes::Simd::vectorize(
                    $simd,
                    #[inline(always)]
                    || $op,
                )
            }
        }
        #[cfg(not(target_arch = "x86_64"))]
        {
            $crate::geometry::lanes::every_level!(level, $simd => $op)
        }
    }};
}
pub use crate::dispatch;
#[doc(hidden)]
pub use fearless_simd::dispatch as every_level;

/// A number a case, of either kind.
pub trait Number: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {
    /// The number of one case.
    type One: Copy;

    /// `one` in as many cases as this has.
    #[must_use]
    fn all(self, one: Self::One) -> Self;

    /// This times `factor`, plus `addend`.
    #[must_use]
    fn times_plus(self, factor: Self, addend: Self) -> Self;
}

impl<S: Simd> Number for Lane<S> {
    type One = f64;

    #[inline(always)]
    fn all(self, one: f64) -> Self {
        Self::splat(self.token(), one)
    }

    #[inline(always)]
    fn times_plus(self, factor: Self, addend: Self) -> Self {
        self.mul_add(factor, addend)
    }
}

impl<S: Simd> Number for Rough<S> {
    type One = f32;

    #[inline(always)]
    fn all(self, one: f32) -> Self {
        Self::splat(self.token(), one)
    }

    #[inline(always)]
    fn times_plus(self, factor: Self, addend: Self) -> Self {
        self.mul_add(factor, addend)
    }
}

/// A point or direction a case.
#[derive(Debug, Clone, Copy)]
pub struct Point<L> {
    /// Along x.
    pub x: L,
    /// Along y.
    pub y: L,
    /// Along z.
    pub z: L,
}

impl<S: Simd> Point<Lane<S>> {
    /// The same point in every case.
    #[inline(always)]
    pub fn splat(simd: S, v: &Vec3) -> Self {
        Self { x: Lane::splat(simd, v.x), y: Lane::splat(simd, v.y), z: Lane::splat(simd, v.z) }
    }
}

impl<S: Simd> Point<Rough<S>> {
    /// The same point in every case.
    #[inline(always)]
    pub fn splat_rough(simd: S, [x, y, z]: [f32; 3]) -> Self {
        Self { x: Rough::splat(simd, x), y: Rough::splat(simd, y), z: Rough::splat(simd, z) }
    }

    /// The points in three rows.
    #[inline(always)]
    pub fn load(simd: S, [x, y, z]: [&RoughRow; 3]) -> Self {
        Self {
            x: Rough::load_array_ref(simd, x),
            y: Rough::load_array_ref(simd, y),
            z: Rough::load_array_ref(simd, z),
        }
    }

    /// The lesser of each coordinate.
    #[inline(always)]
    #[must_use]
    pub fn min(self, other: Self) -> Self {
        Self { x: self.x.min(other.x), y: self.y.min(other.y), z: self.z.min(other.z) }
    }

    /// The greater of each coordinate.
    #[inline(always)]
    #[must_use]
    pub fn max(self, other: Self) -> Self {
        Self { x: self.x.max(other.x), y: self.y.max(other.y), z: self.z.max(other.z) }
    }
}

impl<L: Number> Point<L> {
    /// The scalar product.
    #[inline(always)]
    pub fn dot(self, other: Self) -> L {
        self.x.times_plus(other.x, self.y.times_plus(other.y, self.z * other.z))
    }

    /// The vector product.
    #[inline(always)]
    #[must_use]
    pub fn cross(self, other: Self) -> Self {
        Self {
            x: self.y * other.z - self.z * other.y,
            y: self.z * other.x - self.x * other.z,
            z: self.x * other.y - self.y * other.x,
        }
    }

    /// The point `factor` times as far out.
    #[inline(always)]
    #[must_use]
    pub fn scaled(self, factor: L) -> Self {
        Self { x: self.x * factor, y: self.y * factor, z: self.z * factor }
    }

    /// This point and `factor` times `direction`.
    #[inline(always)]
    #[must_use]
    pub fn plus(self, factor: L, direction: Self) -> Self {
        Self {
            x: direction.x.times_plus(factor, self.x),
            y: direction.y.times_plus(factor, self.y),
            z: direction.z.times_plus(factor, self.z),
        }
    }
}

impl<L: Number> Add for Point<L> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y, z: self.z + other.z }
    }
}

impl<L: Number> Sub for Point<L> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y, z: self.z - other.z }
    }
}

/// A frame a case.
#[derive(Debug, Clone, Copy)]
pub struct Frames<L> {
    /// Where the x, y and z axes point.
    pub axes: [Point<L>; 3],
    /// Where the origin is.
    pub origin: Point<L>,
}

impl<S: Simd> Frames<Lane<S>> {
    /// The same frame in every case.
    #[inline(always)]
    pub fn splat(simd: S, frame: &Frame) -> Self {
        let [x, y, z] = [frame.axis(0), frame.axis(1), frame.axis(2)];
        Self {
            axes: [Point::splat(simd, &x), Point::splat(simd, &y), Point::splat(simd, &z)],
            origin: Point::splat(simd, &frame.origin),
        }
    }

    /// A direction given in the frame.
    #[inline(always)]
    pub fn direction(&self, simd: S, local: &Vec3) -> Point<Lane<S>> {
        let [x, y, z] = self.axes;
        let [along_x, along_y, along_z] = splat3(simd, [local.x, local.y, local.z]);
        x.scaled(along_x).plus(along_y, y).plus(along_z, z)
    }

    /// The parent coordinates of a point given in the frame.
    #[inline(always)]
    pub fn point(&self, simd: S, local: &Vec3) -> Point<Lane<S>> {
        self.origin + self.direction(simd, local)
    }

    /// `other`, given in this frame, in the parent.
    #[inline(always)]
    #[must_use]
    pub fn then(&self, simd: S, other: &Frame) -> Self {
        let [x, y, z] = [other.axis(0), other.axis(1), other.axis(2)];
        Self {
            axes: [self.direction(simd, &x), self.direction(simd, &y), self.direction(simd, &z)],
            origin: self.point(simd, &other.origin),
        }
    }

    /// This frame, given in `parent`, in the parent of `parent`.
    #[inline(always)]
    #[must_use]
    pub fn within(&self, simd: S, parent: &Frame) -> Self {
        let parent = Self::splat(simd, parent);
        let [x, y, z] = self.axes;
        Self {
            axes: [parent.turned(x), parent.turned(y), parent.turned(z)],
            origin: parent.origin + parent.turned(self.origin),
        }
    }

    /// Directions given in the frame.
    #[inline(always)]
    fn turned(&self, local: Point<Lane<S>>) -> Point<Lane<S>> {
        let [x, y, z] = self.axes;
        x.scaled(local.x).plus(local.y, y).plus(local.z, z)
    }
}

/// Three numbers, each in every case.
#[inline(always)]
pub fn splat3<S: Simd>(simd: S, [x, y, z]: [f64; 3]) -> [Lane<S>; 3] {
    [Lane::splat(simd, x), Lane::splat(simd, y), Lane::splat(simd, z)]
}

/// A pose a case, as rows: the x, y and z axes, then the origin, x first.
pub type PoseRows = [Row; 12];

impl<S: Simd> Frames<Lane<S>> {
    /// The frames as rows.
    #[inline(always)]
    pub fn to_rows(&self) -> PoseRows {
        let ([x, y, z], o) = (self.axes, self.origin);
        [
            x.x.to_array(),
            x.y.to_array(),
            x.z.to_array(),
            y.x.to_array(),
            y.y.to_array(),
            y.z.to_array(),
            z.x.to_array(),
            z.y.to_array(),
            z.z.to_array(),
            o.x.to_array(),
            o.y.to_array(),
            o.z.to_array(),
        ]
    }

    /// The frames in `rows`.
    #[inline(always)]
    pub fn from_rows(simd: S, rows: &PoseRows) -> Self {
        Self {
            axes: [row_point(simd, rows, 0), row_point(simd, rows, 3), row_point(simd, rows, 6)],
            origin: row_point(simd, rows, 9),
        }
    }
}

/// The point in three rows from `first` on.
#[inline(always)]
fn row_point<S: Simd>(simd: S, rows: &PoseRows, first: usize) -> Point<Lane<S>> {
    Point {
        x: Lane::load_array(simd, rows[first]),
        y: Lane::load_array(simd, rows[first + 1]),
        z: Lane::load_array(simd, rows[first + 2]),
    }
}
