//! Verdicts: what was found about each claim.

use super::class::{Polarity, Verdict};
use serde::{Deserialize, Serialize};
use stats::interval::Interval;
use std::collections::BTreeMap;

/// Our number beside the printed one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Estimate {
    /// The number.
    pub value: f64,
    /// Its interval, if it has one.
    pub interval: Option<[f64; 2]>,
    /// What the number and its interval are.
    pub what: String,
    /// How many independent instances it rests on.
    pub n: usize,
    /// Of the cases that were asked, those that were solved by everyone who is compared, and all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub solved: Option<[usize; 2]>,
}

impl Estimate {
    /// A number with its interval.
    pub fn new(value: f64, interval: Interval, what: impl Into<String>, n: usize) -> Self {
        Self { value, interval: Some([interval.low, interval.high]), what: what.into(), n, solved: None }
    }

    /// A number that was estimated over instances.
    pub fn from_bootstrap(found: stats::bootstrap::Estimate, what: impl Into<String>) -> Self {
        Self::new(found.value, found.interval, what, found.units)
    }

    /// A number without an interval.
    pub fn bare(value: f64, what: impl Into<String>, n: usize) -> Self {
        Self { value, interval: None, what: what.into(), n, solved: None }
    }

    /// It, of so many cases that were solved among all that were asked.
    #[must_use]
    pub fn of_cases(self, solved: [usize; 2]) -> Self {
        Self { solved: Some(solved), ..self }
    }
}

/// What one criterion found, with its class.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CriterionFinding {
    /// The criterion; of arithmetic on printed numbers the rule.
    pub criterion: String,
    /// Its class; absent if it only shows something, or can only refuse and did not.
    pub verdict: Option<Verdict>,
    /// Our number.
    pub ours: Option<Estimate>,
    /// The trial that shows it, as `--trial` takes it.
    pub trial: Option<String>,
    /// What would settle it, where it is undecided.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub settles: Option<String>,
    /// The computation, step by step, and what was found.
    pub because: Vec<String>,
    /// What the computation takes for granted.
    #[serde(default)]
    pub premises: Vec<String>,
}

/// What an interpretation does to a claim when it alone departs from its default, the least first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Effect {
    /// It cannot touch it.
    None,
    /// It moves our number, not what is said of the claim.
    Number,
    /// It changes the class, not which way it speaks.
    Class,
    /// It leaves open what was decided, or decides what was open.
    Opens,
    /// It turns it.
    Turns,
}

/// The greatest effect of an axis's options.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EffectOfOption {
    /// What it does.
    pub effect: Effect,
    /// The option.
    pub option: String,
    /// The class under it.
    pub class: Verdict,
}

/// What the interpretations make of a claim.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Across {
    /// Its class across interpretations.
    pub class: Verdict,
    /// Its class under the default interpretation.
    pub default: Verdict,
    /// `holds under 44 of 44`, or what it hangs on.
    pub said: String,
    /// What would settle it, if the interpretations leave it open.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub settles: Option<String>,
    /// How many different results count.
    pub counted: usize,
    /// How many interpretations they come from.
    pub looked: usize,
    /// Of the results, those that speak for it.
    pub holds: usize,
    /// Those that leave it open.
    pub open: usize,
    /// Those that speak against it.
    pub fails: usize,
    /// Those that speak against most others, without a second seed to say so too: they count as open.
    pub unconfirmed: usize,
    /// Interpretations that vote and do not look at it.
    pub not_looked_at: usize,
    /// Interpretations that vote and contradict what the study was calibrated to.
    pub incompatible: usize,
    /// Every voting interpretation does, so that all are judged.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub none_compatible: bool,
    /// The least and the greatest of our numbers over them, where the paper's chapter asks.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub range: Option<[f64; 2]>,
    /// What probes that are never counted do, where they change what is said of it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub probes: Vec<String>,
    /// What each choice does alone, where it can touch it.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub effects: BTreeMap<String, EffectOfOption>,
}

