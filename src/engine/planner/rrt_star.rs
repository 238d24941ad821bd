//! RRT*, on samples from everywhere or from where a shorter path can be.
//!
//! It goes on until its budget is spent. Informed samples come from the ellipsoid of points that could lie on a shorter
//! path than the best so far. A joint that turns without end takes the shorter way round there, so paths the other way
//! round are missed. A leg of the best path that a finer look refuses leaves the tree: the node behind it takes another parent, or is cut off
//! with all behind it.
//!
//! # Source
//! Karaman & Frazzoli, *Int. J. Robotics Research* 30(7), 846 (2011), algorithm 6 with k-nearest neighbours; Gammell, Srinivasa &
//! Barfoot, *Informed RRT\**, IROS 2014.

use super::rrt::sample;
use super::sampled::{IMPROVING_COLUMNS, Progress, SampledPlanner, SampledSearch, extended};
use super::{Build, Entry, Request};
use crate::sampling::{Draw, DrawSetting, Motions, Tree};
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use world::space::WorldKind;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "rrt_star",
    about: "RRT that goes on: each new node takes the cheapest of its neighbours as parent and is offered to them; informed or not",
    revision: 3,
    needs: WorldKind::Roadmap,
    columns: IMPROVING_COLUMNS,
    settings: Accepted::shape::<RrtStar>(),
    example: r#"
range = 2
sampler = "seeded"
goal_share = 0.05
iterations = 1_000
informed = true
"#,
    build: Build::Planner(|settings| {
        let search: RrtStar = settings.read()?;
        if search.informed && search.sampler == DrawSetting::Halton {
            let message = "informed samples are random; sampler = \"seeded\" is accepted";
            return Err(settings.error_at("sampler", message));
        }
        Ok(Box::new(SampledPlanner(search)))
    }),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct RrtStar {
    /// The longest step: the root of the sum of squares of radians and, of joints that slide, metres; millimetres in the plane.
    #[schemars(extend("exclusiveMinimum" = 0))]
    range: f64,
    /// Where samples come from.
    sampler: DrawSetting,
    /// The share of iterations whose sample is the goal, until there is a path.
    #[schemars(range(min = 0, max = 1))]
    goal_share: f64,
    /// Samples; without a path after as many there is none to be found; the study's budget of expansions limits them as well.
    #[schemars(range(min = 1, max = 10_000_000))]
    iterations: u64,
    /// Whether samples after the first path come from where a shorter one can be.
    informed: bool,
    /// How near the goal a node must be to be joined with it, in the unit of `range`; as near as `range` if absent.
    #[schemars(extend("exclusiveMinimum" = 0))]
    reach: Option<f64>,
    /// Whether every node keeps the nearest node as parent, and not the cheapest of its neighbours: this is RRT that goes on after
    /// its first path.
    #[serde(default)]
    nearest_parent: bool,
}

/// How many nearest nodes are neighbours among `count`: `e (1 + 1 / d) ln n`.
pub(super) fn neighbour_count(count: usize, axes: usize) -> usize {
    let factor = std::f64::consts::E * (1.0 + 1.0 / axes as f64);
    (factor * libm::log(count as f64)).ceil().max(1.0) as usize
}

/// The tree of RRT*: what each node costs, and which were reached from it.
struct Costs {
    tree: Tree,
    cost: Vec<f64>,
    children: Vec<Vec<u32>>,
}

impl Costs {
    fn new(tree: Tree) -> Self {
        Self { tree, cost: vec![0.0], children: vec![Vec::new()] }
    }

    fn add(&mut self, config: &[f64], parent: u32, cost: f64) -> u32 {
        let node = self.tree.add(config, parent);
        self.children[parent as usize].push(node);
        self.children.push(Vec::new());
        self.cost.push(cost);
        node
    }

    /// Makes `parent` the parent of a node, which has this cost there; what all behind it cost changes as much.
    fn rewire(&mut self, node: u32, parent: u32, cost: f64) {
        self.detach(node);
        self.children[parent as usize].push(node);
        self.tree.set_parent(node, parent);
        let less = self.cost[node as usize] - cost;
        for node in self.branch(node) {
            self.cost[node as usize] -= less;
        }
    }

    /// Cuts off a node with all behind it: they are near nothing any more.
    fn cut(&mut self, node: u32) {
        self.detach(node);
        for node in self.branch(node) {
            self.tree.hide(node);
            self.cost[node as usize] = f64::INFINITY;
        }
    }

    fn detach(&mut self, node: u32) {
        self.children[self.tree.parent(node) as usize].retain(|child| *child != node);
    }

