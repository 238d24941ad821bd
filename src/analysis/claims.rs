//! Judges every claim of a paper, and which claims hold together.

use super::claim_test::{CappedFinding, ClaimTest, claim_tests, premises};
use super::context;
use super::criterion;
use super::evidence::{Evidence, default_point};
use super::meaning;
use super::metric;
use super::outcome::{self, Caps, Outcome};
use super::rule;
use super::settle::{nothing_decides, parts_settle};
use super::tabulated;
use super::together::together;
use super::verdict::{ClaimVerdict, CriterionFinding, Verdicts};
use super::verdict_rule::{Chosen, Verdict};
use base::hash::sha256;
use base::settings::{Faults, Settings, SettingsError, in_first_words, none_called};
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use study::paper::{Claim, Paper, Parts, PrintedTable, TestRole, names_of};
use toml::Table;

/// Builds every criterion and rule of every claim, so that `replan check` finds what is wrong before anything runs.
///
/// # Errors
/// Everything at once: criteria and rules that do not exist, metrics that a study does not produce, problem groups and
/// contenders that it lacks.
pub fn validate(paper: &Paper) -> Result<(), SettingsError> {
    let mut faults = Faults::default();
    let ids = || paper.claims.iter().map(|claim| claim.id.as_str());
    for study in &paper.studies {
        for (index, id) in study.fitted_to.iter().enumerate() {
            if paper.claim(id).is_none() {
                let message = format!("fitted_to: {}", none_called("claim", id, ids()));
                let error = study.document.error_at(&format!("fitted_to.{index}"), message).about(id);
                faults.add(error.about(&names_of("claim")).about("id"));
            }
        }
    }
    check_metrics(paper, &mut faults);
    let point = default_point(paper);
    for claim in &paper.claims {
        faults.keep(context::printed(paper, claim));
        for test in claim_tests(paper, claim, &point) {
            faults.keep(test);
        }
    }
    for cell in paper.tables.iter().flat_map(PrintedTable::cells) {
        let claim = cell.claim.as_ref().and_then(|id| paper.claim(id));
        if let (Some(claim), Some(beside)) = (claim, &cell.beside) {
            faults.keep(tabulated::selected(paper, (claim, &point), beside).map(drop));
        }
    }
    faults.done()
}

/// Refuses options that give a name the meaning of a metric that does not exist.
fn check_metrics(paper: &Paper, faults: &mut Faults) {
    for choice in &paper.choices {
        let options = choice.options.iter();
        let named = options.flat_map(|(option, change)| change.metric.iter().map(move |m| (option, m)));
        for (option, (name, metric)) in named.filter(|(_, (_, metric))| metric::find(metric).is_none()) {
            let message = none_called("metric", metric, metric::METRICS.iter().map(|metric| metric.name));
            faults.add(choice.error(&["option", option, "metric", name], message));
        }
    }
}

/// What a claim says and how it is judged, in a line.
fn question(claim: &Claim) -> String {
    let test = |(role, name, settings): (TestRole, &str, &Settings)| {
        format!("{role:?} {name}: {}", in_first_words(settings.table()))
    };
    let tests = claim.tests().map(test).collect::<Vec<_>>();
    let parts = &claim.parts;
    let when = premises(claim).map(|premise| format!(" {premise}")).collect::<Vec<_>>().concat();
    format!(
        "{} {:?} {:?} {:?} {tests:?} {parts:?}{when}\n",
        claim.id, claim.printed, claim.digits, claim.untestable
    )
}

/// The hash of one claim's words and test, with its parts and the claims that its criteria name.
pub fn claim_hash(paper: &Paper, claim: &Claim) -> String {
    let own = question(claim);
    // The text writes every name between quotes.
    let named: BTreeSet<usize> = own.split('"').filter_map(|text| paper.place_of(text)).collect();
    let others: Vec<&Claim> =
        named.into_iter().map(|place| &paper.claims[place]).filter(|other| other.id != claim.id).collect();
    let text: String = others.iter().map(|other| question(other)).collect();
    let revisions: String = std::iter::once(claim).chain(others).map(revisions).collect();
    sha256((own.clone() + &text + &revisions).as_bytes())[..16].to_owned()
}

