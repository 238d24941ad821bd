use super::*;
use crate::verification;
use engine::planner::Plan;
use engine::planner::{self, Build, Ending, Planner, Request};
use engine::space::roadmap::{Near, Roadmap};

fn settings(over: &str) -> Settings {
    let text = r#"
robot = "data/robots/motoman_up6.toml"
scene = "data/scenes/fu2018_cell.toml"
queries = "data/scenes/fu2018_groups.toml"
obstacles = true
self_collision = true
samples = 60
counted = "accepted"
region = "full"
radius_mm = 500
path = "tool"
step_mm = 20
step_deg = 4
jump_deg = 20
turn_deg = 180
end = "own"
"#;
    let mut table: toml::Table = toml::from_str(text).unwrap();
    table.extend(toml::from_str::<toml::Table>(over).unwrap());
    Settings::composed("a test", table)
}

fn inputs(more: Option<&std::path::Path>) -> Inputs {
    let own = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    Inputs::below(more.map(PathBuf::from).into_iter().chain([own]).collect())
}

fn planner(over: &str) -> Box<dyn Planner> {
    let text = "samples = 60\nneighbour_mm = 500\ncost = 'hops'\ngoal_shot = 'never'\npath = 'parents'\n";
    let mut table: toml::Table = toml::from_str(text).unwrap();
    table.extend(toml::from_str::<toml::Table>(over).unwrap());
    let Build::Planner(build) = planner::find("roadmap_astar").unwrap().build else { panic!("a planner") };
    build(&Settings::composed("a test", table)).unwrap()
}

#[test]
fn numbers_that_cannot_be_are_refused_by_name() {
    for (over, parts) in [
        ("samples = 0", ["`samples` is 0", "1 to 100000"]),
        ("radius_mm = 0", ["`radius_mm` is 0", "from 0.001 to 100000"]),
        ("radius_times = 0", ["`radius_times` is 0", "above 0"]),
        ("step_deg = nan", ["`step_deg` is nan", "finite"]),
        ("speed = { tool_mm_s = -1, acceleration_mm_s2 = 1 }", ["tool_mm_s` is -1", "above 0"]),
        ("tool_mm = 0", ["tool_mm", "capsule"]),
        ("tool_mm = 0.15", ["tool_mm is 0.15", "is it in metres? millimetres are accepted"]),
        (
            "radius_mm = 0.5",
            ["radius_mm is 0.5", "is it in metres? millimetres are accepted (0.5 m is 500 mm)"],
        ),
        (
            "queries = 2\nstart_mm = { x = [0, 0.5], z = [0.3, 0.9] }",
            ["the greatest coordinate of start_mm is 0.9", "is it in metres? millimetres are accepted"],
        ),
        (
            "speed = { tool_mm_s = 0.5, acceleration_mm_s2 = 2000 }",
            ["speed.tool_mm_s is 0.5", "is it in metres? millimetres are accepted (0.5 m is 500 mm)"],
        ),
        (
            "speed = { tool_mm_s = 500, acceleration_mm_s2 = 1.5 }",
            [
                "speed.acceleration_mm_s2 is 1.5",
                "is it in metres? millimetres are accepted (1.5 m is 1500 mm)",
            ],
        ),
        ("turn_deg = 3.14159", ["turn_deg is 3.14159", "is it in radians? degrees are accepted"]),
        ("scene = 'data/none.toml'", ["data/none.toml", "does not exist"]),
        ("radius = 3", ["radius", "radius_mm"]),
        ("region = 'half'", ["half", "around_poses"]),
        (
            "heights_mm = { 'ground obstacle' = 0.42 }",
            [
                "heights_mm.ground obstacle is 0.42",
                "is it in metres? millimetres are accepted (0.42 m is 420 mm)",
            ],
        ),
        ("heights_mm = { storage = 9 }", ["no box `storage`", "ground obstacle"]),
    ] {
        let message = Posed::new(&settings(over), &inputs(None)).err().expect(over).to_string();
        assert!(parts.iter().all(|part| message.contains(part)), "{over}: {message}");
    }
}

#[test]
fn the_sixth_joint_is_drawn_over_half_a_turn_either_way_or_over_all_that_it_turns() {
    let degrees = |over: &str| {
        let posed = Posed::new(&settings(over), &inputs(None)).unwrap();
        posed.bounds_rad.map(|ends| ends.map(|end| end.to_degrees().round()))
    };
    let half = degrees("");
    let whole = degrees("turns = 'whole'");
    assert_eq!((half[5], whole[5]), ([-180.0, 180.0], [-360.0, 360.0]));
    assert_eq!(half[..5], whole[..5]);
}

