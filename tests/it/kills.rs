//! Commands that are killed at random moments: the same command then ends with the bytes of one that nobody disturbed, leaves nothing
//! half-written, and writes nowhere else. `REPLAN_KILLS` sets how many kills there are.

use crate::across::Toy;
use crate::paper::Bench;
use base::seed;
use rand::RngExt as _;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Child;
use std::thread::sleep;
use std::time::Duration;
use study::clock::timed;

/// Kills, unless `REPLAN_KILLS` says otherwise.
const KILLS: usize = 10;

/// What is done to the toy, one command after the other; each is killed in the middle of it.
const COMMANDS: [&[&str]; 5] = [
    &["run", "./toy", "--threads", "2"],
    &["explore", "./toy", "--threads", "2"],
    &["render", "./toy"],
    &["merge", "parts", "--out", "merged"],
    &["export", "target/replan/toy", "--csv", "--out", "exported"],
];

/// The toy with parts of a run that are to be merged.
fn toy() -> Toy {
    let toy = Toy::written(&[]);
    for shard in ["1/2", "2/2"] {
        toy.0.done(&["run", "./toy", "--shard", shard, "--out", "parts"]);
    }
    toy
}

/// What must repeat of a file: a history has an entry for what a killed command stored, and verdicts name its last seal, which is
/// under their own.
fn repeated(path: &Path, bytes: Vec<u8>) -> Vec<u8> {
    match path.file_name().and_then(|name| name.to_str()) {
        Some("history.toml") => Vec::new(),
        Some("verdicts.toml") => {
            let text = String::from_utf8(bytes).unwrap();
            let is_seal = |line: &str| line.starts_with("history = ") || line.starts_with("# SHA-256 of ");
            let kept: Vec<&str> = text.lines().filter(|line| !is_seal(line)).collect();
            kept.join("\n").into_bytes()
        }
        _ => bytes,
    }
}

/// Every file below the bench's folder, by its path there.
fn files(bench: &Bench) -> BTreeMap<PathBuf, Vec<u8>> {
    let root = bench.at(".");
    let named = |(path, bytes): (PathBuf, Vec<u8>)| {
        let bytes = repeated(&path, bytes);
        (path.strip_prefix(&root).unwrap().to_owned(), bytes)
    };
    bench.tree(".").into_iter().map(named).collect()
}

/// The files after every command, and how long each took.
fn undisturbed() -> (BTreeMap<PathBuf, Vec<u8>>, Vec<u64>) {
    let Toy(bench) = toy();
    let took = COMMANDS.map(|command| timed(|| bench.done(command)).0);
    (files(&bench), took.to_vec())
}

/// Kills `run` after a share of `ns`; whether it was still at work.
fn kill(mut run: Child, ns: u64, share: f64) -> bool {
    sleep(Duration::from_nanos((ns as f64 * share) as u64));
    let was_at_work = run.try_wait().unwrap().is_none();
    run.kill().unwrap();
    run.wait().unwrap();
    was_at_work
}

/// How many kills the environment asks for.
fn kills() -> usize {
    std::env::var("REPLAN_KILLS").map_or(KILLS, |text| text.parse().unwrap())
}

#[test]
fn commands_killed_at_random_moments_end_with_the_bytes_of_undisturbed_ones_and_leave_no_litter() {
    let (calm, took) = undisturbed();
    let (again, _) = undisturbed();
    // Times and what is derived from them differ from run to run.
    let repeats: Vec<&PathBuf> = calm.keys().filter(|path| calm.get(*path) == again.get(*path)).collect();
    for needed in ["draws.trials.parquet", "estimates.parquet", "paper_repro.md", "exported/draws.trials.csv"]
    {
        assert!(repeats.iter().any(|path| path.to_string_lossy().ends_with(needed)), "{needed}: {repeats:?}");
    }
    let Toy(bench) = toy();
    let mut at_work = 0;
    for (number, command) in COMMANDS.iter().enumerate() {
        for kill_number in (number..kills()).step_by(COMMANDS.len()) {
            let mut stream = seed::stream(seed::derive(50, &["kill", &kill_number.to_string()]));
            let run = bench.command(command).spawn().unwrap();
            at_work += usize::from(kill(run, took[number], stream.random_range(0.0..0.9)));
        }
        bench.done(command);
    }
    let ended = files(&bench);
    let names = |files: &BTreeMap<PathBuf, Vec<u8>>| files.keys().cloned().collect::<BTreeSet<_>>();
    let left: Vec<_> = names(&ended).difference(&names(&calm)).cloned().collect();
    assert!(left.is_empty(), "left behind: {left:?}");
    let others: Vec<_> = repeats.iter().filter(|path| ended.get(**path) != calm.get(**path)).collect();
    let first_lines = |path: &PathBuf| {
        let [calm, ended] = [&calm, &ended].map(|files| String::from_utf8_lossy(&files[path]).into_owned());
        let differ = calm.lines().zip(ended.lines()).find(|(calm, ended)| calm != ended);
        format!("{}: {differ:?}", path.display())
    };
    let others: Vec<String> = others.into_iter().map(|path| first_lines(path)).collect();
    assert!(others.is_empty(), "other bytes than undisturbed: {others:?}");
    assert!(at_work > kills() / 4, "{at_work} of {} kills hit a command at work", kills());
    println!("{} kills, {at_work} of them at work, {} files of equal bytes", kills(), repeats.len());
}

#[test]
fn what_a_killed_command_left_half_written_is_cleared_when_its_file_is_next_written() {
    let Toy(bench) = toy();
    for command in [0, 3, 4] {
        bench.done(COMMANDS[command]);
    }
    let mut ended = bench.command(&["--version"]).spawn().unwrap();
    ended.wait().unwrap();
    let litter = ["exported/draws.trials.csv", "merged/data/runs/toy/draws.trials.parquet"]
        .map(|name| format!("{name}.{}.tmp", ended.id()));
    let other = format!("exported/of_somebody_else.{}.tmp", ended.id());
    let at_work = format!("exported/draws.trials.csv.{}.tmp", std::process::id());
    for name in litter.iter().chain([&other, &at_work]) {
        bench.write(name, b"half");
    }
    bench.done(COMMANDS[3]);
    bench.done(COMMANDS[4]);
    for name in litter {
        assert!(!bench.at(&name).exists(), "{name} is still there");
    }
    assert!(bench.at(&other).exists() && bench.at(&at_work).exists(), "files of others were removed");
}

#[test]
fn nothing_is_written_but_below_out() {
    let Toy(bench) = Toy::written(&[]);
    for command in [&["run"][..], &["explore"], &["confirm"], &["render"], &["repro"]] {
        bench.done(&[command, &["./toy", "--out", "out"]].concat());
    }
    bench.done(&["export", "out", "--csv", "--out", "out/csv"]);
    let tops: BTreeSet<String> = fs::read_dir(bench.at("."))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    let expected = ["mini", "out", "toy"].map(str::to_owned);
    assert_eq!(tops, BTreeSet::from(expected));
    assert!(Path::new(&bench.at("out/data/runs/toy")).is_dir());
}
