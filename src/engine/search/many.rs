//! Least costs from one cell on up to 64 grids of one size at once.
//!
//! It finds what [`OctileAstar::flood`](super::OctileAstar::flood) finds on each grid alone; a test holds the two equal. A
//! set of grids is the bits of a word, and a cell is expanded once for all grids on which it costs the same. Grids that
//! differ in few cells thus cost little more than one.

use super::SearchError;
use super::buckets::Buckets;
use super::octile::{COSTS, MAX_CELLS};
use base::grid::{DIRECTIONS, Moves};

/// A set of grids: bit `k` stands for grid `k`.
pub type GridSet = u64;

/// The grids of one search, used for many queries.
#[derive(Clone, Debug)]
pub struct ManyGrids {
    /// How many cells lie before the first: an empty row and a cell, so that every neighbour has a number.
    before: u32,
    steps: [i32; 8],
    /// All grids.
    all: GridSet,
    /// For each cell, on which grids each of its moves is legal.
    legal: Vec<[GridSet; 8]>,
    /// On which grids the cell's cost is known.
    closed: Vec<GridSet>,
    /// The least cost that the cell was offered at, and on which grids.
    offered: Vec<(u32, GridSet)>,
    open: Buckets<(u32, GridSet)>,
}

impl ManyGrids {
    /// How many grids a search holds at most.
    pub const MOST: usize = GridSet::BITS as usize;

    /// The search over the legal moves of each of `grids`.
    ///
    /// # Errors
    /// [`SearchError::GridTooLarge`] if costs could exceed 32 bits.
    ///
    /// # Panics
    /// If there are no grids, more than [`Self::MOST`], or grids of different sizes.
    pub fn new(grids: &[Moves]) -> Result<Self, SearchError> {
        let (width, cells) = (grids[0].width(), grids[0].cell_count());
        assert!(grids.len() <= Self::MOST, "{} grids; a search holds {}", grids.len(), Self::MOST);
        let before = width + 1;
        let padded = cells as usize + 2 * before as usize;
        if padded > MAX_CELLS {
            return Err(SearchError::GridTooLarge { width, height: cells / width, padded });
        }
        let mut legal = vec![[0; 8]; padded];
        for (grid, moves) in grids.iter().enumerate() {
            assert!((moves.width(), moves.cell_count()) == (width, cells), "grids have one size");
            for cell in 0..cells {
                for (bit, set) in legal[(cell + before) as usize].iter_mut().enumerate() {
                    *set |= GridSet::from(moves.mask(cell) >> bit & 1) << grid;
                }
            }
        }
        Ok(Self {
            before,
            all: GridSet::MAX >> (Self::MOST - grids.len()),
            steps: DIRECTIONS.map(|[dx, dy]| dy * width as i32 + dx),
            legal,
            closed: vec![0; padded],
            offered: vec![(u32::MAX, 0); padded],
            open: Buckets::default(),
        })
    }

    /// Number of cells of each grid.
    pub fn cell_count(&self) -> u32 {
        self.legal.len() as u32 - 2 * self.before
    }

    /// Tells `visit` every cell that `start` reaches at a cost up to `most` on any grid, with that cost and the grids on
    /// which it is the least; a cell and a grid come together once. Costs rise from visit to visit and are in the units of
    /// [`ScaledOctile`](super::ScaledOctile).
    ///
    /// # Panics
    /// If `start` is outside the grids.
    pub fn flood(&mut self, start: u32, most: u32, mut visit: impl FnMut(u32, u32, GridSet)) {
        assert!(start < self.cell_count(), "{start} is no cell");
        self.open.clear();
        self.closed.fill(0);
        self.offered.fill((u32::MAX, 0));
        self.open.push(0, (start + self.before, self.all));
        while let Some((cost, (node, grids))) = self.open.pop() {
            if cost > u64::from(most) {
                break;
            }
            let new = grids & !self.closed[node as usize];
            if new != 0 {
                self.closed[node as usize] |= new;
                visit(node - self.before, cost as u32, new);
                self.expand(node, cost as u32, new);
            }
        }
    }

    #[inline]
    fn expand(&mut self, node: u32, cost: u32, grids: GridSet) {
        for ((step, length), legal) in self.steps.into_iter().zip(COSTS).zip(self.legal[node as usize]) {
            let (to, reached) = (node.wrapping_add_signed(step), cost + length);
            let (known, on) = &mut self.offered[to as usize];
            let mut new = grids & legal & !self.closed[to as usize];
            if reached >= *known {
                new &= !*on;
            }
            if new == 0 {
                continue;
            }
            if reached < *known {
                (*known, *on) = (reached, new);
            } else if reached == *known {
                *on |= new;
            }
            self.open.push(u64::from(reached), (to, new));
        }
    }
}
