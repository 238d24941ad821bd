//! RRT-Connect with VAMP's settings: balanced trees, dynamic domain, a Halton sequence.
//!
//! # Source
//! Kuffner & `LaValle`, *RRT-Connect: An Efficient Approach to Single-Query Path Planning*, ICRA 2000; the balance of trees as in VAMP
//! (Thomason, Kingston & Kavraki, *Motions in Microseconds via Vectorized Sampling-Based Planning*, ICRA 2024); the dynamic domain as in
//! Yershova et al., ICRA 2005, and Jaillet et al., IROS 2005 (adaptive radius).

use super::sampled::{COLUMNS, Progress, SampledSearch, extended, sampled};
use super::{Build, Entry, Request};
use crate::sampling::{Draw, DrawSetting, Motions, Tree};
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use world::space::WorldKind;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "rrt_connect",
    about: "two trees, from start and goal, that grow to samples and to each other; dynamic domain, balance and sampler as settings",
    revision: 3,
    needs: WorldKind::Roadmap,
    columns: COLUMNS,
    settings: Accepted::shape::<RrtConnect>(),
    example: r#"
range = 2
sampler = "halton"
balance = 1
dynamic_domain = { radius = 4, alpha = 0.0001, least_radius = 1 }
first = "start"
iterations = 100_000
nodes = 100_000
"#,
    build: Build::Planner(sampled::<RrtConnect>),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct RrtConnect {
    /// The longest step: the root of the sum of squares of radians and, of joints that slide, metres; millimetres in the plane.
    #[schemars(extend("exclusiveMinimum" = 0))]
    range: f64,
    /// Where samples come from.
    sampler: DrawSetting,
    /// Trees take turns only while their sizes differ by less than this share of the current one; they always do if absent.
    #[schemars(extend("exclusiveMinimum" = 0))]
    balance: Option<f64>,
    /// Nodes at obstacles draw samples from a ball around them alone; all draw from everywhere if absent.
    dynamic_domain: Option<DynamicDomain>,
    /// Whose tree grows first.
    first: FirstTree,
    /// Samples at most; without a path after as many there is none to be found; the study's budget of expansions limits them as well.
    #[schemars(range(min = 1))]
    iterations: u64,
    /// Nodes of both trees at most.
    #[schemars(range(min = 2, max = 10_000_000))]
    nodes: usize,
}

#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct DynamicDomain {
    /// The radius of a node from which a first step failed, in the unit of `range`.
    #[schemars(extend("exclusiveMinimum" = 0))]
    radius: f64,
    /// The share by which it grows after a free step and shrinks after another.
    #[schemars(range(min = 0, max = 1))]
    alpha: f64,
    /// The least radius.
    #[schemars(extend("exclusiveMinimum" = 0))]
    least_radius: f64,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
enum FirstTree {
    /// The start's.
    Start,
    /// The goal's.
    Goal,
}

/// One of the two trees, with the radius of each node.
struct Side {
    tree: Tree,
    radii: Vec<f64>,
}

impl Side {
    fn new(motions: &Motions<'_>, root: &[f64]) -> Self {
        Self { tree: Tree::new(motions, root), radii: vec![f64::INFINITY] }
    }

    fn add(&mut self, config: &[f64], parent: u32) -> u32 {
        self.radii.push(f64::INFINITY);
        self.tree.add(config, parent)
    }
}

impl DynamicDomain {
    /// The radius after a step from a node that has this one.
    fn after(&self, radius: f64, is_free: bool) -> f64 {
        match (radius.is_finite(), is_free) {
            (false, true) => radius,
            (false, false) => self.radius,
            (true, true) => radius * (1.0 + self.alpha),
            (true, false) => (radius * (1.0 - self.alpha)).max(self.least_radius),
        }
    }
}

impl SampledSearch for RrtConnect {
    const IMPROVES: bool = false;

    fn search(&self, motions: &mut Motions<'_>, request: &Request<'_>) -> Progress {
        let mut found = Progress::default();
        let straight = vec![request.start.to_vec(), request.goal.to_vec()];
        if motions.goes(request.start, request.goal) && motions.refused_leg(&straight).is_none() {
            found.path = straight;
            return found;
        }
        let mut draw = Draw::new(self.sampler, request.seed);
        let mut sides = [request.start, request.goal].map(|end| Side::new(motions, end));
        // Before the first sample the trees take turns once.
        let mut own = usize::from(self.first == FirstTree::Start);
        let limit = self.limit(request);
        while found.iterations < limit && sides[0].tree.count() + sides[1].tree.count() < self.nodes {
            found.iterations += 1;
            let [size, other] = [own, 1 - own].map(|side| sides[side].tree.count() as f64);
            if self.balance.is_none_or(|ratio| (size - other).abs() / size < ratio) {
                own = 1 - own;
            }
            let sample = motions.sample(&mut draw);
            if let Some(met) = self.grow(motions, &mut sides, own, &sample) {
                let (path, ends) = joined(&sides, own, met);
                let Some(leg) = motions.refused_leg(&path) else {
                    found.path = path;
                    break;
                };
                let (side, node) = ends[leg];
                sides[side].tree.cut(node);
            }
        }
        found.nodes = sides.iter().map(|side| side.tree.count()).sum();
        found
    }

