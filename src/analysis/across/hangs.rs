//! What stands beside a class across interpretations: under how many it holds, or what it hangs on.

use super::super::class::{Polarity, Verdict};
use super::count::{Group, VotingChoices};
use super::glance::Sight;
use super::stored::{Exploration, ExploredResult};
use std::collections::BTreeMap;
use study::Choice;

/// In a few words what the interpretations make of the claim called `id`.
pub fn summary(
    choices: &VotingChoices,
    first: &Exploration,
    id: &str,
    groups: &[Group],
    votes: &[Verdict],
    class: Verdict,
    is_existential: bool,
) -> String {
    let count = |wanted| votes.iter().filter(|vote| vote.polarity() == wanted).count();
    let holds = count(Polarity::For);
    let fails = count(Polarity::Against);
    let all = votes.len();
    if all == 1 {
        return "no choice moves it".to_owned();
    }
    if is_existential && holds > 0 {
        let met = groups.iter().zip(votes).find(|(_, vote)| vote.polarity() == Polarity::For);
        // The defaults need no name.
        let departs = met.filter(|(group, _)| !first.interpretations[group.interpretation].is_empty());
        let named = departs.map_or_else(String::new, |(group, _)| {
            format!(", {} among them", name(first, group.interpretation))
        });
        return format!("met under {holds} of {all}{named}");
    }
    let hangs = |parts: Parts| hangs(choices, first, id, groups, votes, parts);
    if holds > 0 && fails > 0 {
        return hangs(Parts::directions(votes));
    }
    let open = all - holds - fails;
    let tail = if open > 0 { format!(", open under {open}") } else { String::new() };
    match class.polarity() {
        Polarity::For => {
            let parts = Parts::classes(votes);
            let by_class = parts.map_or_else(String::new, |parts| format!("; the class {}", hangs(parts)));
            format!("holds under {holds} of {all}{tail}{by_class}")
        }
        Polarity::Against => format!("fails under {fails} of {all}{tail}"),
        Polarity::Open if holds > 0 => format!("holds under {holds} of {all} only, open under {open}"),
        Polarity::Open if fails > 0 => format!("fails under {fails} of {all} only, open under {open}"),
        Polarity::Open => format!("open under {open} of {all}"),
    }
}

/// An interpretation by what differs from the defaults.
fn name(first: &Exploration, place: usize) -> String {
    let parts: Vec<String> =
        first.interpretations[place].iter().map(|(id, option)| format!("{id} = {option}")).collect();
    if parts.is_empty() { "the default".to_owned() } else { parts.join(", ") }
}

/// How often what is asked, and the contrary, comes out under an option of a choice.
type Split<'a> = BTreeMap<&'a str, [usize; 2]>;

/// What parts the classes of a claim: whether it holds or fails or, where it never fails, whether it is as good as it gets.
#[derive(Clone, Copy)]
struct Parts {
    /// What the results for which it is asked are called.
    name: Verdict,
    /// Whether a class is one of them; none if it is neither they nor the contrary.
    is_asked: fn(Verdict, Verdict) -> Option<bool>,
}

impl Parts {
    /// Classes for the claim, by the weakest of them, from those against it.
    fn directions(votes: &[Verdict]) -> Self {
        let name = votes.iter().copied().filter(|vote| vote.polarity() == Polarity::For).max();
        let is_asked = |_, class: Verdict| match class.polarity() {
            Polarity::For => Some(true),
            Polarity::Against => Some(false),
            Polarity::Open => None,
        };
        Self { name: name.unwrap_or(Verdict::Undecided), is_asked }
    }

    /// The best class for the claim from the others for it; none if there is one.
    fn classes(votes: &[Verdict]) -> Option<Self> {
        let holding = || votes.iter().copied().filter(|vote| vote.polarity() == Polarity::For);
        let name = holding().min().filter(|best| holding().any(|class| class != *best))?;
        let is_asked = |best, class: Verdict| (class.polarity() == Polarity::For).then_some(class == best);
        Some(Self { name, is_asked })
    }

    fn side(self, class: Verdict) -> Option<bool> {
        (self.is_asked)(self.name, class)
    }
}

