//! The shortest polyline through cell centres that turns by a given sum of angles.
//!
//! Premises of the bound: the path is a polyline whose corners and ends are cell centres of the grid, its
//! length is Euclidean in cells, and its turn sum follows the stated convention. Obstacles are left out, so
//! the polylines of every map are among those searched and the bound holds on every map.
//!
//! The search is best-first over labels (cell, direction of arrival, turn so far); two labels alike in all
//! three differ only in length, so the shorter one serves, unless a least length is asked for too: then
//! labels of different length are kept. Its estimate is the least length on which the missing turn, or more,
//! can still be had ([`reserve`]). Cells outside the ellipse `|start cell| + |cell goal| ≤ longest` cannot
//! serve. Turns and lengths are told apart to 1e-7, and both windows are widened by 1e-5 on either side in
//! return: widening can only admit more polylines, so what is not found does not exist.

use std::{cmp::Reverse, collections::BinaryHeap};

use super::{Cell, distance};
use crate::analysis::interval::Interval;

mod net;
pub mod octile;
mod reserve;

#[cfg(test)]
mod tests;

use net::Net;
use reserve::Reserve;

/// How a bend counts towards a turn sum.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Convention {
    /// By the change of direction: 0° straight on, 180° for a reversal.
    Exterior,
    /// By the angle between the two segments: 180° less the change of direction. Where the direction does not
    /// change there is no bend.
    Interior,
}

impl Convention {
    /// What a bend that changes the direction by `change_deg` adds.
    pub fn bend_deg(self, change_deg: f64) -> f64 {
        match self {
            Self::Exterior => change_deg,
            Self::Interior => 180.0 - change_deg,
        }
    }
}

/// Which polylines are asked for.
#[derive(Debug, Clone, PartialEq)]
pub struct TurnQuery {
    /// Columns and rows; cells run from `[0, 0]`.
    pub size: [i32; 2],
    /// Cells it may start from.
    pub starts: Vec<Cell>,
    /// Cells it may end at.
    pub goals: Vec<Cell>,
    /// How bends count.
    pub convention: Convention,
    /// The turn sum wanted, degrees; `high` may be infinite.
    pub turn_deg: Interval,
    /// The length wanted, cells; `low` may be 0, which is much faster. The greater `high`, the longer the
    /// search: two cells above the straight line take tenths of a second.
    pub length: Interval,
}

/// A polyline through cell centres.
#[derive(Debug, Clone, PartialEq)]
pub struct Polyline {
    /// Start, corners and goal.
    pub cells: Vec<Cell>,
    /// Length, cells.
    pub length: f64,
    /// Turn sum in the convention asked for, degrees.
    pub turn_deg: f64,
}

/// A way to a cell. `parent` leads back to the start; there is none for the first segment.
struct Label {
    cell: usize,
    direction: usize,
    length: f64,
    turn_deg: f64,
    parent: Option<usize>,
    from: usize,
}

/// The shortest polyline that `query` describes, of one segment at least; none if there is none.
///
/// Its length is a lower bound on the length of any path with that turn sum on any map, under the module's
/// premises. It may pass a goal or a cell twice. None means that no path on any map has a length and a turn
/// sum in the two windows.
pub fn shortest_polyline(query: &TurnQuery) -> Option<Polyline> {
    let net = Net::new(query);
    let reserve = Reserve::new(&net, query.turn_deg.low - SLACK);
    let mut search =
        Search { net: &net, reserve: &reserve, query, labels: Vec::new(), queue: BinaryHeap::new() };
    for &start in net.starts() {
        search.extend(start, None);
    }
    let mut settled: Vec<Vec<(i64, i64)>> = vec![Vec::new(); net.len() * net.directions()];
    while let Some(Reverse((_, id))) = search.queue.pop() {
        let label = &search.labels[id];
        let known = &mut settled[label.cell * net.directions() + label.direction];
        let Err(place) = known.binary_search(&search.key(label)) else { continue };
        known.insert(place, search.key(label));
        if search.is_answer(label) {
            return Some(search.polyline(id));
        }
        search.extend(label.cell, Some(id));
    }
    None
}

