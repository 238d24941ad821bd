//! Random maps: independent cells, rectangles, bars.
//!
//! Each map is a function of its stream alone. Cells listed in `keep_free` are freed after everything else was
//! drawn, so that the list moves no draw.

use super::{Grid2, GridError};
use crate::seed::Stream;
use rand::RngExt as _;

/// Which cells of a map are blocked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Blocking {
    /// Each with this probability, independently.
    Independent(f64),
    /// So many, all sets of as many cells alike; all of them, if they are fewer.
    Count(u32),
    /// Those that are hit by so many draws with replacement.
    Draws(u32),
}

/// A `size_cells` = [width, height] map whose cells are blocked as `blocking` has it, but for those within `border_cells` of the rim.
///
/// # Errors
/// [`GridError::Size`] as for [`Grid2::new`].
///
/// # Panics
/// If a probability is not in 0..=1, draws are to hit a map that is all border, or `keep_free` names a cell outside.
pub fn blocked_cells(
    stream: &mut Stream,
    size_cells: [u32; 2],
    blocking: Blocking,
    border_cells: u32,
    keep_free: &[u32],
) -> Result<Grid2, GridError> {
    let [width, height] = size_cells;
    let mut grid = Grid2::new(width, height)?;
    let inner_of = |side: u32| border_cells..side.saturating_sub(border_cells);
    let row = |y: u32| inner_of(width).map(move |x| y * width + x);
    let mut inner: Vec<u32> = inner_of(height).flat_map(row).collect();
    match blocking {
        Blocking::Independent(share) => {
            for cell in inner {
                grid.set_blocked(cell, stream.random_bool(share));
            }
        }
        Blocking::Count(count) => {
            for place in 0..inner.len().min(count as usize) {
                let drawn = stream.random_range(place as u32..inner.len() as u32);
                inner.swap(place, drawn as usize);
                grid.set_blocked(inner[place], true);
            }
        }
        Blocking::Draws(count) => {
            for _ in 0..count {
                grid.set_blocked(inner[stream.random_range(0..inner.len() as u32) as usize], true);
            }
        }
    }
    free(&mut grid, keep_free);
    Ok(grid)
}

/// A `size_cells` = [width, height] map whose cells are blocked independently with probability `blocked_share`.
///
/// # Errors
/// [`GridError::Size`] as for [`Grid2::new`].
///
/// # Panics
/// If `blocked_share` is not in 0..=1 or `keep_free` names a cell outside.
pub fn independent_cells(
    stream: &mut Stream,
    size_cells: [u32; 2],
    blocked_share: f64,
    keep_free: &[u32],
) -> Result<Grid2, GridError> {
    blocked_cells(stream, size_cells, Blocking::Independent(blocked_share), 0, keep_free)
}

/// A map with `count` filled rectangles whose sides are uniform in `side_cells` = [least, most] and whose lower
/// left corner is uniform in the grid; they may overlap, and what sticks out is cut off.
///
/// # Errors
/// [`GridError::Size`] as for [`Grid2::new`].
///
/// # Panics
/// If `side_cells` is not 1 ≤ least ≤ most or `keep_free` names a cell outside.
pub fn rectangles(
    stream: &mut Stream,
    size_cells: [u32; 2],
    count: u32,
    side_cells: [u32; 2],
    keep_free: &[u32],
) -> Result<Grid2, GridError> {
    let mut grid = Grid2::new(size_cells[0], size_cells[1])?;
    for _ in 0..count {
        let corner = [stream.random_range(0..size_cells[0]), stream.random_range(0..size_cells[1])];
        let sides = [0, 1].map(|_| stream.random_range(side_cells[0]..=side_cells[1]));
        fill(&mut grid, corner, sides);
    }
    free(&mut grid, keep_free);
    Ok(grid)
}

