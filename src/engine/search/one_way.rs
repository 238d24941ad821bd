//! Best-first search from one start.

use super::cost::Cost;
use super::estimate::Estimate;
use super::frontier::Frontier;
use super::graph::Graph;
use super::observe::Observer;
use super::side::{Side, SideInputs};
use super::{Outcome, Report, Route};

/// When a path to the goal is accepted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Stop {
    /// When the goal is the best open node.
    #[default]
    GoalPopped,
    /// When the goal is generated; the expansion in hand is finished.
    GoalGenerated,
}

/// How a search ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rules {
    /// When a path is accepted.
    pub stop: Stop,
    /// Most expansions that may be made.
    pub max_expansions: u64,
}

impl Default for Rules {
    /// Stops when the goal is popped, without a budget.
    fn default() -> Self {
        Self { stop: Stop::GoalPopped, max_expansions: u64::MAX }
    }
}

/// Called for each node that was just closed, before it is expanded; may end the search with a path.
pub trait BeforeExpansion<C> {
    /// A direct way from `node`, reached at cost `g`, to a goal, or `None` to go on.
    fn shoot(&mut self, node: u32, g: C) -> Option<Shot<C>>;
}

/// A direct way to a goal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shot<C> {
    /// The goal reached.
    pub goal: u32,
    /// The cost of the direct way.
    pub cost: C,
}

impl<C> BeforeExpansion<C> for () {
    fn shoot(&mut self, _: u32, _: C) -> Option<Shot<C>> {
        None
    }
}

impl<C, F: FnMut(u32, C) -> Option<Shot<C>>> BeforeExpansion<C> for F {
    fn shoot(&mut self, node: u32, g: C) -> Option<Shot<C>> {
        self(node, g)
    }
}

/// A search from one start, whose memory serves one query after another.
#[derive(Clone, Debug)]
pub struct Search<C, Q> {
    side: Side<C, Q>,
}

impl<C: Cost, Q: Frontier> Search<C, Q> {
    /// A search that takes open nodes in the order of `frontier`.
    pub fn new(frontier: Q) -> Self {
        Self { side: Side::new(frontier) }
    }

    /// Searches from `start` until a node for which `is_goal` holds is reached under `rules`.
    ///
    /// A goal that is never met (`|_| false`) makes this an exact single-source search over everything reachable. Its
    /// outcome is [`Outcome::NoPath`], and [`g`](Self::g) gives the costs afterwards. `before` is called once for each
    /// expansion that the budget allows.
    pub fn run<G, E, O>(
        &mut self,
        mut terms: SideInputs<'_, G, E, O>,
        start: u32,
        is_goal: impl Fn(u32) -> bool,
        rules: Rules,
        before: &mut impl BeforeExpansion<C>,
    ) -> Report<C>
    where
        G: Graph<Cost = C>,
        E: Estimate<C>,
        O: Observer,
    {
        self.side.begin(start, &mut terms);
        let mut reached = (rules.stop == Stop::GoalGenerated && is_goal(start)).then_some(start);
        let outcome = loop {
            if let Some(goal) = reached {
                break self.solved(goal, None);
            }
            let Some(offer) = self.side.best() else { break Outcome::NoPath };
            if is_goal(offer.node) {
                break self.solved(offer.node, None);
            }
            if self.side.counters.expansions >= rules.max_expansions {
                break Outcome::BudgetSpent;
            }
            self.side.close(offer.node, terms.observer);
            if let Some(shot) = self.g(offer.node).and_then(|g| before.shoot(offer.node, g)) {
                break self.solved(offer.node, Some(shot));
            }
            self.side.expand(offer.node, &mut terms, |_, to| {
                if rules.stop == Stop::GoalGenerated && reached.is_none() && is_goal(to) {
                    reached = Some(to);
                }
                true
            });
        };
        Report { outcome, counters: self.side.counters }
    }

    fn solved(&self, node: u32, shot: Option<Shot<C>>) -> Outcome<C> {
        let mut nodes = self.side.chain(node);
        let mut cost = self.side.g(node).expect("a node that ends a search was opened");
        if let Some(shot) = shot {
            nodes.push(shot.goal);
            cost = cost.plus(shot.cost);
        }
        Outcome::Solved(Route { nodes, cost })
    }

    /// The cost of the best way that the last search knew to `node`, if it opened it.
    pub fn g(&self, node: u32) -> Option<C> {
        self.side.g(node)
    }

    /// The best way that the last search knew to `node`, start and `node` included; empty if it did not open it.
    pub fn path_to(&self, node: u32) -> Vec<u32> {
        self.side.chain(node)
    }

    /// The nodes that the last search opened, in that order.
    pub fn opened(&self) -> &[u32] {
        self.side.opened()
    }
}
