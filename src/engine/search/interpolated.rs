//! Field D\* between corners of cells, searched once: costs are interpolated along edges, over which paths may lead anywhere.
//!
//! A vertex expanded offers each neighbour ways over the two edges of that neighbour's surroundings that it ends. The cost of a
//! point on an edge is interpolated between its ends as far as they are known ([`FieldRules`]). Blocked cells are not crossed; costs
//! are lengths. The path is extracted from the goal to the start. From where it is, it goes to that point on the edges of a free cell
//! about it from which the rest seems shortest, looked at one step ahead unless the rules leave that out. The cost must fall on the way.
//!
//! # Source
//! Ferguson & Stentz, *Using Interpolation to Improve Path Planning: The Field D\* Algorithm*, JFR 23 (2006); as a search from start to goal:
//! Daniel, Nash, Koenig & Felner, *Theta\*: Any-Angle Path Planning on Grids*, JAIR 39 (2010), section 4.

use super::angle_ranges::Cornered;
use super::estimate::{Combined, euclidean_to, sum};
use super::frontier::Frontier;
use super::graph::{GridGraph, Lengths};
use super::observe::{Observer, Place};
use super::side::{Side, SideInputs, Update};
use super::{Outcome, Report, Route};
use std::f64::consts::{FRAC_1_SQRT_2, SQRT_2};

/// What costs less than this less costs the same.
const SAME: f64 = 1e-9;

/// A point: column and row, between two corners on an edge or at a corner.
type Point = [f64; 2];

/// How a search ended, and the path.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// How it ended, and its counters; the nodes of its route are the ends.
    pub report: Report<f64>,
    /// The path from start to goal; empty if there is none.
    pub path: Vec<Point>,
}

/// What Field D\* leaves to whoever writes it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FieldRules {
    /// Costs are interpolated between expanded corners alone; otherwise between all that were opened.
    pub only_expanded: bool,
    /// A step of the extracted path is rated by the steps that follow it; otherwise by the interpolated cost where it ends.
    pub looks_ahead: bool,
}

/// A search whose memory serves one query after another.
#[derive(Clone, Debug)]
pub struct Interpolated<Q> {
    side: Side<f64, Q>,
    rules: FieldRules,
}

impl<Q: Frontier> Interpolated<Q> {
    /// A search that takes open nodes in the order of `frontier`.
    pub fn new(frontier: Q, rules: FieldRules) -> Self {
        Self { side: Side::new(frontier), rules }
    }

    /// A path from the first to the second of `ends`; the search ends when the goal is taken from OPEN.
    pub fn solve(
        &mut self,
        on: &Cornered<'_>,
        ends: [u32; 2],
        max_expansions: u64,
        observer: &mut impl Observer,
    ) -> Field {
        let estimate = Combined { h: euclidean_to(on.grid, ends[1]), combine: sum };
        let mut graph = Lengths(GridGraph::new(on.moves));
        let update = Update::default();
        let mut terms = SideInputs { graph: &mut graph, estimate: &estimate, observer, update };
        let only_expanded = self.rules.only_expanded;
        let mut outcome = self.side.run(ends, max_expansions, &mut terms, |side, node, terms| {
            let choose = |side: &Side<f64, Q>, to: u32, cost: f64| {
                (node, reached(side, on, [node, to], cost, only_expanded))
            };
            side.expand_by(node, terms, choose, |_, _| true);
        });
        let mut path = Vec::new();
        if let Outcome::Solved(route) = &mut outcome {
            path = self.extract(on, ends);
            let cost = path.windows(2).map(|two| apart(two[0], two[1])).sum();
            *route = Route { nodes: ends.to_vec(), cost };
        }
        Field { report: Report { outcome, counters: self.side.counters }, path }
    }

