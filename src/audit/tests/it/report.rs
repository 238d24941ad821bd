//! What holds of the audit as a whole: no false alarm, power as stated, and no panic on any text.

use crate::pages::printed;
use crate::simulation::{ROUNDINGS, input};
use rand::{RngExt, SeedableRng, rngs::SmallRng};
use replan_audit::checks::{REGISTRY, find};
use replan_audit::reader::{self, Format, read};
use replan_audit::report::{Class, Finding, Options, Report, audit};
use replan_audit::witness::Budget;
use std::collections::BTreeMap;

pub fn audited(text: &str, format: Format, options: &Options) -> Report {
    let input = read(text, format).unwrap_or_else(|faults| panic!("{faults:?}\n{text}"));
    audit(&input, options).unwrap_or_else(|faults| panic!("{faults:?}\n{text}"))
}

/// Findings that data cannot have: impossible, or a signal that no way to end digits explains.
fn false_alarms(report: &Report) -> Vec<&Finding> {
    let is_wrong = |found: &&Finding| {
        let is_about_ends = found.text.contains("not if digits are rounded to nearest");
        found.class == Class::Impossible || found.class == Class::Signal && !is_about_ends
    };
    report.findings.iter().filter(is_wrong).collect()
}

/// How often each check ran on the inputs of these seeds; it may refuse none of them.
fn runs_on_possible(seeds: std::ops::Range<u64>) -> BTreeMap<&'static str, usize> {
    let options = Options { skips_power: true, ..Options::default() };
    let mut tried = BTreeMap::new();
    for seed in seeds {
        let (text, format) = input(seed);
        let report = audited(&text, format, &options);
        let wrong = false_alarms(&report);
        assert!(wrong.is_empty(), "seed {seed}\n{text}\n{wrong:#?}");
        for (check, tally) in &report.tally {
            *tried.entry(*check).or_default() += tally.applied - tally.unchecked;
        }
    }
    tried
}

/// How many tables are simulated, unless `REPLAN_TABLES` says otherwise.
const TABLES: u64 = 20_000;

#[test]
fn no_table_that_was_printed_from_simulated_data_is_called_impossible() {
    let tables = std::env::var("REPLAN_TABLES").map_or(TABLES, |text| text.parse().unwrap());
    let halves = std::thread::scope(|scope| {
        let halves = [0..tables / 2, tables / 2..tables].map(|seeds| scope.spawn(|| runs_on_possible(seeds)));
        halves.map(|half| half.join().expect("a table is called impossible; its seed stands above"))
    });
    for entry in REGISTRY {
        let count: usize = halves.iter().filter_map(|half| half.get(entry.name)).sum();
        // Turns at any angle take a search each.
        let least = tables as usize / if entry.name == "any_angle_turns" { 100 } else { 20 };
        assert!(count > least, "{} looked {count} times only", entry.name);
    }
}

const EXAMPLES: &str = include_str!("../../../../docs/audit/examples.toml");

#[test]
fn every_check_refuses_its_example() {
    let report = audited(EXAMPLES, Format::Toml, &Options::default());
    for entry in REGISTRY {
        let tally = report.tally.get(entry.name).copied().unwrap_or_default();
        assert!(tally.impossible + tally.signals > 0, "{} refuses nothing in examples.toml", entry.name);
        assert!(find(entry.name).is_some());
    }
    let names: Vec<&str> = REGISTRY.iter().map(|entry| entry.name).collect();
    assert!(names.windows(2).all(|pair| pair[0] < pair[1]), "{names:?}");
}

#[test]
fn an_impossible_finding_has_a_certificate_and_a_signal_has_none() {
    let report = audited(EXAMPLES, Format::Toml, &Options::default());
    for finding in &report.findings {
        assert_eq!(finding.certificate.is_some(), finding.class == Class::Impossible, "{finding:?}");
        assert!(!finding.premises.is_empty());
    }
    let skipped =
        audited(EXAMPLES, Format::Toml, &Options { skips_certificates: true, ..Options::default() });
    let classes = |report: &Report| report.findings.iter().map(|finding| finding.class).collect::<Vec<_>>();
    assert_eq!(classes(&skipped), classes(&report));
    assert!(skipped.findings.iter().all(|finding| finding.certificate.is_none()));
}