    /// A node and all behind it.
    fn branch(&self, node: u32) -> Vec<u32> {
        let mut branch = vec![node];
        let mut next = 0;
        while next < branch.len() {
            branch.extend_from_slice(&self.children[branch[next] as usize]);
            next += 1;
        }
        branch
    }
}

/// How often an informed sample is drawn again that is outside the limits or the ellipsoid.
const TRIES: u32 = 1000;

/// A sample evenly from what is within the limits and on no way from start to goal that is longer than `length`.
///
/// The ellipsoid and the limits take turns as what is drawn from; a draw that is in both is the sample. So neither an ellipsoid much
/// larger than the limits nor one much smaller takes many draws.
fn informed(draw: &mut Draw, motions: &Motions<'_>, request: &Request<'_>, length: f64) -> Option<Vec<f64>> {
    let way = |at: &Vec<f64>| motions.distance(request.start, at) + motions.distance(at, request.goal);
    (0..TRIES).find_map(|_| {
        in_ellipsoid(draw, motions, request, length)
            .or_else(|| Some(motions.sample(draw)).filter(|sample| way(sample) <= length))
    })
}

/// A sample evenly from the ellipsoid about start and goal of what is on no way longer than `length`; `None` outside the limits.
fn in_ellipsoid(
    draw: &mut Draw,
    motions: &Motions<'_>,
    request: &Request<'_>,
    length: f64,
) -> Option<Vec<f64>> {
    let along = motions.change(request.start, request.goal);
    let least = along.iter().map(|by| by * by).sum::<f64>().sqrt();
    let narrow = (length * length - least * least).max(0.0).sqrt();
    let mut ball = draw.in_ball(along.len());
    for (axis, part) in ball.iter_mut().enumerate() {
        *part *= 0.5 * if axis == 0 { length } else { narrow };
    }
    // The mirror that takes the first axis to the direction of the goal.
    let mut normal: Vec<f64> = along.iter().map(|by| -by / least).collect();
    normal[0] += 1.0;
    let square: f64 = normal.iter().map(|part| part * part).sum();
    if square > 0.0 {
        let across = 2.0 * normal.iter().zip(&ball).map(|(a, b)| a * b).sum::<f64>() / square;
        ball.iter_mut().zip(&normal).for_each(|(part, by)| *part -= across * by);
    }
    let middle = request.start.iter().zip(&along).map(|(start, by)| start + 0.5 * by);
    let sample = motions.settled(middle.zip(ball).map(|(middle, by)| middle + by).collect());
    let limits = motions.limits().iter().zip(motions.turn_on());
    let is_within = sample
        .iter()
        .zip(limits)
        .all(|(value, (limits, turns_on))| *turns_on || (limits[0]..=limits[1]).contains(value));
    is_within.then_some(sample)
}

impl SampledSearch for RrtStar {
    const IMPROVES: bool = true;

    fn search(&self, motions: &mut Motions<'_>, request: &Request<'_>) -> Progress {
        let mut found = Progress::default();
        let mut draw = Draw::new(self.sampler, request.seed);
        let mut costs = Costs::new(Tree::new(motions, request.start));
        // Nodes from which a free motion leads to the goal, each with its length.
        let mut before_goal: Vec<(u32, f64)> = Vec::new();
        while found.iterations < self.limit(request) {
            found.iterations += 1;
            let length = found.incumbents.last().map(|(_, length)| *length);
            let sample = match length {
                Some(length) if self.informed => informed(&mut draw, motions, request, length),
                Some(_) => Some(motions.sample(&mut draw)),
                None => Some(sample(&mut draw, motions, request.goal, self.goal_share)),
            };
            let Some(sample) = sample else { continue };
            let near = costs.tree.nearest(&sample).0;
            let Some(step) = extended(motions, &costs.tree, near, &sample, self.range) else { continue };
            let node = if self.nearest_parent {
                let cost = costs.cost[near as usize] + motions.distance(costs.tree.config(near), &step);
                costs.add(&step, near, cost)
            } else {
                insert(motions, &mut costs, near, &step)
            };
            let to_goal = motions.distance(&step, request.goal);
            if to_goal <= self.reach.unwrap_or(self.range) && motions.goes(&step, request.goal) {
                before_goal.push((node, to_goal));
            }
            let whole = |(node, rest): &(u32, f64)| costs.cost[*node as usize] + rest;
            let Some(last) = before_goal.iter().copied().min_by(|a, b| whole(a).total_cmp(&whole(b))) else {
                continue;
            };
            if length.is_some_and(|known| whole(&last) >= known) {
                continue;
            }
            let mut path = costs.tree.path(last.0);
            path.push(request.goal.to_vec());
            match motions.refused_leg(&path) {
                None => {
                    path.dedup();
                    found.note(whole(&last));
                    found.path = path;
                }
                Some(leg) if leg + 2 == path.len() => before_goal.retain(|(node, _)| *node != last.0),
                Some(leg) => {
                    let refused = costs.tree.way(last.0)[leg + 1];
                    if self.nearest_parent || !replanted(motions, &mut costs, refused) {
                        costs.cut(refused);
                        before_goal.retain(|(node, _)| costs.cost[*node as usize].is_finite());
                    }
                }
            }
        }
        found.nodes = costs.tree.count();
        found
    }

