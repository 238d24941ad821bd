//! A circular bucket queue for integer keys that lie close together.

use super::frontier::{Best, Frontier, Offer};

/// How many buckets there are.
const BUCKETS: usize = 4096;
const NONE: u32 = u32::MAX;

/// 4096 circular buckets under a two-level bitmap (Dial 1969).
///
/// Order: the smallest key first; among equal keys the item pushed last. All keys in the queue must lie less than
/// 4096 above the key taken last (above the first key pushed, before anything was taken). A consistent octile
/// estimate in units of 1/985 cell grows by at most 2 · 1393 a move, so [`ScaledOctile`](super::ScaledOctile)
/// keeps that promise.
#[derive(Clone, Debug)]
pub struct Buckets<T> {
    /// The link pushed last into each bucket, or `NONE`.
    heads: Box<[u32; BUCKETS]>,
    /// Bit `s % 64` of `words[s / 64]`: bucket `s` holds something.
    words: [u64; BUCKETS / 64],
    /// Bit `w`: `words[w]` is not 0.
    summary: u64,
    links: Vec<Link<T>>,
    low: u64,
}

#[derive(Clone, Copy, Debug)]
struct Link<T> {
    item: T,
    next: u32,
}

impl<T: Copy> Default for Buckets<T> {
    fn default() -> Self {
        Self {
            heads: Box::new([NONE; BUCKETS]),
            words: [0; BUCKETS / 64],
            summary: 0,
            links: Vec::new(),
            low: 0,
        }
    }
}

impl<T: Copy> Buckets<T> {
    /// Forgets everything.
    pub fn clear(&mut self) {
        for (word, bits) in self.words.iter_mut().enumerate() {
            while *bits != 0 {
                self.heads[word * 64 + bits.trailing_zeros() as usize % 64] = NONE;
                *bits &= *bits - 1;
            }
        }
        self.summary = 0;
        self.links.clear();
    }

    /// Adds `item` under `key`.
    ///
    /// # Panics
    /// If `key` is out of the range that the type promises to hold.
    #[inline]
    pub fn push(&mut self, key: u64, item: T) {
        if self.links.is_empty() {
            self.low = key;
        }
        assert!(
            key.wrapping_sub(self.low) < BUCKETS as u64,
            "key {key} is not within 4096 above {}",
            self.low
        );
        let slot = key as usize % BUCKETS;
        let word = slot / 64;
        let bit = 1 << (slot % 64);
        let next = self.heads[slot];
        self.words[word] |= bit;
        self.summary |= 1 << word;
        self.heads[slot] = self.links.len() as u32;
        self.links.push(Link { item, next });
    }

    /// The smallest key held.
    #[inline]
    fn first_key(&self) -> Option<u64> {
        let start = self.low as usize % BUCKETS;
        let word = start / 64;
        let here = self.words[word] & (u64::MAX << (start % 64));
        let slot = if here == 0 {
            let later = self.summary & ((u64::MAX << word) << 1);
            let from = if later == 0 { self.summary } else { later };
            if from == 0 {
                return None;
            }
            let word = from.trailing_zeros() as usize % 64;
            word * 64 + self.words[word].trailing_zeros() as usize
        } else {
            word * 64 + here.trailing_zeros() as usize
        };
        Some(self.low + (slot.wrapping_sub(start) % BUCKETS) as u64)
    }

    /// Takes the first item in the queue's order, with its key.
    #[inline]
    pub fn pop(&mut self) -> Option<(u64, T)> {
        self.low = self.first_key()?;
        self.pop_equal().map(|item| (self.low, item))
    }

    /// Takes the first of the items whose key is the one taken last, if there is one.
    #[inline]
    pub fn pop_equal(&mut self) -> Option<T> {
        let slot = self.low as usize % BUCKETS;
        let head = self.heads[slot];
        if head == NONE {
            return None;
        }
        let Link { item, next } = self.links[head as usize];
        self.heads[slot] = next;
        if next == NONE {
            let word = slot / 64;
            self.words[word] &= !(1 << (slot % 64));
            if self.words[word] == 0 {
                self.summary &= !(1 << word);
            }
        }
        Some(item)
    }
}

impl Frontier for Buckets<Best> {
    fn clear(&mut self) {
        Buckets::clear(self);
    }

    fn push(&mut self, Offer { f, stamp, node, .. }: Offer) {
        Buckets::push(self, f, Best { f, stamp, node });
    }

    fn first(&self) -> Option<Best> {
        let slot = self.first_key()? as usize % BUCKETS;
        Some(self.links[self.heads[slot] as usize].item)
    }

    fn pop(&mut self) -> Option<Best> {
        Buckets::pop(self).map(|(_, best)| best)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use base::seed;
    use rand::RngExt as _;
    use std::collections::BTreeSet;

    #[test]
    fn items_leave_as_from_a_sorted_set_with_the_last_pushed_first() {
        let mut queue = Buckets::default();
        let mut wraps = 0;
        for seed in 0..40 {
            let mut stream = seed::stream(seed);
            queue.clear();
            let mut truth = BTreeSet::new();
            let mut low = stream.random_range(0..10_000_u64);
            let mut pushed = 0_u32;
            let first = low;
            for _ in 0..2_000 {
                if pushed == 0 || stream.random_bool(0.55) {
                    let reach = if pushed == 0 { 1 } else { 4096 };
                    let key = low + stream.random_range(0..reach);
                    queue.push(key, pushed);
                    truth.insert((key, std::cmp::Reverse(pushed)));
                    pushed += 1;
                } else {
                    let expected = truth.pop_first().map(|(key, std::cmp::Reverse(item))| (key, item));
                    assert_eq!(queue.pop(), expected, "seed {seed}");
                    low = expected.map_or(low, |(key, _)| key);
                }
            }
            wraps += (low - first) / 4096;
        }
        assert!(wraps > 40, "the ring was gone round only {wraps} times");
    }

    #[test]
    #[should_panic(expected = "key 99 is not within 4096 above 100")]
    fn a_key_below_the_last_one_taken_is_a_broken_promise() {
        let mut queue = Buckets::default();
        queue.push(100, ());
        queue.push(99, ());
    }
}
