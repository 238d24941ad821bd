//! The trial that stands for what speaks against a claim shows it.

use super::synthetic::End::{At, NoPath};
use super::synthetic::{Made, SWEEP, Sample, Synthetic};

/// The outcome of a claim by `criterion` after `records`, and the trial that is named.
fn shown(criterion: &str, settings: &str, made: Made, records: Sample) -> (&'static str, String) {
    let cells = ["low", "high"]
        .map(|id| format!("[[claim]]\nid = \"{id}\"\nat = \"here\"\nprinted = \"0\"\nuntestable = \"it\"\n"));
    let claim = format!(
        "[[claim]]\nid = \"asked\"\nat = \"here\"\nprinted = \"0\"\n[claim.check.{criterion}]\n{settings}\n{}",
        cells.concat()
    );
    let printed = [("low", "7".to_owned()), ("high", "7".to_owned())];
    let judged = Synthetic::new(&claim, made).judgement(records.records(), &printed);
    (judged.outcome.name(), judged.findings[0].trial.clone().unwrap())
}

const OF: &str = "study = \"drawn\", problems = \"map\"";

#[test]
fn against_a_trend_stands_the_trial_that_does_most_against_it() {
    let mut sample = Sample::default();
    for instance in 0..20 {
        sample.instance();
        // The twelfth is farther out than the slope takes it.
        sample.trial("A", At(100.0 - 3.0 * f64::from(instance) - if instance == 11 { 60.0 } else { 0.0 }));
        sample.with("optimal_cost_cells", if instance == 11 { 30.0 } else { f64::from(instance) });
    }
    let settings = format!(
        "select = {{ {OF}, contender = \"A\", metric = \"path_cost_cells\" }}\nover = \"optimal_cost_cells\"\nrising = true"
    );
    let found = shown("trend", &settings, Made::Plainly, sample);
    assert_eq!(found, ("contradicted", "drawn/map/11/a".to_owned()));
}

#[test]
fn along_a_sweep_the_other_alone_solves_the_trial_that_is_named() {
    let mut sample = Sample::default();
    for _ in 0..40 {
        sample.instance();
        for (query, value) in (0..5).flat_map(|query| SWEEP.map(|value| (query, value))) {
            let is_lost = query == 3 && value == SWEEP[2];
            sample.query("A", Some(query), Some(value), if is_lost { NoPath } else { At(1.0) });
            sample.query("B", Some(query), Some(value), At(1.0));
        }
    }
    let settings = format!("is = \"higher\"\nselect = {{ {OF}, contender = \"A\", against = \"B\" }}");
    let found = shown("lower", &settings, Made::Swept, sample);
    assert_eq!(found, ("contradicted", "drawn/map/0/3/a/weight=3".to_owned()));
}

#[test]
fn beside_a_row_that_no_instance_is_like_stands_the_instance_that_is_most_like_it() {
    let mut sample = Sample::default();
    for instance in 0..60 {
        sample.instance();
        let cost = 100.0 + f64::from(instance * 7 % 60) - if instance == 17 { 90.0 } else { 0.0 };
        sample.query("A", Some(0), None, At(cost));
        sample.query("A", Some(1), None, At(cost + 1.0));
    }
    let rows =
        "[{ contender = \"A\", statistics = [\"least\", \"greatest\"], claims = [\"low\", \"high\"] }]";
    let settings =
        format!("select = {{ {OF}, metric = \"path_cost_cells\" }}\nrows = {rows}\nrefused_below = 0.05");
    let found = shown("row_one_instance", &settings, Made::Plainly, sample);
    assert_eq!(found, ("contradicted", "drawn/map/17/0/a".to_owned()));
}

#[test]
fn against_a_difference_stands_a_problem_that_should_have_given_another_number() {
    let mut sample = Sample::default();
    for group in ["map", "other"] {
        sample.instance_on(group);
        sample.trial("A", At(5.0));
    }
    let settings = "metric = \"path_cost_cells\"\ncontenders = \"A\"\nin = [{ study = \"drawn\", problems = [\"map\", \"other\"] }]\ndiffer = [[\"map\", \"other\"]]";
    let found = shown("exists", settings, Made::Plainly, sample);
    assert_eq!(found, ("contradicted", "drawn/other/1/a".to_owned()));
}
