//! The context from which a criterion or rule is built, and the names that it looks up there.

use super::metric::{self, Metric};
use super::selection_spec::Labels;
use base::settings::{Faults, Settings, SettingsError, did_you_mean, none_called};
use proofs::exact::Print;
use proofs::printed::{Digits, Printed};
use std::collections::BTreeSet;
use study::paper::{self, Claim, Paper};
use study::{Interpretation, Study, columns_of, labels_of};

/// What a criterion or rule is built from.
#[derive(Clone, Copy)]
pub struct Context<'a> {
    /// The claim.
    pub claim: &'a Claim,
    /// Its settings in the claim.
    pub settings: &'a Settings,
    /// The paper.
    pub paper: &'a Paper,
    /// The interpretation that the claim is judged under.
    pub point: &'a Interpretation,
}

/// The audit's word for how a paper's digits end.
fn audited(digits: paper::Digits) -> Digits {
    match digits {
        paper::Digits::Rounded => Digits::Rounded,
        paper::Digits::Truncated => Digits::Truncated,
        paper::Digits::Unknown => Digits::Unknown,
    }
}

/// The number that `claim` prints; none if it prints none.
///
/// # Errors
/// What it prints is no number that we take; the error stands where it is printed.
pub fn printed(paper: &Paper, claim: &Claim) -> Result<Option<Printed>, SettingsError> {
    let refused = |e: proofs::printed::NotANumber| {
        let message = format!("claim `{}`: {e}", claim.id);
        paper.document.error_at(&claim.written.printed, message).about(&paper::printed_by(&claim.id))
    };
    claim.printed.as_ref().map(|text| text.parse().map_err(refused)).transpose()
}

impl<'a> Context<'a> {
    /// The claim's printed number and how its digits end.
    ///
    /// # Errors
    /// The claim prints no number.
    pub fn print(&self) -> Result<Print, SettingsError> {
        let message = format!("claim `{}` prints no number, which is needed here", self.claim.id);
        let missing = || self.settings.error(message).about("printed").about("printed_ratio");
        let printed = printed(self.paper, self.claim)?.ok_or_else(missing)?;
        let digits = self.claim.digits.or_else(|| self.point.digits()).unwrap_or(paper::Digits::Unknown);
        Ok(Print { printed, digits: audited(digits) })
    }

    /// An error at the name of a criterion or rule, `name`, that stands under `key` in the claim's test.
    pub fn error_at_name(&self, key: &str, name: &str, message: String) -> SettingsError {
        let document = &self.paper.document;
        let layers = self.claim.written.layers.iter();
        let steps = layers.map(|layer| layer.split('.').chain([key, name]).collect::<Vec<_>>());
        let mut steps = steps.filter(|steps| document.has(steps));
        document.error_at_key(&steps.next().unwrap_or_default(), message)
    }

    /// The printed number of the claim `id`, which the settings name at `path`.
    ///
    /// # Errors
    /// There is no such claim, or it prints no number.
    pub fn print_of(&self, path: &str, id: &str) -> Result<Print, SettingsError> {
        Context { claim: self.claim_called(path, id)?, ..*self }.print()
    }