/// What of a paper's interpretations was explored.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Explored {
    /// How many interpretations.
    pub interpretations: usize,
    /// How many trials it took.
    pub trials: u64,
    /// Claims of which what is stored is stale: they are judged under the default interpretation alone.
    #[serde(default)]
    pub stale: Vec<String>,
    /// For some claim no voting interpretation is compatible.
    #[serde(default)]
    pub none_compatible: bool,
    /// Whether a second seed was run.
    #[serde(default)]
    pub second_seed: bool,
    /// Claims of which what is stored of the second seed is stale.
    #[serde(default)]
    pub second_stale: Vec<String>,
    /// How each setting of the choices agrees with what a study was fitted to; none if no interpretation is fitted.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub fits: Vec<SettingFit>,
}

/// A setting of the choices that are not fitted, with what the studies were fitted to under each option of the one that is.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SettingFit {
    /// What differs from the defaults, in words.
    pub setting: String,
    /// By option of the fitted choice.
    pub fits: BTreeMap<String, Fit>,
}

/// Whether an interpretation agrees with what the studies were fitted to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Fit {
    /// As well as any other option of the fitted choice: it counts.
    Best,
    /// It does, but another option does better.
    Less,
    /// It does not.
    Refused,
}

/// A claim with what was found about it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ClaimVerdict {
    /// The claim.
    pub claim: String,
    /// Where it stands in the paper.
    pub at: String,
    /// The sentence, where it is not a number alone.
    pub says: Option<String>,
    /// The paper's own words, where they are given word for word.
    pub quote: Option<String>,
    /// The number as printed.
    pub printed: Option<String>,
    /// The number's unit.
    pub unit: Option<String>,
    /// The verdict.
    pub verdict: Verdict,
    /// Why it must hold, if it is asserted and not found out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub theorem: Option<String>,
    /// The sentence or table row that it is a part of, and with which it counts.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub part_of: Option<String>,
    /// What was changed in how it is judged after a run had been seen, and why.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub changed_after_run: Option<String>,
    /// What it meant was changed after its data had been seen: each time, as `history.toml` has it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub changes: Vec<String>,
    /// Its class under the default interpretation on the second seed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub second: Option<Verdict>,
    /// What the interpretations make of it, if they were explored; its findings are those under the default interpretation.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub across: Option<Across>,
    /// The interpretation it was judged under.
    pub interpretation: String,
    /// What each criterion found.
    #[serde(default, rename = "finding")]
    pub findings: Vec<CriterionFinding>,
}

impl ClaimVerdict {
    /// Whether it counts by itself: it is no part of a sentence or row, and no theorem.
    pub fn is_counted(&self) -> bool {
        self.part_of.is_none() && self.theorem.is_none()
    }

    /// What tables say of it: its verdict or, of what must hold, that it was asserted.
    pub fn outcome(&self) -> &'static str {
        match (&self.theorem, self.verdict) {
            (Some(_), Verdict::Reproduced) => "asserted, holds",
            (Some(_), verdict) if verdict.polarity() == Polarity::Against => "asserted, violated",
            _ => self.verdict.name(),
        }
    }

    /// What the interpretations make of it, in a few words that stand behind its class; none if no interpretation was asked.
    pub fn across_interpretations(&self) -> Option<String> {
        self.across.as_ref().map(|across| across.said.clone())
    }

    /// [`across_interpretations`](Self::across_interpretations) with its class on the second seed, where that was run.
    pub fn beside(&self) -> Option<String> {
        let second = self.second.map(|second| format!("second seed: {}", second.name()));
        let said: Vec<String> = self.across_interpretations().into_iter().chain(second).collect();
        (!said.is_empty()).then(|| said.join("; "))
    }

    /// As [`beside`](Self::beside), with the second seed's class where it is another one.
    pub fn beside_if_other(&self) -> Option<String> {
        if self.second == Some(self.verdict) { self.across_interpretations() } else { self.beside() }
    }

    /// Its class under the interpretation that its findings are of.
    pub fn alone(&self) -> Verdict {
        self.across.as_ref().map_or(self.verdict, |across| across.default)
    }

    /// The number of ours that stands beside the printed one.
    pub fn ours(&self) -> Option<&Estimate> {
        let alone = self.alone();
        let deciding = self.findings.iter().find(|finding| finding.verdict == Some(alone));
        deciding
            .and_then(|finding| finding.ours.as_ref())
            .or_else(|| self.findings.iter().find_map(|finding| finding.ours.as_ref()))
    }
}

