//! Whether one contender finds a path wherever another does: a theorem to be asserted, or a share to be counted.

use super::{Check, Entry};
use crate::analysis::draws::both;
use crate::analysis::evidence::Evidence;
use crate::analysis::verdict::{Finding, Verdict};
use crate::study::record::Status;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "finds_whenever",
    about: "does one contender find a path on every problem on which another finds one?",
    settings: Accepted::of::<Settings>(),
    example: r#"
study = "success"
problems = "cell"
contender = "Improved A*"
whenever = "Original A*"
"#,
    build: |context| {
        let settings: Settings = context.settings.read()?;
        let contenders = [settings.contender.as_str(), settings.whenever.as_str()];
        context.study(&settings.study, &settings.problems.listed(), &contenders)?;
        Ok(Box::new(settings))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The study whose records are looked at.
    study: String,
    /// The problem group, by its label.
    problems: Problems,
    /// The contender, by its label.
    contender: String,
    /// The contender on whose solved problems it must find a path too.
    whenever: String,
}

/// One problem group, or several.
#[derive(Deserialize, JsonSchema)]
#[serde(untagged, expecting = "the label of a problem group, or a list of them, is accepted")]
enum Problems {
    /// One problem group.
    One(String),
    /// Several problem groups.
    Several(Vec<String>),
}

impl Problems {
    fn listed(&self) -> Vec<String> {
        match self {
            Self::One(group) => vec![group.clone()],
            Self::Several(groups) => groups.clone(),
        }
    }
}

impl Check for Settings {
    fn judge(&self, evidence: &Evidence<'_>) -> Finding {
        let mut finding = Finding::of(ENTRY.name);
        let Some(run) = evidence.run(&self.study) else { return finding };
        let (mut both_find, mut only_other, mut more, mut refused) = (0, Vec::new(), 0, 0);
        for group in self.problems.listed() {
            for [base, own] in both(run, &group, &self.whenever, &self.contender).values().flatten() {
                refused += usize::from(base.status == Status::Rejected);
                match (base.status == Status::Solved, own.status == Status::Solved) {
                    (true, true) => both_find += 1,
                    (true, false) => only_other.push(run.trial(own)),
                    (false, true) => more += 1,
                    (false, false) => {}
                }
            }
        }
        finding.verdict = Some(match (only_other.is_empty(), both_find) {
            (true, 0) => Verdict::Undecided,
            (true, _) => Verdict::Reproduced,
            (false, _) => Verdict::NotReproduced,
        });
        finding.trial = only_other.first().cloned();
        finding.because.push(format!(
            "{} finds a path on {both_find} of the {} problems on which {} does, and on {more} others",
            self.contender,
            both_find + only_other.len(),
            self.whenever
        ));
        if refused > 0 {
            finding.because.push(format!(
                "{refused} more paths of {} are refused by the verifier and stand on neither side",
                self.whenever
            ));
        }
        finding
    }
}
