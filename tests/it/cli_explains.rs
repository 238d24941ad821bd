//! What people are told of mistakes all at once, and what `list` and `check` say of files and entries.

use crate::paper::Bench;
use crate::wrong_words::file;
use std::fs;

#[test]
fn what_schemas_refuse_is_reported_in_one_round_and_what_they_accept_in_the_next() {
    let bench = Bench::new();
    let refused = [
        ("paper", "title =", "titel =", "paper.toml:2:1: unknown key `titel` (did you mean `title`?)"),
        ("paper", "is = \"lower\"", "is = \"lowr\"", "`is` is \"lowr\" (did you mean `lower`?)"),
        ("paper", "figures = 1\n", "figures = -1\n", "`figures` is -1"),
        ("draws", "seed = 7", "seed = 7.5", "draws.toml:3:8: `seed` is 7.5"),
        ("room", "label = \"room\"", "lable = \"room\"", "unknown key `lable` (did you mean `label`?)"),
    ];
    let accepted = [
        ("paper", "metric = \"path_cost_cells\"", "metrik = \"path_cost_cells\"", "unknown key `metrik`"),
        ("draws", "weight = 1,", "wheight = 1,", "unknown key `wheight` (did you mean `weight`?)"),
        ("draws", "goal = [11, 9]", "goal = [11, 9, 3]", "`goal` is an array of 3; an array of 2"),
        ("draws", "\"bidirectional\"", "\"bidirektional\"", "(did you mean `bidirectional`?)"),
        ("room", "contenders = [\"A*\"]", "contenders = \"A*\"", "`contenders` is \"A*\"; an array"),
    ];
    for (name, from, to, _) in refused.iter().chain(&accepted) {
        bench.edit(&file(name), from, to);
    }
    for round in [refused, accepted] {
        let output = bench.run(&["check", "./mini"]);
        assert_eq!(output.code, Some(2), "{}", output.err);
        for (name, from, to, part) in round {
            assert!(output.err.contains(part), "{part}\nis said: {}", output.err);
            bench.edit(&file(name), to, from);
        }
        let places = output.err.lines().filter(|line| line.contains(".toml:"));
        assert_eq!(places.count(), round.len(), "{}", output.err);
    }
}

#[test]
fn a_toy_needs_no_inventory_no_counts_no_quick_and_no_ties() {
    let bench = Bench::new();
    let paper = fs::read_to_string(bench.at("mini/paper.toml")).unwrap();
    let claims = &paper[paper.find("[[table]]").unwrap()..];
    bench.write("mini/paper.toml", format!("[source]\ntitle = \"A toy\"\n{claims}").as_bytes());
    bench.edit("mini/draws.toml", "[quick]\ninstances = 3\n", "");
    bench.edit("mini/draws.toml", "settings = { weight = 1, ties = \"fifo\" }\n", "");
    bench.edit("mini/room.toml", "[quick]\ninstances = 1\n", "");
    assert_eq!(
        bench.done(&["check", "./mini"]),
        "mini: 2 studies, 2 claims, 0 inventory rows are in order\n"
    );
    bench.done(&["run", "./mini"]);
    let manifest = bench.at("target/replan/mini/data/runs/mini/draws.manifest.toml");
    let manifest = fs::read_to_string(manifest).unwrap();
    for default in [
        "paper: prints = nothing",
        "paper: inventory = nothing",
        "quick: instances = 2",
        "contender `A*`, astar: ties = \"fifo\"",
        "contender `A*`, astar: weight = 1.0",
    ] {
        assert!(manifest.contains(default), "{default}\n{manifest}");
    }
}

#[test]
fn a_scene_in_a_papers_folder_is_taken_for_a_scene() {
    let bench = Bench::new();
    let support = "[support]\nunder = \"floor\"\nbase_mm = [0, 0, 0]\nyaw_deg = 0\n";
    let scene =
        format!("name = \"s\"\n[[box]]\nname = \"b\"\nmin_mm = [0, 0, 0]\nmax_mm = [1, 1, 1]\n{support}");
    bench.write("mini/walls.toml", scene.as_bytes());
    let output = bench.done(&["check", "./mini"]);
    assert!(output.contains("mini/walls.toml is taken for a cell_scene, not for a study"), "{output}");
    bench.write("mini/walls.toml", scene.replace("max_mm", "max_m").as_bytes());
    let output = bench.run(&["check", "./mini"]);
    assert_eq!(output.code, Some(2), "{}", output.err);
    assert!(output.err.contains("walls.toml:5:1: without `paper` and `question`"), "{}", output.err);
    assert!(
        output.err.contains("cell_scene: unknown key `max_m` (did you mean `max_mm`?)"),
        "{}",
        output.err
    );
}

#[test]
fn list_explains_one_thing_within_eighty_columns_and_meets_a_misspelled_name() {
    let bench = Bench::new();
    for (what, name, part) in [
        ("planners", "astar", "ties: \"fifo\", \"lifo\", \"larger_g\" or \"smaller_g\""),
        ("criteria", "one_instance", "[claim.check.one_instance.select]\n"),
        ("checks", "one_instance", "contender = \"A*\""),
        ("rules", "straight_line", "start = [2.0, 2.0]"),
        ("planners", "direct", "planner = \"direct\"\n"),
        ("rules", "lattice_length", "goal = [36, 30]"),
        ("tasks", "plan", "task = \"plan\"\n"),
        ("families", "random_cells", "blocked_share: a number (a share of 1); required"),
        ("tasks", "plan", "It has no settings."),
        ("preprocessing", "lattice", "free_cells"),
        ("files", "robot", "joint.alpha_deg: a number from -360 to 360 (degrees); required"),
        ("files", "study", "{ instances = 2 } if left out"),
    ] {
        let output = bench.done(&["list", what, name]);
        assert!(output.contains(part), "{part}\n{output}");
        assert!(output.lines().all(|line| line.chars().count() <= 80), "{output}");
    }
    assert!(bench.done(&["list", "criteria"]).lines().all(|line| line.chars().count() <= 80));
    let output = bench.run(&["list", "planners", "astr"]);
    assert_eq!(output.code, Some(2), "{}", output.err);
    assert!(output.err.contains("there is no planner `astr` (did you mean `astar`?)"), "{}", output.err);
}

#[test]
fn what_list_prints_of_the_committed_papers_fits_80_columns() {
    let mut list = std::process::Command::new(env!("CARGO_BIN_EXE_replan"));
    let output = list.arg("list").current_dir(env!("CARGO_MANIFEST_DIR")).output().unwrap();
    let output = String::from_utf8(output.stdout).unwrap();
    let wide: Vec<&str> = output.lines().filter(|line| line.chars().count() > 80).collect();
    assert!(output.lines().count() > 100 && wide.is_empty(), "{wide:#?}");
}
