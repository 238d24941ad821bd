//! The walk of one search from map to map, by simulated annealing.

use super::Ground;
use base::grid::Grid2;
use base::seed::Stream;
use rand::RngExt as _;
use std::ops::Range;

/// A map that changes by a few cells at a time.
pub(super) struct Walk<'g> {
    ground: &'g Ground,
    stream: &'g mut Stream,
    near: [Range<u32>; 2],
    /// The map as it is now.
    pub(super) grid: Grid2,
    /// How far it is from what is wanted: 0 where all of that holds.
    pub(super) distance: f64,
}

impl<'g> Walk<'g> {
    /// A walk that starts from `grid`.
    pub(super) fn new(ground: &'g Ground, grid: Grid2, stream: &'g mut Stream) -> Self {
        let distance = ground.distance(&grid);
        Self { near: ground.near(), ground, stream, grid, distance }
    }

    /// Changes some cells, and takes that back unless it is kept; `done` is the share of the search that is over.
    pub(super) fn step(&mut self, done: f64) {
        // One cell, or two or three at once, so that a blocked cell may move.
        let count = [1, 1, 2, 3][self.stream.random_range(0..4)];
        let cells: Vec<u32> = (0..count).map(|_| self.drawn_cell()).collect();
        self.flip(&cells);
        let distance = self.ground.distance(&self.grid);
        let warmth = WARMTH * (1.0 - done) * (1.0 - done) + 1e-9;
        let worse = distance - self.distance;
        if worse <= 0.0 || self.stream.random_bool(libm::exp(-worse / warmth)) {
            self.distance = distance;
        } else {
            self.flip(&cells);
        }
    }

    fn drawn_cell(&mut self) -> u32 {
        let [x, y] = [0, 1].map(|axis: usize| self.stream.random_range(self.near[axis].clone()));
        y * self.grid.width() + x
    }

    /// Blocks what is free and frees what is blocked, but for the ends.
    fn flip(&mut self, cells: &[u32]) {
        for cell in cells.iter().filter(|cell| !self.ground.cells.contains(cell)) {
            self.grid.set_blocked(*cell, self.grid.is_free(*cell));
        }
    }
}

/// How much worse a map may become in one step at the start of a search.
const WARMTH: f64 = 0.05;
