//! Legal moves of an 8-connected grid, one byte a cell.

use super::Grid2;

/// The eight steps `[dx, dy]` in the order of masks, which is also the default order of neighbours.
///
/// Bit `i` of a move mask stands for `DIRECTIONS[i]`; `DIRECTIONS[7 - i]` is its reverse.
pub const DIRECTIONS: [[i32; 2]; 8] = [[1, 1], [1, 0], [1, -1], [0, 1], [0, -1], [-1, 1], [-1, 0], [-1, -1]];

/// When a diagonal move is refused because of the two cells that flank it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CornerRule {
    /// Never.
    Allow,
    /// When both flank cells are blocked: no squeezing between two corners that touch.
    ForbidBoth,
    /// When at least one is blocked: no cutting of corners. Cells outside the grid flank no legal move.
    ForbidAny,
}

impl CornerRule {
    /// Whether a diagonal move between two cells that flank it is legal, given which of them are free.
    pub fn permits(self, flanks_free: [bool; 2]) -> bool {
        match self {
            CornerRule::Allow => true,
            CornerRule::ForbidBoth => flanks_free[0] || flanks_free[1],
            CornerRule::ForbidAny => flanks_free[0] && flanks_free[1],
        }
    }
}

/// The legal moves of every cell under one corner rule. Moves are symmetric: a move is legal iff its reverse is.
#[derive(Clone, Debug)]
pub struct Moves {
    width: u32,
    masks: Vec<u8>,
}

impl Moves {
    /// The legal moves of `grid`; a blocked cell has none.
    pub fn new(grid: &Grid2, corners: CornerRule) -> Self {
        let masks = (0..grid.cell_count()).map(|cell| mask(grid, corners, cell)).collect();
        Self { width: grid.width(), masks }
    }

    /// Moves that something besides cells and corners decides, a mask a cell, row by row.
    ///
    /// # Panics
    /// If the masks do not fill whole rows, or a move has no reverse.
    pub fn from_masks(width: u32, masks: Vec<u8>) -> Self {
        assert!(masks.len().is_multiple_of(width as usize), "{} masks in rows of {width}", masks.len());
        let moves = Self { width, masks };
        for cell in 0..moves.cell_count() {
            let has_reverse = |to: u32| moves.from_cell(to).any(|(back, _)| back == cell);
            assert!(
                moves.from_cell(cell).all(|(to, _)| has_reverse(to)),
                "a move from {cell} has no reverse"
            );
        }
        moves
    }

    /// Number of columns of the grid.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Number of cells of the grid.
    pub fn cell_count(&self) -> u32 {
        self.masks.len() as u32
    }

    /// The mask of `cell`: bit `i` is set iff the step `DIRECTIONS[i]` is legal from it.
    ///
    /// # Panics
    /// If `cell` is outside the grid.
    pub fn mask(&self, cell: u32) -> u8 {
        self.masks[cell as usize]
    }

    /// The cells reached from `cell` in one legal move, in the order of [`DIRECTIONS`], each with whether the move
    /// is diagonal.
    pub fn from_cell(&self, cell: u32) -> impl Iterator<Item = (u32, bool)> {
        let (mask, width) = (self.mask(cell), self.width as i32);
        DIRECTIONS
            .iter()
            .enumerate()
            .filter(move |(bit, _)| mask >> bit & 1 == 1)
            .map(move |(_, &[dx, dy])| (cell.wrapping_add_signed(dy * width + dx), dx != 0 && dy != 0))
    }
}

fn mask(grid: &Grid2, corners: CornerRule, cell: u32) -> u8 {
    if !grid.is_free(cell) {
        return 0;
    }
    let [x, y] = grid.xy(cell);
    let mut mask = 0;
    for (bit, [dx, dy]) in DIRECTIONS.into_iter().enumerate() {
        let diagonal = dx != 0 && dy != 0;
        let flanks_free = [grid.is_free_xy(x + dx, y), grid.is_free_xy(x, y + dy)];
        let legal = grid.is_free_xy(x + dx, y + dy) && (!diagonal || corners.permits(flanks_free));
        mask |= u8::from(legal) << bit;
    }
    mask
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::{independent_cells, parse_text_map};
    use crate::seed;

    #[test]
    fn each_corner_rule_decides_the_move_between_flanks() {
        let up_right = |map: &str, rule| Moves::new(&parse_text_map(map).unwrap(), rule).mask(0) & 1 == 1;
        for (map, legal) in [
            ("..\n..\n", [true, true, true]),
            ("#.\n..\n", [true, true, false]),
            ("..\n.#\n", [true, true, false]),
            ("#.\n.#\n", [true, false, false]),
            (".#\n..\n", [false, false, false]),
        ] {
            let rules = [CornerRule::Allow, CornerRule::ForbidBoth, CornerRule::ForbidAny];
            assert_eq!(rules.map(|rule| up_right(map, rule)), legal, "{map}");
        }
    }

    #[test]
    fn a_move_is_legal_iff_its_reverse_is() {
        let mut legal = 0;
        for seed in 0..30 {
            let grid = independent_cells(&mut seed::stream(seed), [9, 7], 0.35, &[]).unwrap();
            for rule in [CornerRule::Allow, CornerRule::ForbidBoth, CornerRule::ForbidAny] {
                let moves = Moves::new(&grid, rule);
                for cell in 0..grid.cell_count() {
                    for (to, diagonal) in moves.from_cell(cell) {
                        legal += 1;
                        let back = moves.from_cell(to).any(|reverse| reverse == (cell, diagonal));
                        assert!(back, "seed {seed}, {rule:?}: {cell} to {to} has no reverse");
                    }
                }
            }
        }
        assert!(legal > 5_000, "only {legal} legal moves drawn");
        for (i, [dx, dy]) in DIRECTIONS.into_iter().enumerate() {
            assert_eq!(DIRECTIONS[7 - i], [-dx, -dy]);
        }
    }
}
