//! A paper from elsewhere starts no program before people trust it.

use super::{CASES, bench};
use crate::paper::Bench;
use std::fs;

/// Every command that runs trials.
const RUNS: [&[&str]; 8] = [
    &["run", "./outside"],
    &["run", "./outside", "--clock"],
    &["run", "./outside", "--shard", "1/2", "--out", "parts"],
    &["repro", "./outside"],
    &["repro", "./outside", "--trial", "study/wall/good"],
    &["explore", "./outside"],
    &["confirm", "./outside"],
    &["shard", "./outside", "--engine", "parallel", "--shards", "2", "--out", "parts", "--merge", "merged"],
];

fn good() -> Bench {
    let good = CASES.iter().find(|case| case.name == "good").unwrap();
    let bench = bench(&[good]);
    let script = fs::read_to_string(bench.at("outside/good.sh")).unwrap();
    bench.write("outside/good.sh", format!("touch started\n{script}").as_bytes());
    bench
}

fn is_refused(bench: &Bench, command: &[&str]) {
    let output = bench.run(command);
    assert_eq!(output.code, Some(2), "{command:?}: {}{}", output.out, output.err);
    assert!(
        output.err.contains("starts programs with your rights:\n  sh outside/good.sh\n"),
        "{}",
        output.err
    );
    assert!(output.err.contains("`--trust` accepts them until they change"), "{}", output.err);
    assert!(!bench.at("started").exists(), "{command:?} started the program");
}

#[test]
fn no_command_starts_a_program_of_a_paper_from_elsewhere_without_trust() {
    let bench = good();
    for command in RUNS {
        is_refused(&bench, command);
    }
    bench.done(&["check", "./outside"]);
    assert!(!bench.at("started").exists());
}

#[test]
fn trust_is_remembered_until_a_program_changes_and_for_one_folder_alone() {
    let bench = good();
    bench.done(&["run", "./outside", "--trust"]);
    assert!(bench.at("started").exists());
    let again = |bench: &Bench| fs::remove_file(bench.at("started")).unwrap();
    again(&bench);
    bench.done(&["run", "./outside", "--record"]);
    assert!(bench.at("started").exists(), "it was not remembered");
    again(&bench);
    bench.edit("outside/study.toml", "Who misbehaves?", "Who else misbehaves?");
    bench.done(&["run", "./outside"]);
    bench.edit("outside/good.sh", "touch started", "touch started started");
    is_refused(&bench, &["run", "./outside", "--record"]);
    bench.done(&["run", "./outside", "--record", "--trust"]);
    again(&bench);
    bench.edit("outside/study.toml", "time_s = 60.0", "time_s = 61.0");
    is_refused(&bench, &["run", "./outside"]);
    bench.edit("outside/study.toml", "time_s = 61.0", "time_s = 60.0");
    fs::create_dir(bench.at("other")).unwrap();
    fs::rename(bench.at("outside"), bench.at("other/outside")).unwrap();
    bench.write("outside/good.sh", &fs::read(bench.at("other/outside/good.sh")).unwrap());
    is_refused(&bench, &["run", "./other/outside"]);
}
