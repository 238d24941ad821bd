//! A* over a lattice with a neighbourhood of any size, specialised for speed.
//!
//! It is [`Search`](super::Search) over [`LatticeGraph`](super::LatticeGraph) (or any graph whose steps are some of a
//! neighbourhood's, in its order) with [`sum`](super::sum), [`Heap`](super::Heap) in the order [`Ties::Fifo`] or
//! [`Ties::Lifo`], [`Stop::GoalPopped`](super::Stop::GoalPopped), closed nodes that stay closed, and
//! [`ListScans`] watching. It returns the same paths, the same costs to the last bit and the same counters; a test holds
//! the two equal. What makes it fast: free and closed cells are bits, so that a column of neighbours is looked up and
//! counted at once; the costs of the ways to a column are compared in one sweep, and only ways that improve a cell are dealt
//! with one by one; open nodes lie in buckets of f, and only those of the bucket in hand are put in order.
#![expect(
    clippy::inline_always,
    reason = "the search is compiled for the instructions of the function it ends up in"
)]

use super::cost::quantised;
use super::frontier::Ties;
use super::neighbourhood::{MOST_ROWS, Shape, Successors, reach, strides};
use super::observe::{ListScans, Lists};
use super::sorted_buckets::{Order, SortedBuckets};
use super::{Counters, Outcome, Report, Route};
use crate::geometry::lanes::{LANES, Lane, Row, Simd, SimdBase as _, SimdMask as _, dispatch, level};
use base::grid::{Bits, Columns, MAX_REACH_CELLS, Offsets};

const NONE: u32 = u32::MAX;

/// One query of a [`LatticeAstar`].
#[derive(Debug)]
pub struct LatticeQuery<'a, S, H> {
    /// Which cells are free.
    pub columns: &'a Columns,
    /// How far apart neighbouring cells are; costs are in its unit.
    pub spacing: f64,
    /// Which of the free cells around a cell are its successors.
    pub successors: &'a mut S,
    /// The heuristic; f may not rise by more than three times the longest step from a cell to a successor.
    pub h: H,
    /// Start and goal.
    pub ends: [u32; 2],
    /// Whether an open node takes a better way.
    pub lower_open: bool,
    /// Most expansions that may be made.
    pub max_expansions: u64,
}

/// The specialised search, built for one neighbourhood and order of ties and used for many queries.
#[derive(Clone, Debug)]
pub struct LatticeAstar {
    offsets: Offsets,
    /// What follows from the spacing and the places of the last query's lattice.
    shape: Shape,
    lists: NodeLists,
}

/// OPEN and CLOSED.
#[derive(Clone, Debug)]
struct NodeLists {
    /// What makes a node's place among equal f of its rank, and its rank of the place: 0, or every bit.
    flip: u32,
    /// By place: what a way to the cell must stay below to be taken. Infinite for cells that were not opened, and minus
    /// infinite for those that take no other way.
    bounds: Vec<f64>,
    /// By place: how many nodes were opened before.
    ranks: Vec<u32>,
    closed: Bits,
    /// By rank.
    nodes: Vec<Node>,
    open: SortedBuckets<Waiting, ByPlace>,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    g: f64,
    h: f64,
    cell: u32,
    place: u32,
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

impl LatticeAstar {
    /// The search with the neighbourhood `offsets` that takes open nodes of equal f in the order of `ties`; `None` for
    /// an order or a neighbourhood that it does not know.
    pub fn new(offsets: &Offsets, ties: Ties) -> Option<Self> {
        let flip = match ties {
            Ties::Fifo => 0,
            Ties::Lifo => u32::MAX,
            Ties::LargerG | Ties::Smaller => return None,
        };
        (reach(offsets) <= MAX_REACH_CELLS as i32).then(|| Self {
            offsets: offsets.clone(),
            shape: Shape::default(),
            lists: NodeLists {
                flip,
                bounds: Vec::new(),
                ranks: Vec::new(),
                closed: Bits::default(),
                nodes: Vec::new(),
                open: SortedBuckets::new(ByPlace, 0),
            },
        })
    }

