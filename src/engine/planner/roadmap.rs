//! Ends and plans that the planners on a roadmap share, and how part of a roadmap is searched.

use super::{Counts, Ending, Invalid, Plan, Request};
use crate::search::Graph;
use schemars::JsonSchema;
use serde::Deserialize;
use world::space::World;
use world::space::roadmap::{Links, Roadmap};

/// The roadmap of a request with the numbers of its start and goal.
pub(super) struct Posed<'a> {
    pub(super) map: &'a Roadmap,
    pub(super) start: u32,
    pub(super) goal: u32,
}

impl<'a> Posed<'a> {
    pub(super) fn new(request: &Request<'a>) -> Result<Self, Invalid> {
        let map = roadmap(request.world);
        let start = map.number("start", request.start).map_err(Invalid)?;
        let goal = map.number("goal", request.goal).map_err(Invalid)?;
        Ok(Self { map, start, goal })
    }
}

/// The roadmap that `world` is; a checked study gives these planners no other kind.
pub(super) fn roadmap(world: &World) -> &Roadmap {
    world.as_roadmap().expect("a checked study gives a planner the kind of world it needs")
}

/// A plan through `nodes`; its planner claims a length where local paths are straight.
pub(super) fn solved(map: &Roadmap, nodes: &[u32], counts: Counts) -> Plan {
    let length_mm: f64 = nodes.windows(2).map(|pair| map.gap_mm(pair[0], pair[1])).sum();
    Plan {
        ending: Ending::Solved,
        path: nodes.iter().map(|node| map.config(*node)).collect(),
        cost: map.local().is_straight().then_some(length_mm),
        counts,
        traces: Vec::new(),
        reason: None,
    }
}

/// A plan without a path.
pub(super) fn unsolved(ending: Ending, counts: Counts) -> Plan {
    Plan { ending, path: Vec::new(), cost: None, counts, traces: Vec::new(), reason: None }
}

/// What an edge costs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(super) enum EdgeCost {
    /// One.
    Hops,
    /// The straight way of the tool.
    Length,
    /// Nothing: the estimate alone leads.
    Nothing,
}

/// The first samples of a roadmap with one start and one goal, under edges up to a radius.
pub(super) struct Part<'a> {
    pub(super) map: &'a Roadmap,
    pub(super) prefix: u32,
    pub(super) radius_mm: f64,
    /// At most this many nearest samples are neighbours.
    pub(super) nearest: Option<usize>,
    pub(super) cost: EdgeCost,
    pub(super) start: u32,
    pub(super) goal: u32,
    start_links: Links,
    goal_links: Links,
}

impl<'a> Part<'a> {
    pub(super) fn new(
        posed: &Posed<'a>,
        prefix: u32,
        radius_mm: f64,
        nearest: Option<usize>,
        cost: EdgeCost,
    ) -> Self {
        let Posed { map, start, goal } = *posed;
        let (start_links, goal_links) = (map.links(start), map.links(goal));
        Self { map, prefix, radius_mm, nearest, cost, start, goal, start_links, goal_links }
    }

    fn is_linked(&self, gap_mm: f64, to: u32) -> bool {
        to < self.prefix && gap_mm <= self.radius_mm
    }

    /// Whether an end's links, or the edge between the ends, join start and goal with the samples' components.
    pub(super) fn is_connected(&self, components: &[u32]) -> bool {
        let touched = |links: &Links| -> Vec<u32> {
            let near = links.iter().filter(|(to, gap)| self.is_linked(*gap, *to));
            near.map(|(to, _)| components[*to as usize]).collect()
        };
        let at_goal = touched(&self.goal_links);
        touched(&self.start_links).iter().any(|part| at_goal.contains(part)) || self.has_direct_edge()
    }

    /// How many of its samples the start and the goal are joined with.
    pub(super) fn end_links(&self) -> [u64; 2] {
        [&self.start_links, &self.goal_links]
            .map(|links| links.iter().filter(|(to, gap)| self.is_linked(*gap, *to)).count() as u64)
    }

    /// How many of `nodes` are not joined by an edge with the one before.
    pub(super) fn unjoined(&mut self, nodes: &[u32]) -> u64 {
        let mut missing = 0;
        for pair in nodes.windows(2) {
            let mut is_joined = false;
            self.successors(pair[0], |to, _| is_joined |= to == pair[1]);
            missing += u64::from(!is_joined);
        }
        missing
    }

    fn has_direct_edge(&self) -> bool {
        self.map.gap_mm(self.start, self.goal) <= self.radius_mm
            && self.map.are_near(self.start, self.goal)
            && self.map.join(self.start, self.goal).is_ok()
    }

    /// The distance beyond which samples are not among the nearest of `node`; none if all are.
    fn cap_mm(&self, node: u32) -> Option<f64> {
        let count = self.nearest.filter(|count| *count < self.prefix as usize)?;
        let others = (0..self.prefix).filter(|other| *other != node);
        let mut gaps: Vec<f64> = others.map(|other| self.map.gap_mm(node, other)).collect();
        let (_, cap, _) = gaps.select_nth_unstable_by(count.saturating_sub(1), f64::total_cmp);
        Some(*cap)
    }

    fn step(&self, gap_mm: f64) -> f64 {
        match self.cost {
            EdgeCost::Hops => 1.0,
            EdgeCost::Length => gap_mm,
            EdgeCost::Nothing => 0.0,
        }
    }
}

impl Graph for Part<'_> {
    type Cost = f64;

    fn node_count(&self) -> usize {
        self.map.node_count()
    }

    fn successors(&mut self, node: u32, mut visit: impl FnMut(u32, f64)) {
        let links = if node == self.start { self.start_links.clone() } else { self.map.links(node) };
        let cap_mm = self.cap_mm(node).unwrap_or(f64::INFINITY);
        for (to, gap_mm) in links.iter().take_while(|(to, _)| *to < self.prefix) {
            if *gap_mm <= self.radius_mm.min(cap_mm) {
                visit(*to, self.step(*gap_mm));
            }
        }
        let to_goal = if node == self.start {
            self.has_direct_edge().then(|| self.map.gap_mm(node, self.goal))
        } else {
            let at = self.goal_links.binary_search_by_key(&node, |(to, _)| *to).ok();
            at.map(|index| self.goal_links[index].1).filter(|gap_mm| *gap_mm <= self.radius_mm)
        };
        if let Some(gap_mm) = to_goal {
            visit(self.goal, self.step(gap_mm));
        }
    }
}
