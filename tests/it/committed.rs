//! What is committed beside the code: stored runs, plots and the report.

use crate::paper::thoroughly;
use replan::analysis::criterion;
use replan::analysis::outcome::Outcome;
use replan::analysis::verdict::Verdicts;
use replan::analysis::verdict_rule::Verdict;
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;
use study::Inputs;
use study::manifest::Manifest;
use study::paper::Paper;
use study::store::{Columns, Staged, Traces, read_records, stage_records};

/// The bytes of every file below `path`.
fn size(path: &Path) -> u64 {
    let found = fs::metadata(path).unwrap();
    if found.is_file() {
        return found.len();
    }
    fs::read_dir(path).unwrap().map(|entry| size(&entry.unwrap().path())).sum()
}

#[test]
fn runs_plots_and_report_stay_small_enough_to_clone() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let total: u64 = ["data/runs", "plots", "paper_repro.md"].iter().map(|name| size(&root.join(name))).sum();
    assert!((1_000_000..40_000_000).contains(&total), "{total} bytes; 40 MB are accepted");
}

#[test]
fn the_report_has_a_chapter_for_every_paper_in_the_order_of_their_names() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let report = fs::read_to_string(root.join("paper_repro.md")).unwrap();
    let begun = |line: &str| line.strip_prefix("<!-- replan begin ")?.strip_suffix(" -->").map(str::to_owned);
    let chapters: Vec<String> = report.lines().filter_map(begun).collect();
    assert!(chapters.is_sorted(), "{chapters:?}");
    for paper in fs::read_dir(root.join("experiments")).unwrap() {
        let name = paper.unwrap().file_name().into_string().unwrap();
        assert!(chapters.contains(&name), "no chapter of {name} in {chapters:?}");
    }
}

#[test]
fn stored_records_are_the_bytes_that_this_program_would_write_of_them() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut studies = 0;
    for folder in fs::read_dir(root.join("experiments")).unwrap().map(|entry| entry.unwrap().path()) {
        let inputs = Inputs::below(vec![folder.clone(), root.to_owned()]);
        let paper = Paper::load(&folder, &inputs).unwrap();
        let runs = root.join("data/runs").join(&paper.id);
        for study in &paper.studies {
            let manifest = Manifest::read(&runs, &study.name).unwrap();
            // Those of the largest take most of the time; a written file of any study has all that another has.
            let bytes: u64 = ["trials", "traces", "times", "preprocessing"]
                .iter()
                .filter_map(|kind| fs::metadata(runs.join(format!("{}.{kind}.parquet", study.name))).ok())
                .map(|file| file.len())
                .sum();
            if thoroughly(1_000_000) < bytes as usize {
                continue;
            }
            let records = read_records(&runs, &study.name, &manifest.files).unwrap();
            let columns = Columns::new(study);
            let place = tempfile::tempdir().unwrap();
            let traces = Traces::held(&records.batch.kept);
            let mut staged = Staged::default();
            let written = stage_records(&mut staged, place.path(), &study.name, &columns, &records, traces);
            assert_eq!(written.unwrap(), manifest.files, "{}: {}", paper.id, study.name);
            studies += 1;
        }
    }
    assert!(studies > 15, "only {studies} stored studies");
}

#[test]
fn every_stored_trial_has_the_row_of_what_was_prepared_by_which_it_is_found_again() {
    let runs = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/runs");
    let mut studies = 0;
    let folders = fs::read_dir(runs).unwrap().map(|entry| entry.unwrap().path());
    for folder in folders.filter(|path| path.is_dir()) {
        let names =
            fs::read_dir(&folder).unwrap().map(|file| file.unwrap().file_name().into_string().unwrap());
        for name in names.filter_map(|name| name.strip_suffix(".manifest.toml").map(str::to_owned)) {
            let manifest = Manifest::read(&folder, &name).unwrap();
            let batch = read_records(&folder, &name, &manifest.files).unwrap().batch;
            let preprocessing: BTreeSet<_> = batch.preprocessing.iter().map(|row| &row.key).collect();
            let lost = batch.rows.iter().find(|row| !preprocessing.contains(&row.key.on));
            assert!(lost.is_none(), "{}: {name}: {lost:?}", folder.display());
            assert!(!batch.rows.is_empty(), "{}: {name}: no trial", folder.display());
            studies += 1;
        }
    }
    assert!(studies > 15, "only {studies} stored studies");
}

#[test]
fn stored_trials_of_contenders_and_of_tasks_are_found_by_their_names() {
    for (paper, trial) in [
        ("planar", "readings/case-1/a-star-8"),
        ("tang2023", "formula/solids/0/printed-distance"),
        ("zhang", "readings/w1/a-star"),
    ] {
        let mut replan = Command::new(env!("CARGO_BIN_EXE_replan"));
        let output = replan.args(["repro", paper, "--trial", trial]).current_dir(env!("CARGO_MANIFEST_DIR"));
        let output = output.output().unwrap();
        let out = String::from_utf8(output.stdout).unwrap();
        assert!(output.status.success() && out.ends_with("equals the stored row\n"), "{trial}: {out}");
    }
}

#[test]
fn what_speaks_against_a_claim_names_a_trial_and_what_leaves_it_open_says_what_would_settle_it() {
    let runs = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/runs");
    let mut against = 0;
    for folder in fs::read_dir(runs).unwrap().map(|entry| entry.unwrap().path()).filter(|path| path.is_dir())
    {
        for judged in Verdicts::read(&folder).unwrap().claims {
            let is_reported = judged.across.as_ref().is_some_and(|across| across.settles.is_some())
                || judged.findings.iter().any(|finding| finding.settles.is_some());
            let is_open = [Verdict::Inconclusive, Verdict::Depends].contains(&judged.verdict);
            assert!(!is_open || is_reported, "{}", judged.claim);
            for finding in &judged.findings {
                let is_measured = criterion::find(&finding.criterion).is_some();
                match finding.outcome {
                    Some(Outcome::Fails | Outcome::SignOnly) if is_measured => {
                        assert!(finding.trial.is_some(), "{}: {}", judged.claim, finding.criterion);
                        against += 1;
                    }
                    Some(Outcome::Open) => {
                        assert!(finding.settles.is_some(), "{}: {}", judged.claim, finding.criterion);
                    }
                    _ => {}
                }
            }
        }
    }
    assert!(against > 40, "only {against} findings speak against claims");
}

#[test]
fn the_ways_in_which_searches_end_add_up_to_all_of_them() {
    let report = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("paper_repro.md")).unwrap();
    let table = report.split("|  | Solved | Refused | No path | Budget spent |").nth(1).unwrap();
    let rows = table.lines().skip(2).take_while(|line| line.starts_with('|'));
    // The label, and then the four ways; other columns may follow.
    let shares = |line: &str| {
        let cells = line.split('|').skip(2).take(4);
        cells.filter_map(|cell| cell.trim().parse().ok()).collect::<Vec<f64>>()
    };
    let rows: Vec<Vec<f64>> = rows.map(shares).filter(|shares| !shares.is_empty()).collect();
    for shares in &rows {
        let sum: f64 = shares.iter().sum();
        assert!(shares.len() == 4 && (sum - 100.0).abs() < 0.25, "{shares:?}");
    }
    let occurs = |way: usize| rows.iter().any(|shares| shares[way] > 0.0);
    assert!(rows.len() == 8 && (0..3).all(occurs), "{rows:?}");
    assert!(!occurs(3), "a search spent its budget: {rows:?}");
}
