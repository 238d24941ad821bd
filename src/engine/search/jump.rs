//! A* over jump points, on 8-connected grids with the octile distance.
//!
//! Nodes are the start, the goal and jump points. From a node the search runs in every direction that the pruning rules leave
//! ([`Pruning`](world::space::Pruning)). A straight run goes to the first jump point. A diagonal one goes to the wall, with both
//! straight runs from every cell on the way. Their jump points are successors of the node itself, and the cell on the diagonal is
//! never a node (intermediate pruning). Where a corner may be cut, the diagonal run ends at a jump point of its own. A run that
//! meets the goal ends there. One search serves both ways to follow runs, [`JumpLines`] (bits of rows and columns, scanned) and
//! [`JumpTable`] (distances, looked up): they give the same report.
//!
//! A node that is reached again at equal cost goes on in the directions of both ways, even if it was expanded. Pruning keeps one
//! of several ways of equal cost, and which one it keeps depends on the direction in which a node was entered.
//!
//! # Counters
//! Only nodes count. **Generated** is every jump point or goal that a run ends at, known or not; cells that are passed or
//! scanned are no successors. **Opened** and **closed** are distinct nodes. An **expansion** takes one node from OPEN and
//! follows all runs from it; a node whose directions are completed later at equal cost is expanded once more, in those
//! directions. [`Counters`] of this search are therefore no measure against those of one that goes from cell to cell.
//!
//! # Ties
//! Costs are ordered in units of 985 and 1393, as in [`OctileAstar`](super::OctileAstar) and with its limits. Of equal f
//! the node offered last is expanded first; a node keeps the parent that offered its cost first. Runs are followed in the
//! order of [`DIRECTIONS`], on a diagonal from near to far and sideways before upwards. A path goes from node to node
//! with its diagonal moves first.
//!
//! # Source
//! Harabor & Grastien, *Online graph pruning for pathfinding on grid maps*, AAAI 2011; *Improving jump point search*,
//! ICAPS 2014: block-based scanning, preprocessing, and pruning of intermediate nodes.
//!
//! [`JumpLines`]: world::space::JumpLines
//! [`JumpTable`]: world::space::JumpTable

use super::cost::Octile;
use super::estimate::ScaledOctile;
use super::octile::{MAX_CELLS, SearchError};
use super::radix::RadixHeap;
use super::{Counters, Outcome, Report, Route};
use base::grid::DIRECTIONS;
use world::space::Jumps;

/// A cell as [column, row].
type Place = [u32; 2];

/// What is known of a cell; it counts only if `query` is the number of the query at work.
#[derive(Clone, Copy, Debug, Default)]
struct Record {
    query: u32,
    g: u32,
    parent: u32,
    /// Directions to run in when the node is expanded; 0 if it is not open.
    todo: u8,
    /// Directions in which runs were followed.
    done: u8,
}

/// An open node.
#[derive(Clone, Copy, Debug)]
struct Open {
    node: u32,
    g: u32,
}

/// The memory of a search by jump points, for grids of one size and any number of queries.
#[derive(Clone, Debug)]
pub struct JumpSearch {
    size: [u32; 2],
    records: Vec<Record>,
    query: u32,
    open: RadixHeap<Open>,
}

impl JumpSearch {
    /// A search on grids of `size` = [width, height].
    ///
    /// # Errors
    /// [`SearchError::GridTooLarge`] if (width + 1) · (height + 1) is above 3 083 250.
    pub fn new(size: [u32; 2]) -> Result<Self, SearchError> {
        let [width, height] = size;
        // The longest path and the farthest goal together must have a 32-bit cost.
        let padded = (width as usize + 1) * (height as usize + 1);
        if padded > MAX_CELLS {
            return Err(SearchError::GridTooLarge { width, height, padded });
        }
        let records = vec![Record::default(); width as usize * height as usize];
        Ok(Self { size, records, query: 0, open: RadixHeap::default() })
    }

    /// The size of the grids that it is for.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// A shortest path from `start` to `goal`, cell by cell; the search ends when the goal is taken from OPEN.
    ///
    /// # Panics
    /// If the grid of `jumps` is of another size, or either cell is outside it.
    pub fn solve<J: Jumps>(
        &mut self,
        jumps: &J,
        start: u32,
        goal: u32,
        max_expansions: u64,
    ) -> Report<Octile> {
        let [width, height] = self.size;
        let moves = jumps.moves();
        assert_eq!(
            [moves.width(), moves.cell_count()],
            [width, width * height],
            "width and cells of the grid"
        );
        self.begin();
        let mut query = Query {
            jumps,
            records: &mut self.records,
            open: &mut self.open,
            number: self.query,
            width,
            goal,
            target: [goal % width, goal / width],
            counters: Counters::default(),
            in_open: 0,
        };
        let outcome = query.run(start, max_expansions);
        Report { outcome, counters: query.counters }
    }

