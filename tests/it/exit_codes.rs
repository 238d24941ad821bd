//! What is stored and stale has one exit code under every check, and another where it is needed as input.

use crate::across::{CITED, RUNS, Toy};
use crate::paper::Bench;
use std::fs;

const STORED: &str = "target/replan/mini/data/runs/mini";
const REPORT: &str = "target/replan/mini/paper_repro.md";

/// The paper, run, judged and drawn.
fn reproduced() -> Bench {
    let bench = Bench::new();
    bench.done(&["repro", "./mini"]);
    bench
}

/// The command must end with the exit code; what it said.
fn ends(bench: &Bench, arguments: &[&str], code: i32) -> String {
    let output = bench.run(arguments);
    assert_eq!(output.code, Some(code), "{arguments:?}: {}{}", output.out, output.err);
    output.err
}

#[test]
fn a_spec_that_has_changed_has_one_exit_code_under_every_check() {
    let bench = reproduced();
    bench.edit("mini/draws.toml", "seed = 7", "seed = 9");
    for check in [
        &["judge", "./mini", "--check"][..],
        &["render", "./mini", "--check"],
        &["check", "./mini", "--rerun", "4"],
    ] {
        ends(&bench, check, 3);
    }
    let why = "the stored run was made by another spec; `replan run` runs study `draws` again";
    for command in ["judge", "render"] {
        assert!(ends(&bench, &[command, "./mini"], 2).contains(why), "{command}");
    }
}

#[test]
fn a_report_that_was_edited_has_one_exit_code_however_it_was_edited() {
    let begin = "<!-- replan begin mini -->";
    let bench = reproduced();
    let whole = fs::read(bench.at(REPORT)).unwrap();
    let twice = format!("{begin}\n{begin}");
    let edits =
        [(begin, twice.as_str()), ("<!-- replan end mini -->", ""), ("A tiny paper", "A large paper")];
    for (from, to) in edits {
        bench.edit(REPORT, from, to);
        ends(&bench, &["render", "./mini", "--check"], 3);
        bench.write(REPORT, &whole);
    }
    bench.write(REPORT, &[&whole[..], b"\xff"].concat());
    ends(&bench, &["render", "./mini", "--check"], 3);
    let text = ends(&bench, &["render", "./mini"], 2);
    assert!(text.contains("is not UTF-8; mend it, move it away"), "{text}");
}

#[test]
fn verdicts_of_other_readings_are_stale_under_a_check() {
    let bench = Bench::new();
    bench.done(&["repro", "./mini", "--with", "nodes=closed", "--out", "other"]);
    bench.edit("mini/paper.toml", "closed = { metric", "shut = { metric");
    let text = ends(&bench, &["render", "./mini", "--out", "other", "--check"], 3);
    assert!(
        text.contains("the stored verdicts are of other interpretations (choice `nodes` has no option"),
        "{text}"
    );
    ends(&bench, &["render", "./mini", "--out", "other"], 2);
}

#[test]
fn an_exploration_that_was_edited_is_found_by_a_check_and_wrong_input_of_a_command() {
    let bench = reproduced();
    bench.write(&format!("{STORED}/estimates.parquet"), b"by hand");
    let why = "estimates.parquet: is not what replan wrote";
    assert!(ends(&bench, &["judge", "./mini", "--check"], 3).contains(why));
    assert!(ends(&bench, &["judge", "./mini"], 2).contains(why));
}

#[test]
fn what_was_never_stored_is_wrong_input_of_a_check() {
    let bench = Bench::new();
    for check in ["judge", "render"] {
        ends(&bench, &[check, "./mini", "--check"], 2);
    }
}

#[test]
fn an_exploration_that_is_gone_is_named_with_the_command_that_makes_it() {
    let toy = Toy::new(&[CITED]);
    toy.0.done(&["confirm", "./toy"]);
    toy.0.done(&["judge", "./toy", "--check"]);
    let path = format!("{RUNS}/estimates.parquet");
    fs::remove_file(toy.0.at(&path)).unwrap();
    for command in ["explore", "confirm"] {
        let output = ends(&toy.0, &["judge", "./toy", "--check"], 3);
        let expected = format!(
            "replan: {path}: what `{command}` found is gone, and the stored verdicts rest on it; `replan {command} toy` makes it again\n"
        );
        assert_eq!(output, expected);
        // The verdicts that `explore` judges rest on it alone.
        let verdicts = toy.0.at(RUNS).join("verdicts.toml");
        let before = fs::read(&verdicts).unwrap();
        toy.0.done(&[command, "./toy"]);
        fs::write(verdicts, before).unwrap();
    }
    toy.0.done(&["judge", "./toy", "--check"]);
}

#[test]
fn output_that_a_full_disk_loses_is_the_systems_refusal() {
    let bench = Bench::new();
    let full = fs::File::create("/dev/full").unwrap();
    let ended = bench.command(&["check", "./mini"]).stdout(full).output().unwrap();
    assert_eq!(ended.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&ended.stderr).contains("replan: standard output: "));
}
