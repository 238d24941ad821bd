//! The A* kernel: one best-first search, generic over graph, cost, estimate and frontier.
//!
//! Methods differ in parts and not in copies:
//! - the successor rule ([`Graph`]);
//! - the estimate f of (node, g) ([`Estimate`]): f = g + h, weighted, or with falling weight;
//! - the order among equal f (the [`Frontier`]): a [`Heap`] or [`BucketHeap`] with a [`Ties`] rule, or [`Buckets`];
//! - whether the g of an open node is lowered, and whether closed nodes reopen ([`Update`]);
//! - when to stop ([`Stop`]), what is tried before an expansion ([`BeforeExpansion`]) and who watches ([`Observer`]).
//!
//! [`Search`] runs one side, [`Bidirectional`] two, [`AnyAngle`] one whose ways leave the moves of the grid.
//! Between corners of cells, [`AngleRanges`] hands on what each sees and [`Interpolated`] costs along edges.
//! [`OctileAstar`] is the declared specialisation for 8-connected grids, [`LatticeAstar`] the one for neighbourhoods of any
//! size, [`CubicAstar`] the one for cubic lattices with 26 neighbours; tests hold each equal to the general form.
//!
//! # Counters
//! A node is **generated** each time it is produced as a successor, whatever becomes of it. It is **opened** when it enters OPEN
//! for the first time (roots included), so `opened` counts the distinct nodes of OPEN ∪ CLOSED. It is **closed** when it is taken
//! from OPEN. A goal that is taken ends the search instead and is not closed (Hart, Nilsson & Raphael 1968). An **expansion**
//! generates all successors of a node just closed. `closed` counts nodes in CLOSED at the end. It equals `expansions` unless
//! closed nodes reopened, or the last node closed ended the search unexpanded ([`BeforeExpansion`], [`Meeting::BothClosed`]).
//! `peak_open` is the most nodes that were in OPEN at once, between steps.
//!
//! # Ties
//! Keys are integers. Estimates over floating point are rounded to 1e-9 ([`quantised`]) before they are compared,
//! so that the noise of a sum does not order nodes. Among equal f the frontier's written rule decides, and every
//! rule ends in the order in which nodes were first opened, so no tie is left open. Neighbours are generated in
//! the order of the graph, which therefore decides among paths of equal cost; on grids that is a
//! [`NeighbourOrder`](base::grid::NeighbourOrder).
//!
//! Graphs with states of their own (poses, configurations) number them in the order in which they meet them;
//! records grow as numbers appear.

mod angle_ranges;
mod any_angle;
mod bidirectional;
mod bucket_heap;
mod buckets;
mod cost;
mod cubic_astar;
mod estimate;
mod frontier;
mod graph;
mod interpolated;
mod jump;
mod lattice_astar;
mod neighbourhood;
mod node_lists;
mod observe;
mod octile;
mod one_way;
mod open_list;
mod radix;
mod side;
mod straight;
#[cfg(test)]
pub(crate) mod tests;

pub use angle_ranges::{AngleRanges, Cornered};
pub use any_angle::{AnyAngle, AnyAngleRules, Branching, Seen, Sighted, When};
pub use bidirectional::{Bidirectional, BidirectionalReport, BidirectionalRules, End, Meeting, SideChoice};
pub use bucket_heap::BucketHeap;
pub use buckets::Buckets;
pub use cost::{Cost, Octile, quantised};
pub use cubic_astar::{CubicAstar, CubicQuery};
pub use estimate::{Combined, Estimate, ScaledOctile, euclidean_to, falling, octile_to, sum, weighted};
pub use frontier::{Best, Frontier, Heap, Offer, Ties};
pub use graph::{Graph, GridGraph, LatticeGraph};
pub use interpolated::{Field, FieldRules, Interpolated};
pub use jump::JumpSearch;
pub use lattice_astar::{LatticeAstar, LatticeQuery};
pub use neighbourhood::{ColumnGraph, Successors};
pub use observe::{Closing, Closings, ListScans, Lists, Observer, OneSide, Parents, Place, VisitOrder};
pub use octile::{OctileAstar, SearchError};
pub use one_way::{BeforeExpansion, Rules, Search, Shot, Stop};
pub use side::{SideInputs, Update};
pub use straight::{Bent, BentGraph};

/// A path and what it costs.
#[derive(Clone, Debug, PartialEq)]
pub struct Route<C> {
    /// The nodes from start to goal, both included.
    pub nodes: Vec<u32>,
    /// The sum of the steps' costs.
    pub cost: C,
}

/// How a search ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome<C> {
    /// A path was found.
    Solved(Route<C>),
    /// OPEN ran empty.
    NoPath,
    /// The next expansion would have exceeded the budget.
    BudgetSpent,
}

impl<C> Outcome<C> {
    /// The path, if one was found.
    pub fn route(&self) -> Option<&Route<C>> {
        match self {
            Outcome::Solved(route) => Some(route),
            Outcome::NoPath | Outcome::BudgetSpent => None,
        }
    }
}

/// What a search did, as defined in the [module's documentation](self).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Distinct nodes that were ever in OPEN.
    pub opened: u64,
    /// Nodes in CLOSED at the end.
    pub closed: u64,
    /// Nodes expanded, with repetition if closed nodes reopened.
    pub expansions: u64,
    /// Successors evaluated, with repetition.
    pub generated: u64,
    /// Most nodes in OPEN at once.
    pub peak_open: u64,
}

/// How a search ended and what it did.
#[derive(Clone, Debug, PartialEq)]
pub struct Report<C> {
    /// How it ended.
    pub outcome: Outcome<C>,
    /// What it did.
    pub counters: Counters,
}
