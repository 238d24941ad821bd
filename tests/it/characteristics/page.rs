//! The table of rates in `docs/OPERATING_CHARACTERISTICS.md`, held current.

use super::scenario::{Counts, Scenario};
use super::{PAPERS, outcomes, papers};
use replan::analysis::class::Verdict;
use std::fs;
use std::path::Path;

const BEGIN: &str = "<!-- rates: written by the test of operating characteristics -->\n";
const END: &str = "<!-- end of rates -->\n";

const HEAD: &str = "| criterion | truth | what is drawn | for it | direction only | open | against it | false for | false against |\n\
                    |---|---|---|---|---|---|---|---|---|\n";

fn table() -> String {
    let rows = outcomes().iter().map(|(one, counts)| row(one, counts));
    HEAD.to_owned() + &rows.collect::<String>()
}

fn percent(count: usize, of: usize) -> String {
    format!("{:.1}", 100.0 * count as f64 / of as f64)
}

fn row(one: &Scenario, counts: &Counts) -> String {
    let count = |verdicts: &[Verdict]| {
        percent(verdicts.iter().map(|verdict| counts.count(*verdict)).sum(), counts.papers)
    };
    let with = |count: usize, bound: Option<f64>| {
        bound.map_or(String::new(), |bound| {
            format!("{} (≤ {:.1})", percent(count, counts.papers), 100.0 * bound)
        })
    };
    let said = [
        count(&[Verdict::Reproduced, Verdict::Fitted, Verdict::Attainable]),
        count(&[Verdict::DirectionOnly]),
        count(&[Verdict::Undecided, Verdict::Untestable]),
        count(&[Verdict::NotReproduced, Verdict::Impossible]),
        with(counts.false_for, one.bounds.false_for),
        with(counts.false_against, one.bounds.false_against),
    ];
    format!("| `{}` | {} | {} | {} |\n", one.criterion, one.truth, one.about, said.join(" | "))
}

#[test]
fn the_rates_that_are_printed_are_those_found() {
    if papers() != PAPERS {
        return;
    }
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/OPERATING_CHARACTERISTICS.md");
    let text = fs::read_to_string(&path).unwrap();
    let (before, rest) = text.split_once(BEGIN).expect("the page has a place for the rates");
    let (_, after) = rest.split_once(END).expect("the rates end somewhere");
    let page = [before, BEGIN, &table(), END, after].concat();
    if std::env::var_os("REPLAN_WRITE").is_some() {
        fs::write(&path, &page).unwrap();
    }
    assert!(
        fs::read_to_string(&path).unwrap() == page,
        "the rates in docs/OPERATING_CHARACTERISTICS.md are not those found; REPLAN_WRITE=1 writes them"
    );
}
