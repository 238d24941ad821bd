//! Configurations that have nothing to do with each other, eight at once: which of them are free.
//!
//! Bodies are placed eight at a time and held against half-spaces where they stand. Few of eight unrelated configurations come
//! near the same thing else: pairs whose boxes overlap are copied side by side, whatever configurations they belong to, and
//! their distances are found together once all are copied. A processor reads what it has just written in smaller pieces
//! only after a while, so no pair is measured right after it was copied.
#![expect(
    clippy::inline_always,
    reason = "lanes are compiled for the instructions of the function they end up in"
)]

use super::outline::Outline;
use super::place::place_block;
use super::stand::overlaps;
use super::{Axis, is_rough, load, store};
use crate::geometry::lanes::{
    Point, ROUGH_LANES, Rough, RoughRow, RoughSolid, Simd, SimdBase, SimdFloat, SimdMask, dispatch, level,
    squared_distance_segment_segment_lanes,
};
use crate::kinematics::{AXES, Joints};
use crate::space::cell::Cell;

/// How many configurations are taken together; what is kept of them stays in the near caches.
const CROWD: usize = 256;
/// How many parts or pairs are looked at in a row: eight bits each fill a word.
const IN_A_ROW: usize = 8;
/// A byte times this is that byte in every byte.
const EVERY: u64 = u64::MAX / 0xff;

const ALL: u8 = u8::MAX;

/// What is known of eight configurations: one bit each.
#[derive(Debug, Clone, Copy, Default)]
struct Known {
    /// In contact, beyond limits or not there: nothing more is checked.
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

/// Eight axes, or pairs of them, that are measured together.
#[derive(Debug, Clone)]
struct Group<const SIDES: usize> {
    /// Where the configuration of each is: its block and its lane.
    states: [[u8; 2]; ROUGH_LANES],
    axes: [Axis; SIDES],
    /// How far apart each is when it touches.
    touch_m: RoughRow,
}

/// What is to be measured.
#[derive(Debug, Clone)]
struct Waiting<const SIDES: usize> {
    count: usize,
    /// Those in use and others, whose memory is used again.
    groups: Vec<Group<SIDES>>,
}

impl<const SIDES: usize> Waiting<SIDES> {
    const EMPTY: Self = Self { count: 0, groups: Vec::new() };

    #[inline(always)]
    fn push(&mut self, [block, lane]: [usize; 2], axes: [&Axis; SIDES], touch_m: f32) {
        let number = self.count / ROUGH_LANES;
        let place = self.count % ROUGH_LANES;
        if number == self.groups.len() {
            self.grow();
        }
        let group = &mut self.groups[number];
        group.states[place] = [block as u8, lane as u8];
        for (waiting, axis) in group.axes.iter_mut().zip(axes) {
            for (row, from) in waiting.iter_mut().zip(axis) {
                row[place] = from[lane];
            }
        }
        group.touch_m[place] = touch_m;
        self.count += 1;
    }

    #[cold]
    fn grow(&mut self) {
        self.groups.push(Group {
            states: [[0; 2]; ROUGH_LANES],
            axes: [[[0.0; ROUGH_LANES]; 6]; SIDES],
            touch_m: [0.0; ROUGH_LANES],
        });
    }

    /// Tells all configurations on the list what `measure` finds, and empties it.
    #[inline(always)]
    fn resolve(&mut self, known: &mut [Known], mut measure: impl FnMut(&Group<SIDES>) -> [u8; 2]) {
        for (first, group) in (0..self.count).step_by(ROUGH_LANES).zip(&self.groups) {
            let found = measure(group);
            for (place, [block, lane]) in group.states.iter().enumerate().take(self.count - first) {
                known[usize::from(*block)].add(found.map(|bits| (bits >> place & 1) << lane));
            }
        }
        self.count = 0;
    }
}

/// Which gaps are contacts, and which are in doubt.
#[inline(always)]
fn sorted<S: Simd>(gap: Rough<S>, band: f32) -> [u8; 2] {
    let free = gap.simd_gt(band);
    let contact = gap.simd_lt(-band);
    [contact, !(free | contact)].map(|mask| mask.to_bitmask() as u8)
}

/// Up to so many configurations and what of them is to be measured.
struct Crowd<'a> {
    outline: &'a Outline,
    known: Vec<Known>,
    /// The parts of eight bodies, and the boxes about them: the least corner, then the greatest.
    placed: Vec<Axis>,
    boxes: Vec<Axis>,
    /// By obstacle.
    at_obstacles: Vec<Waiting<1>>,
    pairs: Waiting<2>,
}

impl<'a> Crowd<'a> {
    fn new(outline: &'a Outline) -> Self {
        let parts = vec![[[0.0; ROUGH_LANES]; 6]; outline.radii_m.len()];
        let at_obstacles = vec![Waiting::EMPTY; outline.solids.len()];
        let known = Vec::new();
        Self { outline, known, placed: parts.clone(), boxes: parts, at_obstacles, pairs: Waiting::EMPTY }
    }

