//! Starts and goals that are drawn with each instance, family by family.

use base::settings::Settings;
use engine::planner::Invalid;
use engine::space::World;
use engine::space::roadmap::Local;
use std::collections::BTreeSet;
use std::path::Path;
use study::family::{self, Family, Query};
use study::{Inputs, StudyError};

fn build(name: &str, over: &str) -> Result<Box<dyn Family>, StudyError> {
    let entry = family::find(name).unwrap();
    let table = |text: &str| toml::from_str(text).unwrap();
    let settings = Settings::composed("a test", table(entry.example)).overlaid(&table(over), "a test");
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).to_owned();
    (entry.build)(&settings, &Inputs::below(vec![root.join("experiments/zhang"), root]))
}

/// What each family is built from so that both ends of two queries are drawn, the goal within limits; and its limits, by the
/// place of a coordinate.
const DRAWN: [(&str, &str, usize, [f64; 2]); 7] = [
    ("random_cells", "start = 'drawn'\ngoal = { x = [30, 39] }\nqueries = 2", 0, [30.0, 39.0]),
    ("random_rectangles", "start = 'drawn'\ngoal = { y = 7 }\nqueries = 2", 1, [7.0, 7.0]),
    ("random_bars", "start = 'drawn'\ngoal = { x = [0, 9], y = [5, 30] }\nqueries = 2", 1, [5.0, 30.0]),
    ("grid_map", "start = 'drawn'\ngoal = { x = [0, 9] }\nqueries = 2", 0, [0.0, 9.0]),
    ("plane_queries", "start_mm = 'drawn'\ngoal_mm = { y = [10, 60.5] }\nqueries = 2", 1, [10.0, 60.5]),
    ("arm_workspace", "start_cm = 'drawn'\ngoal_cm = { x = [-40, -5] }\nqueries = 2", 0, [-40.0, -5.0]),
    ("cell_queries", "queries = 2\ngoal_mm = { z = [300, 900] }\nsamples = 2", 2, [300.0, 900.0]),
];

/// Whether the robot or the point can stand there.
fn is_free(world: &World, end: &[f64]) -> bool {
    match world {
        World::Lattice(world) => world.free_cell("end", end).is_ok(),
        World::Arm(world) => world.free_cell("end", end).is_ok(),
        World::Roadmap(roadmap) => match roadmap.local() {
            Local::Plane(plane) => plane.refusal([end[0], end[1]]).is_none(),
            Local::Arm(lines) => lines.cell().is_free(&end.try_into().unwrap()),
            Local::Joints(space) => space.is_free(end),
        },
        World::Polyhedra(_) => panic!("no family of these poses problems in another world"),
    }
}

#[test]
fn drawn_ends_are_free_apart_within_their_limits_and_fixed_by_the_seed() {
    for (name, over, axis, [low, high]) in DRAWN {
        let family = build(name, over).unwrap();
        assert!(family.draws_ends(), "{name}");
        let names: Vec<&str> = family.queries().iter().map(|query| query.name.as_str()).collect();
        assert_eq!(names, ["1", "2"], "{name}");
        let mut starts = BTreeSet::new();
        let mut low_goals = 0;
        for seed in 0..40 {
            let world = family.prepare(seed).unwrap().world;
            let queries = family.queries_for(seed);
            assert_eq!(queries, build(name, over).unwrap().queries_for(seed), "{name}, seed {seed}");
            for Query { start, goal, .. } in &queries {
                assert!(
                    start != goal && is_free(&world, start) && is_free(&world, goal),
                    "{name}, seed {seed}"
                );
                // Of an arm in its cell the tip lies within the limits.
                let tip = family.stance(goal).map(|stance| stance.tip_mm.to_vec());
                let at = tip.as_ref().unwrap_or(goal)[axis];
                assert!((low..=high).contains(&at), "{name}, seed {seed}: {at}");
                low_goals += u32::from(at <= low.midpoint(high));
                starts.insert(format!("{start:?}"));
            }
        }
        assert!(starts.len() > 60, "{name}: {} starts in 80 queries", starts.len());
        assert!(
            low == high || (15..65).contains(&low_goals),
            "{name}: {low_goals} of 80 goals in the lower half"
        );
    }
}

#[test]
fn a_robot_among_solids_gets_drawn_configurations_in_place_of_its_problem_file() {
    let family = build("joint_queries", "queries = 2\nstart_mm = { x = [0, 400] }\nsamples = 2").unwrap();
    let preprocessing = family.prepare(4).unwrap();
    for Query { start, goal, .. } in family.queries_for(4) {
        assert!(
            start != goal && is_free(&preprocessing.world, &start) && is_free(&preprocessing.world, &goal)
        );
        assert!((0.0..=400.0).contains(&family.stance(&start).unwrap().tip_mm[0]));
    }
    assert_eq!(preprocessing.traces.iter().filter(|trace| trace.name.starts_with("pose ")).count(), 4);
}

