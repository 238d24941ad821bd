//! Stored explorations: the results of every claim, and the interpretations that give each.
//!
//! Results are weighed anew from the stored numbers whenever they are needed.

use super::super::claims::claim_hash;
use super::super::criterion::EXISTS;
use super::super::estimates::Explored;
use super::super::outcome::Outcome;
use super::super::polylines::Polylines;
use super::super::verdict::Together;
use super::glance::{Glance, Glances, Sight, glances};
use base::hash::sha256;
use base::settings::SettingsError;
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};
use study::explore::stamp;
use study::paper::Paper;
use study::{Interpretation, Study};

/// Interpretations of a paper under which its claims were judged.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Exploration {
    /// How many trials it took.
    pub trials: u64,
    /// The options that differ from the defaults of each choice, the default interpretation first.
    pub interpretations: Vec<BTreeMap<String, String>>,
    /// What the studies were when it was made, by name.
    pub studies: BTreeMap<String, String>,
    /// The claims, by id; those that ask what was not explored are left out.
    pub claims: BTreeMap<String, ExploredClaim>,
    /// Which claims hold jointly under some interpretation.
    pub together: Vec<Together>,
}

/// A claim with all that was found about it.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct ExploredClaim {
    /// The studies that it looks at.
    pub studies: BTreeSet<String>,
    /// What was found, equal results once.
    pub results: Vec<ExploredResult>,
}

/// Every claim that `first` and `more` say something of under all of their interpretations, with its results; `more` are those of interpretations, by their places, that ran once more with more instances.
fn claims(first: &[Glances], more: &BTreeMap<usize, Glances>) -> BTreeMap<String, ExploredClaim> {
    let of_claim = |id: &String| {
        let mut seen = Vec::new();
        let mut studies = BTreeSet::new();
        for (place, glances) in first.iter().enumerate() {
            let Some(first) = glances.get(id) else { continue };
            studies.extend(first.studies.iter().cloned());
            seen.push((place, first, more.get(&place).and_then(|glances| glances.get(id))));
        }
        (id.clone(), ExploredClaim { studies, results: results(&seen) })
    };
    let has = |glances: &Glances, id: &String| glances.is_empty() || glances.contains_key(id);
    let is_whole = |id: &&String| first.iter().chain(more.values()).all(|glances| has(glances, id));
    first.first().into_iter().flat_map(BTreeMap::keys).filter(is_whole).map(of_claim).collect()
}

/// A hash of the meanings of claims that are met exactly, alone or together.
pub fn met_exactly(paper: &Paper) -> String {
    let claims = paper.claims.iter().filter(|claim| claim.check(EXISTS.name).is_some());
    sha256(claims.map(|claim| claim_hash(paper, claim)).collect::<String>().as_bytes())[..16].to_owned()
}

/// What was found about a claim under some interpretations.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ExploredResult {
    /// The interpretations, by their places.
    pub interpretations: Vec<usize>,
    /// The outcome.
    pub outcome: Outcome,
    /// Whether this outcome says something about the claim.
    pub sight: Sight,
    /// Our number.
    pub value: Option<f64>,
    /// Its interval.
    pub interval: Option<[f64; 2]>,
    /// How many instances it rests on.
    pub n: usize,
    /// The printed number that is farthest from ours, in words.
    pub farthest: Option<String>,
    /// The share of returned paths that the verifier refuses, from 0 to 1.
    pub refused: f64,
    /// A hash of the trials' results on the first instances.
    pub results: String,
    /// The same with more instances, where these ran.
    pub more: Option<String>,
    /// Which printed values would have been refused, in words.
    pub power: Option<String>,
}

