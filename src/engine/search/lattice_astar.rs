//! A* over a lattice with a neighbourhood of any size, specialised for speed.
//!
//! It is [`Search`](super::Search) over [`LatticeGraph`](super::LatticeGraph), or any graph whose steps are some of a
//! neighbourhood's, in its order. It has [`sum`](super::sum), [`Stop::GoalPopped`](super::Stop::GoalPopped), and a
//! [`Heap`](super::Heap) in the order [`Ties::Fifo`] or [`Ties::Lifo`]. Closed nodes stay closed, and [`ListScans`]
//! watches. It returns the same paths, the same costs to the last bit and the same counters; a test holds the two
//! equal. What makes it fast: free and closed cells are bits, and a column of neighbours is looked up and counted at
//! once. The costs of the ways to a column are compared in one sweep, and only ways that improve a cell are dealt with
//! one by one. Open nodes lie in buckets of f, each of them once. Only those of the bucket in hand are put in order.
#![expect(
    clippy::inline_always,
    reason = "the search is compiled for the instructions of the function it ends up in"
)]

use super::frontier::Ties;
use super::neighbourhood::{Block, MOST_ROWS, Shape, Step, Successors, reach, strides};
use super::node_lists::{NodeLists, Way, improved};
use super::observe::{ListScans, Lists};
use super::{Counters, Outcome, Report, Route};
use base::grid::{Columns, MAX_REACH_CELLS, Offsets};
use world::geometry::lanes::{LANES, Simd, dispatch, level};

/// One query of a [`LatticeAstar`].
#[derive(Debug)]
pub struct LatticeQuery<'a, S, H> {
    /// Which cells are free.
    pub columns: &'a Columns,
    /// How far apart neighbouring cells are; costs are in its unit.
    pub spacing: f64,
    /// Which of the free cells around a cell are its successors.
    pub successors: &'a mut S,
    /// The heuristic, of a column and a row; f may not rise by more than three times the longest step from a cell to a successor.
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

impl LatticeAstar {
    /// The search with the neighbourhood `offsets` that takes open nodes of equal f in the order of `ties`; `None` for
    /// an order or a neighbourhood that it does not know.
    pub fn new(offsets: &Offsets, ties: Ties) -> Option<Self> {
        let lists = NodeLists::new(ties)?;
        (reach(offsets) <= MAX_REACH_CELLS as i32).then(|| Self {
            offsets: offsets.clone(),
            shape: Shape::default(),
            lists,
        })
    }