    fn iterations(&self) -> u64 {
        self.iterations
    }

    fn draws(&self) -> bool {
        self.sampler == DrawSetting::Seeded
    }
}

impl RrtConnect {
    /// Grows one tree to a sample and then to the other tree; gives a node of each where they meet, the own first.
    fn grow(
        &self,
        motions: &mut Motions<'_>,
        sides: &mut [Side; 2],
        own: usize,
        sample: &[f64],
    ) -> Option<[u32; 2]> {
        let (near, distance) = sides[own].tree.nearest(sample);
        let radius = sides[own].radii[near as usize];
        if self.dynamic_domain.is_some() && radius < distance {
            return None;
        }
        let step = extended(motions, &sides[own].tree, near, sample, self.range);
        if let Some(domain) = &self.dynamic_domain {
            sides[own].radii[near as usize] = domain.after(radius, step.is_some());
        }
        let mut last = sides[own].add(&step?, near);
        let (target, distance) = sides[1 - own].tree.nearest(sides[own].tree.config(last));
        let goal = sides[1 - own].tree.config(target).to_vec();
        let from = sides[own].tree.config(last).to_vec();
        let steps = (distance / self.range).ceil().max(1.0) as u32;
        for step in 1..=steps {
            let to = motions.between(&from, &goal, f64::from(step) / f64::from(steps));
            if sides[0].tree.count() + sides[1].tree.count() >= self.nodes
                || !motions.goes(sides[own].tree.config(last), &to)
            {
                return None;
            }
            last = sides[own].add(&to, last);
        }
        Some([last, target])
    }
}

/// The path from start to goal over a node of each tree, which are at one place. Each leg comes with its tree, and with
/// its node there that is farther from the root.
fn joined(sides: &[Side; 2], own: usize, [last, target]: [u32; 2]) -> (Vec<Vec<f64>>, Vec<(usize, u32)>) {
    let there = sides[own].tree.way(last);
    let mut back = sides[1 - own].tree.way(target);
    back.reverse();
    let configs = |side: usize, way: &[u32]| -> Vec<Vec<f64>> {
        way.iter().map(|node| sides[side].tree.config(*node).to_vec()).collect()
    };
    let mut path = [configs(own, &there[..there.len() - 1]), configs(1 - own, &back)].concat();
    let ends = there[1..].iter().map(|node| (own, *node));
    let mut ends: Vec<_> = ends.chain(back[..back.len() - 1].iter().map(|node| (1 - own, *node))).collect();
    if own == 1 {
        path.reverse();
        ends.reverse();
    }
    (path, ends)
}

#[cfg(test)]
mod tests {
    use super::*;
    use world::space::roadmap::{Local, PlaneMap};

    #[test]
    fn each_leg_of_a_joined_path_has_the_node_that_its_tree_loses_if_it_is_refused() {
        let local = Local::Plane(PlaneMap::new([100.0, 100.0], Vec::new()));
        let motions = Motions::new(&local);
        let mut sides = [[0.0, 0.0], [90.0, 0.0]].map(|end| Side::new(&motions, &end));
        let last = (1..=3).fold(0, |parent, step| sides[0].add(&[f64::from(step) * 20.0, 0.0], parent));
        let other = sides[1].add(&[75.0, 0.0], 0);
        let target = sides[1].add(&[60.0, 0.0], other);
        for (own, met) in [(0, [last, target]), (1, [target, last])] {
            let (path, ends) = joined(&sides, own, met);
            let along: Vec<f64> = path.iter().map(|config| config[0]).collect();
            assert_eq!(along, [0.0, 20.0, 40.0, 60.0, 75.0, 90.0]);
            assert_eq!(ends.len(), 5);
            for (leg, (side, node)) in ends.into_iter().enumerate() {
                let far = sides[side].tree.config(node)[0];
                assert_eq!(far, along[if side == 0 { leg + 1 } else { leg }], "leg {leg}, own tree {own}");
            }
        }
    }

    #[test]
    fn the_radius_of_a_node_is_set_by_its_first_failed_step_and_then_follows_its_steps() {
        let domain = DynamicDomain { radius: 4.0, alpha: 0.5, least_radius: 1.5 };
        let after = |steps: &[bool]| {
            steps.iter().fold(f64::INFINITY, |radius, is_free| domain.after(radius, *is_free))
        };
        for (steps, radius) in [
            (&[true, true][..], f64::INFINITY),
            (&[true, false], 4.0),
            (&[false, true], 6.0),
            (&[false, false], 2.0),
            (&[false, false, false], 1.5),
            (&[false, false, false, true], 2.25),
        ] {
            assert_eq!(after(steps), radius, "{steps:?}");
        }
    }
}
