//! Rules: arithmetic and geometry of printed numbers alone; one a file, all in [`REGISTRY`].
//!
//! A rule proves that a claim cannot be, or says that it can; it looks at no trial. The proof and its words are the package
//! [`proofs::proof`]'s: a rule looks up what the claim names and asks for it.

mod at_most;
mod clock_ticks;
mod count_bound;
mod formula;
mod joint_length_turn;
mod largest_saving;
mod lattice_length;
mod percentage;
mod point_distance;
mod straight_line;
mod turn_needs_length;

use super::criterion::{Criterion, Entry};
use super::criterion_result::CriterionResult;
use super::evidence::Evidence;
use super::number::Number;
use super::outcome::Outcome;
use super::polylines::Polylines;
use super::verdict::POSSIBLE;
use proofs::proof::Proof;

/// A rule: a criterion that selects no trial. Polylines only remember what other claims needed.
struct Rule<F>(F);

impl<F: Fn(&Polylines, bool) -> CriterionResult> Criterion for Rule<F> {
    fn numbers(&self, _evidence: &Evidence<'_>) -> Vec<Number> {
        Vec::new()
    }

    fn weigh(&self, _numbers: &[Number]) -> CriterionResult {
        CriterionResult::default()
    }

    fn proof(&self, polylines: &Polylines, is_explained: bool) -> Option<CriterionResult> {
        Some((self.0)(polylines, is_explained))
    }
}

/// The rule that finds this.
fn rule<'a>(find: impl Fn(&Polylines, bool) -> CriterionResult + 'a) -> Box<dyn Criterion + 'a> {
    Box::new(Rule(find))
}

/// What a proof finds that can only refuse: that something is possible does not make it so.
fn refused(proof: Proof) -> CriterionResult {
    refused_or(proof, "arithmetic does not refuse it")
}

/// The same, with what is possible in words.
fn refused_or(proof: Proof, possible: &str) -> CriterionResult {
    let outcome = (!proof.is_possible).then_some(Outcome::Proved);
    let possible = proof.is_possible.then(|| format!("{POSSIBLE}{possible}"));
    let because = proof.because.into_iter().chain(possible).collect();
    CriterionResult { outcome, because, premises: proof.premises, ..CriterionResult::default() }
}

/// What a proof finds that decides either way.
fn decided(proof: Proof) -> CriterionResult {
    let outcome = if proof.is_possible { Outcome::Holds } else { Outcome::Proved };
    CriterionResult {
        outcome: Some(outcome),
        because: proof.because,
        premises: proof.premises,
        ..CriterionResult::default()
    }
}

/// Every rule, in the order of their names.
pub static REGISTRY: &[&Entry] = &[
    &at_most::ENTRY,
    &clock_ticks::ENTRY,
    &count_bound::ENTRY,
    &formula::ENTRY,
    &joint_length_turn::ENTRY,
    &largest_saving::ENTRY,
    &lattice_length::ENTRY,
    &percentage::ENTRY,
    &point_distance::ENTRY,
    &straight_line::ENTRY,
    &turn_needs_length::ENTRY,
];

/// The rule called `name`.
pub fn find(name: &str) -> Option<&'static Entry> {
    REGISTRY.iter().copied().find(|entry| entry.name == name)
}
