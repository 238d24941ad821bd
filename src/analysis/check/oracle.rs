//! Whether every trial's number equals the one that stands beside it as known, both ways.

use super::{Check, Entry};
use crate::analysis::evidence::Evidence;
use crate::analysis::metric::Metric;
use crate::analysis::verdict::{Estimate, Finding, Verdict};
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "oracle",
    about: "is a metric within a tolerance of a known one on every trial, neither above nor below?",
    settings: Accepted::of::<Settings>(),
    example: r#"
study = "scenarios"
problems = ["sample"]
contenders = ["A*"]
metric = "path_cost_cells"
truth = "printed_optimal_cells"
within = 0.0001
"#,
    build: |context| {
        let settings: Settings = context.settings.read()?;
        let contenders: Vec<&str> = settings.contenders.iter().map(String::as_str).collect();
        let study = context.study(&settings.study, &settings.problems, &contenders)?;
        let (metric, truth) =
            (context.metric(&settings.metric, study)?, context.metric(&settings.truth, study)?);
        if settings.within.is_nan() || settings.within < 0.0 {
            let message = format!("within is {}; 0 or more is accepted", settings.within);
            return Err(context.settings.error_at("within", message));
        }
        Ok(Box::new(Oracle { settings, metric, truth }))
    },
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
    /// The metric that holds the truth on the same trial.
    truth: String,
    /// How far the metric may be from the truth, in the metric's unit.
    within: f64,
}

struct Oracle {
    settings: Settings,
    metric: &'static Metric,
    truth: &'static Metric,
}

impl Check for Oracle {
    fn judge(&self, evidence: &Evidence<'_>) -> Finding {
        let mut finding = Finding::of(ENTRY.name);
        let (mut trials, mut worst, mut off) = (0, 0.0_f64, 0);
        let run = evidence.run(&self.settings.study);
        for (run, group) in
            run.iter().flat_map(|run| self.settings.problems.iter().map(move |group| (run, group)))
        {
            for row in self.settings.contenders.iter().flat_map(|contender| run.rows(group, contender)) {
                trials += 1;
                let pair = run.value(row, self.metric).zip(run.value(row, self.truth));
                // What was not measured is as wrong as what is far off.
                let apart = pair.map_or(f64::INFINITY, |(ours, truth)| (ours - truth).abs());
                worst = worst.max(apart);
                if apart > self.settings.within {
                    off += 1;
                    finding.trial.get_or_insert_with(|| run.trial(row));
                }
            }
        }
        finding.verdict = Some(match (trials, off) {
            (0, _) => Verdict::Undecided,
            (_, 0) => Verdict::Reproduced,
            _ => Verdict::NotReproduced,
        });
        let (metric, truth) = (self.metric.label.to_lowercase(), self.truth.label.to_lowercase());
        if worst.is_finite() && trials > 0 {
            let what = format!("largest distance between {metric} and {truth}");
            finding.ours = Some(Estimate { value: worst, interval: None, what, n: trials });
        }
        finding.because.push(format!(
            "{metric} of {} against {truth} on {}: {} of {trials} trials within {}, {off} not",
            self.settings.contenders.join(", "),
            self.settings.problems.join(", "),
            trials - off,
            self.settings.within
        ));
        finding
    }
}
