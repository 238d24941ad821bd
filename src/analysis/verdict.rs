//! Verdicts: what was found about each claim, and the file that keeps them.

use crate::study::StudyError;
use crate::study::store::write_whole;
use base::settings::Document;
use serde::{Deserialize, Serialize};
use stats::interval::Interval;
use stats::proportion::units_for_margin;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// What we found about a claim, from the best that can be said to the worst.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Our interval and the printed value agree within the margin, and nothing was fitted to the claim.
    Reproduced,
    /// They agree, but something in the study was chosen so that they would.
    Fitted,
    /// An input exists on which it holds; it was searched for.
    Attainable,
    /// The sign is right, the size is not.
    DirectionOnly,
    /// The interval straddles the margin, or too little is known to say.
    Undecided,
    /// It is contradicted by what we measured.
    NotReproduced,
    /// The printed numbers contradict arithmetic or geometry.
    Impossible,
    /// The paper leaves out what is needed.
    Untestable,
}

impl Verdict {
    /// Every verdict.
    pub const ALL: [Self; 8] = [
        Self::Reproduced,
        Self::Fitted,
        Self::Attainable,
        Self::DirectionOnly,
        Self::Undecided,
        Self::NotReproduced,
        Self::Impossible,
        Self::Untestable,
    ];

    /// Its name in tables and reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Reproduced => "reproduced",
            Self::Fitted => "fitted",
            Self::Attainable => "attainable",
            Self::DirectionOnly => "direction only",
            Self::Undecided => "undecided",
            Self::NotReproduced => "not reproduced",
            Self::Impossible => "impossible",
            Self::Untestable => "untestable",
        }
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
    /// What the number and its interval are.
    pub what: String,
    /// How many independent draws it rests on.
    pub n: usize,
}

impl Estimate {
    /// A number with its interval.
    pub fn new(value: f64, interval: Interval, what: impl Into<String>, n: usize) -> Self {
        Self { value, interval: Some([interval.low, interval.high]), what: what.into(), n }
    }
}

/// What one check found.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Finding {
    /// The check.
    pub check: String,
    /// Its verdict; absent if the check can only refuse and did not.
    pub verdict: Option<Verdict>,
    /// Our number.
    pub ours: Option<Estimate>,
    /// The trial that shows it, as `--trial` takes it.
    pub trial: Option<String>,
    /// The reading it was found under, if that is not the one that the claim is judged under.
    pub reading: Option<String>,
    /// The computation, step by step, and what was found.
    pub because: Vec<String>,
    /// What the computation takes for granted.
    #[serde(default)]
    pub premises: Vec<String>,
}

impl Verdict {
    /// Whether an estimate is at least `bound`, as its interval says.
    pub fn at_least(interval: Interval, bound: f64) -> Self {
        if interval.low >= bound {
            Self::Reproduced
        } else if interval.high < bound {
            Self::NotReproduced
        } else {
            Self::Undecided
        }
    }

    /// Whether an estimate is below 0, as its interval says.
    pub fn below_zero(interval: Interval) -> Self {
        if interval.high < 0.0 {
            Self::Reproduced
        } else if interval.low > 0.0 {
            Self::NotReproduced
        } else {
            Self::Undecided
        }
    }
}

impl Finding {
    /// A finding of `check` that says nothing yet.
    pub fn of(check: &str) -> Self {
        Self { check: check.to_owned(), ..Self::default() }
    }

    /// It, undecided for this reason.
    #[must_use]
    pub fn undecided(mut self, because: impl Into<String>) -> Self {
        self.verdict = Some(Verdict::Undecided);
        self.because.push(because.into());
        self
    }

    /// If it is undecided because the interval of `ours` holds one of `limits`: how many `units` would tell them apart.
    pub fn say_what_settles(&mut self, limits: &[f64], units: &str) {
        let (Some(Verdict::Undecided), Some(ours)) = (self.verdict, &self.ours) else { return };
        let Some([low, high]) = ours.interval else { return };
        let straddled = limits.iter().filter(|limit| (low..=high).contains(*limit));
        let margin = straddled.map(|limit| (ours.value - limit).abs()).fold(f64::INFINITY, f64::min);
        if margin > 0.0 && margin.is_finite() {
            let needed = units_for_margin((high - low) / 2.0, ours.n, margin);
            self.because.push(format!("about {needed} {units} would settle a value of this size"));
        }
    }
}

/// A claim with what was found about it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Judged {
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
    /// The reading it was judged under.
    pub reading: String,
    /// What each check found.
    #[serde(default, rename = "finding")]
    pub findings: Vec<Finding>,
}