#[test]
fn a_group_that_names_a_missing_pose_is_refused_with_the_poses_there_are() {
    let folder = tempfile::tempdir().unwrap();
    let text = "[pose_deg]\nA = [0, 0, 0, 0, 0, 0]\n[[group]]\nname = '1'\nfrom = 'A'\nto = 'B'\n";
    std::fs::write(folder.path().join("groups.toml"), text).unwrap();
    let refused = Posed::new(&settings("queries = 'groups.toml'"), &inputs(Some(folder.path())));
    let message = refused.err().unwrap().to_string();
    assert!(message.contains("groups.toml:6:6") && message.contains("no pose `B`; there are A"), "{message}");
}

#[test]
fn a_pose_that_seems_to_be_in_radians_is_asked_about() {
    let folder = tempfile::tempdir().unwrap();
    let text = "[pose_deg]\nA = [0, -1.5708, 0, 0, 1.5708, 0]\nB = [0, -90, 0, 0, 90, 0]\n[[group]]\nname = '1'\nfrom = 'A'\nto = 'B'\n";
    std::fs::write(folder.path().join("groups.toml"), text).unwrap();
    let refused = Posed::new(&settings("queries = 'groups.toml'"), &inputs(Some(folder.path())));
    let message = refused.err().unwrap().to_string();
    let question =
        "an angle of pose `A` is -1.5708; is it in radians? degrees are accepted (-1.5708 rad is -90.0°)";
    assert!(message.contains("groups.toml:2:9") && message.contains(question), "{message}");
    // No right angle is among these.
    let question =
        "pose `A` turns no joint beyond 2.1°; is it in radians? degrees are accepted (2.1 rad is 120.3°)";
    let pose = "0, -1.5708, 0, 0, 1.5708, 0";
    for (small, other, is_asked) in [
        ("2.1, -1.05, 1.3, -2, -1.2, 0.1", "0, -90, 0, 0, 90, 0", true),
        ("2.1, 0, 0, 0, 0, 0", "0, -1, 0, 0, 1, 0", true),
        ("2.1, 0, 0, 0, 0, 0", "0, -90, 0, 0, 90, 0", false),
        ("2, -1, 1, -2, -1, 0", "0, -1, 0, 0, 1, 0", false),
    ] {
        let text = text.replace(pose, small).replace("0, -90, 0, 0, 90, 0", other);
        std::fs::write(folder.path().join("groups.toml"), text).unwrap();
        let refused = Posed::new(&settings("queries = 'groups.toml'"), &inputs(Some(folder.path())));
        let message = refused.err().map_or_else(String::new, |error| error.to_string());
        assert_eq!(message.contains(question), is_asked, "{small}: {message}");
        assert_eq!(message.contains("groups.toml:2:6"), is_asked, "{small}: {message}");
    }
}

#[test]
fn a_start_in_collision_is_an_invalid_problem_and_the_other_groups_go_on() {
    let folder = tempfile::tempdir().unwrap();
    let text = "[pose_deg]\nfloor = [0, 0, 60, 0, 0, 0]\nbeyond = [171, -90, 0, 0, 90, 0]\nH = [0, -90, 0, 0, 90, 0]\n\
                P6 = [10, -49, -53, -7, 102, 10]\n[[group]]\nname = '1'\nfrom = 'floor'\nto = 'H'\n[[group]]\nname = '2'\n\
                from = 'H'\nto = 'beyond'\n[[group]]\nname = '3'\nfrom = 'H'\nto = 'P6'\n";
    std::fs::write(folder.path().join("groups.toml"), text).unwrap();
    let posed = Posed::new(&settings("queries = 'groups.toml'"), &inputs(Some(folder.path()))).unwrap();
    let preprocessing = posed.prepare(1).unwrap();
    let plan = |index: usize| {
        let Query { start, goal, .. } = &posed.queries()[index];
        let request =
            Request { world: &preprocessing.world, start, goal, expansions: 1000, seed: 0, trace: false };
        planner("goal_shot = 'before_expansion'").plan(&request).map_err(|invalid| invalid.0)
    };
    assert!(plan(0).unwrap_err().starts_with("the start cannot be posed: part `"));
    let beyond = plan(1).unwrap_err();
    assert_eq!(beyond, "the goal cannot be posed: joint 1 is at 171.00°; it turns from -170.00° to 170.00°");
    assert_eq!(plan(2).unwrap().ending, Ending::Solved);
}

