//! Two encodings of one paper side by side: which claims they judge alike, and what differs where they do not.
//!
//! Claims are matched by their id, or else by the same number with the same unit at the same place. A number that
//! stands twice at a place matches nothing.

use super::verdict::{ClaimVerdict, Verdicts};
use serde::Serialize;
use std::collections::BTreeSet;

/// Two encodings side by side.
#[derive(Debug, Serialize)]
pub struct Agreement {
    /// What the sides are called.
    pub sides: [String; 2],
    /// Claims that both have, in the order of the first side.
    pub claims: Vec<ClaimPair>,
    /// Choices whose default is not the same, or which one side alone has.
    pub defaults: Vec<DefaultPair>,
    /// Claims that one side alone has.
    pub only: [Vec<String>; 2],
}

/// A claim as both sides judge it.
#[derive(Debug, Serialize)]
pub struct ClaimPair {
    /// Its id on each side.
    pub ids: [String; 2],
    /// Its verdicts.
    pub verdicts: [&'static str; 2],
    /// Whether the verdicts are the same.
    pub is_same: bool,
    /// What differs, where they are not.
    pub because: Vec<String>,
}

/// A choice with the option that each side takes by default.
#[derive(Debug, Serialize)]
pub struct DefaultPair {
    /// The choice.
    pub choice: String,
    /// The options; none where the side does not have the choice.
    pub options: [Option<String>; 2],
}

impl Agreement {
    /// How the verdicts of two sides agree.
    pub fn new(names: [&str; 2], sides: [&Verdicts; 2]) -> Self {
        let defaults = defaults(sides);
        let mut taken = BTreeSet::new();
        let mut claims = Vec::new();
        let mut only = [Vec::new(), Vec::new()];
        for first in &sides[0].claims {
            let by_id = sides[1].claims.iter().find(|second| second.claim == first.claim);
            let free = |second: &&ClaimVerdict| sides[0].claims.iter().all(|own| own.claim != second.claim);
            let alike = || sides[1].claims.iter().filter(|second| is_alike(first, second)).filter(free);
            let twins = sides[0].claims.iter().filter(|own| is_alike(first, own)).count();
            let by_cell = || alike().next().filter(|_| twins == 1 && alike().count() == 1);
            match by_id.or_else(by_cell) {
                Some(second) => {
                    taken.insert(second.claim.as_str());
                    claims.push(ClaimPair::new([first, second], &defaults));
                }
                None => only[0].push(first.claim.clone()),
            }
        }
        let left = sides[1].claims.iter().filter(|second| !taken.contains(second.claim.as_str()));
        only[1].extend(left.map(|second| second.claim.clone()));
        Self { sides: names.map(str::to_owned), claims, defaults, only }
    }

    /// How many claims are judged differently.
    pub fn differ(&self) -> usize {
        self.claims.iter().filter(|pair| !pair.is_same).count()
    }
}

/// Whether both print the same number with the same unit at the same place.
fn is_alike(first: &ClaimVerdict, second: &ClaimVerdict) -> bool {
    let cell = |claim: &ClaimVerdict| (claim.printed.clone(), claim.unit.clone(), claim.at.clone());
    first.printed.is_some() && cell(first) == cell(second)
}

fn defaults(sides: [&Verdicts; 2]) -> Vec<DefaultPair> {
    let names: BTreeSet<&String> = sides.iter().flat_map(|side| side.interpretation.keys()).collect();
    let pair = |choice: &String| {
        let options = sides.map(|side| side.interpretation.get(choice).cloned());
        DefaultPair { choice: choice.clone(), options }
    };
    names.into_iter().map(pair).filter(|pair| pair.options[0] != pair.options[1]).collect()
}

impl ClaimPair {
    fn new(pair: [&ClaimVerdict; 2], defaults: &[DefaultPair]) -> Self {
        let verdicts = pair.map(ClaimVerdict::word);
        let is_same = verdicts[0] == verdicts[1];
        let because = if is_same { Vec::new() } else { reasons(pair, defaults) };
        Self { ids: pair.map(|claim| claim.claim.clone()), verdicts, is_same, because }
    }
}

/// What may make two sides judge a claim differently: the question, what it depends on, and defaults that touch it.
fn reasons(pair: [&ClaimVerdict; 2], defaults: &[DefaultPair]) -> Vec<String> {
    let mut reasons = Vec::new();
    let [first, second] = pair.map(|claim| {
        let deciding = claim.findings.iter().filter(|finding| finding.outcome.is_some());
        deciding.map(|finding| finding.criterion.as_str()).collect::<Vec<_>>().join(", ")
    });
    if first != second {
        reasons.push(format!("question: {} and {}", or_none(&first), or_none(&second)));
    }
    let numbers =
        pair.map(|claim| claim.ours().map_or_else(|| "none".to_owned(), |ours| ours.value.to_string()));
    if numbers[0] != numbers[1] {
        reasons.push(format!("our numbers: {} and {}", numbers[0], numbers[1]));
    }
    let depends = pair.map(|claim| claim.depends_on.clone().unwrap_or_default());
    if depends[0] != depends[1] {
        reasons.push(format!("depends on: {} and {}", or_none(&depends[0]), or_none(&depends[1])));
    }
    let printed = pair.map(|claim| claim.printed.clone().unwrap_or_default());
    if printed[0] != printed[1] {
        reasons.push(format!("printed: {} and {}", or_none(&printed[0]), or_none(&printed[1])));
    }
    // A choice that is known to do nothing to either side does not explain the difference.
    let touches = |default: &&DefaultPair| {
        pair.iter().any(|claim| {
            claim.across.as_ref().is_none_or(|across| across.effects.contains_key(&default.choice))
        })
    };
    reasons.extend(defaults.iter().filter(touches).map(DefaultPair::in_words));
    if reasons.is_empty() {
        // The same criterion with other settings, as a margin, or with other parts.
        let because = pair.map(|claim| claim.findings.iter().flat_map(|finding| &finding.because));
        let [first, second] = because;
        let other = first.zip(second).find(|(first, second)| first != second);
        reasons.extend(other.map(|(first, second)| format!("evidence: {first}; and {second}")));
    }
    reasons
}

fn or_none(text: &str) -> &str {
    if text.is_empty() { "none" } else { text }
}

impl DefaultPair {
    /// It in words.
    pub fn in_words(&self) -> String {
        let [first, second] = [0, 1].map(|side| self.options[side].as_deref().unwrap_or("no such choice"));
        format!("default of `{}`: {first} and {second}", self.choice)
    }
}
