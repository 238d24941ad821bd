//! Bidirectional search: one side from the start, one from the goal.
//!
//! Side 0 starts at the start, side 1 at the goal; a path is the two chains joined at the meeting node. Both use
//! one graph, whose steps must be symmetric. Each side is the same search as [`Search`](super::Search) runs and
//! keeps its own OPEN and CLOSED, so a node opened by both sides is counted on both;
//! [`Bidirectional::opened_distinct`] counts it once.

use super::cost::Cost;
use super::estimate::Estimate;
use super::frontier::Frontier;
use super::graph::Graph;
use super::observe::{Observer, Place};
use super::side::{Side, SideInputs, Update};
use super::{Counters, Outcome, Route};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// When the two sides have met. All but the optimal stop promise no shortest path.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Meeting {
    /// A side generates a node that the other has generated before, be it open or closed there.
    GeneratedAny,
    /// A side generates a node that the other has closed.
    ClosedByOther,
    /// A side closes a node that the other has closed; the node is not expanded again.
    BothClosed,
    /// The best sum found is no more than the smallest f on either side. With an admissible and consistent
    /// estimate the path is shortest.
    OptimalStop,
}

/// How the search ends once the sides have met while a node is expanded. A node that both sides closed ends it at once.
/// The optimal stop compares the least f of both sides.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum End {
    /// The expansion in hand is finished; of the nodes that met in it, the one with the smallest sum of the two g is kept,
    /// of equals the one generated first.
    #[default]
    Expansion,
    /// The search ends with the first node that met; no later successor is generated.
    Contact,
}

/// Which side moves next. A side whose OPEN is empty is passed over.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SideChoice {
    /// Strictly in turn, the start's side first.
    Alternate,
    /// The side with the smaller least f; the start's side if they are equal.
    SmallerF,
}

/// How a bidirectional search proceeds and ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BidirectionalRules {
    /// When the sides have met.
    pub meeting: Meeting,
    /// What is done then.
    pub end: End,
    /// Which side moves next.
    pub choice: SideChoice,
    /// What a better way changes, on both sides.
    pub update: Update,
    /// Most expansions that both sides together may make.
    pub max_expansions: u64,
}

/// How a bidirectional search ended and what each side did.
#[derive(Clone, Debug, PartialEq)]
pub struct BidirectionalReport<C> {
    /// How it ended.
    pub outcome: Outcome<C>,
    /// Where the two halves of the path join, if there is one.
    pub meeting: Option<u32>,
    /// What the start's side and the goal's side did.
    pub sides: [Counters; 2],
}

/// A bidirectional search, whose memory serves one query after another.
#[derive(Clone, Debug)]
pub struct Bidirectional<C, Q> {
    sides: [Side<C, Q>; 2],
}

/// The best meeting node so far and the sum of the two g there.
type Met<C> = Option<(u32, C)>;

impl<C: Cost, Q: Frontier + Clone> Bidirectional<C, Q> {
    /// A search whose sides take open nodes in the order of `frontier`.
    pub fn new(frontier: Q) -> Self {
        Self { sides: [Side::new(frontier.clone()), Side::new(frontier)] }
    }

    /// Searches between `ends` = [start, goal]; `estimates` and `observers` are those of the start's side and of
    /// the goal's side, the first towards the goal and the second towards the start.
    pub fn run<G, E, O>(
        &mut self,
        graph: &mut G,
        estimates: &[E; 2],
        observers: &mut [O; 2],
        ends: [u32; 2],
        rules: BidirectionalRules,
    ) -> BidirectionalReport<C>
    where
        G: Graph<Cost = C>,
        E: Estimate<C>,
        O: Observer,
    {
        let update = rules.update;
        for (side, root) in ends.into_iter().enumerate() {
            let observer = &mut observers[side];
            self.sides[side]
                .begin(root, &mut SideInputs { graph, estimate: &estimates[side], observer, update });
        }
        let mut met = (ends[0] == ends[1]).then_some((ends[0], C::ZERO));
        let mut turn = 0;
        let outcome = loop {
            let best = [0, 1].map(|side| self.sides[side].best());
            let f = best.map(|offer| offer.map(|offer| offer.f));
            if self.has_ended(met.map(|(_, cost)| estimates[0].finished(cost)), f, ends, rules.meeting) {
                break met.map_or(Outcome::NoPath, |(node, _)| self.solved(node));
            }
            let side = chosen(f, turn, rules.choice);
            let Some(offer) = best[side] else { break Outcome::NoPath };
            if self.sides.iter().map(|side| side.counters.expansions).sum::<u64>() >= rules.max_expansions {
                break Outcome::BudgetSpent;
            }
            let observer = &mut observers[side];
            let terms = &mut SideInputs { graph, estimate: &estimates[side], observer, update };
            self.step(side, offer.node, terms, rules, &mut met);
            turn = 1 - side;
        };
        let meeting = outcome.route().and(met).map(|(node, _)| node);
        BidirectionalReport { outcome, meeting, sides: [0, 1].map(|side| self.sides[side].counters) }
    }

