//! How far every cell is from its next jump point, in all eight directions.

use super::{Jumps, LatticeWorld, Pruning};
use base::grid::{DIRECTIONS, Moves};
use std::sync::Arc;

/// The longest hop that a table holds, in cells; longer runs are followed in several.
const LONGEST: u16 = u16::MAX >> 1;

/// For every cell and direction, how far a run goes and whether it ends at a jump point: what JPS+ looks up.
///
/// Straight runs end at the first jump point or before the wall. Diagonal runs end at the first cell from which a straight
/// run in one of their two parts meets a jump point, or that is a jump point itself, or before the wall. Such cells
/// on diagonals are no nodes of a search; it looks past them (intermediate pruning). Goals are no part of the table.
///
/// # Source
/// Harabor & Grastien, *Improving jump point search*, ICAPS 2014, section 6.
#[derive(Debug)]
pub struct JumpTable {
    moves: Arc<Moves>,
    pruning: &'static Pruning,
    /// By cell and direction, twice the length of the run, and 1 if a jump point ends it.
    runs: Vec<[u16; 8]>,
}

/// A direction and, if it is diagonal, the straight ones that make it.
type Direction = (usize, Option<[usize; 2]>);

/// The passes over the cells: first to last, back, and forth again.
///
/// A run goes on where that of the next cell does, so that each pass takes the directions that lead to cells it has been to.
/// A diagonal run also asks where straight ones of the next cell end, so that south-east waits for east.
const PASSES: [&[Direction]; 3] = [
    &[(4, None), (6, None), (7, Some([6, 4]))],
    &[(1, None), (3, None), (0, Some([1, 3])), (5, Some([6, 3]))],
    &[(2, Some([1, 4]))],
];

impl JumpTable {
    /// The table of `world`.
    pub fn new(world: &LatticeWorld) -> Self {
        let moves = Arc::clone(world.moves());
        let pruning = Pruning::under(world.corner_rule());
        let mut table = Self { runs: vec![[0; 8]; moves.cell_count() as usize], moves, pruning };
        let count = table.moves.cell_count();
        for (number, pass) in PASSES.into_iter().enumerate() {
            for place in 0..count {
                let cell = if number == 1 { count - 1 - place } else { place };
                let mask = table.moves.mask(cell);
                for (direction, parts) in pass {
                    if mask >> direction & 1 == 1 {
                        table.fill(cell, *direction, *parts);
                    }
                }
            }
        }
        table
    }

    #[inline]
    fn fill(&mut self, cell: u32, direction: usize, parts: Option<[usize; 2]>) {
        let [dx, dy] = DIRECTIONS[direction];
        let next = cell.wrapping_add_signed(dy * self.moves.width() as i32 + dx);
        let beyond = &self.runs[next as usize];
        let is_turn = self.pruning.turns(self.moves.mask(next)) >> direction & 1 == 1;
        let meets_jump =
            parts.is_some_and(|[sideways, upwards]| (beyond[sideways] | beyond[upwards]) & 1 == 1);
        self.runs[cell as usize][direction] = match beyond[direction] >> 1 {
            _ if is_turn || meets_jump => 3,
            LONGEST => LONGEST << 1 | 1,
            _ => beyond[direction] + 2,
        };
    }

    /// The memory it takes besides the legal moves.
    pub fn bytes(&self) -> usize {
        size_of_val(self.runs.as_slice())
    }
}

impl Jumps for JumpTable {
    fn moves(&self) -> &Moves {
        &self.moves
    }

    fn pruning(&self) -> &Pruning {
        self.pruning
    }

    #[inline]
    fn ahead<const DIRECTION: usize>(&self, [x, y]: [u32; 2]) -> (u32, bool) {
        let run = self.runs[(y * self.moves.width() + x) as usize][DIRECTION];
        (u32::from(run >> 1), run & 1 == 1)
    }

    #[inline]
    fn hop<const DIRECTION: usize>(&self, cell: u32, wanted: u32) -> u32 {
        let run = self.runs[cell as usize][DIRECTION];
        let length = u32::from(run >> 1);
        if wanted <= length { wanted } else { length * u32::from(run & 1) }
    }
}