/// What it hangs on which of two sides the results are on.
fn hangs(
    choices: &VotingChoices,
    first: &Exploration,
    id: &str,
    groups: &[Group],
    votes: &[Verdict],
    parts: Parts,
) -> String {
    let class = parts.name.name();
    let moving = choices.choices.iter().filter(|choice| moves(choice, first, id));
    let splits = moving.map(|choice| (choice, split(choice, first, groups, votes, parts)));
    let splits: Vec<(&Choice, Split<'_>)> = splits.collect();
    let right = |split: &Split<'_>| split.values().map(|[one, other]| one.max(other)).sum::<usize>();
    let count = |side| votes.iter().filter(|vote| parts.side(**vote) == Some(side)).count();
    let asked = count(true);
    let others = count(false);
    let all = votes.len();
    let deciding = splits.iter().find(|(choice, split)| {
        is_clean(choice, first, groups, votes, parts) && decides(choice, split, first, id, parts)
    });
    if let Some((choice, split)) = deciding {
        let options: Vec<&str> =
            split.iter().filter(|(_, [asked, _])| *asked > 0).map(|(option, _)| *option).collect();
        return format!("hangs on {}: {class} if {} ({asked} of {all})", choice.id, options.join(" or "));
    }
    // Many options part few results by chance, so that each costs one; of equals the first.
    let worth = |split: &Split<'_>| right(split) as i64 - split.len() as i64;
    let parting = splits.iter().rev().filter(|(_, split)| right(split) > asked.max(others));
    let Some((choice, split)) = parting.max_by_key(|(_, split)| worth(split)) else {
        return format!("hangs on several interpretations: {class} under {asked} of {all}");
    };
    format!("hangs on {} and others: {class} under {asked} of {all} ({})", choice.id, shares(split))
}

/// Under how many of its results each option is asked for; many that have all of them are counted, not listed.
fn shares(split: &Split<'_>) -> String {
    const MANY: usize = 4;
    let listed = |options: &[(&&str, &[usize; 2])]| -> String {
        let each =
            options.iter().map(|(option, [asked, others])| format!("{option} {asked} of {}", asked + others));
        each.collect::<Vec<String>>().join(", ")
    };
    let looked: Vec<_> = split.iter().filter(|(_, counts)| counts.iter().sum::<usize>() > 0).collect();
    let (whole, parted): (Vec<_>, Vec<_>) = looked.iter().partition(|(_, [_, others])| *others == 0);
    if whole.len() > MANY && !parted.is_empty() {
        return format!("{}; all under each of {} more", listed(&parted), whole.len());
    }
    listed(&looked)
}

/// Whether no option of `choice` has interpretations on both sides; a result stands under all of its interpretations, not under the first alone.
fn is_clean(choice: &Choice, first: &Exploration, groups: &[Group], votes: &[Verdict], parts: Parts) -> bool {
    let mut sides: BTreeMap<&str, bool> = BTreeMap::new();
    let spoken = groups.iter().zip(votes).filter_map(|(group, vote)| Some((group, parts.side(*vote)?)));
    spoken.into_iter().all(|(group, side)| {
        let options = group
            .interpretations
            .iter()
            .map(|place| VotingChoices::option(choice, &first.interpretations[*place]));
        options.into_iter().all(|option| *sides.entry(option).or_insert(side) == side)
    })
}

/// What was found under `option` of `choice` where all else is at its default.
fn alone<'f>(choice: &Choice, option: &str, first: &'f Exploration, id: &str) -> Option<&'f ExploredResult> {
    let place = first.place(&BTreeMap::from([(choice.id.clone(), option.to_owned())]))?;
    first.result(id, place)
}

/// Whether some voting option of `choice` by itself gives other results than the defaults, or was not looked at: nothing hangs on
/// a choice that moves nothing.
fn moves(choice: &Choice, first: &Exploration, id: &str) -> bool {
    let Some(base) = first.result(id, 0) else { return true };
    let voting = choice.options.keys().filter(|option| **option != choice.default && choice.votes(option));
    let found: Vec<_> = voting.map(|option| alone(choice, option, first, id)).collect();
    let is_other = |found: &ExploredResult| {
        found.sight == Sight::Unexplored || found.results != base.results || found.class != base.class
    };
    found.is_empty() || found.iter().any(|found| found.is_none_or(is_other))
}

/// Whether each option of `choice` brings by itself, all else at its default, the side that its results are on, as far as that was
/// looked at: in a sample of combinations a choice may part by chance what others decide.
fn decides(choice: &Choice, split: &Split<'_>, first: &Exploration, id: &str, parts: Parts) -> bool {
    let counted =
        split.iter().filter(|(option, counts)| **option != choice.default && counts.iter().any(|n| *n > 0));
    counted.into_iter().all(|(option, [asked, _])| {
        let found = alone(choice, option, first, id);
        found.is_none_or(|found| (parts.side(found.class) == Some(true)) == (*asked > 0))
    })
}

/// By option of `choice`, how many results are on either side; a result under several options belongs to the first.
fn split<'a>(
    choice: &'a Choice,
    first: &'a Exploration,
    groups: &[Group],
    votes: &[Verdict],
    parts: Parts,
) -> Split<'a> {
    let mut split = Split::new();
    for (group, vote) in groups.iter().zip(votes) {
        let counts = split
            .entry(VotingChoices::option(choice, &first.interpretations[group.interpretation]))
            .or_default();
        match parts.side(*vote) {
            Some(true) => counts[0] += 1,
            Some(false) => counts[1] += 1,
            None => {}
        }
    }
    split
}
