//! Judges every claim of a paper, and which claims hold together.

use super::check::checks;
use super::evidence::{Evidence, default_point};
use super::together::together;
use super::verdict::{Finding, Judged, Verdict, Verdicts};
use crate::study::paper::{Claim, Paper};
use base::hash::sha256;
use base::settings::{Faults, SettingsError, none_called};
use rayon::prelude::*;

/// Builds every check of every claim, so that `replan check` finds what is wrong before anything runs.
///
/// # Errors
/// All at once: an unknown check, a metric that the study does not produce, a problem group or contender that it lacks.
pub fn validate(paper: &Paper) -> Result<(), SettingsError> {
    let mut faults = Faults::default();
    for study in &paper.studies {
        for (index, id) in study.fitted_to.iter().enumerate() {
            if paper.claim(id).is_none() {
                let known = paper.claims.iter().map(|claim| claim.id.as_str());
                let message = format!("fitted_to: {}", none_called("claim", id, known));
                faults.add(study.document.error_at(&format!("fitted_to.{index}"), message));
            }
        }
    }
    let point = default_point(paper);
    for claim in &paper.claims {
        faults.keep(checks(paper, &point, claim));
    }
    faults.done()
}

/// The hash of what claims say and how they are judged, for manifests: wording and ledger do not count.
pub fn claims_hash(paper: &Paper) -> String {
    let judged = paper.claims.iter().map(|claim| {
        let checks: Vec<String> =
            claim.checks.iter().map(|(name, settings)| format!("{name}: {}", settings.table())).collect();
        format!("{} {:?} {:?} {:?} {checks:?}\n", claim.id, claim.printed, claim.digits, claim.untestable)
    });
    sha256(judged.collect::<String>().as_bytes())
}

/// Judges every claim under the evidence's reading.
///
/// # Errors
/// Those of [`validate`].
pub fn judge(evidence: &Evidence<'_>) -> Result<Verdicts, SettingsError> {
    let paper = evidence.paper;
    // Gathered in order before any error is passed on, so that it is the first claim's.
    let claims = || paper.claims.par_iter().map(|claim| judge_claim(evidence, claim)).collect::<Vec<_>>();
    let (claims, sets) = rayon::join(claims, || together(evidence));
    let hash = claims_hash(paper);
    let changed = evidence.runs().filter(|run| run.manifest.claims != hash);
    Ok(Verdicts {
        paper: paper.id.clone(),
        command: evidence.runs().next().map_or_else(String::new, |run| run.manifest.command.clone()),
        quick: evidence.runs().any(|run| run.manifest.quick),
        reading: evidence.point.choices().clone(),
        claims_changed_since: changed.map(|run| run.study.name.clone()).collect(),
        claims: claims.into_iter().collect::<Result<_, _>>()?,
        together: sets?,
    })
}

fn judge_claim(evidence: &Evidence<'_>, claim: &Claim) -> Result<Judged, SettingsError> {
    let mut findings = Vec::new();
    for (_, check) in checks(evidence.paper, &evidence.point, claim)? {
        findings.push(check.judge(evidence));
    }
    if let Some(reason) = &claim.untestable {
        let because = vec![reason.clone()];
        let check = "none".to_owned();
        findings.push(Finding { check, verdict: Some(Verdict::Untestable), because, ..Finding::default() });
    }
    let verdict = combine(&findings);
    let deciding = findings.iter().find(|finding| finding.verdict == Some(verdict));
    let reading = deciding.and_then(|finding| finding.reading.clone());
    Ok(Judged {
        claim: claim.id.clone(),
        at: claim.at.clone(),
        says: claim.says.clone(),
        quote: claim.quote.clone(),
        printed: claim.printed.clone(),
        unit: claim.unit.clone(),
        verdict,
        theorem: claim.theorem.clone(),
        reading: reading.unwrap_or_else(|| evidence.point.name().to_owned()),
        findings,
    })
}

/// The verdict over all checks: a proof that it cannot be outweighs everything, otherwise the weakest counts, so
/// that nothing comes out better than it is. A claim that was only checked for possibility stays undecided.
fn combine(findings: &[Finding]) -> Verdict {
    findings.iter().filter_map(|finding| finding.verdict).max().unwrap_or(Verdict::Undecided)
}
