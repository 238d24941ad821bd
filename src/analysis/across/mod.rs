//! The verdict of a claim over all interpretations: whether it survives the choices that the paper leaves open, or on
//! which it depends.
//!
//! Every claim was judged by itself under each interpretation explored ([`glance`]), and the results are stored
//! ([`stored`]). Interpretations that vote and are compatible with the studies' calibration are counted, equal results
//! once ([`count`]). Those of a minority need a second seed ([`combine`](mod@combine)). The [table of
//! verdicts](super::verdict_rule) turns the counts into a verdict. The words beside it are [`wording`]'s. The options
//! on which it depends are found by [`depends`], choices that were not varied by [`touched`], and the change by each
//! option by [`effects`]. Where the calibration leaves one option of a choice, the choice is settled for claims that took
//! no part in it: other options would not count, whether their trials ran or not.

pub mod by_interpretation;
pub mod combine;
pub mod count;
pub mod depends;
pub mod effects;
pub mod glance;
pub mod stored;
pub mod tested;
pub mod touched;
pub mod wording;

use super::estimates::{Estimates, Explored};
use super::outcome::{Outcome, Polarity};
use super::polylines::Polylines;
use super::settle::{MEANT, across_settles, meanings_settle};
use super::together::greatest;
use super::verdict::{Across, ClaimVerdict, Explored as Note, Quantity, Verdicts};
use super::verdict_rule::{Line, Results, Verdict, of_meanings};
use count::{Counted, Group, VotingChoices};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use stored::Exploration;
use study::paper::{Claim, Paper};
use study::{Choice, StudyError};
use touched::Touched;
use wording::{View, Wording};

/// What is stored of a paper besides its default run.
#[derive(Debug, Default)]
pub struct Stored {
    /// Its interpretations, explored.
    pub first: Option<Exploration>,
    /// Its claims on the second seed, under the default interpretation and under interpretations that turn a claim.
    pub second: Option<Exploration>,
}

impl Stored {
    /// The stored exploration beside the runs in `folder`, as the paper judges it now. Polylines that rules search for
    /// are remembered.
    ///
    /// # Errors
    /// [`StudyError::Touched`] if it cannot be understood.
    pub fn read(paper: &Paper, folder: &Path, polylines: &Polylines) -> Result<Self, StudyError> {
        let Estimates { first, second, .. } = Estimates::read(paper, folder)?;
        let weighed = |explored: Option<Explored>| {
            explored.map(|explored| Exploration::weighed(paper, &explored, polylines)).transpose()
        };
        let stored = weighed(first).and_then(|first| Ok(Self { first, second: weighed(second)? }));
        stored.map_err(StudyError::from)
    }
}

/// Gives every claim of `verdicts`, whose outcomes are those under the default interpretation, its verdict over all interpretations.
pub fn apply(paper: &Paper, verdicts: &mut Verdicts, stored: &Stored) {
    let outcomes = default_outcomes(verdicts);
    let choices = VotingChoices::new(paper);
    let mut note = note(&choices, stored, &outcomes);
    for judged in &mut verdicts.claims {
        let Some(claim) = paper.claim(&judged.claim) else { continue };
        let second = stored.second.as_ref().filter(|second| second.is_current(&choices.now, &claim.id));
        let first = stored.first.as_ref().filter(|first| first.is_current(&choices.now, &claim.id));
        let of_claim = OfClaim { paper, choices: &choices, claim, first, second };
        note.none_compatible |= of_claim.judge(judged, &outcomes);
    }
    apply_meanings(paper, verdicts);
    if let Some(first) = stored.first.as_ref().filter(|_| note.stale.is_empty()) {
        let sets = [&verdicts.together[..], &first.together[..]].concat();
        verdicts.together = greatest(sets);
    }
    if stored.first.is_some() || stored.second.is_some() {
        verdicts.explored = Some(note);
    }
}

/// What of the interpretations was explored.
fn note(choices: &VotingChoices, stored: &Stored, outcomes: &BTreeMap<String, Outcome>) -> Note {
    let mut note = Note::default();
    if let Some(first) = &stored.first {
        note.interpretations = first.interpretations.len();
        note.trials = first.trials;
        note.stale = first.stale(&choices.now);
        note.refused = refused(choices, first);
        if !choices.calibration.iter().any(|id| note.stale.contains(id)) {
            note.fits = choices.fits(first, outcomes);
        }
    }
    if let Some(second) = &stored.second {
        note.second_seed = true;
        note.second_stale = second.stale(&choices.now);
    }
    note
}

