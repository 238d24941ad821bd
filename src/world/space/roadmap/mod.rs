//! Probabilistic roadmaps: samples in the order they were drawn, and the local paths between them.
//!
//! A roadmap is built once. Its first N samples are a roadmap too, and so are its edges up to any smaller radius: both are read
//! off, and nothing is built again. (Where so many nearest samples are neighbours, a part keeps the edges among its own.) A query
//! adds its own start and goal and nothing else. What was found out about a pair of configurations is remembered, so that
//! queries, sizes and contenders share it; it depends on the pair alone.

mod local;
mod near;
mod plane;
#[cfg(test)]
mod tests;

pub use local::{Local, MotionScratch, joints};
pub use near::Near;
pub use plane::{PlaneMap, RASTER_MM};
use schemars::JsonSchema;
use serde::Deserialize;

use super::cell::{Rejection, Scratch};
use local::Node;
use near::Samples;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard};

/// Neighbours of a node and how far they are, in the order of their numbers.
pub type Links = Arc<Vec<(u32, f64)>>;

/// A sample as it was drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Sample {
    /// The configuration.
    pub config: Vec<f64>,
    /// How many draws came before it, refused ones included.
    pub drawn_after: u32,
}

/// Which samples belong to a roadmap of N.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Counted {
    /// The first N that were accepted.
    Accepted,
    /// Those accepted among the first N draws.
    Drawn,
}

/// How large a roadmap is, or what a planner asks of one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    /// How many samples, or draws where draws are counted.
    pub samples: u32,
    /// How far apart neighbours may be; none for a planner that takes all that was built or a multiple of the roadmap's unit.
    pub radius_mm: Option<f64>,
    /// The same in the roadmap's unit; none for a planner that takes millimetres.
    pub times: Option<f64>,
}

impl Extent {
    /// Why a roadmap of this size does not do for what is `wanted`; `None` if it does.
    pub fn lacks(&self, wanted: &Self) -> Option<String> {
        let samples = self.samples;
        if wanted.samples > samples {
            let requested = wanted.samples;
            return Some(format!("{requested} samples are requested; the roadmap was built with {samples}"));
        }
        let lacks = |wanted: Option<f64>, built: Option<f64>, unit: &str| {
            let (requested, built) = wanted.zip(built).filter(|(requested, built)| requested > built)?;
            Some(format!(
                "neighbours up to {requested} {unit} are requested; the roadmap was built up to {built} {unit}"
            ))
        };
        let in_mm = lacks(wanted.radius_mm, self.radius_mm, "mm");
        in_mm.or_else(|| lacks(wanted.times, self.times, "times its unit"))
    }
}

/// Samples, edges, and what was learned about them.
#[derive(Debug)]
pub struct Roadmap {
    local: Local,
    counted: Counted,
    samples: Vec<Sample>,
    nodes: Vec<Node>,
    near: Samples,
    unit_mm: f64,
    times: f64,
    numbers: BTreeMap<Vec<u64>, u32>,
    links: Vec<Links>,
    tally: Tally,
    memory: Mutex<Memory>,
}

/// What became of the pairs of samples that are near each other.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Tally {
    /// Pairs that were tried.
    pub pairs: u64,
    /// Those that became edges.
    pub edges: u64,
    /// Those that did not, by [`Rejection::ALL`].
    pub rejected: [u64; Rejection::ALL.len()],
    /// Configurations that were checked for contact on the way.
    pub checked: u64,
}

/// What was found out about a pair, and at how many configurations contact was checked for it.
type Joined = (Result<(), Rejection>, u64);

/// Ends of queries and pairs that are no edges of the roadmap itself.
#[derive(Debug, Default)]
struct Memory {
    scratch: Scratch,
    ends: Vec<End>,
    numbers: BTreeMap<Vec<u64>, u32>,
    joins: BTreeMap<(u32, u32), Joined>,
    parts: BTreeMap<(u32, u64), Arc<Vec<u32>>>,
}

#[derive(Debug)]
struct End {
    config: Vec<f64>,
    node: Node,
    place_mm: [f64; 3],
    links: Links,
}

