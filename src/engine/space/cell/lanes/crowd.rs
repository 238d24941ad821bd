//! Configurations that have nothing to do with each other, eight at once: which of them are free.
//!
//! Bodies are placed eight at a time and their parts' boxes held against those of the obstacles. Few of eight unrelated
//! configurations come near the same thing, so pairs that may touch wait until eight have gathered, whatever
//! configurations they belong to, and their distances are found together. A configuration in contact is not asked about
//! again.
#![expect(
    clippy::inline_always,
    reason = "lanes are compiled for the instructions of the function they end up in"
)]

use super::outline::Outline;
use super::place::place_block;
use super::stand::overlaps;
use super::{Axis, is_rough, load};
use crate::geometry::lanes::{
    Point, ROUGH_LANES, Rough, RoughRow, Simd, SimdBase, SimdFloat, SimdMask, dispatch, far_balls, level,
    squared_distance_segment_segment_lanes,
};
use crate::kinematics::{AXES, Joints};
use crate::space::cell::Cell;

/// How many configurations are taken together; their placed bodies stay in the nearest cache.
const CROWD: usize = 128;
/// How many obstacles are held against a block in a row: eight bits each fill a word.
const OBSTACLES: usize = 8;
/// A byte times this is that byte in every byte.
const EVERY: u64 = u64::MAX / 0xff;
/// From so many of eight on, pairs of parts are measured where they stand.
const MOST: u32 = 3;

const ALL: u8 = u8::MAX;

/// What is known of eight configurations: one bit each.
#[derive(Debug, Clone, Copy, Default)]
struct Known {
    /// In contact, beyond limits or not there: nothing more is asked.
    shut: u8,
    /// In doubt.
    unsure: u8,
}

impl Known {
    #[inline(always)]
    fn add(&mut self, [contact, unsure]: [u8; 2]) {
        self.shut |= contact;
        self.unsure |= unsure;
    }
}

/// Pairs that may touch, up to eight.
#[derive(Debug, Clone)]
struct Waiting {
    count: usize,
    /// Where each pair's configuration is: its block and its lane.
    states: [[u8; 2]; ROUGH_LANES],
    axes: [Axis; 2],
    radii: RoughRow,
}

impl Waiting {
    const EMPTY: Self = Self {
        count: 0,
        states: [[0; 2]; ROUGH_LANES],
        axes: [[[0.0; ROUGH_LANES]; 6]; 2],
        radii: [0.0; ROUGH_LANES],
    };

    /// Puts a pair on the list; whether the list is full.
    #[inline(always)]
    fn push<const SIDES: usize>(&mut self, at: [usize; 2], axes: [&Axis; SIDES], radius_m: f32) -> bool {
        let [block, lane] = at;
        let place = self.count;
        self.states[place] = [block as u8, lane as u8];
        for (waiting, axis) in self.axes.iter_mut().zip(axes) {
            for (row, from) in waiting.iter_mut().zip(axis) {
                row[place] = from[lane];
            }
        }
        self.radii[place] = radius_m;
        self.count = (place + 1) % ROUGH_LANES;
        self.count == 0
    }

    /// Tells the first `count` configurations what was found.
    #[inline(always)]
    fn tell(&self, count: usize, found: [u8; 2], known: &mut [Known]) {
        for (place, [block, lane]) in self.states[..count].iter().enumerate() {
            known[usize::from(*block)].add(found.map(|bits| (bits >> place & 1) << lane));
        }
    }
}

/// Which gaps are contacts, and which are in doubt.
#[inline(always)]
fn sorted<S: Simd>(gap: Rough<S>, band: f32) -> [u8; 2] {
    let (free, contact) = (gap.simd_gt(band), gap.simd_lt(-band));
    [contact, !(free | contact)].map(|mask| mask.to_bitmask() as u8)
}

/// Up to so many configurations and their bodies.
struct Crowd<'a> {
    outline: &'a Outline,
    known: Vec<Known>,
    /// By block, then by part.
    placed: Vec<Axis>,
    waiting: Vec<Waiting>,
}

