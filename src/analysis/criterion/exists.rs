//! Whether the printed number is met exactly by any stored trial, alone or together with other printed numbers.

mod differs;

use super::{Criterion, Entry};
use crate::analysis::class::Outcome;
use crate::analysis::context::{CONTENDER_KEYS, Context};
use crate::analysis::evidence::{Evidence, Pair, Run};
use crate::analysis::found::Found;
use crate::analysis::metric::Metric;
use crate::analysis::selection_spec::Labels;
use crate::analysis::verdict::Estimate;
use crate::study::record::Row;
use crate::study::{Reading, ReadingChoice, Study};
use audit::exact::Print;
use base::settings::{Accepted, Faults, SettingsError, none_called};
use differs::Differs;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeSet;
use std::sync::Arc;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "exists",
    about: "does any stored trial meet the printed number exactly, where other named claims are met too?",
    settings: Accepted::of::<Settings>(),
    example: r#"
metric = "expansions"
contenders = "Original A*"
in = [{ study = "particle", problems = "plane" }]
"#,
    build: |context| {
        let settings: Settings = context.settings.read()?;
        if settings.differ.is_empty() {
            return Ok(Box::new(Attained::new(context)?));
        }
        Ok(Box::new(Differs::new(context, settings)?))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The metric, or the metric whose reduction is claimed.
    metric: String,
    /// Contenders that may stand for the paper's.
    contenders: Labels,
    /// Contender that a reduction is relative to.
    against: Option<String>,
    /// Where to look.
    r#in: Vec<PlaceSpec>,
    /// Claims that must be met on the same problem.
    #[serde(default)]
    given: Vec<String>,
    /// Sets of problem groups: what is claimed is no number, but that the metric is not the same in all of a set.
    #[serde(default)]
    differ: Vec<Vec<String>>,
}

#[derive(Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct PlaceSpec {
    /// The study whose records are looked at.
    study: String,
    /// The problem groups, by their labels; one that ends in `*` stands for all that begin so.
    problems: Labels,
    /// Its problems were drawn until the claim held: they serve where the claim is given, and say nothing of how often
    /// it holds.
    #[serde(default)]
    selected: bool,
}

/// Where a claim's number is looked for.
pub struct Place<'a> {
    study: &'a Study,
    groups: Vec<String>,
    selected: bool,
}

/// A claim's number and where it is looked for.
pub struct Attained<'a> {
    contenders: Vec<String>,
    against: Option<String>,
    places: Vec<Place<'a>>,
    metric: &'static Metric,
    print: Print,
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
    /// The number, or the reduction in per cent.
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
    /// The criterion of the claim of `context`.
    ///
    /// # Errors
    /// A settings error of the criterion.
    pub fn new(context: &Context<'a>) -> Result<Self, SettingsError> {
        let settings: Settings = context.settings.read()?;
        let readings = context.paper.readings();
        let contenders = settings.contenders.listed();
        let (places, metric) = places(context, &settings, &readings)?;
        let mut given = Vec::new();
        for id in &settings.given {
            let claim = context.claim_called(id)?;
            let settings = claim.check(ENTRY.name).ok_or_else(|| {
                let message = format!("claim `{id}` cannot be given: it has no criterion `exists`");
                context.settings.error_about("", &["given"], id, message)
            })?;
            given.push(Attained::new(&Context { claim, settings, ..*context })?);
        }
        let (print, claim, against) = (context.print()?, context.claim.id.as_str(), settings.against);
        Ok(Self { contenders, against, places, metric, print, given, claim, readings })
    }

    /// The claim's id.
    pub fn claim(&self) -> &'a str {
        self.claim
    }

    /// Whether it is looked for in this problem group of the study.
    pub fn looks_at(&self, study: &str, group: &str) -> bool {
        let is_there =
            |place: &Place<'_>| place.study.name == study && place.groups.iter().any(|own| own == group);
        self.places.iter().any(is_there)
    }

    /// The first of its contenders that the study has and that departs from no reading.
    pub fn contender_of(&self, study: &Study) -> Option<&str> {
        let is_plain = |label: &&String| {
            study.contenders.iter().any(|own| own.label == **label && own.departs.is_empty())
        };
        self.contenders.iter().find(is_plain).map(String::as_str)
    }

    /// The contender that a reduction is relative to.
    pub fn against(&self) -> Option<&str> {
        self.against.as_deref()
    }

    /// What is measured.
    pub fn metric(&self) -> &'static Metric {
        self.metric
    }

    /// What is printed.
    pub fn print(&self) -> Print {
        self.print
    }

    /// Whether the claim is met by a number.
    pub fn is_met(&self, value: f64) -> bool {
        self.print.agrees(value)
    }

    /// Every trial that it is looked for in under the evidence's reading.
    pub fn seen<'e>(&'e self, evidence: &'e Evidence<'_>) -> Vec<Seen<'e>> {
        let mut seen = Vec::new();
        for place in &self.places {
            let run = evidence.run(&place.study.name);
            let Some(run) = run.filter(|run| self.is_asked_of(run.study, &evidence.point)) else { continue };
            let reading = |label: &'e String| (label, self.reading_of(run.study, &evidence.point, label));
            let contenders: Vec<_> = self.contenders.iter().map(reading).collect();
            for group in &place.groups {
                for (contender, reading) in &contenders {
                    seen.extend(self.seen_in(run, (group, place.selected), contender, reading));
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
        point.expect("departures were looked up when the criterion was built").name().into()
    }

    /// The trials of `contender` in one problem group, which was selected or not.
    fn seen_in<'e>(
        &self,
        run: &'e Run<'e>,
        (group, selected): (&str, bool),
        contender: &'e str,
        reading: &Arc<str>,
    ) -> Vec<Seen<'e>> {
        let base = self.against.as_deref().unwrap_or(contender);
        let number = run.reader(self.metric);
        let value = |pair: &Pair<'_>| {
            let other = number(pair.other)?;
            if self.against.is_none() {
                return Some(other);
            }
            let base = number(pair.base)?;
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
    pub fn eligible<'e>(&'e self, evidence: &'e Evidence<'_>) -> Vec<Seen<'e>> {
        let mut eligible = self.seen(evidence);
        for given in &self.given {
            if eligible.is_empty() {
                break;
            }
            // A number is met exactly on few problems of many.
            let seen = given.seen(evidence);
            let met = seen.iter().filter(|seen| given.is_met(seen.value));
            let met: BTreeSet<Problem<'_>> = met.map(Seen::problem).collect();
            eligible.retain(|seen| met.contains(&seen.problem()));
        }
        eligible
    }

    /// Whether nothing else must be met where it is looked for.
    pub fn is_unconditional(&self) -> bool {
        self.given.is_empty()
    }

    /// What the value is, with its unit.
    fn title(&self) -> String {
        if self.against.is_some() {
            return format!("reduction of {} (%)", self.metric.label.to_lowercase());
        }
        self.metric.title()
    }
}