fn bits(config: &[f64]) -> Vec<u64> {
    config.iter().map(|x| x.to_bits()).collect()
}

fn square_mm2(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    let [x, y, z] = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    x * x + y * y + z * z
}

fn distance_mm(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    square_mm2(a, b).sqrt()
}

impl Roadmap {
    /// Joins every two samples that are `near` each other, if there is a local path.
    ///
    /// # Panics
    /// If a sample is not a free configuration.
    pub fn build(local: Local, samples: Vec<Sample>, near: Near, counted: Counted) -> Self {
        let nodes: Vec<Node> = samples.iter().map(|sample| local.node(&sample.config)).collect();
        let placed = samples.iter().zip(&nodes);
        let places_mm = placed.map(|(sample, node)| node.place_mm(&local, &sample.config)).collect();
        let numbers = samples.iter().zip(0..).map(|(sample, i)| (bits(&sample.config), i)).collect();
        let near = Samples::new(near, &samples, places_mm, local.turn_on());
        let mut tally = Tally::default();
        let mut scratch = Scratch::default();
        let mut links = vec![Vec::new(); samples.len()];
        near.each_pair(&samples, |from, to, gap_mm| {
            tally.pairs += 1;
            match local.join(&nodes[from], &nodes[to], &mut scratch) {
                Ok(()) => {
                    tally.edges += 1;
                    links[from].push((to as u32, gap_mm));
                    links[to].push((from as u32, gap_mm));
                }
                Err(reason) => tally.rejected[reason as usize] += 1,
            }
        });
        tally.checked = scratch.checked();
        let links = links.into_iter().map(Arc::new).collect();
        let memory = Mutex::new(Memory { scratch, ..Memory::default() });
        let unit_mm = near.radius_mm();
        Self { local, counted, samples, nodes, near, unit_mm, times: 1.0, numbers, links, tally, memory }
    }

    /// Makes `unit_mm`, the radius over `times`, the distance that planners may take multiples of; without it that is
    /// the radius.
    pub fn set_unit(&mut self, unit_mm: f64, times: f64) {
        self.unit_mm = unit_mm;
        self.times = times;
    }

    /// How many units the radius is.
    pub fn times(&self) -> f64 {
        self.times
    }

    /// The distance that planners may take multiples of.
    pub fn unit_mm(&self) -> f64 {
        self.unit_mm
    }

    /// The robot and its local paths.
    pub fn local(&self) -> &Local {
        &self.local
    }

    /// How far apart the places of two samples may be to be tried as neighbours; infinite where their configurations decide.
    pub fn radius_mm(&self) -> f64 {
        self.near.radius_mm()
    }

    /// Whether two nodes that are no samples would be tried as neighbours if they were.
    pub fn are_near(&self, a: u32, b: u32) -> bool {
        self.near.are_near([&self.config(a), &self.config(b)], self.gap_mm(a, b))
    }

    /// The samples, in the order they were drawn.
    pub fn samples(&self) -> &[Sample] {
        &self.samples
    }

    /// What became of the pairs.
    pub fn tally(&self) -> &Tally {
        &self.tally
    }

    /// How many of the samples belong to the roadmap of `count`.
    ///
    /// # Errors
    /// A sentence if there are not as many.
    pub fn prefix(&self, count: u32) -> Result<u32, String> {
        match self.counted {
            Counted::Accepted if count as usize > self.samples.len() => Err(format!(
                "{count} samples are requested; the roadmap was built with {}",
                self.samples.len()
            )),
            Counted::Accepted => Ok(count),
            Counted::Drawn => Ok(self.samples.partition_point(|sample| sample.drawn_after < count) as u32),
        }
    }

