//! Eight configurations at once: free, near something, or in contact.
#![expect(
    clippy::inline_always,
    reason = "lanes are compiled for the instructions of the function they end up in"
)]

use super::outline::Outline;
use super::{Axis, Track, load};
use crate::geometry::lanes::{
    Point, ROUGH_LANES, Rough, RoughRow, Simd, SimdBase, SimdFloat, SimdMask, far_balls,
    squared_distance_segment_segment_lanes,
};
use crate::space::cell::lines::middle_outwards;

/// The verdict on the configurations of a path.
pub(super) enum Look {
    Free,
    /// In contact; holds the rank of the first such configuration, counted from the middle outwards.
    Contact(usize),
    /// Open: a comparison fell within its error band, or a solid has no lanes.
    UnsettledPath,
}

/// The pairs that may touch somewhere on a path.
#[derive(Debug, Default)]
pub(super) struct Close {
    /// Parts and obstacles.
    pub(super) scene: Vec<(usize, usize)>,
    /// Pairs of parts, by their place among the outline's.
    pub(super) own: Vec<usize>,
}

impl Close {
    /// Whether nothing may touch anything.
    pub(super) fn is_empty(&self) -> bool {
        self.scene.is_empty() && self.own.is_empty()
    }

    /// Which parts may touch something: one bit each, the last one for all further parts.
    pub(super) fn parts(&self, outline: &Outline) -> u64 {
        let scene = self.scene.iter().map(|(part, _)| *part);
        let own = self.own.iter().flat_map(|pair| outline.pairs[*pair].parts);
        scene.chain(own).fold(0, |parts, part| parts | 1 << part.min(63))
    }
}

/// One bit a configuration.
#[derive(Debug, Default, Clone, Copy)]
pub(super) struct Bits {
    pub(super) contact: u64,
    /// Within the error band of contact.
    pub(super) unsure: u64,
    /// Near something, or within the error band of it.
    pub(super) near: u64,
}

impl Bits {
    /// Adds a gap, given its width and the width that makes it clear beyond the error band.
    #[inline(always)]
    fn judge<S: Simd>(&mut self, gap: Rough<S>, room: Rough<S>, band: f32) {
        let near = !gap.simd_gt(room);
        if near.any_true() {
            let free = gap.simd_gt(band);
            let contact = gap.simd_lt(-band);
            self.near |= near.to_bitmask();
            self.contact |= contact.to_bitmask();
            self.unsure |= (!(free | contact)).to_bitmask();
        }
    }
}

/// Which intervals share a point with another.
#[inline(always)]
pub(super) fn overlaps<S: Simd>(
    [least, most]: [Point<Rough<S>>; 2],
    [other_least, other_most]: [Point<Rough<S>>; 2],
) -> u64 {
    let x = least.x.simd_le(other_most.x) & most.x.simd_ge(other_least.x);
    let y = least.y.simd_le(other_most.y) & most.y.simd_ge(other_least.y);
    let z = least.z.simd_le(other_most.z) & most.z.simd_ge(other_least.z);
    (x & y & z).to_bitmask()
}

/// The box about eight obstacles each.
#[inline(always)]
fn corners<S: Simd>(simd: S, [a, b, c, d, e, f]: &[RoughRow; 6]) -> [Point<Rough<S>>; 2] {
    [Point::load(simd, [a, b, c]), Point::load(simd, [d, e, f])]
}

/// The verdict on eight placed bodies whose parts are thickened by `rooms`.
pub(super) fn stand<S: Simd>(
    simd: S,
    outline: &Outline,
    close: &Close,
    placed: &[Axis],
    rooms: &[RoughRow],
) -> Bits {
    simd.vectorize(
        #[inline(always)]
        || {
            let mut bits = Bits::default();
            among_obstacles(simd, outline, close, placed, rooms, &mut bits);
            for &index in &close.own {
                let pair = &outline.pairs[index];
                let [a, b] = pair.parts;
                let (p, q) = (load(simd, &placed[a]), load(simd, &placed[b]));
                let room = Rough::load_array_ref(simd, &rooms[a]) + Rough::load_array_ref(simd, &rooms[b]);
                if far_balls(p, q, room + pair.balls_m) != (1 << ROUGH_LANES) - 1 {
                    let gap = squared_distance_segment_segment_lanes(p, q).sqrt() - pair.touch_m;
                    bits.judge(gap, room, outline.band_m);
                }
            }
            bits
        },
    )
}

