//! Explorations and confirmations cut into shards: what they find is what one machine finds, to the byte; and what is refused.

use crate::across::{CITED, RUNS, Toy};
use crate::cli_shards::{PARALLEL, SBATCH, checked, run_hyperqueue, stub};
use crate::exploring::{MET, MORE};
use std::collections::BTreeMap;
use std::fs;
use std::process::Command;

/// The study of the room runs where interpretations are compatible alone, so that an exploration has all of its rounds.
const LATE: (&str, &str) = ("trials = 100_000", "trials = 100_000\nwhere_compatible = [\"room\"]");
const EDITS: [(&str, &str); 4] = [CITED, MORE, MET, LATE];
/// What is found, and what claims are by it.
const FOUND: [&str; 2] = ["estimates.parquet", "verdicts.toml"];

/// What is stored of `FOUND`.
fn found(toy: &Toy) -> BTreeMap<&'static str, Vec<u8>> {
    FOUND.into_iter().filter_map(|name| Some((name, fs::read(toy.0.at(RUNS).join(name)).ok()?))).collect()
}

/// What one machine finds.
fn calm() -> BTreeMap<&'static str, Vec<u8>> {
    let toy = Toy::unexplored(&EDITS);
    toy.0.done(&["explore", "./toy"]);
    toy.0.done(&["confirm", "./toy"]);
    found(&toy)
}

/// Runs one shard of the round that is at work.
fn shard(toy: &Toy, command: &str, number: usize, of: usize, parts: &str) {
    let shard = format!("{number}/{of}");
    toy.0.done(&[command, "./toy", "--shard", &shard, "--out", parts, "--threads", "1"]);
}

/// Runs and merges round after round, shards in the order of `numbers`, until something is found; the rounds that were planned.
fn rounds(toy: &Toy, command: &str, numbers: &[usize], parts: &str) -> Vec<String> {
    let mut planned = Vec::new();
    loop {
        for number in numbers {
            shard(toy, command, *number, numbers.len(), parts);
        }
        let output = toy.0.done(&["merge", parts]);
        if output.contains("what was found is in ") {
            return planned;
        }
        let name = output.split("\nround `").nth(1).unwrap_or_else(|| panic!("{output}"));
        planned.push(name.split('`').next().unwrap().to_owned());
        let status = toy.0.done(&["status", parts]);
        let none = format!("round `{}`: 0 of {} shards are done", planned[planned.len() - 1], numbers.len());
        assert!(status.starts_with(&none), "{status}");
    }
}

#[test]
fn explorations_and_confirmations_in_shards_find_what_one_machine_finds() {
    let calm = calm();
    let toy = Toy::unexplored(&EDITS);
    assert_eq!(calm.len(), 2);
    for numbers in [&[1][..], &[2, 1], &[3, 1, 2]] {
        let parts = |command: &str| format!("{command}-{}", numbers.len());
        assert_eq!(rounds(&toy, "explore", numbers, &parts("explore")), ["compatible", "round-2"]);
        assert_eq!(rounds(&toy, "confirm", numbers, &parts("confirm")), ["turned"]);
        assert!(found(&toy) == calm, "{} shards find something else than one machine", numbers.len());
        assert!(!toy.0.at("target/replan/explore").exists(), "trials ran outside of the parts");
        // Merged once more, all is as it was.
        let status = toy.0.done(&["status", &parts("explore")]);
        assert!(
            status.ends_with(&format!("put together by: replan merge {}\n", parts("explore"))),
            "{status}"
        );
        toy.0.done(&["merge", &parts("explore")]);
        toy.0.done(&["merge", &parts("confirm")]);
        assert!(found(&toy) == calm, "a second merge finds something else");
        for name in FOUND {
            fs::remove_file(toy.0.at(RUNS).join(name)).unwrap();
        }
    }
}

