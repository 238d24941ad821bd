//! No input makes the program panic, hang or fill the memory: seeded mutations of everything that it reads.
//!
//! Each case damages one committed file and has it read as `check` reads it: a study with its families, planners, claims
//! and figures; a paper with its studies as they are; a robot, scene or map through a study that uses it. The case ends
//! well or with an error that names a file and a place in it. What is accepted must run, too: that is tried on small papers
//! ([`running`]). `REPLAN_MUTATIONS` sets how many cases there are, or which: `1000..2000`.

mod damage;
mod doors;
mod running;
mod stored;
mod subject;

use base::seed;
use rand::RngExt as _;
use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind};
use subject::Subject;

/// Cases, unless `REPLAN_MUTATIONS` says otherwise.
const CASES: u64 = 3000;

/// One case in so many damages a committed paper, which takes thousands of times longer than all else that is damaged.
const SPECS_OF: u64 = 10;

/// One case may take this long; the longest of four hundred thousand took a fifth of it.
const LONGEST_S: f64 = 20.0;

/// The cases of a test that has so many of the first `n` as `share` gives for `n`.
fn cases(share: impl Fn(u64) -> u64) -> Range<u64> {
    let text = std::env::var("REPLAN_MUTATIONS").unwrap_or_else(|_| CASES.to_string());
    let (from, to) = text.split_once("..").unwrap_or(("0", &text));
    let [from, to] = [from, to].map(|number| number.parse().unwrap());
    share(from)..share(to)
}

/// How many cases are in `range`.
fn count(range: &Range<u64>) -> u64 {
    range.end - range.start
}

/// The processor time of this thread, where the system gives it: a busy machine makes no case long.
fn used_ns() -> Option<u64> {
    std::fs::read_to_string("/proc/thread-self/schedstat").ok()?.split(' ').next()?.parse().ok()
}

/// What went wrong with a case, if anything did: `work` panicked, took too long, or refused without saying where.
fn fault(work: impl FnOnce() -> Result<(), String>) -> Result<bool, String> {
    let before = used_ns();
    let (wall_ns, ended) = study::clock::timed(|| catch_unwind(AssertUnwindSafe(work)));
    let ns = used_ns().zip(before).map_or(wall_ns, |(after, before)| after - before);
    let seconds = ns as f64 * 1e-9;
    match ended {
        Err(_) => Err("it panicked".to_owned()),
        Ok(_) if seconds > LONGEST_S => Err(format!("it took {seconds:.1} s")),
        Ok(Err(message)) if !is_located(&message) => {
            Err(format!("it was refused without a place: {message}"))
        }
        Ok(Ok(())) => Ok(true),
        Ok(Err(_)) => Ok(false),
    }
}

/// Whether the first line of `message` names a file and a line, a byte or a column in it.
fn is_located(message: &str) -> bool {
    let first = message.lines().next().unwrap_or_default();
    let is_place = |rest: &str| {
        let rest = rest.trim_start_matches([':', ',', ' ', '`']);
        let rest = rest.strip_prefix("line ").or_else(|| rest.strip_prefix("byte ")).unwrap_or(rest);
        rest.starts_with(|c: char| c.is_ascii_digit())
    };
    // A Parquet file is no text: its name is all that can be said.
    if first.contains(".parquet") || first.contains("manifest.toml") || first.contains("verdicts.toml") {
        return true;
    }
    let endings =
        [".toml", ".txt", ".map", ".scen", ".csv", ".md", ".json", ".yaml", ".urdf", ".stl", ".pgm", ".png"];
    let is_file =
        |ending: &str| first.match_indices(ending).any(|(at, _)| is_place(&first[at + ending.len()..]));
    endings.into_iter().any(is_file)
}

