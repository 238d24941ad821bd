//! Which interpretations count for a claim: those that vote and are compatible with what the study was calibrated to; equal results
//! count once.

use super::super::criterion::is_powerless;
use super::super::outcome::{Outcome, Polarity};
use super::super::verdict::{Fit, SettingFit};
use super::glance::Sight;
use super::stored::{Exploration, ExploredResult, Now};
use std::collections::{BTreeMap, BTreeSet};
use study::Choice;
use study::paper::Paper;

/// The choices of a paper, with the options that vote.
pub struct VotingChoices {
    /// Each choice.
    pub choices: Vec<Choice>,
    /// The claims that some study was calibrated to.
    pub(super) calibration: BTreeSet<String>,
    /// The paper as it is now.
    pub now: Now,
}

/// Interpretations that give one result for a claim.
#[derive(Debug, Clone, PartialEq)]
pub struct Group {
    /// Index of the first of them.
    pub interpretation: usize,
    /// All of them that count.
    pub interpretations: Vec<usize>,
    /// The outcome.
    pub outcome: Outcome,
}

/// The interpretations that count for a claim.
#[derive(Debug, Default)]
pub struct Counted {
    /// The interpretations that count, those with equal results together.
    pub groups: Vec<Group>,
    /// How many interpretations looked at it.
    pub looked: usize,
    /// How many would count, but do not look at it.
    pub not_looked_at: usize,
    /// How many vote, but are not compatible or are fitted worse than others.
    pub incompatible: usize,
    /// No voting interpretation is compatible, so that all of them are judged.
    pub none_compatible: bool,
    /// Interpretations that are set apart, by their places: the verifier refuses many of their paths, which the paper calls free.
    pub refused: Vec<usize>,
    /// By choice, the one option that the calibration leaves, where it refuses every other that votes.
    pub calibrated: BTreeMap<String, String>,
}

impl Counted {
    /// Counts a result of the claim for those of its interpretations that are `judged`; `default` is the outcome in the default run.
    /// `is_hollow` says whether its number has no power by the rules of now.
    fn take(
        &mut self,
        result: &ExploredResult,
        judged: &[usize],
        default: Option<&Outcome>,
        is_refused: bool,
        is_hollow: bool,
    ) {
        let own: Vec<usize> =
            result.interpretations.iter().copied().filter(|place| judged.contains(place)).collect();
        let Some(interpretation) = own.first().copied() else { return };
        if is_refused {
            self.refused.extend(own);
            return;
        }
        // The default run has more instances than an exploration.
        let is_default = own.contains(&0);
        let outcome = default.copied().filter(|_| is_default).unwrap_or(result.outcome);
        let seen = match result.sight {
            Sight::Looked if !is_hollow => own.clone(),
            Sight::Unmeant => Vec::new(),
            Sight::Looked | Sight::Unexplored | Sight::Powerless | Sight::Few => {
                own[..usize::from(is_default)].to_vec()
            }
        };
        self.not_looked_at += own.len() - seen.len();
        self.looked += seen.len();
        if !seen.is_empty() {
            self.groups.push(Group { interpretation, interpretations: seen, outcome });
        }
    }
}

impl VotingChoices {
    /// The voting choices of `paper`.
    pub fn new(paper: &Paper) -> Self {
        let calibration = paper.studies.iter().flat_map(|study| study.fitted_to.iter().cloned()).collect();
        Self { choices: paper.choices.clone(), calibration, now: Now::new(paper) }
    }

    /// The option that `interpretation`, given as its differences from the defaults, takes on `choice`.
    pub fn option<'r>(choice: &'r Choice, interpretation: &'r BTreeMap<String, String>) -> &'r str {
        interpretation.get(&choice.id).unwrap_or(&choice.default)
    }

    /// Whether every option of `interpretation` votes.
    pub fn votes(&self, interpretation: &BTreeMap<String, String>) -> bool {
        self.choices.iter().all(|choice| choice.votes(Self::option(choice, interpretation)))
    }

