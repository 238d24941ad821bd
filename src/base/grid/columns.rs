//! The free cells of a grid as bits, for searches that look at a whole column of neighbours at once.

use super::Grid2;

/// How far a window may reach from its cell, in cells.
pub const MAX_REACH_CELLS: u32 = 20;

/// A set of places, one bit each.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Bits {
    bytes: Vec<u8>,
}

/// How many places a window holds at least: a word, less what lies in its first byte before the first place.
const WINDOW: u32 = u64::BITS - 7;
const _: () = assert!(2 * MAX_REACH_CELLS < WINDOW);

impl Bits {
    /// No place of `count`.
    pub fn none(count: usize) -> Self {
        // A word more, so that a window can begin at the last place.
        Self { bytes: vec![0; count / 8 + size_of::<u64>()] }
    }

    /// Adds `place`.
    #[inline]
    pub fn insert(&mut self, place: u32) {
        self.bytes[place as usize / 8] |= 1 << (place % 8);
    }

    /// The places from `first` on; bit `i` is place `first + i`. It holds at least 57 places.
    #[inline]
    pub fn window(&self, first: u32) -> u64 {
        let word = self.bytes[first as usize / 8..].first_chunk().expect("there is a word at every place");
        u64::from_le_bytes(*word) >> (first % 8)
    }

    /// Removes every place.
    pub fn clear(&mut self) {
        self.bytes.fill(0);
    }
}

/// The free cells of a grid, column by column in the order of [`Offsets`](super::Offsets): x falls, and for each x, y falls.
///
/// Around the cells there are empty places enough for a window of [`MAX_REACH_CELLS`] to either side of every cell.
#[derive(Clone, Debug)]
pub struct Columns {
    size: [u32; 2],
    stride: u32,
    free: Bits,
}

impl Columns {
    /// The columns of `grid`.
    pub fn new(grid: &Grid2) -> Self {
        let size = [grid.width(), grid.height()];
        let stride = grid.height() + MAX_REACH_CELLS;
        let mut columns = Self { size, stride, free: Bits::default() };
        columns.free = Bits::none(columns.place_count());
        for cell in (0..grid.cell_count()).filter(|&cell| grid.is_free(cell)) {
            let place = columns.place(cell);
            columns.free.insert(place);
        }
        columns
    }

    /// Number of columns of the grid.
    pub fn width(&self) -> u32 {
        self.size[0]
    }

    /// Number of cells of the grid.
    pub fn cell_count(&self) -> u32 {
        self.size[0] * self.size[1]
    }

    /// How many places there are.
    pub fn place_count(&self) -> usize {
        (self.size[0] + 2 * MAX_REACH_CELLS) as usize * self.stride as usize + MAX_REACH_CELLS as usize
    }

    /// The place of `cell`.
    #[inline]
    pub fn place(&self, cell: u32) -> u32 {
        let [width, height] = self.size;
        let [column, row] = [width - 1 - cell % width, height - 1 - cell / width];
        (column + MAX_REACH_CELLS) * self.stride + row + MAX_REACH_CELLS
    }

    /// The column and the row of the cell at `place`.
    #[inline]
    pub fn xy(&self, place: u32) -> [u32; 2] {
        let [width, height] = self.size;
        let [column, row] = [place / self.stride, place % self.stride].map(|at| at - MAX_REACH_CELLS);
        [width - 1 - column, height - 1 - row]
    }

    /// What a step by `[dx, dy]` adds to a place.
    pub fn offset(&self, [dx, dy]: [i32; 2]) -> i32 {
        -(dx * self.stride as i32 + dy)
    }

    /// The places of free cells.
    #[inline]
    pub fn free(&self) -> &Bits {
        &self.free
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::{Offsets, independent_cells};
    use crate::seed;

    #[test]
    fn a_window_holds_the_free_cells_of_a_column_with_the_highest_first() {
        let mut free = 0;
        let reach = MAX_REACH_CELLS as i32;
        for seed in 0..20 {
            let size_cells = [3 + seed as u32, 70 - 3 * seed as u32];
            let grid = independent_cells(&mut seed::stream(seed), size_cells, 0.4, &[]).unwrap();
            let columns = Columns::new(&grid);
            for cell in 0..grid.cell_count() {
                let [x, y] = grid.xy(cell);
                assert_eq!(columns.xy(columns.place(cell)).map(|at| at as i32), [x, y], "seed {seed}");
                for dx in -reach..=reach {
                    let first = columns.place(cell).wrapping_add_signed(columns.offset([dx, reach]));
                    let window = columns.free().window(first);
                    for bit in 0..=2 * reach {
                        let is_free = grid.is_free_xy(x + dx, y + reach - bit);
                        assert_eq!(window >> bit & 1 == 1, is_free, "seed {seed}: {cell}, {dx}, bit {bit}");
                        free += u32::from(is_free);
                    }
                }
            }
        }
        assert!(free > 100_000, "only {free} free cells were looked at");
    }

    #[test]
    fn places_rise_in_the_order_of_offsets() {
        let columns = Columns::new(&Grid2::new(9, 9).unwrap());
        let added: Vec<i32> = Offsets::square(4).steps().iter().map(|step| columns.offset(*step)).collect();
        assert!(added.is_sorted(), "{added:?}");
    }
}
