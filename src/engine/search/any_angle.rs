//! Any-angle search on 8-connected grids: the parent of a node may be any node that sees it.
//!
//! Nodes are expanded as by A* with the Euclidean distance, but the way to a successor goes straight from the parent of
//! the node expanded, where that parent sees it. So g is the length of a polyline, whose corners
//! [`Outcome::Solved`] lists; it is not the shortest polyline in general. [`When`] says at what time a line of sight is
//! looked at. Under Theta*, a successor that the straight way would not improve is not looked at; [`AnyAngleRules::counts_all`] counts
//! it all the same, as the printed procedure looks at it.
//!
//! # Source
//! Nash, Daniel, Koenig & Felner, *Theta\*: Any-Angle Path Planning on Grids*, AAAI 2007; Nash, Koenig & Tovey, *Lazy
//! Theta\*: Any-Angle Path Planning and Path Length Analysis in 3D*, AAAI 2010.

use super::cost::Cost as _;
use super::estimate::{Combined, distance, euclidean_to, weighted};
use super::frontier::Frontier;
use super::graph::{Graph, GridGraph};
use super::observe::{Observer, Place};
use super::side::{Side, SideInputs, Update};
use super::{Outcome, Report, Route};
use base::grid::{DIRECTIONS, Grid2, Moves};
use schemars::JsonSchema;
use serde::Deserialize;

/// When it is looked at whether a parent sees a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum When {
    /// When the node is generated: Theta*.
    Generated,
    /// When the node is taken from OPEN; until then it is taken to be seen: Lazy Theta*.
    Taken,
}

/// How many neighbours a node has at most.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Branching {
    /// Along rows and columns.
    Four,
    /// Diagonally too.
    #[default]
    Eight,
    /// Those that a knight reaches in chess too, where they are seen.
    Sixteen,
}

/// What distinguishes one any-angle search from another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AnyAngleRules {
    /// When lines of sight are looked at.
    pub when: When,
    /// f = g + weight · h, h the distance to the goal.
    pub weight: f64,
    /// Whether a closed node to which a better way is found returns to OPEN; not where lines are looked at when nodes are taken.
    pub reopens: bool,
    /// How many neighbours a node has.
    pub branching: Branching,
    /// Whether a line to each successor that is not closed counts as looked at, as the printed procedure has it.
    pub counts_all: bool,
    /// At most this many expansions.
    pub max_expansions: u64,
}

impl AnyAngleRules {
    /// As the papers have it.
    pub fn new(when: When, max_expansions: u64) -> Self {
        let branching = Branching::default();
        Self { when, weight: 1.0, reopens: false, branching, counts_all: false, max_expansions }
    }
}

