//! All corners of a map that are seen from one of them, found at once.
//!
//! Each quarter around the corner is swept a column of cells at a time. The directions that are left are closed ranges of slopes;
//! a blocked cell cuts an open range out of them, so that what leads between two cells that touch at a corner is left. Slopes are
//! compared exactly.

use super::{Grid2, corners_see};

/// A slope: rise over run, which is above 0.
#[derive(Clone, Copy)]
struct Slope {
    rise: i64,
    run: i64,
}

impl Slope {
    fn is_below(self, other: Self) -> bool {
        self.rise * other.run < other.rise * self.run
    }

    /// The greatest whole number that a line of this slope has reached at `x`.
    fn floor_at(self, x: i64) -> i64 {
        self.rise * x / self.run
    }

    /// The least whole number that it has not passed there.
    fn ceil_at(self, x: i64) -> i64 {
        (self.rise * x + self.run - 1) / self.run
    }
}

/// Calls `visit` with every corner of `cells` that [`corners_see`] from `from`, once each; the corner itself is not among them.
pub fn seen_corners(cells: &Grid2, from: [i32; 2], mut visit: impl FnMut([i32; 2])) {
    for [dx, dy] in [[1, 0], [-1, 0], [0, 1], [0, -1]] {
        let mut at = from;
        let mut to = [at[0] + dx, at[1] + dy];
        while corners_see(cells, at, to) {
            visit(to);
            at = to;
            to = [at[0] + dx, at[1] + dy];
        }
    }
    for quarter in [[1, 1], [-1, 1], [1, -1], [-1, -1]] {
        sweep(cells, from, quarter, &mut visit);
    }
}

/// Visits what is seen in one quarter, its sides left out; x and y count from the corner into the quarter.
fn sweep(cells: &Grid2, from: [i32; 2], [dx, dy]: [i32; 2], visit: &mut impl FnMut([i32; 2])) {
    let is_free = |x: i64, y: i64| {
        let x = from[0] + dx * x as i32 - i32::from(dx < 0);
        cells.is_free_xy(x, from[1] + dy * y as i32 - i32::from(dy < 0))
    };
    let columns = i64::from(if dx < 0 { from[0] } else { cells.width() as i32 - from[0] });
    let rows = i64::from(if dy < 0 { from[1] } else { cells.height() as i32 - from[1] });
    let first = (0..rows).take_while(|y| is_free(0, *y)).count() as i64;
    let mut ranges = vec![[Slope { rise: 0, run: 1 }, Slope { rise: first, run: 1 }]];
    for column in 1..=columns {
        for [low, high] in &ranges {
            for y in low.ceil_at(column).max(1)..=high.floor_at(column) {
                visit([from[0] + dx * column as i32, from[1] + dy * y as i32]);
            }
        }
        ranges = ranges.into_iter().flat_map(|range| cut(range, column, is_free)).collect();
        if ranges.is_empty() {
            return;
        }
    }
}

/// What the blocked cells of a column leave of a range that reaches it.
fn cut([mut low, high]: [Slope; 2], column: i64, is_free: impl Fn(i64, i64) -> bool) -> Vec<[Slope; 2]> {
    let mut left = Vec::new();
    for y in low.floor_at(column)..high.ceil_at(column + 1) {
        if is_free(column, y) {
            continue;
        }
        let below = Slope { rise: y, run: column + 1 };
        if y > 0 && !below.is_below(low) {
            left.push([low, below]);
        }
        let above = Slope { rise: y + 1, run: column };
        if low.is_below(above) {
            low = above;
        }
        if high.is_below(low) {
            return left;
        }
    }
    left.push([low, high]);
    left
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::independent_cells;
    use crate::seed;
    use std::collections::BTreeSet;

    #[test]
    fn the_corners_seen_at_once_are_those_seen_one_by_one() {
        let [mut seen, mut hidden] = [0, 0];
        for (seed, share) in (0..60).zip([0.02, 0.1, 0.25, 0.4].into_iter().cycle()) {
            let size = [[17, 12], [9, 21], [1, 6]][seed as usize % 3];
            let cells = independent_cells(&mut seed::stream(seed), size, share, &[]).unwrap();
            let corners = || (0..=size[1] as i32).flat_map(|y| (0..=size[0] as i32).map(move |x| [x, y]));
            for from in corners() {
                let mut at_once = Vec::new();
                seen_corners(&cells, from, |to| at_once.push(to));
                let count = at_once.len();
                let at_once: BTreeSet<[i32; 2]> = at_once.into_iter().collect();
                assert_eq!(at_once.len(), count, "seed {seed}: visited twice from {from:?}\n{cells:?}");
                let is_seen = |to: &[i32; 2]| *to != from && corners_see(&cells, from, *to);
                let one_by_one: BTreeSet<[i32; 2]> = corners().filter(is_seen).collect();
                assert_eq!(at_once, one_by_one, "seed {seed}: from {from:?}\n{cells:?}");
                seen += count;
                hidden += corners().count() - 1 - count;
            }
        }
        assert!(seen > 50_000 && hidden > 50_000, "{seen} seen, {hidden} hidden");
    }
}
