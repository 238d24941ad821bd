//! What `check` accepts runs: a small paper with one number changed ends a quick run, or is refused, in a moment.

use super::damage;
use crate::paper::Bench;
use base::seed::{self, Stream};
use rand::RngExt as _;
use std::fs;
use std::io::Read as _;
use std::ops::Range;
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

/// So many cases of interpretation go with one that runs.
const READ_FOR_ONE: u64 = 100;

/// A run is looked at this often.
const LOOK: Duration = Duration::from_millis(5);

/// So many looks, a minute and a half, a run may take on a busy machine; unchanged papers take a second.
const MOST_LOOKS: usize = 18_000;

/// What stands in place of a number: small, large, and what a slip of units or of a decimal point makes of one.
const NUMBERS: [&str; 12] =
    ["0", "1", "-1", "7", "1000", "1_000_000", "4000000000", "1e-9", "0.001", "0.5", "1e9", "1e300"];

/// Whether `run` ended well and not with a refusal; what else it did.
fn ended(mut run: Command) -> Result<bool, String> {
    let mut child = run.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    let looked = (0..MOST_LOOKS).find_map(|_| {
        sleep(LOOK);
        child.try_wait().unwrap()
    });
    let Some(status) = looked else {
        child.kill().unwrap();
        child.wait().unwrap();
        return Err("it did not end".to_owned());
    };
    let code = status.code();
    let mut text = String::new();
    child.stderr.take().unwrap().read_to_string(&mut text).unwrap();
    let is_fit = matches!(code, Some(0 | 2)) && !text.contains("panicked");
    if is_fit { Ok(code == Some(0)) } else { Err(format!("it ended with {code:?}: {text}")) }
}

/// The TOML files of a paper that say what runs, with where numbers stand in them.
fn files(bench: &Bench, paper: &str) -> Vec<(PathBuf, String, Vec<Range<usize>>)> {
    let mut paths: Vec<PathBuf> =
        fs::read_dir(bench.at(paper)).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|is| is == "toml") && !path.ends_with("paper.toml"));
    paths.sort();
    let read = |path: PathBuf| {
        let text = fs::read_to_string(&path).unwrap();
        let is_meant = |at: &Range<usize>| {
            let line = text[..at.start].rsplit('\n').next().unwrap_or_default();
            !line.contains('#') && line.contains('=') && !line.contains('"')
        };
        let places = damage::numbers(text.as_bytes()).into_iter().filter(is_meant).collect();
        (path, text, places)
    };
    paths.into_iter().map(read).collect()
}

/// Whether a paper runs with one number of one file in another's place; what went wrong.
fn case(bench: &Bench, paper: &str, stream: &mut Stream) -> Result<bool, String> {
    let files: Vec<_> = files(bench, paper).into_iter().filter(|(.., places)| !places.is_empty()).collect();
    let (path, text, places) = &files[stream.random_range(0..files.len())];
    let place = places[stream.random_range(0..places.len())].clone();
    let number = NUMBERS[stream.random_range(0..NUMBERS.len())];
    fs::write(path, format!("{}{number}{}", &text[..place.start], &text[place.end..])).unwrap();
    let folder = format!("./{paper}");
    let run = bench.command(&["run", &folder, "--quick", "--fresh", "--threads", "1", "--out", "out"]);
    let ended = ended(run);
    fs::write(path, text).unwrap();
    let line = text[..place.start].matches('\n').count() + 1;
    ended
        .map_err(|fault| format!("{}:{line}: {number} in place of {}: {fault}", path.display(), &text[place]))
}

#[test]
fn a_paper_with_any_number_changed_is_refused_or_runs_to_its_end() {
    let bench = Bench::empty();
    let papers = ["grid", "arm", "cell"];
    for paper in papers {
        bench.done(&["new", paper, "--from", paper]);
    }
    let cases = super::cases(|all| all.div_ceil(READ_FOR_ONE));
    let all = super::count(&cases);
    let mut faults = Vec::new();
    let mut ran = 0;
    for number in cases {
        let mut stream = seed::stream(seed::derive(2026, &["running", &number.to_string()]));
        match case(&bench, papers[number as usize % papers.len()], &mut stream) {
            Ok(is_accepted) => ran += u64::from(is_accepted),
            Err(fault) => faults.push(fault),
        }
    }
    assert!(faults.is_empty(), "{} of {all} cases:\n{}", faults.len(), faults.join("\n"));
    assert!(ran * 4 > all, "{ran} of {all} ran");
}
