//! A yardstick for path lengths: a visibility graph over points sampled on the obstacles' edges, then each point
//! moved along its edge to where the path is shortest.
//!
//! A shortest path among polyhedra bends on edges only. The optimum of the sampled graph exceeds the true one by an amount that
//! shrinks with the spacing, and moving the points along their edges removes most of it. The result is a path, and so no
//! lower bound.

use super::entry::planner;
use super::key_nodes::{GUARDED, key};
use super::polyhedra::{Posed, plan};
use super::{Build, Counts, Ending, Entry, Invalid, Plan, Planner, Request, Value};
use crate::search::{Combined, Graph, Heap, Outcome, Rules, Search, SideInputs, Stop, Ties, Update, sum};
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use world::geometry::{Segment, Vec3};
use world::space::{PolyhedraWorld, WorldKind};

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "visibility_edges",
    about: "a shortest path over points sampled on the obstacles' edges, each then slid along its edge",
    revision: 1,
    needs: WorldKind::Polyhedra,
    columns: &["opened", "expansions", "generated"],
    settings: Accepted::shape::<Visibility>(),
    example: "
spacing_cm = 3.0
",
    build: Build::Planner(planner::<Visibility>),
};

/// Sliding stops when a round shortens the path by less than this share.
const SETTLED: f64 = 1e-9;
/// At most this many rounds of sliding.
const ROUNDS: u32 = 200;

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Visibility {
    /// How far apart the points on an edge are, at most.
    #[schemars(extend("exclusiveMinimum" = 0))]
    spacing_cm: f64,
}

/// A point on an edge; start and goal have none.
#[derive(Clone, Copy)]
struct Sample {
    point: Vec3,
    edge: Option<(usize, usize)>,
}

struct Visible<'a> {
    world: &'a PolyhedraWorld,
    samples: &'a [Sample],
}

impl Graph for Visible<'_> {
    type Cost = f64;

    fn node_count(&self) -> usize {
        self.samples.len()
    }

    fn successors(&mut self, node: u32, mut visit: impl FnMut(u32, f64)) {
        let from = self.samples[node as usize].point;
        for (index, sample) in self.samples.iter().enumerate() {
            if index != node as usize && self.world.is_clear(&Segment::new(from, sample.point)) {
                visit(index as u32, (sample.point - from).norm());
            }
        }
    }
}

/// Start, goal, and points on every edge, moved off it as key nodes are; those in another obstacle are left out.
fn samples(posed: &Posed<'_>, spacing: f64) -> Vec<Sample> {
    let end = |point| Sample { point, edge: None };
    let mut samples = vec![end(posed.start), end(posed.goal)];
    for (obstacle, convex) in posed.world.obstacles().iter().enumerate() {
        for (index, edge) in convex.edges().iter().enumerate() {
            let [a, b] = edge.ends.map(|end| convex.vertices()[end]);
            let parts = ((b - a).norm() / spacing).ceil().max(1.0) as u32;
            for k in 0..=parts {
                let at = a + (b - a) * (f64::from(k) / f64::from(parts));
                let found = key(convex, index, &at, &at, GUARDED.push);
                if posed.world.is_free(&found.point) {
                    samples.push(Sample { point: found.point, edge: Some((obstacle, index)) });
                }
            }
        }
    }
    samples
}

/// Moves every inner point along its edge to where the way between its neighbours is shortest, if that is clear.
fn slide(world: &PolyhedraWorld, path: &mut [Sample]) {
    for _ in 0..ROUNDS {
        let mut gained = 0.0;
        for i in 1..path.len().saturating_sub(1) {
            let Some((obstacle, edge)) = path[i].edge else { continue };
            let (before, after) = (path[i - 1].point, path[i + 1].point);
            let found = key(&world.obstacles()[obstacle], edge, &before, &after, GUARDED.push);
            let old = (before - path[i].point).norm() + (after - path[i].point).norm();
            let clear = world.is_clear(&Segment::new(before, found.point))
                && world.is_clear(&Segment::new(found.point, after));
            if clear && found.detour < old {
                gained += old - found.detour;
                path[i].point = found.point;
            }
        }
        if gained <= SETTLED {
            break;
        }
    }
}

impl Planner for Visibility {
    fn plan(&self, request: &Request<'_>) -> Result<Plan, Invalid> {
        let posed = Posed::new(request)?;
        let samples = samples(&posed, self.spacing_cm);
        let h = |node: u32| (samples[node as usize].point - posed.goal).norm();
        let terms = SideInputs {
            graph: &mut Visible { world: posed.world, samples: &samples },
            estimate: &Combined { h, combine: sum },
            observer: &mut (),
            update: Update::default(),
        };
        let rules = Rules { stop: Stop::GoalPopped, max_expansions: request.expansions };
        let report = Search::new(Heap::new(Ties::Fifo)).run(terms, 0, |node| node == 1, rules, &mut ());
        let (ending, points) = match &report.outcome {
            Outcome::Solved(route) => {
                let mut path: Vec<Sample> = route.nodes.iter().map(|node| samples[*node as usize]).collect();
                slide(posed.world, &mut path);
                (Ending::Solved, path.iter().map(|sample| sample.point).collect())
            }
            Outcome::NoPath => (Ending::NoPath, Vec::new()),
            Outcome::BudgetSpent => (Ending::BudgetSpent, Vec::new()),
        };
        let counts = Counts::from([
            ("opened", Value::Count(report.counters.opened)),
            ("expansions", Value::Count(report.counters.expansions)),
            ("generated", Value::Count(report.counters.generated)),
        ]);
        Ok(plan(ending, &points, counts))
    }
}
