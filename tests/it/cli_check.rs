//! `replan check` finds everything that is wrong with a paper in one round, each thing once.

use crate::paper::{Bench, CONTENDERS_END};

/// Every fault that `said` tells is one of `expected`, in this order, and none is missing; the lines of the files below them
/// are left out.
fn assert_faults(message: &str, expected: &[&str]) {
    let text = message.strip_prefix("replan: ").unwrap_or(message);
    let lines: Vec<&str> = text.lines().filter(|line| !line.starts_with("    ")).collect();
    assert_eq!(lines.len(), expected.len(), "{message}");
    for (line, expected) in lines.iter().zip(expected) {
        assert!(
            line.contains(expected),
            "{expected}
is not in: {line}
{message}"
        );
    }
}

#[test]
fn ten_faults_of_as_many_kinds_are_reported_in_one_round_and_once_each() {
    let bench = Bench::new();
    for (file, from, to) in [
        ("room", "searched = true", "searched = true\nfitted_to = [\"toll\"]"),
        ("room", "start = [0, 0]", "start = [3, 0]"),
        ("room", "goal = [6, 3]", "goal = [3, 1]"),
        ("draws", "\"delete_inflections\"", "\"delete_reflections\""),
        ("draws", "weight = 1,", "weight = -1,"),
        ("paper", "default = \"opened\"", "default = \"open\""),
        ("paper", "figures = [\"fig1\"]", "figures = [\"fig2\"]"),
        ("paper", "metric = \"path_cost_cells\"", "metric = \"path_cost\""),
        ("paper", "contenders = [\"A*\"]", "contenders = [\"B*\"]"),
        ("paper", "problems = \"drawn\"", "problems = [\"drown\"]"),
    ] {
        bench.edit(&format!("mini/{file}.toml"), from, to);
    }
    let output = bench.run(&["check", "./mini"]);
    assert_eq!(output.code, Some(2), "{}", output.err);
    let expected = [
        "mini/draws.toml:24:23: weight is -1; ",
        "mini/draws.toml:30:19: contender `Two-sided` asks for stage `delete_reflections`, which does not exist (did you",
        "mini/paper.toml:13:12: there is no figure or table `fig2` (did you mean `fig1`?); there are fig1, table1",
        "mini/paper.toml:26:10: there is no metric `path_cost`, nor a choice that gives the name a meaning (did you",
        "mini/paper.toml:27:15: there is no contender `B*`; there are A*",
        "mini/paper.toml:38:13: study `draws` has no problem group `drown` (did you mean `drawn`?); it has drawn",
        "mini/paper.toml:46:11: choice `nodes` has no option `open` (did you mean `opened`?); it has closed, opened",
        "mini/room.toml:5:14: fitted_to: there is no claim `toll`",
        "mini/room.toml:17:44: the start [3.0, 0.0] is blocked",
        "mini/room.toml:17:59: the goal [3.0, 1.0] is blocked",
    ];
    assert_faults(&output.err, &expected);
}

#[test]
fn a_default_that_hides_what_a_contender_or_a_problem_says_is_refused() {
    let bench = Bench::new();
    let written = "problem = { corner_rule = \"allow\" }";
    let other = "problem = { corner_rule = \"forbid_any\" }\nstage.astar = { ties = \"lifo\" }";
    bench.edit("mini/paper.toml", written, other);
    let output = bench.run(&["check", "./mini"]);
    assert_eq!(output.code, Some(2), "{}", output.err);
    assert_faults(
        &output.err,
        &[
            "paper.toml:54:11: the default of choice `corners` changes the `ties` that contender `A*` says in study `draws`; the",
            "paper.toml:54:11: the default of choice `corners` changes the `corner_rule` that problems `drawn` say in study `draws`;",
        ],
    );
    // The same is no other, and what is not said is not hidden.
    let same = format!(
        "{written}\nstage.astar = {{ ties = \"fifo\" }}\nstage.delete_inflections = {{ corners = \"kept\" }}"
    );
    bench.edit("mini/paper.toml", other, &same);
    let output = bench.run(&["check", "./mini"]);
    assert!(!output.err.contains("the default of choice"), "{}", output.err);
}