#[inline(always)]
fn among_obstacles<S: Simd>(
    simd: S,
    outline: &Outline,
    close: &Close,
    placed: &[Axis],
    rooms: &[RoughRow],
    bits: &mut Bits,
) {
    for &(part, obstacle) in &close.scene {
        let axis = load(simd, &placed[part]);
        let room = Rough::load_array_ref(simd, &rooms[part]);
        let radius = outline.radii_m[part];
        let reach = room + radius;
        let reach = Point { x: reach, y: reach, z: reach };
        let (least, most) = (axis[0].min(axis[1]) - reach, axis[0].max(axis[1]) + reach);
        let [low, high] = outline.boxes[obstacle];
        let met = overlaps([least, most], [Point::splat_rough(simd, low), Point::splat_rough(simd, high)]);
        if met != 0 {
            match &outline.solids[obstacle] {
                Some(solid) => bits.judge(solid.distance(simd, axis) - radius, room, outline.band_m),
                None => bits.unsure |= met,
            }
        }
    }
}

impl Track {
    /// Collects what may meet on the path.
    #[inline(always)]
    pub(super) fn collect<S: Simd>(&mut self, simd: S, outline: &Outline) {
        self.close.scene.clear();
        for &part in &outline.exposed {
            let [low, high] = self.swept[part];
            let swept = [Point::splat_rough(simd, low), Point::splat_rough(simd, high)];
            for (block, bounds) in outline.bounds.iter().enumerate() {
                let mut met = overlaps(swept, corners(simd, bounds));
                while met != 0 {
                    let obstacle = block * ROUGH_LANES + met.trailing_zeros() as usize;
                    self.close.scene.push((part, obstacle));
                    met &= met - 1;
                }
            }
        }
        self.close.own.clear();
        for (index, pair) in outline.pairs.iter().enumerate() {
            let [[a, b], [c, d]] = pair.parts.map(|part| self.swept[part]);
            if (0..3).all(|axis| a[axis] <= d[axis] && c[axis] <= b[axis]) {
                self.close.own.push(index);
            }
        }
    }

    /// Which of the configurations, in the order from the middle outwards, is the first in contact, and, in `near`,
    /// which may come near something.
    #[inline(always)]
    pub(super) fn look<S: Simd>(&mut self, simd: S, outline: &Outline) -> Look {
        let middle = self.count / 2;
        let parts = outline.radii_m.len();
        let order =
            |state: usize| if state >= middle { 2 * (state - middle) } else { 2 * (middle - state) - 1 };
        let mut first = usize::MAX;
        for block in middle_outwards(self.angles.len()) {
            let states = block * ROUGH_LANES..self.count.min((block + 1) * ROUGH_LANES);
            if first < usize::MAX && states.clone().all(|state| order(state) > first) {
                continue;
            }
            let rows = block * parts..(block + 1) * parts;
            let bits = stand(simd, outline, &self.close, &self.placed[rows.clone()], &self.rooms[rows]);
            let valid = (1 << states.len()) - 1;
            if bits.unsure & valid != 0 {
                return Look::UnsettledPath;
            }
            self.near[block] = bits.near & valid;
            let touching = states.filter(|state| bits.contact >> (state - block * ROUGH_LANES) & 1 == 1);
            first = touching.map(order).fold(first, usize::min);
        }
        if first == usize::MAX { Look::Free } else { Look::Contact(first) }
    }
}
