//! OPEN lists: which of the open nodes is taken next.

use super::cost::quantised;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// A node with what may order it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Offer {
    /// The estimate's key; the smallest is taken first.
    pub f: u64,
    /// The cost of the way to the node.
    pub g: f64,
    /// What tells costs of one value apart ([`Cost::tie`](super::Cost::tie)).
    pub tie: u64,
    /// How many nodes had been opened before this one was first opened.
    pub rank: u32,
    /// How many offers were made before in this search.
    pub stamp: u32,
    /// The node.
    pub node: u32,
}

/// What an OPEN list gives back of an offer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Best {
    /// The offer's key.
    pub f: u64,
    /// Its stamp.
    pub stamp: u32,
    /// Its node.
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
    fn first(&self) -> Option<Best>;

    /// Takes the offer that comes first in the frontier's order.
    fn pop(&mut self) -> Option<Best>;
}

/// The order among offers with equal f.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Ties {
    /// The node that was first opened earlier; lowering its g does not move a node.
    #[default]
    Fifo,
    /// The node that was first opened later.
    Lifo,
    /// The node with the larger g (to 1e-9), then the one first opened earlier.
    LargerG,
    /// The node with the smaller g (to 1e-9), then the one first opened earlier.
    SmallerG,
    /// The node whose cost has the smaller [`tie`](super::Cost::tie), then the one first opened earlier; no setting asks for it by this
    /// name.
    #[serde(skip)]
    Smaller,
}

impl Ties {
    /// What tells offers of one f apart before their places do.
    pub(super) fn depth(self, g: f64, tie: u64) -> u64 {
        match self {
            Self::Fifo | Self::Lifo => 0,
            Self::LargerG => !quantised(g),
            Self::SmallerG => quantised(g),
            Self::Smaller => tie,
        }
    }

    /// The place of an offer among those that are equal but for it, and the offer's stamp in the last 32 bits.
    pub(super) fn last(self, rank: u32, stamp: u32) -> u64 {
        let place = if self == Self::Lifo { !rank } else { rank };
        u64::from(place) << 32 | u64::from(stamp)
    }
}

/// A binary heap in the total order (f, tie rule, offer).
#[derive(Clone, Debug, Default)]
pub struct Heap {
    ties: Ties,
    keys: Keys,
    /// The node of each offer, by stamp: keys are moved about, so they hold no more than what orders them.
    nodes: Vec<u32>,
}

/// Keys from the smallest on; the last 32 bits of each are an offer's stamp, which makes keys unique.
#[derive(Clone, Debug)]
enum Keys {
    /// f, place, stamp.
    Flat(BinaryHeap<Reverse<u128>>),
    /// f, then depth or tie, then place and stamp.
    Deep(BinaryHeap<Reverse<[u64; 3]>>),
}

impl Default for Keys {
    fn default() -> Self {
        Self::Flat(BinaryHeap::new())
    }
}

impl Heap {
    /// An empty heap with the given order among equals.
    pub fn new(ties: Ties) -> Self {
        let keys = match ties {
            Ties::Fifo | Ties::Lifo => Keys::default(),
            Ties::LargerG | Ties::SmallerG | Ties::Smaller => Keys::Deep(BinaryHeap::new()),
        };
        Self { ties, keys, nodes: Vec::new() }
    }

    fn best(&self, f: u64, stamp: u32) -> Best {
        Best { f, stamp, node: self.nodes[stamp as usize] }
    }
}

impl Frontier for Heap {
    fn clear(&mut self) {
        match &mut self.keys {
            Keys::Flat(keys) => keys.clear(),
            Keys::Deep(keys) => keys.clear(),
        }
    }

    fn push(&mut self, Offer { f, g, tie, rank, stamp, node }: Offer) {
        let at = stamp as usize;
        if self.nodes.len() <= at {
            self.nodes.resize(at + 1, 0);
        }
        self.nodes[at] = node;
        let last = self.ties.last(rank, stamp);
        match &mut self.keys {
            Keys::Flat(keys) => keys.push(Reverse(u128::from(f) << 64 | u128::from(last))),
            Keys::Deep(keys) => keys.push(Reverse([f, self.ties.depth(g, tie), last])),
        }
    }

    fn first(&self) -> Option<Best> {
        match &self.keys {
            Keys::Flat(keys) => keys.peek().map(|Reverse(key)| self.best((key >> 64) as u64, *key as u32)),
            Keys::Deep(keys) => keys.peek().map(|Reverse([f, _, last])| self.best(*f, *last as u32)),
        }
    }

    fn pop(&mut self) -> Option<Best> {
        let first = self.first();
        match &mut self.keys {
            Keys::Flat(keys) => drop(keys.pop()),
            Keys::Deep(keys) => drop(keys.pop()),
        }
        first
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equals_leave_in_the_order_of_the_tie_rule() {
        // (f, g, tie) by rank.
        let offers = [(5, 1.0, 0), (4, 2.0, 9), (4, 3.0, 7), (4, 3.0, 7), (4, 1.0, 8), (3, 0.0, 9)];
        for (ties, ranks) in [
            (Ties::Fifo, [5, 1, 2, 3, 4, 0]),
            (Ties::Lifo, [5, 4, 3, 2, 1, 0]),
            (Ties::LargerG, [5, 2, 3, 1, 4, 0]),
            (Ties::SmallerG, [5, 4, 1, 2, 3, 0]),
            (Ties::Smaller, [5, 2, 3, 4, 1, 0]),
        ] {
            let mut heap = Heap::new(ties);
            for (rank, (f, g, tie)) in (0..).zip(offers) {
                heap.push(Offer { f, g, tie, rank, stamp: rank + 10, node: rank + 20 });
            }
            for rank in ranks {
                let first = heap.first();
                let (f, ..) = offers[rank as usize];
                assert_eq!(first, Some(Best { f, stamp: rank + 10, node: rank + 20 }), "{ties:?}");
                assert_eq!(heap.pop(), first);
            }
            assert_eq!(heap.pop(), None);
        }
    }
}
