//! The shortest polyline through cell centres that turns by a given sum of angles.
//!
//! Premises of the bound: the path is a polyline whose corners and ends are cell centres of the grid, its length is
//! Euclidean in cells, and its turn sum follows the stated convention. Obstacles are left out, so the polylines of
//! every map are among those searched and the bound holds on every map.
//!
//! A polyline is put together from two halves, one from a start and one from a goal, that meet in the bend between
//! them. Each has at most half of the greatest turn. A half is found best-first over labels: cell, direction of
//! arrival, turn so far. Two labels alike in all three differ only in length, and the shorter one serves. If a least
//! length is requested too, labels of different length are kept. The estimate is the least length on which the missing
//! turn, or more, can still be had. Cells outside the ellipse `|start cell| + |cell goal| ≤ longest` cannot serve.
//! Turns and lengths are distinguished to 1e-7. Both windows are widened by 1e-5 on either side, which can only admit
//! more polylines: what is not found does not exist.

use serde::{Deserialize, Serialize};
use stats::interval::Interval;

mod half;
mod net;
mod reserve;

#[cfg(test)]
mod tests;

use half::{Half, Label};

/// A lattice cell `[x, y]`.
pub type Cell = [i32; 2];

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

/// Which polylines are requested.
#[derive(Debug, Clone, PartialEq)]
pub struct TurnQuery {
    /// Columns and rows; cells run from `[0, 0]`.
    pub size: [i32; 2],
    /// Cells it may start from.
    pub starts: Vec<Cell>,
    /// Cells it may end at.
    pub goals: Vec<Cell>,
    /// Headings, as steps to neighbours: the first segment turns from any of these, and from nothing if there are none.
    pub headings: Vec<Cell>,
    /// How bends count.
    pub convention: Convention,
    /// The turn sum wanted, degrees; `high` may be infinite.
    pub turn_deg: Interval,
    /// The length wanted, cells; `high` is finite. With a `low` above 0 much more has to be kept. Work grows
    /// about threefold for each half cell of the answer (or of `high`, if there is none) above the straight
    /// line.
    pub length: Interval,
}

/// The text of this module, so that an answer that is kept is distinct from one that other code would give.
pub const SOURCE: [&str; 4] = [
    include_str!("turns.rs"),
    include_str!("turns/half.rs"),
    include_str!("turns/net.rs"),
    include_str!("turns/reserve.rs"),
];

/// A polyline through cell centres.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Polyline {
    /// Start, corners and goal.
    pub cells: Vec<Cell>,
    /// Length, cells.
    pub length: f64,
    /// Turn sum in the requested convention, degrees.
    pub turn_deg: f64,
}

/// The shortest polyline that `query` describes, of one segment at least; none if there is none.
///
/// Its length is a lower bound on the length of any path with that turn sum on any map, under the module's
/// premises. It may pass a goal or a cell twice. None means that no path on any map has a length and a turn
/// sum in the two windows.
///
/// # Panics
/// If `length.high` is infinite.
pub fn shortest_polyline(query: &TurnQuery) -> Option<Polyline> {
    assert!(query.length.high.is_finite(), "a polyline of any length");
    let straight = straight_line_between(&query.starts, &query.goals)?;
    // Looking a little further each time costs less than looking once much too far.
    let first = if query.length.low > 0.0 { query.length.high } else { straight + STRIDE };
    let strides = (0..).map(|stride| first + STRIDE * f64::from(stride));
    for longest in strides {
        let length = Interval { high: longest.min(query.length.high), ..query.length };
        let found = shortest_within(&TurnQuery { length, ..query.clone() });
        if found.is_some() || longest >= query.length.high {
            return found;
        }
    }
    None
}

/// The shortest straight line from any of `starts` to any of `goals`, in cells; none if either is empty.
pub fn straight_line_between(starts: &[Cell], goals: &[Cell]) -> Option<f64> {
    let pairs = starts.iter().flat_map(|&start| goals.iter().map(move |&goal| distance(start, goal)));
    pairs.min_by(f64::total_cmp)
}

/// Distance between two cell centres.
pub fn distance(a: Cell, b: Cell) -> f64 {
    let (dx, dy) = (f64::from(a[0] - b[0]), f64::from(a[1] - b[1]));
    (dx * dx + dy * dy).sqrt()
}

/// How much further each search looks, cells.
const STRIDE: f64 = 0.5;