/// Claims that hold together under one interpretation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Together {
    /// The study.
    pub study: String,
    /// The problems: one for each group of claims that share one.
    pub problem: String,
    /// The interpretation.
    pub interpretation: String,
    /// The contenders that stand for the paper's.
    pub under: String,
    /// The claims that hold there.
    pub hold: Vec<String>,
    /// The claims about the same numbers that do not.
    pub fail: Vec<String>,
}

/// What stands in `verdicts.toml`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Verdicts {
    /// The paper.
    pub paper: String,
    /// The command that made the records they rest on.
    pub command: String,
    /// Whether the records are those of a quick run.
    pub quick: bool,
    /// The option of each choice that the claims were judged under.
    pub interpretation: BTreeMap<String, String>,
    /// By study the hash of the records that the claims were judged from.
    #[serde(default)]
    pub records: BTreeMap<String, String>,
    /// A hash of what the claims mean.
    pub meanings: String,
    /// The last seal of the history of claims; absent if there is no history.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub history: Option<String>,
    /// What that history cannot show, a sentence each.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub remarks: Vec<String>,
    /// Claims that the paper had until after their data had been seen, each with the entry of the history.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub withdrawn: Vec<String>,
    /// What of the interpretations was explored; absent if nothing was.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub explored: Option<Explored>,
    /// Every claim.
    #[serde(default, rename = "claim")]
    pub claims: Vec<ClaimVerdict>,
    /// Which claims hold jointly: sets none of which lies within another, the largest first.
    #[serde(default, rename = "together")]
    pub together: Vec<Together>,
}

/// How many sentences and table rows there are of each class, in words: the same on the terminal and in the report. What
/// is a part of a sentence or a cell of a row counts with it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Counts {
    /// How many there are, and of each class.
    pub classes: String,
    /// How many parts and cells they have.
    pub parts: Option<String>,
    /// How many must hold by a theorem, if any.
    pub asserted: Option<String>,
}

impl Verdicts {
    /// How many sentences and table rows there are that do not hold by a theorem, and how many of each class.
    pub fn tally(&self) -> Vec<usize> {
        let whole = self.claims.iter().filter(|judged| judged.is_counted());
        let whole: Vec<Verdict> = whole.map(|judged| judged.verdict).collect();
        let of = |verdict: &Verdict| whole.iter().filter(|own| *own == verdict).count();
        std::iter::once(whole.len()).chain(Verdict::ALL.iter().map(of)).collect()
    }

    /// How many sentences and table rows there are of each class.
    pub fn counts(&self) -> Counts {
        let (parts, whole): (Vec<&ClaimVerdict>, Vec<&ClaimVerdict>) =
            self.claims.iter().partition(|judged| judged.part_of.is_some());
        let asserted = whole.iter().filter(|judged| judged.theorem.is_some()).count();
        let tally = self.tally();
        let found = tally[1..].iter().zip(Verdict::ALL).filter(|(count, _)| **count > 0);
        let found: Vec<String> =
            found.map(|(count, verdict)| format!("{count} {}", verdict.name())).collect();
        let what = if tally[0] == 1 { "sentence or row" } else { "sentences and rows" };
        let classes = format!("{} {what}: {}", tally[0], found.join(", "));
        let parts = (!parts.is_empty()).then(|| {
            format!("{} parts and cells have classes of their own and count with these", parts.len())
        });
        let asserted = (asserted > 0).then(|| {
            format!("{asserted} more must hold whatever was drawn; they are asserted and count for nothing")
        });
        Counts { classes, parts, asserted }
    }

    /// The claims that must hold whatever was drawn and do not: the program is wrong, or the theorem.
    pub fn violated(&self) -> Vec<&str> {
        let is_broken =
            |verdict: Verdict| verdict.polarity() == Polarity::Against || verdict == Verdict::DirectionOnly;
        let is_violated = |judged: &&ClaimVerdict| judged.theorem.is_some() && is_broken(judged.verdict);
        self.claims.iter().filter(is_violated).map(|judged| judged.claim.as_str()).collect()
    }

    /// The claim called `id`.
    pub fn claim(&self, id: &str) -> Option<&ClaimVerdict> {
        self.claims.iter().find(|judged| judged.claim == id)
    }
}

#[cfg(test)]
mod tests;
