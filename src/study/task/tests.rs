use crate::Inputs;
use crate::choice::Interpretation;
use crate::lock::Lock;
use crate::paper::Paper;
use crate::record::Batch;
use crate::rerun::rerun;
use crate::runner::{BuiltStudy, Unwatched};
use crate::session::{Again, Options, run, run_one};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

const PAPER: &str = "[source]\ntitle = 'a test'\n[prints]\nfigures = 0\ntables = 0\nequations = 0\n";

/// Random segments beside two kinds of small solids.
const STUDY: &str = "
seed = 6
paper = 'p'
question = 'q'
task = 'formula_error'
[task_settings]
samples = 20
reach = 0.5
range_cm = 5.0
[budget]
expansions = 1000
[quick]
instances = 1
[[problems]]
label = 'boxes'
family = 'random_polyhedra'
instances = 3
settings = { side_cm = 50, step_cm = 10, count = [1, 1], size_cm = [8, 20], shapes = ['box'], clear_cm = 1, queries = [{ start = [1, 1, 1], goal = [49, 49, 49] }] }
[[problems]]
label = 'wedges'
family = 'random_polyhedra'
instances = 3
settings = { side_cm = 50, step_cm = 10, count = [1, 1], size_cm = [8, 20], shapes = ['wedge'], clear_cm = 1, queries = [{ start = [1, 1, 1], goal = [49, 49, 49] }] }
";

/// Every file of facts that the study `p/s.toml` leaves when it runs on `threads`.
fn facts(folder: &Path, threads: usize) -> BTreeMap<String, Vec<u8>> {
    let inputs = Inputs::below(vec![folder.join("p")]);
    let paper = Paper::load(&folder.join("p"), &inputs).unwrap();
    let points = paper.studies[0].trial_interpretations().unwrap();
    let out = folder.join(threads.to_string());
    let lock = Lock::take(&out).unwrap();
    let options = Options {
        lock: &lock,
        points: &points,
        inputs: &inputs,
        command: String::new(),
        quick: false,
        again: Again::default(),
        portion: None,
        threads: Some(threads),
        stop: &AtomicBool::new(false),
        progress: &Unwatched,
    };
    let report = run(&paper.studies[0], &options).unwrap();
    assert!(report.trials > 2, "{} trials", report.trials);
    let files = ["trials", "preprocessing", "traces"].map(|kind| format!("s.{kind}.parquet"));
    files.map(|name| (name.clone(), fs::read(out.join(name)).unwrap())).into()
}

/// A folder with the paper `p` of one study.
fn folder(study: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("p")).unwrap();
    fs::write(folder.path().join("p/paper.toml"), PAPER).unwrap();
    fs::write(folder.path().join("p/s.toml"), study).unwrap();
    folder
}

/// The study whose settings of quick runs are `quick`.
fn with_quick(quick: &str) -> Result<crate::Study, String> {
    let folder = folder(&STUDY.replace("instances = 1\n", quick));
    let paper = Paper::load(&folder.path().join("p"), &Inputs::default()).map_err(|e| e.to_string())?;
    Ok(paper.studies.into_iter().next().unwrap())
}

#[test]
fn a_quick_run_alone_takes_the_budget_clock_and_task_settings_of_quick() {
    let quick = "instances = 1
budget = { expansions = 7 }
timing = { problems = 1, repeats = 1 }
task_settings = { samples = 5 }
[timing]
problems = 3
repeats = 4
";
    let shown = |study: &crate::Study| {
        let samples = study.task_settings.table()["samples"].as_integer().unwrap();
        (study.budget.expansions, study.timing.map(|timing| timing.repeats), samples)
    };
    let study = with_quick(quick).unwrap();
    assert_eq!(shown(&study), (1000, Some(4), 20));
    let study = study.quick();
    assert_eq!(shown(&study), (7, Some(1), 5));
    assert_eq!(study.task_settings.table()["reach"].as_float(), Some(0.5));
    // A study that reads no clock reads none in a quick run either.
    let untimed = with_quick(&quick.replace("[timing]\nproblems = 3\nrepeats = 4\n", "")).unwrap();
    assert_eq!(shown(&untimed.quick()), (7, None, 5));
    for (wrong, part) in [
        (quick.replace("expansions = 7", "expansions = 0"), "a whole number from 1 to"),
        (quick.replace("samples = 5", "samples = 0"), "`samples` is 0; a whole number from 1 to"),
        (quick.replace("budget", "budgets"), "budgets"),
    ] {
        let error = with_quick(&wrong).unwrap_err();
        assert!(error.contains(part), "{error}");
    }
}

#[test]
fn a_task_gives_the_same_bytes_at_any_number_of_threads() {
    let folder = folder(STUDY);
    assert!(facts(folder.path(), 1) == facts(folder.path(), 2), "1 thread and 2 differ");
}

