//! The shortest polyline that can be free on a map whose 8-connected optimum is known.
//!
//! Premises: the corners and ends of the path are cell centres; every segment is free in all cells whose interior it
//! crosses (or in all cells of Bresenham's line); a diagonal move may pass blocked cells; and no 8-connected path on
//! the map is shorter than C*.
//!
//! Argument. Take a free segment over (dx, dy) with dx ≥ dy ≥ 0, the other octants being alike. In each column that
//! it passes, take the cell that holds its point on the column's centre line (where that point lies between two
//! cells the segment crosses both, and either will do). The slope is at most 1, so the cells of neighbouring columns
//! differ by at most one row, and they are joined by dx moves of which dy are diagonal; Bresenham's line is such a
//! chain itself. So the map has an 8-connected path as long as the octile distances of all segments together, and
//! these sum to at least C*. The bound is the shortest polyline for which they do, found best-first over (cell, moves so
//! far). Obstacles are left out otherwise, so it holds on every map.

use super::lattice::{Octile, octile_distance};
use super::{Cell, distance};
use std::cmp::{Ordering, Reverse};
use std::collections::{BTreeMap, BinaryHeap};

/// A shortest polyline and its length.
#[derive(Debug, Clone, PartialEq)]
pub struct Seen {
    /// Start, corners and goal.
    pub cells: Vec<Cell>,
    /// Length, cells.
    pub length: f64,
}

/// The shortest polyline from `start` to `goal` through cells of a grid of `size` = `[columns, rows]` whose segments'
/// octile distances sum to `optimum` at least.
///
/// # Panics
/// If an end is outside the grid, or `start` is `goal`.
pub fn shortest_seen(size: [i32; 2], [start, goal]: [Cell; 2], optimum: Octile) -> Seen {
    let is_inside = |cell: Cell| (0..2).all(|axis| (0..size[axis]).contains(&cell[axis]));
    assert!(is_inside(start) && is_inside(goal) && start != goal, "from {start:?} to {goal:?} on {size:?}");
    let straight = distance(start, goal);
    // The walk of an optimum's own moves is such a polyline, or a little longer where it does not end at the goal.
    let mut longest = straight;
    loop {
        longest += STRIDE;
        if let Some(found) = within(size, [start, goal], optimum, longest) {
            return found;
        }
    }
}

/// How much further each search looks, cells.
const STRIDE: f64 = 0.25;

/// A place on the way: the cell and the moves so far, or `None` once they suffice.
type State = (Cell, Option<(u32, u32)>);

/// Floats in the order of their values.
#[derive(PartialEq)]
struct Length(f64);

impl Eq for Length {}

impl PartialOrd for Length {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Length {
    fn cmp(&self, other: &Self) -> Ordering {
        self.0.total_cmp(&other.0)
    }
}

fn within(size: [i32; 2], [start, goal]: [Cell; 2], optimum: Octile, longest: f64) -> Option<Seen> {
    let all = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| [x, y]));
    let cells: Vec<Cell> = all.filter(|&c| distance(start, c) + distance(c, goal) <= longest).collect();
    let mut best: BTreeMap<State, (f64, Option<State>)> = BTreeMap::new();
    let first = (start, Some((0, 0)));
    best.insert(first, (0.0, None));
    let mut open = BinaryHeap::from([Reverse((Length(distance(start, goal)), first))]);
    while let Some(Reverse((Length(f), state))) = open.pop() {
        let (at, moves) = state;
        let length = best[&state].0;
        if state == (goal, None) {
            return Some(Seen { cells: chain(&best, state), length });
        }
        if f > length + distance(at, goal) + 1e-12 {
            continue;
        }
        for &to in cells.iter().filter(|&&to| to != at) {
            let next = (to, moves.and_then(|moves| longer(moves, [to[0] - at[0], to[1] - at[1]], optimum)));
            let reached = length + distance(at, to);
            let f = reached + distance(to, goal);
            if f <= longest && best.get(&next).is_none_or(|(known, _)| reached < *known) {
                best.insert(next, (reached, Some(state)));
                open.push(Reverse((Length(f), next)));
            }
        }
    }
    None
}

/// The moves with those of one more segment, or `None` if they reach the optimum.
fn longer((straight, diagonal): (u32, u32), segment: Cell, optimum: Octile) -> Option<(u32, u32)> {
    let more = octile_distance(segment);
    let sum = Octile { straight: straight + more.straight, diagonal: diagonal + more.diagonal };
    sum.compare(optimum).is_lt().then_some((sum.straight, sum.diagonal))
}

fn chain(best: &BTreeMap<State, (f64, Option<State>)>, last: State) -> Vec<Cell> {
    let mut states = vec![last];
    while let Some(before) = best[&states[states.len() - 1]].1 {
        states.push(before);
    }
    states.reverse();
    states.into_iter().map(|(cell, _)| cell).collect()
}

#[cfg(test)]
mod tests;