#[test]
fn a_fault_is_reported_once_whatever_choices_and_sweeps_lie_over_it() {
    let bench = Bench::new();
    bench.edit("mini/draws.toml", "weight = 1,", "weight = -1,");
    bench.edit("mini/draws.toml", "size_cells = [12, 12]", "size_cells = [0, 12]");
    let sweep = "\n[[sweep]]\nkey = \"ties\"\nstage = \"astar\"\nvalues = [\"fifo\", \"lifo\"]\n";
    bench.edit("mini/draws.toml", CONTENDERS_END, &format!("{CONTENDERS_END}{sweep}"));
    let output = bench.run(&["check", "./mini"]);
    assert_faults(
        &output.err,
        &[
            "draws.toml:19:27: size_cells: a grid of 0 × 12 cells; each side",
            "draws.toml:24:23: weight is -1; ",
        ],
    );
    bench.edit("mini/draws.toml", "size_cells = [0, 12]", "size_cells = [12, 12]");
    bench.edit("mini/draws.toml", "weight = -1,", "weight = 1,");
    bench.edit(
        "mini/paper.toml",
        "problem = { corner_rule = \"forbid_any\" }",
        "problem = { goal = [12, 9] }",
    );
    let output = bench.run(&["check", "./mini"]);
    assert_faults(&output.err, &[":20: goal is [12, 9], outside the map"]);
}

#[test]
fn sizes_whose_product_cannot_be_meant_are_refused_with_the_limit() {
    let bench = Bench::new();
    for (file, edits, expected) in [
        (
            "draws",
            &[
                ("instances = 24", "instances = 1_000_000"),
                ("ties = \"fifo\" }\n\n", "ties = \"fifo\" }\nrepeats = 100_000\n\n"),
            ][..],
            &[
                "draws.toml:18:13: the study has 1.0e11 trials: 1000000 problems by 2 contenders, up to 100000 seeds each",
                "draws.toml:25:11: `repeats` is 100000, and contender `A*` draws nothing at random; 1 is accepted",
            ][..],
        ),
        (
            "draws",
            &[("instances = 24", "instances = 1_000_000"), ("[12, 12]", "[4096, 4096]")],
            &[
                "draws.toml:18:13: 1000000 instances of 16777216 cells or samples each are 1.7e13; at most 1e12 are accepted",
            ],
        ),
        (
            "draws",
            &[
                ("\"random_cells\"", "\"random_rectangles\""),
                ("[12, 12]", "[4096, 4096]"),
                ("blocked_share = 0.3", "count = 1_000_000, side_cells = [1, 8192]"),
            ],
            &[
                "draws.toml:18:13: 24 instances of 16777232777216 cells or samples each are 4.0e14; at most 1e12 are",
            ],
        ),
        (
            "draws",
            &[("problems = 2\nrepeats = 2", "problems = 1_000_000\nrepeats = 1_000_000")],
            &["draws.toml:13:11: 1.0e12 runs are timed; at most 1e7 are accepted"],
        ),
        (
            "room",
            &[("instances = 1 }]", "instances = 2, contender = \"A*\", repeats = 3 }]")],
            &[
                "room.toml:27:43: `instances` is 2; there are 1, and no more is accepted",
                "room.toml:27:74: `repeats` is 3; there are 1, and no more is accepted",
            ],
        ),
    ] {
        let name = format!("mini/{file}.toml");
        let whole = std::fs::read(bench.at(&name)).unwrap();
        for (from, to) in edits {
            bench.edit(&name, from, to);
        }
        let output = bench.run(&["check", "./mini"]);
        assert_eq!(output.code, Some(2), "{}{}", output.out, output.err);
        assert_faults(&output.err, expected);
        bench.write(&name, &whole);
    }
    let many: Vec<String> = (0..101).map(|value| value.to_string()).collect();
    let sweep = |key: &str| {
        format!("[[sweep]]\nkey = \"{key}\"\nstage = \"astar\"\nvalues = [{}]\n\n", many.join(", "))
    };
    let both = format!("{CONTENDERS_END}\n{}{}", sweep("weight"), sweep("other"));
    bench.edit("mini/draws.toml", CONTENDERS_END, &both);
    let output = bench.run(&["check", "./mini"]);
    assert!(
        output.err.contains("the values of the sweeps have 10201 combinations; at most 10000 are"),
        "{}",
        output.err
    );
}