    /// The claim called `id`, which the settings name at `path`.
    ///
    /// # Errors
    /// There is no such claim.
    pub fn claim_called(&self, path: &str, id: &str) -> Result<&'a Claim, SettingsError> {
        self.paper.claim(id).ok_or_else(|| {
            let known = self.paper.claims.iter().map(|claim| claim.id.as_str());
            let error = self.settings.error_about(&[path], id, none_called("claim", id, known));
            error.about(&paper::names_of("claim")).about("id")
        })
    }

    /// The study called `name`, which the settings name at `path`.
    ///
    /// # Errors
    /// There is no such study.
    pub fn study(&self, path: &str, name: &str) -> Result<&'a Study, SettingsError> {
        self.paper.study(name).ok_or_else(|| {
            let known = self.paper.studies.iter().map(|study| study.name.as_str());
            let error = self.settings.error_about(&[path], name, none_called("study", name, known));
            error.about(&paper::names_of("study"))
        })
    }

    /// Refuses contenders that `study` does not have, which the settings name at `paths`.
    ///
    /// # Errors
    /// It lacks one.
    pub fn check_contenders(
        &self,
        paths: &[&str],
        study: &Study,
        named: &[&str],
    ) -> Result<(), SettingsError> {
        let labels = study.labels();
        let known: Vec<&str> = labels.iter().map(String::as_str).collect();
        let mut faults = Faults::default();
        // What the labels of a task are is not known where its settings are wrong.
        for label in named.iter().filter(|label| !known.is_empty() && !known.contains(label)) {
            faults.add(self.unknown(paths, "contender", label, (study, &known)));
        }
        faults.done()
    }

    fn unknown(
        &self,
        paths: &[&str],
        what: &str,
        label: &str,
        (study, known): (&Study, &[&str]),
    ) -> SettingsError {
        let hint = did_you_mean(label, known.iter().copied());
        let message =
            format!("study `{}` has no {what} `{label}`{hint}; it has {}", study.name, known.join(", "));
        self.settings.error_about(paths, label, message).about(&labels_of(&study.name))
    }

    /// The problem groups of `study` that `labels` name, in their order; the settings name them at `path`.
    ///
    /// # Errors
    /// The study has no such group; there is no label.
    pub fn groups(&self, path: &str, study: &Study, labels: &Labels) -> Result<Vec<String>, SettingsError> {
        let known: Vec<&str> = study.groups.iter().map(|group| group.label.as_str()).collect();
        let mut groups = Vec::new();
        let mut faults = Faults::default();
        for label in labels.listed() {
            let is_meant = |group: &&&str| match label.strip_suffix('*') {
                Some(beginning) => group.starts_with(beginning),
                None => **group == label,
            };
            let meant: Vec<String> = known.iter().filter(is_meant).map(|group| (*group).to_owned()).collect();
            if meant.is_empty() {
                let fault = self.unknown(&[path], "problem group", &label, (study, &known));
                // What begins so may be what was not read.
                let is_many = label.ends_with('*');
                faults.add(if is_many { fault.about(&columns_of(&study.name)) } else { fault });
            }
            groups.extend(meant);
        }
        faults.done()?;
        if groups.is_empty() {
            let message = "`problems` needs at least one label";
            return Err(self.settings.error_at(path, message).about("problems"));
        }
        Ok(groups)
    }

    /// The metric that `name`, which the settings give at `path`, stands for under the interpretation.
    ///
    /// # Errors
    /// There is no such metric.
    pub fn known_metric(&self, path: &str, name: &str) -> Result<&'static Metric, SettingsError> {
        metric::find(self.point.metric(name)).ok_or_else(|| {
            let choices = &self.paper.choices;
            let options = choices.iter().flat_map(|choice| choice.options.values());
            // Names that choices give a meaning; several options give one to the same name.
            let read: BTreeSet<&str> =
                options.flat_map(|option| option.metric.keys()).map(String::as_str).collect();
            let known: Vec<&str> = metric::METRICS.iter().map(|metric| metric.name).chain(read).collect();
            let hint = did_you_mean(name, known.iter().copied());
            let message = format!(
                "there is no metric `{name}`, nor a choice that gives the name a meaning{hint}; the metrics are {}",
                known.join(", ")
            );
            self.settings.error_about(&[path], name, message)
        })
    }

    /// As [`known_metric`](Self::known_metric); `study` must produce it.
    ///
    /// # Errors
    /// There is no such metric, or the study does not produce it.
    pub fn metric(&self, path: &str, name: &str, study: &Study) -> Result<&'static Metric, SettingsError> {
        let metric = self.known_metric(path, name)?;
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
        Err(self.settings.error_about(&[path], name, message).about(&columns_of(&study.name)))
    }

    /// An error unless `low..high` rises and lies in `least..most`.
    ///
    /// # Errors
    /// They do not.
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