#[test]
fn regions_hold_what_they_say() {
    let home = [0.0, -90.0, 0.0, 0.0, 90.0, 0.0_f64].map(f64::to_radians);
    for (region, seed) in [("full", 1), ("front", 2), ("one_branch", 3), ("around_poses", 4)] {
        let posed = Posed::new(&settings(&format!("region = '{region}'")), &inputs(None)).unwrap();
        let (samples, draws) = posed.samples(&posed.cell, seed);
        assert_eq!(samples.len(), 60);
        assert!(samples.windows(2).all(|pair| pair[0].drawn_after < pair[1].drawn_after));
        assert_eq!(samples[59].drawn_after + 1, draws);
        let arm = posed.cell.robot().arm();
        let q = |sample: &Sample| -> Joints { sample.config.as_slice().try_into().unwrap() };
        assert!(samples.iter().all(|sample| posed.cell.refusal(&q(sample)).is_none()));
        let behind = samples.iter().filter(|s| s.config[0].abs() > std::f64::consts::FRAC_PI_2).count();
        let others = samples.iter().filter(|s| arm.branch_of(&q(s)) != arm.branch_of(&home)).count();
        match region {
            "front" => assert_eq!(behind, 0),
            "one_branch" => assert!(others == 0 && behind > 0),
            "around_poses" => assert!(samples.iter().all(|s| s.config[1] < -18_f64.to_radians())),
            _ => assert!(behind > 10 && others > 20, "{behind} {others}"),
        }
    }
}

#[test]
fn the_first_samples_of_an_arm_and_a_smaller_radius_give_the_roadmap_that_is_built_from_them() {
    let posed = Posed::new(&settings("samples = 300\nregion = 'around_poses'"), &inputs(None)).unwrap();
    let (samples, _) = posed.samples(&posed.cell, 11);
    let built = |count: usize, radius_mm: f64| {
        let local = Local::Arm(Box::new(Lines::new(posed.cell.clone(), posed.read.rules())));
        Roadmap::build(local, samples[..count].to_vec(), Near::Places(radius_mm), Counted::Accepted)
    };
    let whole = built(300, 500.0);
    // An end of a query leaves its trace in the memory that attempts share, and in no edge.
    whole.number("start", &posed.queries()[0].start).unwrap();
    let tally = whole.tally();
    let reasons = whole.tally().rejected.iter().filter(|count| **count > 20).count();
    assert!(tally.edges > 1_000 && reasons >= 3, "one-sided sample: {tally:?}");
    for (count, radius_mm) in [(300, 500.0), (170, 500.0), (300, 350.0), (90, 250.0)] {
        let part = built(count, radius_mm);
        let mut edges = 0;
        for node in 0..count as u32 {
            let links = whole.links(node);
            let kept = links.iter().filter(|(to, gap)| (*to as usize) < count && *gap <= radius_mm);
            let kept: Vec<(u32, f64)> = kept.copied().collect();
            assert_eq!(kept, *part.links(node), "seed 11, {count} samples, {radius_mm} mm, node {node}");
            edges += kept.len() as u64;
        }
        assert!(
            edges == 2 * part.tally().edges && edges > 50,
            "{edges} with {count} samples, {radius_mm} mm"
        );
        assert_eq!(*whole.components(count as u32, radius_mm), *part.components(count as u32, radius_mm));
    }
}

/// The plan with something wrong in it, one thing each.
fn mutants(plan: &Plan) -> Vec<Plan> {
    let mut mutants = vec![plan.clone(), plan.clone(), plan.clone()];
    mutants[0].cost = plan.cost.map(|cost| cost * 0.999);
    mutants[1].path.pop();
    mutants[2].path.insert(1, vec![0.3, -2.0, 0.4, 1.0, 1.2, 0.5]);
    if plan.path.len() > 2 {
        let mut nudged = plan.clone();
        nudged.path[1][0] += 0.3;
        mutants.push(nudged);
    }
    mutants
}

