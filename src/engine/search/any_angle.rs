//! Any-angle search on 8-connected grids: the parent of a node may be any node that sees it.
//!
//! Nodes are expanded as by A* with the Euclidean distance, but the way to a successor goes straight from the parent of
//! the node expanded, where that parent sees it. So g is the length of a polyline, whose corners
//! [`Outcome::Solved`] lists; it is not the shortest polyline in general. [`When`] says at what time a line of sight is
//! looked at. Under Theta*, a successor that the straight way would not improve is not looked at.
//!
//! # Source
//! Nash, Daniel, Koenig & Felner, *Theta\*: Any-Angle Path Planning on Grids*, AAAI 2007; Nash, Koenig & Tovey, *Lazy
//! Theta\*: Any-Angle Path Planning and Path Length Analysis in 3D*, AAAI 2010.

use super::cost::Cost as _;
use super::estimate::{Combined, euclidean_to, sum};
use super::frontier::Frontier;
use super::graph::{Graph, GridGraph};
use super::observe::{Observer, Place};
use super::side::{Side, SideInputs, Update};
use super::{Outcome, Report, Route};
use base::grid::{Grid2, Moves};

/// When it is looked at whether a parent sees a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum When {
    /// When the node is generated: Theta*.
    Generated,
    /// When the node is taken from OPEN; until then it is taken to be seen: Lazy Theta*.
    Taken,
}

/// A grid with its moves and its line of sight.
#[derive(Clone, Copy, Debug)]
pub struct Sighted<'a, S> {
    /// The cells.
    pub grid: &'a Grid2,
    /// The legal moves.
    pub moves: &'a Moves,
    /// Whether the second cell is seen from the first.
    pub sees: S,
}

/// A report, and how many lines of sight were looked at.
#[derive(Clone, Debug, PartialEq)]
pub struct Seen {
    /// How the search ended, and its counters.
    pub report: Report<f64>,
    /// Lines of sight that were looked at.
    pub sight_checks: u64,
}

/// An any-angle search, whose memory serves one query after another.
#[derive(Clone, Debug)]
pub struct AnyAngle<Q> {
    side: Side<f64, Q>,
}

impl<Q: Frontier> AnyAngle<Q> {
    /// A search that takes open nodes in the order of `frontier`.
    pub fn new(frontier: Q) -> Self {
        Self { side: Side::new(frontier) }
    }

    /// A path from the first to the second of `ends`; the search ends when the goal is taken from OPEN.
    pub fn solve<S: Fn(u32, u32) -> bool>(
        &mut self,
        on: &Sighted<'_, S>,
        when: When,
        ends: [u32; 2],
        max_expansions: u64,
        observer: &mut impl Observer,
    ) -> Seen {
        let estimate = Combined { h: euclidean_to(on.grid, ends[1]), combine: sum };
        let mut graph = Plane(GridGraph::new(on.moves));
        let mut terms =
            SideInputs { graph: &mut graph, estimate: &estimate, observer, update: Update::default() };
        self.side.begin(ends[0], &mut terms);
        let mut sight_checks = 0;
        let outcome = loop {
            let Some(offer) = self.side.best() else { break Outcome::NoPath };
            if when == When::Taken {
                sight_checks += self.look(on, offer.node);
            }
            if offer.node == ends[1] {
                break self.solved(ends[1]);
            }
            if self.side.counters.expansions >= max_expansions {
                break Outcome::BudgetSpent;
            }
            self.side.close(offer.node, terms.observer);
            let way = Way::from(&self.side, offer.node);
            let choose = |side: &Side<f64, Q>, to: u32, cost: f64| {
                way.to(side, on, to, cost, (when == When::Generated).then_some(&mut sight_checks))
            };
            self.side.expand_by(offer.node, &mut terms, choose, |_, _| true);
        };
        Seen { report: Report { outcome, counters: self.side.counters }, sight_checks }
    }

    /// Hangs the open `node` under the closed neighbour over which it is reached at least cost, if its parent does not see
    /// it; how many lines of sight were looked at.
    fn look<S: Fn(u32, u32) -> bool>(&mut self, on: &Sighted<'_, S>, node: u32) -> u64 {
        let Some(parent) = self.side.parent(node) else { return 0 };
        if !(on.sees)(parent, node) {
            let mut best: Option<(u32, f64)> = None;
            Plane(GridGraph::new(on.moves)).successors(node, |from, cost| {
                let is_closed = self.side.place(from) == Place::Closed;
                let reached = self.side.g(from).filter(|_| is_closed).map(|g| g + cost);
                if let Some(g) = reached.filter(|g| best.is_none_or(|(_, least)| *g < least)) {
                    best = Some((from, g));
                }
            });
            let (from, g) = best.expect("the node from which it was generated is a closed neighbour");
            self.side.hang(node, from, g);
        }
        1
    }

    fn solved(&self, goal: u32) -> Outcome<f64> {
        let cost = self.side.g(goal).expect("a node that ends a search was opened");
        Outcome::Solved(Route { nodes: self.side.chain(goal), cost })
    }
}

/// Where ways to the successors of a node may start.
struct Way {
    /// The node, and its g.
    node: (u32, f64),
    /// Its parent, and the parent's g; the root has none.
    parent: Option<(u32, f64)>,
}

impl Way {
    fn from<Q: Frontier>(side: &Side<f64, Q>, node: u32) -> Self {
        let known = |node: u32| (node, side.g(node).unwrap_or_default());
        Self { node: known(node), parent: side.parent(node).map(known) }
    }

    /// The parent and g of `to`, one move of length `cost` away; lines of sight are looked at if they are counted.
    fn to<Q: Frontier, S: Fn(u32, u32) -> bool>(
        &self,
        side: &Side<f64, Q>,
        on: &Sighted<'_, S>,
        to: u32,
        cost: f64,
        sight_checks: Option<&mut u64>,
    ) -> (u32, f64) {
        let (node, g) = self.node;
        let Some((parent, g_parent)) = self.parent else { return (node, g + cost) };
        let straight = g_parent + euclidean_to(on.grid, parent)(to);
        // The way over the node is no shorter.
        let would_improve = match side.place(to) {
            Place::Unseen => true,
            Place::Open => side.g(to).is_none_or(|known| straight.is_below(known)),
            Place::Closed => false,
        };
        match sight_checks.filter(|_| would_improve) {
            None => (parent, straight),
            Some(count) => {
                *count += 1;
                if (on.sees)(parent, to) { (parent, straight) } else { (node, g + cost) }
            }
        }
    }
}

/// The moves of a grid, with their lengths as numbers.
struct Plane<'a>(GridGraph<'a>);

impl Graph for Plane<'_> {
    type Cost = f64;

    fn node_count(&self) -> usize {
        self.0.node_count()
    }

    fn successors(&mut self, node: u32, mut visit: impl FnMut(u32, f64)) {
        self.0.successors(node, |to, cost| visit(to, cost.value()));
    }
}