/// A grid with its moves and its line of sight.
#[derive(Clone, Copy, Debug)]
pub struct Sighted<'a, S> {
    /// The cells.
    pub grid: &'a Grid2,
    /// The legal moves.
    pub moves: &'a Moves,
    /// Whether the second cell is seen from the first, each by column and row.
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
    pub fn solve<S: Fn([i32; 2], [i32; 2]) -> bool>(
        &mut self,
        on: &Sighted<'_, S>,
        rules: AnyAngleRules,
        ends: [u32; 2],
        observer: &mut impl Observer,
    ) -> Seen {
        let estimate = Combined { h: euclidean_to(on.grid, ends[1]), combine: weighted(rules.weight) };
        let mut graph = Plane::new(on, rules.branching);
        let update = Update { reopen_closed: rules.reopens, ..Update::default() };
        let mut terms = SideInputs { graph: &mut graph, estimate: &estimate, observer, update };
        self.side.begin(ends[0], &mut terms);
        let mut sight_checks = 0;
        let outcome = loop {
            let Some(offer) = self.side.best() else { break Outcome::NoPath };
            if rules.when == When::Taken {
                sight_checks += self.look(on, rules.branching, offer.node, terms.observer);
            }
            if offer.node == ends[1] {
                break self.solved(ends[1]);
            }
            if self.side.counters.expansions >= rules.max_expansions {
                break Outcome::BudgetSpent;
            }
            self.side.close(offer.node, terms.observer);
            let way = Way::from(&self.side, on.grid, offer.node);
            let choose = |side: &Side<f64, Q>, to: u32, cost: f64| {
                way.to(side, on, (to, cost), rules, &mut sight_checks)
            };
            self.side.expand_by(offer.node, &mut terms, choose, |_, _| true);
        };
        Seen { report: Report { outcome, counters: self.side.counters }, sight_checks }
    }

    /// Hangs the open `node` under the closed neighbour over which it is reached at least cost, if its parent does not see
    /// it; how many lines of sight were looked at.
    fn look<S: Fn([i32; 2], [i32; 2]) -> bool>(
        &mut self,
        on: &Sighted<'_, S>,
        branching: Branching,
        node: u32,
        observer: &mut impl Observer,
    ) -> u64 {
        let Some(parent) = self.side.parent(node) else { return 0 };
        if !(on.sees)(on.grid.xy(parent), on.grid.xy(node)) {
            let mut best: Option<(u32, f64)> = None;
            Plane::new(on, branching).successors(node, |from, cost| {
                let is_closed = self.side.place(from) == Place::Closed;
                let reached = self.side.g(from).filter(|_| is_closed).map(|g| g + cost);
                if let Some(g) = reached.filter(|g| best.is_none_or(|(_, least)| *g < least)) {
                    best = Some((from, g));
                }
            });
            let (from, g) = best.expect("the node from which it was generated is a closed neighbour");
            self.side.hang(node, from, g, observer);
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
    /// Its parent, the parent's g, and where the parent is; the root has none.
    parent: Option<(u32, f64, [i32; 2])>,
}

impl Way {
    fn from<Q: Frontier>(side: &Side<f64, Q>, grid: &Grid2, node: u32) -> Self {
        let g = |node: u32| side.g(node).unwrap_or_default();
        let parent = side.parent(node).map(|parent| (parent, g(parent), grid.xy(parent)));
        Self { node: (node, g(node)), parent }
    }

    /// The parent and g of a successor, one move of length `cost` away.
    fn to<Q: Frontier, S: Fn([i32; 2], [i32; 2]) -> bool>(
        &self,
        side: &Side<f64, Q>,
        on: &Sighted<'_, S>,
        (to, cost): (u32, f64),
        rules: AnyAngleRules,
        sight_checks: &mut u64,
    ) -> (u32, f64) {
        let (node, g) = self.node;
        let place = side.place(to);
        if place == Place::Closed && !rules.reopens {
            // It stays as it is, whatever the way.
            return (node, g + cost);
        }
        let looks = rules.when == When::Generated;
        *sight_checks += u64::from(looks && rules.counts_all);
        let Some((parent, g_parent, from)) = self.parent else { return (node, g + cost) };
        let at = on.grid.xy(to);
        let straight = g_parent + distance(from, at);
        // The way over the node is no shorter.
        let would_improve = place == Place::Unseen || side.g(to).is_none_or(|known| straight.is_below(known));
        if !(looks && would_improve) {
            return (parent, straight);
        }
        *sight_checks += u64::from(!rules.counts_all);
        if (on.sees)(from, at) { (parent, straight) } else { (node, g + cost) }
    }
}

/// The steps of a knight: two along one axis, one along the other.
const KNIGHT: [[i32; 2]; 8] = [[2, 1], [2, -1], [1, 2], [1, -2], [-1, 2], [-1, -2], [-2, 1], [-2, -1]];

/// Which of the [`DIRECTIONS`] lead along rows and columns, as a mask.
const STRAIGHT: u8 = {
    let mut mask = 0;
    let mut bit = 0;
    while bit < 8 {
        mask |= ((DIRECTIONS[bit][0] * DIRECTIONS[bit][1] == 0) as u8) << bit;
        bit += 1;
    }
    mask
};

/// The moves of a grid, with their lengths as numbers.
struct Plane<'a, S> {
    on: &'a Sighted<'a, S>,
    moves: GridGraph<'a>,
    branching: Branching,
}

impl<'a, S: Fn([i32; 2], [i32; 2]) -> bool> Plane<'a, S> {
    fn new(on: &'a Sighted<'a, S>, branching: Branching) -> Self {
        let kept = if branching == Branching::Four { STRAIGHT } else { u8::MAX };
        Self { on, moves: GridGraph::new(on.moves).only(kept), branching }
    }
}

impl<S: Fn([i32; 2], [i32; 2]) -> bool> Graph for Plane<'_, S> {
    type Cost = f64;

    fn node_count(&self) -> usize {
        self.moves.node_count()
    }

    fn successors(&mut self, node: u32, mut visit: impl FnMut(u32, f64)) {
        self.moves.successors(node, |to, cost| visit(to, cost.value()));
        if self.branching != Branching::Sixteen {
            return;
        }
        let [x, y] = self.on.grid.xy(node);
        for [dx, dy] in KNIGHT {
            if let Some(to) = self.on.grid.cell(x + dx, y + dy)
                && self.on.grid.is_free(to)
                && (self.on.sees)([x, y], [x + dx, y + dy])
            {
                visit(to, 5.0_f64.sqrt());
            }
        }
    }
}
