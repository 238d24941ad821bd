//! Halving the steps of a free path beside configurations that are near something, eight steps at once.
//!
//! A step is halved whenever the scalar code would halve it, and also within the error band. So a step that is free here
//! is free in the scalar code; any other step is left to the scalar code.
#![expect(
    clippy::inline_always,
    reason = "lanes are compiled for the instructions of the function they end up in"
)]

use super::outline::Outline;
use super::place::{NUMBERS, followers, place_block, way2};
use super::stand::stand;
use super::{Axis, Course, Track, is_rough, load, store};
use crate::geometry::lanes::{ROUGH_LANES, Rough, RoughRow, Simd, SimdBase, SimdFloat, SimdMask};
use crate::kinematics::{AXES, Arm, Joints};
use crate::space::cell::doubt::{HALF_WAY, HALVINGS};

/// Into how many parts a step is halved at most.
const PARTS: usize = 1 << HALVINGS;

/// Eight bodies at one part of eight steps.
#[derive(Debug, Default)]
struct Stop {
    placed: Vec<Axis>,
    /// How far each part may stray from its place at the nearer end of the step.
    offsets: Vec<RoughRow>,
    /// The steps whose halves beside this stop are to be halved.
    near: u64,
    /// The configurations, where they are not on a line.
    states: [Joints; ROUGH_LANES],
}

/// Eight steps in up to eight parts.
#[derive(Debug, Default)]
pub(super) struct Halves {
    stops: [Stop; PARTS + 1],
    rooms: Vec<RoughRow>,
}

impl Halves {
    fn clear(&mut self, parts: usize) {
        for stop in &mut self.stops {
            stop.placed.resize(parts, [[0.0; ROUGH_LANES]; 6]);
            stop.offsets.resize(parts, [0.0; ROUGH_LANES]);
        }
        self.rooms.resize(parts, [0.0; ROUGH_LANES]);
    }
}

/// Measures the ways to the stop in the middle of two others; the steps on which a part strays further than `reaches`.
#[inline(always)]
fn measure<S: Simd>(
    simd: S,
    [low, high]: [&Stop; 2],
    stop: &mut Stop,
    rooms: &mut [RoughRow],
    reaches: &[f32],
    band_m: f32,
) -> u64 {
    let mut astray = 0;
    for (part, reach) in reaches.iter().enumerate() {
        let own = load(simd, &stop.placed[part]);
        let before = way2(load(simd, &low.placed[part]), own);
        let way = before.max(way2(own, load(simd, &high.placed[part]))).sqrt();
        let from = Rough::load_array_ref(simd, &low.offsets[part]);
        let offset = from.min(Rough::load_array_ref(simd, &high.offsets[part])) + way;
        let room = way.mul_add(2.0 * HALF_WAY as f32, 2.0 * band_m);
        astray |= (!(offset + room).simd_le(*reach)).to_bitmask();
        offset.store_array(&mut stop.offsets[part]);
        room.store_array(&mut rooms[part]);
    }
    astray
}

impl Track {
    /// Whether every step that may come near something is surely free.
    #[inline(always)]
    pub(super) fn settle<S: Simd>(
        &self,
        simd: S,
        arm: &Arm,
        outline: &Outline,
        course: &Course,
        halves: &mut Halves,
    ) -> bool {
        halves.clear(outline.radii_m.len());
        for block in 0..self.angles.len() {
            let following = self.near.get(block + 1).map_or(0, |near| near << (ROUGH_LANES - 1));
            let steps = (self.count - 1 - block * ROUGH_LANES).min(ROUGH_LANES);
            let near = (self.near[block] | self.near[block] >> 1 | following) & ((1 << steps) - 1);
            if near != 0 {
                self.spread(simd, block, near, halves);
                if !self.halve(simd, arm, outline, course, block, halves) {
                    return false;
                }
            }
        }
        true
    }

