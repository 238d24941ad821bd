//! Verdicts: the finding about each claim.

use super::outcome::{Outcome, Polarity};
use super::verdict_rule::{Chosen, Verdict};
use serde::{Deserialize, Serialize};
use stats::interval::Interval;
use std::collections::BTreeMap;
use study::paper::Reply;

/// How the line begins that gives a probability after it was multiplied by the number of interpretations.
pub const CORRECTED: &str = "p after ";

/// A smaller p-value says no more.
pub const LEAST_P: f64 = 0.0001;

/// A p-value to the digits that are shown of it.
pub fn p_text(p: f64) -> String {
    if p < 1e-3 { format!("{p:.1e}") } else { format!("{p:.3}") }
}

/// How the line begins that says which printed values would have been refused.
pub const POWER: &str = "power: ";

/// What kind of number an estimate is.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Quantity {
    /// A number in the unit of its subject.
    #[default]
    Number,
    /// By how many per cent there is more of the subject than with another contender.
    MorePercent,
    /// By how many per cent there is less of it.
    LessPercent,
    /// How many times as much of it there is as with another contender.
    Ratio,
    /// How many per cent of another contender's it is.
    PercentOfOther,
    /// By how many percentage points the subject lies above another contender's.
    MorePoints,
    /// A share of the subject, from 0 to 1.
    Share,
    /// The p of a joint test.
    Probability,
    /// A rank among our instances: the share of them, from 0 to 1, that is at least as unusual. No printed size compares with it.
    Rank,
}

impl Quantity {
    /// Whether it is [`Number`](Self::Number).
    pub fn is_number(&self) -> bool {
        *self == Self::Number
    }
}

/// Our number beside the printed one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Estimate {
    /// The number.
    pub value: f64,
    /// Its interval, if it has one.
    pub interval: Option<[f64; 2]>,
    /// What the number and its interval are, in words.
    pub what: String,
    /// What kind of number it is.
    #[serde(default, skip_serializing_if = "Quantity::is_number")]
    pub quantity: Quantity,
    /// What it is a number of: a metric, or the cases that a share counts. Empty where `what` alone says so.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub subject: String,
    /// How many independent instances it rests on.
    pub n: usize,
    /// Of the cases, those that were solved by everyone who is compared, and all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub solved: Option<[usize; 2]>,
}

impl Estimate {
    /// A number with its interval.
    pub fn new(value: f64, interval: Interval, what: impl Into<String>, n: usize) -> Self {
        Self { interval: Some([interval.low, interval.high]), ..Self::bare(value, what, n) }
    }

    /// A number without an interval.
    pub fn bare(value: f64, what: impl Into<String>, n: usize) -> Self {
        let (quantity, subject) = (Quantity::Number, String::new());
        Self { value, interval: None, what: what.into(), quantity, subject, n, solved: None }
    }

    /// The estimate, as a number of this kind of `subject`.
    #[must_use]
    pub fn measures(self, quantity: Quantity, subject: impl Into<String>) -> Self {
        Self { quantity, subject: subject.into(), ..self }
    }

    /// The estimate, with how many cases were solved, and all.
    #[must_use]
    pub fn of_cases(self, solved: [usize; 2]) -> Self {
        Self { solved: Some(solved), ..self }
    }
}

/// What one criterion found.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CriterionFinding {
    /// The criterion; of arithmetic on printed numbers the rule.
    pub criterion: String,
    /// Its outcome; absent if it only shows something, or can only refuse and did not.
    pub outcome: Option<Outcome>,
    /// Our number.
    pub ours: Option<Estimate>,
    /// The trial that shows it, as `--trial` takes it.
    pub trial: Option<String>,
    /// What would settle it, where it is open.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub settles: Option<String>,
    /// The computation, step by step, and what was found.
    pub because: Vec<String>,
    /// What the computation takes for granted.
    #[serde(default)]
    pub premises: Vec<String>,
}

impl CriterionFinding {
    /// Which printed values would have been refused, in words.
    pub fn power(&self) -> Option<&str> {
        self.because.iter().find_map(|line| line.strip_prefix("power: "))
    }
}

/// What an interpretation does to a claim when it alone departs from its default, the least first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Effect {
    /// It cannot touch it.
    None,
    /// It moves our number, not the claim's outcome.
    Number,
    /// It changes the outcome, not which way it speaks.
    Outcome,
    /// It leaves open what was decided, or decides what was open.
    Opens,
    /// It turns it.
    Turns,
}

/// The greatest effect of a choice's options.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EffectOfOption {
    /// What it does.
    pub effect: Effect,
    /// The option.
    pub option: String,
    /// The outcome under it.
    pub outcome: Outcome,
}

