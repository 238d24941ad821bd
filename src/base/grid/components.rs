//! Which cells can be reached from which.

use super::{Grid2, Moves};

/// Connected components of the free cells under the moves they were built from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Components {
    labels: Vec<u32>,
    sizes: Vec<u32>,
}

impl Components {
    /// The component of `cell`, or `None` if the cell is blocked or outside. Components are numbered from 0 in the
    /// order of their smallest cells.
    pub fn label(&self, cell: u32) -> Option<u32> {
        self.labels.get(cell as usize).copied().filter(|&label| label != u32::MAX)
    }

    /// Whether a path of legal moves joins the two cells.
    pub fn are_joined(&self, a: u32, b: u32) -> bool {
        self.label(a).is_some() && self.label(a) == self.label(b)
    }

    /// Cells in each component, by number.
    pub fn sizes(&self) -> &[u32] {
        &self.sizes
    }
}

/// The components of the free cells of `grid` under its legal `moves`.
pub fn components(grid: &Grid2, moves: &Moves) -> Components {
    let mut labels = vec![u32::MAX; grid.cell_count() as usize];
    let mut sizes = Vec::new();
    let mut stack = Vec::new();
    for seed_cell in 0..grid.cell_count() {
        if labels[seed_cell as usize] != u32::MAX || !grid.is_free(seed_cell) {
            continue;
        }
        let label = sizes.len() as u32;
        labels[seed_cell as usize] = label;
        stack.push(seed_cell);
        let mut size = 0;
        while let Some(cell) = stack.pop() {
            size += 1;
            for (to, _) in moves.from_cell(cell) {
                if labels[to as usize] == u32::MAX {
                    labels[to as usize] = label;
                    stack.push(to);
                }
            }
        }
        sizes.push(size);
    }
    Components { labels, sizes }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::{CornerRule, parse_text_map};

    #[test]
    fn corners_that_touch_join_only_where_the_rule_says_so() {
        let grid = parse_text_map("..#.\n..#.\n##..\n.#..\n").unwrap();
        let count = |rule| components(&grid, &Moves::new(&grid, rule)).sizes().to_vec();
        assert_eq!(count(CornerRule::Allow), [1, 10]);
        assert_eq!(count(CornerRule::ForbidBoth), [1, 6, 4]);
        let parts = components(&grid, &Moves::new(&grid, CornerRule::ForbidAny));
        let at = |x, y| grid.cell(x, y).unwrap();
        assert!(parts.are_joined(at(3, 3), at(2, 0)) && !parts.are_joined(at(0, 3), at(3, 3)));
        assert_eq!(parts.label(at(1, 0)), None);
        assert!(!parts.are_joined(at(1, 0), at(1, 0)), "a blocked cell is joined to nothing");
    }
}
