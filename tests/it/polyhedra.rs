//! Points among polyhedra from outside: planners and stages against the verifier, whose solids and distances are its own.

use rand::RngExt as _;
use replan::geometry::{Aabb, Convex, Segment, Vec3};
use replan::kinematics::Robot;
use replan::planner::{self, Build, Ending, Plan, Planner, Request, Stage};
use replan::seed;
use replan::settings::Settings;
use replan::space::polyhedra::{CarriedArm, read_scene};
use replan::space::{PolyhedraWorld, World};
use replan::verify::polyhedra::{Case, Solid};
use replan::verify::rods;
use std::f64::consts::{FRAC_PI_2, PI};
use std::path::Path;

/// A world with a query, and its solids as the verifier builds them.
struct Posed {
    name: String,
    world: World,
    solids: Vec<Solid>,
    ends: [[f64; 3]; 2],
}

const SIDE: f64 = 24.0;
const ENDS: [[f64; 3]; 2] = [[1.3, 2.1, 1.7], [22.4, 21.2, 22.9]];
const LATTICE: &str = "checked = 'segments'\nties = 'fifo'";
const FULL: &str = "search = 'open_list'\ncluster = true\nlast_resort = true";

/// Cubes of 24 with up to 9 boxes and octahedra that may overlap; every tenth has the goal walled in.
fn sample(count: u64) -> Vec<Posed> {
    let pose = |number: u64| {
        let mut stream = seed::stream(seed::derive(26, &["polyhedra", &number.to_string()]));
        let mut bodies = Vec::new();
        for _ in 0..stream.random_range(1..10) {
            let center = Vec3::from_fn(|_, _| stream.random_range(6.0..18.0));
            bodies.push(if stream.random_bool(0.5) {
                Convex::cuboid(center, Vec3::from_fn(|_, _| stream.random_range(2.0..8.0))).unwrap()
            } else {
                Convex::octahedron(center, stream.random_range(2.0..5.0)).unwrap()
            });
        }
        if number % 10 == 9 {
            bodies.extend(walls(Vec3::from(ENDS[1])));
        }
        let corners = |body: &Convex| body.vertices().iter().map(|v| (*v).into()).collect::<Vec<_>>();
        let solids = bodies.iter().map(|body| Solid::new(&corners(body)).unwrap()).collect();
        let domain = Aabb { min: Vec3::zeros(), max: Vec3::repeat(SIDE) };
        let world = PolyhedraWorld::new(bodies, domain, 1.0, 0.0).unwrap();
        let name = format!("world {number}");
        Posed { name, world: World::Polyhedra(Box::new(world)), solids, ends: ENDS }
    };
    (0..count).map(pose).collect()
}

/// Six plates around `at` that overlap at their rims.
fn walls(at: Vec3) -> Vec<Convex> {
    let plate = |axis: usize, side: f64| {
        let (mut center, mut size) = (at, Vec3::repeat(2.4));
        center[axis] += side;
        size[axis] = 0.4;
        Convex::cuboid(center, size).unwrap()
    };
    (0..3).flat_map(|axis| [plate(axis, -1.0), plate(axis, 1.0)]).collect()
}

impl Posed {
    fn request(&self, expansions: u64) -> Request<'_> {
        let [start, goal] = &self.ends;
        Request { world: &self.world, start, goal, expansions, seed: 0, trace: false }
    }

    fn plan(&self, planner: &dyn Planner) -> Plan {
        planner.plan(&self.request(100_000)).unwrap_or_else(|invalid| panic!("{}: {invalid}", self.name))
    }

    fn refusal(&self, plan: &Plan) -> Option<String> {
        let ([start, goal], domain) = (self.ends, [[0.0; 3], [SIDE; 3]]);
        let case = Case { solids: &self.solids, growth: 0.0, domain, start, goal };
        case.refuse_path(&plan.path, plan.cost)
    }
}

fn built(name: &str, settings: &str) -> Box<dyn Planner> {
    let Build::Planner(build) = planner::find(name).unwrap().build else { panic!("`{name}` plans") };
    build(&Settings::composed("a test", toml::from_str(settings).unwrap())).unwrap()
}

fn stage(name: &str, settings: &str) -> Box<dyn Stage> {
    let Build::Stage(build) = planner::find(name).unwrap().build else { panic!("`{name}` is a stage") };
    build(&Settings::composed("a test", toml::from_str(settings).unwrap())).unwrap()
}

