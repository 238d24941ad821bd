//! Roadmaps of a particle among rectangles, some with the goal walled off; the oracle asks the verifier about every edge.
//! For planners that sample by themselves it asks about every straight way between corners.

use super::{Case, Posed, Subject, Truth, flood, samples};
use base::seed;
use engine::geometry::Vec2;
use engine::geometry::planar::ConvexPolygon;
use engine::planner::Plan;
use engine::space::World;
use engine::space::roadmap::{Counted, Local, Near, PlaneMap, Roadmap, Sample};
use rand::RngExt as _;
use verify::plane;

const SIDE_MM: f64 = 100.0;

/// How far apart neighbours may be; the settings of planners must say the same.
const RADIUS_MM: f64 = 30.0;

/// How many samples there are; the settings of planners must say the same.
const SAMPLES: usize = 40;

/// How far beside a corner a path may pass it: the raster of the plane.
const BESIDE_MM: f64 = 1.0 / 16.0;

/// What the oracle knows of a case.
pub struct Scene {
    samples: Vec<Vec<f64>>,
    plane: plane::Case,
    /// No path in the whole plane is shorter; absent if there is none.
    shortest_mm: Option<f64>,
}

/// Corners of a rectangle, counter-clockwise.
type Corners = Vec<[f64; 2]>;

fn rectangle([x, y]: [f64; 2], [width, height]: [f64; 2]) -> Corners {
    vec![[x, y], [x + width, y], [x + width, y + height], [x, y + height]]
}

/// Four bars around `at` that let nothing through.
fn wall([x, y]: [f64; 2]) -> Vec<Corners> {
    let bars = [
        ([-4.0, -4.0], [8.0, 1.0]),
        ([-4.0, 3.0], [8.0, 1.0]),
        ([-4.0, -4.0], [1.0, 8.0]),
        ([3.0, -4.0], [1.0, 8.0]),
    ];
    bars.map(|([dx, dy], size)| rectangle([x + dx, y + dy], size)).to_vec()
}

pub fn roadmap(number: u64) -> Case {
    let mut stream = seed::stream(seed::derive(1968, &["roadmap", &number.to_string()]));
    let mut point = || [0, 1].map(|_| f64::from(stream.random_range(80..1520_u32)) / 16.0);
    let mut walls = vec![rectangle([30.0, 0.0], [6.0, 62.0]), rectangle([62.0, 38.0], [6.0, 62.0])];
    walls.extend((0..4).map(|_| rectangle(point(), [9.0, 9.0])));
    let polygon = |corners: &Corners| {
        ConvexPolygon::new(corners.iter().map(|corner| Vec2::from(*corner)).collect()).unwrap()
    };
    let plane = |walls: &[Corners]| PlaneMap::new([SIDE_MM; 2], walls.iter().map(polygon).collect());
    let mut free = |plane: &PlaneMap| loop {
        let at = point();
        if plane.refusal(at).is_none() {
            break at;
        }
    };
    let open = plane(&walls);
    let goal = free(&open);
    if number % 5 == 4 {
        walls.extend(wall(goal));
    }
    let shut = plane(&walls);
    let start = loop {
        let at = free(&shut);
        let is_outside = (0..2).any(|axis| (at[axis] - goal[axis]).abs() > 4.0);
        if is_outside {
            break at;
        }
    };
    let samples: Vec<Sample> =
        (0..SAMPLES as u32).map(|drawn_after| Sample { config: free(&shut).to_vec(), drawn_after }).collect();
    let scene = Scene {
        samples: samples.iter().map(|sample| sample.config.clone()).collect(),
        plane: plane::Case::new(&walls).unwrap(),
        shortest_mm: shortest_mm([start, goal], &walls),
    };
    let world = Roadmap::build(Local::Plane(shut), samples, Near::Places(RADIUS_MM), Counted::Accepted);
    Case {
        name: format!("roadmap {number}, {start:?} to {goal:?}"),
        world: World::Roadmap(Box::new(world)),
        start: start.to_vec(),
        goal: goal.to_vec(),
        posed: Posed::Roadmap(scene),
    }
}

