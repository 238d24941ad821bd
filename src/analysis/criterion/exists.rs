//! Whether the printed number is met exactly by any stored trial, alone or together with other printed numbers.
//!
//! A trial counts under the interpretation that it ran under, and under interpretations that differ from it only in what cannot touch it:
//! one witness under one interpretation is no witness under another.

mod differs;
mod ran_under;

use super::{Criterion, Entry};
use crate::analysis::context::Context;
use crate::analysis::criterion_result::CriterionResult;
use crate::analysis::evidence::{Evidence, Pair, Run, default_point};
use crate::analysis::metric::Metric;
use crate::analysis::number::{Ends, Number, parts};
use crate::analysis::outcome::Outcome;
use crate::analysis::selection_spec::Labels;
use crate::analysis::verdict::Estimate;
use base::settings::{Accepted, Faults, SettingsError, none_called};
use differs::Differs;
use proofs::exact::Print;
use ran_under::ran_under;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet};
use study::paper::Paper;
use study::record::Row;
use study::{Interpretation, Study};

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "exists",
    about: "does any stored trial meet the printed number exactly, where other named claims are met too?",
    revision: |_| 1,
    question: |_| Some("values found 2"),
    settings: Accepted::shape::<Settings>(),
    example: r#"
metric = "path_cost_cells"
contenders = "A*"
in = [{ study = "compare", problems = "maps" }]
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
    /// Sets of problem groups, for a claim without a number: it says that the metric is not the same in all groups of a set.
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
    /// Its problems were drawn until the claim held: they serve where the claim is `given`, and do not show how often it holds.
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
    paper: &'a Paper,
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
    selected: bool,
}

/// What tells problems under one interpretation apart: study, group, instance and query.
pub type Problem<'e> = (&'e str, &'e str, u32, Option<&'e str>);

impl<'e> Seen<'e> {
    /// The problem that it is about.
    pub fn problem(&self) -> Problem<'e> {
        let key = &self.row.key;
        (&self.run.study.name, &key.on.group, key.on.instance, key.query.as_deref())
    }
}

impl<'a> Attained<'a> {
    /// The criterion of the claim of `context`.
    ///
    /// # Errors
    /// A settings error of the criterion.
    pub fn new(context: &Context<'a>) -> Result<Self, SettingsError> {
        let settings: Settings = context.settings.read()?;
        let contenders = settings.contenders.listed();
        let (places, metric) = places(context, &settings)?;
        let mut given = Vec::new();
        for id in &settings.given {
            let claim = context.claim_called("given", id)?;
            let settings = claim.check(ENTRY.name).ok_or_else(|| {
                let message = format!("claim `{id}` cannot be given: it has no criterion `exists`");
                context.settings.error_about(&["given"], id, message)
            })?;
            given.push(Attained::new(&Context { claim, settings, ..*context })?);
        }
        let print = context.print()?;
        let claim = context.claim.id.as_str();
        let against = settings.against;
        Ok(Self { contenders, against, places, metric, print, given, claim, paper: context.paper })
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

    /// The first of its contenders that the study has and that departs from no default.
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

    /// Every trial that it is looked for in under the evidence's interpretation.
    pub fn seen<'e>(&'e self, evidence: &'e Evidence<'_>) -> Vec<Seen<'e>> {
        let mut seen = Vec::new();
        for (run, place, contenders) in self.places(evidence) {
            for group in &place.groups {
                for contender in &contenders {
                    seen.extend(self.seen_in(run, (group, place.selected), contender));
                }
            }
        }
        seen
    }

    /// Each place where trials ran under the evidence's interpretation, with the contenders whose trials did.
    fn places<'e>(&'e self, evidence: &'e Evidence<'_>) -> Vec<(&'e Run<'e>, &'e Place<'a>, Vec<&'e str>)> {
        let seen = |place: &'e Place<'a>| {
            let run = evidence.run(&place.study.name).filter(|run| run.is_covered())?;
            let ran = |label: &str| {
                let contender = run.study.contenders.iter().find(|contender| contender.label == label);
                contender
                    .is_some_and(|contender| ran_under(self.paper, run.study, contender, &evidence.point))
            };
            let contenders = self.contenders.iter().map(String::as_str).filter(|label| ran(label));
            let contenders: Vec<&str> = contenders.collect();
            let is_run = !contenders.is_empty() && self.against.iter().all(|base| ran(base));
            is_run.then_some((run, place, contenders))
        };
        self.places.iter().filter_map(seen).collect()
    }

    /// The trials of `contender` in one problem group, which was selected or not.
    fn seen_in<'e>(
        &self,
        run: &'e Run<'e>,
        (group, selected): (&str, bool),
        contender: &'e str,
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
            let row = pair.other;
            let value = value(pair)?;
            Some(Seen { run, row, contender, value, selected })
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

    /// Whether it is looked for without other claims that must be met too.
    pub fn is_unconditional(&self) -> bool {
        self.given.is_empty()
    }

    /// Beside the defaults, the interpretations that contenders depart to under which it is met, each with the first trial that meets it.
    fn met_elsewhere(&self, evidence: &Evidence<'_>) -> Vec<String> {
        let default = default_point(self.paper);
        let points = if evidence.point == default { self.paper.departures() } else { Vec::new() };
        let met = |point: Interpretation| {
            let name = point.name().to_owned();
            let view = evidence.under(point);
            let found = self.eligible(&view);
            let first = found.iter().find(|seen| !seen.selected && self.is_met(seen.value))?;
            let trial = first.run.trial(first.row);
            Some(format!("met under another interpretation, {name}, where it counts: {trial}"))
        };
        points.into_iter().filter_map(met).collect()
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
) -> Result<(Vec<Place<'a>>, &'static Metric), SettingsError> {
    let mut places = Vec::new();
    let mut metric = None;
    let mut faults = Faults::default();
    for (index, place) in settings.r#in.iter().enumerate() {
        let at = |key| format!("in.{index}.{key}");
        let Some(study) = faults.keep(context.study(&at("study"), &place.study)) else { continue };
        let groups = faults.keep(context.groups(&at("problems"), study, &place.problems)).unwrap_or_default();
        metric = faults.keep(context.metric("metric", &settings.metric, study)).or(metric);
        places.push(Place { study, groups, selected: place.selected });
    }
    for label in settings.contenders.listed().iter().chain(&settings.against) {
        // A place need not have every contender, but each must exist in some place.
        let known = || places.iter().flat_map(|place| &place.study.contenders).map(|c| c.label.as_str());
        if places.len() == settings.r#in.len() && !known().any(|own| own == label) {
            let message = none_called("contender", label, known());
            faults.add(context.settings.error_about(&["contenders", "against"], label, message));
        }
    }
    faults.done()?;
    let metric = metric.ok_or_else(|| context.settings.error_at("in", "`in` names no study to look at"))?;
    Ok((places, metric))
}