#[test]
fn files_of_something_else_beside_the_studies_are_distinguished_from_studies() {
    let bench = Bench::new();
    for (name, text) in [
        (".hidden.toml", "paper = \"mini\"\nbroken"),
        ("Cargo.toml", "[package]\nname = \"x\"\n[dependencies]\n"),
        ("empty.toml", ""),
        ("notes.toml", "[[idea]]\ntext = \"try a third side\"\n"),
    ] {
        bench.write(&format!("mini/{name}"), text.as_bytes());
    }
    let output = bench.done(&["check", "./mini"]);
    let expected = "mini: 2 studies, 2 claims, 2 inventory rows are in order\n  \
        ./mini/Cargo.toml is taken for a file of something else, not for a study\n  \
        ./mini/empty.toml is taken for a file of something else, not for a study\n  \
        ./mini/notes.toml is taken for a file of something else, not for a study\n";
    assert_eq!(output, expected);
    for (text, expected) in [
        (
            "seed = 3\n",
            &["notes.toml:1:1: missing key `paper`", "notes.toml:1:1: missing key `question`"][..],
        ),
        ("[budget", &["notes.toml:1:8: "]),
    ] {
        bench.write("mini/notes.toml", text.as_bytes());
        let output = bench.run(&["check", "./mini"]);
        assert_eq!(output.code, Some(2), "{}", output.err);
        assert_faults(&output.err, expected);
    }
}

#[test]
fn a_crosscheck_is_checked_with_its_paper() {
    let bench = Bench::new();
    let spec = "seed = 1\n[sizes]\nstills = 1\n[picture]\n";
    bench.write("mini/crosscheck.toml", spec.as_bytes());
    let output = bench.run(&["check", "./mini"]);
    assert_eq!(output.code, Some(2), "{}", output.err);
    assert!(output.err.contains("mini/crosscheck.toml:2:1: missing key `"), "{}", output.err);
    let whole =
        std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/experiments/planar/crosscheck.toml"));
    let whole = whole.unwrap();
    let name = whole.split_once("study = \"").unwrap().1.split_once('"').unwrap().0;
    let wrong = whole.replace(&format!("study = \"{name}\""), "study = \"drows\"");
    bench.write("mini/crosscheck.toml", wrong.as_bytes());
    bench.edit("mini/room.toml", "start = [0, 0]", "start = [3, 0]");
    let output = bench.run(&["check", "./mini"]);
    assert!(
        output.err.contains("there is no study `drows` (did you mean `draws`?); there are draws, room"),
        "{}",
        output.err
    );
    assert!(output.err.contains("mini/room.toml:16:44: the start [3.0, 0.0] is blocked"), "{}", output.err);
}

#[test]
fn a_misspelled_metric_may_be_one_that_a_choice_introduces() {
    let bench = Bench::new();
    bench.edit("mini/paper.toml", "metric = \"nodes\"", "metric = \"nodez\"");
    let output = bench.run(&["check", "./mini"]);
    assert!(
        output.err.contains("gives the name a meaning (did you mean `nodes`?); the metrics are "),
        "{}",
        output.err
    );
    let output = bench.done(&["list", "metrics", "path_length_mm"]);
    let output = output.split_whitespace().collect::<Vec<_>>().join(" ");
    let column = study::column::find("path_length_mm").unwrap();
    for part in [column.about, "unit: mm", "better: lower", "read from: path_length_mm"] {
        assert!(output.contains(part), "{part}\n{output}");
    }
}

#[test]
fn an_option_of_a_choice_changes_what_exists() {
    let bench = Bench::new();
    bench.edit(
        "mini/paper.toml",
        "metric = { nodes = \"closed\" }",
        "metric = { nodes = \"colsed\" }, stage = { asatr = { ties = \"lifo\" } }",
    );
    let output = bench.run(&["check", "./mini"]);
    assert_faults(
        &output.err,
        &[
            "paper.toml:49:31: there is no metric `colsed` (did you mean `closed`?); there are ",
            "paper.toml:49:61: there is no planner or stage `asatr` (did you mean `astar`?); there are ",
        ],
    );
}
