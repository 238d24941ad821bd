//! Commands that replan stores and shows can be pasted into a shell, whatever stands in names of folders.

use crate::paper::Bench;
use std::fs;
use std::path::Path;
use std::process::Command;

/// A folder whose name a shell would take apart.
const ODD: &str = "it's \"my\" $HOME & `parts` #1";

/// Runs `line` in a shell in the bench's folder, where `replan` is this program; what it printed.
fn pasted(bench: &Bench, line: &str) -> String {
    let program = Path::new(env!("CARGO_BIN_EXE_replan")).parent().unwrap();
    let path = format!("{}:{}", program.display(), std::env::var("PATH").unwrap());
    let mut shell = Command::new("sh");
    shell.args(["-c", line]).current_dir(bench.at(".")).env("PATH", path);
    let done = bench.output(&shell.env("XDG_STATE_HOME", bench.at("state")).output().unwrap());
    assert_eq!(done.code, Some(0), "{line}\n{}{}", done.out, done.err);
    done.out
}

#[test]
fn the_command_in_a_manifest_makes_the_same_records_again() {
    let bench = Bench::new();
    bench.done(&["run", "./mini", "--out", ODD]);
    let facts = bench.facts(ODD);
    let manifest = fs::read_to_string(bench.at(ODD).join("data/runs/mini/draws.manifest.toml")).unwrap();
    let table: toml::Table = manifest.parse().unwrap();
    let command = table["command"].as_str().unwrap().to_owned();
    fs::remove_dir_all(bench.at(ODD)).unwrap();
    pasted(&bench, &command);
    assert!(!facts.is_empty() && bench.facts(ODD) == facts, "{command}");
}

#[test]
fn the_command_that_a_merge_lacks_runs_the_missing_part() {
    let bench = Bench::new();
    bench.done(&["run", "./mini", "--shard", "1/2", "--out", ODD]);
    let refused = bench.run(&["merge", ODD, "--out", "merged"]).err;
    let (_, command) = refused.split_once("to run it: ").unwrap_or_else(|| panic!("{refused}"));
    pasted(&bench, command.lines().next().unwrap());
    let status = bench.done(&["status", ODD]);
    let (_, merge) = status.split_once("put together by: ").unwrap_or_else(|| panic!("{status}"));
    pasted(&bench, &merge.trim().replace("DIR", "merged"));
    assert!(!bench.facts("merged").is_empty());
}
