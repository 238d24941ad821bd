//! Worlds of every kind with what is true of them, found by other code than any planner's.

mod arm;
mod lattice;
pub mod polyhedra;
mod roadmap;
pub mod rods;

use base::settings::Settings;
use engine::planner::{Entry, Plan, Planner};
use engine::space::{World, WorldKind};
use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};
use std::sync::LazyLock;
use verify::lattice::Least;

/// A planner with the settings that it was built from.
pub struct Subject {
    pub name: String,
    pub entry: &'static Entry,
    pub settings: Settings,
    pub planner: Box<dyn Planner>,
}

/// A query in a world.
pub struct Case {
    /// The seed and what was drawn, for messages.
    pub name: String,
    pub world: World,
    pub start: Vec<f64>,
    pub goal: Vec<f64>,
    posed: Posed,
}

/// What the oracle of each kind needs besides.
enum Posed {
    /// The least cost.
    Lattice(Option<f64>),
    /// The least costs.
    Corners(Option<Least>),
    /// The obstacles.
    Arm(Vec<crate::shapes::Placed>),
    /// The samples, the verifier's map, and what is true in the whole plane.
    Roadmap(roadmap::Scene),
    /// The obstacles.
    Polyhedra(polyhedra::Scene),
    /// The obstacles.
    Rods(rods::Scene),
}

/// What is true of a query in the graph that a planner searches.
#[derive(Clone, Copy)]
pub struct Truth {
    /// The least cost, or a bound below it where no oracle finds it; absent if the goal cannot be reached.
    pub optimum: Option<f64>,
    /// The planner must find a path exactly if there is one.
    pub is_exact: bool,
    /// How many nodes can be reached and how many moves leave them, where one search from the start takes them all.
    pub reachable: Option<(u64, u64)>,
}

/// A sample of worlds of `kind`, some with the goal walled off; drawn once for all tests.
pub fn worlds(kind: WorldKind) -> &'static [Case] {
    static ARM: LazyLock<Vec<Case>> = LazyLock::new(|| (0..48).map(arm::arm).collect());
    static CORNERS: LazyLock<Vec<Case>> = LazyLock::new(|| (0..150).map(lattice::corners).collect());
    static LATTICE: LazyLock<Vec<Case>> = LazyLock::new(|| (0..150).map(lattice::lattice).collect());
    static POLYHEDRA: LazyLock<Vec<Case>> = LazyLock::new(|| (0..60).map(polyhedra::polyhedra).collect());
    static ROADMAP: LazyLock<Vec<Case>> = LazyLock::new(|| (0..60).map(roadmap::roadmap).collect());
    static RODS: LazyLock<Vec<Case>> = LazyLock::new(|| (0..24).map(rods::rods).collect());
    match kind.name() {
        "arm" => &ARM,
        "arm among polyhedra" => &RODS,
        "lattice" | "lattice of centres" => &LATTICE,
        "lattice of corners" => &CORNERS,
        "polyhedra" => &POLYHEDRA,
        "roadmap" => &ROADMAP,
        other => panic!("conformance has no sample of {other} worlds; add one to tests/it/worlds"),
    }
}

/// Whether a planner samples a world by itself and searches no graph of it.
pub fn samples(subject: &Subject) -> bool {
    subject.entry.columns.contains(&"tree_nodes")
}

/// The least cost of every node that can be reached from `start`, and how many moves leave them: Dijkstra's algorithm.
fn flood<N: Copy + Ord>(start: N, moves: impl Fn(N) -> Vec<(N, f64)>) -> (BTreeMap<N, f64>, u64) {
    let (mut found, mut count): (BTreeMap<N, f64>, u64) = (BTreeMap::new(), 0);
    // Costs are not negative, so that their bits are in their order.
    let mut open = BinaryHeap::from([(Reverse(0_u64), start)]);
    while let Some((Reverse(cost), node)) = open.pop() {
        if found.contains_key(&node) {
            continue;
        }
        found.insert(node, f64::from_bits(cost));
        for (to, step) in moves(node) {
            count += 1;
            open.push((Reverse((f64::from_bits(cost) + step).to_bits()), to));
        }
    }
    (found, count)
}

impl Case {
    /// What is true of it for `subject`.
    pub fn truth(&self, subject: &Subject) -> Truth {
        match &self.posed {
            Posed::Lattice(optimum) => lattice::truth(self, *optimum, subject),
            Posed::Corners(least) => lattice::truth_at_corners(*least, subject),
            Posed::Arm(_) => arm::truth(self, subject),
            Posed::Roadmap(scene) => roadmap::truth(self, scene, subject),
            Posed::Polyhedra(scene) => polyhedra::truth(self, scene, subject),
            Posed::Rods(scene) => rods::truth(self, scene),
        }
    }

    /// Why the verifier refuses the path of a plan that `subject` made.
    pub fn refusal(&self, plan: &Plan, subject: &Subject) -> Option<String> {
        let steps = subject.planner.steps();
        let optimal = subject.planner.is_optimal();
        match &self.posed {
            Posed::Lattice(optimum) => {
                lattice::refusal(self, *optimum, plan, [!subject.planner.is_any_angle(), optimal])
            }
            Posed::Corners(least) => {
                lattice::refusal_at_corners(self, *least, plan, [!subject.planner.is_any_angle(), optimal])
            }
            Posed::Arm(solids) => arm::refusal(self, solids, plan, steps, optimal),
            Posed::Roadmap(scene) => roadmap::refusal(self, scene, plan, Some(subject)),
            Posed::Polyhedra(scene) => polyhedra::refusal(self, scene, plan),
            Posed::Rods(scene) => rods::refusal(self, scene, plan),
        }
    }

    /// Why the verifier refuses the path of a tidied plan, which may leave the graph.
    pub fn refusal_off_graph(&self, plan: &Plan) -> Option<String> {
        match &self.posed {
            Posed::Lattice(optimum) => lattice::refusal(self, *optimum, plan, [false; 2]),
            Posed::Corners(least) => lattice::refusal_at_corners(self, *least, plan, [false; 2]),
            Posed::Arm(solids) => arm::refusal(self, solids, plan, None, false),
            Posed::Roadmap(scene) => roadmap::refusal(self, scene, plan, None),
            Posed::Polyhedra(scene) => polyhedra::refusal(self, scene, plan),
            Posed::Rods(scene) => rods::refusal(self, scene, plan),
        }
    }

    /// Starts and goals that cannot be posed.
    pub fn impossible(&self) -> Vec<(Vec<f64>, Vec<f64>)> {
        let points = match &self.posed {
            Posed::Lattice(_) | Posed::Corners(_) => lattice::impossible(self),
            Posed::Arm(solids) => arm::impossible(solids),
            Posed::Roadmap(_) => roadmap::impossible(),
            Posed::Polyhedra(_) => polyhedra::impossible(self),
            Posed::Rods(_) => rods::impossible(self),
        };
        let both = |point: Vec<f64>| [(point.clone(), self.goal.clone()), (self.start.clone(), point)];
        points.into_iter().flat_map(both).collect()
    }
}