#[test]
fn a_mend_is_possible_and_says_whether_the_ranking_changes() {
    let text = "| planner | success [% of 250] |\n|-|-|\n| A | 33.3 |\n| B | 33.2 |\n| C | 35.6 |\n";
    let report = audited(text, Format::Markdown, &Options::default());
    let mend = report.findings[0].mend.clone().unwrap();
    assert_eq!((mend.from.to_string(), mend.to.to_string()), ("33.3".to_owned(), "33.2".to_owned()));
    assert_eq!(mend.changes_ranking, Some(true));
    let mended = audited(&text.replace("33.3", "33.2"), Format::Markdown, &Options::default());
    assert!(!mended.has_impossible());
    let apart = audited(&text.replace("| B | 33.2", "| B | 20.0"), Format::Markdown, &Options::default());
    assert_eq!(apart.findings[0].mend.clone().unwrap().changes_ranking, Some(false));
}

#[test]
fn what_only_cut_digits_allow_is_a_signal() {
    let text = "| planner | success [% of 3] |\n|-|-|\n| A | 66.6 |\n";
    let report = audited(text, Format::Markdown, &Options::default());
    assert_eq!(report.findings[0].class, Class::Signal);
    assert_eq!(report.findings[0].readings, ["truncation", "floor"]);
    let nearest =
        audited(&text.replace("of 3]", "of 3, rounding=nearest]"), Format::Markdown, &Options::default());
    assert_eq!(nearest.findings[0].class, Class::Impossible);
}

#[test]
fn data_behind_a_possible_number_print_it() {
    let text = "[[sample]]\nname = \"x\"\nis = \"integers, n=4, sample\"\nmean = \"2.50\"\nsd = \"1.29\"\n";
    let witness = Some(Budget { most: 5, steps: 10_000, seed: Some(3) });
    let report = audited(text, Format::Toml, &Options { witness, ..Options::default() });
    let found = report.findings.iter().find(|finding| finding.check == "grimmer").unwrap();
    let witness = found.witness.clone().unwrap();
    assert_eq!(witness.vectors, ["1 ×1, 2 ×1, 3 ×1, 4 ×1"]);
    assert!(witness.is_all && witness.steps[0] < witness.steps[1]);
    let none = Some(Budget { most: 5, steps: 3, seed: None });
    let report = audited(text, Format::Toml, &Options { witness: none, ..Options::default() });
    let found = report.findings.iter().find(|finding| finding.check == "grimmer").unwrap();
    assert!(!found.witness.clone().unwrap().is_all);
}

/// A text with one to three random changes.
fn mutated(text: &str, rng: &mut SmallRng) -> String {
    const PIECES: [&str; 24] = [
        "|",
        ",",
        ";",
        "\n",
        "\"",
        "[",
        "]",
        "=",
        "±",
        "−",
        "0",
        "999999999999999",
        "0.000000000000001",
        "1,234",
        "12,5",
        "1e9",
        "n=0",
        "n=",
        "% of 0",
        "digits=15",
        "tick=1/999999999",
        "-",
        "/",
        "\u{feff}",
    ];
    let mut chars: Vec<char> = text.chars().collect();
    for _ in 0..rng.random_range(1..=3) {
        let at = rng.random_range(0..=chars.len());
        match rng.random_range(0..4) {
            0 => chars.truncate(at),
            1 => drop(chars.splice(at..(at + 8).min(chars.len()), [])),
            2 => drop(chars.splice(at..(at + 3).min(chars.len()), PIECES[rng.random_range(0..24)].chars())),
            _ => drop(chars.splice(at..at, PIECES[rng.random_range(0..24)].chars())),
        }
    }
    chars.into_iter().collect()
}

const CSV: &str = "name,success [% of 250],time [mean s, n=50, ±sd],nodes [mean, integers, n=runs],runs [value],\"p, q\" [skip]\n\
    A,33.2,1.5 ± 0.2,12.5,50,\"a, b\"\nB,33.6%,1.50 (0.31),−0.5,8,-\nC,**34.0**,1.50 +/- 0.10,3.25,8,\n";

const MARKDOWN: &str = "Some text.\n\n| planner | Success rate (%) | Time (s) | expanded [mean, integers, n=10] | expanded [sd] |\n\
    |---|---:|:--|---|---|\n| A | 33.3 | 1.2 ± 0.1 | 3.5 | 0.01 |\n| **B** | **40** | n/a | 4.2 | 1.1 |\n";