/// Turn sum of a polyline, degrees. Corners at which the direction does not change are no bends.
pub fn turn_sum_deg(cells: &[Cell], convention: Convention) -> f64 {
    let bends = cells.windows(3).map(|w| change_deg(difference(w[0], w[1]), difference(w[1], w[2])));
    bends.filter(|&change| change > 0.0).map(|change| convention.bend_deg(change)).sum()
}

/// By how much both windows are widened, degrees and cells.
const SLACK: f64 = 1e-5;

struct Search<'a> {
    net: &'a Net,
    reserve: &'a Reserve,
    query: &'a TurnQuery,
    labels: Vec<Label>,
    /// Least estimate first (as the bits of a non-negative float), then the older label.
    queue: BinaryHeap<Reverse<(u64, usize)>>,
}

impl Search<'_> {
    /// What two labels at one cell and direction must share for one of them to be superfluous.
    fn key(&self, label: &Label) -> (i64, i64) {
        let told_apart = |quantity: f64| (quantity * 1e7).round() as i64;
        let length = if self.query.length.low > 0.0 { told_apart(label.length) } else { 0 };
        (told_apart(label.turn_deg), length)
    }

    fn is_answer(&self, label: &Label) -> bool {
        let (turn_deg, length) = (self.query.turn_deg, self.query.length);
        self.net.is_goal(label.cell)
            && label.turn_deg >= turn_deg.low - SLACK
            && label.length >= length.low - SLACK
    }

    /// Queues every segment that leaves `cell` with a bend, or every one if there is no label to bend from.
    fn extend(&mut self, cell: usize, parent: Option<usize>) {
        let (length, turn_deg, arrival) = parent.map_or((0.0, 0.0, None), |id| {
            let label = &self.labels[id];
            (label.length, label.turn_deg, Some(label.direction))
        });
        let (longest, most_deg) = (self.query.length.high + SLACK, self.query.turn_deg.high + SLACK);
        for segment in self.net.segments(cell) {
            if length + segment.least_total > longest {
                break;
            }
            if arrival == Some(segment.direction) {
                continue;
            }
            let bend_deg = arrival.map_or(0.0, |arrival| self.net.bend_deg(arrival, segment.direction));
            let (length, turn_deg) = (length + segment.length, turn_deg + bend_deg);
            let (cell, direction, from) = (segment.to, segment.direction, cell);
            let least_total = length + self.reserve.least_length(cell, direction, turn_deg);
            if least_total <= longest && turn_deg + self.net.least_turn_deg(cell, direction) <= most_deg {
                self.queue.push(Reverse((least_total.to_bits(), self.labels.len())));
                self.labels.push(Label { cell, direction, length, turn_deg, parent, from });
            }
        }
    }

    fn polyline(&self, id: usize) -> Polyline {
        let mut cells = vec![self.net.cell(self.labels[id].cell)];
        let mut next = Some(id);
        while let Some(id) = next {
            cells.push(self.net.cell(self.labels[id].from));
            next = self.labels[id].parent;
        }
        cells.reverse();
        let length = cells.windows(2).map(|w| distance(w[0], w[1])).sum();
        let turn_deg = turn_sum_deg(&cells, self.query.convention);
        Polyline { cells, length, turn_deg }
    }
}

fn difference(from: Cell, to: Cell) -> Cell {
    [to[0] - from[0], to[1] - from[1]]
}

/// The angle between two vectors, degrees in [0, 180]; exactly 0 where they point the same way.
fn change_deg(u: Cell, v: Cell) -> f64 {
    let cross = f64::from(u[0] * v[1] - u[1] * v[0]).abs();
    let dot = f64::from(u[0] * v[0] + u[1] * v[1]);
    libm::atan2(cross, dot).to_degrees()
}
