//! Proofs about a few printed numbers, in words: the questions that the claims of a paper put to this package.
//!
//! Each function receives everything that its answer rests on. It says whether the printed numbers are possible, how
//! that was computed, and under which premises. Where it refuses a number, it also says whether the printed ends
//! matter: each end is moved, one at a time, to the neighbours of its cell.

mod counts;
mod lengths;
mod turns;

pub use self::turns::{Search, joint_length_turn, turn_needs_length};
pub use counts::{at_most, clock_ticks, count_bound, percentage};
pub use lengths::{largest_saving, lattice_length, point_distance, straight_line};

use crate::lattice::Octile;
use crate::turns::Cell;

/// What the arithmetic of printed numbers amounts to.
#[derive(Debug, Clone, PartialEq)]
pub struct Proof {
    /// Whether what is printed can be, under the premises.
    pub is_possible: bool,
    /// The computation, step by step.
    pub because: Vec<String>,
    /// What it takes for granted.
    pub premises: Vec<String>,
}

/// The ends of a path on a grid, as printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Ends {
    /// Columns and rows.
    pub size: [i32; 2],
    /// The cell of the start.
    pub start: Cell,
    /// The cell of the goal.
    pub goal: Cell,
}

/// From the first cell to the second.
fn displacement([from, to]: [Cell; 2]) -> Cell {
    [to[0] - from[0], to[1] - from[1]]
}

/// The moves of a path and its length.
fn spelled(moves: Octile) -> String {
    format!("{} + {}√2 = {:.4}", moves.straight, moves.diagonal, moves.length())
}
