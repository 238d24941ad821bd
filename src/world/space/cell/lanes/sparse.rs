//! A first look at a straight line of the joints: at few of its configurations, with room about the parts for all between.
//!
//! An end of a part moves on a smooth curve. On a line of the joints its acceleration is at most what [`Outline::bend_m`]
//! says, so between two configurations of the first look it strays from their chord by an eighth of that at most. What is
//! clear with the room for it is clear, and not near, at every configuration of the path and between them: it
//! is not looked at again.
#![expect(
    clippy::inline_always,
    reason = "lanes are compiled for the instructions of the function they end up in"
)]

use super::outline::{Outline, Pair};
use super::place::{NUMBERS, followers, way2};
use super::stand::overlaps;
use super::{Course, Track, load};
use crate::geometry::lanes::{
    Point, ROUGH_LANES, Rough, Select, Simd, SimdBase, SimdFloat, SimdMask, far_balls,
    squared_distance_segment_segment_lanes,
};
use crate::kinematics::AXES;
use crate::space::cell::doubt::HALF_WAY;

/// About how many steps of a path go on one of the first look.
const SPAN: usize = 6;
/// What rounding may take from a bound.
const ROUNDED: f32 = 1.001;

impl Track {
    /// Collects what may meet on a path of `count` configurations by a first look at few of them; false where that is none.
    #[inline(always)]
    pub(super) fn narrow<S: Simd>(
        &mut self,
        simd: S,
        outline: &Outline,
        course: &Course,
        count: usize,
    ) -> bool {
        let Course::Line { from, step } = course else { return false };
        let blocks = (count - 1).div_ceil(ROUGH_LANES * SPAN).max(1);
        let sparse = blocks * ROUGH_LANES;
        if count < 2 * sparse {
            return false;
        }
        let longer = (count - 1) as f32 / (sparse - 1) as f32;
        let step = step.map(|change| change * longer);
        self.open(sparse, outline.radii_m.len());
        self.fill(simd, &Course::Line { from: *from, step });
        self.place(simd, outline);
        self.measure_between(simd, outline, &step, 1.0 / longer);
        self.collect(simd, outline);
        self.sift(simd, outline);
        true
    }

    /// By how much parts are thickened for all that lies between the configurations of a first look, and the boxes they sweep. A
    /// step of the path is the `share` of one of the first look.
    #[inline(always)]
    fn measure_between<S: Simd>(&mut self, simd: S, outline: &Outline, step: &[f32; AXES], share: f32) {
        // A place is at most half a chord, and what the curve strays from it, from the nearer end. From there a step goes as far
        // as its share of the longest chord, and of half the acceleration.
        let thickened = HALF_WAY as f32 * share;
        let of_way = (0.5 + thickened) * ROUNDED;
        let of_bend = (0.125 + 0.5 * thickened) * ROUNDED;
        let pulls = Outline::pulls(step);
        let blocks = self.angles.len();
        let parts = outline.radii_m.len();
        let last = Rough::load_array(simd, NUMBERS).simd_lt((ROUGH_LANES - 1) as f32);
        let zero = Rough::splat(simd, 0.0);
        for part in 0..parts {
            let mut own = load(simd, &self.placed[part]);
            let (mut least, mut most) = (own[0].min(own[1]), own[0].max(own[1]));
            let mut longest2 = zero;
            for block in 1..blocks {
                let next = load(simd, &self.placed[block * parts + part]);
                longest2 = longest2.max(way2(own, followers(own, next)));
                own = next;
                (least, most) = (least.min(own[0].min(own[1])), most.max(own[0].max(own[1])));
            }
            longest2 = longest2.max(last.select(way2(own, followers(own, own)), zero));
            let way_m = longest2.reduce_max().sqrt();
            let room = way_m * of_way + outline.bend_m(part, &pulls) * of_bend + 2.0 * outline.band_m;
            self.reaches[part] = room;
            let reach = room + outline.radii_m[part];
            self.swept[part] = [
                [least.x.reduce_min() - reach, least.y.reduce_min() - reach, least.z.reduce_min() - reach],
                [most.x.reduce_max() + reach, most.y.reduce_max() + reach, most.z.reduce_max() + reach],
            ];
        }
    }

    /// Drops the pairs that are clear at every configuration of a first look.
    ///
    /// Loops, not closures: what a library calls is not compiled for the instructions of its caller.
    #[inline(always)]
    fn sift<S: Simd>(&mut self, simd: S, outline: &Outline) {
        let mut kept = 0;
        for index in 0..self.close.scene.len() {
            let pair = self.close.scene[index];
            if self.may_meet_obstacle(simd, outline, pair) {
                self.close.scene[kept] = pair;
                kept += 1;
            }
        }
        self.close.scene.truncate(kept);
        kept = 0;
        for index in 0..self.close.own.len() {
            let pair = self.close.own[index];
            if self.may_meet_itself(simd, outline, &outline.pairs[pair]) {
                self.close.own[kept] = pair;
                kept += 1;
            }
        }
        self.close.own.truncate(kept);
    }

    #[inline(always)]
    fn may_meet_obstacle<S: Simd>(
        &self,
        simd: S,
        outline: &Outline,
        (part, obstacle): (usize, usize),
    ) -> bool {
        let room = self.reaches[part] + outline.radii_m[part];
        let reach = Point::splat_rough(simd, [room; 3]);
        let [low, high] = outline.boxes[obstacle];
        let bounds = [Point::splat_rough(simd, low), Point::splat_rough(simd, high)];
        let parts = outline.radii_m.len();
        for placed in self.placed[..self.angles.len() * parts].chunks_exact(parts) {
            let axis = load(simd, &placed[part]);
            if overlaps([axis[0].min(axis[1]) - reach, axis[0].max(axis[1]) + reach], bounds) == 0 {
                continue;
            }
            let Some(solid) = &outline.solids[obstacle] else { return true };
            if !solid.distance(simd, axis).simd_gt(room).all_true() {
                return true;
            }
        }
        false
    }

    #[inline(always)]
    fn may_meet_itself<S: Simd>(&self, simd: S, outline: &Outline, pair: &Pair) -> bool {
        let [a, b] = pair.parts;
        let room = self.reaches[a] + self.reaches[b];
        let balls = Rough::splat(simd, room + pair.balls_m);
        let parts = outline.radii_m.len();
        for placed in self.placed[..self.angles.len() * parts].chunks_exact(parts) {
            let (p, q) = (load(simd, &placed[a]), load(simd, &placed[b]));
            if far_balls(p, q, balls) == (1 << ROUGH_LANES) - 1 {
                continue;
            }
            let gap = squared_distance_segment_segment_lanes(p, q).sqrt();
            if !gap.simd_gt(room + pair.touch_m).all_true() {
                return true;
            }
        }
        false
    }
}
