//! How four configurations stand in their cell.
#![expect(
    clippy::inline_always,
    reason = "lanes are compiled for the instructions of the function they end up in"
)]

use super::{Memory, middle_outwards};
use crate::geometry::lanes::{
    LANES, Lane, Point, SLACK, Simd, SimdBase, SimdFloat, SimdMask, far_balls, height_half_space,
    squared_distance_segment_box_lanes, squared_distance_segment_segment_lanes,
};
use crate::geometry::{Aabb, Solid, Vec3};
use crate::space::cell::Cell;
use crate::space::cell::doubt::HALF_WAY;

/// What a path's configurations came to.
pub(super) enum Look {
    Free,
    /// In contact, with the first one's place in the order from the middle outwards.
    Contact(usize),
    /// A comparison was too close, or a solid has no lanes.
    Doubt,
}

/// One bit a configuration.
#[derive(Default)]
struct Bits {
    contact: u64,
    near: u64,
}

impl Bits {
    /// Takes in how wide gaps are, where `valid`; `None` if one is too close to a bound.
    #[inline(always)]
    fn judge<S: Simd>(&mut self, gap: Lane<S>, margin: Lane<S>, valid: u64) -> Option<()> {
        let sure = gap.abs().simd_gt(SLACK) & (gap - margin).abs().simd_gt(SLACK);
        self.contact |= gap.simd_le(0.0).to_bitmask() & valid;
        self.near |= gap.simd_le(margin).to_bitmask() & valid;
        (!sure.to_bitmask() & valid == 0).then_some(())
    }
}

/// Which boxes about axes, grown by `reach`, share a point with `bounds`.
#[inline(always)]
fn overlaps<S: Simd>([a, b]: [Point<S>; 2], reach: Lane<S>, bounds: &Aabb) -> u64 {
    let x = overlaps_along(a.x, b.x, reach, [bounds.min.x, bounds.max.x]);
    let y = overlaps_along(a.y, b.y, reach, [bounds.min.y, bounds.max.y]);
    let z = overlaps_along(a.z, b.z, reach, [bounds.min.z, bounds.max.z]);
    x & y & z
}

#[inline(always)]
fn overlaps_along<S: Simd>(a: Lane<S>, b: Lane<S>, reach: Lane<S>, [least, most]: [f64; 2]) -> u64 {
    ((a.min(b) - reach).simd_le(most) & (a.max(b) + reach).simd_ge(least)).to_bitmask()
}

/// The gap between axes and a solid; `None` for a solid that has no lanes.
#[inline(always)]
fn gap_to_solid<S: Simd>(simd: S, axis: [Point<S>; 2], solid: &Solid) -> Option<Lane<S>> {
    match solid {
        Solid::Box(shape) => Some(squared_distance_segment_box_lanes(simd, axis, shape).sqrt()),
        Solid::HalfSpace(shape) => Some(height_half_space(simd, axis[0], axis[1], shape)),
        Solid::Capsule(capsule) => {
            let (a, b) = (Point::splat(simd, &capsule.segment.a), Point::splat(simd, &capsule.segment.b));
            Some(squared_distance_segment_segment_lanes(axis, [a, b]).sqrt() - capsule.radius)
        }
        Solid::Sphere(_) | Solid::Convex(_) => None,
    }
}

impl Memory {
    /// By how much a part is thickened at four configurations from `state` on.
    #[inline(always)]
    fn margin<S: Simd>(&self, simd: S, part: usize, state: usize) -> Lane<S> {
        let at = part * self.stride + state;
        let before = Lane::from_slice(simd, &self.ways[at..at + LANES]);
        let after = Lane::from_slice(simd, &self.ways[at + 1..at + 1 + LANES]);
        before.max(after) * HALF_WAY
    }

    /// Collects the exposed parts and the obstacles that may meet on the path.
    #[inline(always)]
    fn collect_close<S: Simd>(&mut self, simd: S, cell: &Cell) {
        self.close.clear();
        for &part in &cell.exposed {
            let mut margin = self.margin(simd, part, 0);
            let [a, b] = self.axis(simd, part, 0);
            let (mut least, mut most) = (a.min(b), a.max(b));
            for block in 1..self.blocks() {
                margin = margin.max(self.margin(simd, part, block * LANES));
                let [a, b] = self.axis(simd, part, block * LANES);
                (least, most) = (least.min(a.min(b)), most.max(a.max(b)));
            }
            let reach = cell.body.parts()[part].capsule().radius + margin.reduce_max() + 2.0 * SLACK;
            let swept = Aabb {
                min: Vec3::new(least.x.reduce_min(), least.y.reduce_min(), least.z.reduce_min()),
                max: Vec3::new(most.x.reduce_max(), most.y.reduce_max(), most.z.reduce_max()),
            };
            let swept = swept.grown(reach);
            self.close.extend(cell.broad.candidates(&swept).map(|obstacle| (part, obstacle)));
        }
    }

    #[inline(always)]
    fn stand<S: Simd>(&self, simd: S, cell: &Cell, state: usize) -> Option<Bits> {
        let mut bits = Bits::default();
        let valid = (1 << (self.count - state).min(LANES)) - 1;
        for &(part, obstacle) in &self.close {
            let radius = cell.body.parts()[part].capsule().radius;
            let (axis, margin) = (self.axis(simd, part, state), self.margin(simd, part, state));
            if overlaps(axis, margin + (radius + 2.0 * SLACK), &cell.broad.boxes()[obstacle]) & valid != 0 {
                let gap = gap_to_solid(simd, axis, &cell.scene.obstacles()[obstacle].solid)? - radius;
                bits.judge(gap, margin, valid)?;
            }
        }
        for ([a, b], reach_m) in cell.self_pairs.iter().zip(&cell.self_reach_m) {
            let (p, q) = (self.axis(simd, *a, state), self.axis(simd, *b, state));
            let margin = self.margin(simd, *a, state) + self.margin(simd, *b, state);
            if !far_balls(p, q, margin + (reach_m + 2.0 * SLACK)) & valid != 0 {
                let [ra, rb] = [*a, *b].map(|part| cell.body.parts()[part].capsule().radius);
                let gap = squared_distance_segment_segment_lanes(p, q).sqrt() - (ra + rb);
                bits.judge(gap, margin, valid)?;
            }
        }
        Some(bits)
    }

    /// Which of the configurations, in the order from the middle outwards, is the first in contact, and, in `near`,
    /// which come near something.
    #[inline(always)]
    pub(super) fn look<S: Simd>(&mut self, simd: S, cell: &Cell) -> Look {
        self.collect_close(simd, cell);
        self.near.clear();
        self.near.resize(self.count, false);
        let middle = self.count / 2;
        let order =
            |state: usize| if state >= middle { 2 * (state - middle) } else { 2 * (middle - state) - 1 };
        let mut first = usize::MAX;
        for block in middle_outwards(self.blocks()) {
            let states = block * LANES..self.count.min((block + 1) * LANES);
            if states.clone().all(|state| order(state) > first) {
                continue;
            }
            let Some(bits) = self.stand(simd, cell, block * LANES) else { return Look::Doubt };
            for state in states {
                let lane = state - block * LANES;
                self.near[state] = bits.near >> lane & 1 == 1;
                if bits.contact >> lane & 1 == 1 {
                    first = first.min(order(state));
                }
            }
        }
        if first == usize::MAX { Look::Free } else { Look::Contact(first) }
    }
}