/// Gives sentences that mean one of their parts the verdict that these make.
fn apply_meanings(paper: &Paper, verdicts: &mut Verdicts) {
    let meant: Vec<_> = paper.claims.iter().filter_map(|claim| meaning(claim, verdicts)).collect();
    for (id, verdict, wording) in meant {
        let Some(judged) = verdicts.claims.iter_mut().find(|judged| judged.claim == id) else { continue };
        judged.verdict = verdict;
        (judged.beside, judged.depends_on) = (wording.beside, wording.depends_on);
        let settles = meanings_settle(judged.verdict, judged.depends_on.as_deref());
        match &mut judged.across {
            Some(across) => across.settles = settles,
            None => judged.findings.iter_mut().for_each(|finding| finding.settles.clone_from(&settles)),
        }
    }
}

/// A claim with what is stored of it.
struct OfClaim<'a> {
    paper: &'a Paper,
    choices: &'a VotingChoices,
    claim: &'a Claim,
    /// Its interpretations, explored, if that is not stale.
    first: Option<&'a Exploration>,
    /// The same on the second seed.
    second: Option<&'a Exploration>,
}

impl OfClaim<'_> {
    /// Gives `judged` its verdict; says whether no voting interpretation is compatible.
    fn judge(&self, judged: &mut ClaimVerdict, outcomes: &BTreeMap<String, Outcome>) -> bool {
        let touched = Touched::new(self.paper, self.claim);
        self.look_at_seeds(judged, &touched);
        let explored = self.first.filter(|_| judged.theorem.is_none());
        let counted = explored.map(|first| self.choices.counted(self.paper, first, &self.claim.id, outcomes));
        if judged.theorem.is_none() {
            (judged.calibrated, judged.not_varied) = self.unvaried(&touched, counted.as_ref());
        }
        let none_compatible = counted.as_ref().is_some_and(|counted| counted.none_compatible);
        let both = explored.zip(counted.filter(|counted| counted.looked > 1));
        let (explored, counted) =
            both.map_or_else(|| (None, alone(judged)), |(first, counted)| (Some(first), counted));
        let votes = explored.map_or_else(
            || vec![judged.outcome],
            |first| counted_as(first, self.second, judged, &counted.groups),
        );
        let is_counted = counted.groups.iter().any(|group| group.interpretations.contains(&0));
        let default = if is_counted { judged.outcome.polarity() } else { Polarity::Open };
        let again = judged.second.map_or(Polarity::Open, Outcome::polarity);
        let results = Results {
            outcomes: &votes,
            default,
            second: if judged.is_seedless { default } else { again },
            chosen: judged.chosen,
            states_size: touched.states_size(),
            is_unvaried: !judged.not_varied.is_empty() || touched.is_elsewhere(),
        };
        let id = &self.claim.id;
        let view = View { choices: self.choices, first: explored, id, counted: &counted, results: &results };
        self.say(judged, &view);
        if touched.is_elsewhere() {
            judged.beside.push(wording::ELSEWHERE.to_owned());
        }
        none_compatible
    }

    /// Gives `judged` its outcome on the second seed, if it looks at trials, and whether a seed moves anything.
    fn look_at_seeds(&self, judged: &mut ClaimVerdict, touched: &Touched<'_>) {
        let own = self.second.and_then(|second| second.result(&self.claim.id, 0));
        let own = own.filter(|_| touched.looks_at_trials());
        let own = own.filter(|own| own.sight == glance::Sight::Looked);
        judged.second = own.map(|own| own.outcome);
        let is_p = judged.ours().is_some_and(|ours| ours.quantity == Quantity::Probability);
        judged.second_p = own.and_then(|own| own.value).filter(|_| is_p);
        let is_moved = judged.second.is_some_and(|second| second != judged.outcome);
        judged.is_seedless = !is_moved && touched.draws_nothing(self.paper);
    }

    /// Gives `judged` the verdict of its results, with what stands beside it.
    fn say(&self, judged: &mut ClaimVerdict, view: &View<'_>) {
        let (verdict, line) = view.results.verdict();
        let Wording { beside, depends_on } = view.wording(line);
        let is_bearing = !matches!(line, Line::Proved | Line::Lacking);
        let calibrated = wording::listed("calibrated", &judged.calibrated);
        let not_varied = wording::listed("choices not varied", &judged.not_varied);
        let unvaried = calibrated.into_iter().chain(not_varied).filter(|_| is_bearing);
        let beside = judged.possible().map_or(beside, |possible| vec![possible.to_owned()]);
        let is_met = matches!(verdict, Verdict::Reproduced | Verdict::Fitted);
        let power = view.power().filter(|_| is_met && judged.power().is_none());
        judged.beside = beside.into_iter().chain(power).chain(unvaried).collect();
        (judged.verdict, judged.depends_on) = (verdict, depends_on);
        judged.across = view.first.map(|first| self.across(first, judged, view, line));
    }

    /// The choices that touch the claim and were not varied. First those that the calibration leaves one option, each with that
    /// option. Then those judged under their default alone, though the calibration allows others.
    fn unvaried(&self, touched: &Touched<'_>, counted: Option<&Counted>) -> (Vec<String>, Vec<String>) {
        let left = |choice: &Choice| {
            let option = counted.and_then(|counted| counted.calibrated.get(&choice.id));
            // Another option than the default settles the choice only where the claim was looked at under it.
            option.filter(|option| **option == choice.default || counted.is_some_and(|own| own.looked > 1))
        };
        let is_varied = |choice: &Choice| {
            self.first.is_some_and(|first| {
                let is_other = |place: &usize| {
                    let option = VotingChoices::option(choice, &first.interpretations[*place]);
                    option != choice.default && choice.votes(option)
                };
                let is_seen = |place: &usize| {
                    let result = first.result(&self.claim.id, *place);
                    result.is_some_and(|result| result.sight != glance::Sight::Unexplored)
                };
                (0..first.interpretations.len()).filter(is_other).any(|place| is_seen(&place))
            })
        };
        let (mut calibrated, mut not_varied) = (Vec::new(), Vec::new());
        for choice in self.choices.choices.iter().filter(|choice| touched.is_touched_by(choice)) {
            let is_without = touched.is_without(self.paper, choice);
            if let Some(option) = left(choice).filter(|_| !is_without) {
                calibrated.push(format!("{} = {option}", choice.id));
            } else if is_without || !is_varied(choice) {
                not_varied.push(choice.id.clone());
            }
        }
        (calibrated, not_varied)
    }

    /// What the interpretations make of the claim.
    fn across(&self, first: &Exploration, judged: &ClaimVerdict, view: &View<'_>, line: Line) -> Across {
        let counted = view.counted;
        let votes = view.results.outcomes;
        let [holds, open, fails] = view.results.counts();
        let is_other = |(vote, group): &(&Outcome, &Group)| **vote != group.outcome;
        let named = |place: &usize| {
            let options = first.interpretations[*place].iter().map(|(id, option)| format!("{id} = {option}"));
            options.collect::<Vec<_>>().join(", ")
        };
        let mut across = Across {
            settles: None,
            counted: votes.len(),
            looked: counted.looked,
            holds,
            open,
            fails,
            unconfirmed: votes.iter().zip(&counted.groups).filter(is_other).count(),
            not_looked_at: counted.not_looked_at,
            incompatible: counted.incompatible,
            none_compatible: counted.none_compatible,
            refused: counted.refused.iter().map(named).collect(),
            effects: effects::effects(self.choices, first, &judged.claim, judged.outcome),
            tested: tested::tested(self.paper, self.choices, first, self.claim),
            probes: effects::probes(self.choices, first, &judged.claim, judged.outcome),
        };
        across.settles = across_settles(&across, judged, line);
        across
    }
}

