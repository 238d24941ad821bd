//! Local paths, eight configurations at once.
//!
//! Steps, reasons and margins are those of the scalar code, which checks one configuration at a time. Inverse kinematics
//! runs in f64, four lanes at once; positions and distances run in f32, eight lanes at once, with errors of a few micrometres.
//! Every comparison that decides a verdict therefore has an error band around its bound ([`SLACK`] in f64, [`Outline`]'s in
//! f32). Inside the band, near singular poses, where another branch may be nearer, and for shapes that have no lanes, the
//! answer is `None` and the scalar code checks the whole path. So a verdict from here is the scalar code's verdict.
//!
//! A configuration is *near* something if its thickened body may touch it; the steps beside it are then halved and checked.
//! Halving can only confirm that a path is free. A configuration within the error band of near therefore counts as near,
//! and a contact found between two configurations is handed to the scalar code.

mod crowd;
mod follow;
mod outline;
mod place;
mod settle;
mod sparse;
mod stand;
#[cfg(test)]
mod tests;

pub(super) use outline::Outline;

use stand::{Close, Look};

use super::way::Way;
use super::{Lines, Path, Pose, Rejection};
use crate::geometry::lanes::{
    Point, ROUGH_LANES, Rough, RoughRow, Simd, SimdBase, SimdFloat, dispatch, level,
};
use crate::kinematics::ik::Branch;
use crate::kinematics::{AXES, Arm, Joints};
use std::f64::consts::TAU;

/// The largest absolute angle that is converted to f32: slightly over one turn. Beyond it an f32 angle is too coarse for
/// the error band.
const MOST_RAD: f64 = 1.01 * TAU;

/// The axis of one part at eight configurations: x, y and z of its first end, then of the second.
type Axis = [RoughRow; 6];

#[expect(clippy::inline_always, reason = "lanes are compiled for the instructions of their caller")]
#[inline(always)]
fn load<S: Simd>(simd: S, [ax, ay, az, bx, by, bz]: &Axis) -> [Point<Rough<S>>; 2] {
    [Point::load(simd, [ax, ay, az]), Point::load(simd, [bx, by, bz])]
}

#[expect(clippy::inline_always, reason = "lanes are compiled for the instructions of their caller")]
#[inline(always)]
fn store<S: Simd>([a, b]: [Point<Rough<S>>; 2], [ax, ay, az, bx, by, bz]: &mut Axis) {
    a.x.store_array(ax);
    a.y.store_array(ay);
    a.z.store_array(az);
    b.x.store_array(bx);
    b.y.store_array(by);
    b.z.store_array(bz);
}

/// The course that the configurations of a path follow.
enum Course<'a> {
    /// A straight line of the joints, by the angles at its start and their changes in a step.
    Line { from: [f32; AXES], step: [f32; AXES] },
    /// A way of the tool in so many steps.
    Way { way: &'a Way, branch: Branch, steps: f64 },
}

/// A path's configurations in blocks of eight, the last one filled with copies of the last, and the body at each.
#[derive(Debug, Default)]
struct Track {
    /// The configurations of a tool's way.
    states: Vec<Joints>,
    /// How many configurations there are.
    count: usize,
    angles: Vec<[RoughRow; AXES]>,
    /// Placed axes, by block, then by part; those beyond the last block are of no path.
    placed: Vec<Axis>,
    /// By how much each part is thickened, error band included: as the placed axes.
    rooms: Vec<RoughRow>,
    /// The largest thickening of each part on the whole path.
    reaches: Vec<f32>,
    /// The box that each thickened part sweeps: its least and its greatest corner.
    swept: Vec<[[f32; 3]; 2]>,
    close: Close,
    /// Which configurations may come near something: one bit each, a number a block.
    near: Vec<u64>,
}

/// Buffers that are reused from path to path.
#[derive(Debug, Default)]
pub(super) struct Memory {
    track: Track,
    halves: settle::Halves,
}

impl Track {
    /// Makes room for `count` configurations of so many parts and overwrites what the buffers held.
    fn open(&mut self, count: usize, parts: usize) {
        let blocks = count.div_ceil(ROUGH_LANES);
        self.count = count;
        self.angles.resize(blocks, [[0.0; ROUGH_LANES]; AXES]);
        // What is longer stays so: a first look and the whole path take turns.
        if self.placed.len() < blocks * parts {
            self.placed.resize(blocks * parts, [[0.0; ROUGH_LANES]; 6]);
            self.rooms.resize(blocks * parts, [0.0; ROUGH_LANES]);
        }
        self.reaches.resize(parts, 0.0);
        self.swept.resize(parts, [[0.0; 3]; 2]);
        self.near.resize(blocks, 0);
    }

