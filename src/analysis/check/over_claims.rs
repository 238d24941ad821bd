//! A sentence that is asked in several ways, each a claim of its own: whether all of them, some or none hold.

use super::{Check, Entry, verdict_on};
use crate::analysis::evidence::Evidence;
use crate::analysis::verdict::{Finding, Verdict};
use crate::study::paper::Claim;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "over_claims",
    about: "a sentence that several claims ask in their own ways: do all, some or none of them hold?",
    settings: Accepted::of::<Settings>(),
    example: r#"
claims = ["edges.chs", "edges.chs.turn", "edges.chs.r2"]
"#,
    build: |context| {
        let settings: Settings = context.settings.read()?;
        let claims = settings.claims.iter().map(|id| context.claim_called(id));
        let claims: Vec<&Claim> = claims.collect::<Result<_, _>>()?;
        if claims.len() < 2 || claims.iter().any(|claim| claim.checks.contains_key(ENTRY.name)) {
            let message = "`claims` needs at least two, none of which is over claims itself";
            return Err(context.settings.error_at("claims", message));
        }
        Ok(Box::new(OverClaims { claims }))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The claims that are met or not together, by id.
    claims: Vec<String>,
}

struct OverClaims<'a> {
    claims: Vec<&'a Claim>,
}

impl Check for OverClaims<'_> {
    fn judge(&self, evidence: &Evidence<'_>) -> Finding {
        let mut finding = Finding::of(ENTRY.name);
        let verdict = |claim: &&Claim| verdict_on(evidence, claim).unwrap_or(Verdict::Undecided);
        let verdicts: Vec<Verdict> = self.claims.iter().map(verdict).collect();
        for verdict in Verdict::ALL {
            let with = self.claims.iter().zip(&verdicts).filter(|(_, found)| **found == verdict);
            let ids: Vec<String> = with.map(|(claim, _)| format!("`{}`", claim.id)).collect();
            if !ids.is_empty() {
                finding.because.push(format!("{}: {}", verdict.name(), ids.join(", ")));
            }
        }
        finding.verdict = Some(overall(&verdicts));
        if finding.verdict == Some(Verdict::Undecided) {
            let why = "the sentence does not say which is meant, and they do not agree";
            finding.because.push(why.to_owned());
        }
        finding
    }
}

/// The verdict that all have; undecided where some hold and others do not; otherwise the weakest.
fn overall(verdicts: &[Verdict]) -> Verdict {
    let holds = |verdict: &&Verdict| **verdict <= Verdict::Attainable;
    let held = verdicts.iter().filter(holds).count();
    let weakest = verdicts.iter().copied().max().unwrap_or(Verdict::Undecided);
    if held == 0 || held == verdicts.len() { weakest } else { Verdict::Undecided }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn some_that_hold_and_some_that_do_not_decide_nothing() {
        let (yes, sign, no) = (Verdict::Reproduced, Verdict::DirectionOnly, Verdict::NotReproduced);
        assert_eq!(overall(&[yes, no]), Verdict::Undecided);
        assert_eq!(overall(&[yes, yes]), yes);
        assert_eq!(overall(&[sign, no]), no);
        assert_eq!(overall(&[yes, Verdict::Attainable]), Verdict::Attainable);
    }
}
