//! How the time of reading and judging a paper grows with its claims, choices and studies.
//!
//! The papers are made up, and so are their records: nothing is planned. Each line ends with the exponent of a power of the
//! size fitted to the times. `REPLAN_GROWTH=1000` leaves larger sizes out. `cargo test` runs the smallest alone: there only that each
//! claim gets a verdict counts.

use engine::planner::Value;
use replan::analysis::claims::judge;
use replan::analysis::evidence::{Evidence, default_point};
use std::collections::BTreeMap;
use std::fs;
use std::hint::black_box;
use study::Inputs;
use study::clock;
use study::manifest::Manifest;
use study::paper::Paper;
use study::record::{Batch, Row, Status};
use study::runner::BuiltStudy;
use study::store::Records;

const SIZES: [usize; 3] = [100, 1_000, 10_000];
/// Each interpretation names an option of every choice: ten times the choices are a hundred times the names.
const CHOICES: [usize; 3] = [10, 100, 1_000];
const GROUPS: usize = 20;

fn study(groups: usize) -> String {
    let mut text =
        "paper = \"grown\"\nquestion = \"None.\"\nseed = 1\n[budget]\nexpansions = 1_000\n".to_owned();
    for group in 0..groups {
        text += &format!(
            "[[problems]]\nlabel = \"m{group}\"\nfamily = \"random_cells\"\ninstances = 3\nsettings = {{ size_cells = [9, 9], start = \
             [0, 0], goal = [8, 8], blocked_share = 0.2, corner_rule = \"allow\" }}\n"
        );
    }
    for (label, ties) in [("A", "fifo"), ("B", "lifo")] {
        text += &format!(
            "[[contender]]\nlabel = \"{label}\"\nplanner = \"astar\"\nsettings = {{ weight = 1, ties = \"{ties}\" }}\n"
        );
    }
    text
}

/// Claims in turn about two kinds of numbers, many of which ask the same.
fn claims(count: usize) -> String {
    let claim = |index: usize| {
        let group = index % GROUPS;
        let criterion = if index % 40 < 20 {
            format!(
                "printed = \"{}\"\n[claim.check.exists]\nmetric = \"opened\"\ncontenders = [\"A\", \"B\"]\nin = [{{ study = \"s0\", problems \
                 = \"m{group}\" }}]\n",
                index % 37
            )
        } else {
            format!(
                "[claim.check.lower]\nselect = {{ study = \"s0\", problems = \"m{group}\", contender = \"B\", against = \"A\", metric = \
                 \"opened\" }}\n"
            )
        };
        format!("[[claim]]\nid = \"c{index}\"\nat = \"row {index}\"\nsays = \"nodes\"\n{criterion}")
    };
    (0..count).map(claim).collect()
}

fn choices(count: usize) -> String {
    let choice = |index: usize| {
        format!(
            "[[choice]]\nid = \"o{index}\"\nwhy = \"open\"\ndefault = \"a\"\n[choice.option]\na = {{ metric = {{ m{index} = \"opened\" }} }}\nb \
             = {{ metric = {{ m{index} = \"closed\" }} }}\n"
        )
    };
    (0..count).map(choice).collect()
}

/// Made-up records of `study`.
fn records(study: &study::Study, inputs: &Inputs) -> (Manifest, Records) {
    let points = study.trial_interpretations().unwrap();
    let built = BuiltStudy::new(study, &points, inputs).unwrap();
    let manifest = Manifest::new(study, &points, &built, String::new(), false).unwrap();
    let mut batch = Batch::default();
    for (index, unit) in built.units().enumerate() {
        for (place, key) in built.trials(&unit).into_iter().enumerate() {
            let opened = Value::Count((index * 7 + place) as u64 % 37);
            let values = [("opened", opened)].into_iter().collect();
            batch.rows.push(Row { key, seed: Some(unit.seed), status: Status::Solved, reason: None, values });
        }
    }
    (manifest, Records { batch, times: Vec::new() })
}

/// Seconds to read a paper of `text` with so many studies, and to judge its claims.
fn seconds(text: &str, studies: usize, groups: usize) -> [f64; 2] {
    let folder = tempfile::tempdir().unwrap();
    let home = folder.path().join("grown");
    fs::create_dir(&home).unwrap();
    fs::write(home.join("paper.toml"), format!("[source]\ntitle = \"Growth\"\n{text}")).unwrap();
    for number in 0..studies {
        fs::write(home.join(format!("s{number}.toml")), study(groups)).unwrap();
    }
    let inputs = Inputs::below(vec![home.clone()]);
    let (reading, paper) = clock::timed(|| Paper::load(&home, &inputs).unwrap());
    let stored = BTreeMap::from([("s0".to_owned(), records(&paper.studies[0], &inputs))]);
    let evidence = Evidence::held(&paper, default_point(&paper), stored);
    let (judging, verdicts) = clock::timed(|| judge(&evidence).unwrap());
    assert_eq!(black_box(verdicts).claims.len(), paper.claims.len());
    [reading, judging].map(|nanoseconds| nanoseconds as f64 / 1e9)
}

/// The exponent of the power of the size that fits the times best.
fn exponent(points: &[(usize, f64)]) -> f64 {
    let logs: Vec<[f64; 2]> =
        points.iter().map(|(size, time)| [*size as f64, *time].map(libm::log)).collect();
    let mean = |at: usize| logs.iter().map(|log| log[at]).sum::<f64>() / logs.len() as f64;
    let [x, y] = [mean(0), mean(1)];
    let along: f64 = logs.iter().map(|log| (log[0] - x) * (log[1] - y)).sum();
    along / logs.iter().map(|log| (log[0] - x).powi(2)).sum::<f64>()
}

fn main() {
    let is_bench = std::env::args().any(|argument| argument == "--bench");
    let otherwise = if is_bench { usize::MAX } else { SIZES[0] };
    let most = std::env::var("REPLAN_GROWTH").map_or(otherwise, |most| most.parse().unwrap());
    let kinds: [(&str, [usize; 3], fn(usize) -> [f64; 2]); 3] = [
        ("claims", SIZES, |size| seconds(&claims(size), 1, GROUPS)),
        ("choices", CHOICES, |size| seconds(&choices(size), 1, 1)),
        ("studies", SIZES, |size| seconds("", size, 1)),
    ];
    for (kind, sizes, of) in kinds {
        let measured: Vec<(usize, [f64; 2])> =
            sizes.into_iter().filter(|size| *size <= most).map(|size| (size, of(size))).collect();
        for (at, what) in ["read", "judge"].into_iter().enumerate() {
            let points: Vec<(usize, f64)> = measured.iter().map(|(size, times)| (*size, times[at])).collect();
            let times: Vec<String> =
                points.iter().map(|(size, time)| format!("{size}: {time:.4} s")).collect();
            println!("{kind}, {what}: {}; exponent {:.2}", times.join(", "), exponent(&points));
        }
    }
}
