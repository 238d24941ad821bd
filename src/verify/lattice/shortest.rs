//! The length of a shortest path among blocked cells, which may bend anywhere.
//!
//! Such a path bends at corners of blocked cells alone, about which it turns. From every corner that the search takes, rows are
//! scanned upwards and downwards for what is in sight. It is an interval of the next row for every run of free cells, whose ends
//! are rounded to a whole number within 1e-9. Ends are where a line through two corners of the map meets a row, so that different
//! ones are further apart on maps of up to 10 000 rows.

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
    open.push(Open { estimate: distance(start, goal), g: 0.0, corner: start });
    while let Some(Open { g, corner, .. }) = open.pop() {
        if corner == goal {
            return Some(g);
        }
        if g > best[index(corner)] {
            continue;
        }
        in_sight(cells, corner, &mut stack, |seen| {
            let known = &mut best[index(seen)];
            let reached = g + distance(corner, seen);
            if (seen == goal || is_turn(cells, seen)) && reached < *known {
                *known = reached;
                open.push(Open { estimate: reached + distance(seen, goal), g: reached, corner: seen });
            }
        });
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

/// What is seen of a row: the row, in which direction the next one is, and from where to where.
type Part = (i32, i32, [f64; 2]);

/// Hands every corner that is in sight of `from` to `visit`.
fn in_sight(cells: &Grid2, from: [i32; 2], stack: &mut Vec<Part>, mut visit: impl FnMut([i32; 2])) {
    let [x, y] = from;
    for dx in [-1, 1] {
        let mut at = x;
        let beside = |at: i32| if dx > 0 { at } else { at - 1 };
        while cells.is_free_xy(beside(at), y) || cells.is_free_xy(beside(at), y - 1) {
            at += dx;
            visit([at, y]);
        }
    }
    stack.clear();
    stack.extend([(y, 1, [f64::from(x); 2]), (y, -1, [f64::from(x); 2])]);
    while let Some((row, up, [low, high])) = stack.pop() {
        let cell_row = if up > 0 { row } else { row - 1 };
        let away = f64::from((row - y).abs());
        let is_free = |column: i32| cells.is_free_xy(column, cell_row);
        let onwards = |at: f64| {
            if away == 0.0 { at } else { round(f64::from(x) + (at - f64::from(x)) * (away + 1.0) / away) }
        };
        // Whole rows are open from the corner itself.
        let [far_low, far_high] =
            if away == 0.0 { [0.0, f64::from(cells.width())] } else { [onwards(low), onwards(high)] };
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
            let far =
                if away == 0.0 { run } else { [onwards(near[0]).max(run[0]), onwards(near[1]).min(run[1])] };
            if far[0] > far[1] {
                continue;
            }
            for seen in far[0].ceil() as i32..=far[1].floor() as i32 {
                visit([seen, row + up]);
            }
            stack.push((row + up, up, far));
        }
    }
}

/// `at`, or the whole number that it should be.
fn round(at: f64) -> f64 {
    let whole = at.round();
    if (at - whole).abs() < SAME { whole } else { at }
}
