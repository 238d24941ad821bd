//! Criteria: how statistics of stored trials are held against what a paper says; one a file, all in [`REGISTRY`].
//!
//! A criterion selects trials, takes a statistic of each draw, and says what it finds; its class is decided in
//! [`class`](super::class). Arithmetic on printed numbers alone is a [`rule`](super::rule).

mod equals;
mod exists;
mod least_of;
mod lower;
mod on_every;
mod one_draw;
mod prints_as;
mod row_one_draw;
mod share;
mod trend;
mod within;

pub use exists::{Attained, ENTRY as EXISTS};
pub use one_draw::{Draws, draws};

use super::class::Outcome;
use super::evidence::Evidence;
use super::metric::{self, Metric};
use super::selection::{Explored, Labels};
use super::verdict::Estimate;
use crate::study::paper::{self, Claim, Paper};
use crate::study::{ReadingChoice, Study};
use audit::printed::{Digits, Printed};
use base::settings::{Accepted, Faults, Settings, SettingsError, did_you_mean, none_called};

/// What was found about a claim, before its class is decided.
#[derive(Debug, Default)]
pub struct Found {
    /// What it amounts to; none if it is only shown, or can only refuse and does not.
    pub outcome: Option<Outcome>,
    /// Our number.
    pub ours: Option<Estimate>,
    /// The trial that shows it, as `--trial` takes it.
    pub trial: Option<String>,
    /// The reading it was found under, if that is not the one that the claim is judged under.
    pub reading: Option<String>,
    /// The computation, step by step.
    pub because: Vec<String>,
    /// What it takes for granted.
    pub premises: Vec<String>,
    /// Where an interval around our number would have to lie beyond to decide.
    pub limits: Vec<f64>,
    /// What takes more of to narrow that interval.
    pub units: &'static str,
    /// The claim is met by one input among many.
    pub existential: bool,
    /// Hardly any printed value could have been refused.
    pub powerless: bool,
    /// How many cases without a number could turn it.
    pub censored: usize,
    /// The reading is none under which the premises of a proof hold.
    pub without_premises: bool,
    /// The draws that it takes at least, where there are fewer.
    pub needs: Option<usize>,
}

impl Found {
    /// Undecided for this reason.
    pub fn open(because: impl Into<String>) -> Self {
        Self { outcome: Some(Outcome::Open), because: vec![because.into()], ..Self::default() }
    }

    /// Undecided because `draws` draws are fewer than `needs`.
    pub fn too_few(draws: usize, needs: usize) -> Self {
        let because = format!("{draws} draws have what is compared; at least {needs} are needed");
        Self { needs: Some(needs), ..Self::open(because) }
    }
}

/// A criterion with its settings, every name looked up.
pub trait Criterion {
    /// What it finds in the stored runs as the evidence's reading, and session of the clock, show them.
    fn find(&self, evidence: &Evidence<'_>) -> Found;

    /// The studies whose trials it looks at.
    fn studies(&self) -> Vec<&Study>;

    /// Whether what it finds rests on our own clock.
    fn is_clock(&self) -> bool {
        false
    }
}

/// A registered criterion.
pub struct Entry {
    /// The name that claims use; also its file's name.
    pub name: &'static str,
    /// One line for `replan list`.
    pub about: &'static str,
    /// The shape of its settings, which documents them.
    pub settings: Accepted,
    /// Settings that it can be built from, as TOML: for `replan list`, and for a test that builds it from them.
    pub example: &'static str,
    /// How to build it.
    pub build: for<'a> fn(&Context<'a>) -> Result<Box<dyn Criterion + 'a>, SettingsError>,
}

/// Every criterion, in the order of their names.
pub static REGISTRY: &[&Entry] = &[
    &equals::ENTRY,
    &exists::ENTRY,
    &least_of::ENTRY,
    &lower::ENTRY,
    &on_every::ENTRY,
    &one_draw::ENTRY,
    &prints_as::ENTRY,
    &row_one_draw::ENTRY,
    &share::ENTRY,
    &trend::ENTRY,
    &within::ENTRY,
];

/// The criterion called `name`.
pub fn find(name: &str) -> Option<&'static Entry> {
    REGISTRY.iter().copied().find(|entry| entry.name == name)
}