/// A map with `count` bars one cell thick, lying or standing with equal chance. Lengths are uniform in `length_cells` =
/// [least, most], and lower left ends in the grid. Bars may cross and are cut at the rim.
///
/// # Errors
/// [`GridError::Size`] as for [`Grid2::new`].
///
/// # Panics
/// If `length_cells` is not 1 ≤ least ≤ most or `keep_free` names a cell outside.
pub fn bars(
    stream: &mut Stream,
    size_cells: [u32; 2],
    count: u32,
    length_cells: [u32; 2],
    keep_free: &[u32],
) -> Result<Grid2, GridError> {
    let mut grid = Grid2::new(size_cells[0], size_cells[1])?;
    for _ in 0..count {
        let corner = [stream.random_range(0..size_cells[0]), stream.random_range(0..size_cells[1])];
        let length = stream.random_range(length_cells[0]..=length_cells[1]);
        let sides = if stream.random_bool(0.5) { [length, 1] } else { [1, length] };
        fill(&mut grid, corner, sides);
    }
    free(&mut grid, keep_free);
    Ok(grid)
}

fn fill(grid: &mut Grid2, corner: [u32; 2], sides: [u32; 2]) {
    for y in corner[1]..(corner[1].saturating_add(sides[1])).min(grid.height()) {
        for x in corner[0]..(corner[0].saturating_add(sides[0])).min(grid.width()) {
            grid.set_blocked(y * grid.width() + x, true);
        }
    }
}

fn free(grid: &mut Grid2, cells: &[u32]) {
    for &cell in cells {
        grid.set_blocked(cell, false);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::seed;

    #[test]
    fn cells_are_blocked_in_the_share_wanted() {
        let grid = independent_cells(&mut seed::stream(4), [200, 200], 0.3, &[]).unwrap();
        let blocked = f64::from(grid.cell_count() - grid.free_count()) / f64::from(grid.cell_count());
        assert!((blocked - 0.3).abs() < 0.01, "seed 4: {blocked}"); // four standard errors
    }

    #[test]
    fn cells_are_blocked_by_chance_by_count_or_by_draws_and_never_on_the_border() {
        let mut seen = [0.0; 3];
        for seed in 0..50 {
            let draw = |blocking| blocked_cells(&mut seed::stream(seed), [30, 20], blocking, 2, &[]).unwrap();
            let grids = [Blocking::Independent(0.4), Blocking::Count(160), Blocking::Draws(160)].map(draw);
            for (grid, seen) in grids.iter().zip(&mut seen) {
                *seen += f64::from(grid.cell_count() - grid.free_count()) / 50.0;
                let is_border = |[x, y]: [i32; 2]| x < 2 || y < 2 || x >= 28 || y >= 18;
                let border = (0..600).filter(|cell| is_border(grid.xy(*cell)));
                assert!(border.into_iter().all(|cell| grid.is_free(cell)), "seed {seed}");
            }
            assert_eq!(grids[1].free_count(), 600 - 160, "seed {seed}");
        }
        // Of 416 cells: 0.4 of them, and 1 - (1 - 1/416)^160 of them; four standard errors of 50 maps.
        assert!((seen[0] - 166.4).abs() < 5.7, "{seen:?}");
        assert!((seen[2] - 132.9).abs() < 2.9, "{seen:?}");
        let all = blocked_cells(&mut seed::stream(1), [5, 4], Blocking::Count(99), 1, &[]).unwrap();
        assert_eq!(all.free_count(), 14, "no more than there are");
    }

    #[test]
    fn what_is_kept_free_moves_no_other_cell() {
        let draw = |keep: &[u32]| {
            [
                independent_cells(&mut seed::stream(5), [20, 30], 0.5, keep).unwrap(),
                rectangles(&mut seed::stream(5), [20, 30], 30, [2, 7], keep).unwrap(),
                bars(&mut seed::stream(5), [20, 30], 60, [3, 9], keep).unwrap(),
            ]
        };
        for (mut drawn, kept) in draw(&[]).into_iter().zip(draw(&[0, 123, 599])) {
            assert!((100..500).contains(&drawn.free_count()), "{} free", drawn.free_count());
            free(&mut drawn, &[0, 123, 599]);
            assert_eq!(drawn, kept);
        }
    }

    #[test]
    fn one_bar_is_one_cell_thick_and_one_rectangle_has_its_sides() {
        for seed in 0..50 {
            let bar = bars(&mut seed::stream(seed), [40, 40], 1, [4, 4], &[]).unwrap();
            assert!((1..=4).contains(&(1600 - bar.free_count())), "seed {seed}");
            let rectangle = rectangles(&mut seed::stream(seed), [40, 40], 1, [3, 3], &[]).unwrap();
            assert!((1..=9).contains(&(1600 - rectangle.free_count())), "seed {seed}");
        }
    }
}
