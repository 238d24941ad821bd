//! How many cells A* can close and open, on any map at all, when the length of its path is known.
//!
//! Premises: an 8-connected unit grid with moves of cost 1 and √2, and an optimal path of cost C*. A* runs as published,
//! with f = g + h, and stops when the goal is chosen. Its heuristic `h` is Euclidean, which is consistent for these costs.
//!
//! Argument. With a consistent heuristic, A* chooses cells in non-decreasing f and with final g (Hart, Nilsson &
//! Raphael 1968, lemma 2 and its corollary). The goal is chosen with f = C*, so every closed cell n has g(n) + h(n) ≤
//! C*. Obstacles only lengthen paths, so g(n) is at least the octile distance from the start. Hence the closed cells,
//! the goal among them, lie in K = {n : octile(start, n) + h(n) ≤ C*}, and |K| bounds their number on every map and for
//! every order of ties. A cell is opened only as the start or as a neighbour of a closed cell, so opened cells (open or
//! closed) lie in K ∪ N(K). This covers a program that expands the goal before it stops. The argument covers every
//! corner rule, since these only remove moves. Ties at C* within a billionth of a cell count as inside, so floats can
//! only raise the bounds.

use super::{lattice, neighbourhood};
use crate::turns::{Cell, distance};
use std::collections::BTreeSet;

/// Upper bounds that hold on every map.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CountBound {
    /// Cells on the closed list when the goal is chosen, start and goal included.
    pub closed: usize,
    /// Cells ever put on the open list, closed ones included.
    pub opened: usize,
}

/// Bounds on the counts of an A* run from `start` to `goal` on a grid of `size` = `[columns, rows]` whose
/// optimal path costs `optimum` cells.
///
/// An optimum below the octile distance of the ends leaves no cell: nothing can be closed on the way there.
pub fn astar_count_bound(size: [i32; 2], start: Cell, goal: Cell, optimum: f64) -> CountBound {
    let least_f = |n: Cell| {
        let moved = lattice::octile_distance([n[0] - start[0], n[1] - start[1]]);
        moved.length() + distance(n, goal)
    };
    let cells = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| [x, y]));
    let closed: Vec<Cell> = cells.filter(|&n| least_f(n) <= optimum + 1e-9).collect();
    let opened: BTreeSet<Cell> = closed.iter().flat_map(|&n| neighbourhood(n, size)).collect();
    CountBound { closed: closed.len(), opened: opened.len() }
}

#[cfg(test)]
mod tests;