    /// Searches until the goal is the best open node; what was compared if OPEN and CLOSED were plain lists comes along.
    ///
    /// # Panics
    /// If start or goal are outside the grid, or f rises more than the query promises.
    pub fn run<S, H>(&mut self, mut query: LatticeQuery<'_, S, H>) -> (Report<f64>, ListScans)
    where
        S: Successors,
        H: Fn(u32) -> f64,
    {
        self.fit(query.columns, query.spacing);
        dispatch!(level(), simd => self.solve(simd, &mut query))
    }

    #[inline(always)]
    fn solve<I, S, H>(&mut self, simd: I, query: &mut LatticeQuery<'_, S, H>) -> (Report<f64>, ListScans)
    where
        I: Simd,
        S: Successors,
        H: Fn(u32) -> f64,
    {
        let [start, goal] = query.ends;
        let mut seen = Seen {
            counters: Counters { opened: 1, peak_open: 1, ..Counters::default() },
            lists: Lists { open: 1, closed: 0 },
            scans: ListScans::default(),
        };
        let mut best = Some(self.lists.open_start(start, query));
        let outcome = loop {
            let Some(rank) = best else { break Outcome::NoPath };
            if self.lists.nodes[rank as usize].cell == goal {
                break Outcome::Solved(self.lists.route(rank));
            }
            if seen.counters.expansions >= query.max_expansions {
                break Outcome::BudgetSpent;
            }
            seen.close();
            self.expand(simd, rank, query, &mut seen);
            seen.counters.peak_open = seen.counters.peak_open.max(seen.lists.open);
            best = self.lists.best();
        };
        (Report { outcome, counters: seen.counters }, seen.scans)
    }

    /// Makes room for the cells of `columns`, and works out the steps if the last query's were others.
    fn fit(&mut self, columns: &Columns, spacing: f64) {
        let Self { offsets, shape, lists } = self;
        if (shape.spacing, shape.strides) != (spacing, strides(columns)) {
            *shape = Shape::new(offsets, columns, spacing);
            lists.open = SortedBuckets::new(ByPlace, shape.bucket_bits());
        }
        for node in lists.nodes.drain(..) {
            lists.bounds[node.place as usize] = f64::INFINITY;
        }
        let count = columns.place_count();
        if lists.ranks.len() < count {
            // A sweep at the last place takes lanes beyond it.
            lists.bounds.resize(count + LANES * MOST_ROWS, f64::INFINITY);
            lists.ranks.resize(count, NONE);
            lists.closed = Bits::none(count);
        }
        lists.closed.clear();
    }

    /// Closes a node and deals with its successors.
    #[inline(always)]
    fn expand<I, S, H>(&mut self, simd: I, rank: u32, query: &mut LatticeQuery<'_, S, H>, seen: &mut Seen)
    where
        I: Simd,
        S: Successors,
        H: Fn(u32) -> f64,
    {
        let Self { shape, lists, .. } = self;
        let Node { g, cell, place, .. } = lists.close(rank);
        query.successors.expands(cell);
        let (before, mut looked_up) = (seen.lists, LookedUp::default());
        for block in &shape.blocks {
            let (mut kept, mut open, mut better) = (0, 0, 0);
            for column in &block.columns {
                let (first, shift) = (place.wrapping_add_signed(column.first), column.shift);
                let free = query.columns.free().window(first) & column.mask;
                let here = query.successors.kept(cell, column.dx, shape.reach, free);
                kept |= here << shift;
                open |= (here & !lists.closed.window(first)) << shift;
                let (lengths, bounds) = (&column.lengths[..shape.rows], &lists.bounds[first as usize..]);
                better |= (improved(simd, g, lengths, bounds) & column.mask) << shift;
            }
            better &= open;
            while better != 0 {
                let bit = better.trailing_zeros();
                better &= better - 1;
                let step = block.steps[bit as usize];
                let [place, cell] =
                    [(place, step.place), (cell, step.cell)].map(|(at, by)| at.wrapping_add_signed(by));
                if lists.take(&Way { g: g + step.length, parent: rank, place, cell }, query) {
                    seen.lists.open += 1;
                    looked_up.before_new += looked_up.open + u64::from((open << (63 - bit)).count_ones());
                }
            }
            looked_up.all += u64::from(kept.count_ones());
            looked_up.open += u64::from(open.count_ones());
        }
        seen.counters.opened += seen.lists.open - before.open;
        seen.counters.generated += looked_up.all;
        seen.scans.membership_comparisons += looked_up.comparisons(before, seen.lists.open - before.open);
    }
}

impl NodeLists {
    /// Opens the start and takes it.
    fn open_start<S, H: Fn(u32) -> f64>(&mut self, start: u32, query: &LatticeQuery<'_, S, H>) -> u32 {
        let (place, h) = (query.columns.place(start), (query.h)(start));
        self.nodes.push(Node { g: 0.0, h, cell: start, place, parent: NONE, is_closed: false });
        self.open.begin(Waiting { f: quantised(h), place: self.flip });
        0
    }

    /// Takes the best open node.
    #[inline(always)]
    fn best(&mut self) -> Option<u32> {
        loop {
            let rank = self.open.pop()?.place ^ self.flip;
            if !self.nodes[rank as usize].is_closed {
                return Some(rank);
            }
        }
    }

    #[inline(always)]
    fn close(&mut self, rank: u32) -> Node {
        let node = &mut self.nodes[rank as usize];
        node.is_closed = true;
        self.bounds[node.place as usize] = f64::NEG_INFINITY;
        self.closed.insert(node.place);
        *node
    }

    /// Takes a way that is better than what is known; tells whether it opens the cell.
    #[inline(always)]
    fn take<S, H: Fn(u32) -> f64>(&mut self, way: &Way, query: &LatticeQuery<'_, S, H>) -> bool {
        let Way { g, parent, place, cell } = *way;
        let bound = &mut self.bounds[place as usize];
        let is_new = *bound == f64::INFINITY;
        *bound = if query.lower_open { g } else { f64::NEG_INFINITY };
        let (rank, h) = if is_new {
            let (rank, h) = (self.nodes.len() as u32, (query.h)(cell));
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
    fn route(&self, rank: u32) -> Route<f64> {
        let (mut nodes, mut at) = (Vec::new(), rank);
        while let Some(node) = self.nodes.get(at as usize) {
            nodes.push(node.cell);
            at = node.parent;
        }
        nodes.reverse();
        Route { nodes, cost: self.nodes[rank as usize].g }
    }
}

/// A way to a cell.
struct Way {
    g: f64,
    /// The rank of the node before the cell.
    parent: u32,
    place: u32,
    cell: u32,
}

/// Which of the ways from a node at cost `g` along steps of these lengths stay below their bounds, a bit each.
#[inline(always)]
fn improved<I: Simd>(simd: I, g: f64, lengths: &[Row], bounds: &[f64]) -> u64 {
    let (from, mut bits) = (Lane::splat(simd, g), 0);
    for (row, (lengths, bounds)) in lengths.iter().zip(bounds.as_chunks().0).enumerate() {
        let reached = from + Lane::load_array_ref(simd, lengths);
        let is_below = reached.simd_lt(Lane::load_array_ref(simd, bounds));
        bits |= is_below.to_bitmask() << (LANES * row);
    }
    bits
}

/// What a query has done.
struct Seen {
    counters: Counters,
    lists: Lists,
    scans: ListScans,
}

impl Seen {
    /// The best open node is closed and expanded.
    fn close(&mut self) {
        self.scans.minimum_comparisons += self.lists.open;
        self.lists.open -= 1;
        self.lists.closed += 1;
        self.counters.closed += 1;
        self.counters.expansions += 1;
    }
}

/// The successors of one node.
#[derive(Default)]
struct LookedUp {
    all: u64,
    /// Those that were not closed.
    open: u64,
    /// For each that was new, how many of those that were not closed had been generated, itself included.
    before_new: u64,
}

impl LookedUp {
    /// What lists scanned from end to end compare for them; `lists` are those before the first, `new` were opened.
    fn comparisons(&self, lists: Lists, new: u64) -> u64 {
        // A new node makes OPEN longer for those that come after it.
        self.all * lists.closed + self.open * lists.open + new * self.open - self.before_new
    }
}
