//! Under which readings a printed number is like our draws, and under which it is met exactly.
//!
//! The check gives no verdict; the verdict stands under the default reading. It says whether another reading would
//! have carried the claim.

use super::{Check, Context, Entry};
use crate::analysis::evidence::Evidence;
use crate::analysis::metric::Metric;
use crate::analysis::verdict::Finding;
use crate::study::record::Status;
use crate::study::{ReadingChoice, Study};
use audit::printed::Printed;
use base::settings::{Accepted, SettingsError};
use schemars::JsonSchema;
use serde::Deserialize;
use stats::interval::Interval;
use stats::proportion::predictive;
use stats::summary::median;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "across_readings",
    about: "under which readings does the printed number lie among our draws, or is it met exactly?",
    settings: Accepted::of::<Settings>(),
    example: r#"
study = "readings"
problems = ["simple"]
searched = ["W1"]
metric = "nodes"
contender = "Improved A*"
against = "A*"
"#,
    build: |context| Ok(Box::new(Across::new(context)?)),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// A study that explores readings.
    study: String,
    /// Its random maps.
    problems: Vec<String>,
    /// Maps of it that were searched for.
    #[serde(default)]
    searched: Vec<String>,
    /// The metric: a name that `replan list metrics` gives, or one that a reading gives a meaning.
    metric: String,
    /// The contender, by its label.
    contender: String,
    /// The contender that the reduction is from; without it the printed number is the metric itself.
    against: Option<String>,
}

/// What is found under one reading.
#[derive(Debug, Clone)]
pub struct Outcome {
    /// The reading.
    pub point: ReadingChoice,
    /// Median over the random maps.
    pub median: f64,
    /// Where 95 % of further maps would lie, at least.
    pub central: Interval,
    /// Random maps that both contenders solved.
    pub maps: usize,
    /// Whether the printed number lies where 95 % of the maps do.
    pub is_among: bool,
    /// Random maps on which the printed number is met exactly.
    pub met: usize,
    /// Maps that were searched for on which it is.
    pub met_searched: usize,
}

struct Across<'a> {
    settings: Settings,
    study: &'a Study,
    context: Context<'a>,
    printed: Printed,
}

/// What the check in `context` finds under every reading that its study explores, in the order of the study's points.
///
/// # Errors
/// A settings error of the check.
pub fn outcomes(context: &Context<'_>, evidence: &Evidence<'_>) -> Result<Vec<Outcome>, SettingsError> {
    Ok(Across::new(context)?.outcomes(evidence))
}

impl<'a> Across<'a> {
    fn new(context: &Context<'a>) -> Result<Self, SettingsError> {
        let settings: Settings = context.settings.read()?;
        let mut contenders = vec![settings.contender.as_str()];
        contenders.extend(settings.against.as_deref());
        let groups: Vec<String> = settings.problems.iter().chain(&settings.searched).cloned().collect();
        let study = context.study(&settings.study, &groups, &contenders)?;
        if study.explore.is_none() {
            let message = format!("study `{}` explores no readings; it needs a table `explore`", study.name);
            return Err(context.settings.error_at("study", message));
        }
        context.metric(&settings.metric, study)?;
        Ok(Self { settings, study, context: *context, printed: context.printed()? })
    }

    fn outcomes(&self, evidence: &Evidence<'_>) -> Vec<Outcome> {
        let points = self.study.explored().expect("a checked study's readings are in order");
        points.into_iter().filter_map(|point| self.under(point, evidence)).collect()
    }

    fn under(&self, point: ReadingChoice, evidence: &Evidence<'_>) -> Option<Outcome> {
        let view = evidence.under(point.clone());
        let context = Context { point: &point, ..self.context };
        let metric = context.metric(&self.settings.metric, self.study).ok()?;
        if self.refusals(&view) > 0 {
            return None;
        }
        let draws = self.values(&view, &self.settings.problems, metric);
        let searched = self.values(&view, &self.settings.searched, metric);
        let agrees = |value: &&f64| self.printed.agrees(**value, context.digits());
        let central = predictive(&draws, 0.95)?;
        let printed = self.printed.interval(context.digits());
        Some(Outcome {
            median: median(&draws)?,
            central,
            maps: draws.len(),
            is_among: central.meets(printed),
            met: draws.iter().filter(agrees).count(),
            met_searched: searched.iter().filter(agrees).count(),
            point,
        })
    }

    /// Paths of the contender on the random maps that the verifier refused: what is left would be the lucky ones.
    fn refusals(&self, view: &Evidence<'_>) -> usize {
        let Some(run) = view.run(&self.settings.study) else { return 0 };
        let rows = self.settings.problems.iter().flat_map(|group| run.rows(group, &self.settings.contender));
        rows.filter(|row| row.status == Status::Rejected).count()
    }

    fn values(&self, view: &Evidence<'_>, groups: &[String], metric: &Metric) -> Vec<f64> {
        let Some(run) = view.run(&self.settings.study) else { return Vec::new() };
        let against = self.settings.against.as_deref();
        groups
            .iter()
            .flat_map(|group| run.changes(group, &self.settings.contender, against, metric))
            .collect()
    }
}

impl Check for Across<'_> {
    fn judge(&self, evidence: &Evidence<'_>) -> Finding {
        let outcomes = self.outcomes(evidence);
        let count = |is: fn(&Outcome) -> bool| outcomes.iter().filter(|outcome| is(outcome)).count();
        let medians = outcomes.iter().map(|outcome| outcome.median);
        let (low, high) = medians.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), m| (a.min(m), b.max(m)));
        let points = self.study.explored().expect("a checked study's readings are in order");
        let refused =
            points.iter().filter(|point| self.refusals(&evidence.under((*point).clone())) > 0).count();
        let mut distinct: Vec<[f64; 3]> =
            outcomes.iter().map(|o| [o.median, o.central.low, o.central.high]).collect();
        distinct.sort_by(|a, b| a.partial_cmp(b).expect("medians are numbers"));
        distinct.dedup();
        let mut because = vec![
            format!(
                "{} readings were explored; {refused} are left out because the verifier refused paths under them, and {} \
                 because too few maps were solved",
                points.len(),
                points.len() - refused - outcomes.len()
            ),
            format!(
                "under the {} others ({} with different draws of this number) the printed number lies among the central \
                 95 % of random maps under {}, and is met exactly on some random map under {}; on a map that was searched for \
                 it is met under {}",
                outcomes.len(),
                distinct.len(),
                count(|outcome| outcome.is_among),
                count(|outcome| outcome.met > 0),
                count(|outcome| outcome.met_searched > 0)
            ),
        ];
        if low <= high {
            because.push(format!("the median over maps goes from {low:.2} to {high:.2}"));
        }
        Finding { check: ENTRY.name.to_owned(), because, ..Finding::default() }
    }
}
