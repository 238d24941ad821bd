//! What was found about hops, kept: contenders and seeds ask about the same ones again and again.

use std::sync::atomic::{AtomicU32, Ordering};

/// Hops of at most this many cells along either axis are kept.
const REACH: i32 = 6;
const SIDE: usize = 2 * REACH as usize + 1;

/// Whether hops are free, as far as it is known.
///
/// What is kept is a function of the hop alone, so that it does not matter who came first. Hops from one cell into one
/// column share a word: bit `i` says that the hop `REACH - i` rows up is free, bit `16 + i` that this is known.
#[derive(Debug)]
pub(super) struct Hops(Vec<AtomicU32>);

impl Hops {
    /// Nothing about any hop from `cells` cells.
    pub(super) fn new(cells: u32) -> Self {
        Self((0..cells as usize * SIDE).map(|_| AtomicU32::new(0)).collect())
    }

    /// What `find` says of the hop by `[dx, dy]` from `cell`; called once.
    pub(super) fn is_free(&self, cell: u32, [dx, dy]: [i32; 2], find: impl Fn([i32; 2]) -> bool) -> bool {
        if dx.abs().max(dy.abs()) > REACH {
            return find([dx, dy]);
        }
        let bit = 1 << (REACH - dy);
        self.known(cell, dx, bit, find) & bit != 0
    }

    /// Those of the hops by `dx` columns from `cell` that are free, among those that are `wanted` about; bit `i` is the hop
    /// `reach - i` rows up.
    #[inline]
    pub(super) fn free(
        &self,
        cell: u32,
        dx: i32,
        reach: i32,
        wanted: u64,
        find: impl Fn([i32; 2]) -> bool,
    ) -> u64 {
        if reach <= REACH {
            let shift = REACH - reach;
            return u64::from(self.known(cell, dx, (wanted << shift) as u32, find)) >> shift;
        }
        let is_free = |bit: &i32| wanted >> bit & 1 == 1 && self.is_free(cell, [dx, reach - bit], &find);
        (0..=2 * reach).filter(is_free).fold(0, |free, bit| free | 1 << bit)
    }

    /// Those of the `wanted` hops that are free.
    #[inline]
    fn known(&self, cell: u32, dx: i32, wanted: u32, find: impl Fn([i32; 2]) -> bool) -> u32 {
        let word = &self.0[cell as usize * SIDE + (dx + REACH) as usize];
        let kept = word.load(Ordering::Relaxed);
        let unknown = wanted & !(kept >> 16);
        if unknown == 0 {
            return wanted & kept;
        }
        let is_free = |bit: &i32| unknown >> bit & 1 == 1 && find([dx, REACH - bit]);
        let found = (0..SIDE as i32).filter(is_free).fold(0, |free, bit| free | 1 << bit);
        wanted & (word.fetch_or(unknown << 16 | found, Ordering::Relaxed) | found)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    #[test]
    fn a_hop_is_checked_once_and_long_ones_each_time() {
        let hops = Hops::new(4);
        let checks = Cell::new(0);
        let ask = |cell, step, answer| {
            hops.is_free(cell, step, |_| {
                checks.set(checks.get() + 1);
                answer
            })
        };
        assert!(ask(0, [6, -6], true) && ask(0, [6, -6], false), "the first answer is kept");
        assert!(!ask(3, [6, 6], false) && !ask(3, [6, 6], true), "and so is a hit");
        assert!(ask(0, [-6, 6], true) && !ask(1, [6, -6], false), "another step or cell is another hop");
        assert!(ask(0, [7, 0], true) && !ask(0, [7, 0], false), "too long to be kept");
        assert_eq!(checks.get(), 6);
    }
}
