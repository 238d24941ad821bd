//! The effect of each choice on a claim when it alone departs from its default.

use super::super::outcome::{Outcome, Polarity};
use super::super::verdict::{Effect, EffectOfOption};
use super::count::VotingChoices;
use super::glance::Sight;
use super::stored::Exploration;
use std::collections::BTreeMap;

/// The effects of voting options, by choice: the greatest of each; choices that cannot touch the claim are left out.
pub fn effects(
    choices: &VotingChoices,
    first: &Exploration,
    id: &str,
    default: Outcome,
) -> BTreeMap<String, EffectOfOption> {
    let mut all: BTreeMap<String, EffectOfOption> = BTreeMap::new();
    for (choice, option, effect) in each(choices, first, id, default, true) {
        let better = all.get(&choice).is_none_or(|known| effect.0 > known.effect);
        if effect.0 > Effect::None && better {
            all.insert(choice, EffectOfOption { effect: effect.0, option, outcome: effect.1 });
        }
    }
    all
}

/// The effect of each probe, in a few words; probes that change no outcome are left out.
pub fn probes(choices: &VotingChoices, first: &Exploration, id: &str, default: Outcome) -> Vec<String> {
    let all = each(choices, first, id, default, false).into_iter();
    let moving = all.filter(|(_, _, effect)| effect.0 > Effect::Number);
    moving.map(|(choice, option, effect)| format!("{choice} = {option}: {}", effect.1.name())).collect()
}

/// A choice, an option of it, and what that does, with the outcome under it.
pub(super) type OptionEffect = (String, String, (Effect, Outcome));

/// Every option, voting or not, that departs alone from the defaults, with what it does.
pub(super) fn each(
    choices: &VotingChoices,
    first: &Exploration,
    id: &str,
    default: Outcome,
    voting: bool,
) -> Vec<OptionEffect> {
    let Some(base) = first.result(id, 0) else { return Vec::new() };
    let mut all = Vec::new();
    for choice in &choices.choices {
        for option in choice.options.keys().filter(|option| **option != choice.default) {
            let alone = BTreeMap::from([(choice.id.clone(), option.clone())]);
            let Some(result) = first.place(&alone).and_then(|place| first.result(id, place)) else {
                continue;
            };
            if choice.votes(option) != voting || result.sight <= Sight::Unexplored {
                continue;
            }
            let effect = match (default.polarity(), result.outcome.polarity()) {
                _ if result.is_as_far_as_seen(base) => Effect::None,
                _ if result.sight.is_powerless() || result.outcome == default => Effect::Number,
                (own, other) if own == other => Effect::Outcome,
                (_, Polarity::Open) | (Polarity::Open, _) => Effect::Opens,
                _ => Effect::Turns,
            };
            all.push((choice.id.clone(), option.clone(), (effect, result.outcome)));
        }
    }
    all
}
