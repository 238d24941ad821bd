//! Judges every claim of a paper, and which claims hold together.

use super::check::{self, Check, Context, attained_problems};
use super::evidence::Evidence;
use super::verdict::{Finding, Judged, Together, Verdict, Verdicts};
use crate::settings::SettingsError;
use crate::study::paper::{Claim, Paper};
use crate::study::store::sha256;
use std::collections::{BTreeMap, BTreeSet};

/// Builds every check of every claim, so that `replan check` finds what is wrong before anything runs.
///
/// # Errors
/// An unknown check, a metric that the study does not produce, a problem group or contender that it lacks.
pub fn validate(paper: &Paper) -> Result<(), SettingsError> {
    for study in &paper.studies {
        for id in &study.fitted_to {
            if paper.claim(id).is_none() {
                let message = format!("fitted_to names the claim `{id}`, which {} does not have", paper.id);
                return Err(study.document.error(0..0, message));
            }
        }
    }
    paper.claims.iter().try_for_each(|claim| checks(paper, claim).map(|_| ()))
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
    let claims = paper.claims.iter().map(|claim| judge_claim(evidence, claim));
    let hash = claims_hash(paper);
    let changed = evidence.runs().filter(|run| run.manifest.claims != hash);
    Ok(Verdicts {
        paper: paper.id.clone(),
        command: evidence.runs().next().map_or_else(String::new, |run| run.manifest.command.clone()),
        quick: evidence.runs().any(|run| run.manifest.quick),
        reading: evidence.point.choices().clone(),
        claims_changed_since: changed.map(|run| run.study.name.clone()).collect(),
        claims: claims.collect::<Result<_, _>>()?,
        together: together(evidence)?,
    })
}

fn checks<'a>(
    paper: &'a Paper,
    claim: &'a Claim,
) -> Result<Vec<(&'static str, Box<dyn Check + 'a>)>, SettingsError> {
    let mut built = Vec::new();
    for (name, settings) in &claim.checks {
        let entry = check::find(name).ok_or_else(|| {
            let known: Vec<&str> = check::REGISTRY.iter().map(|entry| entry.name).collect();
            let message = format!(
                "claim `{}` asks for the check `{name}`, which does not exist; the checks are {}",
                claim.id,
                known.join(", ")
            );
            settings.error(message)
        })?;
        built.push((entry.name, (entry.build)(&Context { claim, settings, paper })?));
    }
    Ok(built)
}

fn judge_claim(evidence: &Evidence<'_>, claim: &Claim) -> Result<Judged, SettingsError> {
    let mut findings = Vec::new();
    for (_, check) in checks(evidence.paper, claim)? {
        findings.push(check.judge(evidence));
    }
    if let Some(reason) = &claim.untestable {
        let because = vec![reason.clone()];
        let check = "none".to_owned();
        findings.push(Finding { check, verdict: Some(Verdict::Untestable), because, ..Finding::default() });
    }
    Ok(Judged {
        claim: claim.id.clone(),
        at: claim.at.clone(),
        says: claim.says.clone(),
        printed: claim.printed.clone(),
        unit: claim.unit.clone(),
        verdict: combine(&findings),
        reading: evidence.point.name().to_owned(),
        findings,
    })
}

/// The verdict over all checks: a proof that it cannot be outweighs everything, otherwise the weakest counts, so
/// that nothing comes out better than it is. A claim that was only checked for possibility stays undecided.
fn combine(findings: &[Finding]) -> Verdict {
    findings.iter().filter_map(|finding| finding.verdict).max().unwrap_or(Verdict::Undecided)
}

/// For every problem on which any claim is met exactly: which claims hold there and which fail, by the contender
/// that stands for the paper's.
fn together(evidence: &Evidence<'_>) -> Result<Vec<Together>, SettingsError> {
    let mut outcomes: BTreeMap<(String, String), BTreeMap<String, BTreeMap<String, bool>>> = BTreeMap::new();
    for claim in &evidence.paper.claims {
        let Some(settings) = claim.checks.get("attained") else { continue };
        let context = Context { claim, settings, paper: evidence.paper };
        for (study, problem, contender, is_met) in attained_problems(&context, evidence)? {
            let by_contender = outcomes.entry((study, problem)).or_default();
            by_contender.entry(contender).or_default().insert(claim.id.clone(), is_met);
        }
    }
    let mut sets: Vec<Together> = outcomes.into_iter().flat_map(|(place, by)| sets_of(&place, &by)).collect();
    sets.sort_by_key(|set| std::cmp::Reverse(set.hold.len()));
    let mut known = BTreeSet::new();
    sets.retain(|set| set.hold.len() > 1 && known.insert(set.hold.clone()));
    sets.truncate(LISTED_SETS);
    Ok(sets)
}

/// How many sets of jointly holding claims are listed, the largest first.
const LISTED_SETS: usize = 12;

/// One set per contender that is an alternative for the paper's improved one; contenders that no other contender
/// shares a claim with belong to every set.
fn sets_of(
    (study, problem): &(String, String),
    by_contender: &BTreeMap<String, BTreeMap<String, bool>>,
) -> Vec<Together> {
    let claims_of = |label: &String| by_contender[label].keys().cloned().collect::<BTreeSet<_>>();
    let rivals = |label: &String| {
        by_contender.keys().any(|other| other != label && !claims_of(other).is_disjoint(&claims_of(label)))
    };
    let (alternatives, fixed): (Vec<&String>, Vec<&String>) = by_contender.keys().partition(|l| rivals(l));
    let choices: Vec<Option<&String>> =
        if alternatives.is_empty() { vec![None] } else { alternatives.into_iter().map(Some).collect() };
    let set = |choice: Option<&String>| {
        let labels: Vec<&String> = fixed.iter().copied().chain(choice).collect();
        let (mut hold, mut fail) = (Vec::new(), Vec::new());
        for (claim, is_met) in labels.iter().flat_map(|label| &by_contender[*label]) {
            if *is_met { hold.push(claim.clone()) } else { fail.push(claim.clone()) }
        }
        hold.sort();
        fail.sort();
        let under = labels.into_iter().cloned().collect::<Vec<_>>().join(" and ");
        Together { study: study.clone(), problem: problem.clone(), under, hold, fail }
    };
    choices.into_iter().map(set).collect()
}
