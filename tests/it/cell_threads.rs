//! A whole study of an arm in its cell, roadmaps included, gives equal bytes at one and at two threads.

use std::fs;
use std::path::Path;
use std::sync::atomic::AtomicBool;
use study::lock::Lock;
use study::runner::Unwatched;
use study::session::{Again, Options, run};
use study::{Inputs, Study};

const STUDY: &str = r#"
paper = "p"
question = "q"
seed = 7
[budget]
expansions = 1_000
[quick]
instances = 1
[[keep]]
problems = "cell"
instances = 2
[[problems]]
label = "cell"
family = "cell_queries"
instances = 5
shared_instances = "shared"
[problems.settings]
robot = "data/robots/motoman_up6.toml"
scene = "data/scenes/fu2018_cell.toml"
queries = "data/scenes/fu2018_groups.toml"
obstacles = true
self_collision = true
samples = 120
counted = "accepted"
region = "around_poses"
radius_mm = 500
path = "tool"
step_mm = 20
step_deg = 4
jump_deg = 20
turn_deg = 180
end = "own"
[[contender]]
label = "Improved A*"
planner = "roadmap_astar"
settings = { samples = 120, neighbour_mm = 500, cost = "hops", goal_shot = "before_expansion", path = "parents" }
then = [{ stage = "straighten", settings = { last = "goal" } }]
[[contender]]
label = "Original A*"
planner = "roadmap_astar"
settings = { samples = 120, neighbour_mm = 500, cost = "hops", goal_shot = "never", path = "parents" }
[[sweep]]
key = "samples"
stage = "roadmap_astar"
values = [60, 120]
"#;

/// The records of the study run with so many threads, by file.
fn records(home: &Path, threads: usize) -> Vec<(String, Vec<u8>)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).to_owned();
    let inputs = Inputs::below(vec![root]);
    let study = Study::load(&home.join("p").join("s.toml"), &inputs).unwrap();
    let folder = home.join(format!("runs{threads}"));
    let points = study.trial_interpretations().unwrap();
    let options = Options {
        lock: &Lock::take(&folder).unwrap(),
        points: &points[..1],
        inputs: &inputs,
        command: String::new(),
        quick: false,
        again: Again { fresh: true, ..Again::default() },
        portion: None,
        threads: Some(threads),
        stop: &AtomicBool::new(false),
        progress: &Unwatched,
    };
    let report = run(&study, &options).unwrap();
    assert_eq!((report.units, report.trials), (5, 200));
    ["trials", "preprocessing", "traces"]
        .map(|part| format!("s.{part}.parquet"))
        .map(|name| (name.clone(), fs::read(folder.join(name)).unwrap()))
        .into()
}

#[test]
fn a_study_of_roadmaps_gives_equal_bytes_at_one_and_two_threads() {
    let home = tempfile::tempdir().unwrap();
    fs::create_dir_all(home.path().join("p")).unwrap();
    fs::write(home.path().join("p").join("s.toml"), STUDY).unwrap();
    let (one, two) = (records(home.path(), 1), records(home.path(), 2));
    for ((name, one), (_, two)) in one.iter().zip(&two) {
        assert!(one == two, "{name} differs: {} and {} bytes", one.len(), two.len());
        assert!(one.len() > 1_000, "{name} has {} bytes", one.len());
    }
}
