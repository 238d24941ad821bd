//! How a verdict is cited: the paper, the claim, the verdict and its version.
//!
//! The version is a hash of what the claim means, of the records that it was judged on and of what was found. It is the same as long
//! as these are, on every machine. Wording changes no version, and neither do other claims or replies.

use super::meaning::meaning;
use super::outcome::Outcome;
use super::verdict::{ClaimVerdict, Verdicts};
use base::hash::sha256;
use study::paper::Paper;

/// How many digits of the hash a version has.
const DIGITS: usize = 12;

/// The version of `judged`, one of `verdicts`. The claim's `meaning` is its hash, and behind it the studies that it asks.
pub fn version(verdicts: &Verdicts, judged: &ClaimVerdict, meaning: &[String]) -> String {
    let records: Vec<_> = meaning.iter().skip(1).map(|study| (study, verdicts.records.get(study))).collect();
    let counts = judged.across.as_ref().map(|across| [across.holds, across.open, across.fails]);
    let outcomes = [Some(judged.outcome), judged.second].map(|outcome| outcome.map(Outcome::name));
    let found = (&judged.interpretation, judged.verdict.name(), &judged.depends_on, outcomes, counts);
    let text = format!("{:?} {records:?} {found:?}", meaning.first());
    sha256(text.as_bytes())[..DIGITS].to_owned()
}

/// The version of `judged`, one of `verdicts`, from its meaning in `paper`; `None` if the paper does not have the claim.
pub fn version_in(paper: &Paper, verdicts: &Verdicts, judged: &ClaimVerdict) -> Option<String> {
    Some(version(verdicts, judged, &meaning(paper, paper.claim(&judged.claim)?)))
}

/// The text that cites `judged`, one of `verdicts`, in this `version`.
pub fn citation(verdicts: &Verdicts, judged: &ClaimVerdict, version: &str) -> String {
    let replan = env!("CARGO_PKG_VERSION");
    format!(
        "{} {}: {}, version {version} (replan {replan})",
        verdicts.paper,
        judged.claim,
        judged.verdict_text()
    )
}
