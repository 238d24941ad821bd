//! Angle-propagation Theta\*: lines of sight are answered from ranges of angles, which expanded vertices hand on.
//!
//! It searches as Theta\* between corners of cells. A vertex taken from OPEN learns within which angles its parent sees past it: not
//! beyond a blocked cell that touches it, and no further than neighbours on the way to it can tell. A range is kept as its two outermost
//! directions from the parent, in whole numbers, so that angles are compared exactly. Ranges are never too wide; they are too narrow now
//! and then, so that some lines of sight are missed.
//!
//! # Source
//! Daniel, Nash, Koenig & Felner, *Theta\*: Any-Angle Path Planning on Grids*, JAIR 39 (2010), section 6.

use super::Report;
use super::estimate::{Combined, euclidean_to, sum};
use super::frontier::Frontier;
use super::graph::{Graph as _, GridGraph, Lengths};
use super::observe::{Observer, Place};
use super::side::{Side, SideInputs, Update};
use base::grid::{Grid2, Moves};

/// Corners of cells, with the cells and the moves.
#[derive(Clone, Copy, Debug)]
pub struct Cornered<'a> {
    /// The cells.
    pub cells: &'a Grid2,
    /// Their corners.
    pub grid: &'a Grid2,
    /// The legal moves from corner to corner.
    pub moves: &'a Moves,
}

/// A search whose memory serves one query after another.
#[derive(Clone, Debug)]
pub struct AngleRanges<Q> {
    side: Side<f64, Q>,
    /// For every vertex that was expanded, the range of directions from its parent.
    ranges: Vec<[Bound; 2]>,
}

/// The lowest or the highest direction of a range, from the parent; none if there is no bound.
type Bound = Option<[i32; 2]>;

impl<Q: Frontier> AngleRanges<Q> {
    /// A search that takes open nodes in the order of `frontier`.
    pub fn new(frontier: Q) -> Self {
        Self { side: Side::new(frontier), ranges: Vec::new() }
    }

    /// A path from the first to the second of `ends`; the search ends when the goal is taken from OPEN.
    pub fn solve(
        &mut self,
        on: &Cornered<'_>,
        ends: [u32; 2],
        max_expansions: u64,
        observer: &mut impl Observer,
    ) -> Report<f64> {
        let estimate = Combined { h: euclidean_to(on.grid, ends[1]), combine: sum };
        let mut graph = Lengths(GridGraph::new(on.moves));
        let update = Update::default();
        let mut terms = SideInputs { graph: &mut graph, estimate: &estimate, observer, update };
        let Self { side, ranges } = self;
        ranges.resize(on.grid.cell_count() as usize, [None; 2]);
        let outcome = side.run(ends, max_expansions, &mut terms, |side, node, terms| {
            let parent = side.parent(node);
            if let Some(parent) = parent {
                ranges[node as usize] = seen_past(side, ranges, on, [node, parent]);
            }
            let range = ranges[node as usize];
            let g = side.g(node).expect("it was opened");
            let from = parent.map(|parent| (parent, side.g(parent).expect("a parent was opened")));
            let choose = |_: &Side<f64, Q>, to: u32, cost: f64| match from {
                Some((parent, g_parent)) if is_within(range, apart(on.grid, parent, to)) => {
                    (parent, g_parent + euclidean_to(on.grid, parent)(to))
                }
                _ => (node, g + cost),
            };
            side.expand_by(node, terms, choose, |_, _| true);
        });
        Report { outcome, counters: side.counters }
    }
}

/// Within which directions `parent` sees past `node`.
fn seen_past<Q: Frontier>(
    side: &Side<f64, Q>,
    ranges: &[[Bound; 2]],
    on: &Cornered<'_>,
    [node, parent]: [u32; 2],
) -> [Bound; 2] {
    let own = apart(on.grid, parent, node);
    let mut range = [None, None];
    let [x, y] = on.grid.xy(node);
    for cell in [[x, y], [x - 1, y], [x, y - 1], [x - 1, y - 1]] {
        if on.cells.is_free_xy(cell[0], cell[1]) {
            continue;
        }
        let [at_x, at_y] = on.grid.xy(parent);
        let corners =
            [[0, 0], [1, 0], [0, 1], [1, 1]].map(|[dx, dy]| [cell[0] + dx - at_x, cell[1] + dy - at_y]);
        let is_behind = |corner: &[i32; 2]| turn(own, *corner) == 0 && square(*corner) <= square(own);
        let all_on =
            |sign: i64| corners.iter().all(|corner| turn(own, *corner) * sign > 0 || is_behind(corner));
        narrow(&mut range, own, [all_on(-1), all_on(1)]);
    }
    Lengths(GridGraph::new(on.moves)).successors(node, |near, _| {
        let shares = side.place(near) == Place::Closed && side.parent(near) == Some(parent);
        let way = apart(on.grid, parent, near);
        if shares {
            let [low, high] = ranges[near as usize];
            let [low, high] =
                [low.filter(|low| turn(own, *low) <= 0), high.filter(|high| turn(own, *high) >= 0)];
            narrow(&mut range, low.unwrap_or(own), [low.is_some(), false]);
            narrow(&mut range, high.unwrap_or(own), [false, high.is_some()]);
        } else if near != parent && square(way) < square(own) {
            let turn = turn(own, way);
            narrow(&mut range, way, [turn < 0, turn > 0]);
        }
    });
    range
}

/// Lifts the lowest and lowers the highest direction of a range to `bound`, where `which` says so and it is not within already.
fn narrow(range: &mut [Bound; 2], bound: [i32; 2], which: [bool; 2]) {
    for (end, sign) in [(0, 1), (1, -1)] {
        let is_tighter = range[end].is_none_or(|known| turn(known, bound) * sign > 0);
        if which[end] && is_tighter {
            range[end] = Some(bound);
        }
    }
}

fn is_within([low, high]: [Bound; 2], way: [i32; 2]) -> bool {
    low.is_none_or(|low| turn(low, way) >= 0) && high.is_none_or(|high| turn(high, way) <= 0)
}

/// From the first to the second vertex, in columns and rows.
fn apart(grid: &Grid2, from: u32, to: u32) -> [i32; 2] {
    let [from, to] = [from, to].map(|at| grid.xy(at));
    [to[0] - from[0], to[1] - from[1]]
}

/// Positive if `to` is counter-clockwise of `from`, 0 if they are one direction, for directions less than half a turn apart.
fn turn(from: [i32; 2], to: [i32; 2]) -> i64 {
    i64::from(from[0]) * i64::from(to[1]) - i64::from(from[1]) * i64::from(to[0])
}

fn square([dx, dy]: [i32; 2]) -> i64 {
    i64::from(dx) * i64::from(dx) + i64::from(dy) * i64::from(dy)
}