#[test]
fn one_more_query_moves_no_other_and_no_query_moves_the_map() {
    let of = |over: &str| build("random_cells", over).unwrap();
    let two = of("queries = 2");
    let five = of("queries = 5");
    let fixed = of("start = [1, 1]\ngoal = [2, 2]\nqueries = 1");
    for seed in 0..20 {
        assert_eq!(two.queries_for(seed)[..], five.queries_for(seed)[..2], "seed {seed}");
        let grid = |family: &dyn Family| {
            let world = family.draw(seed).unwrap();
            let mut grid = world.as_lattice().unwrap().grid().clone();
            for (x, y) in [(1, 1), (2, 2)] {
                grid.set_blocked(grid.cell(x, y).unwrap(), false);
            }
            grid
        };
        assert_eq!(grid(two.as_ref()), grid(fixed.as_ref()), "seed {seed}");
    }
}

#[test]
fn a_drawn_cell_is_any_free_one_with_equal_chance() {
    let over = "size_cells = 3\nstart = 'drawn'\ngoal = 'drawn'\nqueries = 10000\nblocked_share = 0.4";
    let family = build("random_cells", over).unwrap();
    let seed = (0..50).find(|seed| {
        let free = family.draw(*seed).unwrap().as_lattice().unwrap().grid().free_count();
        (4..7).contains(&free)
    });
    let seed = seed.unwrap();
    let mut counts = std::collections::BTreeMap::new();
    for query in family.queries_for(seed) {
        *counts.entry(format!("{:?} {:?}", query.start, query.goal)).or_insert(0) += 1;
    }
    let free = family.draw(seed).unwrap().as_lattice().unwrap().grid().free_count() as usize;
    let pairs = free * (free - 1);
    assert_eq!(counts.len(), pairs, "seed {seed}");
    let expected = 10_000.0 / pairs as f64;
    // Five standard deviations.
    let is_near = |count: &i32| (f64::from(*count) - expected).abs() < 5.0 * expected.sqrt();
    assert!(counts.values().all(is_near), "seed {seed}: {counts:?}");
}

#[test]
fn ends_that_cannot_be_drawn_are_refused_at_their_key_or_make_an_invalid_instance() {
    for (name, over, expected) in [
        (
            "random_cells",
            "goal = { x = 40 }",
            "x of goal is from 40 to 40; the least and the greatest, both from 0 to 39, are",
        ),
        ("random_cells", "goal = { y = [9, 3] }", "y of goal is from 9 to 3"),
        (
            "random_cells",
            "start = [3, 4]\ngoal = { x = 3, y = 4 }",
            "start and goal can be drawn at [3.0, 4.0] alone; wider limits are accepted",
        ),
        ("random_bars", "queries = 3", "queries is 3, and nothing of them is drawn; 1 is accepted"),
        ("random_bars", "goal = { z = 3 }", "unknown key `z`; accepted: `x`, `y`"),
        ("random_bars", "goal = 'anywhere'", "`goal` is \"anywhere\""),
        ("random_cells", "start = [40, 4]", "start is [40, 4], outside the map"),
        ("plane_queries", "radius_mm = 0.22", "radius_mm is 0.22; is it in metres? millimetres are accepted"),
        ("plane_queries", "goal_mm = { x = [5, 1e6] }", "x of goal_mm is from 5 to 1000000"),
        ("arm_workspace", "goal_cm = { y = [-3, 10] }", "y of goal_cm is from -3 to 10"),
        (
            "cell_queries",
            "start_mm = { z = [300, 900] }",
            "start_mm limits queries that are drawn; `queries`, how many, is",
        ),
        (
            "cell_queries",
            "queries = 2\nregion = 'one_branch'",
            "region goes by the poses of queries that a file holds",
        ),
        (
            "joint_queries",
            "queries = 2\ngoal_mm = { z = [3, 1] }",
            "z of goal_mm is from 3 to 1; the least and the greatest are",
        ),
        (
            "conditioned",
            "shared = { size_cells = [30, 30], start = 'drawn', goal = [26, 28] }",
            "`families` has families that draw a start or goal; written ones are accepted",
        ),
    ] {
        let refused =
            build(name, over).err().unwrap_or_else(|| panic!("{name}: {over} was accepted")).to_string();
        assert!(refused.contains(expected), "should be said: {expected}\nis said: {refused}");
    }
    for (name, over, end) in [
        ("random_rectangles", "goal = { x = 5 }\ncount = 3000", "goal"),
        ("joint_queries", "queries = 2\nstart_mm = { x = 90000 }\nsamples = 2", "start of query 1"),
    ] {
        let family = build(name, over).unwrap();
        let Err(Invalid(reason)) = family.prepare(1) else { panic!("{name}: {over} was posed") };
        assert_eq!(reason, format!("no free {end} was found in 100000 draws"));
        assert_eq!(family.queries_for(1).len(), family.queries().len(), "its trials are rows all the same");
    }
}
