//! Four cases at once: the parts of a motion check that run in SIMD lanes.
//!
//! The instructions are chosen when the program runs ([`level`]); arithmetic is f64 on every path, but fused
//! multiply-adds and other polynomials make results differ from the scalar code in the last digits. So nothing here
//! decides a close call: callers compare with a band ([`SLACK`]) and ask the scalar code inside it. A NaN must
//! end inside the band too: write comparisons so that it fails the certain side.
#![expect(
    clippy::inline_always,
    reason = "lanes are compiled for the instructions of the function they end up in"
)]

mod distance;
#[cfg(test)]
mod tests;
mod trig;

pub use distance::{
    far_balls, height_half_space, squared_distance_segment_box_lanes, squared_distance_segment_segment_lanes,
};
pub use fearless_simd::{ExtractToken, Level, Select, Simd, SimdBase, SimdFloat, SimdMask, dispatch};
pub use trig::{atan2, sincos};

use super::{Frame, Vec3};
use fearless_simd::f64x4;
use std::ops::{Add, Sub};

/// How many cases are taken at once.
pub const LANES: usize = 4;

/// How close a comparison of metres or radians may be before the scalar code is asked.
///
/// Away from singular poses (the inverse kinematics says which) lanes and scalar code differ by less than 1e-11.
pub const SLACK: f64 = 1e-9;

/// One number a case.
pub type Lane<S> = f64x4<S>;

/// Numbers of four cases between two functions that may be compiled for different instructions.
pub type Row = [f64; LANES];

/// The instructions that this machine has; in a test, those that it asked for.
pub fn level() -> Level {
    #[cfg(test)]
    if let Some(level) = tests::FORCED.get() {
        return level;
    }
    Level::new()
}

#[cfg(test)]
pub use tests::{levels, on_level};

/// A point or direction a case.
#[derive(Debug, Clone, Copy)]
pub struct Point<S: Simd> {
    /// Along x.
    pub x: Lane<S>,
    /// Along y.
    pub y: Lane<S>,
    /// Along z.
    pub z: Lane<S>,
}

impl<S: Simd> Point<S> {
    /// The same point in every case.
    #[inline(always)]
    pub fn splat(simd: S, v: &Vec3) -> Self {
        Self { x: Lane::splat(simd, v.x), y: Lane::splat(simd, v.y), z: Lane::splat(simd, v.z) }
    }

    /// The scalar product.
    #[inline(always)]
    pub fn dot(self, other: Self) -> Lane<S> {
        self.x.mul_add(other.x, self.y.mul_add(other.y, self.z * other.z))
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

    /// The point `factor` times as far out.
    #[inline(always)]
    #[must_use]
    pub fn scaled(self, factor: Lane<S>) -> Self {
        Self { x: self.x * factor, y: self.y * factor, z: self.z * factor }
    }

    /// This point and `factor` times `direction`.
    #[inline(always)]
    #[must_use]
    pub fn plus(self, factor: Lane<S>, direction: Self) -> Self {
        Self {
            x: direction.x.mul_add(factor, self.x),
            y: direction.y.mul_add(factor, self.y),
            z: direction.z.mul_add(factor, self.z),
        }
    }
}

impl<S: Simd> Add for Point<S> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y, z: self.z + other.z }
    }
}

impl<S: Simd> Sub for Point<S> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y, z: self.z - other.z }
    }
}

/// A frame a case.
#[derive(Debug, Clone, Copy)]
pub struct Frames<S: Simd> {
    /// Where the x, y and z axes point.
    pub axes: [Point<S>; 3],
    /// Where the origin is.
    pub origin: Point<S>,
}

impl<S: Simd> Frames<S> {
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
    pub fn direction(&self, simd: S, local: &Vec3) -> Point<S> {
        let [x, y, z] = self.axes;
        let [along_x, along_y, along_z] = splat3(simd, [local.x, local.y, local.z]);
        x.scaled(along_x).plus(along_y, y).plus(along_z, z)
    }

    /// The parent coordinates of a point given in the frame.
    #[inline(always)]
    pub fn point(&self, simd: S, local: &Vec3) -> Point<S> {
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
    fn turned(&self, local: Point<S>) -> Point<S> {
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

impl<S: Simd> Frames<S> {
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
fn row_point<S: Simd>(simd: S, rows: &PoseRows, first: usize) -> Point<S> {
    Point {
        x: Lane::load_array(simd, rows[first]),
        y: Lane::load_array(simd, rows[first + 1]),
        z: Lane::load_array(simd, rows[first + 2]),
    }
}
