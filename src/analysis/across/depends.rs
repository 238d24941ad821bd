//! On which options a claim depends: those that all results on one side share.
//!
//! A rule is one option, or two. It is exact if no result on the other side has it, and then the smallest comes first: one option,
//! then two. Of as many options the rule under which the fewest interpretations stand comes first. Without an exact rule a
//! combination of options decides. The choice that separates best is named, with its counts, or else an option that all results
//! on a side share and at most half of those on the other side have.

use super::count::{Group, VotingChoices};
use super::glance::Sight;
use super::stored::{Exploration, ExploredResult};
use std::collections::{BTreeMap, BTreeSet};
use study::Choice;

/// Options that all results on one side share, by choice.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Rule {
    /// The options, by choice.
    pub options: Vec<(String, String)>,
    /// Whether the side whose results share these options is the first.
    pub is_first_side: bool,
    /// How many results are on that side.
    pub hits: usize,
    /// How many results have these options under one of their interpretations.
    pub covered: usize,
    /// Whether no result on the other side has them.
    pub is_exact: bool,
}

impl Rule {
    /// The options in words.
    pub fn in_words(&self) -> String {
        let option = |(choice, option): &(String, String)| format!("{choice} = {option}");
        self.options.iter().map(option).collect::<Vec<_>>().join(" and ")
    }

    /// The choices in words.
    pub fn choices(&self) -> String {
        self.options.iter().map(|(choice, _)| choice.as_str()).collect::<Vec<_>>().join(" and ")
    }
}

/// The results of a claim, each on the first side, on the other, or on neither.
pub struct Sides<'a> {
    /// The choices of the paper.
    pub choices: &'a VotingChoices,
    /// What was explored.
    pub first: &'a Exploration,
    /// The claim.
    pub id: &'a str,
    /// The results.
    pub groups: &'a [Group],
    /// The side of each.
    pub sides: Vec<Option<bool>>,
}

/// An option of a choice.
type Taken<'a> = (&'a Choice, &'a str);

