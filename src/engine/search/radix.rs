//! A queue for integer keys that never fall below the key taken last, however far above it they lie.

/// A radix heap (Ahuja, Mehlhorn, Orlin & Tarjan 1990).
///
/// Order: the smallest key first; among equal keys the item pushed last. Items lie in buckets by the highest bit in which
/// their keys differ from the key taken last, so that equal keys always share a bucket and keep their order.
#[derive(Clone, Debug)]
pub(super) struct RadixHeap<T> {
    buckets: [Vec<(u32, T)>; 33],
    /// Bit `b`: `buckets[b]` holds something.
    filled: u64,
    low: u32,
}

impl<T> Default for RadixHeap<T> {
    fn default() -> Self {
        Self { buckets: std::array::from_fn(|_| Vec::new()), filled: 0, low: 0 }
    }
}

impl<T: Copy> RadixHeap<T> {
    /// Forgets everything; keys may start from 0 again.
    pub(super) fn clear(&mut self) {
        for bucket in &mut self.buckets {
            bucket.clear();
        }
        (self.filled, self.low) = (0, 0);
    }

    /// Adds `item` under `key`.
    ///
    /// # Panics
    /// If `key` is below the key taken last.
    #[inline]
    pub(super) fn push(&mut self, key: u32, item: T) {
        assert!(key >= self.low, "key {key} is below {}, which was taken", self.low);
        let bucket = 32 - (key ^ self.low).leading_zeros();
        self.buckets[bucket as usize].push((key, item));
        self.filled |= 1 << bucket;
    }

    /// Takes the first item in the queue's order, with its key.
    #[inline]
    pub(super) fn pop(&mut self) -> Option<(u32, T)> {
        if self.filled & 1 == 0 {
            self.refill()?;
        }
        let first = self.buckets[0].pop();
        self.filled &= !u64::from(self.buckets[0].is_empty());
        first
    }

    /// Moves the smallest keys into bucket 0.
    fn refill(&mut self) -> Option<()> {
        let bucket = self.filled.trailing_zeros() as usize;
        let mut items = std::mem::take(self.buckets.get_mut(bucket)?);
        self.filled &= !(1 << bucket);
        self.low = items.iter().map(|(key, _)| *key).min()?;
        for (key, item) in items.drain(..) {
            self.push(key, item);
        }
        self.buckets[bucket] = items;
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use base::seed;
    use rand::RngExt as _;
    use std::cmp::Reverse;
    use std::collections::BTreeSet;

    #[test]
    fn items_leave_as_from_a_sorted_set_with_the_last_pushed_first() {
        let mut queue = RadixHeap::default();
        let mut ties = 0;
        for seed in 0..40 {
            let mut stream = seed::stream(seed);
            queue.clear();
            let mut truth = BTreeSet::new();
            let mut low = 0_u32;
            for pushed in 0..2_000_u32 {
                let reach = [4, 100, 1 << 20][stream.random_range(0..3)];
                let key = low + stream.random_range(0..reach);
                queue.push(key, pushed);
                truth.insert((key, Reverse(pushed)));
                if stream.random_bool(0.55) {
                    let expected = truth.pop_first().map(|(key, Reverse(item))| (key, item));
                    assert_eq!(queue.pop(), expected, "seed {seed}");
                    let taken = expected.map_or(low, |(key, _)| key);
                    ties += u32::from(taken == low);
                    low = taken;
                }
            }
            while let Some((key, Reverse(item))) = truth.pop_first() {
                assert_eq!(queue.pop(), Some((key, item)), "seed {seed}");
            }
            assert_eq!(queue.pop(), None, "seed {seed}");
        }
        assert!(ties > 1_000, "only {ties} keys were taken twice running");
    }

    #[test]
    #[should_panic(expected = "key 99 is below 100, which was taken")]
    fn a_key_below_the_last_one_taken_is_a_broken_promise() {
        let mut queue = RadixHeap::default();
        queue.push(100, ());
        queue.pop();
        queue.push(99, ());
    }
}
