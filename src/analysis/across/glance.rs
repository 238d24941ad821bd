//! The outcome of every claim under each interpretation, from stored numbers.

use super::super::claim_test::{CappedFinding, ClaimTest, claim_tests};
use super::super::claims;
use super::super::estimates::with_refused;
use super::super::number::Numbers;
use super::super::outcome::{self, Caps, Outcome, Polarity};
use super::super::polylines::Polylines;
use base::hash::sha256;
use base::settings::SettingsError;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use study::Interpretation;
use study::paper::{Claim, Paper};

/// Whether an outcome says something of a claim under an interpretation, the least first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Sight {
    /// The paper does not mean the claim under this interpretation.
    Unmeant,
    /// Its trials did not run under the interpretation, or the clock was not read.
    Unexplored,
    /// Almost any printed value would fit, or no problem could be posed.
    Powerless,
    /// There are too few instances; more may say something.
    Few,
    /// It was looked at.
    Looked,
}

impl Sight {
    /// Whether the trials ran and say nothing.
    pub fn is_powerless(self) -> bool {
        matches!(self, Self::Powerless | Self::Few)
    }
}

/// A claim under one interpretation.
#[derive(Debug, Clone, PartialEq)]
pub struct Glance {
    /// Its outcome there.
    pub outcome: Outcome,
    /// Whether this outcome says something about the claim.
    pub sight: Sight,
    /// Our number, its interval, and the number of instances.
    pub ours: Option<(f64, Option<[f64; 2]>, usize)>,
    /// The printed number that is farthest from ours, in words.
    pub farthest: Option<String>,
    /// The share of returned paths that the verifier refuses, from 0 to 1.
    pub refused: f64,
    /// A hash of the results that it rests on.
    pub results: String,
    /// The studies that it looks at.
    pub studies: BTreeSet<String>,
    /// Which printed values would have been refused, in words.
    pub power: Option<String>,
}

/// What every claim is found to be under one interpretation.
pub type Glances = BTreeMap<String, Glance>;

