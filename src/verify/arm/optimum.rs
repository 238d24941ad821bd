//! The least length there is, by Dijkstra's algorithm over postures that the verifier judges itself.

use super::{Case, Hops};
use base::grid::CornerRule;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

impl Case<'_> {
    /// The least length of a path from start to goal made of `steps` (columns and rows), in centimetres; `None` if
    /// there is none.
    ///
    /// A hop is judged only where it would shorten the way to its end.
    pub fn optimal_length(&self, steps: &[[i32; 2]]) -> Option<f64> {
        let (start, goal) = (self.point(self.start)?, self.point(self.goal)?);
        let [columns, rows] = self.size.map(|side| side as i32);
        let index = |[x, y]: [i32; 2]| (y * columns + x) as usize;
        let cells = (0..rows).flat_map(|y| (0..columns).map(move |x| [x, y]));
        let postures: Vec<Option<[f64; 2]>> = cells.map(|point| self.free_posture(point)).collect();
        let mut best = vec![f64::INFINITY; postures.len()];
        let mut queue = BinaryHeap::from([Reverse((0_u64, start))]);
        best[index(start)] = 0.0;
        while let Some(Reverse((key, at))) = queue.pop() {
            let reached = f64::from_bits(key);
            if at == goal {
                return Some(reached);
            }
            let Some(from) = postures[index(at)].filter(|_| reached <= best[index(at)]) else { continue };
            for step in steps {
                let next = [at[0] + step[0], at[1] + step[1]];
                if !(0..columns).contains(&next[0]) || !(0..rows).contains(&next[1]) {
                    continue;
                }
                let Some(to) = postures[index(next)] else { continue };
                let cost = reached + self.length(*step);
                let is_legal = || {
                    let sweeps =
                        || self.motion([at, next], [from, to]).is_some_and(|motion| self.is_clear(&motion));
                    self.corner_is_free(at, *step) && (self.hops == Hops::EndPoints || sweeps())
                };
                if cost < best[index(next)] && is_legal() {
                    best[index(next)] = cost;
                    queue.push(Reverse((cost.to_bits(), next)));
                }
            }
        }
        None
    }

    /// Whether the corner rule allows `step` from `at`; it binds diagonal steps of one cell.
    pub(super) fn corner_is_free(&self, [x, y]: [i32; 2], [dx, dy]: [i32; 2]) -> bool {
        if self.corner_rule == CornerRule::Allow || dx.abs() != 1 || dy.abs() != 1 {
            return true;
        }
        let inside =
            |[x, y]: [i32; 2]| (0..self.size[0] as i32).contains(&x) && (0..self.size[1] as i32).contains(&y);
        let flanks = [[x + dx, y], [x, y + dy]].map(|at| inside(at) && self.free_posture(at).is_some());
        match self.corner_rule {
            CornerRule::Allow => true,
            CornerRule::ForbidBoth => flanks != [false, false],
            CornerRule::ForbidAny => flanks == [true, true],
        }
    }
}