/// The criteria and rules of a claim that do not find what they found at first, each with its revision.
fn revisions(claim: &Claim) -> String {
    let found = |(role, name, settings): (TestRole, &'_ str, &Settings)| {
        let entry = criterion::find(name).or_else(|| rule::find(name))?;
        // What is shown moves no outcome, however its settings are looked at since.
        let none = Table::new();
        let own = if role == TestRole::Shown { &none } else { settings.table() };
        Some((entry.name, (entry.revision)(own)))
    };
    let revised = claim.tests().filter_map(found).filter(|(_, revision)| *revision > 1);
    revised.map(|(name, revision)| format!("{name} {revision}\n")).collect::<Vec<_>>().concat()
}

/// Judges every claim under the evidence's interpretation alone. [`across`](super::across) turns these outcomes into a
/// verdict.
///
/// # Errors
/// Those of [`validate`].
pub fn judge(evidence: &Evidence<'_>) -> Result<Verdicts, SettingsError> {
    let paper = evidence.paper;
    // Gathered in order before any error is passed on, so that it is the first claim's.
    let alone: Vec<_> = paper.claims.par_iter().map(|claim| judge_alone(evidence, claim)).collect();
    let mut claims = with_parts(evidence, alone.into_iter().collect::<Result<_, _>>()?);
    for (claim, judged) in paper.claims.iter().zip(&mut claims) {
        set_what_settles(claim, judged);
    }
    let mut together = together(evidence)?;
    // A number that no data can give is not met by a trial that prints alike.
    let impossible = claims.iter().filter(|judged| judged.outcome == Outcome::Proved);
    let impossible: BTreeSet<&str> = impossible.map(|judged| judged.claim.as_str()).collect();
    let is_impossible = |id: &String| impossible.contains(id.as_str());
    for set in &mut together {
        let (out, hold) = std::mem::take(&mut set.hold).into_iter().partition(is_impossible);
        set.hold = hold;
        set.fail.extend::<Vec<String>>(out);
        set.fail.sort();
    }
    Ok(Verdicts {
        paper: paper.id.clone(),
        command: evidence.runs().next().map_or_else(String::new, |run| run.manifest.command.clone()),
        quick: evidence.runs().any(|run| run.manifest.quick),
        interpretation: evidence.point.options().clone(),
        explored: None,
        records: records(evidence),
        meanings: meaning::digest(paper),
        history: None,
        remarks: Vec::new(),
        withdrawn: Vec::new(),
        claims,
        together,
        replies: paper.replies.clone(),
    })
}

/// By study the hash of the records that `evidence` is read from.
pub fn records(evidence: &Evidence<'_>) -> BTreeMap<String, String> {
    evidence.runs().map(|run| (run.study.name.clone(), run.manifest.records_hash())).collect()
}

/// One claim by its own criteria and rules.
fn judge_alone(evidence: &Evidence<'_>, claim: &Claim) -> Result<ClaimVerdict, SettingsError> {
    let weigh = |test: Result<ClaimTest<'_>, SettingsError>| {
        let test = test?;
        Ok(test.weighed(&test.numbers(evidence, false), evidence.polylines(), Some(evidence)))
    };
    let weighed: Vec<CappedFinding> = claim_tests(evidence.paper, claim, &evidence.point)
        .map(weigh)
        .collect::<Result<_, SettingsError>>()?;
    let chosen = chosen(&weighed);
    let findings: Vec<CriterionFinding> = weighed.into_iter().map(|one| one.finding).collect();
    let outcomes = findings.iter().filter_map(|finding| finding.outcome);
    let outcome = outcome::combined(outcomes, claim.untestable.is_some());
    Ok(ClaimVerdict { chosen, ..judged(evidence, claim, outcome, findings) })
}

/// How the inputs of a claim were chosen, as its deciding findings have it.
fn chosen(weighed: &[CappedFinding]) -> Option<Chosen> {
    let caps: Vec<Caps> =
        weighed.iter().filter(|one| one.finding.outcome.is_some()).map(|one| one.caps).collect();
    if !caps.is_empty() && caps.iter().all(|caps| caps.existential) {
        return Some(Chosen::Existence);
    }
    let has = |of: fn(&Caps) -> bool, chosen: Chosen| caps.iter().any(of).then_some(chosen);
    has(|caps| caps.searched, Chosen::Searched).or(has(|caps| caps.fitted, Chosen::Fitted))
}

