//! Runs cut into shards: the same bytes as one machine's, whatever happens to the parts on the way; and what is refused.

use crate::paper::{Bench, CONTENDERS_END};
use std::collections::BTreeMap;
use std::fs::{self, File};
use std::os::unix::fs::PermissionsExt as _;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::thread::sleep;
use std::time::Duration;

/// A bench with two groups of unlike cost, several interpretations and kept traces, and its whole run in `whole`.
fn bench() -> Bench {
    let bench = Bench::new();
    bench.edit("mini/draws.toml", "instances = 24", "instances = 50");
    bench.edit("mini/draws.toml", "[12, 12]", "[40, 40]");
    bench.edit("mini/draws.toml", "[11, 9]", "[39, 30]");
    let group = "[[problems]]\nlabel = \"small\"\nfamily = \"random_cells\"\ninstances = 20\nsettings = { size_cells = \
                 [6, 6], start = [0, 0], goal = [5, 5], blocked_share = 0.2, corner_rule = \"allow\" }\n\n[[contender]]";
    bench.edit("mini/draws.toml", "[[contender]]", group);
    bench.edit(
        "mini/draws.toml",
        CONTENDERS_END,
        &format!("{CONTENDERS_END}\n[[keep]]\nproblems = \"drawn\"\ninstances = 9\n"),
    );
    bench.done(&["run", "./mini", "--with", "all", "--out", "whole"]);
    bench
}

/// Runs the shards `numbers` of `of` into `parts`.
fn run(bench: &Bench, numbers: &[usize], of: usize, parts: &str) {
    for number in numbers {
        let shard = format!("{number}/{of}");
        bench.done(&["run", "./mini", "--with", "all", "--shard", &shard, "--out", parts, "--threads", "1"]);
    }
}

#[test]
fn shards_in_any_order_with_one_killed_halfway_give_the_bytes_of_one_machine() {
    let bench = bench();
    let whole = bench.facts("whole");
    assert_eq!(whole.len(), 6, "{:?}", whole.keys());
    for (order, merged) in [(&[1][..], "one"), (&[3, 1, 2], "three"), (&[4, 7, 2, 1, 6, 3, 5], "seven")] {
        let of = order.len();
        let parts = format!("parts-{merged}");
        if of == 7 {
            assert!(kill_at_work(&bench, "7/7", &parts, "7-of-7"), "no shard was caught at work");
        }
        run(&bench, order, of, &parts);
        let out = bench.done(&["merge", &parts, "--out", merged]);
        let of_parts = if of == 1 { "1 part".to_owned() } else { format!("{of} parts") };
        assert!(out.contains(&format!("draws: 280 trials of {of_parts}\n")), "{out}");
        assert!(bench.facts(merged) == whole, "{of} shards give other bytes than one machine");
    }
    let parts: Vec<usize> = (1..=7).map(|k| trials(&bench, &format!("parts-seven/{k}-of-7"))).collect();
    assert!(parts.iter().all(|rows| *rows > 10), "units are not spread: {parts:?}");
    // What is put together is a run as any: it is used again, and its clock is read on one machine.
    let again = bench.done(&["run", "./mini", "--with", "all", "--out", "seven"]);
    assert!(again.contains("draws: 280 trials (140 of 140 units reused)\n"), "{again}");
    assert!(bench.facts("seven") == whole);
    let times =
        |root: &str| fs::read(bench.at(&format!("{root}/data/runs/mini/draws.times.parquet"))).unwrap().len();
    assert!(times("seven") > times("three"), "no clock was read");
}