    /// Whether nothing more can or need be done, `found` being the key of the best sum and `f` the least keys.
    fn has_ended(&self, found: Option<u64>, f: [Option<u64>; 2], ends: [u32; 2], meeting: Meeting) -> bool {
        match (found, meeting) {
            (Some(found), Meeting::OptimalStop) => f.iter().any(|least| least.is_none_or(|f| f >= found)),
            (Some(_), _) => true,
            // A side that ran empty has opened all that it can reach.
            (None, _) => (0..2).any(|side| f[side].is_none() && self.sides[side].g(ends[1 - side]).is_none()),
        }
    }

    /// Closes `node` on `side` and expands it, and notes in `met` the best node at which the sides have met.
    fn step<G, E, O>(
        &mut self,
        side: usize,
        node: u32,
        terms: &mut SideInputs<'_, G, E, O>,
        rules: BidirectionalRules,
        met: &mut Met<C>,
    ) where
        G: Graph<Cost = C>,
        E: Estimate<C>,
        O: Observer,
    {
        let [first, second] = &mut self.sides;
        let (this, other) = if side == 0 { (first, &*second) } else { (second, &*first) };
        let mut note = |this: &Side<C, Q>, node: u32| {
            let sum = this.g(node).zip(other.g(node)).map(|(here, there)| here.plus(there));
            if let Some(sum) = sum.filter(|sum| met.is_none_or(|(_, best)| sum.compare(best).is_lt())) {
                *met = Some((node, sum));
            }
            met.is_some()
        };
        this.close(node, terms.observer);
        if rules.meeting == Meeting::BothClosed && other.place(node) == Place::Closed {
            note(this, node);
            return;
        }
        this.expand(node, terms, |this, to| {
            let has_met = match rules.meeting {
                Meeting::GeneratedAny => note(this, to),
                Meeting::ClosedByOther => other.place(to) == Place::Closed && note(this, to),
                Meeting::OptimalStop => {
                    note(this, to);
                    false
                }
                Meeting::BothClosed => false,
            };
            !(has_met && rules.end == End::Contact)
        });
    }

    fn solved(&self, meeting: u32) -> Outcome<C> {
        let [mut nodes, back] = [0, 1].map(|side| self.sides[side].chain(meeting));
        nodes.extend(back.into_iter().rev().skip(1));
        let g = |side: usize| self.sides[side].g(meeting).expect("the sides met where both were");
        Outcome::Solved(Route { nodes, cost: g(0).plus(g(1)) })
    }

    /// How many different nodes both sides together opened in the last search.
    pub fn opened_distinct(&self) -> u64 {
        let [start, goal] = &self.sides;
        let of_goal_alone = goal.opened().iter().filter(|node| start.g(**node).is_none());
        (start.opened().len() + of_goal_alone.count()) as u64
    }

    /// The nodes that the start's side (0) or the goal's side (1) opened in the last search, in that order.
    ///
    /// # Panics
    /// If `side` is neither 0 nor 1.
    pub fn opened(&self, side: usize) -> &[u32] {
        self.sides[side].opened()
    }
}

fn chosen(f: [Option<u64>; 2], turn: usize, choice: SideChoice) -> usize {
    match (f, choice) {
        ([Some(_), None], _) => 0,
        ([None, _], _) => 1,
        (_, SideChoice::Alternate) => turn,
        (_, SideChoice::SmallerF) => usize::from(f[1] < f[0]),
    }
}