#[test]
fn parts_of_a_round_that_are_missing_double_or_of_another_exploration_are_refused_by_name() {
    let toy = Toy::unexplored(&EDITS);
    let merge = |complaint: &str| {
        let output = toy.0.run(&["merge", "parts"]);
        assert_eq!(output.code, Some(2), "{}", output.err);
        assert!(output.err.contains(complaint), "{complaint}\nis said: {}", output.err);
        assert!(found(&toy).is_empty(), "{complaint}: something was written");
    };
    let copy = |from: &str| {
        let to = "parts/round-1/2-of-3";
        let _ = fs::remove_dir_all(toy.0.at(to));
        for (path, bytes) in toy.0.tree(from) {
            toy.0.write(&format!("{to}/{}", path.file_name().unwrap().to_string_lossy()), &bytes);
        }
    };
    for number in [1, 3] {
        shard(&toy, "explore", number, 3, "parts");
    }
    merge(
        "parts/round-1: the parts cannot be put together:\n  2-of-3: study `draws` is not done; 0 units are kept\n",
    );
    merge("to run it: replan explore ./toy --out parts --shard 2/3\n");
    copy("parts/round-1/1-of-3");
    merge("2-of-3: study `draws`: holds shard 1/3, not 2/3");
    toy.0.edit("toy/draws.toml", "seed = 7", "seed = 9");
    shard(&toy, "explore", 2, 3, "other");
    toy.0.edit("toy/draws.toml", "seed = 9", "seed = 7");
    copy("other/round-1/2-of-3");
    merge("2-of-3: study `draws`: seed 9, not 7");
    fs::remove_dir_all(toy.0.at("parts/round-1/2-of-3")).unwrap();
    shard(&toy, "explore", 2, 3, "parts");
    let manifest = "parts/round-1/2-of-3/draws.manifest.toml";
    let sound = fs::read(toy.0.at(manifest)).unwrap();
    toy.0.edit(manifest, "replan = \"", "replan = \"9");
    merge("2-of-3: study `draws`: version 9");
    toy.0.write(manifest, &sound);
    for (command, of) in [("confirm", "3"), ("run", "3"), ("explore", "2")] {
        let output = toy.0.run(&[command, "./toy", "--shard", &format!("1/{of}"), "--out", "parts"]);
        assert_eq!(output.code, Some(2), "{}", output.err);
        assert!(
            output.err.contains("parts/round-1/plan.toml: the parts here are of another "),
            "{}",
            output.err
        );
    }
    toy.0.done(&["merge", "parts"]);
    // A round runs under the interpretations that come out of the one before it, and under no others.
    toy.0.edit(
        "parts/compatible/plan.toml",
        "[[round.interpretations]]",
        "[[round.interpretations]]\nhurry = \"none\"\n[[round.interpretations]]",
    );
    let output = toy.0.run(&["merge", "parts"]);
    assert_eq!(output.code, Some(2), "{}", output.err);
    assert!(
        output.err.contains(
            "parts/compatible/plan.toml: the parts here are of another run: command `explore`, round"
        ),
        "{}",
        output.err
    );
}

#[test]
fn scripts_run_and_merge_round_after_round() {
    let calm = calm();
    let toy = Toy::unexplored(&EDITS);
    stub(&toy.0, "sbatch", SBATCH);
    stub(&toy.0, "parallel", PARALLEL);
    for (command, engine) in [("explore", "slurm"), ("confirm", "parallel")] {
        let arguments = ["--engine", engine, "--shards", "3", "--tasks", "2", "--out", command];
        toy.0.done(&[&["shard", "./toy", &format!("--{command}")], &arguments[..]].concat());
        let path = toy.0.at(&format!("{command}/run_{engine}.sh"));
        checked(&path);
        let search = format!("{}:{}", toy.0.at("bin").display(), std::env::var("PATH").unwrap());
        let done =
            Command::new("bash").arg(&path).env("PATH", search).current_dir(toy.0.at("")).output().unwrap();
        assert!(done.status.success(), "{engine}: {}", String::from_utf8_lossy(&done.stderr));
    }
    assert!(found(&toy) == calm, "scripts find something else than one machine");
}

const DYING: &str = r#"#!/usr/bin/env bash
# replan, but for the first try of shard 2 in every round, whose process is killed.
for word in "$@"; do
  mark="killed.$1.$(ls -d explore/*/ confirm/*/ 2> /dev/null | wc -l)"
  if [[ $word == 2/2 && ! -e $mark ]]; then
    touch "$mark"
    "$REAL" "$@" &
    kill -9 $!
    exit 137
  fi
done
exec "$REAL" "$@"
"#;

#[test]
fn hyperqueue_runs_round_after_round_and_again_what_was_killed() {
    let calm = calm();
    let toy = Toy::unexplored(&EDITS);
    stub(&toy.0, "replan", DYING);
    for (command, rounds) in [("explore", 3), ("confirm", 2)] {
        let arguments = ["--engine", "hyperqueue", "--shards", "2", "--out", command];
        toy.0.done(&[&["shard", "./toy", &format!("--{command}")], &arguments[..]].concat());
        let Some(message) = run_hyperqueue(&toy.0, command) else { return };
        let count = |what: &str| message.matches(what).count();
        assert_eq!(count("2 of 2 shards to run, try 1 of 3\n"), rounds, "{message}");
        assert_eq!(count("1 of 2 shards to run, try 2 of 3\n"), rounds, "{message}");
        assert_eq!(count("shard 2 failed; see "), rounds, "{message}");
    }
    assert!(found(&toy) == calm, "HyperQueue finds something else than one machine");
}
