//! How often a verdict is wrong: synthetic papers of known truth through the whole engine, criterion by criterion.
//!
//! Each scenario draws records, and what a paper prints, from distributions that are known, and judges the claim as any
//! other. The rates stand in `docs/OPERATING_CHARACTERISTICS.md`; `REPLAN_WRITE=1` writes them, `REPLAN_PAPERS` draws more.

mod censored;
mod means;
mod named;
mod numbers;
mod page;
mod scenario;
mod shares;
mod synthetic;
mod telling;
mod theory;
mod universal;
mod verdicts;

use rayon::prelude::*;
use scenario::{Counts, Scenario};
use std::sync::OnceLock;

/// Papers drawn for a scenario where tests are thorough; the gate draws a tenth, and `REPLAN_PAPERS` says otherwise. The page of rates is
/// of all.
const PAPERS: usize = 250;

fn papers() -> usize {
    let thorough = || if std::env::var_os("REPLAN_THOROUGH").is_some() { PAPERS } else { PAPERS / 10 };
    std::env::var("REPLAN_PAPERS").map_or_else(|_| thorough(), |text| text.parse().unwrap())
}

/// Every scenario, by criterion, with how it came out.
fn outcomes() -> &'static [(Scenario, Counts)] {
    static OUTCOMES: OnceLock<Vec<(Scenario, Counts)>> = OnceLock::new();
    OUTCOMES.get_or_init(|| {
        let mut all = [universal::scenarios(), numbers::scenarios(), shares::scenarios(), means::scenarios()]
            .into_iter()
            .flatten();
        let mut all: Vec<Scenario> = all.by_ref().collect();
        all.sort_by_key(|scenario| scenario.criterion);
        all.into_par_iter().map(|one| (one.run(papers()), one)).map(|(counts, one)| (one, counts)).collect()
    })
}

#[test]
fn no_criterion_errs_more_often_than_theory_allows() {
    let broken: Vec<String> = outcomes().iter().flat_map(|(one, counts)| one.broken(counts)).collect();
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}

#[test]
fn every_criterion_is_tried_where_its_claim_is_true_and_where_it_is_false() {
    for entry in replan::analysis::criterion::REGISTRY {
        let truths: Vec<&str> = outcomes()
            .iter()
            .filter(|(one, _)| one.criterion == entry.name)
            .map(|(one, _)| one.truth)
            .collect();
        for truth in ["true", "false", "false by a little", "underpowered", "fitted", "searched", "censored"]
        {
            assert!(truths.contains(&truth), "{} is not tried {truth}: {truths:?}", entry.name);
        }
    }
}
