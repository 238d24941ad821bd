//! Points among boxes and octahedra, some with the goal walled in; the oracle asks the verifier about every step.

use super::{Case, Posed, Subject, Truth, flood};
use base::grid::STEPS_26;
use base::seed;
use engine::geometry::{Aabb, Convex, Vec3};
use engine::planner::Plan;
use engine::space::{PolyhedraWorld, World};
use rand::RngExt as _;
use std::sync::OnceLock;
use verify::polyhedra::{Case as Query, Point, Solid};

const SIDE: f64 = 12.0;

/// Points of the lattice along a side; they are 1 apart.
const POINTS: i32 = 13;

/// The obstacles as the verifier builds them, and what was found on the lattice among them.
pub struct Scene {
    solids: Vec<Solid>,
    /// The lower and the upper corner of the box round each solid.
    boxes: Vec<[Point; 2]>,
    /// With steps free at their ends, and with steps free all along.
    truths: [OnceLock<Truth>; 2],
}

/// Up to 6 obstacles that may overlap and leave the rim free; in every tenth world the goal is walled in, and every
/// twentieth asks for the way to where the start is.
pub fn polyhedra(number: u64) -> Case {
    let mut stream = seed::stream(seed::derive(26, &["polyhedra", &number.to_string()]));
    let mut bodies = Vec::new();
    for _ in 0..stream.random_range(1..7) {
        let center = Vec3::from_fn(|_, _| stream.random_range(3.5..8.5));
        bodies.push(if stream.random_bool(0.5) {
            Convex::cuboid(center, Vec3::from_fn(|_, _| stream.random_range(0.3..4.0))).unwrap()
        } else {
            Convex::octahedron(center, stream.random_range(1.0..2.5)).unwrap()
        });
    }
    let start = Vec3::from_fn(|_, _| stream.random_range(0.1..0.9));
    let goal = Vec3::from_fn(|_, _| SIDE - stream.random_range(0.1..0.9));
    let goal = if number % 20 == 10 { start } else { goal };
    if number % 10 == 9 {
        bodies.extend(walls(goal));
    }
    let scene = Scene::new(&bodies);
    let domain = Aabb { min: Vec3::zeros(), max: Vec3::repeat(SIDE) };
    let world = PolyhedraWorld::new(bodies, domain, 1.0, 0.0).unwrap();
    let [start, goal] = [start, goal].map(|end| end.as_slice().to_vec());
    let name = format!("polyhedra {number}, {start:?} to {goal:?}");
    Case { name, world: World::Polyhedra(Box::new(world)), start, goal, posed: Posed::Polyhedra(scene) }
}

/// Six plates around `at`, too thick to be stepped over.
fn walls(at: Vec3) -> Vec<Convex> {
    let plate = |axis: usize, side: f64| {
        let mut center = at;
        let mut size = Vec3::repeat(4.0);
        center[axis] += side;
        size[axis] = 1.2;
        Convex::cuboid(center, size).unwrap()
    };
    (0..3).flat_map(|axis| [plate(axis, -1.4), plate(axis, 1.4)]).collect()
}

pub fn point(of: &[f64]) -> Point {
    of.try_into().expect("three numbers are a point in space")
}