#[test]
fn what_planners_return_is_accepted_by_the_verifier_and_changed_it_is_not() {
    let posed = Posed::new(&settings("samples = 900\nregion = 'front'"), &inputs(None)).unwrap();
    let preprocessing = posed.prepare(7).unwrap();
    let original = planner("samples = 900");
    let improved = planner("samples = 900\ngoal_shot = 'before_expansion'");
    let mut solved = [0, 0];
    let mut refused = 0;
    for query in posed.queries() {
        let verification::Truth::Roadmap(case) =
            verification::truth(&preprocessing.world, query, &crate::verification::Guide::default())
        else {
            panic!("a roadmap")
        };
        let request = Request {
            world: &preprocessing.world,
            start: &query.start,
            goal: &query.goal,
            expansions: 10_000,
            seed: 0,
            trace: false,
        };
        let plans = [&original, &improved].map(|planner| planner.plan(&request).unwrap());
        assert!(
            plans[0].ending != Ending::Solved || plans[1].ending == Ending::Solved,
            "group {}",
            query.name
        );
        for (index, plan) in plans.into_iter().enumerate().filter(|(_, plan)| plan.ending == Ending::Solved) {
            let verified = case.verify(&request, &plan);
            assert_eq!(verified.outcome.1, None, "group {}", query.name);
            solved[index] += 1;
            for (which, mutant) in mutants(&plan).iter().enumerate() {
                let verified = case.verify(&request, mutant);
                assert_eq!(verified.outcome.0, crate::record::Status::Rejected, "mutant {which}");
                refused += 1;
            }
        }
    }
    assert!(solved[0] > 0 && solved[1] >= 8 && refused > 30, "{solved:?} {refused}");
}

#[test]
fn samples_are_those_that_drawing_and_looking_one_by_one_gives() {
    for (over, seed) in [
        ("samples = 300", 21),
        ("samples = 300\ncounted = 'drawn'", 22),
        ("samples = 40\nregion = 'one_branch'", 23),
    ] {
        let posed = Posed::new(&settings(over), &inputs(None)).unwrap();
        let (samples, draws) = posed.samples(&posed.cell, seed);
        let mut stream = seed::stream(seed);
        let mut expected = Vec::new();
        for drawn_after in 0..draws {
            let q: Joints = posed.bounds_rad.map(|[low, high]| low + (high - low) * stream.random::<f64>());
            let fits = posed.branch.is_none_or(|branch| posed.cell.robot().arm().branch_of(&q) == branch);
            if fits && posed.cell.is_free(&q) {
                expected.push(Sample { config: q.to_vec(), drawn_after });
            }
        }
        assert_eq!(samples, expected, "{over}");
        let wanted = posed.read.samples as usize;
        match posed.read.counted {
            Counted::Accepted => assert!(samples.len() == wanted && draws > samples.len() as u32),
            Counted::Drawn => assert!(draws as usize == wanted && samples.len() < wanted),
        }
    }
}

#[test]
fn a_radius_is_multiplied_and_nothing_else_is() {
    let near = |over: &str| Posed::new(&settings(over), &inputs(None)).unwrap().near;
    assert_eq!(near(""), Near::Places(500.0));
    assert_eq!(near("radius_times = 1.25"), Near::Places(625.0));
    assert_eq!(near("built_times = 1.28"), Near::Places(640.0));
    assert_eq!(near("radius_times = 1.6\nbuilt_times = 1.28"), Near::Places(800.0));
}

/// Settings without a radius of places.
#[test]
fn angles_and_distances_of_settings_in_other_units_are_asked_about() {
    for (over, doubt) in [
        (
            "jump_deg = 0.349",
            "jump_deg is 0.349; is it in radians? degrees are accepted (0.349 rad is 20.0°)",
        ),
        ("jump_deg = 0.35", "jump_deg is 0.35; is it in radians?"),
        ("step_deg = 0.1745", "step_deg is 0.1745; is it in radians?"),
        ("turn_deg = 3.1416", "turn_deg is 3.1416; is it in radians?"),
        ("radius_mm = 1.5", "radius_mm is 1.5; is it in metres?"),
    ] {
        let message = Posed::new(&settings(over), &inputs(None)).err().expect(over).to_string();
        assert!(message.contains(doubt), "{over}: {message}");
    }
    for (radius_deg, is_asked) in
        [("1.5", true), ("2.618", true), ("0.5", true), ("2.5", false), ("30", false)]
    {
        let posed = Posed::new(&by_configuration(&format!("radius_deg = {radius_deg}")), &inputs(None));
        let message = posed.err().map_or_else(String::new, |error| error.to_string());
        let doubt = format!("radius_deg is {radius_deg}; is it in radians?");
        assert_eq!(message.contains(&doubt), is_asked, "{message}");
    }
}

fn by_configuration(over: &str) -> Settings {
    let settings = settings(&format!("path = 'joints'\n{over}"));
    let mut table = settings.table().clone();
    table.remove("radius_mm");
    Settings::composed("a test", table)
}

