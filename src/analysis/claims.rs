//! Judges every claim of a paper, and which claims hold together.

use super::class::{self, Caps, Polarity, Sessions, Verdict};
use super::context::Context;
use super::criterion::{self, Criterion};
use super::evidence::{Evidence, Run, default_point};
use super::found::Found;
use super::metric;
use super::rule;
use super::settle::settles;
use super::together::together;
use super::verdict::{Finding, Judged, Verdicts};
use crate::study::paper::{Asked, Claim, Paper, Parts};
use base::hash::sha256;
use base::settings::{Faults, SettingsError, none_called};
use rayon::prelude::*;
use std::collections::BTreeMap;

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
                faults.add(study.document.error_at(&format!("fitted_to.{index}"), message).about(id));
            }
        }
    }
    check_metrics(paper, &mut faults);
    let point = default_point(paper);
    for claim in &paper.claims {
        for (asked, name, settings) in claim.asked() {
            let context = Context { claim, settings, paper, point: &point };
            faults.keep(Built::new(asked, name, &context).map(|_| ()));
        }
    }
    faults.done()
}

/// Refuses options of readings that give a name the meaning of a metric that does not exist.
fn check_metrics(paper: &Paper, faults: &mut Faults) {
    for study in &paper.studies {
        for (index, reading) in study.readings.iter().enumerate() {
            let options = reading.options.iter();
            let named = options.flat_map(|(option, change)| change.metric.iter().map(move |m| (option, m)));
            for (option, (name, metric)) in named.filter(|(_, (_, metric))| metric::find(metric).is_none()) {
                let message = none_called("metric", metric, metric::METRICS.iter().map(|metric| metric.name));
                let place = format!("reading.{index}.option.{option}.metric.{name}");
                faults.add(study.document.error_at(&place, message));
            }
        }
    }
}