#[test]
fn no_damaged_spec_robot_scene_or_map_panics_and_every_refusal_says_where() {
    let subject = Subject::of_committed_papers();
    let mut faults = Vec::new();
    let mut accepted = 0;
    let cases = cases(|all| all / SPECS_OF);
    let all = count(&cases);
    for case in cases {
        let mut stream = seed::stream(seed::derive(2024, &["mutation", &case.to_string()]));
        let file = stream.random_range(0..subject.files());
        let bytes = damage::damaged(&mut stream, subject.bytes(file));
        match fault(|| subject.read(file, &bytes)) {
            Ok(is_accepted) => accepted += u64::from(is_accepted),
            Err(what) => faults.push(format!("case {case}, {}: {what}", subject.name(file))),
        }
    }
    println!("{all} cases, {accepted} accepted");
    assert!(faults.is_empty(), "{} of {all} cases:\n{}", faults.len(), faults.join("\n"));
    // Comments and captions take any damage; names, keys and numbers do not.
    assert!((all / 10..all * 9 / 10).contains(&accepted), "{accepted} of {all} were accepted");
}

#[test]
fn an_option_renamed_where_a_choice_declares_it_is_refused_wherever_it_is_named() {
    let subject = Subject::of_committed_papers();
    let file = subject.find("fu2018/paper.toml");
    let text = String::from_utf8(subject.bytes(file).to_vec()).unwrap();
    let mut is_inline = false;
    let mut refused = 0;
    for line in text.lines() {
        let renamed = match line.strip_prefix("[choice.option.") {
            Some(rest) => format!("[choice.option.renamed_{rest}"),
            None if is_inline && line.contains(" = { ") => match line.strip_prefix('"') {
                Some(rest) => format!("\"renamed_{rest}"),
                None => format!("renamed_{line}"),
            },
            None => {
                is_inline = line == "[choice.option]" || is_inline && !line.starts_with('[');
                continue;
            }
        };
        match fault(|| subject.read(file, text.replacen(line, &renamed, 1).as_bytes())) {
            Ok(is_accepted) => refused += u32::from(!is_accepted),
            Err(what) => panic!("{renamed}: {what}"),
        }
    }
    assert!(refused >= 10, "{refused} renamed options were refused: fu2018 has ten choices");
}

#[test]
fn sizes_that_cannot_be_meant_are_refused_with_their_limit() {
    let subject = Subject::of_committed_papers();
    for (file, from, to, expected) in [
        (
            "zhang/ensemble.toml",
            "instances = 200",
            "instances = 4000000000",
            "`instances` is 4000000000; a whole number from 1 to 1000000 is",
        ),
        (
            "zhang/ensemble.toml",
            "size_cells = [30, 30]",
            "size_cells = [65000, 65000]",
            "and all may have 16777216",
        ),
        (
            "tang2023/environments.toml",
            "side_cm = 100",
            "side_cm = 1e9",
            "each side may have 1 to 1023 nodes",
        ),
        (
            "tang2023/environments.toml",
            "side_cm = 100",
            "side_cm = 1e308",
            "a number from -1e9 to 1e9 is accepted",
        ),
        ("scenes/tang_c1.toml", "max = [95", "max = [1e9", "each side may have 1 to 1023 nodes"),
        (
            "fu2018/paper.toml",
            "decimals = 0",
            "decimals = 70000",
            "`decimals` is 70000; a whole number from 0 to 15 is",
        ),
        (
            "fu2018/paper.toml",
            "refused_below = 0.05",
            "refused_below = 5",
            "`refused_below` is 5; a number above 0 to 1 is",
        ),
    ] {
        let index = subject.find(file);
        let text = String::from_utf8(subject.bytes(index).to_vec()).unwrap();
        assert!(text.contains(from), "{file} does not hold `{from}`");
        let refused = fault(|| {
            let refused = subject.read(index, text.replacen(from, to, 1).as_bytes());
            assert!(refused.as_ref().is_err_and(|e| e.contains(expected)), "{to}: {refused:?}");
            refused
        });
        assert_eq!(refused, Ok(false), "{to}");
    }
}