/// The default alone, as the one result that counts.
fn alone(judged: &ClaimVerdict) -> Counted {
    let only = Group { interpretation: 0, interpretations: vec![0], outcome: judged.outcome };
    Counted { groups: vec![only], looked: 1, ..Counted::default() }
}

/// The verdict of a sentence that means one of its parts, from theirs, with what stands beside it; `None` of any other claim.
fn meaning(claim: &Claim, verdicts: &Verdicts) -> Option<(String, Verdict, Wording)> {
    let ids = claim.meanings()?;
    let parts: Vec<&ClaimVerdict> = ids.iter().filter_map(|id| verdicts.claim(id)).collect();
    let verdict = of_meanings(&parts.iter().map(|part| part.verdict).collect::<Vec<_>>());
    let meanings: Vec<String> =
        parts.iter().map(|part| format!("`{}` {}", part.claim, part.verdict_text())).collect();
    let weakest = parts.iter().find(|part| part.verdict == verdict);
    let on = weakest.and_then(|part| part.depends_on.clone()).unwrap_or_else(|| MEANT.to_owned());
    let depends_on = (verdict == Verdict::Depends).then_some(on);
    Some((
        claim.id.clone(),
        verdict,
        Wording { beside: vec![format!("meanings: {}", meanings.join(", "))], depends_on },
    ))
}