/// Every claim under each of `points`, by id: `answer` gives the numbers of a question under the interpretation at a place, and a name for
/// them. A claim is left out where a question of its own, or of a part, has no answer.
///
/// # Errors
/// Those of [`validate`](super::super::claims::validate).
pub fn glances<'e>(
    paper: &Paper,
    points: &[Option<Interpretation>],
    polylines: &Polylines,
    answer: &(impl Fn(usize, &str) -> Option<(usize, &'e Numbers)> + Sync),
) -> Result<Vec<Glances>, SettingsError> {
    let of_claim = |claim: &Claim| weighed(paper, claim, points, polylines, answer);
    // Gathered in order before any error is passed on, so that it is the first claim's.
    let alone: Vec<Result<_, SettingsError>> = paper.claims.par_iter().map(of_claim).collect();
    let alone: Vec<Vec<Option<Glance>>> = alone.into_iter().collect::<Result<_, _>>()?;
    let at = |place: usize| {
        let of_claims = paper.claims.iter().zip(&alone);
        let own = of_claims.filter_map(|(claim, all)| Some((claim.id.clone(), all[place].clone()?)));
        points[place].as_ref().map(|point| with_parts(paper, point, own.collect())).unwrap_or_default()
    };
    Ok((0..points.len()).into_par_iter().map(at).collect())
}

/// What an interpretation lets claims mean, and whether the claim is meant there.
type Meaning = (String, bool);

/// One claim by its own criteria under each of `points`: those that mean the same by it and have equal numbers are weighed once.
fn weighed<'e>(
    paper: &Paper,
    claim: &Claim,
    points: &[Option<Interpretation>],
    polylines: &Polylines,
    answer: &impl Fn(usize, &str) -> Option<(usize, &'e Numbers)>,
) -> Result<Vec<Option<Glance>>, SettingsError> {
    let none =
        Numbers { by_session: vec![Vec::new()], is_covered: true, is_posed: true, ..Numbers::default() };
    let mut built: BTreeMap<Meaning, Vec<(Option<String>, ClaimTest<'_>)>> = BTreeMap::new();
    let mut known: BTreeMap<(Meaning, Vec<usize>), Glance> = BTreeMap::new();
    let mut all = Vec::new();
    for (place, point) in points.iter().enumerate() {
        let Some(point) = point else {
            all.push(None);
            continue;
        };
        let meaning = (point.meaning(), claim.is_meant(point));
        if !built.contains_key(&meaning) {
            let decides = claim_tests(paper, claim, point)
                .filter(|one| one.as_ref().map_or(true, |one| !one.is_shown()));
            let built_now = decides.map(|one| one.map(|one| (one.question(), one)));
            built.insert(meaning.clone(), built_now.collect::<Result<_, SettingsError>>()?);
        }
        let of_claim = &built[&meaning];
        let numbers = |(question, test): &(Option<String>, ClaimTest<'_>)| match question {
            Some(question) if test.criterion().counts_refused() => {
                let without = || answer(place, question).filter(|(_, numbers)| numbers.refused == 0.0);
                answer(place, &with_refused(question)).or_else(without)
            }
            Some(question) => answer(place, question),
            None => Some((usize::MAX, &none)),
        };
        let answers: Option<Vec<(usize, &Numbers)>> = of_claim.iter().map(numbers).collect();
        let Some(answers) = answers else {
            all.push(None);
            continue;
        };
        let is_meant = meaning.1;
        let key = (meaning, answers.iter().map(|(name, _)| *name).collect::<Vec<_>>());
        let glance = known.entry(key).or_insert_with(|| {
            let both = of_claim.iter().zip(&answers);
            let weighed = both.map(|((_, test), (_, numbers))| test.weighed(numbers, polylines, None));
            meant(claim, is_meant, alone(claim, &weighed.collect::<Vec<_>>()))
        });
        all.push(Some(glance.clone()));
    }
    Ok(all)
}

/// `glance`, but that nothing is found where the claim is not meant.
fn meant(claim: &Claim, is_meant: bool, glance: Glance) -> Glance {
    if is_meant {
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
    Glance {
        outcome,
        sight,
        ours: ours.map(|ours| (ours.value, ours.interval, ours.n)),
        farthest: deciding.iter().find_map(|one| one.farthest.clone()),
        refused: weighed.iter().filter(decides).map(|one| one.refused).fold(0.0, f64::max),
        results: digest(weighed),
        studies: weighed.iter().filter(decides).flat_map(|one| one.studies.iter().cloned()).collect(),
        power: deciding.iter().find_map(|one| one.finding.power()).map(str::to_owned),
    }
}

/// What the findings that decide rest on, and what they say: interpretations that only change what a name means move these.
fn digest(weighed: &[CappedFinding]) -> String {
    let decides = weighed.iter().filter(|one| one.finding.outcome.is_some());
    let in_words = |one: &CappedFinding| {
        let ours = one.finding.ours.as_ref().map(|ours| (ours.value.to_bits(), ours.n));
        format!("{} {:?} {ours:?} {}\n", one.finding.criterion, one.finding.outcome, one.results)
    };
    sha256(decides.map(in_words).collect::<String>().as_bytes())[..12].to_owned()
}

fn sight(one: &CappedFinding, outcome: Outcome) -> Sight {
    let Caps { powerless, few, clock, .. } = one.caps;
    if !one.is_covered || clock.is_some() {
        Sight::Unexplored
    } else if outcome == Outcome::Open && (powerless || !one.is_posed) {
        Sight::Powerless
    } else if outcome == Outcome::Open && few {
        Sight::Few
    } else {
        Sight::Looked
    }
}

/// Sentences of parts and rows of cells take what they are from theirs.
fn with_parts(paper: &Paper, point: &Interpretation, mut glances: Glances) -> Glances {
    let alone = glances.clone();
    for claim in &paper.claims {
        let Some((_, of, ids)) = claims::of_parts(claim) else { continue };
        let parts: Option<Vec<&Glance>> = ids.iter().map(|id| alone.get(id)).collect();
        let Some((parts, own)) = parts.zip(alone.get(&claim.id)) else {
            glances.remove(&claim.id);
            continue;
        };
        let of_parts = of(&parts.iter().map(|part| part.outcome).collect::<Vec<_>>());
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
            ours: None,
            farthest: None,
            refused: parts.iter().map(|part| part.refused).fold(0.0, f64::max),
            results: sha256(results.as_bytes())[..12].to_owned(),
            studies: parts.iter().flat_map(|part| part.studies.iter().cloned()).collect(),
            power: None,
        };
        glances.insert(claim.id.clone(), meant(claim, claim.is_meant(point), whole));
    }
    glances
}
