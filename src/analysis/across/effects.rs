//! What each reading does to a claim when it alone departs from its default.

use super::super::outcome::{Outcome, Polarity};
use super::super::verdict::{Effect, EffectOf};
use super::count::Axes;
use super::glance::Sight;
use super::stored::Exploration;
use std::collections::BTreeMap;

/// The effects of voting options, by axis: the greatest of each; axes that cannot touch the claim are left out.
pub fn effects(axes: &Axes, first: &Exploration, id: &str, default: Outcome) -> BTreeMap<String, EffectOf> {
    let mut all: BTreeMap<String, EffectOf> = BTreeMap::new();
    for (axis, option, effect) in each(axes, first, id, default, true) {
        let better = all.get(&axis).is_none_or(|known| effect.0 > known.effect);
        if effect.0 > Effect::None && better {
            all.insert(axis, EffectOf { effect: effect.0, option, outcome: effect.1 });
        }
    }
    all
}

/// What probes do, each in a few words; those that change no outcome are left out.
pub fn probes(axes: &Axes, first: &Exploration, id: &str, default: Outcome) -> Vec<String> {
    let all = each(axes, first, id, default, false).into_iter();
    let moving = all.filter(|(_, _, effect)| effect.0 > Effect::Number);
    moving.map(|(axis, option, effect)| format!("{axis} = {option}: {}", effect.1.name())).collect()
}

/// An axis, an option of it, and what that does, with the outcome under it.
pub(super) type Found = (String, String, (Effect, Outcome));

/// Every option, voting or not, that departs alone from the defaults, with what it does.
pub(super) fn each(axes: &Axes, first: &Exploration, id: &str, default: Outcome, voting: bool) -> Vec<Found> {
    let Some(base) = first.result(id, 0) else { return Vec::new() };
    let mut all = Vec::new();
    for axis in &axes.readings {
        for option in axis.options.keys().filter(|option| **option != axis.default) {
            let alone = BTreeMap::from([(axis.id.clone(), option.clone())]);
            let Some(result) = first.place(&alone).and_then(|place| first.result(id, place)) else {
                continue;
            };
            if axis.votes(option) != voting || result.sight <= Sight::Unexplored {
                continue;
            }
            let effect = match (default.polarity(), result.outcome.polarity()) {
                _ if result.results == base.results => Effect::None,
                _ if result.sight == Sight::Powerless || result.outcome == default => Effect::Number,
                (own, other) if own == other => Effect::Outcome,
                (_, Polarity::Open) | (Polarity::Open, _) => Effect::Opens,
                _ => Effect::Turns,
            };
            all.push((axis.id.clone(), option.clone(), (effect, result.outcome)));
        }
    }
    all
}
