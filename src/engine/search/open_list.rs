//! An OPEN list that holds each node once: what is lowered moves.
//!
//! 4096 circular buckets of f under a two-level bitmap (Dial 1969), each a list of nodes that are linked both ways. Only the
//! nodes of the bucket in hand are put in order.
#![expect(
    clippy::inline_always,
    reason = "the queue is compiled for the instructions of the search that it serves"
)]

use super::cost::quantised;

const BUCKETS: usize = 4096;
/// No node.
const NONE: u32 = u32::MAX;

/// What orders an open node, and its neighbours in its bucket.
#[derive(Clone, Copy, Debug)]
pub(super) struct Waiting {
    f: u64,
    /// The order among equal f; no two nodes have the same.
    key: u32,
    next: u32,
    /// Written only in buckets, for every node but the first of one.
    previous: u32,
}

impl Waiting {
    /// A node of this f, in no list.
    pub(super) fn new(f: u64, key: u32) -> Self {
        Self { f, key, next: NONE, previous: NONE }
    }
}

/// A node that was opened.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub(super) g: f64,
    pub(super) h: f64,
    /// The place of the node before it on its way.
    pub(super) parent: u32,
    pub(super) open: Waiting,
}

/// The open nodes, by place.
#[derive(Clone, Debug)]
pub(super) struct OpenList {
    /// A bucket spans 2 to the power of this many keys.
    bits: u32,
    /// The node put last into each bucket, or `NONE`.
    heads: Box<[u32; BUCKETS]>,
    /// Bit `s % 64` of `words[s / 64]`: bucket `s` holds something.
    words: [u64; BUCKETS / 64],
    /// Bit `w`: `words[w]` is not 0.
    summary: u64,
    /// The bucket in hand.
    bucket: u64,
    /// What is open in it or below: f, key and place; the first of them last.
    now: Vec<(u64, u32, u32)>,
}

impl OpenList {
    /// An empty list for f that do not rise by more than three times `longest`.
    pub(super) fn new(longest: f64) -> Self {
        let rise = quantised(3.0 * longest) / (BUCKETS as u64 - 2);
        Self {
            bits: u64::BITS - rise.leading_zeros(),
            heads: Box::new([NONE; BUCKETS]),
            words: [0; BUCKETS / 64],
            summary: 0,
            bucket: 0,
            now: Vec::new(),
        }
    }

    /// Forgets everything; a node of this `f` is in hand.
    pub(super) fn begin(&mut self, f: u64) {
        for (word, bits) in self.words.iter_mut().enumerate() {
            while *bits != 0 {
                self.heads[word * 64 + bits.trailing_zeros() as usize % 64] = NONE;
                *bits &= *bits - 1;
            }
        }
        self.summary = 0;
        self.now.clear();
        self.bucket = f >> self.bits;
    }

    /// Puts in the node at `place`, which waits as `open` says.
    ///
    /// # Panics
    /// If its f is out of the range that the list was made for.
    #[inline(always)]
    pub(super) fn push(&mut self, nodes: &mut [Node], place: u32, mut open: Waiting) {
        let bucket = open.f >> self.bits;
        if bucket <= self.bucket {
            self.insert((open.f, open.key, place));
        } else {
            assert!(bucket - self.bucket < BUCKETS as u64, "f rises by more than was promised");
            let slot = bucket as usize % BUCKETS;
            open.next = std::mem::replace(&mut self.heads[slot], place);
            if let Some(next) = nodes.get_mut(open.next as usize) {
                next.open.previous = place;
            }
            self.words[slot / 64] |= 1 << (slot % 64);
            self.summary |= 1 << (slot / 64);
        }
        nodes[place as usize].open = open;
    }

    /// Gives the node at `place` this `f`.
    ///
    /// # Panics
    /// As [`push`](Self::push).
    #[inline(always)]
    pub(super) fn reorder(&mut self, nodes: &mut [Node], place: u32, f: u64) {
        let before = nodes[place as usize].open;
        if f == before.f {
            return;
        }
        let bucket = before.f >> self.bits;
        if bucket <= self.bucket {
            self.now.retain(|(.., other)| *other != place);
        } else {
            self.unlink(nodes, bucket as usize % BUCKETS, before);
        }
        self.push(nodes, place, Waiting::new(f, before.key));
    }

    /// Takes a node out of the bucket at `slot`.
    #[inline(always)]
    fn unlink(&mut self, nodes: &mut [Node], slot: usize, Waiting { next, previous, .. }: Waiting) {
        if let Some(next) = nodes.get_mut(next as usize) {
            next.open.previous = previous;
        }
        if let Some(previous) = nodes.get_mut(previous as usize) {
            previous.open.next = next;
        } else {
            self.heads[slot] = next;
            if next == NONE {
                self.unmark(slot);
            }
        }
    }

    /// Tells that the bucket at `slot` is empty.
    #[inline(always)]
    fn unmark(&mut self, slot: usize) {
        let word = slot / 64;
        self.words[word] &= !(1 << (slot % 64));
        if self.words[word] == 0 {
            self.summary &= !(1 << word);
        }
    }

    /// The first bucket that holds something, going round from the one in hand.
    #[inline(always)]
    fn first_slot(&self) -> Option<usize> {
        let start = self.bucket as usize % BUCKETS;
        let word = start / 64;
        let here = self.words[word] & (u64::MAX << (start % 64));
        if here != 0 {
            return Some(word * 64 + here.trailing_zeros() as usize);
        }
        // What lies before the start in its own word comes last.
        let later = self.summary.rotate_right(word as u32) & !1;
        let found = if later == 0 { word } else { (word + later.trailing_zeros() as usize) % 64 };
        (self.summary != 0).then(|| found * 64 + self.words[found].trailing_zeros() as usize % 64)
    }

    /// Takes the first node in the order of f, then of keys.
    #[inline(always)]
    pub(super) fn pop(&mut self, nodes: &[Node]) -> Option<u32> {
        if let Some((.., place)) = self.now.pop() {
            return Some(place);
        }
        let slot = self.first_slot()?;
        self.bucket += (slot.wrapping_sub(self.bucket as usize) % BUCKETS) as u64;
        let head = std::mem::replace(&mut self.heads[slot], NONE);
        self.unmark(slot);
        if nodes[head as usize].open.next == NONE {
            return Some(head);
        }
        let mut place = head;
        while let Some(Node { open, .. }) = nodes.get(place as usize) {
            self.insert((open.f, open.key, place));
            place = open.next;
        }
        self.now.pop().map(|(.., place)| place)
    }

    /// Puts a node at its place among what is in hand.
    #[inline]
    fn insert(&mut self, item: (u64, u32, u32)) {
        let mut at = self.now.len();
        self.now.push(item);
        while at > 0 && item > self.now[at - 1] {
            self.now[at] = self.now[at - 1];
            at -= 1;
        }
        self.now[at] = item;
    }
}