    /// The interpretations of `first` that count for the claim called `id`; `default` are the claims' outcomes in the default run.
    pub fn counted(
        &self,
        paper: &Paper,
        first: &Exploration,
        id: &str,
        default: &BTreeMap<String, Outcome>,
    ) -> Counted {
        let Some(claim) = first.claims.get(id) else { return Counted::default() };
        let voting: Vec<usize> = (0..first.interpretations.len())
            .filter(|place| self.votes(&first.interpretations[*place]))
            .collect();
        let calibration = self.calibrating(paper, first, id);
        let compatible = self.compatible(first, &voting, &calibration, default);
        let none_compatible = compatible.is_empty() && !voting.is_empty();
        let judged = if none_compatible { voting.clone() } else { compatible };
        let looked: Vec<usize> =
            voting.iter().copied().filter(|place| calibration.is_looked_at(first, *place)).collect();
        let left = |choice: &Choice| {
            let option = Self::option_left(choice, first, &judged, &looked)?;
            Some((choice.id.clone(), option.to_owned()))
        };
        let mut counted = Counted {
            incompatible: voting.len() - judged.len(),
            none_compatible,
            calibrated: self.choices.iter().filter_map(left).collect(),
            ..Counted::default()
        };
        let most = paper.explore.as_ref().and_then(|explore| explore.refused_above_percent);
        let is_refused =
            |result: &ExploredResult| most.is_some_and(|most| 100.0 * result.refused > f64::from(most));
        // Where all are refused, none can be set apart from the others.
        let some_stand = claim.results.iter().any(|result| !is_refused(result));
        let has_more = |other: &&ExploredResult| {
            let is_judged = other.interpretations.iter().any(|place| judged.contains(place));
            other.more.is_some() && is_judged && !(some_stand && is_refused(other))
        };
        let with_more: BTreeSet<&str> =
            claim.results.iter().filter(has_more).map(|result| result.results.as_str()).collect();
        for result in &claim.results {
            // Few instances that do not tell it from a result of more are no other result, and may not borrow that one's outcome.
            let is_told_apart = result.more.is_some() || !with_more.contains(result.results.as_str());
            if !is_told_apart && !result.interpretations.contains(&0) {
                counted.not_looked_at +=
                    result.interpretations.iter().filter(|place| judged.contains(place)).count();
                continue;
            }
            let hollow = result.outcome.polarity() == Polarity::For
                && paper
                    .claim(id)
                    .zip(result.interval)
                    .is_some_and(|(claim, ends)| is_powerless(claim, ends));
            counted.take(result, &judged, default.get(id), some_stand && is_refused(result), hollow);
        }
        counted.groups.sort_by_key(|group| group.interpretation);
        counted
    }

    /// The option that all compatible interpretations take on `choice`, if every other that votes is among `looked`, those
    /// under which each calibration claim was looked at.
    fn option_left<'r>(
        choice: &'r Choice,
        first: &'r Exploration,
        compatible: &[usize],
        looked: &[usize],
    ) -> Option<&'r str> {
        let option = |place: &usize| Self::option(choice, &first.interpretations[*place]);
        let left = option(compatible.first()?);
        let others: Vec<&str> = choice
            .options
            .keys()
            .map(String::as_str)
            .filter(|one| *one != left && choice.votes(one))
            .collect();
        let is_refused = |other: &&str| looked.iter().any(|place| option(place) == *other);
        let is_only = !others.is_empty() && compatible.iter().all(|place| option(place) == left);
        (is_only && others.iter().all(is_refused)).then_some(left)
    }

    /// The interpretations of `first` that vote and are compatible with every calibration claim; all that vote if none is.
    pub fn fitting(&self, first: &Exploration, default: &BTreeMap<String, Outcome>) -> Vec<usize> {
        let voting: Vec<usize> = (0..first.interpretations.len())
            .filter(|place| self.votes(&first.interpretations[*place]))
            .collect();
        let all = self.calibration.iter().map(String::as_str);
        let others = all.filter(|id| first.is_current(&self.now, id)).collect();
        let calibration = Calibration { others, own: Vec::new() };
        let compatible = self.compatible(first, &voting, &calibration, default);
        if compatible.is_empty() { voting } else { compatible }
    }

    /// How each setting of the choices that are not fitted agrees with the calibration claims under each option of the one
    /// that is; none if no choice is fitted.
    pub fn fits(&self, first: &Exploration, default: &BTreeMap<String, Outcome>) -> Vec<SettingFit> {
        let Some(fitted) = self.choices.iter().find(|choice| choice.fitted) else { return Vec::new() };
        let voting =
            (0..first.interpretations.len()).filter(|place| self.votes(&first.interpretations[*place]));
        let best: BTreeSet<usize> = self.fitting(first, default).into_iter().collect();
        let calibration: Vec<&str> = self.calibration.iter().map(String::as_str).collect();
        let mut all: Vec<SettingFit> = Vec::new();
        for place in voting {
            let interpretation = &first.interpretations[place];
            let others = interpretation.iter().filter(|(id, _)| **id != fitted.id);
            let departures: Vec<String> = others.map(|(id, option)| format!("{id} = {option}")).collect();
            let setting =
                if departures.is_empty() { "the defaults".to_owned() } else { departures.join(", ") };
            let fit = match held(first, place, &calibration, default) {
                None => Fit::Refused,
                Some(_) if best.contains(&place) => Fit::Best,
                Some(_) => Fit::Less,
            };
            let at = all.iter().position(|row| row.setting == setting).unwrap_or_else(|| {
                all.push(SettingFit { setting, ..SettingFit::default() });
                all.len() - 1
            });
            all[at].fits.insert(Self::option(fitted, interpretation).to_owned(), fit);
        }
        all
    }

    /// The calibration claims as they stand to the claim called `id`; one that is stale says nothing.
    fn calibrating<'c>(&'c self, paper: &Paper, first: &Exploration, id: &str) -> Calibration<'c> {
        let whole = paper.whole_of(id).map(|whole| whole.id.as_str());
        let parts = paper.claim(id).map(|claim| claim.parts.ids()).unwrap_or_default();
        let is_own =
            |other: &&str| *other == id || whole == Some(*other) || parts.iter().any(|part| part == other);
        let all = self.calibration.iter().map(String::as_str);
        let (own, others) = all.filter(|other| first.is_current(&self.now, other)).partition(is_own);
        Calibration { others, own }
    }

    /// The voting interpretations under which no other calibration claim is contradicted and each has power; of those that differ in
    /// fitted choices alone, the ones that fit best.
    fn compatible(
        &self,
        first: &Exploration,
        voting: &[usize],
        calibration: &Calibration<'_>,
        default: &BTreeMap<String, Outcome>,
    ) -> Vec<usize> {
        let fits: BTreeMap<usize, Goodness> = voting
            .iter()
            .filter_map(|place| Some((*place, calibration.goodness(first, *place, default)?)))
            .collect();
        let mut best: BTreeMap<Vec<&str>, Goodness> = BTreeMap::new();
        for (place, fit) in &fits {
            let most = best.entry(self.unfitted(first, *place)).or_default();
            *most = (*most).max(*fit);
        }
        let is_best = |(place, fit): &(usize, Goodness)| best[&self.unfitted(first, *place)] == *fit;
        fits.into_iter().filter(is_best).map(|(place, _)| place).collect()
    }

    /// The options that an interpretation takes where nothing is fitted.
    fn unfitted<'r>(&'r self, first: &'r Exploration, place: usize) -> Vec<&'r str> {
        let choices = self.choices.iter().filter(|choice| !choice.fitted);
        choices.map(|choice| Self::option(choice, &first.interpretations[place])).collect()
    }
}

