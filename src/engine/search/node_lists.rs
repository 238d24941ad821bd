//! OPEN and CLOSED of the searches that are specialised for lattices.
//!
//! Closed nodes stay closed. Every node has a place, and everything about it lies there, so that a search goes from a place
//! to its neighbours' without asking where they are kept.
#![expect(
    clippy::inline_always,
    reason = "the lists are compiled for the instructions of the search that they serve"
)]

use super::Route;
use super::cost::quantised;
use super::frontier::Ties;
use super::open_list::{Node, OpenList, Waiting};
use base::grid::Bits;
use world::geometry::lanes::{LANES, Lane, Row, Simd, SimdBase as _, SimdMask as _};

/// The place before the start.
const NONE: u32 = u32::MAX;

/// OPEN and CLOSED.
#[derive(Clone, Debug)]
pub(super) struct NodeLists {
    /// What makes a node's key among equal f of how many were opened before: 0, or every bit.
    flip: u32,
    /// By place: what a way to the node must stay below to be taken. Infinite for nodes that were not opened, and minus
    /// infinite for those that take no other way.
    pub(super) bounds: Vec<f64>,
    /// Whether a node was ever opened.
    pub(super) opened: Bits,
    pub(super) closed: Bits,
    /// By place; entries of nodes that were not opened hold no meaning.
    nodes: Vec<Node>,
    /// The places of the nodes in the order in which they were opened.
    order: Vec<u32>,
    open: OpenList,
}

/// A way to a node.
pub(super) struct Way {
    pub(super) g: f64,
    /// The place of the node before it.
    pub(super) parent: u32,
    pub(super) place: u32,
}

impl NodeLists {
    /// Empty lists that take open nodes of equal f in the order of `ties`; `None` for an order that they do not know.
    pub(super) fn new(ties: Ties) -> Option<Self> {
        let flip = match ties {
            Ties::Fifo => 0,
            Ties::Lifo => u32::MAX,
            Ties::LargerG | Ties::SmallerG | Ties::Smaller => return None,
        };
        Some(Self {
            flip,
            bounds: Vec::new(),
            opened: Bits::default(),
            closed: Bits::default(),
            nodes: Vec::new(),
            order: Vec::new(),
            open: OpenList::new(0.0),
        })
    }

    /// Forgets the last query and makes room for so many places, and for bounds beyond the last of them; `longest` is the
    /// longest step from now on, if it is another one.
    pub(super) fn fit(&mut self, places: usize, beyond: usize, longest: Option<f64>) {
        if let Some(longest) = longest {
            self.open = OpenList::new(longest);
        }
        for place in self.order.drain(..) {
            self.bounds[place as usize] = f64::INFINITY;
        }
        if self.nodes.len() < places {
            // A sweep at the last place takes lanes beyond it.
            self.bounds.resize(places + beyond, f64::INFINITY);
            self.nodes.resize(places, Node { g: 0.0, h: 0.0, parent: NONE, open: Waiting::new(0, 0) });
            (self.opened, self.closed) = (Bits::none(places), Bits::none(places));
        }
        self.opened.clear();
        self.closed.clear();
    }

    /// Opens the start and takes it.
    pub(super) fn open_start(&mut self, place: u32, h: f64) -> u32 {
        let f = quantised(h);
        self.nodes[place as usize] = Node { g: 0.0, h, parent: NONE, open: Waiting::new(f, self.flip) };
        self.order.push(place);
        self.opened.insert(place);
        self.open.begin(f);
        place
    }

    /// Takes the best open node.
    #[inline(always)]
    pub(super) fn best(&mut self) -> Option<u32> {
        self.open.pop(&self.nodes)
    }

    /// Closes a node; gives its g.
    #[inline(always)]
    pub(super) fn close(&mut self, place: u32) -> f64 {
        self.bounds[place as usize] = f64::NEG_INFINITY;
        self.closed.insert(place);
        self.nodes[place as usize].g
    }

    /// Opens a node; it will take no other way unless `lower_open`.
    #[inline(always)]
    pub(super) fn add(&mut self, way: &Way, lower_open: bool, h: f64) {
        let Way { g, parent, place } = *way;
        let open = Waiting::new(quantised(g + h), self.order.len() as u32 ^ self.flip);
        self.bounds[place as usize] = if lower_open { g } else { f64::NEG_INFINITY };
        self.opened.insert(place);
        self.order.push(place);
        self.nodes[place as usize] = Node { g, h, parent, open };
        self.open.push(&mut self.nodes, place, open);
    }

