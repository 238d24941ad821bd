//! OPEN and CLOSED of the searches that are specialised for lattices.
//!
//! Closed nodes stay closed. Open nodes lie in buckets of f, and only those of the bucket in hand are put in order.
#![expect(
    clippy::inline_always,
    reason = "the lists are compiled for the instructions of the search that they serve"
)]

use super::Route;
use super::buckets::BUCKETS;
use super::cost::quantised;
use super::frontier::Ties;
use super::sorted_buckets::{Order, SortedBuckets};
use crate::geometry::lanes::{LANES, Lane, Row, Simd, SimdBase as _, SimdMask as _};
use base::grid::Bits;

const NONE: u32 = u32::MAX;

/// OPEN and CLOSED.
#[derive(Clone, Debug)]
pub(super) struct NodeLists {
    /// What makes a node's place among equal f of its rank, and its rank of the place: 0, or every bit.
    flip: u32,
    /// By place: what a way to the cell must stay below to be taken. Infinite for cells that were not opened, and minus
    /// infinite for those that take no other way.
    pub(super) bounds: Vec<f64>,
    /// By place: how many nodes were opened before.
    ranks: Vec<u32>,
    pub(super) closed: Bits,
    /// By rank.
    pub(super) nodes: Vec<Node>,
    open: SortedBuckets<Waiting, ByPlace>,
}

/// A node that was opened.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub(super) g: f64,
    h: f64,
    pub(super) cell: u32,
    pub(super) place: u32,
    /// The rank of the node before it on its way.
    parent: u32,
    is_closed: bool,
}

/// An open node in the queue.
#[derive(Clone, Copy, Debug)]
struct Waiting {
    f: u64,
    /// What orders it among equal f: its rank, or the complement of it.
    place: u32,
}

/// The order of [`Waiting`].
#[derive(Clone, Copy, Debug)]
struct ByPlace;

impl Order<Waiting> for ByPlace {
    #[inline]
    fn f(&self, item: &Waiting) -> u64 {
        item.f
    }

    #[inline]
    fn is_after(&self, one: &Waiting, other: &Waiting) -> bool {
        (one.f, one.place) > (other.f, other.place)
    }
}

/// A way to a cell.
pub(super) struct Way {
    pub(super) g: f64,
    /// The rank of the node before the cell.
    pub(super) parent: u32,
    pub(super) place: u32,
    pub(super) cell: u32,
}

impl NodeLists {
    /// Empty lists that take open nodes of equal f in the order of `ties`; `None` for an order that they do not know.
    pub(super) fn new(ties: Ties) -> Option<Self> {
        let flip = match ties {
            Ties::Fifo => 0,
            Ties::Lifo => u32::MAX,
            Ties::LargerG | Ties::Smaller => return None,
        };
        Some(Self {
            flip,
            bounds: Vec::new(),
            ranks: Vec::new(),
            closed: Bits::default(),
            nodes: Vec::new(),
            open: SortedBuckets::new(ByPlace, 0),
        })
    }

    /// Forgets the last query and makes room for so many places, and for bounds beyond the last of them; `longest` is the
    /// longest step from now on, if it is another one.
    pub(super) fn fit(&mut self, places: usize, beyond: usize, longest: Option<f64>) {
        if let Some(longest) = longest {
            self.open = SortedBuckets::new(ByPlace, bucket_bits(longest));
        }
        for node in self.nodes.drain(..) {
            self.bounds[node.place as usize] = f64::INFINITY;
        }
        if self.ranks.len() < places {
            // A sweep at the last place takes lanes beyond it.
            self.bounds.resize(places + beyond, f64::INFINITY);
            self.ranks.resize(places, NONE);
            self.closed = Bits::none(places);
        }
        self.closed.clear();
    }

    /// Opens the start and takes it.
    pub(super) fn open_start(&mut self, cell: u32, place: u32, h: f64) -> u32 {
        self.nodes.push(Node { g: 0.0, h, cell, place, parent: NONE, is_closed: false });
        self.open.begin(Waiting { f: quantised(h), place: self.flip });
        0
    }

    /// Takes the best open node.
    #[inline(always)]
    pub(super) fn best(&mut self) -> Option<u32> {
        loop {
            let rank = self.open.pop()?.place ^ self.flip;
            if !self.nodes[rank as usize].is_closed {
                return Some(rank);
            }
        }
    }

    /// Closes a node.
    #[inline(always)]
    pub(super) fn close(&mut self, rank: u32) -> Node {
        let node = &mut self.nodes[rank as usize];
        node.is_closed = true;
        self.bounds[node.place as usize] = f64::NEG_INFINITY;
        self.closed.insert(node.place);
        *node
    }

    /// Takes a way that is better than what is known; tells whether it opens the cell. Open nodes take no other way unless
    /// `lower_open`.
    #[inline(always)]
    pub(super) fn take(&mut self, way: &Way, lower_open: bool, h: impl Fn(u32) -> f64) -> bool {
        let Way { g, parent, place, cell } = *way;
        let bound = &mut self.bounds[place as usize];
        let is_new = *bound == f64::INFINITY;
        *bound = if lower_open { g } else { f64::NEG_INFINITY };
        let (rank, h) = if is_new {
            let (rank, h) = (self.nodes.len() as u32, h(cell));
            self.ranks[place as usize] = rank;
            self.nodes.push(Node { g, h, cell, place, parent, is_closed: false });
            (rank, h)
        } else {
            let rank = self.ranks[place as usize];
            let node = &mut self.nodes[rank as usize];
            (node.g, node.parent) = (g, parent);
            (rank, node.h)
        };
        self.open.push(Waiting { f: quantised(g + h), place: rank ^ self.flip });
        is_new
    }

    /// The way to the node of this rank.
    pub(super) fn route(&self, rank: u32) -> Route<f64> {
        let (mut nodes, mut at) = (Vec::new(), rank);
        while let Some(node) = self.nodes.get(at as usize) {
            nodes.push(node.cell);
            at = node.parent;
        }
        nodes.reverse();
        Route { nodes, cost: self.nodes[rank as usize].g }
    }
}

/// Log₂ of the keys that a bucket must span to hold every f that can be open, if f rises by at most three times the longest
/// step.
fn bucket_bits(longest: f64) -> u32 {
    let rise = quantised(3.0 * longest) / (BUCKETS as u64 - 2);
    u64::BITS - rise.leading_zeros()
}

/// Which of the ways from a node at cost `g` along steps of these lengths stay below their bounds, a bit each.
#[inline(always)]
pub(super) fn improved<I: Simd>(simd: I, g: f64, lengths: &[Row], bounds: &[f64]) -> u64 {
    let (from, mut bits) = (Lane::splat(simd, g), 0);
    for (row, (lengths, bounds)) in lengths.iter().zip(bounds.as_chunks().0).enumerate() {
        let reached = from + Lane::load_array_ref(simd, lengths);
        let is_below = reached.simd_lt(Lane::load_array_ref(simd, bounds));
        bits |= is_below.to_bitmask() << (LANES * row);
    }
    bits
}
