//! The class of a claim across interpretations: whether it survives what the paper leaves open, or what it hangs on.
//!
//! Under each interpretation that was explored every claim was judged by itself ([`glance`]); what came out is stored ([`stored`]).
//! Interpretations that vote and are compatible with what the study was calibrated to are counted, equal results once ([`count`]),
//! and their classes are combined in one place ([`combine`](mod@combine)), with the words that stand beside the class
//! ([`hangs`]) and what each interpretation moves ([`effects`]).

pub mod by_interpretation;
pub mod combine;
pub mod count;
pub mod effects;
pub mod glance;
pub mod hangs;
pub mod stored;

use super::class::{Polarity, Verdict};
use super::settle::interpretations_settle;
use super::together::greatest;
use super::verdict::{Across, ClaimVerdict, Explored, Verdicts};
use count::{Counted, Group, VotingChoices};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use stored::Exploration;
use study::StudyError;
use study::paper::Paper;

/// What is stored of a paper besides its default run.
#[derive(Debug, Default)]
pub struct Stored {
    /// Its interpretations, explored.
    pub first: Option<Exploration>,
    /// Its claims on the second seed, under the default interpretation and under interpretations that turn a claim.
    pub second: Option<Exploration>,
}

impl Stored {
    /// What is stored beside the runs in `folder`.
    ///
    /// # Errors
    /// [`StudyError::Touched`] if it cannot be understood.
    pub fn read(folder: &Path) -> Result<Self, StudyError> {
        let first = Exploration::read(&Exploration::first(folder))?;
        Ok(Self { first, second: Exploration::read(&Exploration::second(folder))? })
    }
}

/// Gives every claim of `verdicts`, which were judged under the default interpretation, its class across interpretations.
pub fn apply(paper: &Paper, verdicts: &mut Verdicts, stored: &Stored) {
    let classes = default_classes(verdicts);
    let choices = VotingChoices::new(paper);
    let mut note = Explored::default();
    if let Some(first) = &stored.first {
        note.interpretations = first.interpretations.len();
        note.trials = first.trials;
        note.stale = first.stale(&choices.now);
        if note.stale.is_empty() {
            note.fits = choices.fits(first, &classes);
        }
    }
    if let Some(second) = &stored.second {
        note.second_seed = true;
        note.second_stale = second.stale(&choices.now);
    }
    for judged in &mut verdicts.claims {
        let second = stored.second.as_ref().filter(|second| second.is_current(&choices.now, &judged.claim));
        let own = second.and_then(|second| second.result(&judged.claim, 0));
        judged.second = own.filter(|own| own.sight == glance::Sight::Looked).map(|own| own.class);
        let first = stored.first.as_ref().filter(|first| first.is_current(&choices.now, &judged.claim));
        let Some(first) = first else { continue };
        let counted = choices.counted(paper, first, &judged.claim, &classes);
        note.none_compatible |= counted.none_compatible;
        if let Some(mut across) = across(&choices, first, second, judged, &counted) {
            let is_asked = paper.asks_over_interpretations(&judged.claim);
            across.range = is_asked.then(|| range(first, judged, &counted)).flatten();
            judged.verdict = across.class;
            judged.across = Some(across);
        }
    }
    if let Some(first) = stored.first.as_ref().filter(|_| note.stale.is_empty()) {
        let sets = [&verdicts.together[..], &first.together[..]].concat();
        verdicts.together = greatest(sets);
    }
    if stored.first.is_some() || stored.second.is_some() {
        verdicts.explored = Some(note);
    }
}