/// What the interpretations make of a claim.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Across {
    /// What would settle it, if the interpretations leave it open.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub settles: Option<String>,
    /// How many different results count.
    pub counted: usize,
    /// How many interpretations these results come from.
    pub looked: usize,
    /// How many results speak for it.
    pub holds: usize,
    /// How many leave it open.
    pub open: usize,
    /// How many speak against it.
    pub fails: usize,
    /// Results against the majority that no second seed confirms: they count as open.
    pub unconfirmed: usize,
    /// Interpretations that vote and do not look at it.
    pub not_looked_at: usize,
    /// Interpretations that vote and contradict what the study was calibrated to.
    pub incompatible: usize,
    /// Whether every voting interpretation contradicts what the study was calibrated to, so that all are judged.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub none_compatible: bool,
    /// Interpretations that are set apart: the verifier refuses their paths, which the paper calls free.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub refused: Vec<String>,
    /// Of a joint test: which options fit and which do not, then its results, the likeliest first, each with its interpretations.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub tested: Vec<String>,
    /// How probes, which are never counted, would change its verdict.
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
    /// How many interpretations were explored.
    pub interpretations: usize,
    /// How many trials it took.
    pub trials: u64,
    /// Claims whose stored results are stale: they are judged under the default interpretation alone.
    #[serde(default)]
    pub stale: Vec<String>,
    /// For some claim no voting interpretation is compatible.
    #[serde(default)]
    pub none_compatible: bool,
    /// Whether a second seed was run.
    #[serde(default)]
    pub second_seed: bool,
    /// Claims whose stored results of the second seed are stale.
    #[serde(default)]
    pub second_stale: Vec<String>,
    /// Voting options under which the verifier refuses many paths, each with the share.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub refused: Vec<String>,
    /// How each setting of the choices agrees with what a study was fitted to; none if no choice is fitted.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub fits: Vec<SettingFit>,
}