/// What a criterion or rule is built from.
#[derive(Clone, Copy)]
pub struct Context<'a> {
    /// The claim.
    pub claim: &'a Claim,
    /// Its settings in the claim.
    pub settings: &'a Settings,
    /// The paper.
    pub paper: &'a Paper,
    /// The reading that the claim is judged under.
    pub point: &'a ReadingChoice,
}

/// A criterion with a study that explores readings in the place of its own, and that study; none if it names none.
///
/// # Errors
/// What the criterion refuses of that study.
pub fn explored<'a>(
    entry: &Entry,
    context: &Context<'a>,
) -> Result<Option<(&'a Study, Settings)>, SettingsError> {
    let Some(of) = context.settings.table().get("of").and_then(toml::Value::as_table) else {
        return Ok(None);
    };
    let read = |value: &toml::Value| value.clone().try_into::<Explored>().ok();
    let Some(wanted) = of.get("explored").and_then(read) else { return Ok(None) };
    let (name, problems) = match wanted {
        Explored::Study(name) => (name, None),
        Explored::Elsewhere(place) => (place.study, Some(place.problems.listed())),
    };
    let study = context.study("of.explored", &name, &[])?;
    if study.explore.is_none() {
        let message = format!("study `{name}` explores no readings; it needs a table `explore`");
        return Err(context.settings.error_at("of.explored", message));
    }
    let mut elsewhere = of.clone();
    elsewhere.remove("explored");
    elsewhere.insert("study".to_owned(), name.into());
    if let Some(problems) = problems {
        elsewhere.insert("problems".to_owned(), problems.into());
    }
    let mut table = context.settings.table().clone();
    table.insert("of".to_owned(), elsewhere.into());
    let settings = Settings::composed(format!("claim `{}`, explored", context.claim.id), table);
    (entry.build)(&Context { settings: &settings, ..*context })
        .map_err(|error| context.settings.error_at("of.explored", error.to_string()))?;
    Ok(Some((study, settings)))
}

/// How the keys start that name studies, problem groups, contenders and metrics.
const STUDY_KEYS: [&str; 2] = ["stud", "explored"];
const PROBLEM_KEYS: [&str; 2] = ["problem", "differ"];
const CONTENDER_KEYS: [&str; 4] = ["contender", "against", "lower", "higher"];
const METRIC_KEYS: [&str; 3] = ["metric", "over", "truth"];

impl From<paper::Digits> for Digits {
    fn from(digits: paper::Digits) -> Self {
        match digits {
            paper::Digits::Rounded => Self::Rounded,
            paper::Digits::Truncated => Self::Truncated,
            paper::Digits::Unknown => Self::Unknown,
        }
    }
}

impl<'a> Context<'a> {
    /// The claim's printed number.
    pub fn printed(&self) -> Result<Printed, SettingsError> {
        let missing = || format!("claim `{}` prints no number, which is needed here", self.claim.id);
        let text = self.claim.printed.as_ref().ok_or_else(|| self.settings.error(missing()))?;
        text.parse().map_err(|e: audit::AuditError| self.settings.error(e.to_string()))
    }

    /// The printed number of another claim.
    pub fn printed_of(&self, id: &str) -> Result<(Printed, Digits), SettingsError> {
        let other = self.claim_called(id)?;
        let context = Context { claim: other, ..*self };
        Ok((context.printed()?, context.digits()))
    }

