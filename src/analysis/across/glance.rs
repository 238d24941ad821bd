//! What is found about every claim under one interpretation, in the few numbers that are stored.

use super::super::claims::{self, CappedFinding};
use super::super::evidence::Evidence;
use super::super::outcome::{self, Caps, Outcome, Polarity};
use base::hash::sha256;
use base::settings::SettingsError;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use study::paper::Claim;

/// Whether an outcome says something of a claim under an interpretation, the least first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Sight {
    /// The claim is not meant there.
    Unmeant,
    /// Its trials did not run under the interpretation, or the clock was not read.
    Unexplored,
    /// There are too few instances, hardly any printed value could have been refused, or no problem could be posed.
    Powerless,
    /// It was looked at.
    Looked,
}

/// A claim under one interpretation.
#[derive(Debug, Clone, PartialEq)]
pub struct Glance {
    /// Its outcome there.
    pub outcome: Outcome,
    /// Whether that says something.
    pub sight: Sight,
    /// One witness would do.
    pub existential: bool,
    /// Our number with its interval, and of how many instances.
    pub ours: Option<(f64, Option<[f64; 2]>, usize)>,
    /// The share of the paths that come back which the verifier refuses.
    pub refused: f64,
    /// A hash of the results that it rests on.
    pub results: String,
    /// The studies that it looks at.
    pub studies: BTreeSet<String>,
}

/// Every claim under the evidence's interpretation, by id.
///
/// # Errors
/// Those of [`validate`](claims::validate).
pub fn glances(evidence: &Evidence<'_>) -> Result<BTreeMap<String, Glance>, SettingsError> {
    let paper = evidence.paper;
    let alone = |claim: &Claim| {
        let glance = alone(claim, &claims::capped_findings(evidence, claim, true)?);
        Ok((claim.id.clone(), meant(evidence, claim, glance)))
    };
    // Gathered in order before any error is passed on, so that it is the first claim's.
    let found: Vec<Result<_, SettingsError>> = paper.claims.par_iter().map(alone).collect();
    Ok(with_parts(evidence, found.into_iter().collect::<Result<_, _>>()?))
}

/// `glance`, but that nothing is found where the claim is not meant.
fn meant(evidence: &Evidence<'_>, claim: &Claim, glance: Glance) -> Glance {
    if claim.is_meant(&evidence.point) {
        return glance;
    }
    let outcome = outcome::combined([], claim.untestable.is_some());
    Glance { outcome, sight: Sight::Unmeant, ours: None, results: String::new(), ..glance }
}

fn alone(claim: &Claim, weighed: &[CappedFinding]) -> Glance {
    let decides = |one: &&CappedFinding| one.finding.outcome.is_some();
    let outcomes = weighed.iter().filter_map(|one| one.finding.outcome);
    let outcome = outcome::combined(outcomes, claim.untestable.is_some());
    let deciding: Vec<&CappedFinding> =
        weighed.iter().filter(|one| one.finding.outcome == Some(outcome)).collect();
    let sight = deciding.iter().map(|one| sight(one, outcome)).max().unwrap_or(Sight::Looked);
    let ours = deciding.iter().find_map(|one| one.finding.ours.as_ref());
    let existential = weighed.iter().any(|one| decides(&one))
        && weighed.iter().filter(decides).all(|one| one.caps.existential);
    Glance {
        outcome,
        sight,
        existential,
        ours: ours.map(|ours| (ours.value, ours.interval, ours.n)),
        refused: weighed.iter().filter(decides).map(|one| one.refused).fold(0.0, f64::max),
        results: digest(weighed),
        studies: weighed.iter().filter(decides).flat_map(|one| one.studies.iter().cloned()).collect(),
    }
}

/// What the findings that decide rest on, and what they say: interpretations that only change what a name means move these.
fn digest(weighed: &[CappedFinding]) -> String {
    let decides = weighed.iter().filter(|one| one.finding.outcome.is_some());
    let said = |one: &CappedFinding| {
        let ours = one.finding.ours.as_ref().map(|ours| (ours.value.to_bits(), ours.n));
        format!("{} {:?} {ours:?} {}\n", one.finding.criterion, one.finding.outcome, one.results)
    };
    sha256(decides.map(said).collect::<String>().as_bytes())[..12].to_owned()
}

fn sight(one: &CappedFinding, outcome: Outcome) -> Sight {
    let Caps { powerless, few, clock, .. } = one.caps;
    if !one.is_covered || clock.is_some() {
        Sight::Unexplored
    } else if outcome == Outcome::Open && (powerless || few || !one.is_posed) {
        Sight::Powerless
    } else {
        Sight::Looked
    }
}

/// Sentences of parts and rows of cells take what they are from theirs.
fn with_parts(evidence: &Evidence<'_>, mut glances: BTreeMap<String, Glance>) -> BTreeMap<String, Glance> {
    let alone = glances.clone();
    for claim in &evidence.paper.claims {
        let Some((_, of, ids)) = claims::of_parts(claim) else { continue };
        let parts: Vec<&Glance> = ids.iter().map(|id| &alone[id]).collect();
        let of_parts = of(&parts.iter().map(|part| part.outcome).collect::<Vec<_>>());
        let own = &alone[&claim.id];
        let found = claim.tests().next().map(|_| own.outcome).into_iter().chain([of_parts]);
        let outcome = outcome::combined(found, claim.untestable.is_some());
        let alike = |part: &&&Glance| part.outcome.polarity() == outcome.polarity();
        let mut speaks: Vec<&&Glance> = parts.iter().filter(alike).collect();
        if speaks.is_empty() {
            speaks = parts.iter().collect();
        }
        // A sentence that all parts must meet is looked at only where all of them are.
        let sights = speaks.iter().map(|part| part.sight);
        let sight = if outcome.polarity() == Polarity::For { sights.min() } else { sights.max() };
        let results: String = parts.iter().map(|part| part.results.as_str()).chain([&*own.results]).collect();
        let whole = Glance {
            outcome,
            sight: sight.unwrap_or(Sight::Looked),
            existential: parts.iter().all(|part| part.existential),
            ours: None,
            refused: parts.iter().map(|part| part.refused).fold(0.0, f64::max),
            results: sha256(results.as_bytes())[..12].to_owned(),
            studies: parts.iter().flat_map(|part| part.studies.iter().cloned()).collect(),
        };
        glances.insert(claim.id.clone(), meant(evidence, claim, whole));
    }
    glances
}
