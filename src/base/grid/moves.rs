//! Legal moves of an 8-connected grid, one byte a cell.

use super::Grid2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The eight steps `[dx, dy]` in the order of masks, which is also the default order of neighbours.
///
/// Bit `i` of a move mask stands for `DIRECTIONS[i]`; `DIRECTIONS[7 - i]` is its reverse.
pub const DIRECTIONS: [[i32; 2]; 8] = [[1, 1], [1, 0], [1, -1], [0, 1], [0, -1], [-1, 1], [-1, 0], [-1, -1]];

/// When a diagonal move is refused because of the two cells that flank it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
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
    pub const fn permits(self, flanks_free: [bool; 2]) -> bool {
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
        let masks_of = &MASKS[corners as usize];
        let mut masks = Vec::with_capacity(grid.cell_count() as usize);
        for y in 0..grid.height() as i32 {
            let rows = [-1, 0, 1].map(|dy| grid.blocked_row(y + dy));
            let column = |x: usize| {
                let free = |row: &[bool]| usize::from(row.get(x).is_some_and(|blocked| !blocked));
                free(rows[0]) | free(rows[1]) << 1 | free(rows[2]) << 2
            };
            // Three columns of three bits; the cell in hand is in the middle.
            let mut around = column(0) << 6;
            for x in 0..grid.width() as usize {
                around = around >> 3 | column(x + 1) << 6;
                masks.push(masks_of[around]);
            }
        }
        Self { width: grid.width(), masks }
    }

    /// Moves that something besides cells and corners decides, a mask a cell, row by row.
    ///
    /// # Panics
    /// If the masks do not fill whole rows, or a move has no reverse.
    pub fn from_masks(width: u32, masks: Vec<u8>) -> Self {
        assert!(masks.len().is_multiple_of(width as usize), "{} masks in rows of {width}", masks.len());
        let moves = Self { width, masks };
        let steps = DIRECTIONS.map(|[dx, dy]| dy * width as i32 + dx);
        for cell in 0..moves.cell_count() {
            let mut left = moves.mask(cell);
            while left != 0 {
                let bit = left.trailing_zeros() as usize;
                left &= left - 1;
                let back = moves.mask(cell.wrapping_add_signed(steps[bit])) >> (7 - bit);
                assert!(back & 1 == 1, "a move from {cell} has no reverse");
            }
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
        let mask = self.mask(cell);
        let width = self.width as i32;
        DIRECTIONS
            .iter()
            .enumerate()
            .filter(move |(bit, _)| mask >> bit & 1 == 1)
            .map(move |(_, &[dx, dy])| (cell.wrapping_add_signed(dy * width + dx), dx != 0 && dy != 0))
    }
}

/// The mask of a cell by its corner rule and by which cells around it are free: bit `3 (dx + 1) + dy + 1`.
static MASKS: [[u8; 512]; 3] =
    [masks(CornerRule::Allow), masks(CornerRule::ForbidBoth), masks(CornerRule::ForbidAny)];

const fn masks(corners: CornerRule) -> [u8; 512] {
    const fn is_free(around: usize, dx: i32, dy: i32) -> bool {
        around >> (3 * (dx + 1) + dy + 1) & 1 == 1
    }
    let mut masks = [0; 512];
    let mut around = 0;
    while around < 512 {
        let mut bit = 0;
        while bit < 8 {
            let [dx, dy] = DIRECTIONS[bit];
            let flanks_free = [is_free(around, dx, 0), is_free(around, 0, dy)];
            let is_straight = dx == 0 || dy == 0;
            let is_legal = is_free(around, 0, 0)
                && is_free(around, dx, dy)
                && (is_straight || corners.permits(flanks_free));
            masks[around] |= (is_legal as u8) << bit;
            bit += 1;
        }
        around += 1;
    }
    masks
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
    fn masks_are_what_each_cell_and_its_flanks_say() {
        let mut legal = 0;
        for seed in 0..60 {
            let size = [[1, 1], [1, 6], [6, 1], [9, 7]][seed as usize % 4];
            let grid = independent_cells(&mut seed::stream(seed), size, 0.35, &[]).unwrap();
            for rule in [CornerRule::Allow, CornerRule::ForbidBoth, CornerRule::ForbidAny] {
                let moves = Moves::new(&grid, rule);
                for cell in 0..grid.cell_count() {
                    let [x, y] = grid.xy(cell);
                    for (bit, [dx, dy]) in DIRECTIONS.into_iter().enumerate() {
                        let flanks_free = [grid.is_free_xy(x + dx, y), grid.is_free_xy(x, y + dy)];
                        let may_turn = dx == 0 || dy == 0 || rule.permits(flanks_free);
                        let expected = grid.is_free(cell) && grid.is_free_xy(x + dx, y + dy) && may_turn;
                        let found = moves.mask(cell) >> bit & 1 == 1;
                        assert_eq!(found, expected, "seed {seed}, {rule:?}, [{x}, {y}] by [{dx}, {dy}]");
                        legal += u32::from(expected);
                    }
                }
            }
        }
        assert!(legal > 2_000, "only {legal} legal moves drawn");
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