#[test]
fn no_mutated_input_panics_and_every_fault_has_its_line() {
    let printed = ["vamp", "curobo", "rdt", "zhang", "fu2018", "planar"].map(printed);
    let witness = Some(Budget { most: 2, steps: 200, seed: None });
    let all = std::env::var("REPLAN_MUTATIONS").map_or(3000, |text| text.parse().unwrap());
    let mut read_ones = 0;
    let mut faulty = 0;
    for seed in 0..all {
        let mut rng = SmallRng::seed_from_u64(seed);
        let (simulated, simulated_format) = input(seed);
        let (whole, format) = match seed % 6 {
            0 => (EXAMPLES, Format::Toml),
            1 => (CSV, Format::Csv),
            2 => (MARKDOWN, Format::Markdown),
            3 => (printed[rng.random_range(0..6)].as_str(), Format::Toml),
            _ => (simulated.as_str(), simulated_format),
        };
        // Power asks for a search a print where turns are at any angle.
        let skips_power = format == Format::Toml;
        let options =
            Options { skips_power, keeps_possible: true, witness: witness.clone(), ..Options::default() };
        let text = mutated(whole, &mut rng);
        match read(&text, format).and_then(|input| audit(&input, &options)) {
            Ok(_) => read_ones += 1,
            Err(faults) => {
                faulty += 1;
                let lines = text.lines().count() + 1;
                assert!(
                    faults.iter().all(|fault| (1..=lines).contains(&fault.place.line)),
                    "seed {seed}: {faults:?}\n{text}"
                );
            }
        }
        Format::of_text(&text);
    }
    assert!(read_ones > all / 12 && faulty > all / 12, "{read_ones} read and {faulty} faulty of {all}");
}

/// Wrong input, and how its message begins.
const WRONG: [(&str, Format, &str); 23] = [
    ("a,b [% of 5]\n1,20\n2\n", Format::Csv, "3: 1 cells, where the header has 2"),
    ("a,b [% of 5]\nx,\"1,234\"\n", Format::Csv, "2:2: column `b`: `1,234` may have a thousands separator"),
    ("a;b [% of 5]\nx;12,5\n", Format::Csv, "2:2: column `b`: `12,5` has a decimal comma"),
    ("a,b [% of 0]\nx,1\n", Format::Csv, "1:2: `% of 0` is no item"),
    ("a,b [mean, n=-3]\nx,1\n", Format::Csv, "1:2: `n=-3` is no item"),
    ("a,b [% of runs]\nx,1\n", Format::Csv, "1:2: column `b` names the column `runs`; there are: a, b"),
    ("a,b [value, sum=b+b]\nx,1\n", Format::Csv, "1:2: column `b` names itself; another column is accepted"),
    (
        "a,b [value, ratio=b/a]\nx,1\n",
        Format::Csv,
        "1:2: column `b` names itself; another column is accepted",
    ),
    (
        "a,b [mean, n=m],m\nx,1.5,0\n",
        Format::Csv,
        "2:3: column `m` is the n of column `b`, and here it is `0`; a whole number from 1",
    ),
    (
        "a,b [% of m],m\nx,-,-\ny,20,\n",
        Format::Csv,
        "3:3: column `m` is the n of column `b`, and here it is missing",
    ),
    ("|a|b [% of 5]|\n|-|-|\n|x|1|2|\n", Format::Markdown, "3: 3 cells, where the header has 2"),
    ("|a|b [speed]|\n|-|-|\n|x|1|\n", Format::Markdown, "1:2: `speed` is no item of an annotation"),
    (
        "a,time [mean]\nx,950 ms\ny,1.2 s\n",
        Format::Csv,
        "3:2: column `time`: `1.2 s` has the unit s, and the first number the unit ms; one unit a column",
    ),
    (
        "a,time [value],b [value],both [value, sum=time+b]\nx,950 ms,1 ms,1.2 s\n",
        Format::Csv,
        "2:4: column `both`: `1.2 s` is the sum of numbers such as `950 ms`, in the unit s and in the unit ms; one unit is accepted",
    ),
    (
        "a,b [mean, digits=6]\nx,2.50\n",
        Format::Csv,
        "2:2: column `b`: `2.50` contradicts digits=6, by which a number has 6 digits at most",
    ),
    (
        "[[relation]]\ncheck = \"ratio\"\nvalue = \"2\"\nof = \"950 ms\"\nover = \"1.2 s\"\n",
        Format::Toml,
        "4: relation `ratio`: `of` is `950 ms`; numbers that are held against each other are written without units",
    ),
    (
        "[[sample]]\nname = \"x\"\nmean = \"1.2 s\"\nsd = \"70 ms\"\n",
        Format::Toml,
        "3: sample `x`: `1.2 s` has a unit",
    ),
    ("", Format::Csv, "1: there is no table here"),
    ("words\n", Format::Markdown, "1: there is no table here"),
    (
        "[[relation]]\ncheck = \"magic\"\n",
        Format::Toml,
        "2: check `magic` is no relation; accepted: any_angle_turns, clock",
    ),
    (
        "[[relation]]\ncheck = \"grim\"\nvalue = \"1.2\"\nm = 3\n",
        Format::Toml,
        "4: check `grim` has no key `m`",
    ),
    ("[[sample]]\nname = \"x\"\nmean = 1.2\n", Format::Toml, "3: `1.2` is no text in quotes"),
    ("x = 1\n", Format::Toml, "1: unknown field `x`"),
];