/// Starts a shard and kills it as soon as it has something in its journal; whether it was at work then.
fn kill_at_work(bench: &Bench, shard: &str, parts: &str, part: &str) -> bool {
    let journal = bench.at(&format!("{parts}/{part}/draws.journal"));
    let arguments = ["run", "./mini", "--with", "all", "--shard", shard, "--out", parts, "--threads", "1"];
    let mut child = bench.command(&arguments).spawn().unwrap();
    let mut is_at_work = false;
    while child.try_wait().unwrap().is_none() && !is_at_work {
        let lines = fs::read(&journal).unwrap_or_default().split(|byte| *byte == b'\n').count();
        is_at_work = lines > 3;
        sleep(Duration::from_micros(200));
    }
    if is_at_work {
        let status = bench.done(&["status", parts]);
        assert!(status.contains("0 of 7 shards are done, 1 running (7), 0 stopped, 6 waiting"), "{status}");
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let status = bench.done(&["status", parts]);
    assert!(status.contains("0 running, 1 stopped (7), 6 waiting"), "{status}");
    let go_on = format!("to go on: replan run ./mini --out {parts} --with all --shard 7/7");
    assert!(status.contains(&go_on), "{status}");
    is_at_work && journal.exists()
}

/// Trials in a part, by its exported rows.
fn trials(bench: &Bench, part: &str) -> usize {
    bench.done(&["export", part, "--csv", "--out", "csv"]);
    fs::read_to_string(bench.at("csv/draws.trials.csv")).unwrap().lines().count() - 1
}

#[test]
fn parts_that_are_missing_double_or_of_another_run_are_refused_by_name() {
    let bench = Bench::new();
    let shard = |number: usize, parts: &str, flags: &[&str]| {
        let shard = format!("{number}/3");
        bench.done(&[&["run", "./mini", "--shard", &shard, "--out", parts], flags].concat());
    };
    let merge = |complaint: &str| {
        let output = bench.run(&["merge", "parts", "--out", "merged"]);
        assert_eq!(output.code, Some(2), "{}", output.err);
        assert!(output.err.contains(complaint), "{complaint}\nis said: {}", output.err);
        assert!(!bench.at("merged").exists(), "{complaint}: something was written");
    };
    let copy = |from: &str, to: &str| {
        let _ = fs::remove_dir_all(bench.at(to));
        for (path, bytes) in bench.tree(from) {
            bench.write(&format!("{to}/{}", path.file_name().unwrap().to_string_lossy()), &bytes);
        }
    };
    merge("parts/plan.toml: no plan");
    shard(1, "parts", &[]);
    shard(3, "parts", &[]);
    merge("2-of-3: study `draws` is not done; 0 units are kept\n");
    merge("to run it: replan run ./mini --out parts --shard 2/3\n");
    for (flags, complaint) in [
        (&["--seed", "9"][..], "2-of-3: study `draws`: seed 9, not 7"),
        (&["--quick"], "2-of-3: study `draws`: quick true, not false"),
        (&["--with", "corners=forbid_any"], "2-of-3: study `draws`: ran under other interpretations"),
    ] {
        let _ = fs::remove_dir_all(bench.at("other"));
        shard(2, "other", flags);
        copy("other/2-of-3", "parts/2-of-3");
        merge("was cut by another plan");
        merge(complaint.split(": ").last().unwrap());
        let output = bench.run(&[&["run", "./mini", "--shard", "2/3", "--out", "parts"], flags].concat());
        assert_eq!(output.code, Some(2), "{}", output.err);
        assert!(
            output.err.contains("parts/plan.toml: the parts here are of another run: "),
            "{}",
            output.err
        );
    }
    copy("parts/1-of-3", "parts/2-of-3");
    merge("2-of-3: study `draws`: holds shard 1/3, not 2/3");
    fs::remove_dir_all(bench.at("parts/2-of-3")).unwrap();
    shard(2, "parts", &[]);
    copy("parts/1-of-3", "parts/4-of-8");
    merge("4-of-8: no part of this run, which has 3 shards");
    fs::remove_dir_all(bench.at("parts/4-of-8")).unwrap();
    let manifest = "parts/2-of-3/draws.manifest.toml";
    let sound = fs::read(bench.at(manifest)).unwrap();
    bench.edit(manifest, "replan = \"", "replan = \"9");
    merge("2-of-3: study `draws`: version 9");
    bench.write(manifest, &sound[..sound.len() / 2]);
    merge("parts/2-of-3/draws.manifest.toml:");
    bench.write(manifest, &sound);
    bench.edit("mini/draws.toml", "blocked_share = 0.3", "blocked_share = 0.2");
    merge("1-of-3: study `draws`: spec ");
    bench.edit("mini/draws.toml", "blocked_share = 0.2", "blocked_share = 0.3");
    bench.done(&["merge", "parts", "--out", "merged"]);
}

#[test]
fn half_written_parts_a_full_disk_and_a_second_merge_lose_nothing() {
    let bench = Bench::new();
    bench.edit(
        "mini/draws.toml",
        CONTENDERS_END,
        &format!("{CONTENDERS_END}\n[[keep]]\nproblems = \"drawn\"\ninstances = 24\n"),
    );
    for shard in ["1/2", "2/2"] {
        bench.done(&["run", "./mini", "--shard", shard, "--out", "parts"]);
    }
    bench.done(&["merge", "parts", "--out", "merged"]);
    let before = bench.tree("merged");
    let trials = "parts/2-of-2/draws.trials.parquet";
    let whole = fs::read(bench.at(trials)).unwrap();
    for bytes in [&whole[..whole.len() / 2], b""] {
        bench.write(trials, bytes);
        let output = bench.run(&["merge", "parts", "--out", "merged"]);
        assert_eq!(output.code, Some(2), "{}", output.err);
        assert!(
            output.err.contains(&format!("{trials}: is not the file that the manifest names")),
            "{}",
            output.err
        );
    }
    bench.write(trials, &whole);
    let lock = File::open(bench.at("merged/data/runs/mini/.lock")).unwrap();
    lock.lock().unwrap();
    let output = bench.run(&["merge", "parts", "--out", "merged"]);
    assert_eq!(output.code, Some(1), "{}", output.err);
    assert!(output.err.contains("merged/data/runs/mini: another run is writing here"), "{}", output.err);
    drop(lock);
    assert!(bench.tree("merged") == before, "a refused merge changed something");
    full_disk(&bench);
    assert!(bench.facts("merged").len() == 6 && bench.tree("parts").len() > 10);
}

/// Merges onto a disk that is too small, where the system lets one be made.
fn full_disk(bench: &Bench) {
    fs::create_dir(bench.at("small")).unwrap();
    let place = bench.at("small").display().to_string();
    let mount = Command::new("mount").args(["-t", "tmpfs", "-o", "size=16k", "tmpfs", &place]).status();
    if !mount.is_ok_and(|status| status.success()) {
        eprintln!("no tmpfs can be mounted here: a full disk is not tried");
        return;
    }
    let output = bench.run(&["merge", "parts", "--out", "small/merged"]);
    let left = bench.tree("small");
    let grown = Command::new("mount").args(["-o", "remount,size=4m", &place]).status();
    let again = bench.run(&["merge", "parts", "--out", "small/merged"]);
    let facts = bench.facts("small");
    assert!(Command::new("umount").arg(&place).status().unwrap().success());
    assert_eq!(output.code, Some(1), "{}", output.err);
    assert!(output.err.contains(".parquet: writing the file: No space left on device"), "{}", output.err);
    // What the claims meant is written first, so that no merge that ends midway hides a change.
    let history = |file: &PathBuf| file.ends_with("history.toml");
    assert!(left.keys().all(history), "left behind: {:?}", left.keys());
    assert!(grown.unwrap().success() && again.code == Some(0), "{}", again.err);
    assert!(facts == bench.facts("merged"));
}

/// A folder of programs that stand in for a scheduler.
pub fn stub(bench: &Bench, name: &str, text: &str) {
    let path = format!("bin/{name}");
    bench.write(&path, text.as_bytes());
    fs::set_permissions(bench.at(&path), fs::Permissions::from_mode(0o755)).unwrap();
}

pub const SBATCH: &str = r#"#!/usr/bin/env bash
# Runs a job at once, task after task, as Slurm would.
set -euo pipefail
echo "sbatch $*" >> sbatch.log
for word in "$@"; do
  case $word in
    --wrap=*) bash -c "${word#--wrap=}" >&2; echo '18;cluster'; exit ;;
    --*) ;;
    *) script=$word ;;
  esac