/// The calibration claims as they stand to one claim.
///
/// A claim never filters itself: only `others` make an interpretation incompatible. But what is fitted is fitted to all of them at
/// once, so that the claim is judged where it fares best together with the others, and not where they alone do.
struct Calibration<'c> {
    /// Claims that make an interpretation incompatible if one of them is contradicted under it.
    others: Vec<&'c str>,
    /// The claim itself, its parts and the sentence that it is a part of, as far as they are calibration claims.
    own: Vec<&'c str>,
}

/// How well a setting of fitted choices fits, the worst first.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
struct Goodness {
    /// No calibration claim, the judged one among them, is contradicted, and each has power.
    is_whole: bool,
    /// How many of them hold.
    holds: usize,
}

impl Calibration<'_> {
    /// Whether every calibration claim, the judged one among them, was looked at under the interpretation at `place`.
    fn is_looked_at(&self, first: &Exploration, place: usize) -> bool {
        let all = [&self.others[..], &self.own].concat();
        all.iter().all(|id| first.result(id, place).is_some_and(|result| result.sight == Sight::Looked))
    }

    /// How the interpretation at `place` fits; none if one of the others is contradicted or has no power there.
    fn goodness(
        &self,
        first: &Exploration,
        place: usize,
        default: &BTreeMap<String, Outcome>,
    ) -> Option<Goodness> {
        let others = held(first, place, &self.others, default)?;
        let own = held(first, place, &self.own, default);
        Some(Goodness { is_whole: own.is_some(), holds: others + own.unwrap_or(0) })
    }
}

/// How many calibration claims hold under the interpretation at `place`; none if one is contradicted or has no power there.
fn held(
    first: &Exploration,
    place: usize,
    calibration: &[&str],
    default: &BTreeMap<String, Outcome>,
) -> Option<usize> {
    let mut holds = 0;
    for id in calibration {
        let Some(result) = first.result(id, place) else { continue };
        // What its studies were not explored for says nothing of other interpretations.
        if result.sight <= Sight::Unexplored {
            continue;
        }
        let full = default.get(*id).filter(|_| place == 0);
        let polarity = full.unwrap_or(&result.outcome).polarity();
        if polarity == Polarity::Against || (result.sight.is_powerless() && full.is_none()) {
            return None;
        }
        holds += usize::from(polarity == Polarity::For);
    }
    Some(holds)
}