    /// Takes a better way to an open node.
    #[inline(always)]
    pub(super) fn lower(&mut self, way: &Way) {
        let Way { g, parent, place } = *way;
        self.bounds[place as usize] = g;
        let node = &mut self.nodes[place as usize];
        (node.g, node.parent) = (g, parent);
        let f = quantised(g + node.h);
        self.open.reorder(&mut self.nodes, place, f);
    }

    /// The way to the node at `place`, as places.
    pub(super) fn route(&self, place: u32) -> Route<f64> {
        let mut nodes = Vec::new();
        let mut at = place;
        while let Some(node) = self.nodes.get(at as usize) {
            nodes.push(at);
            at = node.parent;
        }
        nodes.reverse();
        Route { nodes, cost: self.nodes[place as usize].g }
    }
}

/// Which of the ways from a node at cost `g` along steps of these lengths stay below their bounds, a bit each.
#[inline(always)]
pub(super) fn improved<I: Simd>(simd: I, g: f64, lengths: &[Row], bounds: &[f64]) -> u64 {
    let from = Lane::splat(simd, g);
    let below = |(lengths, bounds): (&Row, &Row)| {
        let reached = from + Lane::load_array_ref(simd, lengths);
        reached.simd_lt(Lane::load_array_ref(simd, bounds)).to_bitmask()
    };
    // The narrow neighbourhoods are most of the work, and what a loop costs is a part of theirs.
    match (lengths, bounds.as_chunks().0) {
        ([l], [b, ..]) => below((l, b)),
        ([l, m], [b, c, ..]) => below((l, b)) | below((m, c)) << LANES,
        ([l, m, n], [b, c, d, ..]) => below((l, b)) | below((m, c)) << LANES | below((n, d)) << (2 * LANES),
        (lengths, bounds) => {
            let rows = lengths.iter().zip(bounds).map(below);
            rows.rev().fold(0, |bits, row| bits << LANES | row)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use base::seed;
    use rand::RngExt as _;
    use std::collections::BTreeSet;

    const PLACES: u32 = 1_000;

    /// Opens, lowers and takes nodes at random beside a sorted set; counts lowered nodes and ties.
    fn against_a_set(lists: &mut NodeLists, seed: u64) -> [u32; 2] {
        let mut stream = seed::stream(seed);
        // A g above `low`; steps of one size make ties, those of the other share a bucket.
        let mut above = |low: f64| {
            let step = [1e-2, 1e-5][stream.random_range(0..2)];
            (
                low + step * f64::from(stream.random_range(0..100_u32)),
                stream.random_range(0..3),
                stream.random(),
            )
        };
        lists.fit(PLACES as usize, LANES, Some(0.5));
        let mut low = 100.0_f64;
        let start = lists.open_start(0, low);
        lists.close(start);
        let mut truth = BTreeSet::new();
        let mut opened = 1;
        let mut seen = [0; 2];
        while opened < PLACES || !truth.is_empty() {
            let (g, choice, chance): (f64, u32, u64) = above(low);
            if choice == 0 && opened < PLACES {
                lists.add(&Way { g, parent: 0, place: opened }, true, 0.0);
                truth.insert((quantised(g), opened ^ lists.flip, opened));
                opened += 1;
            } else if choice == 1 && !truth.is_empty() {
                let &(f, key, place) = truth.iter().nth(chance as usize % truth.len()).unwrap();
                let g = g.min(lists.bounds[place as usize]);
                lists.lower(&Way { g, parent: 0, place });
                truth.remove(&(f, key, place));
                truth.insert((quantised(g), key, place));
                seen[0] += u32::from(quantised(g) < f);
            } else if let Some((f, _, place)) = truth.pop_first() {
                assert_eq!(lists.best(), Some(place), "seed {seed}");
                seen[1] += u32::from(f == quantised(low));
                low = low.max(lists.close(place));
            }
        }
        assert_eq!(lists.best(), None, "seed {seed}");
        seen
    }

    #[test]
    fn nodes_leave_as_from_a_sorted_set_however_often_they_are_lowered() {
        for ties in [Ties::Fifo, Ties::Lifo] {
            let mut lists = NodeLists::new(ties).unwrap();
            let seen = (0..40).map(|seed| against_a_set(&mut lists, seed));
            let [lowered, equal] = seen.fold([0; 2], |sum, seen| [sum[0] + seen[0], sum[1] + seen[1]]);
            assert!(lowered > 2_000 && equal > 500, "{lowered} lowered, {equal} ties");
        }
    }

    #[test]
    #[should_panic(expected = "f rises by more than was promised")]
    fn a_rise_beyond_the_promise_is_refused() {
        let mut lists = NodeLists::new(Ties::Fifo).unwrap();
        lists.fit(4, LANES, Some(1.0));
        lists.open_start(0, 0.0);
        lists.add(&Way { g: 9.0, parent: 0, place: 1 }, true, 0.0);
    }
}