fn distance(a: Point, b: Point) -> f64 {
    (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt()
}

/// The solids that the verifier makes of the bodies' corners.
pub fn solids(bodies: &[Convex]) -> Vec<Solid> {
    let corners = |body: &Convex| body.vertices().iter().map(|v| (*v).into()).collect::<Vec<Point>>();
    bodies.iter().map(|body| Solid::new(&corners(body)).unwrap()).collect()
}

impl Scene {
    fn new(bodies: &[Convex]) -> Self {
        let corner = |body: &Convex, pick: fn(f64, f64) -> f64| -> Point {
            let along = |axis: usize| body.vertices().iter().map(|v| v[axis]).reduce(pick).unwrap();
            [0, 1, 2].map(along)
        };
        let boxes = bodies.iter().map(|body| [corner(body, f64::min), corner(body, f64::max)]).collect();
        Self { solids: solids(bodies), boxes, truths: [OnceLock::new(), OnceLock::new()] }
    }

    /// Whether the verifier lets a point go straight from `a` to `b`.
    fn is_clear(&self, a: Point, b: Point) -> bool {
        let may_meet =
            |[low, high]: &[Point; 2]| (0..3).all(|i| a[i].min(b[i]) <= high[i] && a[i].max(b[i]) >= low[i]);
        let path = [a.to_vec(), b.to_vec()];
        let passes = |solid: &Solid| {
            let solids = std::slice::from_ref(solid);
            let query = Query { solids, growth: 0.0, domain: [[0.0; 3], [SIDE; 3]], start: a, goal: b };
            query.refuse_path(&path, Some(distance(a, b))).is_none()
        };
        self.solids.iter().zip(&self.boxes).all(|(solid, around)| !may_meet(around) || passes(solid))
    }

    /// The free points of the lattice a step from `at`, and how far each is; `whole` asks for steps free all along.
    fn steps(&self, at: [i32; 3], whole: bool) -> Vec<([i32; 3], f64)> {
        let from = at.map(f64::from);
        let step = |by: &[i32; 3]| {
            let to = [0, 1, 2].map(|i| at[i] + by[i]);
            let end = to.map(f64::from);
            let is_free = to.iter().all(|c| (0..POINTS).contains(c)) && self.is_clear(end, end);
            (is_free && (!whole || self.is_clear(from, end))).then(|| (to, distance(from, end)))
        };
        STEPS_26.iter().filter_map(step).collect()
    }

    /// From the nearest point of the lattice that the start sees to one less than a step from the goal.
    fn search(&self, start: Point, goal: Point, whole: bool) -> Truth {
        let nearest = start.map(|c| c.round() as i32);
        let around = STEPS_26.iter().map(|by| [0, 1, 2].map(|i| nearest[i] + by[i]));
        let apart = |at: &[i32; 3], end: Point| distance(at.map(f64::from), end);
        let entrance = around
            .chain([nearest])
            .filter(|at| at.iter().all(|c| (0..POINTS).contains(c)))
            .filter(|at| self.is_clear(start, at.map(f64::from)))
            .min_by(|a, b| apart(a, start).total_cmp(&apart(b, start)))
            .expect("no obstacle is near the start");
        let (found, moves) = flood(entrance, |at| self.steps(at, whole));
        let leaves = |at: &[i32; 3]| !whole || self.is_clear(at.map(f64::from), goal);
        let ways = found.iter().filter(|(at, _)| apart(at, goal) < 1.0 && leaves(at));
        let lengths = ways.map(|(at, cost)| apart(&entrance, start) + cost + apart(at, goal));
        let optimum = lengths.min_by(f64::total_cmp);
        Truth { optimum, is_exact: true, reachable: Some((found.len() as u64, moves)) }
    }
}

/// What is true on the lattice, and of planners that leave it: what the lattice reaches can be reached, no way is
/// shorter than the straight one, and only those that search the lattice last must find one.
pub fn truth(case: &Case, scene: &Scene, subject: &Subject) -> Truth {
    let table = subject.settings.table();
    let whole = table.get("checked").and_then(|checked| checked.as_str()) != Some("nodes");
    let (start, goal) = (point(&case.start), point(&case.goal));
    let on_lattice = *scene.truths[usize::from(whole)].get_or_init(|| scene.search(start, goal, whole));
    if subject.entry.name == "lattice26_astar" {
        return on_lattice;
    }
    let searches_last = table.get("last_resort").and_then(toml::Value::as_bool) == Some(true);
    let optimum = on_lattice.optimum.map(|_| distance(start, goal));
    Truth { optimum, is_exact: searches_last, reachable: None }
}

/// Why the verifier refuses `plan`'s path.
pub fn refusal(case: &Case, scene: &Scene, plan: &Plan) -> Option<String> {
    let (start, goal) = (point(&case.start), point(&case.goal));
    let query = Query { solids: &scene.solids, growth: 0.0, domain: [[0.0; 3], [SIDE; 3]], start, goal };
    query.refuse_path(&plan.path, plan.cost)
}

/// In the middle of an obstacle, outside, of another dimension, not finite.
pub fn impossible(case: &Case) -> Vec<Vec<f64>> {
    let body = &case.world.as_polyhedra().expect("the sample holds polyhedra only").bodies()[0];
    let middle = body.vertices().iter().sum::<Vec3>() / body.vertices().len() as f64;
    let outside = vec![-1.0, 3.0, 3.0];
    vec![middle.as_slice().to_vec(), outside, vec![0.5, 0.5], vec![f64::NAN, 0.5, 0.5]]
}
