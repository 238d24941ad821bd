//! Scenes that break careless searches, each with what must come out.

use crate::planner::{Build, Ending, Entry, Plan, Planner, Request, Value, find};
use crate::shorten::path_length;
use base::seed;
use base::settings::Settings;
use rand::RngExt as _;
use world::geometry::{Aabb, Convex, Segment, Vec3};
use world::space::{PolyhedraWorld, World};

const FULL: &str = "search = 'open_list'\ncluster = true\nlast_resort = true";
const CLUSTER: &str = "search = 'open_list'\ncluster = true\nlast_resort = false";
const OPEN: &str = "search = 'open_list'\ncluster = false\nlast_resort = false";
const GREEDY: &str = "search = 'greedy'\ncluster = false\nlast_resort = false";
const LITERAL: &str = "search = 'literal'\ncluster = false\nlast_resort = false";

fn cuboid(center: [f64; 3], size: [f64; 3]) -> Convex {
    Convex::cuboid(center.into(), size.into()).unwrap()
}

fn world(bodies: Vec<Convex>) -> World {
    let domain = Aabb { min: Vec3::zeros(), max: Vec3::repeat(40.0) };
    World::Polyhedra(Box::new(PolyhedraWorld::new(bodies, domain, 1.0, 0.0).unwrap()))
}

fn planner(name: &str, settings: &str) -> Box<dyn Planner> {
    let entry: &Entry = find(name).unwrap();
    let Build::Planner(build) = entry.build else { panic!("{name} is a stage") };
    build(&Settings::composed("test", toml::from_str(settings).unwrap())).unwrap()
}

fn solve(name: &str, settings: &str, world: &World, ends: [[f64; 3]; 2]) -> Plan {
    let [start, goal] = &ends;
    let request = Request { world, start, goal, expansions: 200_000, seed: 0, trace: false };
    let plan = planner(name, settings).plan(&request).unwrap();
    if plan.ending == Ending::Solved {
        let polyhedra = world.as_polyhedra().unwrap();
        let at = |point: &Vec<f64>| Vec3::new(point[0], point[1], point[2]);
        let careful = !settings.contains("nodes") && !settings.contains("literal");
        for pair in plan.path.windows(2).filter(|_| careful) {
            assert!(
                polyhedra.is_clear(&Segment::new(at(&pair[0]), at(&pair[1]))),
                "{name} {settings}: {pair:?}"
            );
        }
        assert!((plan.cost.unwrap() - path_length(&plan.path)).abs() < 1e-9, "{name} {settings}");
    }
    plan
}

fn keynode(settings: &str, world: &World, ends: [[f64; 3]; 2]) -> Plan {
    solve("keynode_astar", settings, world, ends)
}

fn lattice(checked: &str, world: &World, ends: [[f64; 3]; 2]) -> Plan {
    solve("lattice26_astar", &format!("checked = '{checked}'\nties = 'fifo'"), world, ends)
}

const ACROSS: [[f64; 3]; 2] = [[20.0, 20.0, 5.0], [20.0, 20.0, 35.0]];

#[test]
fn round_a_single_cube_all_but_the_printed_search_find_a_way_near_the_shortest() {
    let world = world(vec![cuboid([20.0, 20.0, 20.0], [10.0, 10.0, 10.0])]);
    // Over the two edges of a face: 5 out, 10 along and 5 back, from 10 away.
    let truth = 2.0 * (10.0_f64.powi(2) + 5.0_f64.powi(2)).sqrt() + 10.0;
    // The walk first goes up to the face, which straightening is for.
    for (settings, most) in [(GREEDY, 1.12), (OPEN, 1.01), (FULL, 1.01)] {
        let plan = keynode(settings, &world, ACROSS);
        assert_eq!(plan.ending, Ending::Solved, "{settings}");
        assert!(plan.cost.unwrap() >= truth && plan.cost.unwrap() < truth * most, "{:?}", plan.cost);
        assert!(plan.counts["opened"].as_f64() < 200.0, "{:?}", plan.counts);
    }
    let yardstick = solve("visibility_edges", "spacing_cm = 3.0", &world, ACROSS);
    assert!((yardstick.cost.unwrap() - truth).abs() < 0.05, "{:?}", yardstick.cost);
    let star = lattice("segments", &world, ACROSS);
    assert!(star.cost.unwrap() < truth * 1.1 && star.counts["opened"].as_f64() > 200.0, "{:?}", star.counts);
    // The printed walk climbs to the first edge and has no face in front of it there.
    assert_eq!(keynode(LITERAL, &world, ACROSS).ending, Ending::NoPath);
}

