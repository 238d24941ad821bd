//! Whether a contender's metric differs between problems that differ in one thing.

use super::{Check, Entry};
use crate::analysis::evidence::Evidence;
use crate::analysis::metric::Metric;
use crate::analysis::verdict::{Finding, Verdict};
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use stats::summary::median;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "varies",
    about: "does a contender's median differ between problems that differ in one thing?",
    settings: Accepted::of::<Settings>(),
    example: r#"
study = "variation"
contender = "A* 8"
metric = "path_length_cm"
problems = [
    ["case 1, circles", "case 1, squares", "case 1, hexagons", "case 1, triangles"],
    ["case 2, circles", "case 2, squares", "case 2, hexagons", "case 2, triangles"],
]
"#,
    build: |context| {
        let settings: Settings = context.settings.read()?;
        let contenders = [settings.contender.as_str()];
        let study = context.study(&settings.study, &settings.problems.concat(), &contenders)?;
        let short = settings.problems.iter().position(|set| set.len() < 2);
        if let Some(set) = short.or(settings.problems.is_empty().then_some(0)) {
            let message = "each set of problems needs at least two names";
            return Err(context.settings.error_at(&format!("problems.{set}"), message));
        }
        let metric = context.metric(&settings.metric, study)?;
        let is_fitted = study.fitted_to.contains(&context.claim.id);
        Ok(Box::new(Varies { settings, metric, is_fitted }))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The study whose records are looked at.
    study: String,
    /// Sets of problems; within each the metric is claimed to vary.
    problems: Vec<Vec<String>>,
    /// The contender, by its label.
    contender: String,
    /// The metric: a name that `replan list metrics` gives, or one that a reading gives a meaning.
    metric: String,
}

struct Varies {
    settings: Settings,
    metric: &'static Metric,
    is_fitted: bool,
}

impl Check for Varies {
    fn judge(&self, evidence: &Evidence<'_>) -> Finding {
        let mut finding = Finding::of(ENTRY.name);
        let Some(run) = evidence.run(&self.settings.study) else { return finding };
        let value = |problem: &String| {
            let rows = run.rows(problem, &self.settings.contender);
            median(&rows.iter().filter_map(|row| run.value(row, self.metric)).collect::<Vec<_>>())
        };
        let mut differ = 0;
        for set in &self.settings.problems {
            let found: Vec<Option<f64>> = set.iter().map(value).collect();
            let spelled = |(problem, value): (&String, &Option<f64>)| match value {
                Some(value) => format!("{problem} {value:.4}"),
                None => format!("{problem} –"),
            };
            finding.because.push(set.iter().zip(&found).map(spelled).collect::<Vec<_>>().join(", "));
            let known: Vec<f64> = found.into_iter().flatten().collect();
            let is_other = |value: &f64| (value - known[0]).abs() > 1e-9;
            differ += usize::from(known.len() == set.len() && known.iter().any(is_other));
        }
        finding.verdict = Some(match (differ, self.is_fitted) {
            (0, _) => Verdict::NotReproduced,
            (_, true) => Verdict::Fitted,
            (all, false) if all == self.settings.problems.len() => Verdict::Reproduced,
            _ => Verdict::DirectionOnly,
        });
        finding.because.push(format!(
            "{} of {} differs in {differ} of {} sets",
            self.metric.label.to_lowercase(),
            self.settings.contender,
            self.settings.problems.len()
        ));
        finding
    }
}
