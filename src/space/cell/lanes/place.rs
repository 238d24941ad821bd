//! The body at every configuration of a path.
#![expect(
    clippy::inline_always,
    reason = "lanes are compiled for the instructions of the function they end up in"
)]

use super::Memory;
use crate::geometry::lanes::{Frames, LANES, Lane, Point, Simd, SimdBase, SimdFloat};
use crate::kinematics::AXES;
use crate::space::cell::Cell;

impl Memory {
    /// Fills the rows of the body's axes and of their ways.
    #[inline(always)]
    pub(super) fn place<S: Simd>(&mut self, simd: S, cell: &Cell) {
        let (chain, parts) = (cell.robot.arm().chain(), cell.body.parts());
        for state in (0..self.stride - LANES).step_by(LANES) {
            let mut frame = Frames::splat(simd, chain.base());
            for link in 0..=AXES {
                for (index, part) in parts.iter().enumerate().filter(|(_, part)| part.link() == link) {
                    let segment = &part.capsule().segment;
                    self.put(index * 6, state, frame.point(simd, &segment.a));
                    self.put(index * 6 + 3, state, frame.point(simd, &segment.b));
                }
                if link < AXES {
                    let angle_rad = Lane::from_slice(simd, &self.states[link][state..state + LANES]);
                    frame = chain.next_lanes(simd, &frame, link, angle_rad);
                }
            }
        }
        let (count, stride) = (self.count, self.stride);
        for row in self.placed.chunks_exact_mut(stride) {
            let last = row[count - 1];
            row[count..].fill(last);
        }
        for part in 0..parts.len() {
            self.ways[part * stride] = 0.0;
            for state in (0..stride - LANES).step_by(LANES) {
                let (from, to) = (self.axis(simd, part, state), self.axis(simd, part, state + 1));
                let (a, b) = (to[0] - from[0], to[1] - from[1]);
                let way = a.dot(a).max(b.dot(b)).sqrt();
                let at = part * stride + state + 1;
                way.store_slice(&mut self.ways[at..at + LANES]);
            }
        }
    }

    /// Writes points into three rows from `row` on.
    #[inline(always)]
    fn put<S: Simd>(&mut self, row: usize, state: usize, point: Point<S>) {
        let at = row * self.stride + state;
        point.x.store_slice(&mut self.placed[at..at + LANES]);
        let at = at + self.stride;
        point.y.store_slice(&mut self.placed[at..at + LANES]);
        let at = at + self.stride;
        point.z.store_slice(&mut self.placed[at..at + LANES]);
    }
}
