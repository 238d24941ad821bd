//! An OPEN list for searches whose f rises little at a step: a binary heap of what comes next, and buckets of what comes later.
//!
//! It takes offers in the order of [`Heap`](super::Heap). That heap holds all that is open, and each offer sinks through it; here one
//! sinks among those of its bucket alone. Costs are those of a grid, in cells.

use super::frontier::{Best, Frontier, Offer, Ties};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// How many buckets there are: as many as a word has bits.
const BUCKETS: u64 = 64;
/// A bucket spans 2 to the power of this many keys: 64 of them span 2.1 cells.
const BITS: u32 = 25;

/// f; what tells offers of one f apart; then place and stamp, by which no two are equal.
type Key = [u64; 3];

/// Binary heap and buckets in the total order (f, tie rule, offer).
#[derive(Clone, Debug)]
pub struct BucketHeap {
    ties: Ties,
    /// The bucket in hand.
    bucket: u64,
    /// What is in it and before it; empty only if nothing is held.
    now: BinaryHeap<Reverse<Key>>,
    /// What is in the buckets beyond it, round and round. In the last one there is also what comes later still.
    later: Vec<Vec<Key>>,
    /// Bit `s`: `later[s]` holds something.
    filled: u64,
    /// The node of each offer, by stamp.
    nodes: Vec<u32>,
}

impl BucketHeap {
    /// An empty one with the given order among equals.
    pub fn new(ties: Ties) -> Self {
        let later = vec![Vec::new(); BUCKETS as usize];
        Self { ties, bucket: 0, now: BinaryHeap::new(), later, filled: 0, nodes: Vec::new() }
    }

    /// Puts `key` into the bucket in hand or beyond.
    #[inline]
    fn put(&mut self, key: Key) {
        let bucket = key[0] >> BITS;
        if bucket <= self.bucket {
            self.now.push(Reverse(key));
        } else {
            let slot = bucket.min(self.bucket + BUCKETS - 1) % BUCKETS;
            self.later[slot as usize].push(key);
            self.filled |= 1 << slot;
        }
    }

    /// Takes the next buckets in hand until there is something.
    fn refill(&mut self) {
        while self.now.is_empty() && self.filled != 0 {
            let at = (self.bucket % BUCKETS) as u32;
            self.bucket += u64::from(self.filled.rotate_right(at).trailing_zeros());
            let slot = self.bucket % BUCKETS;
            self.filled &= !(1 << slot);
            let mut keys = std::mem::take(&mut self.later[slot as usize]);
            keys.drain(..).for_each(|key| self.put(key));
            self.later[slot as usize] = keys;
        }
    }
}

impl Frontier for BucketHeap {
    fn clear(&mut self) {
        self.now.clear();
        self.later.iter_mut().for_each(Vec::clear);
        self.filled = 0;
    }

    fn push(&mut self, Offer { f, g, tie, rank, stamp, node }: Offer) {
        let at = stamp as usize;
        if self.nodes.len() <= at {
            self.nodes.resize(at + 1, 0);
        }
        self.nodes[at] = node;
        if self.now.is_empty() {
            self.bucket = f >> BITS;
        }
        self.put([f, self.ties.depth(g, tie), self.ties.last(rank, stamp)]);
    }

    fn first(&self) -> Option<Best> {
        let Reverse([f, _, last]) = self.now.peek()?;
        let stamp = *last as u32;
        Some(Best { f: *f, stamp, node: self.nodes[stamp as usize] })
    }

    fn pop(&mut self) -> Option<Best> {
        let first = self.first();
        self.now.pop();
        self.refill();
        first
    }
}

#[cfg(test)]
mod tests {
    use super::super::frontier::Heap;
    use super::*;
    use base::seed;
    use rand::RngExt as _;

    #[test]
    fn offers_leave_in_the_order_of_a_heap_whatever_the_ties_and_however_f_falls_and_rises() {
        for ties in [Ties::Fifo, Ties::Lifo, Ties::LargerG, Ties::SmallerG, Ties::Smaller] {
            let (mut heap, mut buckets) = (Heap::new(ties), BucketHeap::new(ties));
            let mut taken = [0, 0];
            for seed in 0..20 {
                let mut stream = seed::stream(seed);
                heap.clear();
                buckets.clear();
                let mut now = 1 << 40;
                for stamp in 0..3_000 {
                    // Mostly within a few buckets, some far off, many equal, some lower than what was taken.
                    let reach = [1 << 10, 1 << 27, 1 << 34][stream.random_range(0..3)];
                    let f = now + stream.random_range(0..reach) / 1_000 * 1_000 - reach / 8;
                    let g = f64::from(stream.random_range(0..4_u32));
                    let tie = stream.random_range(0..3);
                    let offer = Offer { f, g, tie, rank: stream.random_range(0..100), stamp, node: !stamp };
                    heap.push(offer);
                    buckets.push(offer);
                    while stream.random_bool(0.48) {
                        let expected = heap.pop();
                        assert_eq!(buckets.first(), expected, "seed {seed}, {ties:?}");
                        assert_eq!(buckets.pop(), expected, "seed {seed}, {ties:?}");
                        taken[usize::from(expected.is_some_and(|best| best.f < now))] += 1;
                        now = expected.map_or(now, |best| best.f);
                    }
                }
            }
            assert!(taken.iter().all(|count| *count > 1_000), "{ties:?}: rises and falls {taken:?}");
        }
    }
}
