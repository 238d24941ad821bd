//! Runs that are stopped: by Ctrl-C or killed anywhere, the same command goes on and ends with equal bytes.

use crate::paper::{Bench, CONTENDERS_END};
use base::seed;
use rand::RngExt as _;
use std::fs;
use std::process::{Child, Command};
use std::thread::sleep;
use std::time::Duration;

const JOURNAL: &str = "target/replan/mini/data/runs/mini/draws.journal";

/// A bench whose study takes a moment: enough units that a run can be caught at work.
fn slow() -> Bench {
    let bench = Bench::new();
    bench.edit("mini/draws.toml", "instances = 24", "instances = 300");
    bench.edit("mini/draws.toml", "[12, 12]", "[60, 60]");
    bench.edit("mini/draws.toml", "[11, 9]", "[59, 50]");
    bench.edit(
        "mini/draws.toml",
        CONTENDERS_END,
        &format!("{CONTENDERS_END}\n[[keep]]\nproblems = \"drawn\"\ninstances = 40\n"),
    );
    bench
}

fn start(bench: &Bench, threads: &str) -> Child {
    bench.command(&["run", "./mini", "--threads", threads]).spawn().unwrap()
}

fn journal_bytes(bench: &Bench) -> u64 {
    fs::metadata(bench.at(JOURNAL)).map_or(0, |file| file.len())
}

/// Waits until the journal holds `bytes` or the run is over; whether the run is still at work then.
fn await_journal(bench: &Bench, run: &mut Child, bytes: u64) -> bool {
    while run.try_wait().unwrap().is_none() {
        if journal_bytes(bench) >= bytes {
            return true;
        }
        sleep(Duration::from_micros(200));
    }
    false
}

/// Waits until the first record is being written or the run is over; whether the run is still at work then.
fn await_records(bench: &Bench, run: &mut Child) -> bool {
    let is_record =
        |entry: fs::DirEntry| entry.file_name().to_string_lossy().contains("draws.trials.parquet");
    while run.try_wait().unwrap().is_none() {
        let runs = fs::read_dir(bench.at("target/replan/mini/data/runs/mini"));
        if runs.into_iter().flatten().flatten().any(is_record) {
            return true;
        }
        sleep(Duration::from_micros(100));
    }
    false
}

/// The records of an undisturbed run.
fn undisturbed(bench: &Bench) -> std::collections::BTreeMap<String, Vec<u8>> {
    bench.done(&["run", "./mini", "--out", "calm"]);
    bench.facts("calm")
}

/// Units in a journal: its lines but for the first.
fn units(bench: &Bench) -> usize {
    fs::read(bench.at(JOURNAL)).map_or(0, |bytes| bytes.split(|byte| *byte == b'\n').count().max(2) - 2)
}

#[test]
fn a_run_killed_at_20_random_points_ends_with_the_bytes_of_an_undisturbed_one() {
    let bench = slow();
    let calm = undisturbed(&bench);
    let whole_bytes = 400_000;
    let mut midway = 0;
    let mut writing = 0;
    for round in 0..4_u64 {
        let mut stream = seed::stream(seed::derive(20, &["kill", &round.to_string()]));
        for kill in 0..5 {
            let mut run = start(&bench, ["1", "2"][(round % 2) as usize]);
            let from = journal_bytes(&bench);
            let until = from + stream.random_range(0..whole_bytes / 3);
            let at_work = if kill == 4 {
                await_records(&bench, &mut run)
            } else {
                await_journal(&bench, &mut run, until)
            };
            run.kill().unwrap();
            run.wait().unwrap();
            let kept = units(&bench);
            midway += usize::from(at_work && (1..300).contains(&kept));
            writing += usize::from(at_work && kill == 4);
            assert!(kept <= 300, "round {round}, kill {kill}: {kept} units");
        }
        let out = bench.done(&["run", "./mini"]);
        assert!(
            bench.facts("target/replan/mini") == calm,
            "round {round}: other bytes than the undisturbed run's\n{out}"
        );
        let left: Vec<_> = bench
            .tree("target/replan/mini")
            .into_keys()
            .filter(|p| !p.extension().is_some_and(|e| ["parquet", "toml"].iter().any(|known| e == *known)))
            .collect();
        assert!(left.is_empty(), "round {round}: left behind {left:?}");
        fs::remove_dir_all(bench.at("target/replan/mini")).unwrap();
    }
    assert!(midway >= 8, "only {midway} of 16 kills hit trials at work");
    assert!(writing >= 1, "no kill hit records being written");
}

