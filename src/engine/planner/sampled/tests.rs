//! Planners that sample, around a wall whose shortest path is known.

use super::super::roadmap::roadmap;
use super::super::{Build, Counts, Ending, Plan, Planner, Request, find};
use crate::sampling::Motions;
use world::geometry::planar::ConvexPolygon;
use world::space::{JointSpace, SelfContact, World};

use base::robot::{Joint, Kind, Robot};
use base::settings::Settings;
use base::solid::{Form, Pose, Solid};
use world::space::roadmap::{Counted, Local, Near, PlaneMap, RASTER_MM, Roadmap};

/// Over both upper corners of the wall: two legs of 65 mm and its width.
const SHORTEST_MM: f64 = 140.0;

/// A square of 100 mm with bars from lower left to upper right corners.
fn barred(bars: &[[f64; 4]]) -> World {
    let polygon = |[x0, y0, x1, y1]: &[f64; 4]| {
        let corners = [[*x0, *y0], [*x1, *y0], [*x1, *y1], [*x0, *y1]];
        ConvexPolygon::new(corners.map(Into::into).to_vec()).expect("a bar is convex")
    };
    let local = Local::Plane(PlaneMap::new([100.0, 100.0], bars.iter().map(polygon).collect()));
    World::Roadmap(Box::new(Roadmap::build(local, Vec::new(), Near::Places(0.0), Counted::Accepted)))
}

/// A square of 100 mm with a wall from below.
fn world() -> World {
    barred(&[[45.0, 0.0, 55.0, 80.0]])
}

fn planner(name: &str, settings: &str) -> Box<dyn Planner> {
    let Build::Planner(build) = find(name).unwrap().build else { panic!("{name} is a planner") };
    build(&Settings::composed("a test", settings.parse().unwrap())).unwrap()
}

fn plan(planner: &dyn Planner, world: &World, seed: u64) -> Plan {
    let (start, goal) = ([20.0, 20.0], [80.0, 20.0]);
    let request = Request { world, start: &start, goal: &goal, expansions: 100_000, seed, trace: true };
    planner.plan(&request).unwrap()
}

const CONNECT: &str = "range = 20\nbalance = 1\nfirst = 'start'\niterations = 5000\nnodes = 5000\n";

#[test]
fn the_same_seed_gives_the_same_tree_and_another_one_only_where_samples_are_random() {
    let world = world();
    for (sampler, depends) in [("halton", false), ("seeded", true)] {
        let planner = planner("rrt_connect", &format!("{CONNECT}sampler = '{sampler}'"));
        assert_eq!(planner.draws(), depends);
        let [one, again, other] = [1, 1, 2].map(|seed| plan(planner.as_ref(), &world, seed));
        assert_eq!((one.ending, &one), (Ending::Solved, &again));
        assert_eq!(one != other, depends, "{sampler}");
    }
}

#[test]
fn a_start_that_is_the_goal_is_a_path_of_no_leg_and_of_length_0() {
    let world = world();
    let point = [20.0, 20.0];
    let request =
        Request { world: &world, start: &point, goal: &point, expansions: 10, seed: 1, trace: false };
    for (name, settings) in [
        ("rrt_connect", format!("{CONNECT}sampler = 'halton'")),
        ("prm_star", "sampler = 'halton'\niterations = 9\ngrowth = 1.5".to_owned()),
    ] {
        let plan = planner(name, &settings).plan(&request).unwrap();
        assert_eq!((plan.ending, plan.path), (Ending::Solved, vec![point.to_vec()]), "{name}");
        assert_eq!(plan.cost.map(f64::to_bits), Some(0), "{name}: 0, not -0");
    }
}