impl Judged {
    /// What tables say of it: its verdict or, of what must hold, that it was asserted.
    pub fn outcome(&self) -> &'static str {
        match (&self.theorem, self.verdict) {
            (Some(_), Verdict::Reproduced) => "asserted, holds",
            (Some(_), Verdict::NotReproduced) => "asserted, violated",
            _ => self.verdict.name(),
        }
    }

    /// The number of ours that stands beside the printed one.
    pub fn ours(&self) -> Option<&Estimate> {
        let deciding = self.findings.iter().find(|finding| finding.verdict == Some(self.verdict));
        deciding
            .and_then(|finding| finding.ours.as_ref())
            .or_else(|| self.findings.iter().find_map(|finding| finding.ours.as_ref()))
    }
}

/// Claims that hold together under one reading.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Together {
    /// The study.
    pub study: String,
    /// The problems: one for each group of claims that share one.
    pub problem: String,
    /// The reading.
    pub reading: String,
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
    /// The option of each reading that the claims were judged under.
    pub reading: BTreeMap<String, String>,
    /// Studies whose claims changed after their run: a margin may have moved after seeing the data.
    pub claims_changed_since: Vec<String>,
    /// Every claim.
    #[serde(default, rename = "claim")]
    pub claims: Vec<Judged>,
    /// Which claims hold jointly: sets none of which lies within another, the largest first.
    #[serde(default, rename = "together")]
    pub together: Vec<Together>,
}

/// Counts of verdicts in words, the same on the terminal and in the report.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Counts {
    /// The claims and how many there are of each verdict; what must hold by a theorem is not among them.
    pub classes: String,
    /// How many must hold by a theorem, if any.
    pub asserted: Option<String>,
}

impl Verdicts {
    /// Where they lie in the folder of a paper's runs.
    pub fn path(folder: &Path) -> PathBuf {
        folder.join("verdicts.toml")
    }

    /// Reads the verdicts in `folder`.
    ///
    /// # Errors
    /// [`StudyError::Stored`] if there are none, or a settings error if they cannot be understood.
    pub fn read(folder: &Path) -> Result<Self, StudyError> {
        let path = Self::path(folder);
        if !path.exists() {
            return Err(StudyError::stored(&path, "no verdicts; run `replan judge` first"));
        }
        Ok(Document::open(&path)?.read_stored()?)
    }

    /// Writes the verdicts into `folder`.
    ///
    /// # Errors
    /// [`StudyError::Io`].
    pub fn write(&self, folder: &Path) -> Result<(), StudyError> {
        write_whole(&Self::path(folder), self.text().as_bytes())
    }

    /// The verdicts as TOML.
    pub fn text(&self) -> String {
        toml::to_string(self).expect("verdicts are strings, numbers and tables of them")
    }

    /// How many claims there are of each verdict.
    pub fn counts(&self) -> Counts {
        let (asserted, counted): (Vec<&Judged>, Vec<&Judged>) =
            self.claims.iter().partition(|judged| judged.theorem.is_some());
        let of = |verdict: &Verdict| counted.iter().filter(|judged| judged.verdict == *verdict).count();
        let found = Verdict::ALL.iter().map(|verdict| (of(verdict), verdict.name()));
        let found = found.filter(|(count, _)| *count > 0).map(|(count, name)| format!("{count} {name}"));
        let classes = format!("{} claims: {}", counted.len(), found.collect::<Vec<_>>().join(", "));
        let asserted = (!asserted.is_empty()).then(|| {
            let many = asserted.len();
            format!("{many} more must hold whatever was drawn; they are asserted and count for nothing")
        });
        Counts { classes, asserted }
    }

    /// The claim called `id`.
    pub fn claim(&self, id: &str) -> Option<&Judged> {
        self.claims.iter().find(|judged| judged.claim == id)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_an_undecided_interval_around_a_limit_asks_for_more_units() {
        let said = |verdict, [low, value, high]: [f64; 3]| {
            let ours = Some(Estimate::new(value, Interval::new(low, high), "a share", 10));
            let mut finding = Finding { verdict: Some(verdict), ours, ..Finding::of("share") };
            finding.say_what_settles(&[0.5, 1.0], "trials");
            finding.because
        };
        // Half a width of 1/4 against a distance of 1/8: four times as many.
        let needed = "about 40 trials would settle a value of this size";
        assert_eq!(said(Verdict::Undecided, [0.25, 0.375, 0.75]), [needed]);
        assert!(said(Verdict::Undecided, [0.6, 0.7, 0.8]).is_empty(), "no limit lies within");
        assert!(said(Verdict::Undecided, [0.4, 0.5, 0.6]).is_empty(), "no number would");
        assert!(said(Verdict::Reproduced, [0.2, 0.4, 0.6]).is_empty());
    }
}
