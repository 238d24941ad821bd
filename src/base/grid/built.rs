//! Random maps with an order: rooms, streets, mazes.
//!
//! Each map is a function of its stream alone.

use super::{Grid2, GridError};
use crate::seed::Stream;
use rand::RngExt as _;

/// A `size_cells` = [width, height] map of square rooms with sides of `room_cells` and walls one cell thick; each wall
/// between two rooms has a door of one cell with probability `door_share`, anywhere along it.
///
/// # Errors
/// [`GridError::Size`] as for [`Grid2::new`].
///
/// # Panics
/// If `room_cells` is 0 or `door_share` is not in 0..=1.
pub fn rooms(
    stream: &mut Stream,
    size_cells: [u32; 2],
    room_cells: u32,
    door_share: f64,
) -> Result<Grid2, GridError> {
    assert!(room_cells > 0, "rooms of no cell");
    let mut grid = Grid2::new(size_cells[0], size_cells[1])?;
    let pitch = room_cells + 1;
    for cell in 0..grid.cell_count() {
        let [x, y] = [cell % grid.width(), cell / grid.width()];
        grid.set_blocked(cell, x % pitch == room_cells || y % pitch == room_cells);
    }
    for (y, x) in (0..grid.height())
        .step_by(pitch as usize)
        .flat_map(|y| (0..size_cells[0]).step_by(pitch as usize).map(move |x| (y, x)))
    {
        // The wall to the right of this room, then the one above it.
        for [dx, dy] in [[1, 0], [0, 1]] {
            let along = stream.random_range(0..room_cells);
            let has_door = stream.random_bool(door_share);
            let door = [x + dx * room_cells + dy * along, y + dy * room_cells + dx * along];
            if has_door && let Some(cell) = grid.cell(door[0] as i32, door[1] as i32) {
                grid.set_blocked(cell, false);
            }
        }
    }
    Ok(grid)
}

/// A map of blocks between crossing streets `street_cells` wide. Sides of blocks are uniform in `block_cells` = [least,
/// most], the same along a street. Each block draws back from each of its streets by up to `setback_cells`.
///
/// # Errors
/// [`GridError::Size`] as for [`Grid2::new`].
///
/// # Panics
/// If `block_cells` is not 1 ≤ least ≤ most.
pub fn streets(
    stream: &mut Stream,
    size_cells: [u32; 2],
    block_cells: [u32; 2],
    street_cells: u32,
    setback_cells: u32,
) -> Result<Grid2, GridError> {
    let mut grid = Grid2::new(size_cells[0], size_cells[1])?;
    let bands = size_cells.map(|size| {
        let mut bands = Vec::new();
        let mut at = street_cells;
        while at < size {
            let side = stream.random_range(block_cells[0]..=block_cells[1]);
            bands.push([at, (at + side).min(size)]);
            at += side + street_cells;
        }
        bands
    });
    for row in &bands[1] {
        for column in &bands[0] {
            let back = [0; 4].map(|_: u32| stream.random_range(0..=setback_cells));
            for y in row[0] + back[0]..row[1].saturating_sub(back[1]) {
                for x in column[0] + back[2]..column[1].saturating_sub(back[3]) {
                    grid.set_blocked(y * size_cells[0] + x, true);
                }
            }
        }
    }
    Ok(grid)
}

/// A maze with corridors one cell wide and exactly one way between any two of their cells: depth first from cell (0, 0).
/// Corridors lie on even rows and columns; what is left of even sides is wall.
///
/// # Errors
/// [`GridError::Size`] as for [`Grid2::new`].
pub fn maze(stream: &mut Stream, size_cells: [u32; 2]) -> Result<Grid2, GridError> {
    let mut grid = Grid2::new(size_cells[0], size_cells[1])?;
    (0..grid.cell_count()).for_each(|cell| grid.set_blocked(cell, true));
    grid.set_blocked(0, false);
    let mut trail = vec![[0, 0]];
    while let Some(&[x, y]) = trail.last() {
        let ways: Vec<[i32; 2]> = [[1, 0], [0, 1], [-1, 0], [0, -1]]
            .into_iter()
            .filter(|[dx, dy]| grid.cell(x + 2 * dx, y + 2 * dy).is_some_and(|cell| !grid.is_free(cell)))
            .collect();
        if ways.is_empty() {
            trail.pop();
            continue;
        }
        let [dx, dy] = ways[stream.random_range(0..ways.len())];
        for far in [1, 2] {
            let cell = grid.cell(x + far * dx, y + far * dy).expect("its far end is in the grid");
            grid.set_blocked(cell, false);
        }
        trail.push([x + 2 * dx, y + 2 * dy]);
    }
    Ok(grid)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::{CornerRule, Moves, components};
    use crate::seed;

    fn parts(grid: &Grid2) -> Vec<u32> {
        components(grid, &Moves::new(grid, CornerRule::ForbidAny)).sizes().to_vec()
    }

    #[test]
    fn a_room_without_doors_is_a_part_of_its_own() {
        let shut = rooms(&mut seed::stream(1), [19, 14], 4, 0.0).unwrap();
        assert_eq!(parts(&shut), [16; 12]);
        let open = rooms(&mut seed::stream(1), [19, 14], 4, 1.0).unwrap();
        assert_eq!(parts(&open), [12 * 16 + 3 * 3 + 2 * 4], "and every door is one cell");
    }

    #[test]
    fn streets_meet_and_blocks_fill_what_lies_between() {
        for seed in 0..20 {
            let tight = streets(&mut seed::stream(seed), [60, 50], [4, 9], 3, 0).unwrap();
            assert_eq!(parts(&tight), [tight.free_count()], "seed {seed}");
            let wide = streets(&mut seed::stream(seed), [60, 50], [4, 9], 3, 2).unwrap();
            assert!(wide.free_count() > tight.free_count() + 100, "seed {seed}: blocks draw back");
        }
    }

    #[test]
    fn a_maze_has_one_way_between_any_two_cells() {
        for seed in 0..20 {
            let grid = maze(&mut seed::stream(seed), [31, 21]).unwrap();
            let moves = Moves::new(&grid, CornerRule::ForbidAny);
            let ends: usize = (0..grid.cell_count()).map(|cell| moves.from_cell(cell).count()).sum();
            // A tree has one edge fewer than nodes, and every edge two ends.
            assert_eq!(ends, 2 * (grid.free_count() as usize - 1), "seed {seed}");
            assert_eq!(parts(&grid), [16 * 11 * 2 - 1], "seed {seed}: every even cell is reached");
        }
    }
}