#[test]
fn a_search_without_a_path_ends_by_its_own_limits_or_cut_off_by_the_budget() {
    let world = world();
    for (limits, expansions, ending) in [
        ("iterations = 1\nnodes = 5000", 100, Ending::NoPath),
        ("iterations = 100\nnodes = 3", 100, Ending::NoPath),
        ("iterations = 5\nnodes = 5000", 5, Ending::NoPath),
        ("iterations = 6\nnodes = 5000", 5, Ending::BudgetSpent),
    ] {
        let settings = format!("range = 1\nfirst = 'goal'\nsampler = 'halton'\n{limits}");
        let (start, goal) = ([20.0, 20.0], [80.0, 20.0]);
        let request =
            Request { world: &world, start: &start, goal: &goal, expansions, seed: 1, trace: false };
        let plan = planner("rrt_connect", &settings).plan(&request).unwrap();
        assert_eq!((plan.ending, plan.path.len(), plan.cost), (ending, 0, None), "{limits}");
    }
}

#[test]
fn planners_that_go_on_come_near_the_shortest_path_and_each_path_they_note_is_shorter() {
    let world = world();
    for (name, settings) in [
        ("rrt_star", "range = 20\nsampler = 'seeded'\ngoal_share = 0.05\niterations = 3000\ninformed = true"),
        (
            "rrt_star",
            "range = 20\nsampler = 'halton'\ngoal_share = 0.05\niterations = 3000\ninformed = false",
        ),
        ("prm_star", "sampler = 'halton'\niterations = 1500\ngrowth = 1.5"),
    ] {
        let planner = planner(name, settings);
        for seed in 0..3 {
            let plan = plan(planner.as_ref(), &world, seed);
            let cost = plan.cost.unwrap();
            assert!((SHORTEST_MM..1.05 * SHORTEST_MM).contains(&cost), "{name}, seed {seed}: {cost} mm");
            let incumbents = &plan.traces[0].values;
            let noted: Vec<[f64; 2]> = incumbents.chunks(2).map(|pair| [pair[0], pair[1]]).collect();
            assert!(noted.len() > 1, "{name}, seed {seed}: {noted:?}");
            assert!(noted.windows(2).all(|pair| pair[0][0] <= pair[1][0] && pair[0][1] > pair[1][1]));
            assert!(
                (noted[noted.len() - 1][1] - cost).abs() < 1e-9,
                "{name}, seed {seed}: {noted:?}, {cost}"
            );
            assert_eq!(plan.counts["incumbents"].as_f64(), noted.len() as f64);
        }
    }
}

/// What Karaman and Frazzoli prove of RRT and of roadmaps with a fixed number of neighbours.
#[test]
fn trees_that_never_change_and_roadmaps_with_few_neighbours_stay_longer_than_the_shortest_path() {
    let world = world();
    let mean = |name: &str, settings: &str| -> f64 {
        let planner = planner(name, settings);
        (0..5).map(|seed| plan(planner.as_ref(), &world, seed).cost.unwrap()).sum::<f64>() / 5.0
    };
    let tree =
        "range = 20\nreach = 5\nsampler = 'seeded'\ngoal_share = 0\niterations = 2000\ninformed = false";
    let roadmap = "sampler = 'seeded'\niterations = 2000";
    for (name, shared, change) in
        [("rrt_star", tree, "nearest_parent = true"), ("prm_star", roadmap, "nearest = 4")]
    {
        let [star, other] = ["", change].map(|change| mean(name, &format!("{shared}\n{change}")));
        assert!(
            star < 1.03 * SHORTEST_MM && other > 1.06 * SHORTEST_MM,
            "{name}: {star} mm, with {change} {other} mm; {SHORTEST_MM} mm at the least"
        );
    }
}

/// A node joins the goal within `reach` and no farther off.
#[test]
fn a_short_reach_leaves_the_goal_to_nodes_near_it() {
    let settings =
        "range = 30\nreach = 2\nsampler = 'seeded'\ngoal_share = 0\niterations = 3000\ninformed = false";
    let path = plan(planner("rrt_star", settings).as_ref(), &world(), 1).path;
    let [before, goal] = [&path[path.len() - 2], &path[path.len() - 1]];
    assert!(libm::hypot(before[0] - goal[0], before[1] - goal[1]) <= 2.0, "{before:?} to {goal:?}");
}

