//! Buckets of f of which only the one in hand is put in order.
#![expect(
    clippy::inline_always,
    reason = "the queue is compiled for the instructions of the search that it serves"
)]

use super::buckets::Buckets;

/// Items by f, then by a further order, which makes no two equal that are held at once.
pub(super) trait Order<T> {
    /// The key that comes first in the order.
    fn f(&self, item: &T) -> u64;

    /// Whether `one` is taken after `other`.
    fn is_after(&self, one: &T, other: &T) -> bool;
}

/// An OPEN list in a total order, for f that do not rise by more than [`Buckets`] hold.
#[derive(Clone, Debug)]
pub(super) struct SortedBuckets<T, O> {
    order: O,
    /// A bucket spans 2 to the power of this many keys.
    bits: u32,
    buckets: Buckets<T>,
    /// The bucket in hand.
    bucket: u64,
    /// What is open in it or below, the first of them last.
    now: Vec<T>,
}

impl<T: Copy, O: Order<T>> SortedBuckets<T, O> {
    /// An empty list whose buckets span 2^`bits` keys.
    pub(super) fn new(order: O, bits: u32) -> Self {
        Self { order, bits, buckets: Buckets::default(), bucket: 0, now: Vec::new() }
    }

    /// Forgets everything; `first` is in hand.
    pub(super) fn begin(&mut self, first: T) -> T {
        self.buckets.clear();
        self.now.clear();
        self.bucket = self.order.f(&first) >> self.bits;
        // The buckets count from the first key.
        self.buckets.push(self.bucket, first);
        self.buckets.pop().map_or(first, |(_, first)| first)
    }

    #[inline(always)]
    pub(super) fn push(&mut self, item: T) {
        let bucket = self.order.f(&item) >> self.bits;
        if bucket <= self.bucket { self.insert(item) } else { self.buckets.push(bucket, item) }
    }

    #[inline(always)]
    pub(super) fn pop(&mut self) -> Option<T> {
        if self.now.is_empty() {
            let (bucket, first) = self.buckets.pop()?;
            self.bucket = bucket;
            self.now.push(first);
            while let Some(other) = self.buckets.pop_equal() {
                self.insert(other);
            }
        }
        self.now.pop()
    }

    /// Puts `item` at its place among what is in hand.
    #[inline]
    fn insert(&mut self, item: T) {
        let mut place = self.now.len();
        self.now.push(item);
        while place > 0 && self.order.is_after(&item, &self.now[place - 1]) {
            self.now[place] = self.now[place - 1];
            place -= 1;
        }
        self.now[place] = item;
    }
}
