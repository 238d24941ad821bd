//! Every claim under every interpretation that was explored, and the effect of each option alone: for readers who look
//! for themselves.

use super::super::outcome::Outcome;
use super::super::verdict::{ClaimVerdict, Effect, Verdicts};
use super::count::VotingChoices;
use super::effects::{self, each};
use super::glance::Sight;
use super::stored::{Exploration, ExploredResult};
use super::{Stored, counted_as, default_outcomes};
use serde::Serialize;
use std::collections::BTreeMap;
use study::Choice;
use study::paper::Paper;

/// What was explored of a paper.
#[derive(Debug, Serialize)]
pub struct ByInterpretation {
    /// What the paper leaves open.
    pub choices: Vec<ExploredChoice>,
    /// The options that differ from the defaults of each choice that was explored, the default interpretation first.
    pub interpretations: Vec<BTreeMap<String, String>>,
    /// Claims by id; those whose stored results are stale are left out.
    pub claims: BTreeMap<String, Claim>,
}

/// Something that the paper leaves open.
#[derive(Debug, Serialize)]
pub struct ExploredChoice {
    /// Its name.
    pub id: String,
    /// What the paper leaves open, and why the default was taken.
    pub why: String,
    /// The option taken by default.
    pub default: String,
    /// Its options, by name.
    pub options: Vec<ExploredOption>,
}

/// One way to fill it in.
#[derive(Debug, Serialize)]
pub struct ExploredOption {
    /// Its name.
    pub name: String,
    /// The paper's text or the practice that it cites.
    pub cites: Option<String>,
    /// Whether the paper may mean it; a probe is shown and never counted.
    #[serde(rename = "votes")]
    pub is_meant: bool,
    /// Why it cannot be run.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cannot_run: Option<String>,
}

/// A claim under the interpretations.
#[derive(Debug, Serialize)]
pub struct Claim {
    /// What was found, equal results once.
    pub results: Vec<SharedResult>,
    /// Every option that was explored by itself, with what it does.
    pub options: Vec<Alone>,
}

/// What was found under some interpretations.
#[derive(Debug, Serialize)]
pub struct SharedResult {
    /// The outcome.
    #[serde(rename = "class")]
    pub outcome: &'static str,
    /// Whether this outcome says something about the claim.
    pub sight: Sight,
    /// The outcome that it counts as across interpretations; `None` if it does not count. One against the majority that no second
    /// seed confirms counts as open.
    pub counts_as: Option<&'static str>,
    /// Our number.
    pub value: Option<f64>,
    /// Its interval.
    pub interval: Option<[f64; 2]>,
    /// How many instances it rests on.
    pub n: usize,
    /// The interpretations that give it, by their places.
    pub interpretations: Vec<usize>,
    /// Those of them that count.
    pub counted: Vec<usize>,
}

/// An option that alone departs from the defaults.
#[derive(Debug, Serialize)]
pub struct Alone {
    /// What the paper leaves open.
    pub choice: String,
    /// The option.
    pub option: String,
    /// What it does to the claim.
    pub effect: Effect,
    /// The interpretation, by its place.
    pub interpretation: usize,
}

/// What the paper leaves open, with the options of each.
pub fn explored_choices(paper: &Paper) -> Vec<ExploredChoice> {
    let option = |choice: &Choice, name: &String| {
        let spec = &choice.options[name];
        let cites = spec.paper.clone().or_else(|| spec.practice.clone());
        let is_meant = choice.is_meant(name);
        ExploredOption { name: name.clone(), cites, is_meant, cannot_run: spec.cannot_run.clone() }
    };
    let choice = |choice: &Choice| ExploredChoice {
        id: choice.id.clone(),
        why: choice.why.clone(),
        default: choice.default.clone(),
        options: choice.options.keys().map(|name| option(choice, name)).collect(),
    };
    paper.choices.iter().map(choice).collect()
}

/// What is `stored` of the claims of `verdicts`; none if nothing was explored.
pub fn by_interpretation(paper: &Paper, verdicts: &Verdicts, stored: &Stored) -> Option<ByInterpretation> {
    let first = stored.first.as_ref()?;
    let counting = VotingChoices::new(paper);
    let outcomes = default_outcomes(verdicts);
    let claim = |judged: &ClaimVerdict| {
        let id = &judged.claim;
        let explored = first.claims.get(id).filter(|_| first.is_current(&counting.now, id))?;
        let second = stored.second.as_ref().filter(|second| second.is_current(&counting.now, id));
        let counted = counting.counted(paper, first, id, &outcomes);
        let votes = counted_as(first, second, judged, &counted.groups);
        let found = |result: &ExploredResult| {
            let group = counted
                .groups
                .iter()
                .zip(&votes)
                .find(|(group, _)| result.interpretations.contains(&group.interpretation));
            SharedResult::new(
                result,
                outcomes.get(id).copied(),
                group.map(|(group, vote)| (&group.interpretations, *vote)),
            )
        };
        let of_options = [true, false].map(|votes| each(&counting, first, id, outcomes[id], votes));
        let alone = of_options.into_iter().flatten().filter_map(|one| Alone::new(first, one));
        Some((
            id.clone(),
            Claim { results: explored.results.iter().map(found).collect(), options: alone.collect() },
        ))
    };
    Some(ByInterpretation {
        choices: explored_choices(paper),
        interpretations: first.interpretations.clone(),
        claims: verdicts.claims.iter().filter_map(claim).collect(),
    })
}

impl SharedResult {
    /// A result; `default` is the outcome in the default run, which has more instances, `counts` what it counts as, and where.
    fn new(
        result: &ExploredResult,
        default: Option<Outcome>,
        counts: Option<(&Vec<usize>, Outcome)>,
    ) -> Self {
        let outcome = default.filter(|_| result.interpretations.contains(&0)).unwrap_or(result.outcome);
        Self {
            outcome: outcome.name(),
            sight: result.sight,
            counts_as: counts.map(|(_, vote)| vote.name()),
            value: result.value,
            interval: result.interval,
            n: result.n,
            interpretations: result.interpretations.clone(),
            counted: counts.map(|(interpretations, _)| interpretations.clone()).unwrap_or_default(),
        }
    }
}

impl Alone {
    fn new(first: &Exploration, (choice, option, (effect, _)): effects::OptionEffect) -> Option<Self> {
        let interpretation = first.place(&BTreeMap::from([(choice.clone(), option.clone())]))?;
        // The outcome itself stands beside it.
        let effect = if effect == Effect::Outcome { Effect::Number } else { effect };
        Some(Self { choice, option, effect, interpretation })
    }
}