impl<'a> Crowd<'a> {
    fn new(outline: &'a Outline) -> Self {
        let waiting = vec![Waiting::EMPTY; outline.solids.len()];
        Self { outline, known: Vec::new(), placed: Vec::new(), waiting }
    }

    /// Looks at `states`, of which only those that `is_asked` are of interest.
    #[inline(always)]
    fn look<S: Simd>(&mut self, simd: S, states: &[Joints], is_asked: impl Fn(&Joints) -> bool) {
        let (blocks, parts) = (states.len().div_ceil(ROUGH_LANES), self.outline.radii_m.len());
        self.placed.resize(blocks * parts, [[0.0; ROUGH_LANES]; 6]);
        self.known.clear();
        for (states, placed) in states.chunks(ROUGH_LANES).zip(self.placed.chunks_exact_mut(parts.max(1))) {
            let (mut angles, mut shut) = ([[0.0; ROUGH_LANES]; AXES], ALL);
            for (lane, q) in states.iter().enumerate().filter(|(_, q)| is_asked(q)) {
                shut &= !(1 << lane);
                for (row, angle) in angles.iter_mut().zip(q) {
                    row[lane] = *angle as f32;
                }
            }
            self.known.push(Known { shut, unsure: 0 });
            place_block(simd, self.outline, &angles, placed);
        }
        self.among_obstacles(simd);
        self.among_themselves(simd);
    }

    #[inline(always)]
    fn among_obstacles<S: Simd>(&mut self, simd: S) {
        let (outline, parts) = (self.outline, self.outline.radii_m.len());
        for &part in &outline.exposed {
            let radius = outline.radii_m[part];
            let reach = Rough::splat(simd, radius + 2.0 * outline.band_m);
            let reach = Point { x: reach, y: reach, z: reach };
            for block in 0..self.known.len() {
                let axis = load(simd, &self.placed[block * parts + part]);
                let bounds = [axis[0].min(axis[1]) - reach, axis[0].max(axis[1]) + reach];
                let open = u64::from(!self.known[block].shut) * EVERY;
                for (first, corners) in outline.boxes.chunks(OBSTACLES).enumerate() {
                    // A byte an obstacle: whether any is met is not asked of each, the answer is too often another one.
                    let mut met = 0;
                    for (byte, corners) in corners.iter().enumerate() {
                        let corners = corners.map(|corner| Point::splat_rough(simd, corner));
                        met |= overlaps(bounds, corners) << (8 * byte);
                    }
                    self.meet(simd, [block, part, first * OBSTACLES], met & open);
                }
            }
        }
        for obstacle in 0..self.waiting.len() {
            let count = std::mem::take(&mut self.waiting[obstacle].count);
            self.judge_waiting(simd, obstacle, count);
        }
    }

    /// Puts the configurations `met` of a block, a part of which is in the boxes about obstacles from `first` on, on the lists of
    /// these obstacles.
    #[inline(always)]
    fn meet<S: Simd>(&mut self, simd: S, [block, part, first]: [usize; 3], mut met: u64) {
        let (outline, radius) = (self.outline, self.outline.radii_m[part]);
        while met != 0 {
            let bit = met.trailing_zeros() as usize;
            met &= met - 1;
            let (obstacle, lane) = (first + bit / ROUGH_LANES, bit % ROUGH_LANES);
            let axis = &self.placed[block * outline.radii_m.len() + part];
            if outline.solids[obstacle].is_none() {
                self.known[block].unsure |= 1 << lane;
            } else if self.waiting[obstacle].push([block, lane], [axis], radius) {
                self.judge_waiting(simd, obstacle, ROUGH_LANES);
            }
        }
    }

    /// Judges the first `count` of what waits for an obstacle.
    #[inline(always)]
    fn judge_waiting<S: Simd>(&mut self, simd: S, obstacle: usize, count: usize) {
        if count > 0 {
            let waiting = &self.waiting[obstacle];
            let found = gaps(simd, self.outline, obstacle, &waiting.axes[0], &waiting.radii);
            waiting.tell(count, found, &mut self.known);
        }
    }