    /// Makes every record one of an earlier query.
    fn begin(&mut self) {
        self.open.clear();
        self.query = self.query.checked_add(1).unwrap_or_else(|| {
            self.records.fill(Record::default());
            1
        });
    }
}

/// A node from which runs are followed.
#[derive(Clone, Copy)]
struct From {
    node: u32,
    g: u32,
}

/// What one query touches.
struct Query<'a, J> {
    jumps: &'a J,
    records: &'a mut [Record],
    open: &'a mut RadixHeap<Open>,
    number: u32,
    width: u32,
    goal: u32,
    target: Place,
    counters: Counters,
    in_open: u64,
}

impl<J: Jumps> Query<'_, J> {
    fn run(&mut self, start: u32, max_expansions: u64) -> Outcome<Octile> {
        let todo = self.jumps.moves().mask(start);
        self.records[start as usize] = Record { query: self.number, g: 0, parent: start, todo, done: 0 };
        self.counters.opened = 1;
        self.push(start, self.place(start), 0);
        loop {
            let Some((_, Open { node, g })) = self.open.pop() else { return Outcome::NoPath };
            let Record { g: best, todo, .. } = self.records[node as usize];
            if node == self.goal {
                return Outcome::Solved(self.route(start));
            }
            // An offer that a better one has overtaken, or one more of those at the same cost.
            if g != best || todo == 0 && node != start {
                continue;
            }
            if self.counters.expansions >= max_expansions {
                return Outcome::BudgetSpent;
            }
            self.expand(From { node, g });
        }
    }

    fn place(&self, cell: u32) -> Place {
        [cell % self.width, cell / self.width]
    }

    fn push(&mut self, node: u32, [x, y]: Place, g: u32) {
        let h = ScaledOctile::distance([x.abs_diff(self.target[0]), y.abs_diff(self.target[1])]);
        self.open.push(g + h, Open { node, g });
        self.in_open += 1;
        self.counters.peak_open = self.counters.peak_open.max(self.in_open);
    }

    fn expand(&mut self, from: From) {
        let record = &mut self.records[from.node as usize];
        let todo = std::mem::take(&mut record.todo);
        record.done |= todo;
        self.in_open -= 1;
        self.counters.expansions += 1;
        self.counters.closed += 1;
        let at = self.place(from.node);
        let is_left = |direction: u8| todo >> direction & 1 == 1;
        // In the order of DIRECTIONS; a diagonal run with its two parts.
        if is_left(0) {
            self.diagonal::<0, 1, 3>(from, at);
        }
        if is_left(1) {
            self.straight::<1>(from, at, from.g);
        }
        if is_left(2) {
            self.diagonal::<2, 1, 4>(from, at);
        }
        if is_left(3) {
            self.straight::<3>(from, at, from.g);
        }
        if is_left(4) {
            self.straight::<4>(from, at, from.g);
        }
        if is_left(5) {
            self.diagonal::<5, 6, 3>(from, at);
        }
        if is_left(6) {
            self.straight::<6>(from, at, from.g);
        }
        if is_left(7) {
            self.diagonal::<7, 6, 4>(from, at);
        }
    }

    /// Follows the straight run from the cell at `at`, which a way of cost `g` reaches from the node `from`.
    #[inline]
    fn straight<const DIRECTION: usize>(&mut self, from: From, at: Place, g: u32) {
        let (length, is_jump) = self.jumps.ahead::<DIRECTION>(at);
        let to_goal = self.straight_to_goal::<DIRECTION>(at);
        if to_goal <= length || is_jump {
            let length = length.min(to_goal);
            let g = g + length * ScaledOctile::STRAIGHT;
            self.offer::<DIRECTION>(from, moved::<DIRECTION>(at, length), g);
        }
    }

    /// How far the goal lies ahead of the cell at `at`, which is not the goal; more than any run's length if it does not.
    #[inline]
    fn straight_to_goal<const DIRECTION: usize>(&self, at: Place) -> u32 {
        let axis = usize::from(DIRECTIONS[DIRECTION][0] == 0);
        if at[1 - axis] != self.target[1 - axis] {
            return u32::MAX;
        }
        // What lies behind becomes a number beyond any side.
        if DIRECTIONS[DIRECTION][axis] > 0 {
            self.target[axis].wrapping_sub(at[axis])
        } else {
            at[axis].wrapping_sub(self.target[axis])
        }
    }

    /// How many diagonal moves of `step` lead from `at` to the goal or to the row or column from which it lies straight
    /// ahead; 0 if they lead away.
    #[inline]
    fn to_corner(&self, step: [i32; 2], at: Place) -> u32 {
        let aside = [0, 1].map(|axis| (self.target[axis] as i32 - at[axis] as i32) * step[axis]);
        aside[0].min(aside[1]).max(0) as u32
    }

    /// Follows the diagonal run from `from` and, from every cell on it, those in its two parts.
    #[inline]
    fn diagonal<const DIRECTION: usize, const SIDEWAYS: usize, const UPWARDS: usize>(
        &mut self,
        from: From,
        start: Place,
    ) {
        let [dx, dy] = DIRECTIONS[DIRECTION];
        let step = dy * self.width as i32 + dx;
        let to_corner = self.to_corner([dx, dy], start);
        let mut cell = from.node;
        let mut length = 0;
        loop {
            let wanted = if length < to_corner { to_corner - length } else { u32::MAX };
            let hop = self.jumps.hop::<DIRECTION>(cell, wanted);
            if hop == 0 {
                return;
            }
            length += hop;
            cell = cell.wrapping_add_signed(step * hop as i32);
            let at = moved::<DIRECTION>(start, length);
            let g = from.g + length * ScaledOctile::DIAGONAL;
            let turns = self.jumps.pruning().turns(self.jumps.moves().mask(cell));
            if turns >> DIRECTION & 1 == 1 || cell == self.goal {
                self.offer::<DIRECTION>(from, at, g);
                return;
            }
            self.straight::<SIDEWAYS>(from, at, g);
            self.straight::<UPWARDS>(from, at, g);
        }
    }

    /// Offers the node at `at`, entered in `DIRECTION` at cost `g` from the node `from`.
    #[inline]
    fn offer<const DIRECTION: usize>(&mut self, from: From, at: Place, g: u32) {
        self.counters.generated += 1;
        let node = at[1] * self.width + at[0];
        let known = self.records[node as usize];
        let is_new = known.query != self.number;
        if !is_new && known.g < g {
            return;
        }
        let onward = self.jumps.pruning().onward(DIRECTION, self.jumps.moves().mask(node));
        let record = &mut self.records[node as usize];
        if is_new || g < known.g {
            *record = Record { query: self.number, g, parent: from.node, todo: onward, done: 0 };
            self.counters.opened += u64::from(is_new);
            // It is open: an estimate that is consistent reaches no closed node at less cost.
            self.in_open -= u64::from(!is_new);
            self.push(node, at, g);
            return;
        }
        let added = onward & !(known.todo | known.done);
        record.todo |= added;
        if added != 0 && known.todo == 0 && node != self.goal {
            self.counters.closed -= 1;
            self.push(node, at, g);
        }
    }

    /// The path to the goal: from node to node, diagonal moves first.
    fn route(&self, start: u32) -> Route<Octile> {
        let mut node = self.goal;
        let mut nodes = vec![self.goal];
        let mut cost = Octile::default();
        while node != start {
            let parent = self.records[node as usize].parent;
            let [x, y] = self.place(node);
            let [from_x, from_y] = self.place(parent);
            let (dx, dy) = (from_x as i32 - x as i32, from_y as i32 - y as i32);
            let [diagonal, straight] = [dx.abs().min(dy.abs()), (dx.abs() - dy.abs()).abs()];
            cost.diagonal += diagonal as u32;
            cost.straight += straight as u32;
            let row = dy.signum() * self.width as i32;
            let along = if dx.abs() > dy.abs() { dx.signum() } else { row };
            let steps = [(along, straight), (dx.signum() + row, diagonal)];
            for step in steps.into_iter().flat_map(|(step, count)| (0..count).map(move |_| step)) {
                node = node.wrapping_add_signed(step);
                nodes.push(node);
            }
        }
        nodes.reverse();
        Route { nodes, cost }
    }
}

/// The place `length` moves in `DIRECTION` from `[x, y]`.
#[inline]
fn moved<const DIRECTION: usize>([x, y]: Place, length: u32) -> Place {
    let [dx, dy] = DIRECTIONS[DIRECTION];
    [x.wrapping_add_signed(dx * length as i32), y.wrapping_add_signed(dy * length as i32)]
}
