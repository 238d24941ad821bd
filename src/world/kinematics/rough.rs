//! A chain's forward kinematics in rough lanes: eight configurations at once, to seven digits.
#![expect(
    clippy::inline_always,
    reason = "lanes are compiled for the instructions of the function they end up in"
)]

use super::{AXES, Chain};
use crate::geometry::Vec3;
use crate::geometry::lanes::{Frames, Point, Rough, Simd, SimdBase, sincos_rough};

/// The numbers of a [`Chain`] in f32.
#[derive(Debug, Clone, PartialEq)]
pub struct RoughChain {
    axes: [[f32; 3]; 3],
    origin: [f32; 3],
    rows: [Row; AXES],
}

/// One Denavit–Hartenberg row.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Row {
    offset_rad: f32,
    a_m: f32,
    d_m: f32,
    sin_alpha: f32,
    cos_alpha: f32,
}

fn rough(v: &Vec3) -> [f32; 3] {
    [v.x as f32, v.y as f32, v.z as f32]
}

impl RoughChain {
    /// The numbers of `chain`.
    pub fn from_chain(chain: &Chain) -> Self {
        let base = chain.base();
        let row = |i: usize| {
            let joint = &chain.joints()[i];
            let (sin_alpha, cos_alpha) = chain.twists()[i];
            Row {
                offset_rad: joint.offset_rad as f32,
                a_m: joint.a_m as f32,
                d_m: joint.d_m as f32,
                sin_alpha: sin_alpha as f32,
                cos_alpha: cos_alpha as f32,
            }
        };
        Self {
            axes: [0, 1, 2].map(|axis| rough(&base.axis(axis))),
            origin: rough(&base.origin),
            rows: std::array::from_fn(row),
        }
    }

    /// The base in the world.
    #[inline(always)]
    pub fn base<S: Simd>(&self, simd: S) -> Frames<Rough<S>> {
        let [x, y, z] = self.axes;
        let axes = [Point::splat_rough(simd, x), Point::splat_rough(simd, y), Point::splat_rough(simd, z)];
        Frames { axes, origin: Point::splat_rough(simd, self.origin) }
    }

    /// Frame `i + 1` from frame `i`.
    #[inline(always)]
    pub fn next<S: Simd>(
        &self,
        simd: S,
        frame: &Frames<Rough<S>>,
        i: usize,
        angle_rad: Rough<S>,
    ) -> Frames<Rough<S>> {
        let row = &self.rows[i];
        let (s, c) = sincos_rough(angle_rad + row.offset_rad);
        let [x, y, z] = frame.axes;
        let (turned_x, turned_y) = (x.scaled(c).plus(s, y), y.scaled(c).plus(-s, x));
        let mut origin = frame.origin;
        if row.d_m != 0.0 {
            origin = origin.plus(Rough::splat(simd, row.d_m), z);
        }
        if row.a_m != 0.0 {
            origin = origin.plus(Rough::splat(simd, row.a_m), turned_x);
        }
        let [sin, cos] = [Rough::splat(simd, row.sin_alpha), Rough::splat(simd, row.cos_alpha)];
        // Most twists are right angles or none.
        let across = if row.cos_alpha == 0.0 {
            [z.scaled(sin), turned_y.scaled(-sin)]
        } else if row.sin_alpha == 0.0 {
            [turned_y.scaled(cos), z.scaled(cos)]
        } else {
            [turned_y.scaled(cos).plus(sin, z), z.scaled(cos).plus(-sin, turned_y)]
        };
        Frames { axes: [turned_x, across[0], across[1]], origin }
    }
}