#[test]
fn bad_input_is_reported_with_its_line_and_cell() {
    for (text, format, expected) in WRONG {
        let done = read(text, format).and_then(|input| audit(&input, &Options::default()));
        let faults = done.unwrap_err();
        assert!(faults[0].to_string().starts_with(expected), "{text}\n{expected}\n{}", faults[0]);
    }
    let relation = "\n[[relation]]\ncheck = \"grim\"\nvalue = \"t/A/b\"\nn = 3\n";
    let faults = audit(&read(relation, Format::Toml).unwrap(), &Options::default()).unwrap_err();
    assert_eq!(
        faults[0].to_string(),
        "4: relation `grim`: `value` is `t/A/b`, which is neither a number nor the name of a cell"
    );
}

#[test]
fn a_million_rows_are_read_and_the_faulty_one_is_reported() {
    let mut text = "name,success [% of 250]\n".to_owned();
    for row in 0..1_000_000 {
        text += &format!("p{row},{}\n", ["0.0", "0.4", "0.8", "1.2", "1.6"][row % 5]);
    }
    let input = read(&text, Format::Csv).unwrap();
    assert_eq!(input.tables[0].rows.len(), 1_000_000);
    let report = audit(&input, &Options::default()).unwrap();
    assert_eq!(report.tally["grim"].applied, 1_000_000);
    text += "last,12,5\n";
    let faults = read(&text, Format::Csv).unwrap_err();
    assert_eq!(faults[0].place.line, 1_000_002);
}

#[test]
fn guesses_are_a_header_that_can_be_read() {
    let text = "planner,Success rate (%),Time (s),n\nA,33.3,1.2 ± 0.1,250\nB,12.5,1.3 ± 0.2,250\n";
    let input = read(text, Format::Csv).unwrap();
    let stub = reader::stub(&input.tables[0]);
    assert_eq!(stub[1], "Success rate (%) [% of n, higher is better]");
    assert_eq!(stub[2], "Time (s) [mean, n=n, ±sd, lower is better]");
    let half = read("planner,rate [% of 30],Time (s)\nA,33.3,1.2\n", Format::Csv).unwrap();
    assert_eq!(reader::stub(&half.tables[0])[1], "rate [% of 30]", "what was written stays");
    let corrected = format!("{}\nA,33.3,1.2 ± 0.1,250\n", stub.join(","));
    let report = audited(&corrected, Format::Csv, &Options::default());
    assert!(report.has_impossible(), "{report:?}");
}

#[test]
fn simulated_tables_use_every_rounding() {
    let mut seen: Vec<String> = (0..200)
        .map(|seed| input(4 * seed).0)
        .filter_map(|text| Some(text.split_once("rounding=")?.1.split([',', ']']).next()?.to_owned()))
        .collect();
    seen.sort();
    seen.dedup();
    assert_eq!(seen.len(), ROUNDINGS.len(), "{seen:?}");
}
