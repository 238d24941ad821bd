//! The lattice of square cells: a map, its corner rule, and the moves that both leave.

use base::grid::{CornerRule, Grid2, Moves};
use std::sync::Arc;

/// A map with the moves that its corner rule leaves.
#[derive(Debug)]
pub struct LatticeWorld {
    grid: Grid2,
    corner_rule: CornerRule,
    moves: Arc<Moves>,
}

impl LatticeWorld {
    /// The world of `grid` under `corner_rule`.
    pub fn new(grid: Grid2, corner_rule: CornerRule) -> Self {
        let moves = Arc::new(Moves::new(&grid, corner_rule));
        Self { grid, corner_rule, moves }
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

    /// The free cell whose centre is `point` = [x, y].
    ///
    /// # Errors
    /// A sentence about `what` (start or goal) if the point is no cell centre, outside, or blocked.
    pub fn free_cell(&self, what: &str, point: &[f64]) -> Result<u32, String> {
        let outside = || {
            let (width, height) = (self.grid.width(), self.grid.height());
            format!("the {what} {point:?} is not a cell of the map; cells are 0..{width} by 0..{height}")
        };
        let [x, y] = *point else { return Err(outside()) };
        if x.fract() != 0.0 || y.fract() != 0.0 {
            return Err(outside());
        }
        let cell = self.grid.cell(x as i32, y as i32).ok_or_else(outside)?;
        if self.grid.is_free(cell) { Ok(cell) } else { Err(format!("the {what} {point:?} is blocked")) }
    }
}
