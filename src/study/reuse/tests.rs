use crate::key::Owner;
use crate::lock::Lock;
use crate::manifest::Manifest;
use crate::paper::Paper;
use crate::record::Row;
use crate::session::{Again, Options, Report, run};
use crate::store::{Columns, Records, Staged, Traces, read_records, stage_records};
use crate::{Inputs, runner::Unwatched};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

const PAPER: &str = "
[source]
title = 'a test'
[prints]
figures = 0
tables = 0
equations = 0
[[choice]]
id = 'corners'
why = 'w'
default = 'allow'
option.allow = { problem = { corner_rule = 'allow' } }
option.forbid = { problem = { corner_rule = 'forbid_any' } }
";

const STUDY: &str = "
paper = 'p'
question = 'q'
seed = 4
[budget]
expansions = 10_000
[quick]
instances = 1
[[keep]]
problems = 'maps'
instances = 2
[[problems]]
label = 'maps'
family = 'random_cells'
instances = 6
settings = { size_cells = [30, 30], start = [22, 15], goal = [26, 28], blocked_share = 0.2, corner_rule = 'allow' }
[[problems]]
label = 'drawn'
family = 'grid_map'
settings = { map = 'drawn.txt', start = [0, 0], goal = [2, 2], corner_rule = 'allow' }
[[contender]]
label = 'first'
planner = 'astar'
settings = { weight = 1, ties = 'fifo' }
[[contender]]
label = 'second'
planner = 'astar'
settings = { weight = 2, ties = 'fifo' }
then = [{ stage = 'delete_inflections', settings = { line_of_sight = 'exact_interior' } }]
";

const THIRD: &str =
    "[[contender]]\nlabel = 'third'\nplanner = 'astar'\nsettings = { weight = 3, ties = 'fifo' }\n";

/// The paper `p` in a folder of its own.
struct House(tempfile::TempDir);

impl House {
    fn new() -> Self {
        let house = Self(tempfile::tempdir().unwrap());
        fs::create_dir(house.at("p")).unwrap();
        fs::write(house.at("p/paper.toml"), PAPER).unwrap();
        fs::write(house.at("p/drawn.txt"), "...\n.#.\n...\n").unwrap();
        house
    }

    fn at(&self, path: &str) -> PathBuf {
        self.0.path().join(path)
    }

    /// Runs the study `spec` of the paper whose folder is spelled `folder`, with the records in `out`.
    fn run_in(&self, folder: &Path, spec: &str, out: &str) -> Report {
        fs::write(self.at("p/s.toml"), spec).unwrap();
        let inputs = Inputs::below(vec![folder.to_owned(), PathBuf::new()]);
        let paper = Paper::load(folder, &inputs).unwrap();
        let points = paper.studies[0].trial_interpretations().unwrap();
        let options = Options {
            lock: &Lock::take(&self.at(out)).unwrap(),
            points: &points,
            inputs: &inputs,
            command: String::new(),
            quick: false,
            again: Again::default(),
            portion: None,
            threads: Some(1),
            stop: &AtomicBool::new(false),
            progress: &Unwatched,
        };
        run(&paper.studies[0], &options).unwrap()
    }

    fn run(&self, spec: &str, out: &str) -> Report {
        self.run_in(&self.at("p"), spec, out)
    }

    /// Puts `records` in the place of what a run of [`STUDY`] left in `folder`.
    fn rewrite(&self, folder: &Path, records: &Records) {
        let paper = Paper::load(&self.at("p"), &Inputs::below(vec![self.at("p")])).unwrap();
        let study = &paper.studies[0];
        let columns = Columns::new(study);
        let mut staged = Staged::default();
        let mut manifest = Manifest::read(folder, "s").unwrap();
        manifest.files =
            stage_records(&mut staged, folder, "s", &columns, records, Traces::held(&records.batch.kept))
                .unwrap();
        manifest.stage(&mut staged, folder).unwrap();
        staged.put().unwrap();
    }

    fn facts(&self, out: &str) -> BTreeMap<&'static str, Vec<u8>> {
        let read = |part| (part, fs::read(self.at(out).join(format!("s.{part}.parquet"))).unwrap());
        ["trials", "preprocessing", "traces"].map(read).into()
    }

    fn records(&self, out: &str) -> Records {
        let manifest = Manifest::read(&self.at(out), "s").unwrap();
        read_records(&self.at(out), "s", &manifest.files).unwrap()
    }
}

/// `spec` with its two contenders in the other order.
fn reordered(spec: &str) -> String {
    let (head, rest) = spec.split_once("[[contender]]\nlabel = 'first'").unwrap();
    let (first, second) = rest.split_once("[[contender]]").unwrap();
    format!("{head}[[contender]]{second}[[contender]]\nlabel = 'first'{first}")
}

