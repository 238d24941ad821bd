//! The length of a shortest path among blocked cells, which may bend anywhere.
//!
//! Such a path bends at corners of blocked cells alone, about which it turns: it goes on between the direction in which it came and
//! an edge of the blocked cell. From every corner that the search takes, rows are scanned upwards and downwards for what is in sight
//! between these two. It is an interval of the next row for every run of free cells, whose ends are rounded to a whole number within
//! 1e-9. Ends are where a line through two corners of the map meets a row, so that different ones are further apart on maps of up
//! to 10 000 rows.

use super::distance;
use base::grid::Grid2;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

const SAME: f64 = 1e-9;

/// An open corner, the one with the least estimate first.
#[derive(Debug, PartialEq)]
struct Open {
    estimate: f64,
    g: f64,
    corner: [i32; 2],
    /// The corner before it; the start is its own.
    before: [i32; 2],
}

impl Eq for Open {}

impl Ord for Open {
    fn cmp(&self, other: &Self) -> Ordering {
        other.estimate.total_cmp(&self.estimate).then(other.corner.cmp(&self.corner))
    }
}

impl PartialOrd for Open {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// The length of a shortest path between two corners of `cells`; `None` if there is no path.
pub(super) fn shortest(cells: &Grid2, start: [i32; 2], goal: [i32; 2]) -> Option<f64> {
    let width = cells.width() as usize + 1;
    let mut best = vec![f64::INFINITY; width * (cells.height() as usize + 1)];
    let index = |[x, y]: [i32; 2]| y as usize * width + x as usize;
    let mut open = BinaryHeap::new();
    let mut stack = Vec::new();
    best[index(start)] = 0.0;
    open.push(Open { estimate: distance(start, goal), g: 0.0, corner: start, before: start });
    while let Some(Open { g, corner, before, .. }) = open.pop() {
        if corner == goal {
            return Some(g);
        }
        if g > best[index(corner)] {
            continue;
        }
        let visit = |seen| {
            if seen != goal && !is_turn(cells, seen) {
                return;
            }
            let known = &mut best[index(seen)];
            let reached = g + distance(corner, seen);
            if reached < *known {
                *known = reached;
                let estimate = reached + distance(seen, goal);
                open.push(Open { estimate, g: reached, corner: seen, before: corner });
            }
        };
        in_sight(cells, corner, &views(cells, before, corner), &mut stack, visit);
    }
    None
}

/// Whether a taut path may turn about a corner: it belongs to one blocked cell, or to two that touch there.
fn is_turn(cells: &Grid2, [x, y]: [i32; 2]) -> bool {
    let [a, b, c, d] = [[x, y], [x - 1, y - 1], [x - 1, y], [x, y - 1]].map(|[x, y]| !cells.is_free_xy(x, y));
    match [a, b, c, d].iter().filter(|blocked| **blocked).count() {
        1 => true,
        2 => a == b,
        _ => false,
    }
}

/// Where a path may go on from a corner.
#[derive(Debug, Clone, Copy)]
enum View {
    /// Along its row, to lower columns (-1) or higher ones (1).
    Along(i32),
    /// To lower rows (-1) or higher ones (1), by this many columns a row at least and at most.
    Rows(i32, [f64; 2]),
}

/// Where a taut path that came from `before` may go on from `corner`; anywhere from its start.
///
/// Seen with the blocked cell at the upper right, it comes in one of two ways. Along the cell's left edge or from
/// further right, it turns no further than straight up. Along the lower edge or from further up, it turns no further
/// than to the right.
fn views(cells: &Grid2, before: [i32; 2], corner: [i32; 2]) -> Vec<View> {
    let [dx, dy] = [0, 1].map(|axis: usize| corner[axis] - before[axis]);
    if [dx, dy] == [0, 0] {
        let all = [f64::NEG_INFINITY, f64::INFINITY];
        return vec![View::Along(-1), View::Along(1), View::Rows(1, all), View::Rows(-1, all)];
    }
    let mut views = Vec::new();
    for [right, up] in [[1, 1], [-1, 1], [1, -1], [-1, -1]] {
        let cell = [0, 1].map(|axis: usize| corner[axis] + ([right, up][axis] - 1) / 2);
        if cells.is_free_xy(cell[0], cell[1]) {
            continue;
        }
        let came = f64::from(dx) / f64::from(dy.abs());
        let between = |edge: f64| [came.min(edge), came.max(edge)];
        if dx * right <= 0 && dy * up >= 0 {
            views.push(View::Rows(up, between(0.0)));
            views.extend((dy == 0).then_some(View::Along(-right)));
        } else if dx * right >= 0 && dy * up <= 0 {
            views.push(View::Along(right));
            let rows = View::Rows(-up, between(f64::from(right) * f64::INFINITY));
            views.extend((dy != 0).then_some(rows));
        }
    }
    views
}

/// What is seen of a row: the row, and from where to where.
type Part = (i32, [f64; 2]);

/// Hands every corner that is in sight of `from` in one of its `views` to `visit`.
fn in_sight(
    cells: &Grid2,
    from: [i32; 2],
    views: &[View],
    stack: &mut Vec<Part>,
    mut visit: impl FnMut([i32; 2]),
) {
    for view in views {
        match *view {
            View::Along(dx) => along(cells, from, dx, &mut visit),
            View::Rows(up, slopes) => rows(cells, from, (up, slopes), stack, &mut visit),
        }
    }
}

/// Hands every corner that is in sight along the row to `visit`.
fn along(cells: &Grid2, [x, y]: [i32; 2], dx: i32, visit: &mut impl FnMut([i32; 2])) {
    let mut at = x;
    let beside = |at: i32| if dx > 0 { at } else { at - 1 };
    while cells.is_free_xy(beside(at), y) || cells.is_free_xy(beside(at), y - 1) {
        at += dx;
        visit([at, y]);
    }
}

/// Hands every corner that is in sight in the rows beyond to `visit`.
fn rows(
    cells: &Grid2,
    [x, y]: [i32; 2],
    (up, slopes): (i32, [f64; 2]),
    stack: &mut Vec<Part>,
    visit: &mut impl FnMut([i32; 2]),
) {
    let first_row = slopes.map(|slope| rounded(f64::from(x) + slope));
    stack.clear();
    stack.push((y, [f64::from(x); 2]));
    while let Some((row, [low, high])) = stack.pop() {
        let cell_row = if up > 0 { row } else { row - 1 };
        let away = f64::from((row - y).abs());
        let is_free = |column: i32| cells.is_free_xy(column, cell_row);
        let onwards = |at: f64| rounded(f64::from(x) + (at - f64::from(x)) * (away + 1.0) / away);
        let [far_low, far_high] = if away == 0.0 { first_row } else { [onwards(low), onwards(high)] };
        let mut column = low.ceil() as i32 - 1;
        while f64::from(column) <= high {
            if !is_free(column) {
                column += 1;
                continue;
            }
            let first =
                (0..column).rev().take_while(|at| is_free(*at) && f64::from(*at + 1) > far_low).last();
            let mut last = column;
            while is_free(last + 1) && f64::from(last + 1) < high.max(far_high) {
                last += 1;
            }
            let run = [f64::from(first.unwrap_or(column)), f64::from(last + 1)];
            // What is left of a run that goes on beyond all that is seen is not a run of its own.
            column = if is_free(last + 1) { i32::MAX } else { last + 1 };
            if run[0] > high || run[1] < low {
                continue;
            }
            let near = [low.max(run[0]), high.min(run[1])];
            let [from, to] = if away == 0.0 { first_row } else { near.map(onwards) };
            let far = [from.max(run[0]), to.min(run[1])];
            if far[0] > far[1] {
                continue;
            }
            for seen in far[0].ceil() as i32..=far[1].floor() as i32 {
                visit([seen, row + up]);
            }
            stack.push((row + up, far));
        }
    }
}

/// `at`, or the whole number that it should be; below zero, where there is no cell, `at`.
fn rounded(at: f64) -> f64 {
    // `round` would be a call on processors without an instruction for it.
    let whole = f64::from((at + 0.5) as i32);
    if (at - whole).abs() < SAME { whole } else { at }
}