/// The share of refused paths from which on an option is named.
const REFUSED: f64 = 0.05;

/// The options by themselves under which the verifier refuses many of the paths that some claim looks at, with the greatest share.
fn refused(choices: &VotingChoices, first: &Exploration) -> Vec<String> {
    let share = |place: usize| {
        let results = first.claims.keys().filter_map(|id| first.result(id, place));
        results.map(|result| result.refused).fold(0.0, f64::max)
    };
    let of_option = |(choice, option): (&Choice, &String)| {
        let place = first.place(&BTreeMap::from([(choice.id.clone(), option.clone())]))?;
        // What the defaults refuse as well is no matter of the option.
        let own = share(place);
        let default = share(0);
        (own > REFUSED && own > 2.0 * default && choice.votes(option))
            .then(|| format!("{} = {option} ({:.0} %)", choice.id, 100.0 * own))
    };
    let options =
        choices.choices.iter().flat_map(|choice| choice.options.keys().map(move |option| (choice, option)));
    options.filter_map(of_option).collect()
}

/// What each result of a claim counts as: an outcome that speaks against most of them is open unless the second seed says so too,
/// where a seed moves anything.
fn counted_as(
    first: &Exploration,
    second: Option<&Exploration>,
    judged: &ClaimVerdict,
    groups: &[Group],
) -> Vec<Outcome> {
    combine::confirmed(groups, |group| {
        if judged.is_seedless {
            return Some(group.outcome);
        }
        let second = second?;
        let interpretation = second.place(&first.interpretations[group.interpretation])?;
        second.result(&judged.claim, interpretation).map(|result| result.outcome)
    })
}

/// The outcome of every claim under the default interpretation, by id.
fn default_outcomes(verdicts: &Verdicts) -> BTreeMap<String, Outcome> {
    verdicts.claims.iter().map(|judged| (judged.claim.clone(), judged.outcome)).collect()
}

/// The interpretations, by their places in `first`, whose outcomes a second seed must confirm: those that speak against what most
/// interpretations say of some claim.
pub fn to_confirm(paper: &Paper, verdicts: &Verdicts, first: &Exploration) -> BTreeSet<usize> {
    turned(paper, verdicts, first, |groups| combine::flips(groups).into_iter().collect())
}

/// The interpretations, by their places in `first`, under which more instances may help. They leave a claim open while
/// others do not, or turn one, or vote and have too few instances for one.
pub fn near_a_flip(paper: &Paper, verdicts: &Verdicts, first: &Exploration) -> BTreeSet<usize> {
    let near = turned(paper, verdicts, first, |groups| {
        let speaks = groups.iter().any(|group| group.outcome.polarity() != Polarity::Open);
        let open = groups.iter().filter(|group| speaks && group.outcome.polarity() == Polarity::Open);
        open.chain(combine::flips(groups)).collect()
    });
    let choices = VotingChoices::new(paper);
    let results = first.claims.values().flat_map(|claim| &claim.results);
    let few = results.filter(|result| result.sight == glance::Sight::Few);
    let few = few.flat_map(|result| result.interpretations.iter().copied());
    near.into_iter().chain(few.filter(|place| choices.votes(&first.interpretations[*place]))).collect()
}

/// The interpretations, by their places in `first`, that vote and are compatible with the studies' calibration, and the
/// defaults. All that vote if none is compatible.
pub fn compatible(paper: &Paper, verdicts: &Verdicts, first: &Exploration) -> BTreeSet<usize> {
    VotingChoices::new(paper).fitting(first, &default_outcomes(verdicts)).into_iter().chain([0]).collect()
}

fn turned(
    paper: &Paper,
    verdicts: &Verdicts,
    first: &Exploration,
    which: impl Fn(&[Group]) -> Vec<&Group>,
) -> BTreeSet<usize> {
    let choices = VotingChoices::new(paper);
    let outcomes = default_outcomes(verdicts);
    let whole = verdicts.claims.iter().filter(|judged| judged.theorem.is_none());
    let of_claim = |judged: &ClaimVerdict| {
        let counted = choices.counted(paper, first, &judged.claim, &outcomes);
        which(&counted.groups).into_iter().map(|group| group.interpretation).collect::<Vec<_>>()
    };
    whole.flat_map(of_claim).collect()
}

#[cfg(test)]
mod tests;
