//! Successor rules.

use super::cost::{Cost, Octile};
use base::grid::{DIRECTIONS, Grid2, Moves, Offsets};

/// What can be reached from a node in one step.
///
/// A rule may change as it is asked (a neighbourhood redrawn at each expansion), hence `&mut self`. A graph given
/// to the bidirectional driver must hold every step in both directions at the same cost.
pub trait Graph {
    /// What steps cost.
    type Cost: Cost;

    /// A number above every node known so far; room for that many is made at once.
    fn node_count(&self) -> usize;

    /// Hands each successor of `node` and the cost of the step to `visit`, in the graph's order.
    fn successors(&mut self, node: u32, visit: impl FnMut(u32, Self::Cost));
}

/// An 8-connected grid under one corner rule: steps cost 1 or √2, exactly.
#[derive(Clone, Copy, Debug)]
pub struct GridGraph<'a> {
    moves: &'a Moves,
    steps: [i32; 8],
}

impl<'a> GridGraph<'a> {
    /// The graph of the legal `moves`.
    pub fn new(moves: &'a Moves) -> Self {
        Self { moves, steps: DIRECTIONS.map(|[dx, dy]| dy * moves.width() as i32 + dx) }
    }
}

impl Graph for GridGraph<'_> {
    type Cost = Octile;

    fn node_count(&self) -> usize {
        self.moves.cell_count() as usize
    }

    fn successors(&mut self, node: u32, mut visit: impl FnMut(u32, Octile)) {
        let mut mask = self.moves.mask(node);
        while mask != 0 {
            let bit = mask.trailing_zeros() as usize;
            mask &= mask - 1;
            let [dx, dy] = DIRECTIONS[bit];
            let cost = if dx != 0 && dy != 0 { Octile::DIAGONAL } else { Octile::STRAIGHT };
            visit(node.wrapping_add_signed(self.steps[bit]), cost);
        }
    }
}

/// The free cells of a grid with a neighbourhood of any shape; a step costs its Euclidean length.
///
/// `may_hop(from, step)` decides whether the way between two free cells may be taken: always, for a check of end
/// points only, or by a line of sight or a swept body.
#[derive(Debug)]
pub struct LatticeGraph<'a, F> {
    grid: &'a Grid2,
    steps: Vec<Step>,
    may_hop: F,
}

/// A step to a neighbour: in columns and rows, in cells of the row-major order, and in length.
#[derive(Clone, Copy, Debug)]
struct Step {
    by: [i32; 2],
    offset: i32,
    length: f64,
}

impl<'a, F: FnMut(u32, [i32; 2]) -> bool> LatticeGraph<'a, F> {
    /// The lattice on `grid` whose cells are `spacing` apart; costs are in the unit of `spacing`.
    pub fn new(grid: &'a Grid2, offsets: &Offsets, spacing: f64, may_hop: F) -> Self {
        let step = |&[dx, dy]: &[i32; 2]| Step {
            by: [dx, dy],
            offset: dy * grid.width() as i32 + dx,
            length: spacing * f64::from(dx * dx + dy * dy).sqrt(),
        };
        Self { grid, steps: offsets.steps().iter().map(step).collect(), may_hop }
    }
}

impl<F: FnMut(u32, [i32; 2]) -> bool> Graph for LatticeGraph<'_, F> {
    type Cost = f64;

    fn node_count(&self) -> usize {
        self.grid.cell_count() as usize
    }

    fn successors(&mut self, node: u32, mut visit: impl FnMut(u32, f64)) {
        let [x, y] = self.grid.xy(node);
        for &Step { by, offset, length } in &self.steps {
            if !self.grid.holds(x + by[0], y + by[1]) {
                continue;
            }
            let to = node.wrapping_add_signed(offset);
            if self.grid.is_free(to) && (self.may_hop)(node, by) {
                visit(to, length);
            }
        }
    }
}