    /// Puts the ends of the steps of a block into `halves`.
    #[inline(always)]
    fn spread<S: Simd>(&self, simd: S, block: usize, near: u64, halves: &mut Halves) {
        let parts = self.reaches.len();
        let own = &self.placed[block * parts..(block + 1) * parts];
        let next = self.placed.get((block + 1) * parts..(block + 2) * parts).unwrap_or(own);
        let [first, .., last] = &mut halves.stops;
        first.placed.copy_from_slice(own);
        for part in 0..parts {
            store(followers(load(simd, &own[part]), load(simd, &next[part])), &mut last.placed[part]);
        }
        last.near = near;
        for (state, q) in first.states.iter_mut().zip(self.states.iter().skip(block * ROUGH_LANES)) {
            *state = *q;
        }
    }

    #[inline(always)]
    fn halve<S: Simd>(
        &self,
        simd: S,
        arm: &Arm,
        outline: &Outline,
        course: &Course,
        block: usize,
        Halves { stops, rooms }: &mut Halves,
    ) -> bool {
        for level in 1..=HALVINGS {
            let half = PARTS >> level;
            for at in (half..PARTS).step_by(2 * half) {
                let (before, rest) = stops.split_at_mut(at);
                let (stop, after) = rest.split_first_mut().expect("the last stop is an end");
                let (low, high) = (&before[at - half], &after[half - 1]);
                // Of the two, the one that is a middle of the level before.
                let near = if at / half % 4 == 1 { high.near } else { low.near };
                stop.near = 0;
                if near == 0 {
                    continue;
                }
                let place = Place { first: block * ROUGH_LANES, part: at, wanted: near };
                let Some(angles) = course.angles(simd, arm, &place, &low.states, &mut stop.states) else {
                    return false;
                };
                place_block(simd, outline, &angles, &mut stop.placed);
                let astray = measure(simd, [low, high], stop, rooms, &self.reaches, outline.band_m);
                let bits = stand(simd, outline, &self.close, &stop.placed, rooms);
                if (bits.contact | bits.unsure | astray) & near != 0 {
                    return false;
                }
                stop.near = bits.near & near;
            }
        }
        true
    }
}

/// One part of eight steps from the step `first` on.
struct Place {
    first: usize,
    part: usize,
    /// The steps that are looked at: one bit each.
    wanted: u64,
}

impl Place {
    /// The share of a way of so many steps at which it is in the step of `lane`, to the last bit as halving finds it.
    fn share(&self, lane: usize, steps: f64) -> f64 {
        let [mut low, mut high] = [0, 1].map(|next| (self.first + lane + next) as f64 / steps);
        let (mut from, mut to) = (0, PARTS);
        loop {
            let middle = usize::midpoint(from, to);
            let share = f64::midpoint(low, high);
            if self.part == middle {
                return share;
            }
            if self.part < middle {
                (to, high) = (middle, share);
            } else {
                (from, low) = (middle, share);
            }
        }
    }
}

impl Course<'_> {
    /// The angles at one place of eight steps; `None` if one of the steps wanted has no configuration there.
    #[inline(always)]
    fn angles<S: Simd>(
        &self,
        simd: S,
        arm: &Arm,
        at: &Place,
        before: &[Joints; ROUGH_LANES],
        states: &mut [Joints; ROUGH_LANES],
    ) -> Option<[RoughRow; AXES]> {
        let mut angles = [[0.0; ROUGH_LANES]; AXES];
        match self {
            Self::Line { from, step } => {
                let numbers =
                    Rough::load_array(simd, NUMBERS) + (at.first as f32 + at.part as f32 / PARTS as f32);
                for joint in 0..AXES {
                    let start = Rough::splat(simd, from[joint]);
                    numbers.mul_add(step[joint], start).store_array(&mut angles[joint]);
                }
            }
            Self::Way { way, branch, steps } => {
                for lane in (0..ROUGH_LANES).filter(|lane| at.wanted >> lane & 1 == 1) {
                    let q = arm.follow(&way.at(at.share(lane, *steps)), *branch, &before[lane]).ok()?;
                    if !is_rough(&q) {
                        return None;
                    }
                    states[lane] = q;
                    for (row, angle) in angles.iter_mut().zip(q) {
                        row[lane] = angle as f32;
                    }
                }
            }
        }
        Some(angles)
    }
}
