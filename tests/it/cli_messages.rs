//! What the command line says while it works, of names that are nearly right, of counts, and of one thing by itself.

use crate::across::{CITED, Toy};
use crate::paper::Bench;
use base::settings::Document;
use replan::cli::schema;
use std::fs;
use std::path::Path;
use std::process::Command;

#[test]
fn what_may_take_long_says_so_without_a_terminal_on_standard_error_alone() {
    let toy = Toy::unexplored(&[CITED]);
    for (arguments, expected) in [
        (&["run", "./toy", "--why"][..], "toy: looking for what has changed since it was run …"),
        (&["run", "./toy", "--fresh"], "draws: trials: 40 units …"),
        (&["judge", "./toy"], "toy: judging "),
        (&["render", "./toy"], "toy: drawing its figures and tables …"),
        (&["render", "./toy", "--check"], "toy: drawing its figures and tables …"),
        (&["check", "./toy", "--rerun", "3"], "toy/draws: running stored trials again …"),
        (&["explore", "./toy", "--plan"], "toy: counting the trials of its interpretations …"),
        (&["compare", "target/replan/toy", "target/replan/toy"], "reading and comparing stored runs …"),
        (&["export", "target/replan/toy", "--csv"], "reading its records and computing their statistics …"),
        (&["repro", "./toy", "--trial", "room/room/a-star"], "toy: running trial room/room/a-star …"),
    ] {
        let output = toy.0.run(arguments);
        assert_eq!(output.code, Some(0), "{arguments:?}: {}", output.err);
        assert!(output.doing.iter().any(|line| line.contains(expected)), "{arguments:?}: {:?}", output.doing);
        assert!(!output.out.contains('…'), "{}", output.out);
        assert!(!output.doing.concat().contains(['\r', '\x1b']), "{:?}", output.doing);
    }
}

#[test]
fn a_name_that_is_nearly_right_is_answered_with_the_right_one() {
    let bench = Bench::new();
    fs::create_dir(bench.at("experiments")).unwrap();
    fs::rename(bench.at("mini"), bench.at("experiments/mini")).unwrap();
    bench.done(&["repro", "mini"]);
    for (arguments, meant) in [
        (&["check", "minni"][..], "mini"),
        (&["show", "mimi"], "mini"),
        (&["compare", "minni", "mini"], "mini"),
        (&["export", "minni", "--csv"], "mini"),
        (&["repro", "mini", "--with", "corner=allow"], "corners"),
        (&["judge", "mini", "--with", "nodes=opend"], "opened"),
        (&["render", "mini", "--only", "fig2"], "fig1"),
        (&["repro", "mini", "--trial", "draw/drawn/0/a-star"], "draws"),
        (&["repro", "mini", "--trial", "draws/drawn/0/a-sta"], "drawn/0/a-star"),
        (&["compare", "mini", "mini", "--study", "drawn"], "draws"),
        (&["compare", "mini", "mini", "--metric", "opend"], "opened"),
        (&["compare", "mini", "mini", "--gate", "expansion +2%"], "expansions"),
        (&["compare", "mini", "--contenders", "A*", "Two-side"], "Two-sided"),
        (&["show", "mini", "nodse"], "nodes"),
        (&["list", "studies", "mini/drawn"], "mini/draws"),
        (&["list", "studies", "drawss"], "draws"),
    ] {
        let output = bench.run(arguments);
        assert_eq!(output.code, Some(2), "{arguments:?}: {}{}", output.out, output.err);
        assert!(output.err.contains(&format!(" (did you mean `{meant}`?)")), "{arguments:?}: {}", output.err);
    }
}

#[test]
fn one_trial_is_not_called_trials() {
    let bench = Bench::new();
    let output = bench.done(&["run", "./mini"]);
    assert!(output.contains("\nroom: 1 trial\n"), "{output}");
    let output = bench.done(&["check", "./mini", "--rerun", "1"]);
    assert!(output.contains("  room: 1 trial run again on 1 thread equals its row\n"), "{output}");
}