/// A setting of the choices that are not fitted, with the fit of the studies under each option of the fitted one.
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
    /// The sentence in a few words, for the first screens.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub short: Option<String>,
    /// The paper's own words, where they are given word for word.
    pub quote: Option<String>,
    /// The number as printed.
    pub printed: Option<String>,
    /// The number's unit.
    pub unit: Option<String>,
    /// The verdict.
    pub verdict: Verdict,
    /// The words beside it. First the counts for, open and against, or how many interpretations agree. Then its exceptions, the
    /// choice that it depends on, and the choices that were calibrated or not varied.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub beside: Vec<String>,
    /// On what it depends.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub depends_on: Option<String>,
    /// Its outcome under the default interpretation.
    pub outcome: Outcome,
    /// How its inputs were chosen, where that bears on it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub chosen: Option<Chosen>,
    /// Choices that touch it and were not varied.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub not_varied: Vec<String>,
    /// Choices that touch it and are settled, each with its option: the calibration of the studies refuses every other.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub calibrated: Vec<String>,
    /// Why it must hold, if it is a theorem.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub theorem: Option<String>,
    /// The sentence or table row that it is a part of, and with which it counts.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub part_of: Option<String>,
    /// What changed in how it is judged after a run had been seen, and why.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub changed_after_run: Option<String>,
    /// Each change of its meaning after its data had been seen, as in `history.toml`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub changes: Vec<String>,
    /// Its outcome under the default interpretation on the second seed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub second: Option<Outcome>,
    /// Its p of a joint test there.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub second_p: Option<f64>,
    /// Whether nothing that it looks at is drawn, so that a second seed changes nothing.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub is_seedless: bool,
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

    /// What arithmetic found possible, where nothing else was found: it counts for nothing.
    pub fn possible(&self) -> Option<&str> {
        if self.findings.iter().any(|finding| finding.outcome.is_some()) {
            return None;
        }
        let mut because = self.findings.iter().flat_map(|finding| &finding.because);
        because.find(|text| text.starts_with(POSSIBLE)).map(String::as_str)
    }

    /// Its verdict in a word; of a theorem, that it was asserted.
    pub fn word(&self) -> &'static str {
        match self.theorem {
            Some(_) if self.outcome == Outcome::Holds => "asserted, holds",
            Some(_) if self.outcome.polarity() == Polarity::Against => "asserted, violated",
            _ => self.verdict.name(),
        }
    }

    /// The verdict in tables: the word, with what it depends on.
    pub fn verdict_text(&self) -> String {
        match &self.depends_on {
            Some(on) if self.verdict == Verdict::Depends => format!("{} on {on}", self.word()),
            _ => self.word().to_owned(),
        }
    }

    /// The printed number with its unit.
    pub fn printed_text(&self) -> Option<String> {
        let unit = self.unit.as_ref().map_or_else(String::new, |unit| format!(" {unit}"));
        self.printed.as_ref().map(|printed| format!("{printed}{unit}"))
    }

    /// What the paper says: its own words in quotation marks, or what they amount to, and its number.
    pub fn statement(&self) -> String {
        let quoted = self.quote.as_ref().map(|quote| format!("“{quote}”"));
        match (self.printed_text(), quoted.or_else(|| self.says.clone())) {
            (Some(printed), Some(says)) => format!("{says} (printed {printed})"),
            (printed, says) => printed.or(says).unwrap_or_else(|| "–".to_owned()),
        }
    }

    /// What its verdict rests on.
    pub fn rests_on(&self) -> Option<String> {
        (!self.beside.is_empty()).then(|| self.beside.join("; "))
    }

    /// Which printed values would have been refused, in words.
    pub fn power(&self) -> Option<&str> {
        self.findings.iter().find_map(CriterionFinding::power)
    }

    /// What its probability was multiplied for, the number of interpretations that the paper may mean, and what it is then.
    pub fn corrected(&self) -> Option<(&str, &str)> {
        let mut because = self.findings.iter().flat_map(|finding| &finding.because);
        because.find_map(|line| line.strip_prefix(CORRECTED))?.split_once(": ")
    }

    /// The lines of a joint test that begin with `what`: which options fit, which do not, or what speaks against one of these.
    pub fn by_option(&self, what: &str) -> impl Iterator<Item = &str> {
        self.across.iter().flat_map(|across| &across.tested).filter_map(move |line| line.strip_prefix(what))
    }

    /// What would settle it, where it is open.
    pub fn settles(&self) -> Option<&str> {
        let across = self.across.as_ref().and_then(|across| across.settles.as_deref());
        across.or_else(|| self.findings.iter().find_map(|finding| finding.settles.as_deref()))
    }

    /// The words beside its verdict, with its outcome on the second seed where that was run.
    pub fn beside_with_seed(&self) -> Option<String> {
        let second = self.second.map(|second| {
            if self.is_seedless {
                "the seed moves nothing".to_owned()
            } else {
                let p = self.second_p.map_or_else(String::new, |p| {
                    if p < LEAST_P { format!(", p below {LEAST_P}") } else { format!(", p = {}", p_text(p)) }
                });
                format!("second seed: {}{p}", second.name())
            }
        });
        let words: Vec<String> = self.beside.iter().cloned().chain(second).collect();
        (!words.is_empty()).then(|| words.join("; "))
    }

    /// The number of ours that stands beside the printed one.
    pub fn ours(&self) -> Option<&Estimate> {
        let deciding = self.findings.iter().find(|finding| finding.outcome == Some(self.outcome));
        deciding
            .and_then(|finding| finding.ours.as_ref())
            .or_else(|| self.findings.iter().find_map(|finding| finding.ours.as_ref()))
    }

    /// The numbers that are shown and decide nothing.
    pub fn shown(&self) -> impl Iterator<Item = &Estimate> {
        self.findings
            .iter()
            .filter(|finding| finding.outcome.is_none())
            .filter_map(|finding| finding.ours.as_ref())
    }
}

/// How a line begins that says what a rule found possible.
pub const POSSIBLE: &str = "possible: ";

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
    /// Which claims hold jointly: sets, none within another, the largest first.
    #[serde(default, rename = "together")]
    pub together: Vec<Together>,
    /// What authors and others reply.
    #[serde(default, rename = "reply", skip_serializing_if = "Vec::is_empty")]
    pub replies: Vec<Reply>,
}

impl Verdicts {
    /// The claims that must hold whatever was drawn and do not: the program is wrong, or the theorem.
    pub fn violated(&self) -> Vec<&str> {
        let is_broken =
            |outcome: Outcome| outcome.polarity() == Polarity::Against || outcome == Outcome::SignOnly;
        let is_violated = |judged: &&ClaimVerdict| judged.theorem.is_some() && is_broken(judged.outcome);
        self.claims.iter().filter(is_violated).map(|judged| judged.claim.as_str()).collect()
    }

    /// The claim called `id`.
    pub fn claim(&self, id: &str) -> Option<&ClaimVerdict> {
        self.claims.iter().find(|judged| judged.claim == id)
    }

    /// Our numbers beside the parts of a claim, each with the part's short name.
    pub fn parts_ours(&self, whole: &ClaimVerdict) -> Vec<(&Estimate, Option<&str>)> {
        let parts = self.claims.iter().filter(|part| part.part_of.as_ref() == Some(&whole.claim));
        parts.filter_map(|part| Some((part.ours()?, part.short.as_deref()))).collect()
    }

    /// The replies about the claim called `id`.
    pub fn replies_to(&self, id: &str) -> impl Iterator<Item = &Reply> {
        self.replies.iter().filter(move |reply| reply.claims.iter().any(|claim| claim == id))
    }
}

#[cfg(test)]
mod tests;