    /// Searches until the goal is the best open node; what was compared if OPEN and CLOSED were plain lists comes along.
    ///
    /// # Panics
    /// If start or goal are outside the grid, or f rises more than the query promises.
    pub fn run<S, H>(&mut self, mut query: LatticeQuery<'_, S, H>) -> (Report<f64>, ListScans)
    where
        S: Successors,
        H: Fn([u32; 2]) -> f64,
    {
        self.fit(query.columns, query.spacing);
        dispatch!(level(), simd => self.solve(simd, &mut query))
    }

    #[inline(always)]
    fn solve<I, S, H>(&mut self, simd: I, query: &mut LatticeQuery<'_, S, H>) -> (Report<f64>, ListScans)
    where
        I: Simd,
        S: Successors,
        H: Fn([u32; 2]) -> f64,
    {
        let [start, goal] = query.ends;
        let mut seen = Seen {
            counters: Counters { opened: 1, peak_open: 1, ..Counters::default() },
            lists: Lists { open: 1, closed: 0 },
            scans: ListScans::default(),
        };
        let [place, goal] = [start, goal].map(|cell| query.columns.place(cell));
        let h = (query.h)(query.columns.xy(place));
        let mut best = Some(self.lists.open_start(place, h));
        let outcome = loop {
            let Some(place) = best else { break Outcome::NoPath };
            if place == goal {
                break Outcome::Solved(self.route(query.columns, place));
            }
            if seen.counters.expansions >= query.max_expansions {
                break Outcome::BudgetSpent;
            }
            seen.close();
            self.expand(simd, place, query, &mut seen);
            seen.counters.peak_open = seen.counters.peak_open.max(seen.lists.open);
            best = self.lists.best();
        };
        (Report { outcome, counters: seen.counters }, seen.scans)
    }

    /// Makes room for the cells of `columns`, and works out the steps if the last query's were others.
    fn fit(&mut self, columns: &Columns, spacing: f64) {
        let Self { offsets, shape, lists } = self;
        let is_other = (shape.spacing, shape.strides) != (spacing, strides(columns));
        if is_other {
            *shape = Shape::new(offsets, columns, spacing);
        }
        lists.fit(columns.place_count(), LANES * MOST_ROWS, is_other.then(|| shape.longest()));
    }

    /// The way to the cell at `place`.
    fn route(&self, columns: &Columns, place: u32) -> Route<f64> {
        let mut route = self.lists.route(place);
        for node in &mut route.nodes {
            let [x, y] = columns.xy(*node);
            *node = y * columns.width() + x;
        }
        route
    }

    /// Closes a node and deals with its successors.
    #[inline(always)]
    fn expand<I, S, H>(&mut self, simd: I, place: u32, query: &mut LatticeQuery<'_, S, H>, seen: &mut Seen)
    where
        I: Simd,
        S: Successors,
        H: Fn([u32; 2]) -> f64,
    {
        let Self { shape, lists, .. } = self;
        let g = lists.close(place);
        let [x, y] = query.columns.xy(place);
        let at = At { g, place, cell: y * query.columns.width() + x };
        query.successors.expands(at.cell);
        let before = seen.lists;
        let mut looked_up = LookedUp::default();
        for block in &shape.blocks {
            let Around { kept, open, opened, better } = at.around(simd, lists, shape, block, query);
            // New nodes first: their heuristic takes longest, and is worked out while the others are dealt with.
            for bit in bits(open & !opened) {
                let step = block.steps[bit as usize];
                let [dx, dy] = step.xy;
                let h = (query.h)([x.wrapping_add_signed(dx), y.wrapping_add_signed(dy)]);
                lists.add(&at.way(step), query.lower_open, h);
                seen.lists.open += 1;
                looked_up.before_new += looked_up.open + u64::from((open << (63 - bit)).count_ones());
            }
            for bit in bits(open & opened & better) {
                lists.lower(&at.way(block.steps[bit as usize]));
            }
            looked_up.all += u64::from(kept.count_ones());
            looked_up.open += u64::from(open.count_ones());
        }
        seen.counters.opened += seen.lists.open - before.open;
        seen.counters.generated += looked_up.all;
        seen.scans.membership_comparisons += looked_up.comparisons(before, seen.lists.open - before.open);
    }
}

/// The places of the bits that are set, the lowest first.
#[inline(always)]
fn bits(mut of: u64) -> impl Iterator<Item = u32> {
    std::iter::from_fn(move || {
        let bit = (of != 0).then(|| of.trailing_zeros());
        of &= of.wrapping_sub(1);
        bit
    })
}

/// The node that is expanded.
struct At {
    g: f64,
    place: u32,
    cell: u32,
}

/// Nodes around one, a bit each.
#[derive(Default)]
struct Around {
    /// Its successors.
    kept: u64,
    /// Those that are not closed.
    open: u64,
    /// Nodes that were ever opened.
    opened: u64,
    /// Nodes to which the way through it is better than what is known.
    better: u64,
}

impl At {
    /// The way on by `step`.
    #[inline(always)]
    fn way(&self, step: Step) -> Way {
        let place = self.place.wrapping_add_signed(step.place);
        Way { g: self.g + step.length, parent: self.place, place }
    }

    /// What lies in the columns of `block`.
    #[inline(always)]
    fn around<I: Simd, S: Successors, H>(
        &self,
        simd: I,
        lists: &NodeLists,
        shape: &Shape,
        block: &Block,
        query: &mut LatticeQuery<'_, S, H>,
    ) -> Around {
        let mut around = Around::default();
        for column in &block.columns {
            let first = self.place.wrapping_add_signed(column.first);
            let shift = column.shift;
            let free = query.columns.free().window(first) & column.mask;
            let kept = query.successors.kept(self.cell, column.dx, shape.reach, free);
            let lengths = &column.lengths[..shape.rows];
            let bounds = &lists.bounds[first as usize..];
            around.kept |= kept << shift;
            around.open |= (kept & !lists.closed.window(first)) << shift;
            around.opened |= (lists.opened.window(first) & column.mask) << shift;
            around.better |= (improved(simd, self.g, lengths, bounds) & column.mask) << shift;
        }
        around
    }
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
