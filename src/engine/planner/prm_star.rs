//! PRM*: a roadmap of free samples, each joined with its `e (1 + 1 / d) ln n` nearest or with as many as a setting says.
//!
//! # Source
//! Karaman & Frazzoli, *Int. J. Robotics Research* 30(7), 846 (2011), algorithm 4 with k-nearest neighbours, built anew whenever it is searched.

use super::rrt_star::neighbour_count;
use super::sampled::{IMPROVING_COLUMNS, Progress, SampledSearch, local, sampled};
use super::{Build, Entry, Request};
use crate::sampling::{Draw, DrawSetting, Motions, Tree};
use crate::search::{Combined, Graph, Heap, Outcome, Rules, Search, SideInputs, Stop, Ties, Update, sum};
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use world::space::WorldKind;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "prm_star",
    about: "a roadmap whose samples are joined with their nearest ones, more as it grows; built and searched once or as it grows",
    revision: 3,
    needs: WorldKind::Roadmap,
    columns: IMPROVING_COLUMNS,
    settings: Accepted::shape::<PrmStar>(),
    example: r#"
sampler = "halton"
iterations = 1_000
growth = 1.1
"#,
    build: Build::Planner(sampled::<PrmStar>),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct PrmStar {
    /// Where samples come from.
    sampler: DrawSetting,
    /// Samples; without a path after as many there is none to be found; the study's budget of expansions limits them as well.
    #[schemars(range(min = 1, max = 10_000_000))]
    iterations: u64,
    /// When the roadmap is built and searched: after the first iteration, whenever there are this many times as many iterations as
    /// at the last search, and at the end. Only at the end if absent.
    #[schemars(range(min = 1.001, max = 100))]
    growth: Option<f64>,
    /// How many nearest samples each is joined with (k-nearest sPRM, algorithm 2 of the same source); `e (1 + 1 / d) ln n`, which
    /// grows with the roadmap, if absent.
    #[schemars(range(min = 1, max = 1000))]
    nearest: Option<usize>,
}

/// The roadmap: a node's neighbours, each with how far it is.
struct Roadmap {
    nodes: Tree,
    links: Vec<Vec<(u32, f64)>>,
}

impl Graph for &Roadmap {
    type Cost = f64;

    fn node_count(&self) -> usize {
        self.links.len()
    }

    fn successors(&mut self, node: u32, mut visit: impl FnMut(u32, f64)) {
        self.links[node as usize].iter().for_each(|(to, gap)| visit(*to, *gap));
    }
}

impl Roadmap {
    /// Joins each node with the nearest of all, so many or `e (1 + 1 / d) ln n`.
    fn join(&mut self, motions: &mut Motions<'_>, nearest: Option<usize>) {
        let count = self.nodes.count();
        let nearest = nearest.unwrap_or_else(|| neighbour_count(count, self.nodes.config(0).len()));
        self.links = vec![Vec::new(); count];
        for node in 0..count as u32 {
            for (other, gap) in self.nodes.nearest_of(self.nodes.config(node), nearest + 1) {
                let is_known = other == node || self.links[node as usize].iter().any(|(to, _)| *to == other);
                if !is_known && motions.goes(self.nodes.config(node), self.nodes.config(other)) {
                    self.links[node as usize].push((other, gap));
                    self.links[other as usize].push((node, gap));
                }
            }
        }
    }

    /// Takes the link between two nodes away.
    fn part(&mut self, [a, b]: [u32; 2]) {
        self.links[a as usize].retain(|(to, _)| *to != b);
        self.links[b as usize].retain(|(to, _)| *to != a);
    }

    /// The nodes of the shortest way from the first node to the second.
    fn shortest(&self, motions: &Motions<'_>) -> Option<Vec<u32>> {
        let h = |node: u32| motions.distance(self.nodes.config(node), self.nodes.config(1));
        let mut graph = self;
        let terms = SideInputs {
            graph: &mut graph,
            estimate: &Combined { h, combine: sum },
            observer: &mut (),
            update: Update::default(),
        };
        let rules = Rules { stop: Stop::GoalPopped, max_expansions: u64::MAX };
        let report = Search::new(Heap::new(Ties::Fifo)).run(terms, 0, |node| node == 1, rules, &mut ());
        if let Outcome::Solved(route) = report.outcome { Some(route.nodes) } else { None }
    }
}

impl SampledSearch for PrmStar {
    const IMPROVES: bool = true;

    fn search(&self, motions: &mut Motions<'_>, request: &Request<'_>) -> Progress {
        let mut found = Progress::default();
        let mut draw = Draw::new(self.sampler, request.seed);
        let mut map = Roadmap { nodes: Tree::new(motions, request.start), links: Vec::new() };
        map.nodes.add(request.goal, 0);
        let limit = self.limit(request);
        let mut due = self.growth.map_or(f64::INFINITY, |_| 1.0);
        while found.iterations < limit {
            found.iterations += 1;
            let sample = motions.sample(&mut draw);
            if local(request).refusal(&sample).is_none() {
                map.nodes.add(&sample, 0);
            }
            if (found.iterations as f64) < due && found.iterations < limit {
                continue;
            }
            due = self.growth.map_or(due, |growth| found.iterations as f64 * growth);
            map.join(motions, self.nearest);
            while let Some(nodes) = map.shortest(motions) {
                let path: Vec<Vec<f64>> = nodes.iter().map(|node| map.nodes.config(*node).to_vec()).collect();
                let Some(leg) = motions.refused_leg(&path) else {
                    if found.note(motions.length(&path)) {
                        found.path = path;
                    }
                    break;
                };
                map.part([nodes[leg], nodes[leg + 1]]);
            }
        }
        found.nodes = map.nodes.count();
        found
    }

    fn iterations(&self) -> u64 {
        self.iterations
    }

    fn draws(&self) -> bool {
        self.sampler == DrawSetting::Seeded
    }
}
