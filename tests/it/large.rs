//! Studies that ask for more than people mean by accident are refused before anything runs, unless people say that they mean it.

use crate::files::{self, PAPER};
use crate::paper::{Bench, committed};
use base::settings::Settings;
use std::path::Path;
use study::Inputs;
use study::paper::Paper;

#[test]
fn no_study_of_a_committed_paper_comes_near_the_limits() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut most = 0.0_f64;
    for name in committed() {
        let folder = root.join("experiments").join(name);
        let inputs = Inputs::below(vec![folder.clone(), root.to_owned()]);
        for study in Paper::load(&folder, &inputs).unwrap().studies {
            let work = study.work(&inputs).unwrap();
            println!("{} {} {work:?}", study.paper, study.name);
            assert_eq!(work.excess(), None, "{}/{}: {work:?}", study.paper, study.name);
            most = most.max(work.trials);
        }
    }
    assert!(most > 10_000.0, "no trials were counted: {most}");
}

#[test]
fn a_study_beyond_the_limits_is_refused_by_every_command_that_runs_and_runs_where_people_allow_it() {
    let bench = Bench::new();
    for (from, to, excess) in [
        ("instances = 24", "instances = 600_000", "asks for about 1.2e6 trials, above 1e6"),
        ("size_cells = [12, 12]", "size_cells = [4000, 4000]", "asks for about 1.2 GB a thread, above 1 GB"),
        ("problems = 2\nrepeats = 2", "problems = 24\nrepeats = 100_000", "4.8e6 trials, above 1e6"),
    ] {
        let before = std::fs::read(bench.at("mini/draws.toml")).unwrap();
        bench.edit("mini/draws.toml", from, to);
        for command in [
            &["check", "./mini"][..],
            &["run", "./mini"],
            &["run", "./mini", "--shard", "1/2", "--out", "parts"],
            &["repro", "./mini"],
            &["confirm", "./mini"],
            &["shard", "./mini", "--engine", "parallel", "--out", "parts", "--merge", "merged"],
        ] {
            let refused = bench.run(command);
            assert_eq!(refused.code, Some(2), "{to}: {command:?}: {}{}", refused.out, refused.err);
            let is_reported =
                refused.err.contains(excess) && refused.err.contains("`--allow-large` accepts that");
            assert!(is_reported, "{to}: {command:?}: {}", refused.err);
        }
        assert!(!bench.at("target").exists() && !bench.at("parts").exists(), "{to}: something was written");
        bench.done(&["check", "./mini", "--allow-large"]);
        bench.write("mini/draws.toml", &before);
    }
    bench.edit("mini/draws.toml", "problems = 2\nrepeats = 2", "problems = 24\nrepeats = 100_000");
    bench.edit("mini/draws.toml", "[quick]", "[quick]\ntiming = { problems = 1, repeats = 1 }");
    bench.done(&["repro", "./mini", "--quick"]);
}

#[test]
fn the_lattices_of_arms_and_among_polyhedra_count_as_work() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let inputs = Inputs::below(vec![root.to_owned()]);
    for (family, over, cells) in [
        ("arm_workspace", "x_cm = [-50, 50]\ny_cm = [0, 50]\nstep_cm = 0.5", 201 * 101),
        ("random_polyhedra", "side_cm = 100\nstep_cm = 0.5", 201 * 201 * 201),
        ("polyhedra_scene", "step_cm = 5", 1000),
        ("joint_queries", "samples = 4000", 4000),
        // A floor, five obstacles and the parts of a robot.
        ("joint_problems", "", 6),
    ] {
        let entry = study::family::find(family).unwrap();
        let settings = Settings::composed("the example", toml::from_str(entry.example).unwrap());
        let settings = settings.overlaid(&toml::from_str(over).unwrap(), "the test");
        let built = (entry.build)(&settings, &inputs).unwrap_or_else(|error| panic!("{family}: {error}"));
        let is_least = ["joint_problems", "polyhedra_scene"].contains(&family);
        let is_so = if is_least { built.cells() > cells } else { built.cells() == cells };
        assert!(is_so, "{family}: {} cells", built.cells());
    }
}

#[test]
fn trees_over_problems_without_a_roadmap_count_as_large_as_the_budget_lets_them_grow() {
    let bench = Bench::empty();
    bench.write("files/paper.toml", PAPER.as_bytes());
    let group = format!(
        "\n[[problems]]\nlabel = \"set\"\nfamily = \"joint_problems\"\ninstances = 1\n[problems.settings]{}",
        study::family::find("joint_problems").unwrap().example
    );
    let example = engine::planner::find("rrt_connect").unwrap().example;
    let contender = format!("label = \"trees\"\nplanner = \"rrt_connect\"\n[contender.settings]{example}");
    bench.write("files/set.toml", files::study(&group, &contender).as_bytes());
    let folder = bench.at("files");
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).to_owned();
    let inputs = Inputs::below(vec![folder.clone(), root]);
    let work = Paper::load(&folder, &inputs).unwrap().studies[0].work(&inputs).unwrap();
    assert!(work.seconds > 0.1 && work.bytes > 1e6, "the budget is 100 000: {work:?}");
}