#[test]
fn what_is_solved_is_accepted_and_the_full_search_solves_what_the_lattice_does() {
    let lattice = built("lattice26_astar", LATTICE);
    let others = [
        built("keynode_astar", FULL),
        built("keynode_astar", "search = 'greedy'\ncluster = false\nlast_resort = false"),
        built("visibility_edges", "spacing_cm = 3.0"),
    ];
    let (mut open, mut shut, mut bent) = (0, 0, 0);
    for posed in sample(60) {
        let truth = posed.plan(lattice.as_ref());
        let solves: Vec<bool> = others
            .iter()
            .map(|planner| {
                let plan = posed.plan(planner.as_ref());
                let solved = plan.ending == Ending::Solved;
                assert!(
                    !solved || posed.refusal(&plan).is_none(),
                    "{}: {:?}",
                    posed.name,
                    posed.refusal(&plan)
                );
                solved
            })
            .collect();
        if truth.ending == Ending::Solved {
            assert_eq!(posed.refusal(&truth), None, "{}", posed.name);
            assert!(solves[0], "{}: the lattice finds a way and the full search does not", posed.name);
            bent += u32::from(!posed.world.as_polyhedra().unwrap().is_clear(&straight()));
            open += 1;
        } else {
            assert!(solves.iter().all(|solved| !solved), "{}: a way out of a closed box", posed.name);
            shut += 1;
        }
    }
    assert!(open > 45 && shut > 4 && bent > 25, "one-sided sample: {open} {shut} {bent}");
}

fn straight() -> Segment {
    Segment::new(ENDS[0].into(), ENDS[1].into())
}

#[test]
fn stages_keep_a_plan_acceptable_and_straightening_makes_it_no_longer() {
    let star = built("lattice26_astar", LATTICE);
    let straighten = stage("straighten_from_previous", "resume = 'last_joined'");
    let smooth = stage("bspline", "control = 'steps'\nguarded = true\npoints_per_span = 2");
    let mut shorter = 0;
    for posed in sample(30) {
        let plan = posed.plan(star.as_ref());
        let Some(cost) = plan.cost else { continue };
        let straightened = straighten.refine(&posed.request(1), plan);
        assert_eq!(posed.refusal(&straightened), None, "{}", posed.name);
        assert!(straightened.cost.unwrap() <= cost + 1e-9, "{}", posed.name);
        shorter += u32::from(straightened.cost.unwrap() < cost - 0.1);
        let smoothed = smooth.refine(&posed.request(1), straightened);
        assert_eq!(posed.refusal(&smoothed), None, "{}", posed.name);
    }
    assert!(shorter > 15, "one-sided sample: {shorter} got shorter");
}

#[test]
fn a_spent_budget_is_an_outcome_and_the_second_query_is_as_the_first() {
    for (name, settings) in [("lattice26_astar", LATTICE), ("keynode_astar", FULL)] {
        let planner = built(name, settings);
        let mut spent = 0;
        for posed in sample(12) {
            assert_eq!(posed.plan(planner.as_ref()), posed.plan(planner.as_ref()), "{name}, {}", posed.name);
            let plan = planner.plan(&posed.request(1)).unwrap();
            spent += u32::from(plan.ending == Ending::BudgetSpent);
            assert!(plan.ending != Ending::BudgetSpent || plan.path.is_empty());
        }
        assert!(spent > 3, "{name}: one expansion was enough for all but {spent} of 12");
    }
}

#[test]
fn ends_that_cannot_be_posed_are_refused_with_the_place() {
    let mut posed = sample(1).remove(0);
    let inside = posed.world.as_polyhedra().unwrap().bodies()[0].vertices().iter().sum::<Vec3>();
    let inside = inside / posed.world.as_polyhedra().unwrap().bodies()[0].vertices().len() as f64;
    for (end, part) in [([-1.0, 3.0, 3.0], "is outside the domain"), (inside.into(), "is inside obstacle")] {
        for (which, called) in ["the start", "the goal"].iter().enumerate() {
            posed.ends = ENDS;
            posed.ends[which] = end;
            for name in ["lattice26_astar", "keynode_astar", "visibility_edges"] {
                let settings = match name {
                    "lattice26_astar" => LATTICE,
                    "keynode_astar" => FULL,
                    _ => "spacing_cm = 3.0",
                };
                let message = built(name, settings).plan(&posed.request(10)).unwrap_err().to_string();
                assert!(message.contains(part) && message.starts_with(called), "{name}: {message}");
            }
        }
    }
}