/// Dynamic domains are for traps: most samples lie behind walls that surround the start. In the open they spare next to nothing.
#[test]
fn in_a_trap_a_dynamic_domain_spares_two_in_five_of_the_steps_that_fail() {
    let trap = barred(&[
        [10.0, 10.0, 12.0, 40.0],
        [10.0, 10.0, 40.0, 12.0],
        [10.0, 38.0, 40.0, 40.0],
        [38.0, 10.0, 40.0, 24.0],
        [38.0, 25.0, 40.0, 40.0],
    ]);
    let failed = |domain: &str| -> f64 {
        let settings = format!(
            "range = 20\nsampler = 'seeded'\nfirst = 'start'\niterations = 50_000\nnodes = 50_000\n{domain}"
        );
        let planner = planner("rrt_connect", &settings);
        let failed = |seed| {
            let plan = plan(planner.as_ref(), &trap, seed);
            assert_eq!(plan.ending, Ending::Solved, "seed {seed}");
            plan.counts["motions"].as_f64() - plan.counts["tree_nodes"].as_f64()
        };
        (0..20).map(failed).sum()
    };
    let [with, without] = ["dynamic_domain = { radius = 10, alpha = 0.1, least_radius = 5 }", ""].map(failed);
    assert!(with < 0.6 * without, "{with} failed steps with a dynamic domain, {without} without");
}

/// Where the way past the wall is long, the ellipsoid holds the whole square, and informed samples are samples from everywhere.
#[test]
fn past_a_low_wall_informed_samples_come_nearer_to_the_shortest_path_than_samples_from_everywhere() {
    let low = barred(&[[45.0, 0.0, 55.0, 22.0]]);
    let shortest_mm = 2.0 * 629.0_f64.sqrt() + 10.0;
    let above = |informed: bool| {
        let settings = format!(
            "range = 20\nsampler = 'seeded'\ngoal_share = 0.05\niterations = 300\ninformed = {informed}"
        );
        let planner = planner("rrt_star", &settings);
        let cost = |seed| plan(planner.as_ref(), &low, seed).cost.unwrap();
        (0..10).map(cost).sum::<f64>() / 10.0 - shortest_mm
    };
    let [informed, even] = [true, false].map(above);
    assert!(
        informed > 0.0 && informed < even / 3.0,
        "{informed} mm above the shortest path, without {even} mm"
    );
}

#[test]
fn points_in_the_plane_lie_on_its_raster() {
    let world = world();
    for (name, settings) in [
        ("rrt", "range = 7\nsampler = 'seeded'\ngoal_share = 0.05\niterations = 5000"),
        ("rrt_connect", "range = 7\nsampler = 'halton'\nfirst = 'start'\niterations = 5000\nnodes = 5000"),
        ("rrt_star", "range = 7\nsampler = 'seeded'\ngoal_share = 0.05\niterations = 1000\ninformed = true"),
        ("prm_star", "sampler = 'halton'\niterations = 500\ngrowth = 1.5"),
    ] {
        let path = plan(planner(name, settings).as_ref(), &world, 3).path;
        let is_on = |x: &f64| (x / RASTER_MM).fract() == 0.0;
        assert!(path.len() > 2 && path.iter().flatten().all(is_on), "{name}: {path:?}");
    }
}

/// A robot of two joints, each at its place `x` and of its axis and kind, whose only solid is at its end, beside an obstacle.
fn beside(joints: [(f64, [f64; 3], Kind); 2], solid: Solid, obstacle: Solid, step_rad: f64) -> World {
    let joint = |(x, axis, kind): (f64, [f64; 3], Kind)| Joint {
        name: format!("joint at {x} m along {axis:?}"),
        before: Pose { origin_m: [x, 0.0, 0.0], ..Pose::IDENTITY },
        axis,
        kind,
        limits: if kind == Kind::Slides { [0.0, 1.0] } else { [-3.0, 3.0] },
        speed: None,
    };
    let robot = Robot {
        name: "two".to_owned(),
        base: "base".to_owned(),
        joints: joints.map(joint).to_vec(),
        solids: vec![(2, solid)],
        owners: vec!["end".to_owned()],
        tip: Pose::IDENTITY,
        files: Vec::new(),
        notes: Vec::new(),
    };
    let space = JointSpace::new(robot, vec![obstacle], &SelfContact::Unchecked, step_rad);
    World::Roadmap(Box::new(Roadmap::build(
        Local::Joints(Box::new(space)),
        Vec::new(),
        Near::Places(0.0),
        Counted::Accepted,
    )))
}

