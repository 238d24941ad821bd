//! A* over a cubic lattice with 26 neighbours, specialised for speed.
//!
//! It is [`Search`](super::Search) over a graph whose successors are some of the 26 neighbours in the order of
//! [`STEPS_26`], with [`sum`](super::sum) and [`Stop::GoalPopped`](super::Stop::GoalPopped). Its frontier is a
//! [`Heap`](super::Heap) in the order [`Ties::Fifo`] or [`Ties::Lifo`]. Open nodes are lowered, and closed ones stay
//! closed. It returns the same paths, the same costs to the last bit and the same counters; a test holds the two equal.
//! What makes it fast: the costs of the ways to a row of neighbours are compared at once, and only ways that improve a
//! node are dealt with one by one. Open nodes lie in buckets of f.
//!
//! [`STEPS_26`]: base::grid::STEPS_26
#![expect(
    clippy::inline_always,
    reason = "the search is compiled for the instructions of the function it ends up in"
)]

use super::frontier::Ties;
use super::node_lists::{NodeLists, Way, improved};
use super::{Counters, Outcome, Report};
use base::grid::Grid3;
use world::geometry::lanes::{LANES, Row, Simd, dispatch, level};

/// The bit of the node itself among those of its neighbourhood.
const OWN: u32 = 13;
/// How many nodes of a row are neighbours.
const IN_A_ROW: usize = 3;

/// One query of a [`CubicAstar`].
#[derive(Debug)]
pub struct CubicQuery<'a, N, M, H, G> {
    /// The lattice.
    pub grid: &'a Grid3,
    /// How far apart neighbouring nodes are along an axis; costs are in its unit.
    pub spacing: f64,
    /// Whether some moves from a node to free neighbours are refused.
    pub is_near: N,
    /// Whether a move from such a node to a free neighbour is allowed.
    pub may_step: M,
    /// The heuristic; f may not rise by more than three times the longest step from a node to a successor.
    pub h: H,
    /// Whether a node ends the search.
    pub is_goal: G,
    /// Where the search begins.
    pub start: u32,
    /// Most expansions that may be made.
    pub max_expansions: u64,
}

/// The specialised search, built for one order of ties and used for many queries.
#[derive(Clone, Debug)]
pub struct CubicAstar {
    /// What follows from the spacing and the size of the last query's lattice.
    steps: Steps,
    lists: NodeLists,
}

/// The steps to a node's neighbours and to itself.
#[derive(Clone, Debug, Default, PartialEq)]
struct Steps {
    /// By bit: what the step adds to a node, and its length.
    each: Vec<(i32, f64)>,
    /// The lengths of each row's.
    rows: Vec<Row>,
}

impl Steps {
    fn new(grid: &Grid3, spacing: f64) -> Self {
        let each = (0..27).map(|bit| {
            let step = [bit % 3 - 1, bit / 3 % 3 - 1, bit / 9 - 1];
            (grid.offset(step), f64::from(step.map(|c| c * c).iter().sum::<i32>()).sqrt() * spacing)
        });
        let each: Vec<_> = each.collect();
        let row = |row: &[(i32, f64)]| {
            std::array::from_fn(|lane| row.get(lane).map_or(f64::INFINITY, |(_, length)| *length))
        };
        let rows = each.chunks(IN_A_ROW).map(row).collect();
        Self { each, rows }
    }

    /// Those of a node's neighbours, one bit each, to which a move is allowed.
    #[inline(always)]
    fn kept(&self, mut wanted: u32, is_allowed: impl Fn(i32) -> bool) -> u32 {
        let mut kept = wanted;
        while wanted != 0 {
            let bit = wanted.trailing_zeros();
            wanted &= wanted - 1;
            kept &= !(u32::from(!is_allowed(self.each[bit as usize].0)) << bit);
        }
        kept
    }