/// Four boxes that are drawn about the middle.
fn four_boxes(stream: &mut seed::Stream) -> World {
    let boxes = (0..4).map(|_| {
        let mut coordinate = |low: f64, high: f64| stream.random_range(low..high);
        let center = [(); 3].map(|()| coordinate(13.0, 27.0));
        cuboid(center, [(); 3].map(|()| coordinate(3.0, 9.0)))
    });
    world(boxes.collect())
}

/// What the search with key nodes finds from below the middle to above it.
fn across(settings: &str, world: &World, expansions: u64) -> Plan {
    let [start, goal] = &ACROSS;
    let request = Request { world, start, goal, expansions, seed: 0, trace: false };
    planner("keynode_astar", settings).plan(&request).unwrap()
}

#[test]
fn a_walk_in_circles_ends_without_a_path_long_before_its_budget_is_spent() {
    let mut stream = seed::stream(8);
    let mut longest = 0.0_f64;
    for draw in 0..200 {
        let plan = across(LITERAL, &four_boxes(&mut stream), 5_000);
        assert_ne!(plan.ending, Ending::BudgetSpent, "draw {draw}: {:?}", plan.counts);
        longest = longest.max(plan.counts["expansions"].as_f64());
    }
    assert!(longest > 4.0, "no walk comes far: {longest}");
}

#[test]
fn the_walk_with_no_guard_is_the_printed_one_and_with_all_the_guarded_one() {
    let with = |guards: &str| format!("{GREEDY}\nguards = [{guards}]");
    let all = ["faces", "off", "free", "once", "whole"].map(|guard| format!("'{guard}'"));
    let mut stream = seed::stream(7);
    let mut differing = 0;
    for draw in 0..60 {
        let world = four_boxes(&mut stream);
        let plan = |settings: &str| across(settings, &world, 200);
        let same = |a: &Plan, b: &Plan| (a.ending, &a.path) == (b.ending, &b.path) && a.counts == b.counts;
        let printed = plan(LITERAL);
        let guarded = plan(GREEDY);
        assert!(same(&plan(&with("")), &printed), "draw {draw}: no guard");
        assert!(same(&plan(&with(&all.join(", "))), &guarded), "draw {draw}: all guards");
        // Without one of them the walk is another one somewhere.
        let fewer = |left_out: usize| {
            let kept = (0..5).filter(|guard| *guard != left_out).map(|guard| all[guard].clone());
            with(&kept.collect::<Vec<_>>().join(", "))
        };
        differing += (0..5).filter(|left_out| !same(&plan(&fewer(*left_out)), &guarded)).count();
    }
    assert!(differing > 20, "a guard left out changes nothing: {differing} walks");
}

#[test]
fn a_cup_over_the_start_is_left_by_the_open_list_without_fallbacks_and_not_by_the_walk() {
    // Five plates that open downwards, the start inside.
    let plates = vec![
        cuboid([20.0, 20.0, 30.0], [16.0, 16.0, 2.0]),
        cuboid([13.0, 20.0, 23.0], [2.0, 16.0, 14.0]),
        cuboid([27.0, 20.0, 23.0], [2.0, 16.0, 14.0]),
        cuboid([20.0, 13.0, 23.0], [14.0, 2.0, 14.0]),
        cuboid([20.0, 27.0, 23.0], [14.0, 2.0, 14.0]),
    ];
    let world = world(plates);
    let ends = [[20.0, 20.0, 25.0], [20.0, 20.0, 38.0]];
    assert_eq!(keynode(GREEDY, &world, ends).ending, Ending::NoPath);
    assert_eq!(keynode(OPEN, &world, ends).ending, Ending::Solved);
    let plan = keynode(FULL, &world, ends);
    assert_eq!((plan.ending, plan.counts["fell_back"]), (Ending::Solved, Value::Count(0)));
    let yardstick = solve("visibility_edges", "spacing_cm = 2.0", &world, ends);
    let ours = plan.cost.unwrap();
    let least = yardstick.cost.unwrap();
    assert!(ours < 1.4 * least && least > 13.0, "{ours} against {least}");
    assert_eq!(lattice("segments", &world, ends).ending, Ending::Solved);
}

