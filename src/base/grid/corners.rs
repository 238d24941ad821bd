//! Grids whose vertices are the corners of cells.
//!
//! A map of `width × height` cells has `(width + 1) × (height + 1)` corners; corner (x, y) is the lower left one of cell (x, y). A
//! segment between two corners is clear if it neither crosses the interior of a blocked cell nor runs between two blocked cells that
//! share an edge. It may pass between two blocked cells that touch at a corner. What lies outside the map counts as blocked.
//!
//! # Source
//! Daniel, Nash, Koenig & Felner, *Theta\*: Any-Angle Path Planning on Grids*, JAIR 39 (2010), section 2.

use super::{DIRECTIONS, Grid2, Moves};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Where the vertices of a grid are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Vertices {
    /// In the middle of cells: a vertex is a cell.
    #[default]
    Centres,
    /// At the corners of cells.
    Corners,
}

/// The corners of `cells` as a grid of their own: a corner is blocked if no free cell touches it.
pub fn corner_vertices(cells: &Grid2) -> Grid2 {
    let [width, height] = [cells.width() + 1, cells.height() + 1];
    let blocked = all_around(cells).into_iter().map(|free| free == 0).collect();
    Grid2 { width, height, blocked }
}

/// The legal moves from corner to corner: along an edge beside which a cell is free, and across a free cell.
pub fn corner_moves(cells: &Grid2) -> Moves {
    let masks = all_around(cells).into_iter().map(|free| MASKS[usize::from(free)]).collect();
    Moves::from_masks(cells.width() + 1, masks)
}

/// Whether corner `to` of `cells` is seen from corner `from`, with no cells outside the map.
///
/// # Panics
/// If one of them is not a corner of the map.
pub fn corners_see(cells: &Grid2, from: [i32; 2], to: [i32; 2]) -> bool {
    let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
    let [low_x, low_y] = [from[0].min(to[0]), from[1].min(to[1])];
    if dx == 0 {
        return (0..dy.abs()).all(|i| is_open(cells, [from[0] - 1, low_y + i], [from[0], low_y + i]));
    }
    if dy == 0 {
        return (0..dx.abs()).all(|i| is_open(cells, [low_x + i, from[1] - 1], [low_x + i, from[1]]));
    }
    let [across, up] = [i64::from(dx.abs()), i64::from(dy.abs())];
    let width = cells.width as isize;
    let step = [dx.signum() as isize, dy.signum() as isize * width];
    // The first cell on the way; every other is within the rectangle that both corners span.
    let first = [from[0] - i32::from(dx < 0), from[1] - i32::from(dy < 0)];
    let mut at = first[1] as isize * width + first[0] as isize;
    let mut left = [across - 1, up - 1];
    // Below zero where the next vertical grid line is met before the next horizontal one, zero where both are: at a corner.
    let mut order = up - across;
    while !cells.blocked[at as usize] {
        if left == [0, 0] {
            return true;
        }
        let (crosses_vertical, crosses_horizontal) = (order <= 0, order >= 0);
        if crosses_vertical {
            at += step[0];
            left[0] -= 1;
            order += up;
        }
        if crosses_horizontal {
            at += step[1];
            left[1] -= 1;
            order -= across;
        }
    }
    false
}

fn is_open(cells: &Grid2, one: [i32; 2], other: [i32; 2]) -> bool {
    [one, other].iter().any(|[x, y]| cells.is_free_xy(*x, *y))
}

/// Which of the four cells around each corner are free: bits for the upper right, the lower right, the upper left, the lower left one.
fn all_around(cells: &Grid2) -> Vec<u8> {
    let mut all = Vec::with_capacity((cells.width() as usize + 1) * (cells.height() as usize + 1));
    for y in 0..=cells.height() as i32 {
        let [upper, lower] = [cells.blocked_row(y), cells.blocked_row(y - 1)];
        let is_free = |row: &[bool], x: usize| u8::from(row.get(x).is_some_and(|blocked| !blocked));
        let mut left = 0;
        for x in 0..=cells.width() as usize {
            let right = is_free(upper, x) | is_free(lower, x) << 1;
            all.push(left << 2 | right);
            left = right;
        }
    }
    all
}