/// The arm among the boxes of the scene C1, its tip 7 cm clear of them.
fn carried() -> World {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("data");
    let scene = read_scene(&data.join("scenes/tang_c1.toml")).unwrap();
    let robot = Robot::load(&data.join("robots/aubo_i10.toml")).unwrap();
    let world = PolyhedraWorld::new(scene.bodies, scene.domain, 1.0, 7.0).unwrap();
    World::Polyhedra(Box::new(world.with_arm(CarriedArm::new(&robot, "paper").unwrap())))
}

/// The same arm from the maker's table, for the verifier: centimetres.
fn aubo() -> rods::Arm {
    let limit = 175.0_f64.to_radians();
    let row = |alpha: f64, a: f64, d: f64, offset: f64| rods::Row {
        alpha,
        a,
        d,
        offset,
        lower: -limit,
        upper: limit,
    };
    let rod = |link, from, to, radius| rods::Rod { link, from, to, radius };
    rods::Arm {
        base: nalgebra::Matrix4::identity(),
        rows: [
            row(FRAC_PI_2, 0.0, 16.32, 0.0),
            row(PI, 64.7, 0.0, FRAC_PI_2),
            row(PI, 60.05, 0.0, 0.0),
            row(-FRAC_PI_2, 0.0, 20.13, -FRAC_PI_2),
            row(FRAC_PI_2, 0.0, 10.25, 0.0),
            row(0.0, 0.0, 9.4, 0.0),
        ],
        tip: [0.0; 3],
        rods: vec![
            rod(1, [0.0; 3], [0.0, 0.0, 20.13], 8.0),
            rod(2, [-64.7, 0.0, -20.13], [0.0, 0.0, -20.13], 8.0),
            rod(3, [-60.05, 0.0, 20.13], [0.0, 0.0, 20.13], 6.0),
            rod(4, [0.0; 3], [0.0, 0.0, 10.25], 5.0),
            rod(5, [0.0; 3], [0.0, 0.0, 9.4], 4.5),
        ],
    }
}

#[test]
fn the_verifier_accepts_the_arms_paths_and_none_with_an_angle_bent() {
    let (world, arm) = (carried(), aubo());
    let posture = "adjust = true\nsign = 'down'\nclamp = 'floor'\ndistance = 'exact'\npose = 'inverse'\n\
        damping = 0.02\nact_cm = 2.0\nd0_cm = 5.0\nstep_rad = 0.03\niterations = 20\n\
        bounds_rad = [0.2, 0.2, 0.1]\nbounds = 'per_node'\nrecovery_rad = 0.02\nbranches = 'all'\ndiagnose = false";
    let corners = |body: &Convex| body.vertices().iter().map(|v| (*v).into()).collect::<Vec<_>>();
    let bodies = world.as_polyhedra().unwrap().bodies();
    let solids: Vec<Solid> = bodies.iter().map(|body| Solid::new(&corners(body)).unwrap()).collect();
    let (start, goal) = ([70.0, -46.0, 36.0], [70.0, 41.0, 51.0]);
    let case = rods::Case { arm: &arm, solids: &solids, start, goal };
    let request =
        Request { world: &world, start: &start, goal: &goal, expansions: 60_000, seed: 0, trace: false };
    let tip_path = built("keynode_astar", FULL).plan(&request).unwrap();
    let followed = stage("posture", posture).refine(&request, tip_path);
    let jia = built("joint_astar", "delta_deg = 12.0\nneighbours = 12").plan(&request).unwrap();
    for plan in [followed, jia] {
        assert_eq!(plan.ending, Ending::Solved);
        assert_eq!(case.refuse_path(&plan.path, plan.cost), None);
        let (middle, last) = (plan.path.len() / 2, plan.path.len() - 1);
        for (at, by) in [(0, 1e-3), (last, 1e-3), (middle, 1e-2), (middle, 4.0), (middle, f64::NAN)] {
            let mut bent = plan.path.clone();
            bent[at][1] += by;
            assert!(case.refuse_path(&bent, plan.cost).is_some(), "configuration {at} bent by {by}");
        }
    }
}
