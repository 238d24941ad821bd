//! Whether the printed number is met exactly by any stored trial, alone or together with other printed numbers.

use super::{Check, Context, Entry};
use crate::analysis::evidence::{Evidence, Pair, Run};
use crate::analysis::metric::Metric;
use crate::analysis::verdict::{Estimate, Finding, Verdict};
use crate::study::record::Row;
use crate::study::{Reading, ReadingChoice, Study};
use audit::printed::{Digits, Printed};
use base::settings::{Accepted, SettingsError};
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::sync::Arc;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "attained",
    about: "does any stored trial meet the printed number exactly, where other named claims are met too?",
    settings: Accepted::of::<Settings>(),
    example: r#"
metric = "expansions"
contenders = ["Original A*"]
in = [{ study = "particle", problems = ["plane"] }]
"#,
    build: |context| Ok(Box::new(Attained::new(context)?)),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The metric, or the metric whose reduction is claimed.
    metric: String,
    /// Contenders that may stand for the paper's.
    contenders: Vec<String>,
    /// Contender that a reduction is relative to.
    against: Option<String>,
    /// Where to look.
    r#in: Vec<Place>,
    /// Claims that must be met on the same problem.
    #[serde(default)]
    given: Vec<String>,
}

#[derive(Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Place {
    /// The study whose records are looked at.
    study: String,
    /// The problem groups, by their labels.
    problems: Vec<String>,
    /// Its problems were drawn until the claim held: they serve where the claim is given, and say nothing of how often
    /// it holds.
    #[serde(default)]
    selected: bool,
}

/// Where a claim's number is looked for.
pub struct Attained<'a> {
    settings: Settings,
    metric: &'static Metric,
    printed: Printed,
    digits: Digits,
    given: Vec<Attained<'a>>,
    claim: &'a str,
    /// The readings of the paper.
    readings: Vec<Reading>,
}

/// A trial that was looked at, and its value. Names are made of the few that are shown.
pub struct Seen<'e> {
    run: &'e Run<'e>,
    /// The trial.
    pub row: &'e Row,
    /// The contender that stands for the paper's.
    pub contender: &'e str,
    /// What the claim's number is there.
    pub value: f64,
    /// The reading that it ran under.
    pub reading: Arc<str>,
    selected: bool,
}

/// What tells problems under one reading apart: study, group, draw and query.
pub type Problem<'e> = (&'e str, &'e str, u32, Option<&'e str>);

impl<'e> Seen<'e> {
    /// The problem that it is about.
    pub fn problem(&self) -> Problem<'e> {
        let key = &self.row.key;
        (&self.run.study.name, &key.on.group, key.on.draw, key.query.as_deref())
    }
}

/// Refuses contenders that depart from readings which the paper does not have.
fn check_departures(study: &Study, readings: &[Reading]) -> Result<(), SettingsError> {
    for (index, contender) in study.contenders.iter().enumerate() {
        ReadingChoice::new(readings, &contender.departs)
            .map_err(|message| study.document.error_at(&format!("contender.{index}.departs"), message))?;
    }
    Ok(())
}

