//! OPEN lists: which of the open nodes is taken next.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// A node with what may order it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Offer {
    /// The estimate's key; the smallest is taken first.
    pub f: u64,
    /// The cost of the way to the node, in units of 1e-9.
    pub g: u64,
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

/// The fields are compared in the order in which they stand here.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Ordered {
    f: u64,
    depth: u64,
    place: u32,
    stamp: u32,
    node: u32,
    rank: u32,
    g: u64,
}

impl Heap {
    /// An empty heap with the given order among equals.
    pub fn new(ties: Ties) -> Self {
        Self { ties, offers: BinaryHeap::new() }
    }
}

fn offer(Reverse(ordered): Reverse<Ordered>) -> Offer {
    Offer { f: ordered.f, g: ordered.g, rank: ordered.rank, stamp: ordered.stamp, node: ordered.node }
}

impl Frontier for Heap {
    fn clear(&mut self) {
        self.offers.clear();
    }

    fn push(&mut self, Offer { f, g, rank, stamp, node }: Offer) {
        let (depth, place) = match self.ties {
            Ties::Fifo => (0, rank),
            Ties::Lifo => (0, !rank),
            Ties::LargerG => (!g, rank),
        };
        self.offers.push(Reverse(Ordered { f, depth, place, stamp, node, rank, g }));
    }

    fn first(&self) -> Option<Offer> {
        self.offers.peek().copied().map(offer)
    }

    fn pop(&mut self) -> Option<Offer> {
        self.offers.pop().map(offer)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equals_leave_in_the_order_of_the_tie_rule() {
        // (f, g) by rank.
        let offers = [(5, 1), (4, 2), (4, 3), (4, 3), (4, 1), (3, 0)];
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
