//! Flat lattices: which cells are free, which moves between them are legal, what can see what.
//!
//! A grid has `width × height` unit cells, x to the right and y **up**. A cell is named by its row-major index
//! `y · width + x`, a `u32`; cell (0, 0) is the lower left one. Map files list their highest row first (text maps)
//! or count y downwards (`MovingAI`); both readers turn that into y up and nothing later needs to know.
//!
//! The order of neighbours is written once, as [`DIRECTIONS`]; every mask follows it, and every search without orders
//! another [`NeighbourOrder`].
//! Costs belong to the search floor.

mod built;
mod columns;
mod components;
mod corners;
mod cubic;
mod error;
mod image;
mod moves;
mod movingai;
mod offsets;
mod order;
mod picture;
mod random;
mod ros;
mod seen_corners;
mod sight;
mod text;

pub use built::{maze, rooms, streets};
pub use columns::{Bits, Columns, MAX_REACH_CELLS};
pub use components::{Components, components};
pub use corners::{Vertices, corner_moves, corner_vertices, corners_see};
pub use cubic::{Grid3, Nodes3, STEPS_26};
pub use error::GridError;
pub use moves::{CornerRule, DIRECTIONS, Moves};
pub use movingai::{Scenario, parse_movingai_map, parse_scenarios, read_movingai_map, read_scenarios};
pub use offsets::Offsets;
pub use order::NeighbourOrder;
pub use picture::{FileMap, read_map};
pub use random::{Blocking, bars, blocked_cells, independent_cells, rectangles};
pub use seen_corners::seen_corners;
pub use sight::Sight;
pub use text::{parse_text_map, read_text_map, to_text_map};

/// The longest side that is accepted, in cells.
pub const MAX_SIDE_CELLS: u32 = 65_535;

/// The most nodes along one side of a lattice in space.
pub const MAX_SIDE_NODES: u32 = 1023;

/// The most cells of one grid, and the most nodes of one lattice in space: beyond them a search fills the memory.
pub const MAX_CELLS: u32 = 1 << 24;

/// A dense occupancy grid.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Grid2 {
    width: u32,
    height: u32,
    blocked: Vec<bool>,
}

/// Refuses a grid of this size, before anything of its size is made.
fn check_size(width: u32, height: u32) -> Result<(), GridError> {
    let accepted = 1..=MAX_SIDE_CELLS;
    let cells = u64::from(width) * u64::from(height);
    if !accepted.contains(&width) || !accepted.contains(&height) || cells > u64::from(MAX_CELLS) {
        return Err(GridError::Size { width, height });
    }
    Ok(())
}

impl Grid2 {
    /// A grid whose cells are all free.
    ///
    /// # Errors
    /// [`GridError::Size`] unless both sides lie in 1..=[`MAX_SIDE_CELLS`] and their product is at most [`MAX_CELLS`].
    pub fn new(width: u32, height: u32) -> Result<Self, GridError> {
        check_size(width, height)?;
        Ok(Self { width, height, blocked: vec![false; width as usize * height as usize] })
    }

    /// Number of columns.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Number of rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Number of cells, free or not.
    pub fn cell_count(&self) -> u32 {
        self.width * self.height
    }

    /// Whether column `x`, row `y` is inside the grid.
    #[inline]
    pub fn holds(&self, x: i32, y: i32) -> bool {
        // A negative number is far beyond any side once its sign is read as a digit.
        (x as u32) < self.width && (y as u32) < self.height
    }

    /// The cell at column `x` and row `y`, or `None` outside the grid.
    #[inline]
    pub fn cell(&self, x: i32, y: i32) -> Option<u32> {
        self.holds(x, y).then(|| y as u32 * self.width + x as u32)
    }

    /// Column and row of `cell`.
    pub fn xy(&self, cell: u32) -> [i32; 2] {
        [(cell % self.width) as i32, (cell / self.width) as i32]
    }

    /// Whether `cell` can be stood on.
    ///
    /// # Panics
    /// If `cell` is outside the grid.
    pub fn is_free(&self, cell: u32) -> bool {
        !self.blocked[cell as usize]
    }

    /// Column and row of every blocked cell, one after another, in the order of cells.
    pub fn blocked_xy(&self) -> Vec<f64> {
        let cells = (0..self.cell_count()).filter(|cell| !self.is_free(*cell));
        cells.flat_map(|cell| self.xy(cell).map(f64::from)).collect()
    }

    /// Whether column `x`, row `y` is inside the grid and free.
    pub fn is_free_xy(&self, x: i32, y: i32) -> bool {
        self.cell(x, y).is_some_and(|cell| self.is_free(cell))
    }

    /// Which cells of row `y` are blocked, by column; nothing outside the grid.
    pub(super) fn blocked_row(&self, y: i32) -> &[bool] {
        let width = self.width as usize;
        if self.holds(0, y) { &self.blocked[y as usize * width..][..width] } else { &[] }
    }

    /// Marks `cell` as blocked or free.
    ///
    /// # Panics
    /// If `cell` is outside the grid.
    pub fn set_blocked(&mut self, cell: u32, blocked: bool) {
        self.blocked[cell as usize] = blocked;
    }

    /// Number of free cells.
    pub fn free_count(&self) -> u32 {
        self.blocked.iter().filter(|&&blocked| !blocked).count() as u32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_row_major_from_the_lower_left() {
        let grid = Grid2::new(5, 3).unwrap();
        assert_eq!(grid.cell(0, 0), Some(0));
        assert_eq!(grid.cell(4, 0), Some(4));
        assert_eq!(grid.cell(0, 1), Some(5));
        for cell in 0..grid.cell_count() {
            let [x, y] = grid.xy(cell);
            assert_eq!(grid.cell(x, y), Some(cell));
        }
        for (x, y) in [(-1, 0), (0, -1), (5, 0), (0, 3)] {
            assert_eq!(grid.cell(x, y), None, "({x}, {y})");
            assert!(!grid.is_free_xy(x, y), "({x}, {y}) is outside");
        }
    }

    #[test]
    fn a_grid_without_cells_is_refused() {
        let error = Grid2::new(0, 3).unwrap_err();
        assert_eq!(
            error.to_string(),
            "a grid of 0 × 3 cells; each side may have 1 to 65535 cells, and all may have 16777216"
        );
        assert!(Grid2::new(3, 65_536).is_err());
    }
}
