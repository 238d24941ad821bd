//! Line of sight between cell centres, in integers.
//!
//! A segment joins the centres of two cells; it is clear if every cell that the chosen kind counts, both ends
//! included, is inside the grid and free. No floating point is used, so a segment through a corner is seen as
//! that and not as a near miss.

use super::Grid2;
use schemars::JsonSchema;
use serde::Deserialize;

/// Which cells a segment counts as entering. Between corners of cells only `exact_interior` is accepted: a line may run along a blocked
/// cell, but not between two that share an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Sight {
    /// Cells whose interior the segment crosses. Where it passes exactly through the corner between two cells,
    /// neither of the two is entered.
    ExactInterior,
    /// Cells that the segment touches at all: at a corner also the two that flank it.
    ClosedCells,
    /// Cells of Bresenham's line drawn from the first end to the second; the reverse line may differ by a cell
    /// where the segment passes midway between two.
    Bresenham,
}

impl Sight {
    /// Whether `to` is seen from `from`.
    ///
    /// # Panics
    /// If either cell is outside the grid.
    pub fn is_clear(self, grid: &Grid2, from: u32, to: u32) -> bool {
        self.all_cells(grid.xy(from), grid.xy(to), |[x, y]| grid.is_free_xy(x, y))
    }

    /// Whether `accept` holds for every cell entered between the centres of `from` and `to`, called in order from
    /// `from` on and not beyond the first refusal.
    pub fn all_cells(self, from: [i32; 2], to: [i32; 2], accept: impl FnMut([i32; 2]) -> bool) -> bool {
        match self {
            Sight::ExactInterior => walk(from, to, false, accept),
            Sight::ClosedCells => walk(from, to, true, accept),
            Sight::Bresenham => bresenham(from, to, accept),
        }
    }
}

/// Steps through the cells crossed, comparing where the next vertical and the next horizontal grid line are met.
fn walk(from: [i32; 2], to: [i32; 2], with_flanks: bool, mut accept: impl FnMut([i32; 2]) -> bool) -> bool {
    let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
    let (across, up) = (i64::from(dx.abs()), i64::from(dy.abs()));
    let [mut x, mut y] = from;
    let (mut columns, mut rows) = (0, 0);
    if !accept([x, y]) {
        return false;
    }
    while columns < across || rows < up {
        let (vertical, horizontal) = ((1 + 2 * columns) * up, (1 + 2 * rows) * across);
        if with_flanks
            && vertical == horizontal
            && !(accept([x + dx.signum(), y]) && accept([x, y + dy.signum()]))
        {
            return false;
        }
        if vertical <= horizontal {
            x += dx.signum();
            columns += 1;
        }
        if horizontal <= vertical {
            y += dy.signum();
            rows += 1;
        }
        if !accept([x, y]) {
            return false;
        }
    }
    true
}

fn bresenham(from: [i32; 2], to: [i32; 2], mut accept: impl FnMut([i32; 2]) -> bool) -> bool {
    let (across, up) = (i64::from((to[0] - from[0]).abs()), -i64::from((to[1] - from[1]).abs()));
    let step = [(to[0] - from[0]).signum(), (to[1] - from[1]).signum()];
    let [mut x, mut y] = from;
    let mut error = across + up;
    while accept([x, y]) {
        if [x, y] == to {
            return true;
        }
        let doubled = 2 * error;
        if doubled >= up {
            error += up;
            x += step[0];
        }
        if doubled <= across {
            error += across;
            y += step[1];
        }
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    /// Whether the segment from the origin to `to` meets the square of half side 1/2 about `cell`, closed or open,
    /// by clipping in rational numbers: lengths are doubled and parameters compared by cross-multiplication.
    fn meets(to: [i32; 2], cell: [i32; 2], open: bool) -> bool {
        // The clipped interval of the parameter as fractions with positive denominators.
        let (mut low, mut high) = ((0_i64, 1_i64), (1_i64, 1_i64));
        for axis in 0..2 {
            let (d, c) = (2 * i64::from(to[axis]), 2 * i64::from(cell[axis]));
            if d == 0 {
                if c.abs() > 1 || (open && c.abs() == 1) {
                    return false;
                }
                continue;
            }
            let (enter, leave) = if d > 0 { ((c - 1, d), (c + 1, d)) } else { ((-c - 1, -d), (1 - c, -d)) };
            low = if enter.0 * low.1 > low.0 * enter.1 { enter } else { low };
            high = if leave.0 * high.1 < high.0 * leave.1 { leave } else { high };
        }
        let (a, b) = (low.0 * high.1, high.0 * low.1);
        if open { a < b } else { a <= b }
    }

    fn entered(sight: Sight, from: [i32; 2], to: [i32; 2]) -> Vec<[i32; 2]> {
        let mut cells = Vec::new();
        assert!(sight.all_cells(from, to, |cell| {
            cells.push(cell);
            true
        }));
        cells
    }

    #[test]
    fn the_cells_entered_are_those_that_rational_clipping_finds() {
        let mut corners = 0;
        for x in -7..=7_i32 {
            for y in -7..=7_i32 {
                for (sight, open) in [(Sight::ExactInterior, true), (Sight::ClosedCells, false)] {
                    let got: BTreeSet<_> = entered(sight, [0, 0], [x, y]).into_iter().collect();
                    let square = (-8..=8).flat_map(|cx| (-8..=8).map(move |cy| [cx, cy]));
                    // A segment of no length crosses its own cell although its interval is a point.
                    let truth: BTreeSet<_> =
                        square.filter(|&c| c == [0, 0] || meets([x, y], c, open)).collect();
                    assert_eq!(got, truth, "{sight:?} to ({x}, {y})");
                }
                let closed = entered(Sight::ClosedCells, [0, 0], [x, y]).len();
                corners += usize::from(closed > entered(Sight::ExactInterior, [0, 0], [x, y]).len());
            }
        }
        assert!(corners > 40, "only {corners} segments pass through a corner");
    }

    #[test]
    fn bresenhams_cells_lie_within_half_a_cell_of_the_segment() {
        for x in -9..=9_i32 {
            for y in -9..=9_i32 {
                let cells = entered(Sight::Bresenham, [0, 0], [x, y]);
                let longest = x.abs().max(y.abs());
                assert_eq!(cells.len() as i32, longest + 1, "one cell a column or row to ({x}, {y})");
                assert_eq!((cells[0], cells[cells.len() - 1]), ([0, 0], [x, y]));
                for &[cx, cy] in &cells {
                    assert!(
                        (2 * (cx * y - cy * x)).abs() <= longest,
                        "({cx}, {cy}) on the way to ({x}, {y})"
                    );
                }
            }
        }
    }

    #[test]
    fn a_corner_between_two_blocked_cells_hides_nothing_but_closed_cells() {
        let grid = crate::grid::parse_text_map("#.\n.#\n").unwrap();
        let (from, to) = (0, 3);
        assert!(Sight::ExactInterior.is_clear(&grid, from, to));
        assert!(!Sight::ClosedCells.is_clear(&grid, from, to));
        assert!(Sight::Bresenham.is_clear(&grid, from, to));
        assert!(!Sight::ExactInterior.is_clear(&grid, from, 1), "a blocked end is not seen");
    }
}
