//! What share of returned paths has something (a hop that hits an obstacle, say), and whether it is at most as stated.

use super::{Check, Context, Entry};
use crate::analysis::evidence::{Evidence, Run};
use crate::analysis::metric::Metric;
use crate::analysis::verdict::{Estimate, Finding, Verdict};
use crate::study::Study;
use crate::study::record::Status;
use base::settings::{Accepted, SettingsError};
use schemars::JsonSchema;
use serde::Deserialize;
use stats::proportion::wilson;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "share_of_paths",
    about: "is the share of returned paths whose metric is above 0 at most as stated?",
    settings: Accepted::of::<Settings>(),
    example: r#"
study = "methods"
problems = ["case 1", "case 2"]
contenders = ["A* 8"]
metric = "is_unsafe"
at_most_percent = 0
explored = "readings"
"#,
    build: |context| Ok(Box::new(ShareOfPaths::new(context)?)),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The study whose records are looked at.
    study: String,
    /// The problem groups, by their labels.
    problems: Vec<String>,
    /// The contenders, by their labels.
    contenders: Vec<String>,
    /// The metric: a name that `replan list metrics` gives, or one that a reading gives a meaning.
    metric: String,
    /// The largest share that the claim allows.
    at_most_percent: f64,
    /// A study of the same problems and contenders that explores readings.
    explored: Option<String>,
}

struct ShareOfPaths<'a> {
    settings: Settings,
    explored: Option<&'a Study>,
    metric: &'static Metric,
}

impl<'a> ShareOfPaths<'a> {
    fn new(context: &Context<'a>) -> Result<Self, SettingsError> {
        let settings: Settings = context.settings.read()?;
        let contenders: Vec<&str> = settings.contenders.iter().map(String::as_str).collect();
        let study = context.study(&settings.study, &settings.problems, &contenders)?;
        let explored =
            settings.explored.as_ref().map(|name| context.study(name, &settings.problems, &contenders));
        let explored = explored.transpose()?;
        let metric = context.metric(&settings.metric, study)?;
        if !(0.0..=100.0).contains(&settings.at_most_percent) {
            let message = format!("at_most_percent is {}; 0 to 100 is accepted", settings.at_most_percent);
            return Err(context.settings.error_at("at_most_percent", message));
        }
        Ok(Self { settings, explored, metric })
    }

    /// Returned paths, and how many of them have it.
    fn count(&self, run: &Run<'_>, problem: &str, contender: &str) -> [usize; 2] {
        let rows = run.rows(problem, contender);
        let values = rows.iter().filter(|row| row.status == Status::Solved);
        let values: Vec<f64> = values.filter_map(|row| run.value(row, self.metric)).collect();
        [values.len(), values.iter().filter(|value| **value > 0.0).count()]
    }

    fn total(&self, run: &Run<'_>) -> [usize; 2] {
        let mut total = [0, 0];
        for problem in &self.settings.problems {
            for contender in &self.settings.contenders {
                let [paths, with] = self.count(run, problem, contender);
                total = [total[0] + paths, total[1] + with];
            }
        }
        total
    }

    fn is_allowed(&self, [paths, with]: [usize; 2]) -> bool {
        100.0 * with as f64 <= self.settings.at_most_percent * paths as f64
    }
}

impl Check for ShareOfPaths<'_> {
    fn judge(&self, evidence: &Evidence<'_>) -> Finding {
        let mut finding = Finding::of(ENTRY.name);
        let Some(run) = evidence.run(&self.settings.study) else { return finding };
        let total = self.total(run);
        let [paths, with] = total;
        finding.verdict = Some(match (paths, self.is_allowed(total)) {
            (0, _) => Verdict::Undecided,
            (_, true) => Verdict::Reproduced,
            (_, false) => Verdict::NotReproduced,
        });
        for problem in &self.settings.problems {
            for contender in &self.settings.contenders {
                let [paths, with] = self.count(run, problem, contender);
                finding.because.push(format!("{contender}, {problem}: {with} of {paths}"));
            }
        }
        finding.because.extend(super::explored_share(self, self.explored, evidence));
        // Paths of one contender on one problem are independent draws; a mixture of several is only counted.
        let is_one = self.settings.contenders.len() * self.settings.problems.len() == 1;
        let interval = wilson(with, paths, 0.95).filter(|_| is_one);
        finding.ours = (paths > 0).then(|| Estimate {
            value: 100.0 * with as f64 / paths as f64,
            interval: interval.map(|interval| [100.0 * interval.low, 100.0 * interval.high]),
            what: format!("% of paths: {}", self.metric.label.to_lowercase()),
            n: paths,
        });
        finding
    }

    fn holds(&self, evidence: &Evidence<'_>) -> Option<(String, bool)> {
        let study = self.explored?;
        let total = self.total(evidence.run(&study.name)?);
        (total[0] > 0).then(|| (study.name.clone(), self.is_allowed(total)))
    }
}
