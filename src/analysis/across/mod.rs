//! The class of a claim across readings: whether it survives what the paper leaves open, or what it hangs on.
//!
//! Under each reading that was explored every claim was judged by itself ([`glance`]); what came out is stored ([`stored`]).
//! Readings that vote and are compatible with what the study was calibrated to are counted, equal results once ([`count`]),
//! and their classes are combined in one place ([`combine`](mod@combine)), with the words that stand beside the class
//! ([`hangs`]) and what each reading moves ([`effects`]).

pub mod by_reading;
pub mod combine;
pub mod count;
pub mod effects;
pub mod glance;
pub mod hangs;
pub mod stored;

use super::class::{Polarity, Verdict};
use super::settle::readings_settle;
use super::together::greatest;
use super::verdict::{Across, Explored, Judged, Verdicts};
use count::{Axes, Counted, Group};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use stored::Exploration;
use study::StudyError;
use study::paper::Paper;

/// What is stored of a paper besides its default run.
#[derive(Debug, Default)]
pub struct Stored {
    /// Its readings, explored.
    pub first: Option<Exploration>,
    /// Its claims on the second seed, under the default reading and under readings that turn a claim.
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

/// Gives every claim of `verdicts`, which were judged under the default reading, its class across readings.
pub fn apply(paper: &Paper, verdicts: &mut Verdicts, stored: &Stored) {
    let classes = default_classes(verdicts);
    let axes = Axes::of(paper);
    let mut note = Explored::default();
    if let Some(first) = &stored.first {
        note.readings = first.readings.len();
        note.trials = first.trials;
        note.stale = first.stale(&axes.now);
        if note.stale.is_empty() {
            note.fits = axes.fits(first, &classes);
        }
    }
    if let Some(second) = &stored.second {
        note.second_seed = true;
        note.second_stale = second.stale(&axes.now);
    }
    for judged in &mut verdicts.claims {
        let second = stored.second.as_ref().filter(|second| second.is_current(&axes.now, &judged.claim));
        let own = second.and_then(|second| second.result(&judged.claim, 0));
        judged.second = own.filter(|own| own.sight == glance::Sight::Looked).map(|own| own.class);
        let first = stored.first.as_ref().filter(|first| first.is_current(&axes.now, &judged.claim));
        let Some(first) = first else { continue };
        let counted = axes.counted(paper, first, &judged.claim, &classes);
        note.none_compatible |= counted.none_compatible;
        if let Some(mut across) = across(&axes, first, second, judged, &counted) {
            let is_asked = paper.asks_over_readings(&judged.claim);
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

/// What the readings make of one claim; none if it was looked at under none but the default.
fn across(
    axes: &Axes,
    first: &Exploration,
    second: Option<&Exploration>,
    judged: &Judged,
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
        hangs::said(axes, first, &judged.claim, &counted.groups, &votes, class, counted.is_existential)
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
        effects: effects::effects(axes, first, &judged.claim, judged.verdict),
        probes: effects::probes(axes, first, &judged.claim, judged.verdict),
    };
    across.settles = readings_settle(&across);
    Some(across)
}

/// The least and the greatest of our numbers beside a claim over the readings that count; the default run's stands for its own.
fn range(first: &Exploration, judged: &Judged, counted: &Counted) -> Option<[f64; 2]> {
    let own = judged.ours().map(|ours| ours.value);
    let number = |group: &Group| match group.reading {
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
        let reading = second.place(&first.readings[group.reading])?;
        second.result(id, reading).map(|result| result.class)
    })
}

/// The class of every claim under the default reading, by id.
fn default_classes(verdicts: &Verdicts) -> BTreeMap<String, Verdict> {
    verdicts.claims.iter().map(|judged| (judged.claim.clone(), judged.alone())).collect()
}

/// The readings, by their places in `first`, whose classes a second seed must confirm: those that speak against what most
/// readings say of some claim.
pub fn to_confirm(paper: &Paper, verdicts: &Verdicts, first: &Exploration) -> BTreeSet<usize> {
    turned(paper, verdicts, first, |groups| combine::flips(groups).into_iter().collect())
}

/// The readings, by their places in `first`, under which more draws may say more: those that leave a claim open while others
/// do not, and those that turn one.
pub fn near_a_flip(paper: &Paper, verdicts: &Verdicts, first: &Exploration) -> BTreeSet<usize> {
    turned(paper, verdicts, first, |groups| {
        let speaks = groups.iter().any(|group| group.class.polarity() != Polarity::Open);
        let open = groups.iter().filter(|group| speaks && group.class.polarity() == Polarity::Open);
        open.chain(combine::flips(groups)).collect()
    })
}

/// The readings, by their places in `first`, that vote and are compatible with what the studies were fitted to; all that vote
/// if none is, and the defaults.
pub fn compatible(paper: &Paper, verdicts: &Verdicts, first: &Exploration) -> BTreeSet<usize> {
    Axes::of(paper).fitting(first, &default_classes(verdicts)).into_iter().chain([0]).collect()
}

fn turned(
    paper: &Paper,
    verdicts: &Verdicts,
    first: &Exploration,
    which: impl Fn(&[Group]) -> Vec<&Group>,
) -> BTreeSet<usize> {
    let (axes, classes) = (Axes::of(paper), default_classes(verdicts));
    let whole = verdicts.claims.iter().filter(|judged| judged.theorem.is_none());
    let of_claim = |judged: &Judged| {
        let counted = axes.counted(paper, first, &judged.claim, &classes);
        which(&counted.groups).into_iter().map(|group| group.reading).collect::<Vec<_>>()
    };
    whole.flat_map(of_claim).collect()
}

#[cfg(test)]
mod tests;
