//! A paper from elsewhere starts no program before people trust it; those of this repository need no trust.

use super::{CASES, bench};
use crate::paper::Bench;
use std::fs;
use std::path::Path;

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

#[test]
fn a_paper_of_this_repository_needs_no_trust_and_its_copy_elsewhere_does() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let bench = Bench::empty();
    let own = root.join("experiments/baselines");
    for file in fs::read_dir(&own).unwrap().map(Result::unwrap) {
        bench.write(&format!("baselines/{}", file.file_name().display()), &fs::read(file.path()).unwrap());
    }
    let run = |paper: &Path| {
        let trial = "grids/cells/0/networkx-a-star";
        let mut command = bench.command(&["repro", paper.to_str().unwrap(), "--trial", trial]);
        bench.output(&command.current_dir(root).output().unwrap())
    };
    let copy = run(&bench.at("baselines"));
    assert_eq!(copy.code, Some(2), "{}{}", copy.out, copy.err);
    assert!(copy.err.contains("the paper is from elsewhere and starts programs"), "{}", copy.err);
    assert!(copy.err.contains("python planners/python/examples/networkx_grid.py\n"), "{}", copy.err);
    assert_eq!(copy.out, "", "the trial was run");
    // Its library may be missing here: then the row says so.
    let own = run(&own);
    assert_ne!(own.code, Some(2), "{}", own.err);
    assert!(!own.err.contains("trust"), "{}", own.err);
    assert!(own.out.contains("contender              networkx A*\n"), "{}{}", own.out, own.err);
    assert!(!bench.at("state").exists(), "something was remembered as trusted");
}