fn shortest_within(query: &TurnQuery) -> Option<Polyline> {
    let forward = Half::new(query, &[]);
    let mut best = forward.arrival().map(|label| (label.length, forward.chain(label)));
    if query.turn_deg.high.is_finite() {
        let (starts, goals) = (query.goals.clone(), query.starts.clone());
        let reverse = TurnQuery { starts, goals, headings: Vec::new(), ..query.clone() };
        let onward: Vec<Cell> = query.headings.iter().map(|heading| heading.map(|step| -step)).collect();
        let backward = Half::new(&reverse, &onward);
        for (towards, from) in meetings(query, &forward, &backward) {
            let length = towards.length + from.length;
            if best.as_ref().is_none_or(|(least, _)| length < *least) {
                let mut cells = forward.chain(towards);
                cells.extend(backward.chain(from).into_iter().rev().skip(1));
                best = Some((length, cells));
            }
        }
    }
    best.map(|(_, cells)| {
        let length = cells.windows(2).map(|w| distance(w[0], w[1])).sum();
        let turn_deg = turn_from_headings_deg(query, &cells);
        Polyline { cells, length, turn_deg }
    })
}

/// The turn sum of an answer, from the heading that lets it answer.
fn turn_from_headings_deg(query: &TurnQuery, cells: &[Cell]) -> f64 {
    let from = |heading: &Cell| {
        let before = difference(*heading, cells[0]);
        let with_heading: Vec<Cell> = [before].iter().chain(cells).copied().collect();
        turn_sum_deg(&with_heading, query.convention)
    };
    let Interval { low, high } = query.turn_deg;
    let beyond = |turn_deg: &f64| (low - turn_deg).max(turn_deg - high).max(0.0);
    let sums = query.headings.iter().map(from);
    let nearest = sums.min_by(|a, b| beyond(a).total_cmp(&beyond(b)));
    nearest.unwrap_or_else(|| turn_sum_deg(cells, query.convention))
}

/// Every pair of halves that meet in one cell, bend there, and together have the requested length and turn.
fn meetings<'a>(query: &TurnQuery, forward: &'a Half, backward: &'a Half) -> Vec<(&'a Label, &'a Label)> {
    let mut pairs = Vec::new();
    for (cell, direction) in forward.states() {
        let towards = forward.labels(cell, direction);
        let ahead = forward.net().vector(direction);
        for back in (0..backward.net().directions()).filter(|_| !towards.is_empty()) {
            let onwards = backward.net().vector(back).map(|component| -component);
            let from = backward.labels(cell, back);
            if !from.is_empty() && onwards != ahead {
                let bend_deg = query.convention.bend_deg(change_deg(ahead, onwards));
                pair_up(query, bend_deg, towards, from, &mut pairs);
            }
        }
    }
    pairs
}

/// Adds the pairs of two lists, each by rising turn, that have the requested length and turn.
fn pair_up<'a>(
    query: &TurnQuery,
    bend_deg: f64,
    towards: &'a [Label],
    from: &'a [Label],
    pairs: &mut Vec<(&'a Label, &'a Label)>,
) {
    let (low, high) = (query.turn_deg.low - SLACK - bend_deg, query.turn_deg.high + SLACK - bend_deg);
    let mut end = from.len();
    for first in towards {
        while end > 0 && first.turn_deg + from[end - 1].turn_deg > high {
            end -= 1;
        }
        let enough = from[..end].iter().rev().take_while(|second| first.turn_deg + second.turn_deg >= low);
        pairs.extend(enough.map(|second| (first, second)).filter(|(a, b)| fits(query, a.length + b.length)));
    }
}

fn fits(query: &TurnQuery, length: f64) -> bool {
    query.length.low - SLACK <= length && length <= query.length.high + SLACK
}

/// Turn sum of a polyline, degrees. Corners at which the direction does not change are no bends.
pub fn turn_sum_deg(cells: &[Cell], convention: Convention) -> f64 {
    let bends = cells.windows(3).map(|w| change_deg(difference(w[0], w[1]), difference(w[1], w[2])));
    bends.filter(|&change| change > 0.0).map(|change| convention.bend_deg(change)).sum()
}

/// By how much both windows are widened, degrees and cells.
const SLACK: f64 = 1e-5;

fn difference(from: Cell, to: Cell) -> Cell {
    [to[0] - from[0], to[1] - from[1]]
}

/// The angle between two vectors, degrees in [0, 180]; exactly 0 where they point the same way.
fn change_deg(u: Cell, v: Cell) -> f64 {
    let cross = f64::from(u[0] * v[1] - u[1] * v[0]).abs();
    let dot = f64::from(u[0] * v[0] + u[1] * v[1]);
    libm::atan2(cross, dot).to_degrees()
}
