//! Two encodings of one paper side by side: which claims they judge alike, and what differs where they do not.
//!
//! Claims are matched by their id, or else by their meaning, or else by the same printed number with the same unit at the same
//! place. Two claims of one side with one meaning, or with one printed number, match nothing.

use super::compare::stored_studies;
use super::history::History;
use super::verdict::{ClaimVerdict, Verdicts};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use study::StudyError;
use study::manifest::Manifest;

/// An encoding with its stored run.
pub struct Encoding {
    /// What it is called.
    name: String,
    verdicts: Verdicts,
    /// By id what each claim means: the hash, and behind it the studies that it asks.
    meanings: BTreeMap<String, Vec<String>>,
    /// The form of these hashes.
    form: u32,
    /// The studies with stored records.
    studies: BTreeMap<String, Manifest>,
}

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
    /// The default on each side; `None` where the side does not have the choice.
    pub options: [Option<String>; 2],
}

impl Encoding {
    /// Reads what is stored in `folder`.
    ///
    /// # Errors
    /// Verdicts that are missing; verdicts, a history or a manifest that is not as it was written.
    pub fn read(name: &str, folder: &Path) -> Result<Self, StudyError> {
        let history = History::read(folder)?;
        let manifest = |study: String| Ok((study.clone(), Manifest::read(folder, &study)?));
        Ok(Self {
            name: name.to_owned(),
            verdicts: Verdicts::read(folder)?,
            meanings: history.meanings(),
            form: history.form(),
            studies: stored_studies(folder).into_iter().map(manifest).collect::<Result<_, StudyError>>()?,
        })
    }

    /// The one claim that `is_alike`; `None` if there are several.
    fn only(&self, is_alike: impl Fn(&ClaimVerdict) -> bool) -> Option<&ClaimVerdict> {
        let mut found = self.verdicts.claims.iter().filter(|claim| is_alike(claim));
        found.next().filter(|_| found.next().is_none())
    }

    fn has(&self, claim: &str) -> bool {
        self.verdicts.claims.iter().any(|own| own.claim == claim)
    }
}

impl Agreement {
    /// How the verdicts of two sides agree.
    pub fn new(sides: [&Encoding; 2]) -> Self {
        let defaults = defaults(sides.map(|side| &side.verdicts));
        let mut taken = BTreeSet::new();
        let mut claims = Vec::new();
        let mut only = [Vec::new(), Vec::new()];
        for first in &sides[0].verdicts.claims {
            match partner(sides, first, &taken) {
                Some(second) => {
                    taken.insert(second.claim.as_str());
                    claims.push(ClaimPair::new(sides, [first, second], &defaults));
                }
                None => only[0].push(first.claim.clone()),
            }
        }
        let left = sides[1].verdicts.claims.iter().filter(|second| !taken.contains(second.claim.as_str()));
        only[1].extend(left.map(|second| second.claim.clone()));
        Self { sides: sides.map(|side| side.name.clone()), claims, defaults, only }
    }

    /// How many claims are judged differently.
    pub fn differ(&self) -> usize {
        self.claims.iter().filter(|pair| !pair.is_same).count()
    }
}

/// The claim of the second side that is `first`, if it is none of those `taken`.
fn partner<'s>(
    [own, other]: [&'s Encoding; 2],
    first: &ClaimVerdict,
    taken: &BTreeSet<&str>,
) -> Option<&'s ClaimVerdict> {
    if let Some(by_id) = other.only(|second| second.claim == first.claim) {
        return Some(by_id);
    }
    let is_free = |second: &&ClaimVerdict| !own.has(&second.claim) && !taken.contains(second.claim.as_str());
    let meaning = own.meanings.get(&first.claim).filter(|_| own.form == other.form);
    let means = |side: &'s Encoding| {
        side.only(|claim| meaning.is_some() && side.meanings.get(&claim.claim) == meaning)
    };
    let prints = |side: &'s Encoding| side.only(|claim| is_alike(first, claim));
    let by_meaning = means(own).and_then(|_| means(other)).filter(is_free);
    by_meaning.or_else(|| prints(own).and_then(|_| prints(other)).filter(is_free))
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
    fn new(sides: [&Encoding; 2], pair: [&ClaimVerdict; 2], defaults: &[DefaultPair]) -> Self {
        let verdicts = pair.map(ClaimVerdict::word);
        let is_same = verdicts[0] == verdicts[1];
        let because = if is_same { Vec::new() } else { reasons(sides, pair, defaults) };
        Self { ids: pair.map(|claim| claim.claim.clone()), verdicts, is_same, because }
    }
}

/// What may make two sides judge a claim differently: the question, what it depends on, defaults that touch it, and its studies.
fn reasons(sides: [&Encoding; 2], pair: [&ClaimVerdict; 2], defaults: &[DefaultPair]) -> Vec<String> {
    let mut reasons = Vec::new();
    let [first, second] = pair.map(|claim| {
        let deciding = claim.findings.iter().filter(|finding| finding.outcome.is_some());
        deciding.map(|finding| finding.criterion.as_str()).collect::<Vec<_>>().join(", ")
    });
    if first != second {
        reasons.push(format!("question: {} and {}", or_none(&first), or_none(&second)));
    }
    let values = pair.map(|claim| claim.ours().map(|ours| ours.value));
    if values[0] != values[1] {
        let [first, second] =
            values.map(|value| value.map_or_else(|| "none".to_owned(), |value| format!("{value:.4}")));
        reasons.push(format!("our numbers: {first} and {second}"));
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
    let meanings = [0, 1].map(|side| sides[side].meanings.get(&pair[side].claim));
    let [own, other] = meanings.map(|meaning| meaning.map_or(&[][..], Vec::as_slice));
    let studies = own.iter().skip(1).filter(|study| other.iter().skip(1).any(|shared| shared == *study));
    for study in studies {
        let [Some(first), Some(second)] = sides.map(|side| side.studies.get(study)) else { continue };
        let differ = second.set_otherwise(first);
        if !differ.is_empty() {
            reasons.push(format!("study `{study}`: {}", differ.join(", ")));
        }
    }
    if reasons.is_empty() || own.first() != other.first() {
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
