//! Text as a reader sees it: the verdict table, LaTeX, a failing check.

use crate::paper::Bench;
use std::fs;

#[test]
fn a_run_prints_and_writes_what_is_seen_here() {
    let bench = Bench::new();
    let printed = bench.done(&["repro", "./mini"]);
    insta::assert_snapshot!("verdicts", printed);
    let read = |name: &str| fs::read_to_string(bench.at("target/replan/mini").join(name)).unwrap();
    insta::assert_snapshot!("table1", read("plots/mini/table1.tex"));
    insta::assert_snapshot!("numbers", read("plots/mini/numbers.tex"));
}

#[test]
fn a_wrong_spec_is_answered_as_seen_here() {
    let bench = Bench::new();
    bench.edit("mini/draws.toml", "meeting = \"generated_any\"", "meeting = \"generated\"");
    insta::assert_snapshot!("wrong_spec", bench.run(&["check", "./mini"]).err);
}