    #[inline(always)]
    fn among_themselves<S: Simd>(&mut self, simd: S) {
        let (outline, parts) = (self.outline, self.outline.radii_m.len());
        let mut waiting = Waiting::EMPTY;
        for pair in &outline.pairs {
            let reach = Rough::splat(simd, pair.balls_m + 2.0 * outline.band_m);
            for block in 0..self.known.len() {
                let axes = pair.parts.map(|part| &self.placed[block * parts + part]);
                let far = far_balls(load(simd, axes[0]), load(simd, axes[1]), reach) as u8;
                let mut near = !(far | self.known[block].shut);
                if near.count_ones() >= MOST {
                    let found = own_gaps(simd, outline, axes, &[pair.touch_m; ROUGH_LANES]);
                    self.known[block].add(found.map(|bits| bits & near));
                    continue;
                }
                while near != 0 {
                    let lane = near.trailing_zeros() as usize;
                    near &= near - 1;
                    if waiting.push([block, lane], axes, pair.touch_m) {
                        let found = own_gaps(simd, outline, waiting.axes.each_ref(), &waiting.radii);
                        waiting.tell(ROUGH_LANES, found, &mut self.known);
                    }
                }
            }
        }
        let found = own_gaps(simd, outline, waiting.axes.each_ref(), &waiting.radii);
        waiting.tell(waiting.count, found, &mut self.known);
    }
}

/// Which of eight axes, thickened by `radii`, touch an obstacle, and which of them may.
fn gaps<S: Simd>(simd: S, outline: &Outline, obstacle: usize, axis: &Axis, radii: &RoughRow) -> [u8; 2] {
    simd.vectorize(
        #[inline(always)]
        || {
            let radii = Rough::load_array_ref(simd, radii);
            outline.solids[obstacle].as_ref().map_or([0, ALL], |solid| {
                sorted(solid.distance(simd, load(simd, axis)) - radii, outline.band_m)
            })
        },
    )
}

/// Which of eight pairs of axes, as far apart as given when they touch, do so, and which of them may.
fn own_gaps<S: Simd>(simd: S, outline: &Outline, axes: [&Axis; 2], touching: &RoughRow) -> [u8; 2] {
    simd.vectorize(
        #[inline(always)]
        || {
            let [p, q] = axes.map(|axis| load(simd, axis));
            let apart = squared_distance_segment_segment_lanes(p, q).sqrt();
            sorted(apart - Rough::load_array_ref(simd, touching), outline.band_m)
        },
    )
}

impl Cell {
    /// Whether the robot can be at each of `states`, as [`is_free`](Self::is_free) says of one.
    ///
    /// Eight configurations are looked at at once; what lies within the error band is asked about again one at a time.
    pub fn are_free(&self, states: &[Joints]) -> Vec<bool> {
        let found = self.are_free_lanes(states);
        states.iter().zip(found).map(|(q, found)| found.unwrap_or_else(|| self.is_free(q))).collect()
    }

    /// What the lanes alone say; `None` in doubt.
    pub(super) fn are_free_lanes(&self, states: &[Joints]) -> Vec<Option<bool>> {
        let mut crowd = Crowd::new(&self.outline);
        let mut found = Vec::with_capacity(states.len());
        for states in states.chunks(CROWD) {
            let limits = self.robot.arm().chain();
            let is_asked = |q: &Joints| limits.allows(q) && is_rough(q);
            dispatch!(level(), simd => crowd.look(simd, states, is_asked));
            found.extend(states.iter().enumerate().map(|(state, q)| {
                let Known { shut, unsure } = crowd.known[state / ROUGH_LANES];
                let is_set = |bits: u8| bits >> (state % ROUGH_LANES) & 1 == 1;
                match (is_set(shut), is_set(unsure)) {
                    (true, _) => (is_rough(q) || !limits.allows(q)).then_some(false),
                    (false, true) => None,
                    (false, false) => Some(true),
                }
            }));
        }
        found
    }
}
