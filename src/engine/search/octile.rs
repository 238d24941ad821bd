//! A* on 8-connected grids with the octile distance, specialised for speed.
//!
//! It is [`Search`](super::Search) over [`GridGraph`](super::GridGraph), [`ScaledOctile`] and
//! [`Buckets`](super::Buckets), written out for one case, and returns the same costs and counters; a test holds the
//! two equal. What makes it fast:
//!
//! - Nothing is cleared between queries. Each query counts g from a lower base than the one before, so that every g left
//!   behind is larger than any of its own.
//! - Parents are not stored; they are recovered from g.
//! - A row is padded to a power of two, so that column and row are bits of an index.
//! - Empty rows above and below keep every neighbour inside the arrays. A forbidden move then improves nothing and needs no
//!   branch.
//!
//! Costs are ordered in units of 985 and 1393, which is exact while ways to one cell differ by less than 985 in
//! their diagonal moves ([`ScaledOctile`]).

use super::buckets::Buckets;
use super::cost::{Cost, Octile};
use super::estimate::ScaledOctile;
use super::{Counters, Outcome, Report, Route};
use base::grid::{DIRECTIONS, Moves};

/// Empty rows below a grid: one for the neighbours below, one for the neighbour left of the first of these.
const BELOW: u32 = 2;

/// The most cells of a padded grid whose longest conceivable path still has a 32-bit cost.
pub(super) const MAX_CELLS: usize = (u32::MAX / ScaledOctile::DIAGONAL) as usize;

pub(super) const COSTS: [u32; 8] = {
    let mut costs = [ScaledOctile::STRAIGHT; 8];
    let mut bit = 0;
    while bit < 8 {
        if DIRECTIONS[bit][0] != 0 && DIRECTIONS[bit][1] != 0 {
            costs[bit] = ScaledOctile::DIAGONAL;
        }
        bit += 1;
    }
    costs
};

/// What a search cannot be built for.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SearchError {
    /// The grid is too large for 32-bit costs.
    #[error(
        "a grid of {width} × {height} cells, {padded} with what surrounds them; up to {MAX_CELLS} are accepted"
    )]
    GridTooLarge {
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
        /// Cells after padding.
        padded: usize,
    },
}

/// The specialised A*, built for one grid and corner rule and used for many queries.
#[derive(Clone, Debug)]
pub struct OctileAstar {
    width: u32,
    /// Log₂ of the padded row length; padded index = (y + BELOW) << shift | x.
    shift: u32,
    masks: Vec<u8>,
    /// `base + g` for the cells opened by this query; anything above `base + longest` is from before.
    values: Vec<u32>,
    base: u32,
    /// No path costs more.
    longest: u32,
    steps: [i32; 8],
    open: Buckets<(u32, u32)>,
}

impl OctileAstar {
    /// The search over the legal `moves` of a grid.
    ///
    /// # Errors
    /// [`SearchError::GridTooLarge`] if the padded grid has more than 3 083 250 cells.
    pub fn new(moves: &Moves) -> Result<Self, SearchError> {
        let (width, height) = (moves.width(), moves.cell_count() / moves.width());
        let shift = width.next_power_of_two().trailing_zeros();
        let padded = ((height as usize + BELOW as usize + 1) << shift) + 1;
        if padded > MAX_CELLS {
            return Err(SearchError::GridTooLarge { width, height, padded });
        }
        let mut masks = vec![0; padded];
        for cell in 0..moves.cell_count() {
            masks[(((cell / width + BELOW) << shift) + cell % width) as usize] = moves.mask(cell);
        }
        Ok(Self {
            width,
            shift,
            masks,
            values: vec![u32::MAX; padded],
            base: u32::MAX,
            longest: moves.cell_count() * ScaledOctile::DIAGONAL,
            steps: DIRECTIONS.map(|[dx, dy]| (dy << shift) + dx),
            open: Buckets::default(),
        })
    }

    /// The padded index of `cell`.
    fn padded(&self, cell: u32) -> u32 {
        ((cell / self.width + BELOW) << self.shift) + cell % self.width
    }

    /// The cell at a padded index.
    fn cell(&self, node: u32) -> u32 {
        ((node >> self.shift) - BELOW) * self.width + (node & ((1 << self.shift) - 1))
    }

