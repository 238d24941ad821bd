//! Damaged tables and relations, read and audited as `replan audit` does.

use super::damage::damaged;
use super::{cases, fault};
use audit::reader::{Format, read};
use audit::report::{Options, audit};
use audit::witness::Budget;
use base::seed;
use rand::RngExt as _;
use std::fs;
use std::path::Path;

const CSV: &str = "planner,success [% of 250],time [mean, unit=s, n=50, ±sd],nodes [mean, integers, n=runs],runs [value],\"p, q\" [skip]\n\
    A,33.2,1.5 ± 0.2,12.5,50,\"a, b\"\nB,33.6%,1.50 (0.31),−0.5,8,-\nC,**34.0**,1.50 +/- 0.10,3.25,8,\n";

const MARKDOWN: &str = "Some text.\n\n| planner | Success rate (%) | Time (s) | expanded [mean, integers, n=10] | expanded [sd] |\n\
    |---|---:|:--|---|---|\n| A | 33.3 | 1.2 ± 0.1 | 3.5 | 0.01 |\n| **B** | **40** | n/a | 4.2 | 1.1 |\n";

/// What `replan audit` does with a file; a refusal is told as there.
fn audited(name: &str, bytes: &[u8]) -> Result<(), String> {
    let text = std::str::from_utf8(bytes)
        .map_err(|error| format!("{name}: byte {} is not UTF-8", error.valid_up_to()))?;
    let format = name.rsplit_once('.').and_then(|(_, ending)| Format::of_ending(ending)).unwrap();
    let options = Options {
        keeps_possible: true,
        // Its polylines are searched for, a dozen times each for their power.
        skips_power: name == "zhang.toml",
        skips_certificates: false,
        witness: Some(Budget { most: 3, steps: 1000, seed: Some(7) }),
    };
    let done = read(text, format).and_then(|input| audit(&input, &options));
    done.map(|_| ()).map_err(|faults| {
        let lines: Vec<String> = faults.iter().map(|fault| format!("{name}:{fault}")).collect();
        lines.join("\n")
    })
}

#[test]
fn no_damaged_table_panics_the_audit_and_every_refusal_says_where() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/audit");
    let mut files: Vec<(String, Vec<u8>)> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap())
        .map(|entry| (entry.file_name().to_string_lossy().into_owned(), fs::read(entry.path()).unwrap()))
        .collect();
    files.sort();
    files.push(("table.csv".to_owned(), CSV.as_bytes().to_vec()));
    files.push(("table.md".to_owned(), MARKDOWN.as_bytes().to_vec()));
    for (name, bytes) in &files {
        audited(name, bytes).unwrap();
    }
    let (mut faults, mut accepted) = (Vec::new(), 0);
    let all = cases() / 4;
    for case in 0..all {
        let mut stream = seed::stream(seed::derive(2026, &["audit", &case.to_string()]));
        let (name, bytes) = &files[stream.random_range(0..files.len())];
        let bytes = damaged(&mut stream, bytes);
        match fault(|| audited(name, &bytes)) {
            Ok(is_accepted) => accepted += u64::from(is_accepted),
            Err(what) => faults.push(format!("case {case}, {name}: {what}")),
        }
    }
    assert!(faults.is_empty(), "{} of {all} cases:\n{}", faults.len(), faults.join("\n"));
    assert!((all / 10..all * 9 / 10).contains(&accepted), "{accepted} of {all} were accepted");
}
