//! A* on a roadmap, as Fu et al. write it: f = depth + distance, with or without a shot at the goal.

use super::lattice::counted;
use super::roadmap::{EdgeCost, Part, Posed, solved, unsolved};
use super::{Build, Counts, Ending, Entry, Invalid, Plan, Planner, Request, Trace, Value};
use crate::search::{
    Combined, Counters, Heap, Outcome, Rules, Search, Shot, SideInputs, Stop, Ties, Update, VisitOrder, sum,
};
use base::settings::Accepted;
use base::units::seems_in_metres;
use schemars::JsonSchema;
use serde::Deserialize;
use world::space::WorldKind;
use world::space::roadmap::{Extent, Roadmap};

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "roadmap_astar",
    about: "A* on the first samples of a roadmap; f = depth or way so far + distance to the goal; perhaps a shot at the goal",
    revision: 4,
    needs: WorldKind::Roadmap,
    columns: &[
        "opened",
        "closed",
        "expansions",
        "generated",
        "shots",
        "checked_states",
        "connected",
        "components",
        "start_links",
        "goal_links",
        "unjoined_legs",
        "neighbour_mm",
        "used_samples",
        "straight_mm",
    ],
    settings: Accepted::shape::<RoadmapAstar>(),
    example: r#"
samples = 1500
neighbour_mm = 500
cost = "hops"
blind = true
goal_shot = "never"
path = "parents"
"#,
    build: Build::Planner(|settings| {
        let read: RoadmapAstar = settings.read()?;
        if read.neighbour_mm.is_some() == read.neighbour_times.is_some() {
            return Err(settings.error("exactly one of neighbour_mm and neighbour_times is accepted"));
        }
        let in_metres = read.neighbour_mm.and_then(|found| seems_in_metres("neighbour_mm", found));
        settings.accept_without("neighbour_mm", in_metres)?;
        Ok(Box::new(read))
    }),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct RoadmapAstar {
    /// How many samples: N.
    #[schemars(range(min = 1))]
    samples: u32,
    /// How far apart neighbours may be: ρ; given like this or as `neighbour_times`.
    #[schemars(extend("exclusiveMinimum" = 0))]
    neighbour_mm: Option<f64>,
    /// The same as a multiple of the problem's `radius_mm`.
    #[schemars(extend("exclusiveMinimum" = 0))]
    neighbour_times: Option<f64>,
    /// Whether all that the roadmap was built up to are neighbours, whatever ρ is.
    any_distance: Option<bool>,
    /// At most this many nearest samples are neighbours of a node.
    #[schemars(range(min = 1))]
    nearest: Option<u32>,
    /// What g counts.
    cost: EdgeCost,
    /// Whether the search is blind: `h = 0`, so that the path costs least in g.
    #[serde(default)]
    blind: bool,
    /// When a local path straight to the goal is tried.
    goal_shot: ShotSetting,
    /// Which nodes make the path.
    path: PathSetting,
}

#[derive(Deserialize, JsonSchema, Clone, Copy, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
enum ShotSetting {
    /// At no time.
    Never,
    /// Once, from the start.
    FromStart,
    /// From every node before it is expanded.
    BeforeExpansion,
}

#[derive(Deserialize, JsonSchema, Clone, Copy, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
enum PathSetting {
    /// From each node to the one it was reached from.
    Parents,
    /// All nodes of CLOSED in the order they came there (step 14, taken at its word).
    ClosedSequence,
}

impl RoadmapAstar {
    fn extent(&self) -> Extent {
        let [radius_mm, times] =
            [self.neighbour_mm, self.neighbour_times].map(|limit| limit.filter(|_| !self.is_unlimited()));
        Extent { samples: self.samples, radius_mm, times }
    }

    fn is_unlimited(&self) -> bool {
        self.any_distance == Some(true)
    }

    /// How far apart neighbours may be on the roadmap.
    fn neighbour_mm(&self, map: &Roadmap) -> f64 {
        let in_units = self.neighbour_times.map(|times| times * map.unit_mm());
        let limit = self.neighbour_mm.or(in_units).filter(|_| !self.is_unlimited());
        limit.unwrap_or(map.radius_mm())
    }

