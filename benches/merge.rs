//! A merge of a million rows: in how many seconds, with how much memory at most, and what rows take on disk.
//!
//! The parts are made up, row by row as a study names them, so that nothing is planned. It ends with a failure if the merge
//! takes more than a minute of one core or 2 GB.

use engine::planner::{Trace, Value};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use study::Inputs;
use study::clock;
use study::key::Owner;
use study::lock::Lock;
use study::manifest::Manifest;
use study::merge::Parts;
use study::paper::Paper;
use study::plan::{Plan, Wanted};
use study::record::{Batch, Kept, PreprocessingRow, Row, Status, Values};
use study::runner::BuiltStudy;
use study::shard::Portion;
use study::store::{Columns, Records, Staged, Traces, stage_records};
use study::unit::Unit;

const INSTANCES: u32 = 500_000;
const SHARDS: usize = 64;
const MOST_SECONDS: f64 = 60.0;
const MOST_BYTES: u64 = 2_000_000_000;

const PAPER: &str = "[source]\ntitle = \"A large run\"\n";

fn study() -> String {
    format!(
        "paper = \"large\"\nquestion = \"None.\"\nseed = 1\n[budget]\nexpansions = 1_000\n[[problems]]\nlabel = \"map\"\nfamily = \
         \"random_cells\"\ninstances = {INSTANCES}\nsettings = {{ size_cells = [9, 9], start = [0, 0], goal = [8, 8], blocked_share = \
         0.2, corner_rule = \"allow\" }}\n[[contender]]\nlabel = \"A\"\nplanner = \"astar\"\nsettings = {{ weight = 1, ties = \
         \"fifo\" }}\n[[contender]]\nlabel = \"B\"\nplanner = \"astar\"\nsettings = {{ weight = 1, ties = \"lifo\" }}\n"
    )
}

/// Made-up records of the units of a portion: numbers as searches have them, and a path of every tenth draw.
fn made_up(built: &BuiltStudy<'_>, units: &[Unit<'_>], portion: &Portion) -> Batch {
    let mut batch = Batch::default();
    for (index, unit) in portion.units.iter().map(|index| (*index, &units[*index])) {
        let real = |scale: f64| Value::Real(scale * (1.0 + (index % 977) as f64 / 3.0));
        let values: Values = [("optimal_cost_cells", real(1.0))].into_iter().collect();
        let key = unit.key.clone();
        let kind = "grid".to_owned();
        let seed = unit.seed;
        batch.preprocessing.push(PreprocessingRow { key, kind, seed, reason: None, values });
        for key in built.trials(unit) {
            if index % 10 == 0 {
                let trace = Trace { name: "path".to_owned(), width: 2, values: vec![index as f64; 24] };
                batch.kept.push(Kept { owner: Owner::from(&key), trace });
            }
            let count = |times: usize| Value::Count((index * times % 4093) as u64);
            let counts = ["opened", "closed", "expansions", "generated", "bends"];
            let reals = ["path_cost_cells", "turn_exterior_deg", "turn_interior_deg"];
            let counts = counts.into_iter().zip(1..).map(|(name, times)| (name, count(times)));
            let values = counts.chain(reals.into_iter().map(|name| (name, real(1.4)))).collect();
            batch.rows.push(Row { key, seed: Some(unit.seed), status: Status::Solved, reason: None, values });
        }
    }
    batch
}

/// What `/proc/self/status` says of `field`, in bytes; none elsewhere than on Linux.
fn memory(field: &str) -> Option<u64> {
    let text = fs::read_to_string("/proc/self/status").ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix(field)?.strip_prefix(':'))?;
    line.split_whitespace().next()?.parse().ok().map(|kilobytes: u64| kilobytes * 1024)
}

/// Seconds that this process has had of a core, by `/proc/self/stat` in its hundredths; none elsewhere than on Linux.
fn core_seconds() -> Option<f64> {
    let text = fs::read_to_string("/proc/self/stat").ok()?;
    let fields: Vec<f64> =
        text.rsplit_once(')')?.1.split_whitespace().filter_map(|field| field.parse().ok()).collect();
    // The first field behind the name is a letter.
    Some((fields.get(10)? + fields.get(11)?) / 100.0)
}

fn bytes(folder: &Path) -> u64 {
    let files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().metadata().unwrap().len());
    files.sum()
}

fn main() {
    let folder = tempfile::tempdir().unwrap();
    let home = folder.path().join("large");
    let parts = folder.path().join("parts");
    let into = folder.path().join("merged");
    fs::create_dir(&home).unwrap();
    fs::write(home.join("paper.toml"), PAPER).unwrap();
    fs::write(home.join("s.toml"), study()).unwrap();
    let inputs = Inputs::below(vec![home.clone()]);
    let paper = Paper::load(&home, &inputs).unwrap();
    let study = &paper.studies[0];
    let points = paper.studies[0].trial_interpretations().unwrap();
    let built = BuiltStudy::new(study, &points, &inputs).unwrap();
    let manifest = Manifest::new(study, &points, &built, String::new(), false).unwrap();
    let studies = [(built, manifest)];
    let wanted = Wanted {
        paper: "large".to_owned(),
        shards: SHARDS,
        quick: false,
        seed: None,
        with: None,
        round: None,
        claims: BTreeMap::new(),
    };
    let (planning, plan) = clock::timed(|| Plan::agreed(&parts, &wanted, &studies).unwrap());
    let columns = Columns::new(study);
    let units: Vec<_> = studies[0].0.units().collect();
    let cut = plan.cut().remove(0);
    let mut part_bytes = 0;
    for number in 1..=SHARDS {
        let mut manifest = studies[0].1.clone();
        let part = plan.part(&parts, number);
        let own = cut.iter().enumerate().filter(|(_, shard)| **shard == number);
        let portion = Portion { shard: plan.shard(number), units: own.map(|(unit, _)| unit).collect() };
        manifest.cut_to(&portion);
        let records = Records { batch: made_up(&studies[0].0, &units, &portion), times: Vec::new() };
        let mut staged = Staged::default();
        let traces = Traces::held(&records.batch.kept);
        manifest.files = stage_records(&mut staged, &part, "s", &columns, &records, traces).unwrap();
        manifest.stage(&mut staged, &part).unwrap();
        staged.put().unwrap();
        part_bytes += bytes(&part);
    }
    drop(units);
    // From here on the most memory is that of the merge.
    let _ = fs::write("/proc/self/clear_refs", "5");
    let lock = Lock::take(&into).unwrap();
    let merge = || {
        let merged = Parts::checked(&plan, &parts, &studies).unwrap();
        merged.merge((0, study), &studies[0].0, studies[0].1.clone(), lock.folder()).unwrap()
    };
    let before = core_seconds();
    let (nanoseconds, rows) = clock::timed(merge);
    let wall = nanoseconds as f64 / 1e9;
    let most = memory("VmHWM").unwrap_or(0);
    // On a machine that others use as well, the time of day says more of them.
    let seconds = core_seconds().zip(before).map_or(wall, |(after, before)| after - before);
    println!("plan of {INSTANCES} units: {:.1} s", planning as f64 / 1e9);
    println!(
        "merge of {rows} rows in {SHARDS} parts: {seconds:.1} s of one core in {wall:.1} s, {:.2} GB at most; {:.1} bytes a row in parts, {:.1} merged",
        most as f64 / 1e9,
        part_bytes as f64 / rows as f64,
        bytes(&into) as f64 / rows as f64
    );
    assert!(
        rows == 1_000_000 && seconds < MOST_SECONDS && most < MOST_BYTES,
        "the merge is too slow or too large"
    );
}
