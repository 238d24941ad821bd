//! The least cost of a path on a lattice: A\*, whose open cells lie in a ring of buckets.
//!
//! A cell is opened again whenever it is reached at less cost, and the search goes on until no open cell can improve on the goal's
//! cost. So the order within a bucket moves no result, and a bound need not be consistent to its last digit.

use super::Case;

/// The eight moves; bit `i` of a mask of moves stands for the one at `i`.
const STEPS: [[i32; 2]; 8] = [[-1, -1], [0, -1], [1, -1], [-1, 0], [1, 0], [-1, 1], [0, 1], [1, 1]];

/// How many buckets an estimate that is greater by 1 is further on.
const BUCKETS_PER_CELL: f64 = 16.0;

/// How many buckets are in use at once: a move costs up to √2 and its bound rises by up to as much, so that an estimate rises by
/// less than 3.
const RING: usize = 64;

/// Estimates within 2^-24 are equal: rounding parts them by less, and two costs of paths of fewer than a million moves by more.
const SAME: f64 = 1.0 / 16_777_216.0;

/// A cell with the moves on the way to it, and the least that a path through it can cost.
#[derive(Debug, Clone, Copy)]
struct Open {
    estimate: f64,
    straight: u32,
    diagonal: u32,
    at: [i32; 2],
}

/// Open cells by their estimates, the least first.
#[derive(Debug)]
struct Ring {
    buckets: Vec<Vec<Open>>,
    /// The bucket that is taken from, counted from the estimate 0, and the last one that is.
    now: usize,
    last: usize,
    count: usize,
}

impl Ring {
    fn bucket(estimate: f64) -> usize {
        (estimate * BUCKETS_PER_CELL) as usize
    }

    /// Begins anew with one cell.
    fn begin(&mut self, open: Open) {
        self.buckets.iter_mut().for_each(Vec::clear);
        (self.now, self.last, self.count) = (Self::bucket(open.estimate), usize::MAX, 0);
        self.push(open);
    }

    fn push(&mut self, open: Open) {
        // Rounding may lower an estimate into a bucket that was left.
        self.buckets[Self::bucket(open.estimate).max(self.now) % RING].push(open);
        self.count += 1;
    }

    fn pop(&mut self) -> Option<Open> {
        self.count = self.count.checked_sub(1)?;
        while self.now <= self.last {
            if let Some(open) = self.buckets[self.now % RING].pop() {
                return Some(open);
            }
            self.now += 1;
        }
        None
    }
}

/// The memory of a search, to be used again for the same map.
#[derive(Debug)]
pub(super) struct Scratch {
    /// By cell: the bits of the least cost so far and one more; 0 where no path is known.
    best: Vec<u64>,
    /// The cells with a cost.
    reached: Vec<u32>,
    ring: Ring,
}

impl Scratch {
    /// For a map of as many cells.
    pub(super) fn new(cells: u32) -> Self {
        let ring = Ring { buckets: vec![Vec::new(); RING], now: 0, last: 0, count: 0 };
        Self { best: vec![0; cells as usize], reached: Vec::new(), ring }
    }

    /// What the last search found, by cell; infinite where it did not get.
    pub(super) fn costs(&self) -> impl Iterator<Item = f64> {
        self.best.iter().map(|known| known.checked_sub(1).map_or(f64::INFINITY, f64::from_bits))
    }

    fn clear(&mut self) {
        for cell in self.reached.drain(..) {
            self.best[cell as usize] = 0;
        }
    }

    /// Whether `cost` is the least so far for the cell at `index`; it is then written down.
    fn lower(&mut self, index: usize, cost: f64) -> bool {
        let known = &mut self.best[index];
        // Of 0, no path, the wrapped number is beyond every cost.
        if cost.to_bits() >= known.wrapping_sub(1) {
            return false;
        }
        if *known == 0 {
            self.reached.push(index as u32);
        }
        *known = cost.to_bits() + 1;
        true
    }
}

impl Case<'_> {
    /// The least cost from `start` to every cell, left in `scratch`.
    pub(super) fn flood(&self, start: [i32; 2], moves: impl Fn([i32; 2]) -> u8, scratch: &mut Scratch) {
        self.search((start, None), moves, |_| 0.0, scratch);
    }

    /// The least cost from start to goal; without a goal, of every cell that can be reached, in `scratch`.
    pub(super) fn search(
        &self,
        (start, goal): ([i32; 2], Option<[i32; 2]>),
        moves: impl Fn([i32; 2]) -> u8,
        bound: impl Fn([i32; 2]) -> f64,
        scratch: &mut Scratch,
    ) -> Option<f64> {
        scratch.clear();
        scratch.lower(self.index(start), 0.0);
        scratch.ring.begin(Open { estimate: bound(start), straight: 0, diagonal: 0, at: start });
        let mut found = if goal == Some(start) { 0.0 } else { f64::INFINITY };
        while let Some(Open { estimate, straight, diagonal, at }) = scratch.ring.pop() {
            let is_stale = octile(straight, diagonal).to_bits() >= scratch.best[self.index(at)];
            // Once the goal's cost is known, only what can lower it is followed.
            if is_stale || estimate > found - SAME {
                continue;
            }
            let mut left = moves(at);
            while left != 0 {
                let [dx, dy] = STEPS[left.trailing_zeros() as usize];
                left &= left - 1;
                let next = [at[0] + dx, at[1] + dy];
                let is_diagonal = u32::from(dx != 0 && dy != 0);
                let straight = straight + 1 - is_diagonal;
                let diagonal = diagonal + is_diagonal;
                let cost = octile(straight, diagonal);
                if !scratch.lower(self.index(next), cost) {
                    continue;
                }
                if goal == Some(next) {
                    found = cost;
                    scratch.ring.last = Ring::bucket(cost);
                    continue;
                }
                let estimate = cost + bound(next);
                if estimate <= found - SAME {
                    scratch.ring.push(Open { estimate, straight, diagonal, at: next });
                }
            }
        }
        found.is_finite().then_some(found)
    }

    /// The moves from the free cell `at` to free cells, a bit each.
    pub(super) fn moves(&self, at: [i32; 2]) -> u8 {
        let is_open =
            |[dx, dy]: [i32; 2]| self.grid.is_free_xy(at[0] + dx, at[1] + dy) && self.may_step(at, [dx, dy]);
        Self::steps_by(is_open)
    }

    /// The steps that are legal, a bit each.
    pub(super) fn steps_by(is_legal: impl Fn([i32; 2]) -> bool) -> u8 {
        STEPS.iter().enumerate().fold(0, |mask, (bit, step)| mask | u8::from(is_legal(*step)) << bit)
    }

    pub(super) fn index(&self, [x, y]: [i32; 2]) -> usize {
        (y * self.grid.width() as i32 + x) as usize
    }
}

pub(super) fn octile(straight: u32, diagonal: u32) -> f64 {
    f64::from(straight) + f64::from(diagonal) * std::f64::consts::SQRT_2
}