    fn part<'a>(&self, posed: &Posed<'a>) -> Result<Part<'a>, Invalid> {
        let prefix = posed.map.prefix(self.samples).map_err(Invalid)?;
        let [radius_mm, times] = [posed.map.radius_mm(), posed.map.times()].map(Some);
        let built = Extent { samples: self.samples, radius_mm, times };
        if let Some(lack) = built.lacks(&self.extent()) {
            return Err(Invalid(lack));
        }
        let nearest = self.nearest.map(|count| count as usize);
        Ok(Part::new(posed, prefix, self.neighbour_mm(posed.map), nearest, self.cost))
    }

    fn counts(&self, part: &Part<'_>, counters: &Counters, [shots, checked]: [u64; 2]) -> Counts {
        let components = part.map.components(part.prefix, part.radius_mm);
        let mut counts = counted(&[*counters]);
        counts.extend([
            ("checked_states", Value::Count(checked)),
            ("used_samples", Value::Count(u64::from(part.prefix))),
            ("straight_mm", Value::Real(part.map.gap_mm(part.start, part.goal))),
        ]);
        // Where configurations decide what is near, places need not.
        if part.radius_mm.is_finite() {
            counts.insert("neighbour_mm", Value::Real(part.radius_mm));
        }
        if self.goal_shot != ShotSetting::Never {
            counts.insert("shots", Value::Count(shots));
        }
        // With a cap on neighbours the relation is no longer mutual and has no components.
        if self.nearest.is_none() {
            let parts = components.iter().zip(0..).filter(|(part, node)| **part == *node).count();
            counts.insert("components", Value::Count(parts as u64));
            counts.insert("connected", Value::Count(u64::from(part.is_connected(&components))));
            let [start, goal] = part.end_links();
            counts.insert("start_links", Value::Count(start));
            counts.insert("goal_links", Value::Count(goal));
        }
        counts
    }
}

/// Where each node stands, as a closure over the roadmap's places.
fn distance_to(map: &Roadmap, goal: u32) -> impl Fn(u32) -> f64 {
    let goal_mm = map.place_mm(goal);
    move |node| {
        let at = map.place_mm(node);
        (0..3).map(|i| (at[i] - goal_mm[i]) * (at[i] - goal_mm[i])).sum::<f64>().sqrt()
    }
}

/// The plan along `nodes` in the order in which they were closed, with how many of its legs are no edges.
fn along_closed(map: &Roadmap, part: &mut Part<'_>, nodes: &[u32], mut counts: Counts) -> Plan {
    // The last leg is an edge or a shot that was found free.
    let unjoined = part.unjoined(&nodes[..nodes.len() - 1]);
    counts.insert("unjoined_legs", Value::Count(unjoined));
    solved(map, nodes, counts)
}

impl Planner for RoadmapAstar {
    fn plan(&self, request: &Request<'_>) -> Result<Plan, Invalid> {
        let posed = Posed::new(request)?;
        let mut part = self.part(&posed)?;
        let map = posed.map;
        let start = posed.start;
        let goal = posed.goal;
        let to_goal_mm = distance_to(map, goal);
        let weight = if self.blind { 0.0 } else { 1.0 };
        let estimate = Combined { h: |node| weight * to_goal_mm(node), combine: sum };
        let mut shots = 0;
        let mut checked = 0;
        let mut lists = VisitOrder::default();
        let mut shoot = |node: u32, _: f64| {
            let is_tried = match self.goal_shot {
                ShotSetting::Never => false,
                ShotSetting::FromStart => node == start,
                ShotSetting::BeforeExpansion => true,
            };
            shots += u64::from(is_tried);
            let (found, states) = is_tried.then(|| map.join_counted(node, goal))?;
            checked += states;
            found.is_ok().then_some(Shot { goal, cost: 1.0 })
        };
        let rules = Rules { stop: Stop::GoalPopped, max_expansions: request.expansions };
        let update = Update::default();
        let terms = SideInputs { graph: &mut part, estimate: &estimate, observer: &mut lists, update };
        let report =
            Search::new(Heap::new(Ties::Fifo)).run(terms, start, |node| node == goal, rules, &mut shoot);
        let counts = self.counts(&part, &report.counters, [shots, checked]);
        let mut plan = match report.outcome {
            Outcome::NoPath => unsolved(Ending::NoPath, counts),
            Outcome::BudgetSpent => unsolved(Ending::BudgetSpent, counts),
            Outcome::Solved(route) if self.path == PathSetting::Parents => solved(map, &route.nodes, counts),
            Outcome::Solved(_) => {
                let nodes: Vec<u32> = lists.closed.iter().copied().chain([goal]).collect();
                along_closed(map, &mut part, &nodes, counts)
            }
        };
        if request.trace {
            plan.traces.push(places("closed", map, &lists.closed));
        }
        Ok(plan)
    }

    /// The graph is what its settings leave of the roadmap. The straight distance never lies above the rest of a way and falls by
    /// no more than an edge is long, so that no closed node could be reached cheaper.
    fn is_optimal(&self) -> bool {
        let searches_alone = self.goal_shot == ShotSetting::Never && self.path == PathSetting::Parents;
        searches_alone && self.nearest.is_none() && self.cost == EdgeCost::Length
    }

    fn asks(&self) -> Option<Extent> {
        Some(self.extent())
    }
}

/// The places of nodes, in the order given.
fn places(name: &str, map: &Roadmap, nodes: &[u32]) -> Trace {
    let values = nodes.iter().flat_map(|node| map.place_mm(*node)).collect();
    Trace { name: name.to_owned(), width: 3, values }
}

#[cfg(test)]
mod tests;
