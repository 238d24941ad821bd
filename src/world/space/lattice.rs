//! The lattice of square cells: a map, its corner rule, the moves that both leave, and where its jump points are.
//!
//! What searches by jump points prepare for a map ([`JumpLines`], [`JumpTable`]) is made when it is first needed, is
//! shared by all contenders, and goes when the world goes.

mod lines;
mod pruning;
mod table;

pub use lines::JumpLines;
pub use pruning::Pruning;
pub use table::JumpTable;

use base::grid::{CornerRule, Grid2, Moves, Vertices, corner_moves, corner_vertices};
use base::text::listed;
use std::sync::{Arc, OnceLock};

/// Where the runs of a search by jump points end.
pub trait Jumps {
    /// The legal moves.
    fn moves(&self) -> &Moves;

    /// The pruning rules.
    fn pruning(&self) -> &Pruning;

    /// How many moves a run in the straight direction number `DIRECTION` takes from the cell in column and row `at`, and whether
    /// it ends at a jump point, the first on its way. If not, it ends before a wall.
    fn ahead<const DIRECTION: usize>(&self, at: [u32; 2]) -> (u32, bool);

    /// How many moves in the diagonal direction number `DIRECTION` may be taken at once from `cell`. It goes to a cell where a
    /// search has to look for jump points, but takes no more than `wanted`. 0 if there is none on the way.
    fn hop<const DIRECTION: usize>(&self, cell: u32, wanted: u32) -> u32;
}

/// A map with the moves that its corner rule leaves.
///
/// Searches see its vertices only: a grid in which those that can be stood on are free. They are its cells, or the corners of its
/// cells.
#[derive(Debug)]
pub struct LatticeWorld {
    grid: Grid2,
    /// The map, if its vertices are the corners of its cells.
    cornered: Option<Grid2>,
    corner_rule: CornerRule,
    moves: Arc<Moves>,
    jump_lines: OnceLock<JumpLines>,
    jump_table: OnceLock<JumpTable>,
}

impl LatticeWorld {
    /// The world of `grid` under `corner_rule`.
    pub fn new(grid: Grid2, corner_rule: CornerRule) -> Self {
        let moves = Moves::new(&grid, corner_rule);
        Self::with_moves(grid, None, corner_rule, moves)
    }

    /// The world of the corners of `cells`; a path may pass between two blocked cells that touch at a corner.
    pub fn of_corners(cells: Grid2) -> Self {
        let grid = corner_vertices(&cells);
        let moves = corner_moves(&cells);
        Self::with_moves(grid, Some(cells), CornerRule::Allow, moves)
    }

    fn with_moves(grid: Grid2, cornered: Option<Grid2>, corner_rule: CornerRule, moves: Moves) -> Self {
        let moves = Arc::new(moves);
        Self { grid, cornered, corner_rule, moves, jump_lines: OnceLock::new(), jump_table: OnceLock::new() }
    }

    /// The same without what searches by jump points have made of it.
    #[must_use]
    pub fn again(&self) -> Self {
        Self {
            grid: self.grid.clone(),
            cornered: self.cornered.clone(),
            corner_rule: self.corner_rule,
            moves: Arc::clone(&self.moves),
            jump_lines: OnceLock::new(),
            jump_table: OnceLock::new(),
        }
    }

    /// Its vertices.
    pub fn grid(&self) -> &Grid2 {
        &self.grid
    }

    /// The map.
    pub fn cells(&self) -> &Grid2 {
        self.cornered.as_ref().unwrap_or(&self.grid)
    }

    /// The map, if the vertices are the corners of its cells.
    pub fn cornered(&self) -> Option<&Grid2> {
        self.cornered.as_ref()
    }

    /// Where its vertices are.
    pub fn vertices(&self) -> Vertices {
        if self.cornered.is_some() { Vertices::Corners } else { Vertices::Centres }
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

    /// The free vertex at `point` = [x, y].
    ///
    /// # Errors
    /// A sentence about `what` (start or goal) if the point is no vertex, outside, or blocked.
    pub fn free_cell(&self, what: &str, point: &[f64]) -> Result<u32, String> {
        let is_cell = self.cornered.is_none();
        let outside = || {
            let (width, height) = (self.grid.width(), self.grid.height());
            let [one, all] = if is_cell { ["a cell", "cells"] } else { ["a corner", "corners"] };
            format!(
                "the {what} {point} is not {one} of the map; {all} from [0, 0] to [{}, {}] are accepted",
                width - 1,
                height - 1,
                point = listed(point)
            )
        };
        let [x, y] = *point else { return Err(outside()) };
        if x.fract() != 0.0 || y.fract() != 0.0 {
            return Err(outside());
        }
        let cell = self.grid.cell(x as i32, y as i32).ok_or_else(outside)?;
        if self.grid.is_free(cell) {
            return Ok(cell);
        }
        let place = if is_cell { "is blocked" } else { "touches no free cell" };
        Err(format!("the {what} {point} {place}", point = listed(point)))
    }
}
