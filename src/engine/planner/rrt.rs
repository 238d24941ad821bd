//! RRT, which ends with its first path.
//!
//! # Source
//! `LaValle`, *Rapidly-Exploring Random Trees: A New Tool for Path Planning*, TR 98-11, Iowa State University (1998); the goal as a sample
//! now and then as in `LaValle` & Kuffner, *Int. J. Robotics Research* 20(5), 378 (2001).

use super::sampled::{COLUMNS, Progress, SampledSearch, extended, sampled};
use super::{Build, Entry, Request};
use crate::sampling::{Draw, DrawSetting, Motions, Tree};
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use world::space::WorldKind;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "rrt",
    about: "a tree that grows from the start to samples until a step reaches the goal",
    revision: 3,
    needs: WorldKind::Roadmap,
    columns: COLUMNS,
    settings: Accepted::shape::<Rrt>(),
    example: r#"
range = 2
sampler = "seeded"
goal_share = 0.05
iterations = 100_000
"#,
    build: Build::Planner(sampled::<Rrt>),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Rrt {
    /// The longest step: the root of the sum of squares of radians and, of joints that slide, metres; millimetres in the plane.
    #[schemars(extend("exclusiveMinimum" = 0))]
    range: f64,
    /// Where samples come from.
    sampler: DrawSetting,
    /// The share of iterations whose sample is the goal.
    #[schemars(range(min = 0, max = 1))]
    goal_share: f64,
    /// Samples at most; without a path after as many there is none to be found; the study's budget of expansions limits them as well.
    #[schemars(range(min = 1, max = 10_000_000))]
    iterations: u64,
}

impl SampledSearch for Rrt {
    const IMPROVES: bool = false;

    fn search(&self, motions: &mut Motions<'_>, request: &Request<'_>) -> Progress {
        let mut found = Progress::default();
        let mut draw = Draw::new(self.sampler, request.seed);
        let mut tree = Tree::new(motions, request.start);
        while found.path.is_empty() && found.iterations < self.limit(request) {
            found.iterations += 1;
            let sample = sample(&mut draw, motions, request.goal, self.goal_share);
            let near = tree.nearest(&sample).0;
            let Some(step) = extended(motions, &tree, near, &sample, self.range) else { continue };
            let node = tree.add(&step, near);
            if motions.distance(&step, request.goal) <= self.range && motions.goes(&step, request.goal) {
                let mut path = tree.path(node);
                path.push(request.goal.to_vec());
                match motions.refused_leg(&path) {
                    None => {
                        path.dedup();
                        found.path = path;
                    }
                    // The last leg is of no tree; the node before the goal is cut off for it.
                    Some(leg) => tree.cut(tree.way(node)[(leg + 1).min(path.len() - 2)]),
                }
            }
        }
        found.nodes = tree.count();
        found
    }

    fn iterations(&self) -> u64 {
        self.iterations
    }

    fn draws(&self) -> bool {
        self.sampler == DrawSetting::Seeded || self.goal_share > 0.0
    }
}

/// The goal or a sample from everywhere.
pub(super) fn sample(draw: &mut Draw, motions: &Motions<'_>, goal: &[f64], goal_share: f64) -> Vec<f64> {
    if goal_share > 0.0 && draw.share() < goal_share {
        return goal.to_vec();
    }
    motions.sample(draw)
}
