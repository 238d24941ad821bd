//! OPEN lists: which of the open nodes is taken next.

use super::cost::quantised;
use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

/// A node with what may order it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Offer {
    /// The estimate's key; the smallest is taken first.
    pub f: u64,
    /// The cost of the way to the node.
    pub g: f64,
    /// How many nodes had been opened before this one was first opened.
    pub rank: u32,
    /// How many offers were made before in this search.
    pub stamp: u32,
    /// The node.
    pub node: u32,
}

/// An OPEN list.
///
/// A node whose g is lowered is offered again; the search ignores offers that are no longer the node's last, so a
/// frontier never needs to find one.
pub trait Frontier {
    /// Forgets everything.
    fn clear(&mut self);

    /// Adds an offer.
    fn push(&mut self, offer: Offer);

    /// The offer that [`pop`](Self::pop) would take.
    fn first(&self) -> Option<Offer>;

    /// Takes the offer that comes first in the frontier's order.
    fn pop(&mut self) -> Option<Offer>;
}

/// The order among offers with equal f.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Ties {
    /// The node that was first opened earlier; lowering its g does not move a node.
    #[default]
    Fifo,
    /// The node that was first opened later.
    Lifo,
    /// The node with the larger g (to 1e-9), then the one first opened earlier.
    LargerG,
}

/// A binary heap in the total order (f, tie rule, offer).
#[derive(Clone, Debug, Default)]
pub struct Heap {
    ties: Ties,
    offers: BinaryHeap<Reverse<Ordered>>,
}

/// An offer with the rest of its key: among equal f the smaller `depth` comes first, then the smaller `place`, then
/// the older offer.
#[derive(Clone, Copy, Debug)]
struct Ordered {
    depth: u64,
    place: u32,
    offer: Offer,
}

impl Ordered {
    fn key(&self) -> (u64, u64, u32, u32) {
        (self.offer.f, self.depth, self.place, self.offer.stamp)
    }
}

impl PartialEq for Ordered {
    fn eq(&self, other: &Self) -> bool {
        self.key() == other.key()
    }
}

impl Eq for Ordered {}

impl PartialOrd for Ordered {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Ordered {
    fn cmp(&self, other: &Self) -> Ordering {
        self.key().cmp(&other.key())
    }
}

impl Heap {
    /// An empty heap with the given order among equals.
    pub fn new(ties: Ties) -> Self {
        Self { ties, offers: BinaryHeap::new() }
    }
}

impl Frontier for Heap {
    fn clear(&mut self) {
        self.offers.clear();
    }

    fn push(&mut self, offer: Offer) {
        let (depth, place) = match self.ties {
            Ties::Fifo => (0, offer.rank),
            Ties::Lifo => (0, !offer.rank),
            Ties::LargerG => (!quantised(offer.g), offer.rank),
        };
        self.offers.push(Reverse(Ordered { depth, place, offer }));
    }

    fn first(&self) -> Option<Offer> {
        self.offers.peek().map(|Reverse(ordered)| ordered.offer)
    }

    fn pop(&mut self) -> Option<Offer> {
        self.offers.pop().map(|Reverse(ordered)| ordered.offer)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equals_leave_in_the_order_of_the_tie_rule() {
        // (f, g) by rank.
        let offers = [(5, 1.0), (4, 2.0), (4, 3.0), (4, 3.0), (4, 1.0), (3, 0.0)];
        for (ties, ranks) in [
            (Ties::Fifo, [5, 1, 2, 3, 4, 0]),
            (Ties::Lifo, [5, 4, 3, 2, 1, 0]),
            (Ties::LargerG, [5, 2, 3, 1, 4, 0]),
        ] {
            let mut heap = Heap::new(ties);
            for (rank, (f, g)) in (0..).zip(offers) {
                heap.push(Offer { f, g, rank, stamp: rank + 10, node: rank + 20 });
            }
            for rank in ranks {
                let first = heap.first();
                let (f, g) = offers[rank as usize];
                assert_eq!(first, Some(Offer { f, g, rank, stamp: rank + 10, node: rank + 20 }), "{ties:?}");
                assert_eq!(heap.pop(), first);
            }
            assert_eq!(heap.pop(), None);
        }
    }
}