/// Start and goal of the scenes that only a fallback leaves: found among random plates, and thinned out until every plate
/// that was left was needed.
const OUT: [[f64; 3]; 2] = [[20.0, 21.0, 22.0], [39.0, 38.5, 38.0]];

#[test]
fn four_plates_are_passed_only_by_looking_round_all_that_touch() {
    let world = world(vec![
        cuboid([16.5, 23.0, 15.5], [17.0, 2.0, 21.0]),
        cuboid([22.5, 17.5, 16.5], [1.0, 27.0, 21.0]),
        cuboid([13.5, 14.5, 24.0], [23.0, 23.0, 2.0]),
        cuboid([16.5, 25.5, 30.0], [1.0, 15.0, 18.0]),
    ]);
    assert_eq!(keynode(OPEN, &world, OUT).ending, Ending::NoPath);
    assert_eq!(keynode(CLUSTER, &world, OUT).ending, Ending::Solved);
    assert_eq!(keynode(FULL, &world, OUT).counts["fell_back"], Value::Count(0));
}

#[test]
fn five_plates_are_passed_only_by_the_lattice() {
    let world = world(vec![
        cuboid([15.0, 18.5, 17.5], [24.0, 1.0, 25.0]),
        cuboid([22.0, 23.5, 13.0], [26.0, 1.0, 26.0]),
        cuboid([20.75, 20.5, 23.5], [0.5, 18.0, 18.0]),
        cuboid([19.0, 27.5, 18.25], [18.0, 29.0, 0.5]),
        cuboid([12.0, 32.0, 24.5], [2.0, 30.0, 13.0]),
    ]);
    assert_eq!(keynode(CLUSTER, &world, OUT).ending, Ending::NoPath);
    let plan = keynode(FULL, &world, OUT);
    let lattice = lattice("segments", &world, OUT);
    assert_eq!((plan.ending, plan.counts["fell_back"]), (Ending::Solved, Value::Count(1)));
    assert_eq!(plan.cost, lattice.cost);
    assert!(plan.counts["opened"].as_f64() > lattice.counts["opened"].as_f64(), "key nodes count as well");
}

#[test]
fn a_goal_behind_walls_on_all_sides_ends_every_search_without_a_path() {
    let mut walls = Vec::new();
    for axis in 0..3 {
        for side in [-5.0, 5.0] {
            let mut center = [20.0; 3];
            let mut size = [12.0; 3];
            center[axis] += side;
            size[axis] = 2.0;
            walls.push(cuboid(center, size));
        }
    }
    let world = world(walls);
    let ends = [[3.0, 4.0, 5.0], [20.0, 20.0, 20.0]];
    for settings in [GREEDY, OPEN, FULL] {
        assert_eq!(keynode(settings, &world, ends).ending, Ending::NoPath, "{settings}");
    }
    assert_eq!(lattice("segments", &world, ends).ending, Ending::NoPath);
    assert_eq!(solve("visibility_edges", "spacing_cm = 3.0", &world, ends).ending, Ending::NoPath);
}

#[test]
fn a_start_in_a_box_smaller_than_a_step_is_a_start_without_a_path() {
    let mut walls = Vec::new();
    for axis in 0..3 {
        for side in [-0.5, 0.5] {
            let mut center = [20.5; 3];
            let mut size = [1.4; 3];
            center[axis] += side;
            size[axis] = 0.4;
            walls.push(cuboid(center, size));
        }
    }
    let world = world(walls);
    assert_eq!(keynode(FULL, &world, [[20.5; 3], [3.0, 4.0, 5.0]]).ending, Ending::NoPath);
}

