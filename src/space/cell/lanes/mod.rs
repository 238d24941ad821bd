//! Local paths, four configurations at once.
//!
//! The same steps, reasons and margins as one configuration at a time, in arithmetic that may differ in the last
//! digits. Every comparison that decides anything is therefore made with a band of [`SLACK`] about its bound; inside the
//! band, near singular poses, where another branch may be nearer, and for shapes that have no lanes, the answer is `None`
//! and the whole path is left to the scalar code. So a verdict from here is the scalar code's verdict.

mod follow;
mod place;
mod stand;
#[cfg(test)]
mod tests;

use stand::Look;

use super::doubt::{Doubt, HALVINGS};
use super::line::{between, middle_outwards};
use super::way::Way;
use super::{Lines, Path, Pose, Rejection};
use crate::geometry::Capsule;
use crate::geometry::lanes::{LANES, Lane, Point, SLACK, Simd, SimdBase, dispatch, level};
use crate::kinematics::ik::Branch;
use crate::kinematics::{AXES, Joints};

/// A path's configurations and the body placed at each, one row a number, padded with copies of the last.
#[derive(Debug, Default)]
pub(super) struct Memory {
    states: [Vec<f64>; AXES],
    /// How many configurations there are without the padding.
    count: usize,
    /// How long a row is.
    stride: usize,
    /// Six rows a part: x, y and z of its axis's first end, then of the second.
    placed: Vec<f64>,
    /// A row a part: how far the ends of its axis went to a configuration from the one before.
    ways: Vec<f64>,
    /// The parts and obstacles that may meet somewhere on the path.
    close: Vec<(usize, usize)>,
    near: Vec<bool>,
}

impl Memory {
    fn clear(&mut self) {
        self.states.iter_mut().for_each(Vec::clear);
    }

    fn push(&mut self, q: &Joints) {
        for (row, angle) in self.states.iter_mut().zip(q) {
            row.push(*angle);
        }
    }

    /// Ends the path: rows are filled up, with room for a look at the next configuration from the last.
    fn close_rows(&mut self, parts: usize) {
        self.count = self.states[0].len();
        self.stride = self.count.next_multiple_of(LANES) + LANES;
        for row in &mut self.states {
            row.resize(self.stride, row[self.count - 1]);
        }
        self.placed.resize(parts * 6 * self.stride, 0.0);
        self.ways.resize(parts * self.stride, 0.0);
    }

    fn blocks(&self) -> usize {
        self.stride / LANES - 1
    }

    fn state(&self, state: usize) -> Joints {
        std::array::from_fn(|joint| self.states[joint][state])
    }

    /// The axis of a part at four configurations from `state` on.
    #[expect(clippy::inline_always, reason = "lanes are compiled for the instructions of their caller")]
    #[inline(always)]
    fn axis<S: Simd>(&self, simd: S, part: usize, state: usize) -> [Point<S>; 2] {
        let row = part * 6;
        [self.point(simd, row, state), self.point(simd, row + 3, state)]
    }

    /// The points in three rows from `row` on.
    #[expect(clippy::inline_always, reason = "lanes are compiled for the instructions of their caller")]
    #[inline(always)]
    fn point<S: Simd>(&self, simd: S, row: usize, state: usize) -> Point<S> {
        let x = row * self.stride + state;
        let (y, z) = (x + self.stride, x + 2 * self.stride);
        Point {
            x: Lane::from_slice(simd, &self.placed[x..x + LANES]),
            y: Lane::from_slice(simd, &self.placed[y..y + LANES]),
            z: Lane::from_slice(simd, &self.placed[z..z + LANES]),
        }
    }
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
        memory.clear();
        let way = match self.rules.path {
            Path::Joints => {
                self.joint_steps(from, to).for_each(|share| memory.push(&between(&from.q, &to.q, share)));
                None
            }
            Path::Tool => {
                let way = Way::between(&from.tool, &to.tool);
                if let Err(reason) = self.follow_lanes(from, to, &way, memory)? {
                    return Some(Err(reason));
                }
                Some(way)
            }
        };
        memory.close_rows(self.cell.body.parts().len());
        dispatch!(level(), simd => memory.place(simd, &self.cell));
        match dispatch!(level(), simd => memory.look(simd, &self.cell)) {
            Look::Doubt => None,
            Look::Contact(order) => {
                *checked += order as u64 + 1;
                Some(Err(Rejection::Contact))
            }
            Look::Free => {
                let settled = self.settle_lanes(way.as_ref(), from.branch, memory)?;
                *checked += memory.count as u64;
                Some(settled)
            }
        }
    }

    /// Looks more closely at the steps from and to configurations that are near something.
    fn settle_lanes(
        &self,
        way: Option<&Way>,
        branch: Branch,
        memory: &Memory,
    ) -> Option<Result<(), Rejection>> {
        let last = memory.count - 1;
        let ends_q = [memory.state(0), memory.state(last)];
        let doubt = Doubt { lines: self, way, branch, ends_q, slack_m: SLACK };
        let stop = |state: usize| {
            let (q, mut placed) = (memory.state(state), Vec::<Capsule>::new());
            self.cell.place(&q, &mut placed);
            (state as f64 / last as f64, q, placed)
        };
        for step in (1..memory.count).filter(|step| memory.near[*step] || memory.near[step - 1]) {
            let (a, b) = (stop(step - 1), stop(step));
            match doubt.settle([(a.0, a.1, &a.2), (b.0, b.1, &b.2)], HALVINGS)? {
                Ok(()) => {}
                refused => return Some(refused),
            }
        }
        Some(Ok(()))
    }
}
