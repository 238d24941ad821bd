//! The body at every configuration of a path, and how far its parts go from one to the next.
#![expect(
    clippy::inline_always,
    reason = "lanes are compiled for the instructions of the function they end up in"
)]

use super::outline::Outline;
use super::{Axis, Track, load, store};
use crate::geometry::lanes::{
    Frames, Point, ROUGH_LANES, Rough, RoughRow, Select, Simd, SimdBase, SimdFloat,
};
use crate::kinematics::AXES;
use crate::space::cell::doubt::HALF_WAY;

/// The number of each lane.
pub(super) const NUMBERS: RoughRow = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];
/// By how much more than its greatest room a part is thickened where what is close is collected. The middle of a step is up to
/// half of it away from both ends, and what is near that counts as well.
const ROOM_BETWEEN: f32 = 2.1;

/// Writes the axes of the body at eight configurations into `placed`, part by part.
pub(super) fn place_block<S: Simd>(
    simd: S,
    outline: &Outline,
    angles: &[RoughRow; AXES],
    placed: &mut [Axis],
) {
    simd.vectorize(
        #[inline(always)]
        || {
            let mut frame = outline.chain.base(simd);
            place_link(simd, outline, 0, &frame, placed);
            for (joint, row) in angles.iter().enumerate() {
                frame = outline.chain.next(simd, &frame, joint, Rough::load_array_ref(simd, row));
                place_link(simd, outline, joint + 1, &frame, placed);
            }
        },
    );
}

#[inline(always)]
fn place_link<S: Simd>(
    simd: S,
    outline: &Outline,
    link: usize,
    frame: &Frames<Rough<S>>,
    placed: &mut [Axis],
) {
    for (part, ends) in &outline.axes[outline.on_link[link].clone()] {
        let axis = [point(simd, frame, &ends[0]), point(simd, frame, &ends[1])];
        store(axis, &mut placed[*part]);
    }
}

/// A point given in a frame; most are on an axis of it.
#[inline(always)]
fn point<S: Simd>(simd: S, frame: &Frames<Rough<S>>, local: &[f32; 3]) -> Point<Rough<S>> {
    let mut point = frame.origin;
    for (axis, along) in frame.axes.iter().zip(local) {
        if *along != 0.0 {
            point = point.plus(Rough::splat(simd, *along), *axis);
        }
    }
    point
}

/// The square of the longest way that an end of an axis goes.
#[inline(always)]
pub(super) fn way2<S: Simd>(from: [Point<Rough<S>>; 2], to: [Point<Rough<S>>; 2]) -> Rough<S> {
    let (a, b) = (to[0] - from[0], to[1] - from[1]);
    a.dot(a).max(b.dot(b))
}

/// Each case's follower, the last one's from `next`.
#[inline(always)]
pub(super) fn followers<S: Simd>(
    own: [Point<Rough<S>>; 2],
    next: [Point<Rough<S>>; 2],
) -> [Point<Rough<S>>; 2] {
    [follower(own[0], next[0]), follower(own[1], next[1])]
}

#[inline(always)]
fn follower<S: Simd>(own: Point<Rough<S>>, next: Point<Rough<S>>) -> Point<Rough<S>> {
    Point { x: own.x.slide::<1>(next.x), y: own.y.slide::<1>(next.y), z: own.z.slide::<1>(next.z) }
}

impl Track {
    /// Places the body at every configuration.
    #[inline(always)]
    pub(super) fn place<S: Simd>(&mut self, simd: S, outline: &Outline) {
        let blocks = self.angles.iter().zip(self.placed.chunks_exact_mut(outline.radii_m.len()));
        for (angles, placed) in blocks {
            place_block(simd, outline, angles, placed);
        }
    }

    /// By how much each of the `wanted` parts (one bit each) is thickened at every configuration, and the box that it sweeps.
    #[inline(always)]
    pub(super) fn measure<S: Simd>(&mut self, simd: S, outline: &Outline, wanted: u64) {
        let blocks = self.angles.len();
        let parts = outline.radii_m.len();
        let zero = Rough::splat(simd, 0.0);
        let numbers = Rough::load_array(simd, NUMBERS);
        for part in 0..parts {
            if wanted >> part.min(63) & 1 == 0 {
                continue;
            }
            let mut own = load(simd, &self.placed[part]);
            let (mut least, mut most) = (own[0].min(own[1]), own[0].max(own[1]));
            let mut before = zero;
            let mut widest = zero;
            for block in 0..blocks {
                let next = if block + 1 < blocks {
                    load(simd, &self.placed[(block + 1) * parts + part])
                } else {
                    own
                };
                let steps = (self.count - 1 - block * ROUGH_LANES) as f32;
                let after = way2(own, followers(own, next));
                let after = numbers.simd_lt(steps).select(after, zero);
                let longest = before.slide::<7>(after).max(after).sqrt();
                let room = longest.mul_add(HALF_WAY as f32, 2.0 * outline.band_m);
                room.store_array(&mut self.rooms[block * parts + part]);
                (before, own, widest) = (after, next, widest.max(room));
                (least, most) = (least.min(own[0].min(own[1])), most.max(own[0].max(own[1])));
            }
            self.reaches[part] = widest.reduce_max() * ROOM_BETWEEN;
            let reach = self.reaches[part] + outline.radii_m[part];
            self.swept[part] = [
                [least.x.reduce_min() - reach, least.y.reduce_min() - reach, least.z.reduce_min() - reach],
                [most.x.reduce_max() + reach, most.y.reduce_max() + reach, most.z.reduce_max() + reach],
            ];
        }
    }
}