    /// A shortest path from `start` to `goal`; the search ends when the goal is popped.
    ///
    /// Among equal f the cell offered last is expanded first; among shortest paths the one is returned whose
    /// cells, walked back from the goal, come first in the order of [`DIRECTIONS`].
    ///
    /// # Panics
    /// If either cell is outside the grid.
    pub fn solve(&mut self, start: u32, goal: u32, max_expansions: u64) -> Report<Octile> {
        self.begin();
        let [start, goal] = [start, goal].map(|cell| self.padded(cell));
        let target = [goal & ((1 << self.shift) - 1), goal >> self.shift];
        let mut counters = Counters { opened: 1, peak_open: 1, ..Counters::default() };
        let mut query = Query {
            masks: &self.masks,
            values: &mut self.values,
            open: &mut self.open,
            base: self.base,
            longest: self.longest,
            shift: self.shift,
            steps: self.steps,
            target,
        };
        query.values[start as usize] = self.base;
        query.offer(start, self.base);
        let outcome = loop {
            let Some((_, (node, value))) = query.open.pop() else { break Outcome::NoPath };
            if query.values[node as usize] != value {
                continue;
            }
            if node == goal {
                break Outcome::Solved(self.route(start, goal));
            }
            if counters.expansions >= max_expansions {
                break Outcome::BudgetSpent;
            }
            query.expand(node, value, &mut counters);
        };
        counters.closed = counters.expansions;
        Report { outcome, counters }
    }

    /// Puts the base so low that every value left behind is above every g of the coming query.
    fn begin(&mut self) {
        self.open.clear();
        self.base = self.base.checked_sub(self.longest + 1).unwrap_or_else(|| {
            self.values.fill(u32::MAX);
            u32::MAX - self.longest - 1
        });
    }

    /// Walks back from the goal over cells whose g is less by just the cost of the move.
    fn route(&self, start: u32, goal: u32) -> Route<Octile> {
        let mut at = goal;
        let mut nodes = vec![self.cell(goal)];
        let mut cost = Octile::ZERO;
        while at != start {
            let (before, step) = (0..8)
                .filter(|bit| self.masks[at as usize] >> bit & 1 == 1)
                .map(|bit| (at.wrapping_add_signed(self.steps[bit]), COSTS[bit]))
                .find(|&(from, step)| {
                    self.values[from as usize].checked_add(step) == Some(self.values[at as usize])
                })
                .expect("a cell that was reached was reached from a neighbour");
            cost =
                cost.plus(if step == ScaledOctile::STRAIGHT { Octile::STRAIGHT } else { Octile::DIAGONAL });
            at = before;
            nodes.push(self.cell(at));
        }
        nodes.reverse();
        Route { nodes, cost }
    }
}

/// What one query touches, lent as slices: so the compiler knows that writing to one leaves the others in place.
struct Query<'a> {
    masks: &'a [u8],
    values: &'a mut [u32],
    open: &'a mut Buckets<(u32, u32)>,
    base: u32,
    longest: u32,
    shift: u32,
    steps: [i32; 8],
    target: [u32; 2],
}

impl Query<'_> {
    #[inline]
    fn expand(&mut self, node: u32, value: u32, counters: &mut Counters) {
        let mask = self.masks[node as usize];
        counters.expansions += 1;
        counters.generated += u64::from(mask.count_ones());
        // A loop of fixed length unrolls; walking the set bits is slower by a fifth on open maps.
        for (bit, (step, cost)) in self.steps.into_iter().zip(COSTS).enumerate() {
            let to = node.wrapping_add_signed(step);
            let reached = value + cost;
            let known = self.values[to as usize];
            if reached < bound(mask, bit, known) {
                counters.opened += u64::from(known - self.base > self.longest);
                self.values[to as usize] = reached;
                self.offer(to, reached);
            }
        }
        counters.peak_open = counters.peak_open.max(counters.opened - counters.expansions);
    }

    #[inline]
    fn offer(&mut self, node: u32, value: u32) {
        let [x, y] = [node & ((1 << self.shift) - 1), node >> self.shift];
        let h = ScaledOctile::distance([x.abs_diff(self.target[0]), y.abs_diff(self.target[1])]);
        self.open.push(u64::from(value - self.base + h), (node, value));
    }
}

/// What a way must stay below to be taken by move `bit` of `mask`: `known`, or 0 if the move is forbidden.
///
/// Whether a move is legal and whether it improves is each a coin toss on a crowded map; this leaves one branch of two.
#[inline]
fn bound(mask: u8, bit: usize, known: u32) -> u32 {
    known & 0_u32.wrapping_sub(u32::from(mask >> bit & 1))
}