impl<'a> Attained<'a> {
    /// The check of the claim of `context`.
    ///
    /// # Errors
    /// A settings error of the check.
    pub fn new(context: &Context<'a>) -> Result<Self, SettingsError> {
        let settings: Settings = context.settings.read()?;
        let readings = context.paper.readings();
        let mut metric = None;
        for (index, place) in settings.r#in.iter().enumerate() {
            let wanted = settings.contenders.iter().chain(&settings.against);
            // A place need not have every contender, but each must exist in some place.
            let study = context.study_in(&format!("in.{index}"), &place.study, &place.problems, &[])?;
            metric = Some(context.metric(&settings.metric, study)?);
            check_departures(study, &readings)?;
            for label in wanted {
                let is_known = settings.r#in.iter().any(|place| {
                    context
                        .paper
                        .study(&place.study)
                        .is_some_and(|study| study.contenders.iter().any(|c| c.label == *label))
                });
                if !is_known {
                    let message = format!("no study that is looked at has a contender `{label}`");
                    return Err(context.settings.error_about("", &super::CONTENDER_KEYS, label, message));
                }
            }
        }
        let metric =
            metric.ok_or_else(|| context.settings.error_at("in", "`in` names no study to look at"))?;
        let mut given = Vec::new();
        for id in &settings.given {
            let claim = context.claim_called(id)?;
            let settings = claim.checks.get(ENTRY.name).ok_or_else(|| {
                let message = format!("claim `{id}` cannot be given: it has no `attained` check");
                context.settings.error_about("", &["given"], id, message)
            })?;
            given.push(Attained::new(&Context { claim, settings, ..*context })?);
        }
        let printed = context.printed()?;
        let (digits, claim) = (context.digits(), context.claim.id.as_str());
        Ok(Self { settings, metric, printed, digits, given, claim, readings })
    }

    /// The claim's id.
    pub fn claim(&self) -> &'a str {
        self.claim
    }

    /// Whether `value` prints as the claim's number.
    pub fn is_met(&self, value: f64) -> bool {
        self.printed.agrees(value, self.digits)
    }

    /// Every trial in which the claim's number was looked for under the evidence's reading.
    pub fn seen<'e>(&'e self, evidence: &'e Evidence<'_>) -> Vec<Seen<'e>> {
        let mut seen = Vec::new();
        for place in &self.settings.r#in {
            let Some(run) =
                evidence.run(&place.study).filter(|run| self.is_asked_of(run.study, &evidence.point))
            else {
                continue;
            };
            let reading = |label: &'e String| (label, self.reading_of(run.study, &evidence.point, label));
            let contenders: Vec<_> = self.settings.contenders.iter().map(reading).collect();
            for group in &place.problems {
                for (contender, reading) in &contenders {
                    seen.extend(self.seen_in(run, reading, (group, place.selected), contender));
                }
            }
        }
        seen
    }

    /// Whether the trials of `study` can run under the reading at all: it has every axis along which that departs.
    fn is_asked_of(&self, study: &Study, point: &ReadingChoice) -> bool {
        let departs = |reading: &Reading| {
            let taken = point.choices().get(&reading.id);
            reading.touches_trials() && taken.is_some_and(|option| *option != reading.default)
        };
        let has = |reading: &Reading| study.readings.iter().any(|own| own.id == reading.id);
        self.readings.iter().all(|reading| !departs(reading) || has(reading))
    }

    /// The reading that the contender called `label` runs under.
    fn reading_of(&self, study: &Study, point: &ReadingChoice, label: &str) -> Arc<str> {
        let contender = study.contenders.iter().find(|contender| contender.label == label);
        let Some(contender) = contender.filter(|contender| !contender.departs.is_empty()) else {
            return point.name().into();
        };
        let mut choices = point.choices().clone();
        choices.extend(contender.departs.clone());
        let point = ReadingChoice::new(&self.readings, &choices);
        point.expect("departures were looked up when the check was built").name().into()
    }

    /// The trials of `contender` in one problem group, which was selected or not.
    fn seen_in<'e>(
        &self,
        run: &'e Run<'e>,
        reading: &Arc<str>,
        (group, selected): (&str, bool),
        contender: &'e str,
    ) -> Vec<Seen<'e>> {
        let base = self.settings.against.as_deref().unwrap_or(contender);
        let value = |pair: &Pair<'_>| {
            let other = run.value(pair.other, self.metric)?;
            if self.settings.against.is_none() {
                return Some(other);
            }
            let base = run.value(pair.base, self.metric)?;
            (base > 0.0).then(|| 100.0 * (base - other) / base)
        };
        let pairs = run.pairs(group, base, contender);
        let seen = pairs.iter().filter_map(|pair| {
            let (row, value, reading) = (pair.other, value(pair)?, reading.clone());
            Some(Seen { run, row, contender, value, reading, selected })
        });
        seen.collect()
    }

    /// Every trial on a problem where all given claims are met.
    fn eligible<'e>(&'e self, evidence: &'e Evidence<'_>) -> Vec<Seen<'e>> {
        let mut eligible = self.seen(evidence);
        for given in &self.given {
            let mut met: BTreeMap<Problem<'_>, bool> = BTreeMap::new();
            for seen in given.seen(evidence) {
                *met.entry(seen.problem()).or_default() |= given.is_met(seen.value);
            }
            eligible.retain(|seen| met.get(&seen.problem()).copied().unwrap_or(false));
        }
        eligible
    }
}

impl Check for Attained<'_> {
    fn judge(&self, evidence: &Evidence<'_>) -> Finding {
        let (selected, eligible): (Vec<Seen<'_>>, Vec<Seen<'_>>) =
            self.eligible(evidence).into_iter().partition(|seen| seen.selected);
        let met: Vec<&Seen<'_>> = eligible.iter().filter(|seen| self.is_met(seen.value)).collect();
        let given: Vec<&str> = self.given.iter().map(|given| given.claim).collect();
        let condition =
            if given.is_empty() { String::new() } else { format!(" on which {} hold", given.join(", ")) };
        let distance = |seen: &Seen<'_>| (seen.value - self.printed.value()).abs();
        let nearest = eligible.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let mut finding = Finding::of(ENTRY.name);
        if let Some(shown) = met.first().copied().or(nearest) {
            finding.trial = Some(shown.run.trial(shown.row));
            finding.reading = Some(shown.reading.to_string()).filter(|name| name != evidence.point.name());
            let found = if met.is_empty() { "nearest" } else { "met" };
            let what = format!("{found}, {} by {}", self.title(), shown.contender);
            finding.ours = Some(Estimate { value: shown.value, interval: None, what, n: eligible.len() });
        }
        finding.verdict = Some(if met.is_empty() { Verdict::Undecided } else { Verdict::Attainable });
        finding.because.push(match met.first() {
            Some(first) => format!(
                "met by {} of {} trials{condition}; first by `{}` on {}, reading {}",
                met.len(),
                eligible.len(),
                first.contender,
                first.run.problem(first.row),
                first.reading
            ),
            None => {
                format!("met by none of {} trials{condition}; this proves nothing either way", eligible.len())
            }
        });
        let more = selected.len();
        finding.because.extend((more > 0).then(|| {
            format!("{more} more trials are on maps that were drawn until it held, and do not count")
        }));
        finding
    }
}

impl Attained<'_> {
    /// What the value is, with its unit.
    fn title(&self) -> String {
        if self.settings.against.is_some() {
            return format!("reduction of {} (%)", self.metric.label.to_lowercase());
        }
        self.metric.title()
    }
}