#[test]
fn ctrl_c_finishes_the_units_at_work_says_what_it_kept_and_the_run_goes_on() {
    let bench = slow();
    let calm = undisturbed(&bench);
    let mut run = start(&bench, "2");
    assert!(await_journal(&bench, &mut run, 20_000), "the run was over before it could be interrupted");
    let sent = Command::new("sh").args(["-c", &format!("kill -INT {}", run.id())]).status().unwrap();
    assert!(sent.success());
    let output = bench.output(&run.wait_with_output().unwrap());
    assert_eq!(output.code, Some(130), "{}", output.err);
    let kept = units(&bench);
    let message = format!(
        "replan: interrupted: {kept} of 300 units of study `draws` are kept; the same command goes on from there\n"
    );
    assert!(
        output.err.starts_with("stopping at the next safe point; press Ctrl-C again to"),
        "{}",
        output.err
    );
    assert!(output.err.ends_with(&message), "{message}{}", output.err);
    assert!((1..300).contains(&kept), "{kept}");
    let out = bench.done(&["run", "./mini"]);
    assert!(out.starts_with(&format!("draws: 600 trials ({kept} of 300 units resumed)\n")), "{out}");
    assert!(bench.facts("target/replan/mini") == calm);
}

#[test]
fn ctrl_c_while_the_clock_is_read_keeps_the_trials_and_stores_no_half_sample() {
    let bench = slow();
    bench.edit("mini/draws.toml", "problems = 2\nrepeats = 2", "problems = 300\nrepeats = 20");
    let mut run = start(&bench, "2");
    while units(&bench) < 300 {
        assert!(run.try_wait().unwrap().is_none(), "the run was over before its clock was seen");
        sleep(Duration::from_micros(500));
    }
    sleep(Duration::from_millis(30));
    let sent = Command::new("sh").args(["-c", &format!("kill -INT {}", run.id())]).status().unwrap();
    assert!(sent.success());
    let output = bench.output(&run.wait_with_output().unwrap());
    assert_eq!(output.code, Some(130), "{}", output.err);
    assert!(output.err.contains("300 of 300 units of study `draws` are kept"), "{}", output.err);
    assert!(bench.facts("target/replan/mini").is_empty(), "records were written");
    bench.edit("mini/draws.toml", "problems = 300\nrepeats = 20", "problems = 2\nrepeats = 2");
    assert!(bench.done(&["run", "./mini"]).starts_with("draws: 600 trials (300 of 300 units resumed)\n"));
}

#[test]
fn a_journal_of_another_study_is_not_believed() {
    let bench = slow();
    let mut run = start(&bench, "2");
    assert!(await_journal(&bench, &mut run, 20_000), "the run was over before it could be killed");
    run.kill().unwrap();
    run.wait().unwrap();
    bench.edit("mini/draws.toml", "seed = 7", "seed = 9");
    let out = bench.done(&["run", "./mini"]);
    assert!(out.starts_with("draws: 600 trials\n"), "{out}");
    bench.done(&["run", "./mini", "--out", "calm"]);
    assert!(bench.facts("target/replan/mini") == bench.facts("calm"));
}

#[test]
fn ctrl_c_while_figures_are_drawn_ends_with_130_and_leaves_the_older_ones() {
    let bench = Bench::new();
    bench.done(&["repro", "./mini"]);
    let before = bench.tree("target/replan/mini/plots");
    let room = fs::read_to_string(bench.at("mini/room.toml")).unwrap();
    let figure = room.split("[[figure]]").nth(1).unwrap();
    let more: Vec<String> = (2..40).map(|n| figure.replace("fig1", &format!("fig{n}"))).collect();
    fs::write(bench.at("mini/room.toml"), room + "\n[[figure]]" + &more.join("\n[[figure]]")).unwrap();
    fs::remove_file(bench.at("target/replan/mini/data/runs/mini/verdicts.toml")).unwrap();
    let mut run = bench.command(&["repro", "./mini"]).spawn().unwrap();
    while !bench.at("target/replan/mini/data/runs/mini/verdicts.toml").exists() {
        assert!(run.try_wait().unwrap().is_none(), "the run was over before its verdicts were seen");
        sleep(Duration::from_micros(500));
    }
    let sent = Command::new("sh").args(["-c", &format!("kill -INT {}", run.id())]).status().unwrap();
    assert!(sent.success());
    let output = bench.output(&run.wait_with_output().unwrap());
    assert_eq!(output.code, Some(130), "{}", output.err);
    assert!(output.err.contains("interrupted"), "{}", output.err);
    assert!(
        output.out.contains("2 sentences and rows: "),
        "the verdicts are printed before figures are drawn: {}",
        output.out
    );
    assert!(bench.tree("target/replan/mini/plots") == before, "a figure was replaced");
    bench.done(&["repro", "./mini"]);
    assert_eq!(bench.tree("target/replan/mini/plots").len(), before.len() + 2 * 38);
}
