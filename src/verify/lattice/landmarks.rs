//! The verifier's tables of a map with many queries: every cell's moves, and its distances from a few landmarks.
//!
//! By the triangle inequality, two cells are at least as far from each other as their distances from any landmark
//! differ. The search for an optimum then looks where the optimum is, and finds the same.
//!
//! # Source
//! Goldberg and Harrelson, *Computing the Shortest Path: A\* Search Meets Graph Theory*, SODA 2005.

use super::Case;
use super::search::Scratch;
use std::sync::{Mutex, PoisonError};

/// How many cells all distances are known from. Of twice as many a search opens a third fewer cells and takes as long, since
/// distances come from memory.
const COUNT: usize = 4;

/// Beyond as many cells the distances would fill the memory.
const MOST_CELLS: u32 = 1 << 22;

/// Moves of every cell, and its distances from a few.
#[derive(Debug)]
pub struct Landmarks {
    moves: Vec<u8>,
    costs: Vec<Costs>,
    /// The memory of searches that are over: a map has as many as were under way at once.
    spare: Mutex<Vec<Scratch>>,
}

/// A cell's distances; infinite where it cannot be reached.
#[derive(Debug, Clone, Copy)]
pub(super) struct Costs([f64; COUNT]);

impl Costs {
    /// A bound from below on the cost of a path to the cell with the costs `other`, not below `least`; infinite if there is no path.
    pub(super) fn bound(&self, other: &Self, least: f64) -> f64 {
        // Neither cell is reached: not a number, which `max` passes over.
        self.0.iter().zip(&other.0).fold(least, |bound, (a, b)| bound.max((a - b).abs()))
    }
}

impl Landmarks {
    /// Landmarks in the part of the map where the start of `case` is; `None` if it is not free, or the map is too large for them.
    pub fn new(case: &Case<'_>) -> Option<Self> {
        let cells = case.grid.cell_count();
        let width = case.grid.width() as usize;
        let start = case.cell(case.start).filter(|[x, y]| case.grid.is_free_xy(*x, *y))?;
        if cells > MOST_CELLS {
            return None;
        }
        let xy = |index: usize| [(index % width) as i32, (index / width) as i32];
        let is_free = |[x, y]: [i32; 2]| case.grid.is_free_xy(x, y);
        let moves_at = |at| if is_free(at) { case.moves(at) } else { 0 };
        let moves: Vec<u8> = (0..cells as usize).map(|index| moves_at(xy(index))).collect();
        let mut scratch = Scratch::new(cells);
        let mut flood = |from: [i32; 2]| -> Vec<f64> {
            case.flood(from, |at| moves[case.index(at)], &mut scratch);
            scratch.costs().collect()
        };
        // The first is as far as can be from the start, each other one from those before it.
        let mut nearest = flood(start);
        let mut costs = vec![Costs([f64::INFINITY; COUNT]); cells as usize];
        for landmark in 0..COUNT {
            let far = |cell: &usize| if nearest[*cell].is_finite() { nearest[*cell] } else { -1.0 };
            let index = (0..nearest.len()).max_by(|a, b| far(a).total_cmp(&far(b)))?;
            for ((known, nearest), cost) in costs.iter_mut().zip(&mut nearest).zip(flood(xy(index))) {
                known.0[landmark] = cost;
                *nearest = if landmark == 0 { cost } else { nearest.min(cost) };
            }
        }
        Some(Self { moves, costs, spare: Mutex::new(vec![scratch]) })
    }

    /// The moves from a cell, by index, a bit each.
    pub(super) fn moves(&self, cell: usize) -> u8 {
        self.moves[cell]
    }

    /// The distances of a cell, by index.
    pub(super) fn costs(&self, cell: usize) -> &Costs {
        &self.costs[cell]
    }

    /// What `search` makes of memory for this map.
    pub(super) fn lend<T>(&self, search: impl FnOnce(&mut Scratch) -> T) -> T {
        let spare = || self.spare.lock().unwrap_or_else(PoisonError::into_inner);
        let taken = spare().pop();
        let mut scratch = taken.unwrap_or_else(|| Scratch::new(self.moves.len() as u32));
        let found = search(&mut scratch);
        spare().push(scratch);
        found
    }
}