    /// Looks at those of `states` that `is_wanted` names.
    #[inline(always)]
    fn look<S: Simd>(&mut self, simd: S, states: &[Joints], is_wanted: impl Fn(&Joints) -> bool) {
        self.known.clear();
        for (block, states) in states.chunks(ROUGH_LANES).enumerate() {
            let mut angles = [[0.0; ROUGH_LANES]; AXES];
            let mut shut = ALL;
            for (lane, q) in states.iter().enumerate().filter(|(_, q)| is_wanted(q)) {
                shut &= !(1 << lane);
                for (row, angle) in angles.iter_mut().zip(q) {
                    row[lane] = *angle as f32;
                }
            }
            place_block(simd, self.outline, &angles, &mut self.placed);
            let mut known = Known { shut, unsure: 0 };
            self.behind_walls(simd, &mut known);
            self.known.push(known);
            self.bound(simd);
            let open = u64::from(!known.shut) * EVERY;
            self.meet_obstacles(simd, block, open);
            self.meet_themselves(simd, block, open);
        }
        let outline = self.outline;
        let known = &mut self.known;
        self.pairs.resolve(known, |group| own_gaps(simd, outline, group));
        for (waiting, solid) in self.at_obstacles.iter_mut().zip(&outline.solids) {
            let Some(solid) = solid else { continue };
            waiting.resolve(known, |group| gaps(simd, solid, group, outline.band_m));
        }
    }

    /// Holds eight bodies against the half-spaces.
    #[inline(always)]
    fn behind_walls<S: Simd>(&self, simd: S, known: &mut Known) {
        let outline = self.outline;
        for solid in outline.walls.iter().filter_map(|wall| outline.solids[*wall].as_ref()) {
            for &part in &outline.exposed {
                let gap = solid.distance(simd, load(simd, &self.placed[part])) - outline.radii_m[part];
                known.add(sorted(gap, outline.band_m));
            }
        }
    }

    /// Writes the boxes about the parts, error band included.
    #[inline(always)]
    fn bound<S: Simd>(&mut self, simd: S) {
        for ((part, placed), bounds) in self.placed.iter().enumerate().zip(&mut self.boxes) {
            let axis = load(simd, placed);
            let reach = Rough::splat(simd, self.outline.radii_m[part] + 2.0 * self.outline.band_m);
            let reach = Point { x: reach, y: reach, z: reach };
            store([axis[0].min(axis[1]) - reach, axis[0].max(axis[1]) + reach], bounds);
        }
    }

    /// Puts parts on the lists of obstacles whose boxes they meet.
    #[inline(always)]
    fn meet_obstacles<S: Simd>(&mut self, simd: S, block: usize, open: u64) {
        let outline = self.outline;
        for &obstacle in &outline.bounded {
            let corners = outline.boxes[obstacle].map(|corner| Point::splat_rough(simd, corner));
            for parts in outline.exposed.chunks(IN_A_ROW) {
                // A byte a part: whether any is met is not checked for each, the answer is too often another one.
                let mut met = 0;
                for (byte, part) in parts.iter().enumerate() {
                    met |= overlaps(load(simd, &self.boxes[*part]), corners) << (8 * byte);
                }
                met &= open;
                while met != 0 {
                    let bit = met.trailing_zeros() as usize;
                    met &= met - 1;
                    let part = parts[bit / ROUGH_LANES];
                    let lane = bit % ROUGH_LANES;
                    if outline.solids[obstacle].is_none() {
                        self.known[block].unsure |= 1 << lane;
                    } else {
                        let radius_m = outline.radii_m[part];
                        self.at_obstacles[obstacle].push([block, lane], [&self.placed[part]], radius_m);
                    }
                }
            }
        }
    }

    /// Puts pairs of parts whose boxes overlap on the list.
    #[inline(always)]
    fn meet_themselves<S: Simd>(&mut self, simd: S, block: usize, open: u64) {
        for pairs in self.outline.pairs.chunks(IN_A_ROW) {
            let mut met = 0;
            for (byte, pair) in pairs.iter().enumerate() {
                let [a, b] = pair.parts.map(|part| load(simd, &self.boxes[part]));
                met |= overlaps(a, b) << (8 * byte);
            }
            met &= open;
            while met != 0 {
                let bit = met.trailing_zeros() as usize;
                met &= met - 1;
                let pair = &pairs[bit / ROUGH_LANES];
                let lane = bit % ROUGH_LANES;
                self.pairs.push([block, lane], pair.parts.map(|part| &self.placed[part]), pair.touch_m);
            }
        }
    }
}

/// Which of eight axes touch an obstacle, and which of them may.
fn gaps<S: Simd>(simd: S, solid: &RoughSolid, group: &Group<1>, band_m: f32) -> [u8; 2] {
    simd.vectorize(
        #[inline(always)]
        || {
            let gap = solid.distance(simd, load(simd, &group.axes[0]));
            sorted(gap - Rough::load_array_ref(simd, &group.touch_m), band_m)
        },
    )
}

/// Which of eight pairs of axes touch, and which of them may.
fn own_gaps<S: Simd>(simd: S, outline: &Outline, group: &Group<2>) -> [u8; 2] {
    simd.vectorize(
        #[inline(always)]
        || {
            let [p, q] = group.axes.each_ref().map(|axis| load(simd, axis));
            let apart = squared_distance_segment_segment_lanes(p, q).sqrt();
            sorted(apart - Rough::load_array_ref(simd, &group.touch_m), outline.band_m)
        },
    )
}

impl Cell {
    /// Whether the robot can be at each of `states`, as [`is_free`](Self::is_free) says of one.
    ///
    /// Eight configurations are looked at at once; what lies within the error band is checked again one at a time.
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
            let is_wanted = |q: &Joints| limits.allows(q) && is_rough(q);
            dispatch!(level(), simd => crowd.look(simd, states, is_wanted));
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