    fn iterations(&self) -> u64 {
        self.iterations
    }

    fn draws(&self) -> bool {
        self.sampler == DrawSetting::Seeded || self.goal_share > 0.0
    }
}

/// Adds a node under the cheapest neighbour and offers it to the others.
fn insert(motions: &mut Motions<'_>, costs: &mut Costs, nearest: u32, config: &[f64]) -> u32 {
    let count = neighbour_count(costs.tree.count(), config.len());
    let near = costs.tree.nearest_of(config, count);
    let first = motions.distance(costs.tree.config(nearest), config);
    let mut parent = nearest;
    let mut cost = costs.cost[nearest as usize] + first;
    let mut joined = vec![nearest];
    for (other, gap) in &near {
        let through = costs.cost[*other as usize] + gap;
        if through < cost && motions.goes(costs.tree.config(*other), config) {
            (parent, cost) = (*other, through);
            joined.push(*other);
        }
    }
    let node = costs.add(config, parent, cost);
    for (other, gap) in near {
        let through = cost + gap;
        let is_shorter = through < costs.cost[other as usize];
        if is_shorter && (joined.contains(&other) || motions.goes(config, costs.tree.config(other))) {
            costs.rewire(other, node, through);
        }
    }
    node
}

/// Gives a node the cheapest neighbour as parent from which a finer look lets it be reached; whether there is one.
fn replanted(motions: &mut Motions<'_>, costs: &mut Costs, node: u32) -> bool {
    let config = costs.tree.config(node).to_vec();
    let branch = costs.branch(node);
    let mut near = costs.tree.nearest_of(&config, neighbour_count(costs.tree.count(), config.len()));
    near.retain(|(other, _)| !branch.contains(other));
    for (other, gap) in &mut near {
        *gap += costs.cost[*other as usize];
    }
    near.sort_by(|a, b| a.1.total_cmp(&b.1));
    let parent = near.into_iter().find(|(other, _)| {
        let leg = [costs.tree.config(*other).to_vec(), config.clone()];
        motions.refused_leg(&leg).is_none()
    });
    if let Some((parent, cost)) = parent {
        costs.rewire(node, parent, cost);
    }
    parent.is_some()
}

#[cfg(test)]
mod tests {
    use super::*;
    use world::space::World;
    use world::space::roadmap::{Counted, Local, Near, PlaneMap, Roadmap};

    #[test]
    fn informed_samples_are_even_within_the_limits_and_on_no_longer_way() {
        let local = Local::Plane(PlaneMap::new([100.0, 100.0], Vec::new()));
        let roadmap = Roadmap::build(local, Vec::new(), Near::Places(0.0), Counted::Accepted);
        let world = World::Roadmap(Box::new(roadmap));
        let (start, goal) = ([20.0, 5.0], [80.0, 20.0]);
        let request =
            Request { world: &world, start: &start, goal: &goal, expansions: 1, seed: 1, trace: false };
        let motions = Motions::new(super::super::sampled::local(&request));
        // From a sliver of the square to nearly all of it.
        for length in [62.5, 70.0, 100.0, 140.0] {
            let mut draw = Draw::new(DrawSetting::Seeded, 11);
            let way = |at: &[f64]| motions.distance(&start, at) + motions.distance(at, &goal);
            let is_within =
                |at: &Vec<f64>| at.iter().all(|x| (0.0..=100.0).contains(x)) && way(at) <= length + 0.2;
            let samples: Vec<_> =
                (0..4000).filter_map(|_| informed(&mut draw, &motions, &request, length)).collect();
            assert_eq!(samples.len(), 4000, "seed 11, {length} mm: each draw gives one");
            assert!(samples.iter().all(is_within), "seed 11, {length} mm");
            let everywhere = std::iter::repeat_with(|| motions.sample(&mut draw));
            let kept: Vec<_> = everywhere.filter(|at| way(at) <= length).take(4000).collect();
            for (axis, middle) in [(0, 50.0), (1, 12.5), (1, 40.0)] {
                let below = |points: &[Vec<f64>]| points.iter().filter(|at| at[axis] < middle).count();
                let [below, known] = [&samples, &kept].map(|points| below(points));
                assert!(
                    below.abs_diff(known) < 160,
                    "seed 11, {length} mm: {below} and {known} below {middle}"
                );
            }
        }
    }
}
