//! What was found about hops, kept: contenders and seeds ask about the same ones again and again.

use std::sync::atomic::{AtomicU8, Ordering};

/// Hops of at most this many cells along either axis are kept.
const REACH: i32 = 6;
const SIDE: usize = 2 * REACH as usize + 1;
const FREE: u8 = 1;
const HIT: u8 = 2;

/// Whether hops are free, as far as it was asked.
///
/// What is kept is a function of the hop alone, so that it does not matter who asked first.
#[derive(Debug)]
pub(super) struct Hops(Vec<AtomicU8>);

impl Hops {
    /// Nothing about any hop from `cells` cells.
    pub(super) fn new(cells: u32) -> Self {
        Self((0..cells as usize * SIDE * SIDE).map(|_| AtomicU8::new(0)).collect())
    }

    /// What `find` says of the hop by `step` from `cell`; asked once.
    pub(super) fn is_free(&self, cell: u32, step: [i32; 2], find: impl FnOnce() -> bool) -> bool {
        if step.iter().any(|cells| cells.abs() > REACH) {
            return find();
        }
        let [x, y] = step.map(|cells| (cells + REACH) as usize);
        let kept = &self.0[(cell as usize * SIDE + y) * SIDE + x];
        match kept.load(Ordering::Relaxed) {
            0 => {
                let is_free = find();
                kept.store(if is_free { FREE } else { HIT }, Ordering::Relaxed);
                is_free
            }
            known => known == FREE,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hop_is_asked_about_once_and_long_ones_each_time() {
        let hops = Hops::new(4);
        let mut asked = 0;
        let mut ask = |cell, step, answer| {
            hops.is_free(cell, step, || {
                asked += 1;
                answer
            })
        };
        assert!(ask(0, [6, -6], true) && ask(0, [6, -6], false), "the first answer is kept");
        assert!(!ask(3, [6, 6], false) && !ask(3, [6, 6], true), "and so is a hit");
        assert!(ask(0, [-6, 6], true) && !ask(1, [6, -6], false), "another step or cell is another hop");
        assert!(ask(0, [7, 0], true) && !ask(0, [7, 0], false), "too long to be kept");
        assert_eq!(asked, 6);
    }
}