/// A bound below every path among rectangles: ways past their corners, which bend beside a corner instead of at it, and each of
/// whose legs is as much shorter as two such bends can lengthen it.
fn shortest_mm(ends: [[f64; 2]; 2], walls: &[Corners]) -> Option<f64> {
    let plane = plane::Case::new(walls).unwrap();
    let beside = |corners: &Corners| {
        let middle = [0, 1].map(|axis| f64::midpoint(corners[0][axis], corners[2][axis]));
        let away =
            move |at: [f64; 2]| [0, 1].map(|axis| at[axis] + BESIDE_MM.copysign(at[axis] - middle[axis]));
        corners.iter().map(|corner| away(*corner)).collect::<Vec<_>>()
    };
    let is_inside = |at: &[f64; 2]| at.iter().all(|x| (0.0..=SIDE_MM).contains(x));
    let nodes: Vec<Vec<f64>> = (ends.into_iter().chain(walls.iter().flat_map(beside)))
        .filter(is_inside)
        .map(|at| at.to_vec())
        .collect();
    let moves = |from: usize| {
        let leg = |to: usize| {
            let ends = [&nodes[from], &nodes[to]];
            let length_mm = plane.length_mm(&ends.map(Clone::clone), ends.map(Vec::as_slice)).ok()?;
            Some((to, (length_mm - 2.0 * BESIDE_MM * std::f64::consts::SQRT_2).max(0.0)))
        };
        (0..nodes.len()).filter(|to| *to != from).filter_map(leg).collect()
    };
    flood(0, moves).0.get(&1).copied()
}

/// Which edges a planner may take, as its settings say.
struct Graph<'a> {
    /// The samples, then the start, then the goal.
    places: Vec<&'a Vec<f64>>,
    plane: &'a plane::Case,
    /// Samples may be passed.
    has_samples: bool,
    /// Every node may be joined with the goal, however far it is.
    shoots: bool,
}

impl Graph<'_> {
    fn edges(&self, from: u32) -> Vec<(u32, f64)> {
        let (start, goal) = (SAMPLES as u32, SAMPLES as u32 + 1);
        let edge = |to: u32| {
            let ends = [from, to].map(|node| self.places[node as usize]);
            let length_mm = self.plane.length_mm(&ends.map(Clone::clone), ends.map(Vec::as_slice)).ok()?;
            let is_wanted = if to == goal && self.shoots { true } else { length_mm <= RADIUS_MM };
            (is_wanted && (to == goal || self.has_samples)).then_some((to, length_mm))
        };
        (0..=goal).filter(|to| ![from, start].contains(to)).filter_map(edge).collect()
    }
}

fn graph<'a>(case: &'a Case, scene: &'a Scene, subject: &Subject) -> Graph<'a> {
    let places = scene.samples.iter().chain([&case.start, &case.goal]).collect();
    let has_samples = subject.entry.columns.contains(&"expansions");
    let shot = subject.settings.table().get("goal_shot").and_then(|shot| shot.as_str());
    Graph {
        places,
        plane: &scene.plane,
        has_samples,
        shoots: !has_samples || shot == Some("before_expansion"),
    }
}

/// What is true in the graph that the subject's settings describe, or in the whole plane.
pub fn truth(case: &Case, scene: &Scene, subject: &Subject) -> Truth {
    if samples(subject) {
        return Truth { optimum: scene.shortest_mm, is_exact: true, reachable: None };
    }
    let graph = graph(case, scene, subject);
    let (found, moves) = flood(SAMPLES as u32, |node| graph.edges(node));
    let optimum = found.get(&(SAMPLES as u32 + 1)).copied();
    let reachable = graph.has_samples.then_some((found.len() as u64, moves));
    Truth { optimum, is_exact: true, reachable }
}

/// Why the verifier refuses `plan`'s path, or a leg of it that is no edge where all must be.
pub fn refusal(case: &Case, scene: &Scene, plan: &Plan, subject: Option<&Subject>) -> Option<String> {
    let length_mm = match scene.plane.length_mm(&plan.path, [&case.start, &case.goal]) {
        Ok(length_mm) => length_mm,
        Err(refusal) => return Some(refusal),
    };
    if !plan.cost.is_some_and(|cost| (cost - length_mm).abs() < 1e-9 * length_mm.max(1.0)) {
        return Some(format!("the claimed length is {:?} mm, the path's {length_mm} mm", plan.cost));
    }
    let graph = graph(case, scene, subject.filter(|subject| !samples(subject))?);
    let number = |at: &Vec<f64>| graph.places.iter().position(|place| *place == at).map(|n| n as u32);
    let is_edge = |pair: &[Vec<f64>]| {
        let (from, to) = (number(&pair[0]), number(&pair[1]));
        from.zip(to).is_some_and(|(from, to)| graph.edges(from).iter().any(|(other, _)| *other == to))
    };
    plan.path.windows(2).find(|pair| !is_edge(pair)).map(|pair| format!("{pair:?} is no edge"))
}

/// In an obstacle, outside, of another dimension, not finite.
pub fn impossible() -> Vec<Vec<f64>> {
    vec![vec![33.0, 5.0], vec![-1.0, 5.0], vec![5.0, 101.0], vec![5.0], vec![f64::NAN, 5.0]]
}