fn solid(x: f64, y: f64, form: Form) -> Solid {
    Solid { name: "solid".to_owned(), pose: Pose { origin_m: [x, y, 0.0], ..Pose::IDENTITY }, form }
}

/// An arm of two joints about z whose only solid is a ball at its end, beside a ball that is thinner than a step of its motions.
fn past_something_thin() -> World {
    let joints = [0.0, 0.5].map(|x| (x, [0.0, 0.0, 1.0], Kind::Turns));
    beside(joints, solid(0.5, 0.0, Form::Sphere(0.03)), solid(0.99, 0.1, Form::Sphere(0.001)), 0.2)
}

/// A cube of 1 cm slides in a square of 1 m over a wall. Between two configurations that are checked it may cut the wall's edge.
#[test]
fn where_a_finer_look_refuses_legs_of_the_best_path_shorter_ones_are_found_still() {
    let joints = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(|axis| (0.0, axis, Kind::Slides));
    let wall = solid(0.5, 0.25, Form::Box([0.05, 0.35, 0.1]));
    let world = beside(joints, solid(0.0, 0.0, Form::Box([0.005; 3])), wall, 0.02);
    let (start, goal) = ([0.2, 0.3], [0.8, 0.3]);
    let shortest_m = 2.0 * libm::hypot(0.245, 0.305) + 0.11;
    let settings =
        "range = 0.28\nreach = 0.05\nsampler = 'seeded'\ngoal_share = 0\niterations = 2000\ninformed = false";
    let planner = planner("rrt_star", settings);
    for seed in 0..8 {
        let request =
            Request { world: &world, start: &start, goal: &goal, expansions: 2000, seed, trace: false };
        let length_m = planner.plan(&request).unwrap().counts["initial_length_rad"].as_f64();
        assert!((shortest_m..1.035 * shortest_m).contains(&length_m), "seed {seed}: {length_m} m");
    }
}

#[test]
fn a_path_that_a_finer_look_refuses_once_shortened_is_shortened_again_by_that_look() {
    let world = past_something_thin();
    let Build::Stage(build) = find("simplify_path").unwrap().build else { panic!("it is a stage") };
    let settings = "rounds = 5\noperations = ['shortcut']".parse().unwrap();
    let stage = build(&Settings::composed("a test", settings)).unwrap();
    let local = roadmap(&world).local();
    let mut motions = Motions::finely(local);
    let (mut slipped, mut shortened) = (0, 0);
    for case in 0..40 {
        let (start, goal) = ([-0.6 - 0.005 * f64::from(case), 0.0], [0.9, 0.0]);
        // Around the ball by a bent elbow, in more legs than it takes.
        let path = [[start[0], 1.0], [0.0, 1.5], [0.9, 1.0]].map(Vec::from);
        let path = [vec![start.to_vec()], path.to_vec(), vec![goal.to_vec()]].concat();
        let plan = Plan {
            ending: Ending::Solved,
            path: path.clone(),
            cost: None,
            counts: Counts::new(),
            traces: Vec::new(),
            reason: None,
        };
        let request =
            Request { world: &world, start: &start, goal: &goal, expansions: 1, seed: 1, trace: false };
        let short = stage.refine(&request, plan).path;
        slipped += u32::from(Motions::new(local).goes(&start, &goal));
        shortened += u32::from(motions.length(&short) < 0.95 * motions.length(&path));
        assert_eq!(motions.refused_leg(&short), None, "case {case}: {short:?}");
    }
    assert!((5..40).contains(&slipped), "one-sided sample: {slipped} of 40 slip past");
    assert_eq!(shortened, 40, "every path can be shortened");
}
