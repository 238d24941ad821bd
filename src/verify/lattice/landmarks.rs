//! The verifier's own bounds on distances, for maps that are asked many queries.
//!
//! From a few cells far apart all distances are known. By the triangle inequality, two cells are at least as far from each other as
//! their distances from any of these differ; the search for an optimum then looks where the optimum is, and finds the same.
//!
//! # Source
//! Goldberg and Harrelson, *Computing the Shortest Path: A\* Search Meets Graph Theory*, SODA 2005.

use super::{Case, octile};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// How many cells all distances are known from.
const COUNT: usize = 8;

/// Beyond as many cells the distances would fill the memory.
const MOST_CELLS: u32 = 1 << 22;

/// Distances of every cell from a few.
#[derive(Debug)]
pub struct Landmarks {
    /// By cell; infinite where a cell cannot be reached.
    costs: Vec<[f64; COUNT]>,
}

impl Landmarks {
    /// Landmarks in the part of the map where the start of `case` is; `None` if it is not free, or the map is too large for them.
    pub fn new(case: &Case<'_>) -> Option<Self> {
        let cells = case.grid.cell_count();
        let start = case.cell(case.start).filter(|[x, y]| case.grid.is_free_xy(*x, *y))?;
        if cells > MOST_CELLS {
            return None;
        }
        let mut costs = vec![[f64::INFINITY; COUNT]; cells as usize];
        // The first is as far as can be from the start, each other one from those before it.
        let mut nearest = case.costs_from(start);
        for landmark in 0..COUNT {
            let far = |cell: &usize| if nearest[*cell].is_finite() { nearest[*cell] } else { -1.0 };
            let index = (0..nearest.len()).max_by(|a, b| far(a).total_cmp(&far(b)))?;
            let width = case.grid.width() as usize;
            let own = case.costs_from([(index % width) as i32, (index / width) as i32]);
            for ((known, nearest), cost) in costs.iter_mut().zip(&mut nearest).zip(own) {
                known[landmark] = cost;
                *nearest = if landmark == 0 { cost } else { nearest.min(cost) };
            }
        }
        Some(Self { costs })
    }

    /// A bound from below on the cost between two cells, by index; infinite if there is no path.
    pub(super) fn bound(&self, a: usize, b: usize) -> f64 {
        let pairs = self.costs[a].iter().zip(&self.costs[b]);
        pairs.map(|(a, b)| if a == b { 0.0 } else { (a - b).abs() }).fold(0.0, f64::max)
    }
}

impl Case<'_> {
    /// The least cost from `start` to every cell, by index: Dijkstra's algorithm.
    fn costs_from(&self, start: [i32; 2]) -> Vec<f64> {
        let mut best = vec![f64::INFINITY; self.grid.cell_count() as usize];
        let mut queue = BinaryHeap::from([Reverse((0_u64, 0_u32, 0_u32, start))]);
        best[self.index(start)] = 0.0;
        while let Some(Reverse((key, straight, diagonal, at))) = queue.pop() {
            if f64::from_bits(key) > best[self.index(at)] {
                continue;
            }
            self.steps(at, |next, is_diagonal| {
                let (a, b) = (straight + 1 - is_diagonal, diagonal + is_diagonal);
                let cost = octile(a, b);
                let known = &mut best[self.index(next)];
                if cost < *known {
                    *known = cost;
                    queue.push(Reverse((cost.to_bits(), a, b, next)));
                }
            });
        }
        best
    }
}