impl Attained<'_> {
    /// The trial that meets it first or, if none does, the nearest one; and whether it is met.
    fn shown<'s, T>(&self, eligible: &'s [T], value: impl Fn(&T) -> f64) -> Option<(&'s T, bool)> {
        let distance = |seen: &T| (value(seen) - self.print.printed.value()).abs();
        let met = eligible.iter().find(|seen| self.is_met(value(seen)));
        let nearest = || eligible.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
        met.map(|seen| (seen, true)).or_else(|| nearest().map(|seen| (seen, false)))
    }
}

impl Criterion for Attained<'_> {
    /// The numbers by each contender on problems where all given claims are met, equal ones once, in the order in which they were seen.
    /// Those on maps that were drawn until it held stand outside.
    fn numbers(&self, evidence: &Evidence<'_>) -> Vec<Number> {
        let mut numbers = vec![Number::default()];
        let mut places = BTreeMap::new();
        for seen in self.eligible(evidence) {
            let key = (seen.contender, seen.selected, seen.value.to_bits());
            let place = *places.entry(key).or_insert(numbers.len());
            if place == numbers.len() {
                let part = seen.contender.to_owned();
                numbers.push(Number { part, value: Some(seen.value), ..Number::default() });
            }
            numbers[place].n += 1;
            numbers[place].outside += usize::from(seen.selected);
        }
        numbers
    }

    fn weigh(&self, numbers: &[Number]) -> CriterionResult {
        let parts = parts(numbers, Ends::Measured).into_iter();
        let (selected, eligible): (Vec<&Number>, Vec<&Number>) = parts.partition(|part| part.outside > 0);
        let value = |part: &&Number| part.value.unwrap_or_default();
        let count = |parts: &[&Number]| parts.iter().map(|part| part.n).sum::<usize>();
        let all = count(&eligible);
        let met: Vec<&Number> = eligible.iter().copied().filter(|part| self.is_met(value(part))).collect();
        let given: Vec<&str> = self.given.iter().map(|given| given.claim).collect();
        let condition =
            if given.is_empty() { String::new() } else { format!(" on which {} hold", given.join(", ")) };
        let outcome = if met.is_empty() { Outcome::Open } else { Outcome::Holds };
        let mut found =
            CriterionResult { outcome: Some(outcome), existential: true, ..CriterionResult::default() };
        found.ours = self.shown(&eligible, value).map(|(shown, is_met)| {
            let how = if is_met { "met" } else { "nearest" };
            let what = format!("{how}, {} by {}", self.title(), shown.part);
            Estimate::bare(value(shown), what, all)
        });
        let trials = match all {
            1 => "1 trial".to_owned(),
            count => format!("{count} trials"),
        };
        found.because.push(match met.first() {
            Some(first) => {
                format!("met by {} of {trials}{condition}; first by `{}`", count(&met), first.part)
            }
            None => format!("met by none of {trials}{condition}; this proves nothing either way"),
        });
        let more = count(&selected);
        found.because.extend((more > 0).then(|| {
            format!("{more} more trials are on maps that were drawn until it held, and do not count")
        }));
        found
    }

    fn show(&self, evidence: &Evidence<'_>, _: &[Number], found: &mut CriterionResult) {
        let mut eligible = self.eligible(evidence);
        eligible.retain(|seen| !seen.selected);
        let shown = self.shown(&eligible, |seen| seen.value);
        found.trial = shown.map(|(seen, _)| seen.run.trial(seen.row));
        match shown {
            Some((seen, true)) => found.because[0] += &format!(" on {}", seen.run.problem(seen.row)),
            _ => found.because.extend(self.met_elsewhere(evidence)),
        }
    }

    fn studies(&self) -> Vec<&Study> {
        self.places.iter().map(|place| place.study).collect()
    }

    fn is_clock(&self) -> bool {
        self.metric.is_clock()
    }

    fn is_covered(&self, evidence: &Evidence<'_>) -> bool {
        !self.places(evidence).is_empty()
    }

    fn results(&self, evidence: &Evidence<'_>) -> String {
        let line = |seen: Seen<'_>| {
            format!("{:?} {} {} {:x}\n", seen.problem(), seen.contender, seen.selected, seen.value.to_bits())
        };
        let own: String = self.seen(evidence).into_iter().map(line).collect();
        self.given.iter().fold(own, |text, given| text + given.claim + "\n" + &given.results(evidence))
    }
}