impl<'a> Sides<'a> {
    /// The rule that the results on the first side, or on either one, follow; `None` if they share no option.
    pub fn rule(&self, either: bool) -> Option<Rule> {
        let sides = if either { &[true, false][..] } else { &[true] };
        let shared: Vec<(bool, Vec<Taken<'_>>)> =
            sides.iter().map(|side| (*side, self.shared(*side))).collect();
        let single = |(side, taken): &(bool, Vec<Taken<'a>>)| {
            taken.iter().map(|one| (*side, vec![*one])).collect::<Vec<_>>()
        };
        let singles: Vec<(bool, Vec<Taken<'_>>)> = shared.iter().flat_map(single).collect();
        let pair = |(side, taken): &(bool, Vec<Taken<'a>>)| {
            let of = |at: usize| taken[at + 1..].iter().map(move |two| (*side, vec![taken[at], *two]));
            (0..taken.len()).flat_map(of).collect::<Vec<_>>()
        };
        let pairs: Vec<(bool, Vec<Taken<'_>>)> = shared.iter().flat_map(pair).collect();
        let best = |rules: &[(bool, Vec<Taken<'a>>)], is_exact: bool| {
            let is_meant = |(side, rule): &&(bool, Vec<Taken<'a>>)| {
                let others = self.on(!side);
                let having = others.iter().filter(|group| self.has_some(group, rule)).count();
                if is_exact { having == 0 } else { 2 * having <= others.len() }
            };
            rules.iter().filter(is_meant).min_by_key(|(_, rule)| self.interpretations(rule)).cloned()
        };
        let exact = best(&singles, true).or_else(|| best(&pairs, true));
        let is_exact = exact.is_some();
        exact.or_else(|| best(&singles, false)).map(|(is_first_side, rule)| Rule {
            options: rule.iter().map(|(choice, option)| (choice.id.clone(), (*option).to_owned())).collect(),
            is_first_side,
            hits: self.on(is_first_side).len(),
            covered: self.groups.iter().filter(|group| self.has_some(group, &rule)).count(),
            is_exact,
        })
    }

    /// The choice whose options separate the sides best, with how many results of each option are on the first side. Many options with
    /// all of theirs on one side are counted.
    pub fn separating(&self) -> Option<(String, String)> {
        let right = |split: &Split<'_>| split.values().map(|[one, other]| one.max(other)).sum::<usize>();
        let most = self.on(true).len().max(self.on(false).len());
        let splits: Vec<_> = self.moving().map(|choice| (choice, self.split(choice))).collect();
        // Many options part few results by chance, so that each costs one; of equals the first.
        let worth = |split: &Split<'_>| right(split) as i64 - split.len() as i64;
        let parting = splits.iter().rev().filter(|(_, split)| right(split) > most);
        let (choice, split) = parting.max_by_key(|(_, split)| worth(split))?;
        Some((choice.id.clone(), shares(split)))
    }

    fn on(&self, side: bool) -> Vec<&'a Group> {
        let both = self.groups.iter().zip(&self.sides);
        both.filter(|(_, own)| **own == Some(side)).map(|(group, _)| group).collect()
    }

    /// The options that every interpretation on a side takes, of choices that can move the claim.
    fn shared(&self, side: bool) -> Vec<Taken<'a>> {
        let places: Vec<usize> =
            self.on(side).iter().flat_map(|group| group.interpretations.clone()).collect();
        let shared = |choice: &'a Choice| {
            let taken: BTreeSet<&str> = places.iter().map(|place| self.option(choice, *place)).collect();
            (taken.len() == 1).then(|| taken.first().map(|option| (choice, *option))).flatten()
        };
        self.moving().filter_map(shared).collect()
    }

    fn option(&self, choice: &'a Choice, place: usize) -> &'a str {
        VotingChoices::option(choice, &self.first.interpretations[place])
    }

    fn has(&self, place: usize, rule: &[Taken<'a>]) -> bool {
        rule.iter().all(|(choice, option)| self.option(choice, place) == *option)
    }

    fn has_some(&self, group: &Group, rule: &[Taken<'a>]) -> bool {
        group.interpretations.iter().any(|place| self.has(*place, rule))
    }

    /// How many interpretations have these options.
    fn interpretations(&self, rule: &[Taken<'a>]) -> usize {
        let places = self.groups.iter().flat_map(|group| &group.interpretations);
        places.filter(|place| self.has(**place, rule)).count()
    }

    /// The choices with a voting option that by itself gives other results than the defaults, or was not looked at: nothing depends
    /// on a choice that moves nothing.
    pub fn moving(&self) -> impl Iterator<Item = &'a Choice> {
        self.choices.choices.iter().filter(|choice| self.moves(choice))
    }

    fn moves(&self, choice: &Choice) -> bool {
        let Some(base) = self.first.result(self.id, 0) else { return true };
        let voting =
            choice.options.keys().filter(|option| **option != choice.default && choice.votes(option));
        let alone = |option: &String| {
            let place = self.first.place(&BTreeMap::from([(choice.id.clone(), option.clone())]))?;
            self.first.result(self.id, place)
        };
        let found: Vec<_> = voting.map(alone).collect();
        let is_other =
            |found: &ExploredResult| found.sight == Sight::Unexplored || !found.is_as_far_as_seen(base);
        found.is_empty() || found.iter().any(|found| found.is_none_or(is_other))
    }

    /// By option of `choice`, how many results are on either side; a result under several options belongs to the first.
    fn split(&self, choice: &'a Choice) -> Split<'a> {
        let mut split = Split::new();
        for (group, side) in self.groups.iter().zip(&self.sides) {
            let counts = split.entry(self.option(choice, group.interpretation)).or_default();
            if let Some(is_first) = side {
                counts[usize::from(!is_first)] += 1;
            }
        }
        split
    }
}

/// How often one side, and the other, comes out under an option of a choice.
type Split<'a> = BTreeMap<&'a str, [usize; 2]>;

/// How many results of each option are against, the largest share first. Five options or more with all of their results on one side
/// are counted, while others are left to list.
fn shares(split: &Split<'_>) -> String {
    const MANY: usize = 5;
    let mut listed: Vec<_> = split.iter().filter(|(_, counts)| counts.iter().sum::<usize>() > 0).collect();
    let mut counted = Vec::new();
    let mut sides = [(1, "all"), (0, "none")].map(|(lacking, word)| {
        let count = listed.iter().filter(|(_, counts)| counts[lacking] == 0).count();
        (count, lacking, word)
    });
    sides.sort_by_key(|(count, ..)| std::cmp::Reverse(*count));
    for (count, lacking, word) in sides {
        if count >= MANY && count < listed.len() {
            listed.retain(|(_, counts)| counts[lacking] > 0);
            counted.push(format!("{word} with each of {count} more"));
        }
    }
    let larger_share = |(_, one): &(&&str, &[usize; 2]), (_, two): &(&&str, &[usize; 2])| {
        (two[0] * (one[0] + one[1])).cmp(&(one[0] * (two[0] + two[1])))
    };
    listed.sort_by(larger_share);
    let mut against = "against ";
    let each = listed.iter().map(|(option, [own, others])| {
        format!("{own} of {} {}with {option}", own + others, std::mem::take(&mut against))
    });
    each.chain(counted).collect::<Vec<String>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_options_with_all_of_their_results_on_one_side_are_counted() {
        let with = |names: &'static str, counts: [usize; 2]| -> Split<'static> {
            names.split(' ').map(|name| (name, counts)).collect()
        };
        let parted = with("b", [2, 1]);
        let all = with("d e f g h", [1, 0]);
        let none = with("i j k l m n", [0, 2]);
        let join = |parts: &[&Split<'static>]| -> String {
            shares(
                &parts.iter().flat_map(|part| part.iter().map(|(name, counts)| (*name, *counts))).collect(),
            )
        };
        let one_lacks_results = join(&[&parted, &with("a", [1, 0]), &with("c", [0, 0])]);
        assert_eq!(one_lacks_results, "1 of 1 against with a, 2 of 3 with b");
        assert_eq!(join(&[&parted, &all]), "2 of 3 against with b, all with each of 5 more");
        let both = "2 of 3 against with b, none with each of 6 more, all with each of 5 more";
        assert_eq!(join(&[&parted, &all, &none]), both);
        let alone = "1 of 1 against with d, 1 of 1 with e, 1 of 1 with f, 1 of 1 with g, 1 of 1 with h";
        assert_eq!(join(&[&all]), alone);
        assert_eq!(join(&[&all, &none]), format!("{alone}, none with each of 6 more"));
    }
}