/// What the interpretations make of one claim; none if it was looked at under none but the default.
fn across(
    choices: &VotingChoices,
    first: &Exploration,
    second: Option<&Exploration>,
    judged: &ClaimVerdict,
    counted: &Counted,
) -> Option<Across> {
    if judged.theorem.is_some() || counted.looked < 2 {
        return None;
    }
    let votes = counted_as(first, second, &judged.claim, &counted.groups);
    let class = combine::combined(&votes, counted.is_existential);
    let count = |wanted| votes.iter().filter(|vote| vote.polarity() == wanted).count();
    let said = if counted.is_of_defaults && votes.len() == 1 {
        "asked under the defaults alone".to_owned()
    } else {
        hangs::summary(choices, first, &judged.claim, &counted.groups, &votes, class, counted.is_existential)
    };
    let unconfirmed = votes.iter().zip(&counted.groups).filter(|(vote, group)| **vote != group.class).count();
    let mut across = Across {
        class,
        default: judged.verdict,
        said,
        settles: None,
        counted: votes.len(),
        looked: counted.looked,
        holds: count(Polarity::For),
        open: count(Polarity::Open),
        fails: count(Polarity::Against),
        unconfirmed,
        not_looked_at: counted.not_looked_at,
        incompatible: counted.incompatible,
        none_compatible: counted.none_compatible,
        range: None,
        effects: effects::effects(choices, first, &judged.claim, judged.verdict),
        probes: effects::probes(choices, first, &judged.claim, judged.verdict),
    };
    across.settles = interpretations_settle(&across);
    Some(across)
}

/// The least and the greatest of our numbers beside a claim over the interpretations that count; the default run's stands for its own.
fn range(first: &Exploration, judged: &ClaimVerdict, counted: &Counted) -> Option<[f64; 2]> {
    let own = judged.ours().map(|ours| ours.value);
    let number = |group: &Group| match group.interpretation {
        0 => own,
        place => first.result(&judged.claim, place)?.value,
    };
    let numbers: Vec<f64> = counted.groups.iter().filter_map(number).collect();
    let end = |of: fn(f64, f64) -> f64| numbers.iter().copied().reduce(of);
    Some([end(f64::min)?, end(f64::max)?])
}

/// What each result counts as for the claim called `id`: a class that speaks against most of them is open unless the second
/// seed says so too.
fn counted_as(first: &Exploration, second: Option<&Exploration>, id: &str, groups: &[Group]) -> Vec<Verdict> {
    combine::confirmed(groups, |group| {
        let second = second?;
        let interpretation = second.place(&first.interpretations[group.interpretation])?;
        second.result(id, interpretation).map(|result| result.class)
    })
}

/// The class of every claim under the default interpretation, by id.
fn default_classes(verdicts: &Verdicts) -> BTreeMap<String, Verdict> {
    verdicts.claims.iter().map(|judged| (judged.claim.clone(), judged.alone())).collect()
}

/// The interpretations, by their places in `first`, whose classes a second seed must confirm: those that speak against what most
/// interpretations say of some claim.
pub fn to_confirm(paper: &Paper, verdicts: &Verdicts, first: &Exploration) -> BTreeSet<usize> {
    turned(paper, verdicts, first, |groups| combine::flips(groups).into_iter().collect())
}

/// The interpretations, by their places in `first`, under which more instances may say more: those that leave a claim open while others
/// do not, and those that turn one.
pub fn near_a_flip(paper: &Paper, verdicts: &Verdicts, first: &Exploration) -> BTreeSet<usize> {
    turned(paper, verdicts, first, |groups| {
        let speaks = groups.iter().any(|group| group.class.polarity() != Polarity::Open);
        let open = groups.iter().filter(|group| speaks && group.class.polarity() == Polarity::Open);
        open.chain(combine::flips(groups)).collect()
    })
}

/// The interpretations, by their places in `first`, that vote and are compatible with what the studies were fitted to; all that vote
/// if none is, and the defaults.
pub fn compatible(paper: &Paper, verdicts: &Verdicts, first: &Exploration) -> BTreeSet<usize> {
    VotingChoices::new(paper).fitting(first, &default_classes(verdicts)).into_iter().chain([0]).collect()
}

fn turned(
    paper: &Paper,
    verdicts: &Verdicts,
    first: &Exploration,
    which: impl Fn(&[Group]) -> Vec<&Group>,
) -> BTreeSet<usize> {
    let choices = VotingChoices::new(paper);
    let classes = default_classes(verdicts);
    let whole = verdicts.claims.iter().filter(|judged| judged.theorem.is_none());
    let of_claim = |judged: &ClaimVerdict| {
        let counted = choices.counted(paper, first, &judged.claim, &classes);
        which(&counted.groups).into_iter().map(|group| group.interpretation).collect::<Vec<_>>()
    };
    whole.flat_map(of_claim).collect()
}

#[cfg(test)]
mod tests;