#[test]
fn a_plate_thinner_than_a_step_is_tunnelled_through_by_points_and_not_by_segments() {
    let world = world(vec![cuboid([20.0, 20.0, 20.5], [30.0, 30.0, 0.6])]);
    let straight = 30.0;
    assert!((lattice("nodes", &world, ACROSS).cost.unwrap() - straight).abs() < 1e-9);
    for plan in
        [lattice("segments", &world, ACROSS), keynode(GREEDY, &world, ACROSS), keynode(OPEN, &world, ACROSS)]
    {
        assert!(plan.cost.unwrap() > 40.0, "{:?}", plan.cost);
    }
}

#[test]
fn two_boxes_that_touch_leave_no_gap_along_their_common_plane() {
    // The common plane x = 20 holds start and goal.
    let world = world(vec![
        cuboid([15.0, 20.0, 20.0], [10.0, 20.0, 10.0]),
        cuboid([25.0, 20.0, 20.0], [10.0, 20.0, 10.0]),
    ]);
    for plan in
        [lattice("nodes", &world, ACROSS), lattice("segments", &world, ACROSS), keynode(FULL, &world, ACROSS)]
    {
        assert!(plan.cost.unwrap() > 36.0, "leaked: {:?}", plan.cost);
    }
}

#[test]
fn without_obstacles_everything_is_straight_and_a_start_in_one_is_refused() {
    let empty = world(Vec::new());
    let apart = 30.0;
    for settings in [LITERAL, GREEDY, OPEN, FULL] {
        let plan = keynode(settings, &empty, ACROSS);
        assert!((plan.cost.unwrap() - apart).abs() < 1e-9, "{settings}");
        assert!((path_length(&plan.path) - apart).abs() < 1e-9);
        assert_eq!(plan.path.len(), 31, "a point at every step");
    }
    let full = world(vec![cuboid([20.0, 20.0, 6.0], [10.0, 10.0, 10.0])]);
    let [start, goal] = &ACROSS;
    let request = Request { world: &full, start, goal, expansions: 10, seed: 0, trace: false };
    let refusal = planner("keynode_astar", OPEN).plan(&request).unwrap_err();
    assert_eq!(refusal.to_string(), "the start [20.0, 20.0, 5.0] is inside obstacle 1");
}

#[test]
fn straightening_between_key_nodes_shortens_a_walk_and_no_more_than_over_the_whole_path() {
    let world = world(vec![
        cuboid([18.0, 20.0, 14.0], [16.0, 12.0, 6.0]),
        cuboid([22.0, 20.0, 26.0], [18.0, 14.0, 4.0]),
    ]);
    let walk = |legs: &str| keynode(&format!("{GREEDY}\nlegs = '{legs}'"), &world, ACROSS);
    let walked = walk("as_walked");
    let local = walk("last_joined");
    let at = |point: &Vec<f64>| Vec3::new(point[0], point[1], point[2]);
    let all = walked.path.iter().map(at).collect::<Vec<_>>();
    let polyhedra = world.as_polyhedra().unwrap();
    let can_join = |i: usize, j: usize| polyhedra.is_clear(&Segment::new(all[i], all[j]));
    let whole =
        crate::shorten::stepwise_straightening(all.len(), crate::shorten::Resume::LastJoined, can_join);
    let whole: Vec<Vec<f64>> = whole.into_iter().map(|i| walked.path[i].clone()).collect();
    let lengths = [&walked.path, &local.path, &whole].map(|path| path_length(path));
    assert!(lengths[0] > lengths[1] + 1e-6, "{lengths:?}");
    assert!(lengths[1] >= lengths[2] - 1e-9, "{lengths:?}");
    assert!(local.path.len() < walked.path.len() / 2);
}

#[test]
fn no_way_leaves_the_domain_over_an_edge_at_its_wall() {
    // The box ends a thousandth before the wall that is nearest: the shortest way would go round it there.
    let world = world(vec![cuboid([32.9995, 20.0, 20.0], [14.0, 20.0, 10.0])]);
    let ends = [[39.0, 20.0, 5.0], [39.0, 20.0, 35.0]];
    for settings in [GREEDY, OPEN, FULL] {
        let plan = keynode(settings, &world, ends);
        assert_eq!(plan.ending, Ending::Solved, "{settings}");
        let off = plan.path.iter().find(|point| point.iter().any(|c| !(0.0..=40.0).contains(c)));
        assert!(off.is_none(), "{settings}: {off:?}");
    }
}
