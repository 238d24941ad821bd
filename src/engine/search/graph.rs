//! Successor rules.

use super::cost::{Cost, Octile};
use base::grid::{Grid2, Moves, NeighbourOrder, Offsets};
use std::sync::OnceLock;

/// What can be reached from a node in one step.
///
/// A rule may change as it is called (a neighbourhood redrawn at each expansion), hence `&mut self`. A graph given
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
    /// Moves of other directions are left out.
    kept: u8,
    /// For every mask of legal moves, the same moves as places in the order of neighbours.
    places: &'static [u8; 256],
    /// By place in that order.
    steps: [i32; 8],
    costs: [Octile; 8],
}

impl<'a> GridGraph<'a> {
    /// The graph of the legal `moves`, neighbours in the default order.
    pub fn new(moves: &'a Moves) -> Self {
        Self::in_order(moves, NeighbourOrder::default())
    }

    /// The graph of the legal `moves`, neighbours in this order.
    pub fn in_order(moves: &'a Moves, order: NeighbourOrder) -> Self {
        let steps = order.steps();
        let cost = |[dx, dy]: [i32; 2]| if dx != 0 && dy != 0 { Octile::DIAGONAL } else { Octile::STRAIGHT };
        Self {
            moves,
            kept: u8::MAX,
            places: places(order),
            steps: steps.map(|[dx, dy]| dy * moves.width() as i32 + dx),
            costs: steps.map(cost),
        }
    }
}

impl GridGraph<'_> {
    /// The same with the moves of this mask alone.
    #[must_use]
    pub fn only(self, kept: u8) -> Self {
        Self { kept, ..self }
    }
}

/// For every mask of moves, the mask of their places in `order`.
fn places(order: NeighbourOrder) -> &'static [u8; 256] {
    static PLACES: [OnceLock<[u8; 256]>; 24] = [const { OnceLock::new() }; 24];
    PLACES[order.index()].get_or_init(|| {
        let bits = order.bits();
        let moved = |mask: usize| (0..8).map(|place| (mask >> bits[place] & 1) << place).sum::<usize>();
        std::array::from_fn(|mask| moved(mask) as u8)
    })
}

impl Graph for GridGraph<'_> {
    type Cost = Octile;

    fn node_count(&self) -> usize {
        self.moves.cell_count() as usize
    }

    fn successors(&mut self, node: u32, mut visit: impl FnMut(u32, Octile)) {
        let mut places = self.places[usize::from(self.moves.mask(node) & self.kept)];
        while places != 0 {
            let place = places.trailing_zeros() as usize;
            places &= places - 1;
            visit(node.wrapping_add_signed(self.steps[place]), self.costs[place]);
        }
    }
}

/// The moves of a grid, with their lengths as numbers.
#[derive(Debug)]
pub(super) struct Lengths<'a>(pub(super) GridGraph<'a>);

impl Graph for Lengths<'_> {
    type Cost = f64;

    fn node_count(&self) -> usize {
        self.0.node_count()
    }

    fn successors(&mut self, node: u32, mut visit: impl FnMut(u32, f64)) {
        self.0.successors(node, |to, cost| visit(to, cost.value()));
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