/// The hash of what claims say and how they are judged, for manifests: wording and ledger do not count.
pub fn claims_hash(paper: &Paper) -> String {
    let judged = paper.claims.iter().map(|claim| {
        let asked: Vec<String> = claim
            .asked()
            .map(|(asked, name, settings)| format!("{asked:?} {name}: {}", settings.table()))
            .collect();
        let parts = &claim.parts;
        format!(
            "{} {:?} {:?} {:?} {asked:?} {parts:?}\n",
            claim.id, claim.printed, claim.digits, claim.untestable
        )
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
    let alone: Vec<_> = paper.claims.par_iter().map(|claim| judge_alone(evidence, claim)).collect();
    let claims = with_parts(paper, alone.into_iter().collect::<Result<_, _>>()?);
    let hash = claims_hash(paper);
    let changed = evidence.runs().filter(|run| run.manifest.claims != hash);
    Ok(Verdicts {
        paper: paper.id.clone(),
        command: evidence.runs().next().map_or_else(String::new, |run| run.manifest.command.clone()),
        quick: evidence.runs().any(|run| run.manifest.quick),
        reading: evidence.point.choices().clone(),
        claims_changed_since: changed.map(|run| run.study.name.clone()).collect(),
        claims,
        together: together(evidence)?,
    })
}

/// A criterion or rule, built.
enum Built<'a> {
    Criterion(Box<dyn Criterion + 'a>, &'static criterion::Entry),
    Rule(Box<dyn rule::Rule + 'a>),
}

impl<'a> Built<'a> {
    fn new(asked: Asked, name: &str, context: &Context<'a>) -> Result<Self, SettingsError> {
        let unknown = |what: &str, known: Vec<&'static str>| {
            let message =
                format!("claim `{}`: {}", context.claim.id, none_called(what, name, known.into_iter()));
            context.settings.error(message)
        };
        if asked == Asked::Rule {
            let entry = rule::find(name)
                .ok_or_else(|| unknown("rule", rule::REGISTRY.iter().map(|entry| entry.name).collect()))?;
            return Ok(Self::Rule((entry.build)(context)?));
        }
        let entry = criterion::find(name).ok_or_else(|| {
            unknown("criterion", criterion::REGISTRY.iter().map(|entry| entry.name).collect())
        })?;
        Ok(Self::Criterion((entry.build)(context)?, entry))
    }
}

/// One claim by its own criteria and rules.
fn judge_alone(evidence: &Evidence<'_>, claim: &Claim) -> Result<Judged, SettingsError> {
    let mut findings = Vec::new();
    for (asked, name, settings) in claim.asked() {
        let context = Context { claim, settings, paper: evidence.paper, point: &evidence.point };
        let mut finding = match Built::new(asked, name, &context)? {
            Built::Rule(rule) => of_rule(name, rule.find(evidence)),
            Built::Criterion(criterion, entry) => of_criterion(entry.name, &*criterion, evidence, claim),
        };
        if asked == Asked::Shown {
            (finding.verdict, finding.settles) = (None, None);
        }
        findings.push(finding);
    }
    let verdicts = findings.iter().filter_map(|finding| finding.verdict);
    let verdict = class::combined(verdicts, claim.untestable.is_some());
    Ok(judged(evidence, claim, verdict, findings))
}

fn judged(evidence: &Evidence<'_>, claim: &Claim, verdict: Verdict, mut findings: Vec<Finding>) -> Judged {
    if let Some(reason) = &claim.untestable {
        let because = vec![reason.clone()];
        let (criterion, verdict) = ("none".to_owned(), Some(Verdict::Untestable));
        findings.push(Finding { criterion, verdict, because, ..Finding::default() });
    }
    let deciding = findings.iter().find(|finding| finding.verdict == Some(verdict));
    let reading = deciding.and_then(|finding| finding.reading.clone());
    Judged {
        claim: claim.id.clone(),
        at: claim.at.clone(),
        says: claim.says.clone(),
        quote: claim.quote.clone(),
        printed: claim.printed.clone(),
        unit: claim.unit.clone(),
        verdict,
        theorem: claim.theorem.clone(),
        part_of: evidence.paper.whole_of(&claim.id).map(|whole| whole.id.clone()),
        changed_after_run: claim.changed_after_run.clone(),
        reading: reading.unwrap_or_else(|| evidence.point.name().to_owned()),
        findings,
    }
}

fn of_rule(name: &str, found: Found) -> Finding {
    let caps =
        Caps { existential: found.existential, without_premises: found.without_premises, ..Caps::default() };
    let mut finding = finding(name, found, caps);
    if caps.without_premises && finding.verdict.is_none() {
        finding.because.push("the premises of the proof do not hold under this reading".to_owned());
    }
    finding
}

fn finding(criterion: &str, found: Found, caps: Caps) -> Finding {
    let verdict = found.outcome.and_then(|outcome| class::of_finding(outcome, caps));
    let settles = (verdict == Some(Verdict::Undecided)).then(|| settles(&found, caps));
    Finding {
        criterion: criterion.to_owned(),
        verdict,
        ours: found.ours,
        trial: found.trial,
        reading: found.reading,
        settles,
        because: found.because,
        premises: found.premises,
    }
}

fn of_criterion(name: &str, of: &dyn Criterion, evidence: &Evidence<'_>, claim: &Claim) -> Finding {
    let found = of.find(evidence);
    let studies = of.studies();
    let caps = Caps {
        searched: studies.iter().any(|study| study.searched),
        fitted: studies.iter().any(|study| study.fitted_to.contains(&claim.id)),
        existential: found.existential,
        powerless: found.powerless,
        censored: found.censored > 0,
        few: found.needs.is_some(),
        clock: of.is_clock().then(|| sessions(of, evidence)),
        without_premises: found.without_premises,
    };
    finding(name, found, caps)
}

/// What the stored sessions of the clock say, each judged by itself.
fn sessions(of: &dyn Criterion, evidence: &Evidence<'_>) -> Sessions {
    let stored = of.studies().iter().filter_map(|study| evidence.run(&study.name)).map(Run::sessions).min();
    let count = stored.unwrap_or(0);
    if count < class::SESSIONS {
        return Sessions::TooFew;
    }
    let outcome = |session: usize| of.find(&evidence.in_session(session as u32)).outcome;
    let first = outcome(1);
    if (2..=count).all(|session| outcome(session) == first) { Sessions::Agree } else { Sessions::Disagree }
}

/// What would settle a sentence whose parts leave it open.
fn parts_settle(parts: &Parts, verdicts: &[Verdict]) -> String {
    let speaks = |wanted| verdicts.iter().any(|verdict| verdict.polarity() == wanted);
    if matches!(parts, Parts::MeansOneOf(_)) && speaks(Polarity::For) && speaks(Polarity::Against) {
        return "which of its parts is meant: the paper does not say, and they speak both ways".to_owned();
    }
    "what settles its parts".to_owned()
}

/// Sentences of parts and rows of cells take their class from theirs.
fn with_parts(paper: &Paper, mut judged: Vec<Judged>) -> Vec<Judged> {
    let alone: BTreeMap<String, Verdict> =
        judged.iter().map(|one| (one.claim.clone(), one.verdict)).collect();
    for (claim, judged) in paper.claims.iter().zip(&mut judged) {
        let (name, of, ids): (_, fn(&[Verdict]) -> Verdict, _) = match &claim.parts {
            Parts::None => continue,
            // A row with criteria of its own is judged by them; its cells are shown.
            Parts::Cells(_) if claim.asked().next().is_some() => continue,
            Parts::AllOf(ids) => ("all_of", class::all_of, ids),
            Parts::Cells(ids) => ("cells", class::all_of, ids),
            Parts::AnyOf(ids) => ("any_of", class::any_of, ids),
            Parts::MeansOneOf(ids) => ("means_one_of", class::one_meant, ids),
        };
        let verdicts: Vec<Verdict> = ids.iter().map(|id| alone[id]).collect();
        let listed = |verdict: Verdict| {
            let with = ids.iter().zip(&verdicts).filter(|(_, found)| **found == verdict);
            let ids: Vec<String> = with.map(|(id, _)| format!("`{id}`")).collect();
            (!ids.is_empty()).then(|| format!("{}: {}", verdict.name(), ids.join(", ")))
        };
        let because = Verdict::ALL.into_iter().filter_map(listed).collect();
        let verdict = of(&verdicts);
        judged.findings.push(Finding {
            criterion: name.to_owned(),
            verdict: Some(verdict),
            because,
            settles: (verdict == Verdict::Undecided).then(|| parts_settle(&claim.parts, &verdicts)),
            ..Finding::default()
        });
        let found = judged.findings.iter().filter(|finding| finding.criterion != "none");
        judged.verdict =
            class::combined(found.filter_map(|finding| finding.verdict), claim.untestable.is_some());
    }
    judged
}
