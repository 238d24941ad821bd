//! Which results of a claim count: one that speaks against most others needs a second seed that confirms it.

use super::super::outcome::{Outcome, Polarity};
use super::count::Group;

/// The results that speak against what most of them say, where they speak both ways; of as many, against the default's.
pub fn flips(groups: &[Group]) -> Vec<&Group> {
    let of = |wanted| groups.iter().filter(move |group| group.outcome.polarity() == wanted);
    let (holds, fails) = (of(Polarity::For).count(), of(Polarity::Against).count());
    if holds == 0 || fails == 0 {
        return Vec::new();
    }
    let default = groups.first().map(|group| group.outcome.polarity());
    let most_hold = holds > fails || (holds == fails && default != Some(Polarity::Against));
    of(if most_hold { Polarity::Against } else { Polarity::For }).collect()
}

/// The outcome that each result counts as. One that speaks against most others counts only if a second seed confirms
/// it, and is open otherwise.
pub fn confirmed(groups: &[Group], second: impl Fn(&Group) -> Option<Outcome>) -> Vec<Outcome> {
    let flips = flips(groups);
    let counts_as = |group: &Group| {
        let is_flip = flips.iter().any(|flip| flip.interpretation == group.interpretation);
        let is_confirmed = || second(group).is_some_and(|again| again.polarity() == group.outcome.polarity());
        if is_flip && !is_confirmed() { Outcome::Open } else { group.outcome }
    };
    groups.iter().map(counts_as).collect()
}