    fn extract(&self, on: &Cornered<'_>, [start, goal]: [u32; 2]) -> Vec<Point> {
        let place = |corner: u32| on.grid.xy(corner).map(f64::from);
        let first = place(start);
        let mut path = vec![place(goal)];
        let mut cost = self.cost(on, path[0]);
        while path[path.len() - 1] != first {
            let at = path[path.len() - 1];
            let ways = self.ways(on, at);
            let ahead = |to: Point| {
                let further = self.ways(on, to).into_iter().map(|(next, cost)| apart(to, next) + cost);
                if is_corner(to) { self.cost(on, to) } else { further.fold(f64::INFINITY, f64::min) }
            };
            let falls = ways.iter().filter(|(_, left)| *left < cost - SAME);
            let rest = |to: Point, left: f64| if self.rules.looks_ahead { ahead(to) } else { left };
            let rated = falls.map(|(to, left)| (apart(at, *to) + rest(*to, *left), *to, *left));
            let best = rated.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, to, left)| (to, left));
            // Between two corners of one cost, nothing falls: either is a way on.
            let corners = ways.iter().filter(|(to, _)| is_corner(*to)).copied();
            let (to, left) = best
                .or_else(|| corners.min_by(|a, b| a.1.total_cmp(&b.1)))
                .expect("a point on the way has a corner beside it that was opened");
            path.push(to);
            cost = left;
        }
        path.reverse();
        path
    }

    /// The points that a path may go to from `at` across one free cell: its corners, and the best point of each edge; with the cost
    /// that is left from each.
    fn ways(&self, on: &Cornered<'_>, at: Point) -> Vec<(Point, f64)> {
        let [columns, rows] = at.map(|value| {
            let low = value.floor() as i32;
            if value == value.floor() { vec![low - 1, low] } else { vec![low] }
        });
        let mut ways = Vec::new();
        for [x, y] in rows.iter().flat_map(|y| columns.iter().map(move |x| [*x, *y])) {
            if !on.cells.is_free_xy(x, y) {
                continue;
            }
            let corners =
                [[x, y], [x + 1, y], [x + 1, y + 1], [x, y + 1]].map(|[x, y]| [f64::from(x), f64::from(y)]);
            let costs = corners.map(|corner| self.cost(on, corner));
            for (i, j) in [(0, 1), (1, 2), (2, 3), (3, 0)] {
                if corners[i] != at && costs[i].is_finite() {
                    ways.push((corners[i], costs[i]));
                }
                ways.extend(best_on_edge(at, [corners[i], corners[j]], [costs[i], costs[j]]));
            }
        }
        ways
    }

    /// The cost of the way to a corner; infinite if it was not opened.
    fn cost(&self, on: &Cornered<'_>, at: Point) -> f64 {
        let corner = on.grid.cell(at[0] as i32, at[1] as i32);
        corner.and_then(|corner| self.side.g(corner)).unwrap_or(f64::INFINITY)
    }
}

/// The point within an edge by which a path from `at` goes best, costs being interpolated; none if it is an end, or `at` lies on the
/// edge.
fn best_on_edge(at: Point, [one, other]: [Point; 2], [cost, other_cost]: [f64; 2]) -> Option<(Point, f64)> {
    let along = [other[0] - one[0], other[1] - one[1]];
    let [dx, dy] = [at[0] - one[0], at[1] - one[1]];
    let foot = dx * along[0] + dy * along[1];
    let height = (dx * along[1] - dy * along[0]).abs();
    let slope = other_cost - cost;
    // Not where a cost is infinite either.
    if height == 0.0 || slope.is_nan() || slope.abs() >= 1.0 {
        return None;
    }
    let share = foot - slope * height / (1.0 - slope * slope).sqrt();
    let inside = share > SAME && share < 1.0 - SAME;
    inside.then(|| ([one[0] + share * along[0], one[1] + share * along[1]], cost + share * slope))
}

/// The cost at which `to` is reached from the expanded `node`, `cost` away, or over a point on an edge between it and the corners next to
/// it about `to`.
fn reached<Q: Frontier>(
    side: &Side<f64, Q>,
    on: &Cornered<'_>,
    [node, to]: [u32; 2],
    cost: f64,
    only_expanded: bool,
) -> f64 {
    let g = side.g(node).expect("an expanded node was opened");
    let [x, y] = on.grid.xy(to);
    let [node_x, node_y] = on.grid.xy(node);
    let [dx, dy] = [node_x - x, node_y - y];
    let counts = |corner: &u32| !only_expanded || side.place(*corner) == Place::Closed;
    let known =
        |dx: i32, dy: i32| on.grid.cell(x + dx, y + dy).filter(counts).and_then(|corner| side.g(corner));
    // The free cell about `to` in these directions, if it is one.
    let is_free = |dx: i32, dy: i32| on.cells.is_free_xy(x - i32::from(dx < 0), y - i32::from(dy < 0));
    let over = |straight: [i32; 2], diagonal: [i32; 2]| {
        let ends = known(straight[0], straight[1]).zip(known(diagonal[0], diagonal[1]));
        ends.filter(|_| is_free(diagonal[0], diagonal[1])).map(|(near, far)| over_edge(near, far))
    };
    let ways = if dx != 0 && dy != 0 {
        [over([dx, 0], [dx, dy]), over([0, dy], [dx, dy])]
    } else {
        [1, -1].map(|side| over([dx, dy], [dx + dy * side, dy + dx * side]))
    };
    ways.into_iter().flatten().fold(g + cost, f64::min)
}

/// The least cost of a way over the edge between a corner straight ahead and one diagonally ahead, from the cost of both.
fn over_edge(straight: f64, diagonal: f64) -> f64 {
    let falls = straight - diagonal;
    if falls <= 0.0 {
        return straight + 1.0;
    }
    if falls >= FRAC_1_SQRT_2 {
        return diagonal + SQRT_2;
    }
    let share = falls / (1.0 - falls * falls).sqrt();
    (1.0 + share * share).sqrt() + falls * (1.0 - share) + diagonal
}

fn is_corner(at: Point) -> bool {
    at.iter().all(|value| *value == value.floor())
}

fn apart(a: Point, b: Point) -> f64 {
    let [dx, dy] = [a[0] - b[0], a[1] - b[1]];
    (dx * dx + dy * dy).sqrt()
}