#[test]
fn single_trials_are_run_again_without_the_others_and_give_the_stored_rows() {
    let folder = folder(STUDY);
    facts(folder.path(), 2);
    let inputs = Inputs::below(vec![folder.path().join("p")]);
    let paper = Paper::load(&folder.path().join("p"), &inputs).unwrap();
    let study = &paper.studies[0];
    let runs = folder.path().join("2");
    let points = study.trial_interpretations().unwrap();
    for trial in ["boxes/1/printed-distance", "wedges/2/printed-distance"] {
        let (batch, stored) = run_one(study, &points, &inputs, &runs, trial).unwrap();
        assert_eq!(batch.rows, [stored.expect("it was run")], "{trial}");
    }
    for wrong in ["boxes/1/printed", "boxes/3/printed-distance", "other/1/printed-distance"] {
        let error = run_one(study, &points, &inputs, &runs, wrong).unwrap_err().to_string();
        assert!(error.contains("its first one is `s/boxes/0/printed-distance`"), "{wrong}: {error}");
    }
    let again = rerun(study, &inputs, &runs, 1, 1).unwrap();
    let all = rerun(study, &inputs, &runs, 1_000, 1).unwrap();
    assert!(again.differ.is_empty() && all.differ.is_empty(), "{again:?}, {all:?}");
    assert!(again.trials > 0 && again.trials < all.trials, "{again:?}, {all:?}");
}

#[test]
fn a_rerun_names_trials_that_come_out_otherwise_and_those_that_come_no_more() {
    let folder = folder(STUDY);
    facts(folder.path(), 2);
    let file = folder.path().join("p/s.toml");
    for (edited, least) in [
        (STUDY.to_owned(), 0),
        (STUDY.replace("size_cm = [8, 20]", "size_cm = [9, 20]"), 2),
        (STUDY.replace("label = '", "label = 'other "), 2),
    ] {
        fs::write(&file, edited).unwrap();
        let inputs = Inputs::below(vec![folder.path().join("p")]);
        let paper = Paper::load(&folder.path().join("p"), &inputs).unwrap();
        let again = rerun(&paper.studies[0], &inputs, &folder.path().join("2"), 1_000, 1).unwrap();
        let differ = again.differ.len();
        assert!(if least == 0 { differ == 0 } else { differ >= least }, "{again:?}");
    }
}

#[test]
fn units_that_share_what_is_prepared_give_what_each_gives_alone() {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    let inputs = Inputs::below(vec![root.to_owned()]);
    let paper = Paper::load(&root.join("experiments/fu2018"), &inputs).unwrap();
    for name in ["particle", "stages"] {
        let study = paper.study(name).unwrap();
        let points = study.trial_interpretations().unwrap();
        let built = BuiltStudy::new(study, &points[..1], &inputs).unwrap();
        let first = built.unit(0);
        // The other asks for less and in another order, so that what the first learned would show.
        let mut other = first.clone();
        other.entrants.reverse();
        other.entrants.truncate(3);
        let task = (study.task.build)(&study.task_settings).unwrap();
        let together = task.run_alike(&[&first, &other]);
        assert!(together == [built.run_unit(&first), built.run_unit(&other)], "{name}");
        assert!(together[0].rows.len() > together[1].rows.len(), "{name}");
    }
}

#[test]
fn interpretations_of_one_map_give_what_each_gives_alone_and_share_contenders_that_they_leave_as_they_are() {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    let inputs = Inputs::below(vec![root.to_owned()]);
    let paper = Paper::load(&root.join("experiments/theta"), &inputs).unwrap();
    let study = paper.study("replays").unwrap();
    let points = [None, Some(("smoothing", "goal")), Some(("ties", "larger_g"))].map(|other| {
        let other = other.iter().map(|(choice, option)| ((*choice).to_owned(), (*option).to_owned()));
        Interpretation::new(&study.choices, &other.collect()).unwrap()
    });
    let built = BuiltStudy::new(study, &points, &inputs).unwrap();
    let units: Vec<_> = built.units().collect();
    let pipelines: BTreeSet<_> = units
        .iter()
        .flat_map(|unit| unit.entrants.iter().map(|entrant| Arc::as_ptr(&entrant.pipeline).addr()))
        .collect();
    // The six of the defaults, A* PS smoothed from the goal, Theta* and AP Theta* with the other ties.
    assert_eq!(pipelines.len(), 9);
    let task = (study.task.build)(&study.task_settings).unwrap();
    let together = task.run_alike(&units.iter().collect::<Vec<_>>());
    let alone: Vec<_> = units.iter().map(|unit| built.run_unit(unit)).collect();
    assert!(together == alone);
    let whole = |batch: &Batch| batch.rows.len() == 6 && !batch.kept.is_empty();
    assert!(together.iter().all(whole));
    assert_ne!(together[0].rows[5].values, together[1].rows[5].values, "A* PS is smoothed otherwise");
}