    /// Notes that none of `count` configurations comes near anything.
    fn leave_clear(&mut self, count: usize) {
        self.count = count;
        self.near.clear();
        self.near.resize(count.div_ceil(ROUGH_LANES), 0);
    }

    /// Writes the angles of all configurations.
    #[expect(clippy::inline_always, reason = "lanes are compiled for the instructions of their caller")]
    #[inline(always)]
    fn fill<S: Simd>(&mut self, simd: S, course: &Course) {
        let last = self.count - 1;
        for (block, rows) in self.angles.iter_mut().enumerate() {
            let first = block * ROUGH_LANES;
            match course {
                Course::Line { from, step } => {
                    let numbers = Rough::load_array(simd, place::NUMBERS) + first as f32;
                    let numbers = numbers.min(last as f32);
                    for (joint, row) in rows.iter_mut().enumerate() {
                        let from = Rough::splat(simd, from[joint]);
                        numbers.mul_add(step[joint], from).store_array(row);
                    }
                }
                Course::Way { .. } => {
                    for lane in 0..ROUGH_LANES {
                        let q = &self.states[last.min(first + lane)];
                        for (row, angle) in rows.iter_mut().zip(q) {
                            row[lane] = *angle as f32;
                        }
                    }
                }
            }
        }
    }
}

impl Memory {
    /// The verdict on the configurations of a course and, if all are free, on the motion between them.
    #[expect(clippy::inline_always, reason = "lanes are compiled for the instructions of their caller")]
    #[inline(always)]
    fn judge<S: Simd>(
        &mut self,
        simd: S,
        arm: &Arm,
        outline: &Outline,
        course: &Course,
        count: usize,
    ) -> Look {
        let track = &mut self.track;
        let is_narrow = track.narrow(simd, outline, course, count);
        if is_narrow && track.close.is_empty() {
            track.leave_clear(count);
            return Look::Free;
        }
        track.open(count, outline.radii_m.len());
        track.fill(simd, course);
        track.place(simd, outline);
        if is_narrow {
            track.measure(simd, outline, track.close.parts(outline));
            // All that may meet was collected, however far a part strays.
            track.reaches.fill(f32::INFINITY);
        } else {
            track.measure(simd, outline, u64::MAX);
            track.collect(simd, outline);
        }
        match track.look(simd, outline) {
            Look::Free if !track.settle(simd, arm, outline, course, &mut self.halves) => Look::UnsettledPath,
            look => look,
        }
    }
}

/// Whether the angles are small enough for f32.
fn is_rough(q: &Joints) -> bool {
    q.iter().all(|angle| angle.abs() <= MOST_RAD)
}

impl Lines {
    /// Whether the local path between two configurations whose branches allow one can be executed; `None` in doubt.
    pub(super) fn join_lanes(
        &self,
        from: &Pose,
        to: &Pose,
        memory: &mut Memory,
        checked: &mut u64,
    ) -> Option<Result<(), Rejection>> {
        let arm = self.cell.robot.arm();
        let outline = &self.cell.outline;
        if !is_rough(&from.q) || !is_rough(&to.q) {
            return None;
        }
        let way;
        let (course, count) = match self.rules.path {
            Path::Joints => self.line(from, to),
            Path::Tool => {
                way = Way::between(&from.tool, &to.tool);
                if let Err(reason) = self.follow_lanes(from, to, &way, &mut memory.track.states)? {
                    return Some(Err(reason));
                }
                let count = memory.track.states.len();
                if !memory.track.states.iter().all(is_rough) {
                    return None;
                }
                (Course::Way { way: &way, branch: from.branch, steps: (count - 1) as f64 }, count)
            }
        };
        match dispatch!(level(), simd => memory.judge(simd, arm, outline, &course, count)) {
            Look::UnsettledPath => None,
            Look::Contact(order) => {
                *checked += order as u64 + 1;
                Some(Err(Rejection::Contact))
            }
            Look::Free => {
                *checked += count as u64;
                Some(Ok(()))
            }
        }
    }

    /// A straight line of the joints, and how many configurations are looked at on it.
    fn line(&self, from: &Pose, to: &Pose) -> (Course<'_>, usize) {
        let steps = self.joint_steps(from, to);
        let end = self.cell.robot.arm().chain().toward(&from.q, &to.q);
        let step = std::array::from_fn(|i| ((end[i] - from.q[i]) / steps) as f32);
        (Course::Line { from: from.q.map(|angle| angle as f32), step }, steps as usize + 1)
    }
}