fn judged(
    evidence: &Evidence<'_>,
    claim: &Claim,
    outcome: Outcome,
    mut findings: Vec<CriterionFinding>,
) -> ClaimVerdict {
    if let Some(reason) = &claim.untestable {
        let because = vec![reason.clone()];
        let criterion = "none".to_owned();
        let outcome = Some(Outcome::Lacking);
        findings.push(CriterionFinding { criterion, outcome, because, ..CriterionFinding::default() });
    }
    ClaimVerdict {
        claim: claim.id.clone(),
        at: claim.at.clone(),
        says: claim.says.clone(),
        short: claim.short.clone(),
        quote: claim.quote.clone(),
        printed: claim.printed.clone(),
        unit: claim.unit.clone(),
        verdict: Verdict::Inconclusive,
        beside: Vec::new(),
        depends_on: None,
        outcome,
        chosen: None,
        not_varied: Vec::new(),
        calibrated: Vec::new(),
        theorem: claim.theorem.clone(),
        part_of: evidence.paper.whole_of(&claim.id).map(|whole| whole.id.clone()),
        changed_after_run: claim.changed_after_run.clone(),
        changes: Vec::new(),
        second: None,
        second_p: None,
        is_seedless: false,
        across: None,
        interpretation: evidence.point.name().to_owned(),
        findings,
    }
}

/// What would settle a claim without a deciding finding: it is not meant under this interpretation, or is shown alone.
fn set_what_settles(claim: &Claim, judged: &mut ClaimVerdict) {
    if judged.outcome == Outcome::Open && judged.findings.iter().all(|found| found.settles.is_none()) {
        let premises: Vec<String> = premises(claim).collect();
        let is_possible = judged.possible().is_some();
        if let Some(last) = judged.findings.last_mut() {
            last.settles = Some(nothing_decides(&premises, is_possible));
        }
    }
}

/// How the outcomes of a claim's parts make its own.
pub type OfParts = fn(&[Outcome]) -> Outcome;

/// How a claim takes its outcome from its parts: the name of that way, the way, and the parts' ids. `None` if it does
/// not.
pub fn of_parts(claim: &Claim) -> Option<(&'static str, OfParts, &[String])> {
    Some(match &claim.parts {
        Parts::None => return None,
        // A row with criteria of its own is judged by them; its cells are shown.
        Parts::Cells(_) if claim.tests().next().is_some() => return None,
        Parts::AllOf(ids) => ("all_of", outcome::all_of, ids),
        Parts::Cells(ids) => ("cells", outcome::all_of, ids),
        Parts::AnyOf(ids) => ("any_of", outcome::any_of, ids),
        Parts::MeansOneOf(ids) => ("means_one_of", outcome::one_meant, ids),
    })
}

/// Sentences of parts and rows of cells take their outcome from theirs.
fn with_parts(evidence: &Evidence<'_>, mut judged: Vec<ClaimVerdict>) -> Vec<ClaimVerdict> {
    let alone: BTreeMap<String, (Outcome, Option<Chosen>)> =
        judged.iter().map(|one| (one.claim.clone(), (one.outcome, one.chosen))).collect();
    for (claim, judged) in evidence.paper.claims.iter().zip(&mut judged) {
        let Some((name, of, ids)) = of_parts(claim) else { continue };
        let outcomes: Vec<Outcome> = ids.iter().map(|id| alone[id].0).collect();
        let listed = |outcome: Outcome| {
            let with = ids.iter().zip(&outcomes).filter(|(_, found)| **found == outcome);
            let ids: Vec<String> = with.map(|(id, _)| format!("`{id}`")).collect();
            (!ids.is_empty()).then(|| format!("{}: {}", outcome.name(), ids.join(", ")))
        };
        let because = Outcome::ALL.into_iter().filter_map(listed).collect();
        let outcome = Some(of(&outcomes)).filter(|_| claim.is_meant(&evidence.point));
        judged.findings.push(CriterionFinding {
            criterion: name.to_owned(),
            outcome,
            because,
            premises: premises(claim).collect(),
            settles: (outcome == Some(Outcome::Open)).then(|| parts_settle(&claim.parts, &outcomes)),
            ..CriterionFinding::default()
        });
        let found = judged.findings.iter().filter(|finding| finding.criterion != "none");
        judged.outcome =
            outcome::combined(found.filter_map(|finding| finding.outcome), claim.untestable.is_some());
        let of_parts: Option<Vec<Chosen>> = ids.iter().map(|id| alone[id].1).collect();
        judged.chosen = of_parts.and_then(|all| all.into_iter().max());
    }
    judged
}