/// A number to the digits that are shown of it.
fn shown(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

/// An interpretation, by the options that differ from the defaults.
pub fn differing(paper: &Paper, point: &Interpretation) -> BTreeMap<String, String> {
    let interpretations = &paper.choices;
    let is_default = |id: &String, option: &String| {
        interpretations
            .iter()
            .any(|interpretation| interpretation.id == *id && interpretation.default == *option)
    };
    let other = point.options().iter().filter(|(id, option)| !is_default(id, option));
    other.map(|(id, option)| (id.clone(), option.clone())).collect()
}

impl Exploration {
    /// The results of `stored` numbers as the paper judges them now.
    ///
    /// # Errors
    /// Those of [`validate`](super::super::claims::validate).
    pub fn weighed(paper: &Paper, stored: &Explored, polylines: &Polylines) -> Result<Self, SettingsError> {
        let places = stored.places();
        // A choice that the paper no longer has belongs to studies that have changed.
        let point = |options| Interpretation::new(&paper.choices, options).ok();
        let points: Vec<Option<Interpretation>> = stored.interpretations.iter().map(point).collect();
        let under = |points: &[Option<Interpretation>], is_more: bool| {
            let answer = |place: usize, question: &str| {
                let at = *places.get(&(question, is_more, place))?;
                Some((at, &stored.answers[at].numbers))
            };
            glances(paper, points, polylines, &answer)
        };
        let first = under(&points, false)?;
        let again: BTreeSet<usize> = stored.answers_with_more().collect();
        let with_more: Vec<Option<Interpretation>> = points
            .into_iter()
            .enumerate()
            .map(|(place, point)| point.filter(|_| again.contains(&place)))
            .collect();
        let more = under(&with_more, true)?.into_iter().enumerate();
        let more = more.filter(|(place, _)| again.contains(place)).collect();
        let together = if stored.meant == met_exactly(paper) { stored.together.clone() } else { Vec::new() };
        let interpretations = stored.interpretations.clone();
        let (trials, studies) = (stored.trials, stored.studies.clone());
        Ok(Self { interpretations, trials, studies, together, claims: claims(&first, &more) })
    }

    /// The place of the interpretation with these options, if it was explored.
    pub fn place(&self, options: &BTreeMap<String, String>) -> Option<usize> {
        self.interpretations.iter().position(|interpretation| interpretation == options)
    }

    /// What was found about the claim called `id` under the interpretation at `place`.
    pub fn result(&self, id: &str, place: usize) -> Option<&ExploredResult> {
        self.claims.get(id)?.results.iter().find(|result| result.interpretations.contains(&place))
    }

    /// Whether what is stored of the claim called `id` is of the claim and the studies as they are `now`.
    pub fn is_current(&self, now: &Now, id: &str) -> bool {
        let Some(stored) = self.claims.get(id) else { return false };
        let is_as =
            |name: &String| now.studies.contains_key(name) && self.studies.get(name) == now.studies.get(name);
        // What stands for a study answers for it.
        let stands = now.stands_for.iter().filter(|(_, other)| stored.studies.contains(other));
        stored.studies.iter().all(is_as) && stands.map(|(name, _)| name).all(is_as)
    }

    /// The claims that it no longer speaks of.
    pub fn stale(&self, now: &Now) -> Vec<String> {
        now.ids.iter().filter(|id| !self.is_current(now, id)).cloned().collect()
    }
}

/// The present state of a paper, by hashes, which shows whether stored findings are still its own. It is made once and
/// queried for every claim.
#[derive(Debug, Default)]
pub struct Now {
    /// The claims in their order.
    ids: Vec<String>,
    /// The studies.
    studies: BTreeMap<String, String>,
    /// The studies that stand for another one, and that one.
    stands_for: Vec<(String, String)>,
}

impl Now {
    /// The present state of `paper`.
    pub fn new(paper: &Paper) -> Self {
        let stands = |study: &Study| {
            let other = study.explore.as_ref()?.stands_for.clone()?;
            Some((study.name.clone(), other))
        };
        Self {
            ids: paper.claims.iter().map(|claim| claim.id.clone()).collect(),
            studies: paper.studies.iter().map(|study| (study.name.clone(), stamp(study))).collect(),
            stands_for: paper.studies.iter().filter_map(stands).collect(),
        }
    }
}

impl ExploredResult {
    /// What was found on the first instances, and with `more` where these say as much.
    fn new(first: &Glance, more: Option<&Glance>) -> Self {
        let more = more.filter(|more| more.sight >= first.sight);
        let best = more.unwrap_or(first);
        let interval = best.ours.and_then(|(_, interval, _)| interval);
        Self {
            interpretations: Vec::new(),
            outcome: best.outcome,
            sight: best.sight,
            value: best.ours.map(|(value, ..)| shown(value)).filter(|value| value.is_finite()),
            interval: interval
                .map(|ends| ends.map(shown))
                .filter(|ends| ends.iter().all(|end| end.is_finite())),
            n: best.ours.map_or(0, |(_, _, n)| n),
            farthest: best.farthest.clone(),
            refused: shown(best.refused),
            results: first.results.clone(),
            more: more.map(|more| more.results.clone()),
            power: best.power.clone(),
        }
    }

    /// Whether it has the trials' results of `other` on the instances that ran for both.
    pub fn is_as_far_as_seen(&self, other: &Self) -> bool {
        let is_as_more = self.more.as_ref().zip(other.more.as_ref()).is_none_or(|(own, other)| own == other);
        self.results == other.results && is_as_more
    }
}

/// What was found, equal results once, of a claim at a glance under the interpretation at each place, and with more instances where these ran.
/// Results are equal if they have the same numbers of the same instances: one of fewer instances is another result, with its own outcome.
pub(super) fn results(seen: &[(usize, &Glance, Option<&Glance>)]) -> Vec<ExploredResult> {
    let mut found: Vec<ExploredResult> = Vec::new();
    for (place, first, more) in seen {
        let own = ExploredResult::new(first, *more);
        let is_it = |known: &ExploredResult| known.results == own.results && known.more == own.more;
        let at = found.iter().position(is_it).unwrap_or_else(|| {
            found.push(own);
            found.len() - 1
        });
        found[at].interpretations.push(*place);
    }
    found
}
