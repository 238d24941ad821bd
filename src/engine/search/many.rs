//! Least costs from one cell on up to 64 grids of one size at once.
//!
//! It finds what [`OctileAstar::flood`](super::OctileAstar::flood) finds on each grid alone; a test holds the two equal. A
//! set of grids is the bits of a word, and a cell is expanded once for all grids on which it costs the same. Grids that
//! differ in few cells thus cost little more than one.
//!
//! Of equally short ways only those are followed that move diagonally as early as they can (canonical orderings, Sturtevant
//! and Rabin, IJCAI 2016): a cell is left by a move only if, on some grid, no way round the cell is as good for a way that
//! entered it as this one did. In the open that leaves one move of eight after a straight one and three after a diagonal one.

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
    /// For each cell and each move into it, by which moves it may be left; bit `i` is `DIRECTIONS[i]`.
    exits: Vec<[u8; 8]>,
    offered: Vec<Offered>,
    open: Buckets<(u32, GridSet)>,
}

/// The best that a cell was offered.
#[derive(Clone, Copy, Debug)]
struct Offered {
    /// The least cost.
    cost: u32,
    /// By which moves the cell may be left after one of the moves into it at that cost.
    exits: u8,
    /// On which grids.
    on: GridSet,
}

const NOTHING: Offered = Offered { cost: u32::MAX, exits: 0, on: 0 };

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
        let width = grids[0].width();
        let cells = grids[0].cell_count();
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
        let steps = DIRECTIONS.map(|[dx, dy]| dy * width as i32 + dx);
        Ok(Self {
            before,
            all: GridSet::MAX >> (Self::MOST - grids.len()),
            exits: exits(&legal, steps),
            steps,
            legal,
            closed: vec![0; padded],
            offered: vec![NOTHING; padded],
            open: Buckets::default(),
        })
    }

    /// Number of cells of each grid.
    pub fn cell_count(&self) -> u32 {
        self.legal.len() as u32 - 2 * self.before
    }

    /// On which grids there is a move from `cell`.
    pub fn leaving(&self, cell: u32) -> GridSet {
        self.legal[(cell + self.before) as usize].iter().fold(0, |all, on| all | on)
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
        self.offered.fill(NOTHING);
        self.offered[(start + self.before) as usize] = Offered { cost: 0, exits: u8::MAX, on: self.all };
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
        let best = self.offered[node as usize];
        // What was offered at more than the least cost is not distinguished by the moves into the cell.
        let mut left = if best.cost == cost { best.exits } else { u8::MAX };
        let legal = self.legal[node as usize];
        while left != 0 {
            let bit = left.trailing_zeros() as usize % 8;
            left &= left - 1;
            let to = node.wrapping_add_signed(self.steps[bit]);
            let reached = cost + COSTS[bit];
            let mut new = grids & legal[bit] & !self.closed[to as usize];
            if new == 0 {
                continue;
            }
            let exits = self.exits[to as usize][bit];
            let known = &mut self.offered[to as usize];
            if reached < known.cost {
                *known = Offered { cost: reached, exits, on: new };
            } else {
                new &= !known.on;
                if reached == known.cost {
                    known.exits |= exits;
                    known.on |= new;
                }
            }
            if new != 0 {
                self.open.push(u64::from(reached), (to, new));
            }
        }
    }
}

/// A way of one or two moves to where two others lead: what makes the second of these needless on a grid where it is legal.
#[derive(Clone, Copy)]
struct WayRound {
    first: usize,
    second: Option<usize>,
}

/// The ways that are shorter than move `into` and then move `out`, or as long with the diagonal move first.
fn ways_round(into: usize, out: usize) -> Vec<WayRound> {
    let sum = |one: usize, two: usize| [0, 1].map(|axis| DIRECTIONS[one][axis] + DIRECTIONS[two][axis]);
    let target = sum(into, out);
    let cost = COSTS[into] + COSTS[out];
    let direct = (0..8).filter(|first| DIRECTIONS[*first] == target);
    let direct = direct.map(|first| WayRound { first, second: None });
    let in_two = (0..64).map(|both| (both / 8, both % 8)).filter(|(first, second)| {
        let other = COSTS[*first] + COSTS[*second];
        sum(*first, *second) == target && (other < cost || (other == cost && COSTS[*first] > COSTS[into]))
    });
    direct.chain(in_two.map(|(first, second)| WayRound { first, second: Some(second) })).collect()
}

/// For each cell and each move into it the moves out of it that no way round the cell makes needless, on at least one grid.
fn exits(legal: &[[GridSet; 8]], steps: [i32; 8]) -> Vec<[u8; 8]> {
    let ways: Vec<Vec<WayRound>> = (0..64).map(|both| ways_round(both / 8, both % 8)).collect();
    let of_move = |cell: usize, into: usize| {
        let from = cell.wrapping_add_signed(-steps[into] as isize);
        let Some(before) = legal.get(from) else { return 0 };
        let is_needed = |out: &usize| {
            let round = ways[into * 8 + out].iter().fold(0, |round, way| {
                let middle = from.wrapping_add_signed(steps[way.first] as isize);
                let then = |second: usize| legal.get(middle).map_or(0, |moves| moves[second]);
                round | before[way.first] & way.second.map_or(GridSet::MAX, then)
            });
            out + into != 7 && before[into] & legal[cell][*out] & !round != 0
        };
        (0..8).filter(is_needed).fold(0, |exits, out| exits | 1 << out)
    };
    (0..legal.len()).map(|cell| std::array::from_fn(|into| of_move(cell, into))).collect()
}