    /// The number of `config`: a sample's, or one that it gets as an end of a query.
    ///
    /// # Errors
    /// A sentence about `what` (start or goal) if the robot cannot be there.
    pub fn number(&self, what: &str, config: &[f64]) -> Result<u32, String> {
        let key = bits(config);
        let mut memory = self.remember();
        if let Some(number) = self.numbers.get(&key).or_else(|| memory.numbers.get(&key)) {
            return Ok(*number);
        }
        if let Some(refusal) = self.local.refusal(config) {
            return Err(format!("the {what} cannot be posed: {refusal}"));
        }
        let node = self.local.node(config);
        let place_mm = node.place_mm(&self.local, config);
        let mut links = Vec::new();
        for (sample, gap_mm) in self.near.neighbours(config, &place_mm) {
            if self.local.join(&self.nodes[sample as usize], &node, &mut memory.scratch).is_ok() {
                links.push((sample, gap_mm));
            }
        }
        let number = (self.samples.len() + memory.ends.len()) as u32;
        memory.ends.push(End { config: config.to_vec(), node, place_mm, links: Arc::new(links) });
        memory.numbers.insert(key, number);
        Ok(number)
    }

    /// A number above every node's.
    pub fn node_count(&self) -> usize {
        self.samples.len() + self.remember().ends.len()
    }

    /// The samples near a node that it is joined with.
    pub fn links(&self, node: u32) -> Links {
        match self.links.get(node as usize) {
            Some(links) => links.clone(),
            None => self.remember().ends[node as usize - self.samples.len()].links.clone(),
        }
    }

    /// The configuration of a node.
    pub fn config(&self, node: u32) -> Vec<f64> {
        match self.samples.get(node as usize) {
            Some(sample) => sample.config.clone(),
            None => self.remember().ends[node as usize - self.samples.len()].config.clone(),
        }
    }

    /// The place of a node.
    pub fn place_mm(&self, node: u32) -> [f64; 3] {
        match self.near.places_mm().get(node as usize) {
            Some(place) => *place,
            None => self.remember().ends[node as usize - self.samples.len()].place_mm,
        }
    }

    /// The straight distance between the places of two nodes.
    pub fn gap_mm(&self, a: u32, b: u32) -> f64 {
        distance_mm(&self.place_mm(a), &self.place_mm(b))
    }

    /// Whether there is a local path between two nodes, however far apart.
    ///
    /// # Errors
    /// The first reason against it.
    pub fn join(&self, a: u32, b: u32) -> Result<(), Rejection> {
        self.join_counted(a, b).0
    }

    /// As [`join`](Self::join), with how many configurations were checked for contact when it was first needed.
    pub fn join_counted(&self, a: u32, b: u32) -> (Result<(), Rejection>, u64) {
        let key = (a.min(b), a.max(b));
        let mut guard = self.remember();
        let memory = &mut *guard;
        if let Some(known) = memory.joins.get(&key) {
            return *known;
        }
        let ends = &memory.ends;
        let node = |number: u32| {
            let sample = self.nodes.get(number as usize);
            sample.unwrap_or_else(|| &ends[number as usize - self.samples.len()].node)
        };
        let before = memory.scratch.checked();
        let found = self.local.join(node(key.0), node(key.1), &mut memory.scratch);
        let found = (found, memory.scratch.checked() - before);
        memory.joins.insert(key, found);
        found
    }

    /// The component of each of the first `prefix` samples under edges up to `radius_mm`, named by its first sample.
    pub fn components(&self, prefix: u32, radius_mm: f64) -> Arc<Vec<u32>> {
        let key = (prefix, radius_mm.to_bits());
        if let Some(known) = self.remember().parts.get(&key) {
            return known.clone();
        }
        let mut first: Vec<u32> = (0..prefix).collect();
        for from in 0..prefix {
            let near = self.links[from as usize].iter().take_while(|(to, _)| *to < from);
            for (to, _) in near.filter(|(_, gap)| *gap <= radius_mm) {
                let (a, b) = (root(&mut first, from), root(&mut first, *to));
                first[a.max(b) as usize] = a.min(b);
            }
        }
        let parts: Vec<u32> = (0..prefix).map(|node| root(&mut first, node)).collect();
        let parts = Arc::new(parts);
        self.remember().parts.insert(key, parts.clone());
        parts
    }

    fn remember(&self) -> MutexGuard<'_, Memory> {
        self.memory.lock().expect("no thread panics while it remembers")
    }
}

fn root(first: &mut [u32], mut node: u32) -> u32 {
    while first[node as usize] != node {
        first[node as usize] = first[first[node as usize] as usize];
        node = first[node as usize];
    }
    node
}
