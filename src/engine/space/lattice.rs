//! The lattice of square cells: a map, its corner rule, the moves that both leave, and where its jump points are.
//!
//! What searches by jump points prepare for a map ([`JumpLines`], [`JumpTable`]) is made when it is first asked for, is
//! shared by all contenders, and goes when the world goes.

mod lines;
mod pruning;
mod table;

pub use lines::JumpLines;
pub use pruning::Pruning;
pub use table::JumpTable;

use base::grid::{CornerRule, Grid2, Moves};
use base::text::listed;
use std::sync::{Arc, OnceLock};

/// Where the runs of a search by jump points end.
pub trait Jumps {
    /// The legal moves.
    fn moves(&self) -> &Moves;

    /// The pruning rules.
    fn pruning(&self) -> &Pruning;

    /// How many moves a run in the straight direction number `DIRECTION` takes from the cell in column and row `at`, and
    /// whether it ends at a jump point, the first on its way; if not, it ends before a wall.
    fn ahead<const DIRECTION: usize>(&self, at: [u32; 2]) -> (u32, bool);

    /// How many moves in the diagonal direction number `DIRECTION` may be taken at once from `cell`: to a cell where a
    /// search has to look for jump points, but no more than `wanted`; 0 if there is none on the way.
    fn hop<const DIRECTION: usize>(&self, cell: u32, wanted: u32) -> u32;
}

/// A map with the moves that its corner rule leaves.
#[derive(Debug)]
pub struct LatticeWorld {
    grid: Grid2,
    corner_rule: CornerRule,
    moves: Arc<Moves>,
    jump_lines: OnceLock<JumpLines>,
    jump_table: OnceLock<JumpTable>,
}

impl LatticeWorld {
    /// The world of `grid` under `corner_rule`.
    pub fn new(grid: Grid2, corner_rule: CornerRule) -> Self {
        let moves = Arc::new(Moves::new(&grid, corner_rule));
        Self { grid, corner_rule, moves, jump_lines: OnceLock::new(), jump_table: OnceLock::new() }
    }

    /// The map.
    pub fn grid(&self) -> &Grid2 {
        &self.grid
    }

    /// Which corners may be cut.
    pub fn corner_rule(&self) -> CornerRule {
        self.corner_rule
    }

    /// The legal moves of every cell.
    pub fn moves(&self) -> &Arc<Moves> {
        &self.moves
    }

    /// Its rows and columns as bits, for searches by jump points; the first call makes them.
    pub fn jump_lines(&self) -> &JumpLines {
        self.jump_lines.get_or_init(|| JumpLines::new(self))
    }

    /// The distances of its cells to their next jump points; the first call makes them.
    pub fn jump_table(&self) -> &JumpTable {
        self.jump_table.get_or_init(|| JumpTable::new(self))
    }

    /// The free cell whose centre is `point` = [x, y].
    ///
    /// # Errors
    /// A sentence about `what` (start or goal) if the point is no cell centre, outside, or blocked.
    pub fn free_cell(&self, what: &str, point: &[f64]) -> Result<u32, String> {
        let outside = || {
            let (width, height) = (self.grid.width(), self.grid.height());
            format!(
                "the {what} {point} is not a cell of the map; cells are 0..{width} by 0..{height}",
                point = listed(point)
            )
        };
        let [x, y] = *point else { return Err(outside()) };
        if x.fract() != 0.0 || y.fract() != 0.0 {
            return Err(outside());
        }
        let cell = self.grid.cell(x as i32, y as i32).ok_or_else(outside)?;
        if self.grid.is_free(cell) {
            Ok(cell)
        } else {
            Err(format!("the {what} {point} is blocked", point = listed(point)))
        }
    }
}
