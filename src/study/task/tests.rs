use crate::Inputs;
use crate::lock::Lock;
use crate::paper::Paper;
use crate::rerun::rerun;
use crate::runner::{BuiltStudy, Unwatched};
use crate::session::{Again, Options, run, run_one};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::sync::atomic::AtomicBool;

const PAPER: &str = "[source]\ntitle = 'a test'\n[prints]\nfigures = 0\ntables = 0\nequations = 0\n";

/// A quarter of the reproduced workspace, one obstacle in each case.
const WORKSPACE: &str = "
seed = 6
paper = 'p'
question = 'q'
[budget]
expansions = 1000
[quick]
instances = 1
[[problems]]
label = 'w'
family = 'arm_workspace'
[problems.settings]
links_cm = [15, 10]
x_cm = [-25, 25]
y_cm = [0, 25]
step_cm = 1
inner_radius_cm = 10
elbow = 'negative_theta2'
touching = 'collides'
hop_check = 'end_points'
corner_rule = 'allow'
obstacle_diameter_cm = 6
obstacle_shapes = ['circle']
obstacles_cm = []
";

const CASES: &str = "
cases = [
  { obstacles_cm = [[3, 17]], hops = [14, 10] },
  { obstacles_cm = [[15, 10]], hops = [12, 11] },
]
variants = [
  { label = 'circles', shape = 'circle', diameter_cm = 6 },
  { label = 'swept', shape = 'circle', diameter_cm = 6, hop_check = 'continuous' },
";

/// Every file of facts that the study `p/s.toml` leaves when it runs on `threads`.
fn facts(folder: &Path, threads: usize) -> BTreeMap<String, Vec<u8>> {
    let inputs = Inputs { roots: vec![folder.join("p")] };
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

/// A paper with one study, whose settings of quick runs are `quick`.
fn with_quick(quick: &str) -> Result<Paper, String> {
    let folder = tempfile::tempdir().unwrap();
    let workspace = WORKSPACE.replace("instances = 1\n", quick);
    let study =
        format!("task = 'identify_endpoints'\n{workspace}\n[task_settings]{CASES}]\nexcess_steps = 2.0\n");
    fs::create_dir(folder.path().join("p")).unwrap();
    fs::write(folder.path().join("p/paper.toml"), PAPER).unwrap();
    fs::write(folder.path().join("p/s.toml"), study).unwrap();
    Paper::load(&folder.path().join("p"), &Inputs::default()).map_err(|e| e.to_string())
}

#[test]
fn a_quick_run_alone_takes_the_budget_clock_and_task_settings_of_quick() {
    let quick = "instances = 1
budget = { expansions = 7 }
timing = { problems = 1, repeats = 1 }
task_settings = { excess_steps = 0.5 }
[timing]
problems = 3
repeats = 4
";
    let shown = |study: &crate::Study| {
        let excess = study.task_settings.table()["excess_steps"].as_float().unwrap();
        (study.budget.expansions, study.timing.map(|timing| timing.repeats), excess)
    };
    let study = with_quick(quick).unwrap().studies.remove(0);
    assert_eq!(shown(&study), (1000, Some(4), 2.0));
    let variants = study.task_settings.table()["variants"].clone();
    let study = study.quick();
    assert_eq!(shown(&study), (7, Some(1), 0.5));
    assert_eq!(study.task_settings.table()["variants"], variants);
    // A study that reads no clock reads none in a quick run either.
    let untimed = with_quick(&quick.replace("[timing]\nproblems = 3\nrepeats = 4\n", "")).unwrap();
    assert_eq!(shown(&untimed.studies.into_iter().next().unwrap().quick()), (7, None, 0.5));
    for (wrong, part) in [
        (quick.replace("expansions = 7", "expansions = 0"), "a whole number from 1 to"),
        (quick.replace("excess_steps = 0.5", "variants = []"), "variants is empty; at least one is accepted"),
        (quick.replace("budget", "budgets"), "budgets"),
    ] {
        let error = with_quick(&wrong).unwrap_err();
        assert!(error.contains(part), "{error}");
    }
}

/// A paper with one study of `task`, with shapes left open and open nodes never lowered among its variants.
fn with_all_variants(task: &str) -> tempfile::TempDir {
    let never = "{ label = 'never', shape = 'circle', diameter_cm = 6, open_node = 'never', ties = 'lifo' },";
    let free = "{ label = 'free', shape = ['circle', 'triangle'], diameter_cm = 6 },";
    let window = if task == "null_rate" { "window_cm = 2.0" } else { "" };
    let settings = format!("{CASES}{never}\n{free}\n]\n{window}\nexcess_steps = 2.0\n");
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("p")).unwrap();
    fs::write(folder.path().join("p/paper.toml"), PAPER).unwrap();
    let study = format!("task = '{task}'\n{WORKSPACE}\n[task_settings]{settings}");
    fs::write(folder.path().join("p/s.toml"), study).unwrap();
    folder
}

#[test]
fn end_points_and_null_rate_are_the_same_bytes_at_any_number_of_threads() {
    for task in ["identify_endpoints", "null_rate"] {
        let folder = with_all_variants(task);
        assert!(facts(folder.path(), 1) == facts(folder.path(), 2), "{task} differs between 1 thread and 2");
    }
}

#[test]
fn single_variants_are_run_again_without_the_others_and_give_the_stored_rows() {
    for (task, part, whole) in
        [("identify_endpoints", "w/free/pair-0", "w/never"), ("null_rate", "w/free", "w/any-of-the-above")]
    {
        let folder = with_all_variants(task);
        facts(folder.path(), 2);
        let inputs = Inputs { roots: vec![folder.path().join("p")] };
        let paper = Paper::load(&folder.path().join("p"), &inputs).unwrap();
        let study = &paper.studies[0];
        let runs = folder.path().join("2");
        let points = study.trial_interpretations().unwrap();
        for trial in ["w/swept", part, whole] {
            let (batch, stored) = run_one(study, &points, &inputs, &runs, trial).unwrap();
            assert_eq!(batch.rows, [stored.expect("it was run")], "{task}: {trial}");
        }
        for wrong in ["w/swe", "w/swept/x", "w/free/pair-9999"] {
            let error = run_one(study, &points, &inputs, &runs, wrong).unwrap_err().to_string();
            assert!(error.contains("its first one is `s/w/circles`"), "{wrong}: {error}");
        }
        let again = rerun(study, &inputs, &runs, 1, 1).unwrap();
        let all = rerun(study, &inputs, &runs, 1_000, 1).unwrap();
        assert!(again.differ.is_empty() && all.differ.is_empty(), "{task}: {again:?}, {all:?}");
        assert!(again.trials > 0 && again.trials < all.trials, "{task}: {again:?}, {all:?}");
    }
}

#[test]
fn a_rerun_names_trials_that_come_out_otherwise_and_those_that_come_no_more() {
    let folder = with_all_variants("null_rate");
    facts(folder.path(), 2);
    let file = folder.path().join("p/s.toml");
    let spec = fs::read_to_string(&file).unwrap();
    for (edited, is_moved) in [
        (spec.clone(), false),
        (spec.replace("diameter_cm = 6", "diameter_cm = 9"), true),
        (spec.replace("label = '", "label = 'other "), true),
    ] {
        fs::write(&file, edited).unwrap();
        let inputs = Inputs { roots: vec![folder.path().join("p")] };
        let paper = Paper::load(&folder.path().join("p"), &inputs).unwrap();
        let again = rerun(&paper.studies[0], &inputs, &folder.path().join("2"), 1_000, 1).unwrap();
        let of_variants = again.differ.iter().filter(|name| !name.ends_with("above")).count();
        assert!(if is_moved { of_variants >= 2 } else { again.differ.is_empty() }, "{again:?}");
    }
}

#[test]
fn variants_that_never_lower_open_nodes_alone_have_ties_and_need_an_excess() {
    let check = |task: &str, variant: &str, close: &str| {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir(folder.path().join("p")).unwrap();
        fs::write(folder.path().join("p/paper.toml"), PAPER).unwrap();
        let variant = format!("{{ label = 'v', diameter_cm = 6, {variant} }}\n]\n");
        let study = format!("task = '{task}'\n{WORKSPACE}\n[task_settings]{CASES}{variant}{close}");
        fs::write(folder.path().join("p/s.toml"), study).unwrap();
        Paper::load(&folder.path().join("p"), &Inputs::default()).map_err(|e| e.to_string())
    };
    let end_points = "excess_steps = 2.0\n";
    let null = "window_cm = 2.0\n";
    let both = format!("{null}{end_points}");
    let never = "shape = 'circle', open_node = 'never', ties = 'lifo'";
    for (task, close) in [("identify_endpoints", end_points), ("null_rate", &*both)] {
        check(task, never, close).unwrap();
        for (variant, part) in [
            ("shape = 'circle', ties = 'lifo'", "variant `v` has ties"),
            (
                "shape = ['circle', 'triangle'], open_node = 'never'",
                "variant `v` leaves shapes open; open nodes",
            ),
        ] {
            let error = check(task, variant, close).unwrap_err();
            assert!(error.contains(part), "{task}: {error}");
        }
    }
    for (close, part) in [
        (null.to_owned(), "variant `v` never lowers open nodes; excess_steps is needed"),
        (format!("{null}excess_steps = -1.0\n"), "excess_steps is -1; 0 and more"),
    ] {
        let error = check("null_rate", never, &close).unwrap_err();
        assert!(error.contains(part), "{error}");
    }
    check("null_rate", "shape = 'square'", null).unwrap();
}

#[test]
fn units_that_share_what_is_prepared_give_what_each_gives_alone() {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    let inputs = Inputs { roots: vec![root.to_owned()] };
    let paper = Paper::load(&root.join("experiments/fu2018"), &inputs).unwrap();
    for name in ["particle", "stages"] {
        let study = paper.study(name).unwrap();
        let points = study.trial_interpretations().unwrap();
        let built = BuiltStudy::new(study, &points[..1], &inputs).unwrap();
        let first = built.units().remove(0);
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