/// Changes: name, changed spec, reasons reported, and how many of the 14 trials of each contender are kept besides whole units.
fn changes() -> Vec<(&'static str, String, Vec<&'static str>, usize)> {
    vec![
        (
            "settings",
            STUDY.replace("weight = 2", "weight = 4"),
            vec!["contender `second` has changed under 2 of 2 interpretations"],
            14,
        ),
        (
            "a stage",
            STUDY.replace("then = [{ stage = 'delete_inflections', settings = { line_of_sight = 'exact_interior' } }]\n", ""),
            vec!["contender `second` has changed under 2 of 2 interpretations"],
            14,
        ),
        (
            "a label",
            STUDY.replace("label = 'second'", "label = 'other'"),
            vec!["contender `other` is new", "contender `second` is gone"],
            14,
        ),
        (
            "one more",
            format!("{STUDY}{THIRD}"),
            vec!["contender `third` is new"],
            28,
        ),
        (
            "one less",
            STUDY[..STUDY.find("[[contender]]\nlabel = 'second'").unwrap()].to_owned(),
            vec!["contender `second` is gone"],
            0,
        ),
        ("their order", reordered(STUDY), vec![], 0),
    ]
}

#[test]
fn a_changed_contender_runs_alone_and_the_records_are_those_of_a_fresh_run() {
    for (what, spec, why, kept) in changes() {
        let house = House::new();
        let first = house.run(STUDY, "runs");
        assert_eq!((first.trials, first.reused, first.kept), (28, 0, 0));
        let again = house.run(&spec, "runs");
        assert_eq!((again.why, again.kept), (why.into_iter().map(str::to_owned).collect(), kept), "{what}");
        assert_eq!(again.reused, if kept == 0 { again.units } else { 0 }, "{what}");
        house.run(&spec, "fresh");
        assert!(house.facts("runs") == house.facts("fresh"), "{what}: reuse gave other records than a run");
        assert!(!house.records("runs").batch.kept.is_empty(), "{what}: no trace was kept");
    }
}

#[test]
fn trials_of_a_contender_that_has_not_changed_are_taken_as_they_are_stored() {
    let house = House::new();
    house.run(STUDY, "runs");
    // A mark that no run would leave shows which rows were taken over.
    let folder = house.at("runs");
    let mut records = house.records("runs");
    records.batch.rows.iter_mut().for_each(|row| row.seed = Some(1));
    house.rewrite(&folder, &records);
    house.run(&STUDY.replace("weight = 2", "weight = 4"), "runs");
    let rows = house.records("runs").batch.rows;
    let of = |label: &str| rows.iter().filter(|row| *row.key.contender == *label).collect::<Vec<&Row>>();
    assert_eq!((of("first").len(), of("second").len()), (14, 14));
    assert!(of("first").iter().all(|row| row.seed == Some(1)), "a trial ran again");
    assert!(of("second").iter().all(|row| row.seed != Some(1)), "a trial did not run");
}

#[test]
fn a_papers_folder_spelled_otherwise_reruns_nothing_and_another_map_reruns_its_group() {
    let house = House::new();
    house.run(STUDY, "runs");
    for folder in ["p/../p", "./p", "p/."] {
        let again = house.run_in(&house.at(folder), STUDY, "runs");
        assert_eq!((again.reused, again.why.len()), (again.units, 0), "{folder}: {:?}", again.why);
    }
    fs::write(house.at("p/drawn.txt"), "...\n...\n...\n").unwrap();
    let other = house.run(STUDY, "runs");
    assert_eq!(other.why, ["problem group `drawn` has changed under 2 of 2 interpretations"]);
    assert_eq!((other.reused, other.units), (12, 14));
}

#[test]
fn instances_are_kept_by_their_numbers_too_and_no_others() {
    let house = House::new();
    let kept = |out: &str| -> BTreeSet<u32> {
        let kept = house.records(out).batch.kept.into_iter();
        kept.filter_map(|kept| match kept.owner {
            Owner::Trial(key) if *key.on.group == *"maps" => Some(key.on.instance),
            _ => None,
        })
        .collect()
    };
    house.run(STUDY, "runs");
    assert_eq!(kept("runs"), BTreeSet::from([0, 1]));
    let also = STUDY.replace("instances = 2", "instances = 2\nalso = [4]");
    let again = house.run(&also, "runs");
    assert_eq!(again.reused, 0, "a spec that keeps another instance takes over none that it lacks");
    assert_eq!(kept("runs"), BTreeSet::from([0, 1, 4]));
}

#[test]
fn of_a_trial_only_the_traces_that_are_named_are_kept() {
    let house = House::new();
    let named = STUDY.replace("instances = 2", "instances = 2\ntraces = ['path']");
    let names = |out: &str| -> BTreeSet<String> {
        let kept = house.records(out).batch.kept.into_iter();
        let of_trials = kept.filter(|kept| matches!(kept.owner, Owner::Trial(_)));
        of_trials.map(|kept| kept.trace.name).collect()
    };
    house.run(STUDY, "runs");
    house.run(&named, "named");
    assert!(names("runs").len() > 1 && names("runs").contains("path"));
    assert_eq!(names("named"), BTreeSet::from(["path".to_owned()]));
    assert!(house.records("runs").batch.rows == house.records("named").batch.rows);
    let again = house.run(&named, "runs");
    assert_eq!(again.reused, 0, "a spec that keeps other traces takes over none");
    assert!(house.facts("runs") == house.facts("named"));
}