/// Where `settings` look, and for which metric.
fn places<'a>(
    context: &Context<'a>,
    settings: &Settings,
    readings: &[Reading],
) -> Result<(Vec<Place<'a>>, &'static Metric), SettingsError> {
    let (mut places, mut metric, mut faults) = (Vec::new(), None, Faults::default());
    for (index, place) in settings.r#in.iter().enumerate() {
        let within = format!("in.{index}");
        let Some(study) = faults.keep(context.study(&within, &place.study, &[])) else { continue };
        let groups = faults.keep(context.groups(&within, study, &place.problems)).unwrap_or_default();
        metric = faults.keep(context.metric(&settings.metric, study)).or(metric);
        faults.keep(check_departures(study, readings));
        places.push(Place { study, groups, selected: place.selected });
    }
    for label in settings.contenders.listed().iter().chain(&settings.against) {
        // A place need not have every contender, but each must exist in some place.
        let known = || places.iter().flat_map(|place| &place.study.contenders).map(|c| c.label.as_str());
        if places.len() == settings.r#in.len() && !known().any(|own| own == label) {
            let message = none_called("contender", label, known());
            faults.add(context.settings.error_about("", &CONTENDER_KEYS, label, message));
        }
    }
    faults.done()?;
    let metric = metric.ok_or_else(|| context.settings.error_at("in", "`in` names no study to look at"))?;
    Ok((places, metric))
}

impl Criterion for Attained<'_> {
    fn find(&self, evidence: &Evidence<'_>) -> Found {
        let (selected, eligible): (Vec<Seen<'_>>, Vec<Seen<'_>>) =
            self.eligible(evidence).into_iter().partition(|seen| seen.selected);
        let met: Vec<&Seen<'_>> = eligible.iter().filter(|seen| self.is_met(seen.value)).collect();
        let given: Vec<&str> = self.given.iter().map(|given| given.claim).collect();
        let condition =
            if given.is_empty() { String::new() } else { format!(" on which {} hold", given.join(", ")) };
        let distance = |seen: &Seen<'_>| (seen.value - self.print.printed.value()).abs();
        let nearest = eligible.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let outcome = if met.is_empty() { Outcome::Open } else { Outcome::Holds };
        let mut found = Found { outcome: Some(outcome), existential: true, ..Found::default() };
        if let Some(shown) = met.first().copied().or(nearest) {
            found.trial = Some(shown.run.trial(shown.row));
            found.reading = Some(shown.reading.to_string()).filter(|name| name != evidence.point.name());
            let how = if met.is_empty() { "nearest" } else { "met" };
            let what = format!("{how}, {} by {}", self.title(), shown.contender);
            found.ours = Some(Estimate::bare(shown.value, what, eligible.len()));
        }
        found.because.push(match met.first() {
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
        found.because.extend((more > 0).then(|| {
            format!("{more} more trials are on maps that were drawn until it held, and do not count")
        }));
        found
    }

    fn studies(&self) -> Vec<&Study> {
        self.places.iter().map(|place| place.study).collect()
    }

    fn is_clock(&self) -> bool {
        self.metric.is_clock()
    }
}