    /// What is about a closed node of this cost, a bit each: free, better reached over the node, opened before.
    #[inline(always)]
    fn around<S: Simd>(
        &self,
        simd: S,
        lists: &NodeLists,
        (node, g): (u32, f64),
        is_free: impl Fn(u32) -> bool,
    ) -> [u32; 3] {
        let [mut free, mut better, mut opened] = [0; 3];
        for (row, lengths) in self.rows.iter().enumerate() {
            let first = node.wrapping_add_signed(self.each[row * IN_A_ROW].0);
            for lane in 0..IN_A_ROW {
                free |= u32::from(is_free(first + lane as u32)) << (row * IN_A_ROW + lane);
            }
            let below = improved(simd, g, std::slice::from_ref(lengths), &lists.bounds[first as usize..]);
            let row_of = |bits: u64| (bits as u32 & ((1 << IN_A_ROW) - 1)) << (row * IN_A_ROW);
            better |= row_of(below);
            opened |= row_of(lists.opened.window(first));
        }
        [free, better, opened]
    }
}

impl CubicAstar {
    /// The search that takes open nodes of equal f in the order of `ties`; `None` for an order that it does not know.
    pub fn new(ties: Ties) -> Option<Self> {
        Some(Self { steps: Steps::default(), lists: NodeLists::new(ties)? })
    }

    /// Searches until a goal is the best open node.
    ///
    /// # Panics
    /// If the start is outside the lattice or on its border, or f rises more than the query promises.
    pub fn run<N, M, H, G>(&mut self, query: &CubicQuery<'_, N, M, H, G>) -> Report<f64>
    where
        N: Fn(u32) -> bool,
        M: Fn(u32, u32) -> bool,
        H: Fn(u32) -> f64,
        G: Fn(u32) -> bool,
    {
        let steps = Steps::new(query.grid, query.spacing);
        let is_other = steps != self.steps;
        self.lists.fit(query.grid.node_count(), LANES, is_other.then(|| steps.each[0].1));
        self.steps = steps;
        dispatch!(level(), simd => self.solve(simd, query))
    }

    #[inline(always)]
    fn solve<S, N, M, H, G>(&mut self, simd: S, query: &CubicQuery<'_, N, M, H, G>) -> Report<f64>
    where
        S: Simd,
        N: Fn(u32) -> bool,
        M: Fn(u32, u32) -> bool,
        H: Fn(u32) -> f64,
        G: Fn(u32) -> bool,
    {
        let mut counters = Counters { opened: 1, peak_open: 1, ..Counters::default() };
        let mut best = Some(self.lists.open_start(query.start, (query.h)(query.start)));
        let outcome = loop {
            let Some(node) = best else { break Outcome::NoPath };
            if (query.is_goal)(node) {
                break Outcome::Solved(self.lists.route(node));
            }
            if counters.expansions >= query.max_expansions {
                break Outcome::BudgetSpent;
            }
            counters.closed += 1;
            counters.expansions += 1;
            self.expand(simd, node, query, &mut counters);
            counters.peak_open = counters.peak_open.max(counters.opened - counters.closed);
            best = self.lists.best();
        };
        Report { outcome, counters }
    }

    /// Closes a node and deals with its successors.
    #[inline(always)]
    fn expand<S, N, M, H, G>(
        &mut self,
        simd: S,
        node: u32,
        query: &CubicQuery<'_, N, M, H, G>,
        counters: &mut Counters,
    ) where
        S: Simd,
        N: Fn(u32) -> bool,
        M: Fn(u32, u32) -> bool,
        H: Fn(u32) -> f64,
    {
        let Self { steps, lists } = self;
        let g = lists.close(node);
        let [free, mut better, opened] =
            steps.around(simd, lists, (node, g), |cell| query.grid.is_free(cell));
        let mut kept = free & !(1 << OWN);
        if (query.is_near)(node) {
            kept = steps.kept(kept, |offset| (query.may_step)(node, node.wrapping_add_signed(offset)));
        }
        counters.generated += u64::from(kept.count_ones());
        better &= kept;
        while better != 0 {
            let bit = better.trailing_zeros();
            let (offset, length) = steps.each[bit as usize];
            better &= better - 1;
            let to = node.wrapping_add_signed(offset);
            let way = Way { g: g + length, parent: node, place: to };
            if opened >> bit & 1 == 1 {
                lists.lower(&way);
            } else {
                lists.add(&way, true, (query.h)(to));
                counters.opened += 1;
            }
        }
    }
}
