//! Every claim under every reading that was explored, and what each option does alone: for readers who look for themselves.

use super::super::outcome::Outcome;
use super::super::verdict::{Effect, Judged, Verdicts};
use super::count::Axes;
use super::effects::{self, each};
use super::glance::Sight;
use super::stored::{Exploration, ExploredResult};
use super::{Stored, counted_as, default_outcomes};
use serde::Serialize;
use std::collections::BTreeMap;
use study::Reading;
use study::paper::Paper;

/// What was explored of a paper.
#[derive(Debug, Serialize)]
pub struct ByReading {
    /// What the paper leaves open.
    pub axes: Vec<Axis>,
    /// The options that differ from the defaults of each reading that was explored, the default reading first.
    pub readings: Vec<BTreeMap<String, String>>,
    /// Claims by id; those of which what is stored is stale are left out.
    pub claims: BTreeMap<String, Claim>,
}

/// Something that the paper leaves open.
#[derive(Debug, Serialize)]
pub struct Axis {
    /// Its name.
    pub id: String,
    /// What the paper leaves open, and why the default was taken.
    pub why: String,
    /// The option taken unless asked otherwise.
    pub default: String,
    /// Its options, by name.
    pub options: Vec<AxisOption>,
}

/// One way to fill it in.
#[derive(Debug, Serialize)]
pub struct AxisOption {
    /// Its name.
    pub name: String,
    /// The paper's text or the practice that it cites.
    pub cites: Option<String>,
    /// Whether it votes; a probe is shown and never counted.
    pub votes: bool,
}

/// A claim under the readings.
#[derive(Debug, Serialize)]
pub struct Claim {
    /// What was found, equal results once.
    pub results: Vec<Found>,
    /// Every option that was explored by itself, with what it does.
    pub options: Vec<Alone>,
}

/// What was found under some readings.
#[derive(Debug, Serialize)]
pub struct Found {
    /// The outcome.
    #[serde(rename = "class")]
    pub outcome: &'static str,
    /// Whether that says something.
    pub sight: Sight,
    /// What it counts as across readings, if it counts: what speaks against most and was not confirmed is open.
    pub counts_as: Option<&'static str>,
    /// Our number.
    pub value: Option<f64>,
    /// Its interval.
    pub interval: Option<[f64; 2]>,
    /// Of how many draws.
    pub n: usize,
    /// The readings, by their places.
    pub readings: Vec<usize>,
    /// Those of them that count.
    pub counted: Vec<usize>,
}

/// An option that alone departs from the defaults.
#[derive(Debug, Serialize)]
pub struct Alone {
    /// What the paper leaves open.
    pub axis: String,
    /// The option.
    pub option: String,
    /// What it does to the claim.
    pub effect: Effect,
    /// The reading, by its place.
    pub reading: usize,
}

/// What the paper leaves open, with the options of each.
pub fn axes(paper: &Paper) -> Vec<Axis> {
    let option = |reading: &Reading, name: &String| {
        let spec = &reading.options[name];
        let cites = spec.paper.clone().or_else(|| spec.practice.clone());
        AxisOption { name: name.clone(), cites, votes: reading.votes(name) }
    };
    let axis = |reading: &Reading| Axis {
        id: reading.id.clone(),
        why: reading.why.clone(),
        default: reading.default.clone(),
        options: reading.options.keys().map(|name| option(reading, name)).collect(),
    };
    paper.readings().iter().map(axis).collect()
}

/// What is `stored` of the claims of `verdicts`; none if nothing was explored.
pub fn by_reading(paper: &Paper, verdicts: &Verdicts, stored: &Stored) -> Option<ByReading> {
    let (first, counting) = (stored.first.as_ref()?, Axes::of(paper));
    let outcomes = default_outcomes(verdicts);
    let claim = |judged: &Judged| {
        let id = &judged.claim;
        let explored = first.claims.get(id).filter(|_| first.is_current(&counting.now, id))?;
        let second = stored.second.as_ref().filter(|second| second.is_current(&counting.now, id));
        let counted = counting.counted(paper, first, id, &outcomes);
        let votes = counted_as(first, second, judged, &counted.groups);
        let found = |result: &ExploredResult| {
            let group =
                counted.groups.iter().zip(&votes).find(|(group, _)| result.readings.contains(&group.reading));
            Found::of(result, outcomes.get(id).copied(), group.map(|(group, vote)| (&group.readings, *vote)))
        };
        let of_options = [true, false].map(|votes| each(&counting, first, id, outcomes[id], votes));
        let alone = of_options.into_iter().flatten().filter_map(|one| Alone::of(first, one));
        Some((
            id.clone(),
            Claim { results: explored.results.iter().map(found).collect(), options: alone.collect() },
        ))
    };
    Some(ByReading {
        axes: axes(paper),
        readings: first.readings.clone(),
        claims: verdicts.claims.iter().filter_map(claim).collect(),
    })
}

impl Found {
    /// A result; `default` is the outcome in the default run, which has more draws, `counts` what it counts as, and where.
    fn of(result: &ExploredResult, default: Option<Outcome>, counts: Option<(&Vec<usize>, Outcome)>) -> Self {
        let outcome = default.filter(|_| result.readings.contains(&0)).unwrap_or(result.outcome);
        Self {
            outcome: outcome.name(),
            sight: result.sight,
            counts_as: counts.map(|(_, vote)| vote.name()),
            value: result.value,
            interval: result.interval,
            n: result.n,
            readings: result.readings.clone(),
            counted: counts.map(|(readings, _)| readings.clone()).unwrap_or_default(),
        }
    }
}

impl Alone {
    fn of(first: &Exploration, (axis, option, (effect, _)): effects::Found) -> Option<Self> {
        let reading = first.place(&BTreeMap::from([(axis.clone(), option.clone())]))?;
        // The outcome itself stands beside it.
        let effect = if effect == Effect::Outcome { Effect::Number } else { effect };
        Some(Self { axis, option, effect, reading })
    }
}