/// The moves from a corner, by which cells around it are free.
static MASKS: [u8; 16] = {
    let mut masks = [0; 16];
    let mut free = 0;
    while free < 16 {
        let mut bit = 0;
        while bit < 8 {
            let [dx, dy] = DIRECTIONS[bit];
            // The cells beside the step, as bits of what is free around the corner.
            let right = 0b0011;
            let upper = 0b0101;
            let columns = if dx == 0 {
                15
            } else if dx > 0 {
                right
            } else {
                right ^ 15
            };
            let rows = if dy == 0 {
                15
            } else if dy > 0 {
                upper
            } else {
                upper ^ 15
            };
            masks[free] |= ((free & columns & rows != 0) as u8) << bit;
            bit += 1;
        }
        free += 1;
    }
    masks
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::{independent_cells, parse_text_map};
    use crate::seed;

    /// Whether the segment crosses no blocked cell and runs between no two, by points on it. Every grid line that it meets cuts it into
    /// pieces. The middle of each piece lies in one cell, or on an edge between two. Coordinates are multiplied by 2 dx dy.
    fn is_clear(cells: &Grid2, from: [i32; 2], to: [i32; 2]) -> bool {
        let [dx, dy] = [i64::from(to[0] - from[0]), i64::from(to[1] - from[1])];
        // Where along the way grid lines are met, in parts of |dx dy|.
        let whole = dx.abs().max(1) * dy.abs().max(1);
        let mut cuts: Vec<i64> = (0..=dx.abs()).map(|i| i * whole / dx.abs().max(1)).collect();
        cuts.extend((0..=dy.abs()).map(|i| i * whole / dy.abs().max(1)));
        cuts.extend([0, whole]);
        cuts.sort_unstable();
        cuts.dedup();
        cuts.windows(2).all(|two| {
            let middle = |axis: usize| 2 * whole * i64::from(from[axis]) + (two[0] + two[1]) * [dx, dy][axis];
            let cells_at = |axis: usize| {
                let cell = middle(axis).div_euclid(2 * whole) as i32;
                if middle(axis).rem_euclid(2 * whole) == 0 { vec![cell - 1, cell] } else { vec![cell] }
            };
            cells_at(0).iter().any(|x| cells_at(1).iter().any(|y| cells.is_free_xy(*x, *y)))
        })
    }

    #[test]
    fn a_corner_sees_what_no_blocked_cell_hides() {
        let [mut seen, mut hidden] = [0, 0];
        for seed in 0..30 {
            let cells = independent_cells(&mut seed::stream(seed), [6, 5], 0.25, &[]).unwrap();
            let corners: Vec<[i32; 2]> = (0..42).map(|corner| [corner % 7, corner / 7]).collect();
            let pairs = corners.iter().flat_map(|a| corners.iter().map(move |b| (*a, *b)));
            for (from, to) in pairs.filter(|(from, to)| from != to) {
                let expected = is_clear(&cells, from, to);
                assert_eq!(
                    corners_see(&cells, from, to),
                    expected,
                    "seed {seed}: {from:?} to {to:?}\n{cells:?}"
                );
                *(if expected { &mut seen } else { &mut hidden }) += 1;
            }
        }
        assert!(seen > 5_000 && hidden > 5_000, "{seen} seen, {hidden} hidden");
    }

    #[test]
    fn moves_from_corner_to_corner_are_those_in_sight() {
        let mut legal = 0;
        for seed in 0..40 {
            let cells = independent_cells(&mut seed::stream(seed), [7, 6], 0.4, &[]).unwrap();
            let moves = corner_moves(&cells);
            let vertices = corner_vertices(&cells);
            for corner in 0..vertices.cell_count() {
                let [x, y] = vertices.xy(corner);
                assert_eq!(vertices.is_free(corner), moves.mask(corner) != 0, "seed {seed}: [{x}, {y}]");
                for (bit, [dx, dy]) in DIRECTIONS.into_iter().enumerate() {
                    let to = [x + dx, y + dy];
                    let expected = vertices.cell(to[0], to[1]).is_some() && corners_see(&cells, [x, y], to);
                    assert_eq!(
                        moves.mask(corner) >> bit & 1 == 1,
                        expected,
                        "seed {seed}: [{x}, {y}] to {to:?}"
                    );
                    legal += u32::from(expected);
                }
            }
        }
        assert!(legal > 2_000, "only {legal} legal moves drawn");
    }

    #[test]
    fn lines_run_along_single_edges_and_between_diagonal_cells_but_not_between_neighbours() {
        let cells = parse_text_map("..#\n.#.\n##.\n").unwrap();
        for (from, to, expected) in [
            ([1, 3], [3, 1], true),  // between (1, 1) and (2, 2), which touch
            ([0, 1], [2, 1], false), // between (1, 0) and (1, 1)
            ([0, 1], [1, 1], true),
            ([1, 0], [1, 1], false), // between (0, 0) and (1, 0)
            ([2, 0], [2, 2], true),
            ([0, 0], [1, 0], false), // the rim of a blocked cell
            ([0, 3], [0, 1], true),  // the rim of free ones
        ] {
            assert_eq!(corners_see(&cells, from, to), expected, "{from:?} to {to:?}");
        }
    }
}