done
last=$(sed -n 's/^#SBATCH --array=1-//p' "$script")
for ((task = 1; task <= last; task++)); do
  SLURM_ARRAY_TASK_ID=$task bash "$script" >&2
done
echo '17;cluster'
"#;

pub const PARALLEL: &str = r#"#!/usr/bin/env bash
# Runs a command for each line of its input, one after another.
set -euo pipefail
while [[ $1 == --* ]]; do shift 2; done
while read -r item; do
  words=()
  for word in "$@"; do words+=("${word//\{\}/$item}"); done
  "${words[@]}" < /dev/null
done
"#;

#[test]
fn scripts_of_slurm_and_parallel_run_every_shard() {
    let bench = Bench::new();
    bench.done(&["run", "./mini", "--quick", "--out", "whole"]);
    stub(&bench, "sbatch", SBATCH);
    stub(&bench, "parallel", PARALLEL);
    for (engine, script) in [("slurm", "run_slurm.sh"), ("parallel", "run_parallel.sh")] {
        let parts = format!("the parts' of {engine}");
        let merged = format!("merged {engine}");
        let arguments =
            ["--engine", engine, "--shards", "5", "--tasks", "2", "--out", &parts, "--merge", &merged];
        let out = bench.done(&[&["shard", "./mini", "--quick"], &arguments[..]].concat());
        assert!(out.starts_with("4 units in 5 shards\n"), "{out}");
        let path = bench.at(&parts).join(script);
        checked(&path);
        let search = format!("{}:{}", bench.at("bin").display(), std::env::var("PATH").unwrap());
        let done =
            Command::new("bash").arg(&path).env("PATH", search).current_dir(bench.at("")).output().unwrap();
        assert!(done.status.success(), "{engine}: {}", String::from_utf8_lossy(&done.stderr));
        assert!(bench.facts(&merged) == bench.facts("whole"), "{engine}: other bytes than one machine's");
    }
    let log = fs::read_to_string(bench.at("sbatch.log")).unwrap();
    assert!(log.contains("--dependency=afterok:17 "), "{log}");
}