#[test]
fn a_roadmap_in_joint_space_has_paths_that_the_verifier_accepts() {
    for rule in ["nearest = 12", "radius_deg = 110"] {
        let posed = Posed::new(&by_configuration(&format!("samples = 600\n{rule}")), &inputs(None)).unwrap();
        let preprocessing = posed.prepare(3).unwrap();
        let planner = planner("samples = 600\nneighbour_mm = 3000");
        let mut solved = 0;
        for query in posed.queries() {
            let guide = crate::verification::Guide::default();
            let verification::Truth::Roadmap(case) = verification::truth(&preprocessing.world, query, &guide)
            else {
                panic!("a roadmap")
            };
            let (start, goal) = (&query.start, &query.goal);
            let request = Request {
                world: &preprocessing.world,
                start,
                goal,
                expansions: 10_000,
                seed: 0,
                trace: false,
            };
            let plan = planner.plan(&request).unwrap();
            if plan.ending == Ending::Solved {
                assert_eq!(case.verify(&request, &plan).outcome.1, None, "{rule}, group {}", query.name);
                solved += 1;
            }
        }
        assert!(solved >= 3, "{rule}: {solved} solved");
    }
    for rule in ["", "nearest = 12\nradius_deg = 30", "nearest = 12\nradius_mm = 500"] {
        let mut table = by_configuration("").table().clone();
        table.extend(toml::from_str::<toml::Table>(rule).unwrap());
        let refused = Posed::new(&Settings::composed("a test", table), &inputs(None));
        let message = refused.err().expect(rule).to_string();
        assert!(message.contains("exactly one of radius_mm, radius_deg and nearest"), "{rule}: {message}");
    }
}

#[test]
fn drawn_cells_leave_every_pose_free_and_hold_several_roadmaps() {
    let family = |more: &str| {
        let over = format!("scene = 'data/scenes/fu2018_drawn_cell.toml'\n{more}");
        Posed::new(&settings(&over), &inputs(None)).unwrap()
    };
    let [first, second] = [family("roadmap = 1"), family("roadmap = 2")];
    let mut free = [0; 11];
    for seed in 0..40 {
        let cell = first.cell_of(seed).unwrap();
        assert!(are_apart(cell.scene()), "seed {seed}");
        assert!(first.queries.iter().flat_map(Query::ends).all(|end| cell.is_free(end.try_into().unwrap())));
        let same = second.cell_of(seed).unwrap();
        assert_eq!(format!("{:?}", cell.scene()), format!("{:?}", same.scene()), "seed {seed}");
        assert_ne!(first.samples(&cell, seed).0[0].config, second.samples(&same, seed).0[0].config);
        let lines = Lines::new(cell, first.read.rules());
        let traces = picture::traces(&lines, &first.queries);
        let straight: Vec<_> = traces.iter().filter(|trace| trace.name.starts_with("line ")).collect();
        assert_eq!(straight.len(), 10, "seed {seed}");
        free[straight.iter().filter(|line| line.values[0] > 0.0).count()] += 1;
        let known = |near: &str| {
            near == "the robot itself" || lines.cell().scene().obstacles().iter().any(|o| o.name == near)
        };
        assert!(straight.iter().all(|line| known(line.name.split_once('/').unwrap().1)), "seed {seed}");
    }
    assert!(free.iter().filter(|cells| **cells > 0).count() > 2, "cells alike: {free:?}");
    assert!(
        Posed::new(&settings("roadmap = 1"), &inputs(None)).err().unwrap().to_string().contains("[drawn]")
    );
}

#[test]
fn the_drawn_cells_that_the_cross_check_reads_are_those_that_the_study_draws() {
    // The seeds of the first two instances of the study `drawn_cells`.
    for (file, seed) in
        [("fu2018_drawn_0", 2_932_714_602_525_562_093), ("fu2018_drawn_1", 4_252_209_531_978_214_276)]
    {
        let posed =
            Posed::new(&settings("scene = 'data/scenes/fu2018_drawn_cell.toml'"), &inputs(None)).unwrap();
        let boxes = |scene: &Scene| -> Vec<(String, [i64; 6])> {
            let corners = |own: &engine::space::cell::Obstacle| {
                let aabb = own.solid.aabb();
                [aabb.min.x, aabb.min.y, aabb.min.z, aabb.max.x, aabb.max.y, aabb.max.z]
                    .map(|metres| (metres * 1e9).round() as i64)
            };
            scene.obstacles().iter().map(|own| (own.name.clone(), corners(own))).collect()
        };
        let path = format!("{}/../../data/scenes/{file}.toml", env!("CARGO_MANIFEST_DIR"));
        let written = Scene::parse(&Document::open(path.as_ref()).unwrap()).unwrap();
        assert_eq!(boxes(posed.cell_of(seed).unwrap().scene()), boxes(&written), "{file}");
    }
}
