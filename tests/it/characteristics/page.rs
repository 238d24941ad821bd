//! The tables of rates in `docs/OPERATING_CHARACTERISTICS.md`, held current.

use super::scenario::{Counts, Scenario};
use super::{PAPERS, outcomes, papers, verdicts};
use replan::analysis::outcome::Outcome;
use std::fs;
use std::path::Path;

/// The marks around each table.
const RATES: [&str; 2] =
    ["<!-- rates: written by the test of operating characteristics -->\n", "<!-- end of rates -->\n"];
const VERDICTS: [&str; 2] =
    ["<!-- verdicts: written by the test of operating characteristics -->\n", "<!-- end of verdicts -->\n"];

const HEAD: &str = "| criterion | truth | what is drawn | for it | right in direction | open | against it | false for | false against |\n\
                    |---|---|---|---|---|---|---|---|---|\n";

fn table() -> String {
    let rows = outcomes().iter().map(|(one, counts)| row(one, counts));
    HEAD.to_owned() + &rows.collect::<String>()
}

fn percent(count: usize, of: usize) -> String {
    format!("{:.1}", 100.0 * count as f64 / of as f64)
}

fn row(one: &Scenario, counts: &Counts) -> String {
    let count = |outcomes: &[Outcome]| {
        percent(outcomes.iter().map(|outcome| counts.count(*outcome)).sum(), counts.papers)
    };
    let with = |count: usize, bound: Option<f64>| {
        bound.map_or(String::new(), |bound| {
            format!("{} (≤ {:.1})", percent(count, counts.papers), 100.0 * bound)
        })
    };
    let text = [
        count(&[Outcome::Holds, Outcome::Fitted, Outcome::Attainable]),
        count(&[Outcome::SignOnly]),
        count(&[Outcome::Open, Outcome::Lacking]),
        count(&[Outcome::Fails, Outcome::Proved]),
        with(counts.false_for, one.bounds.false_for),
        with(counts.false_against, one.bounds.false_against),
    ];
    format!("| `{}` | {} | {} | {} |\n", one.criterion, one.truth, one.about, text.join(" | "))
}

/// The page with a table between its marks.
fn with(text: &str, [begin, end]: [&str; 2], table: &str) -> String {
    let (before, rest) = text.split_once(begin).expect("the page has a place for the table");
    let (_, after) = rest.split_once(end).expect("the table ends somewhere");
    [before, begin, table, end, after].concat()
}

#[test]
fn the_rates_that_are_printed_are_those_found() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/OPERATING_CHARACTERISTICS.md");
    let text = fs::read_to_string(&path).unwrap();
    let mut page = with(&text, VERDICTS, &verdicts::table());
    // A tenth of the papers gives other rates of criteria.
    if papers() == PAPERS {
        page = with(&page, RATES, &table());
    }
    if std::env::var_os("REPLAN_WRITE").is_some() {
        fs::write(&path, &page).unwrap();
    }
    assert!(
        fs::read_to_string(&path).unwrap() == page,
        "the rates in docs/OPERATING_CHARACTERISTICS.md are not those found; REPLAN_WRITE=1 writes them"
    );
}