/// Asks shellcheck, where there is one.
pub fn checked(script: &Path) {
    let own = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/replan/cluster/venv/bin/shellcheck");
    let program = if own.is_file() { own } else { PathBuf::from("shellcheck") };
    match Command::new(program).arg(script).output() {
        Ok(output) => assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stdout)),
        Err(_) => eprintln!("there is no shellcheck here: {} is not checked by it", script.display()),
    }
}

const DYING: &str = r#"#!/usr/bin/env bash
# replan, but for the first try of shard 2, which is killed at work.
if [[ " $* " == *" 2/4 "* && ! -e killed ]]; then
  touch killed
  "$REAL" "$@" &
  for ((turn = 0; turn < 2000; turn++)); do
    if [[ $(wc -l < parts/2-of-4/draws.journal 2> /dev/null) -gt 2 ]]; then break; fi
    sleep 0.002
  done
  cp parts/2-of-4/draws.journal journal.seen
  kill -9 $!
  exit 137
fi
exec "$REAL" "$@"
"#;

/// Runs the program that `replan shard --engine hyperqueue` wrote into `parts`, with the stub `bin/replan` for replan, and gives
/// what it says; none where there is no environment with `hyperqueue`.
pub fn run_hyperqueue(bench: &Bench, parts: &str) -> Option<String> {
    let python = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/replan/cluster/venv/bin/python");
    if !python.is_file() {
        eprintln!("there is no {}, which .ci/run makes: HyperQueue is not tried", python.display());
        return None;
    }
    let mut command = Command::new(&python);
    command.arg(bench.at(&format!("{parts}/run_hyperqueue.py"))).current_dir(bench.at(""));
    command.env("REPLAN", bench.at("bin/replan")).env("REAL", env!("CARGO_BIN_EXE_replan"));
    let done = command.output().unwrap();
    let text = format!("{}{}", String::from_utf8_lossy(&done.stdout), String::from_utf8_lossy(&done.stderr));
    assert!(done.status.success(), "{text}");
    Some(text)
}

#[test]
fn hyperqueue_runs_every_shard_again_where_its_process_was_killed() {
    let bench = bench();
    stub(&bench, "replan", DYING);
    let arguments = ["--engine", "hyperqueue", "--shards", "4", "--out", "parts", "--merge", "merged"];
    bench.done(&[&["shard", "./mini", "--with", "all"], &arguments[..]].concat());
    let Some(message) = run_hyperqueue(&bench, "parts") else { return };
    assert!(message.contains("4 of 4 shards to run, try 1 of 3\n"), "{message}");
    assert!(
        message.contains("shard 2 failed; see ") && message.contains("1 of 4 shards to run, try 2 of 3\n"),
        "{message}"
    );
    assert!(
        fs::read(bench.at("journal.seen")).unwrap().len() > 100,
        "the shard was killed before it was at work"
    );
    assert!(bench.facts("merged") == bench.facts("whole"), "other bytes than one machine's");
    let again = run_hyperqueue(&bench, "parts").unwrap();
    assert!(!again.contains("shards to run"), "what is done ran again");
    let logs: BTreeMap<_, _> = bench.tree("parts/logs");
    assert_eq!(logs.len(), 8, "{:?}", logs.keys());
}

#[test]
fn shards_that_do_not_exist_are_refused() {
    let bench = Bench::new();
    for (arguments, complaint) in [
        (&["run", "./mini", "--shard", "4/3", "--out", "p"][..], "`4/3` is no shard; K/N with 1 ≤ K ≤ N"),
        (&["run", "./mini", "--shard", "1/3"], "--out <DIR>"),
        (&["merge", "p", "--out", "m"], "p/plan.toml: no plan"),
        (&["status", "p"], "p/plan.toml: no plan"),
        (&["shard", "./mini", "--engine", "slurm", "--out", "p"], "--merge <DIR>"),
        (
            &["shard", "./mini", "--engine", "lsf", "--out", "p", "--merge", "m"],
            "possible values: hyperqueue, slurm",
        ),
    ] {
        let output = bench.run(arguments);
        assert_eq!(output.code, Some(2), "{arguments:?}: {}", output.err);
        assert!(output.err.contains(complaint), "{arguments:?} is answered: {}", output.err);
    }
    bench.write("p/plan.toml", b"paper = 3\n");
    assert!(bench.run(&["status", "p"]).err.contains("p/plan.toml:1:9: "));
}