    /// The claim called `id`.
    pub fn claim_called(&self, id: &str) -> Result<&'a Claim, SettingsError> {
        self.paper.claim(id).ok_or_else(|| {
            let known = self.paper.claims.iter().map(|claim| claim.id.as_str());
            self.settings.error_about("", &[""], id, none_called("claim", id, known))
        })
    }

    /// How the claim's digits end.
    pub fn digits(&self) -> Digits {
        let digits = self.claim.digits.or_else(|| self.point.digits());
        digits.unwrap_or(paper::Digits::Unknown).into()
    }

    /// The study called `name`, which must have the contenders named; `within` is the part of the settings that names them.
    pub fn study(&self, within: &str, name: &str, contenders: &[&str]) -> Result<&'a Study, SettingsError> {
        let study = self.paper.study(name).ok_or_else(|| {
            let known = self.paper.studies.iter().map(|study| study.name.as_str());
            self.settings.error_about(within, &STUDY_KEYS, name, none_called("study", name, known))
        })?;
        let known: Vec<&str> = study.contenders.iter().map(|c| c.label.as_str()).collect();
        let mut faults = Faults::default();
        // A study that measures without contenders has labels of its task's own.
        for label in contenders.iter().filter(|label| !known.is_empty() && !known.contains(label)) {
            faults.add(self.unknown(within, "contender", &CONTENDER_KEYS, label, (study, &known)));
        }
        faults.done()?;
        Ok(study)
    }

    fn unknown(
        &self,
        within: &str,
        what: &str,
        keys: &[&str],
        label: &str,
        (study, known): (&Study, &[&str]),
    ) -> SettingsError {
        let hint = did_you_mean(label, known.iter().copied());
        let message =
            format!("study `{}` has no {what} `{label}`{hint}; it has {}", study.name, known.join(", "));
        self.settings.error_about(within, keys, label, message)
    }

    /// The problem groups of `study` that `labels` name, in their order; `within` is the part of the settings that names
    /// them.
    pub fn groups(&self, within: &str, study: &Study, labels: &Labels) -> Result<Vec<String>, SettingsError> {
        let known: Vec<&str> = study.groups.iter().map(|group| group.label.as_str()).collect();
        let (mut groups, mut faults) = (Vec::new(), Faults::default());
        for label in labels.listed() {
            let is_meant = |group: &&&str| match label.strip_suffix('*') {
                Some(beginning) => group.starts_with(beginning),
                None => **group == label,
            };
            let meant: Vec<String> = known.iter().filter(is_meant).map(|group| (*group).to_owned()).collect();
            if meant.is_empty() {
                faults.add(self.unknown(within, "problem group", &PROBLEM_KEYS, &label, (study, &known)));
            }
            groups.extend(meant);
        }
        faults.done()?;
        if groups.is_empty() {
            return Err(self.settings.error_at(within, "`problems` needs at least one label"));
        }
        Ok(groups)
    }

    /// The metric that `name` stands for under the reading.
    pub fn known_metric(&self, name: &str) -> Result<&'static Metric, SettingsError> {
        metric::find(self.point.metric(name)).ok_or_else(|| {
            let known: Vec<&str> = metric::METRICS.iter().map(|metric| metric.name).collect();
            let hint = did_you_mean(name, known.iter().copied());
            let message = format!(
                "there is no metric `{name}`, nor a reading that gives the name a meaning{hint}; the metrics are {}",
                known.join(", ")
            );
            self.settings.error_about("", &METRIC_KEYS, name, message)
        })
    }

    /// The metric that `name` stands for under the reading; `study` must produce it.
    pub fn metric(&self, name: &str, study: &Study) -> Result<&'static Metric, SettingsError> {
        let metric = self.known_metric(name)?;
        let columns = study.columns();
        if metric.is_produced(&columns) {
            return Ok(metric);
        }
        let produced: Vec<&str> =
            metric::METRICS.iter().filter(|metric| metric.is_produced(&columns)).map(|m| m.name).collect();
        let message = format!(
            "study `{}` does not produce the metric `{}`; it produces {}",
            study.name,
            metric.name,
            produced.join(", ")
        );
        Err(self.settings.error_about("", &METRIC_KEYS, name, message))
    }

    /// The names that the stream of a bootstrap on this claim is derived from.
    pub fn seed_names(&self) -> [&'a str; 2] {
        [&self.paper.id, &self.claim.id]
    }

    /// An error unless `low..high` rises and lies in `least..most`.
    pub fn rising(
        &self,
        key: &str,
        [low, high]: [f64; 2],
        [least, most]: [f64; 2],
    ) -> Result<(), SettingsError> {
        if least <= low && low <= high && high <= most {
            return Ok(());
        }
        let message =
            format!("{key} is [{low}, {high}]; two rising numbers from {least} to {most} are accepted");
        Err(self.settings.error_at(key, message))
    }
}