#[test]
fn devices_are_refused_as_input_files() {
    let bench = Bench::new();
    bench.edit("mini/room.toml", "room.map.txt", "/dev/zero");
    let output = bench.run(&["check", "./mini"]);
    let expected =
        "input file `/dev/zero` is a device, a pipe or a socket (/dev/zero); a regular file is accepted";
    assert!(output.code == Some(2) && output.err.contains(expected), "{}", output.err);
    std::os::unix::fs::symlink("/dev/zero", bench.at("mini/zero.toml")).unwrap();
    let output = bench.run(&["check", "./mini"]);
    let expected = "mini/zero.toml: it is a device, a pipe or a socket; a regular file is accepted";
    assert!(output.code == Some(2) && output.err.contains(expected), "{}", output.err);
}

#[test]
fn a_lattice_of_too_many_points_is_refused_with_the_step_found_and_the_limit() {
    let bench = Bench::empty();
    bench.done(&["new", "./arm", "--from", "arm"]);
    for (step, expected) in [
        (
            "1e-9",
            "step_cm is 1e-9, which makes 1.0e11 points along x_cm alone; at most 1000000 in all are accepted",
        ),
        ("1e-300", "step_cm is 1e-300, which makes 1.0e302 points along x_cm alone; at most 1000000 in all"),
        ("0.01", "step_cm is 0.01, which makes 10001 × 5001 points; at most 1000000 in all are accepted"),
    ] {
        let whole = fs::read(bench.at("arm/lengths.toml")).unwrap();
        bench.edit("arm/lengths.toml", "step_cm = 1\n", &format!("step_cm = {step}\n"));
        let output = bench.run(&["check", "./arm"]);
        assert!(output.code == Some(2) && output.err.contains(expected), "{step}: {}", output.err);
        bench.write("arm/lengths.toml", &whole);
    }
}

#[test]
fn every_kind_of_file_has_an_example_of_its_kind() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for kind in schema::files() {
        let file = kind.file.unwrap_or_else(|| panic!("{} has no example", kind.name));
        assert!(root.join(file).is_file(), "{}: {file}", kind.name);
        if Path::new(file).extension().is_some_and(|end| end == "toml") {
            let document = Document::open(&root.join(file)).unwrap();
            document.validate(&schema::schema(kind.name)).unwrap();
        }
        assert!(listed(&["list", "files", kind.name]).contains(&format!("\nExample\n  {file}\n")), "{file}");
    }
    let groups = listed(&["list", "files", "cell_groups"]);
    assert!(groups.contains("\n    [pose_deg]\n    A = [") && !groups.contains('#'), "{groups}");
}

#[test]
fn a_paper_by_itself_is_listed_with_its_studies_and_how_it_is_run() {
    let text = listed(&["list", "papers", "zhang"]);
    for part in
        ["\n  Y. Zhang, ", " claims, 6 studies\n", "\n  ensemble: How are ", "\n  replan repro zhang "]
    {
        assert!(text.contains(part), "{part}\n{text}");
    }
}

#[test]
fn a_study_by_itself_is_listed_with_its_problems_contenders_and_trials() {
    let text = listed(&["list", "studies", "movingai_sample/scenarios"]);
    for part in [
        "\n  paper: ",
        "\n  120 trials under the default",
        "\nProblems\n",
        "\nContenders\n",
        ": astar; 1 seed\n",
    ] {
        assert!(text.contains(part), "{part}\n{text}");
    }
}

/// What the program prints in the project's folder, of which no line is wider than 80 columns.
fn listed(arguments: &[&str]) -> String {
    let mut list = Command::new(env!("CARGO_BIN_EXE_replan"));
    let output = list.args(arguments).current_dir(env!("CARGO_MANIFEST_DIR")).output().unwrap();
    let output = String::from_utf8(output.stdout).unwrap();
    assert!(output.lines().all(|line| line.chars().count() <= 80), "{output}");
    output
}
