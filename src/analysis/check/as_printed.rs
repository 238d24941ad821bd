//! Whether a contender's metric on one problem prints as the paper prints it.

use super::{Check, Entry};
use crate::analysis::evidence::Evidence;
use crate::analysis::metric::Metric;
use crate::analysis::verdict::{Estimate, Finding, Verdict};
use crate::study::Study;
use audit::printed::{Digits, Printed};
use base::settings::{Accepted, SettingsError};
use schemars::JsonSchema;
use serde::Deserialize;
use stats::summary::median;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "as_printed",
    about: "does a contender's metric on one problem, the median over its trials, print as the paper prints it?",
    settings: Accepted::of::<Settings>(),
    example: r#"
study = "methods"
problems = "case 1 safe"
contender = "A* 8"
metric = "path_length_cm"
"#,
    build: |context| {
        let settings: Settings = context.settings.read()?;
        let study = context.study(
            &settings.study,
            std::slice::from_ref(&settings.problems),
            &[settings.contender.as_str()],
        )?;
        let explored = settings.explored.as_ref().map(|name| {
            context.study(name, std::slice::from_ref(&settings.problems), &[settings.contender.as_str()])
        });
        let explored = explored.transpose()?;
        let metric = context.metric(&settings.metric, study)?;
        let is_fitted = study.fitted_to.contains(&context.claim.id);
        let (printed, digits) = (context.printed()?, context.digits());
        Ok::<_, SettingsError>(Box::new(AsPrinted {
            settings,
            study,
            explored,
            metric,
            printed,
            digits,
            is_fitted,
        }))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The study whose records are looked at.
    study: String,
    /// The problem group, by its label.
    problems: String,
    /// The contender, by its label.
    contender: String,
    /// The metric: a name that `replan list metrics` gives, or one that a reading gives a meaning.
    metric: String,
    /// A study of the same problem and contender that explores readings.
    explored: Option<String>,
}

struct AsPrinted<'a> {
    settings: Settings,
    study: &'a Study,
    explored: Option<&'a Study>,
    metric: &'static Metric,
    printed: Printed,
    digits: Digits,
    is_fitted: bool,
}

impl Check for AsPrinted<'_> {
    fn judge(&self, evidence: &Evidence<'_>) -> Finding {
        let mut finding = Finding::of(ENTRY.name);
        let Settings { study, problems, contender, .. } = &self.settings;
        let rows = evidence.run(study).map(|run| (run, run.rows(problems, contender)));
        let values: Vec<f64> = rows
            .iter()
            .flat_map(|(run, rows)| rows.iter().filter_map(|row| run.value(row, self.metric)))
            .collect();
        let Some(value) = median(&values) else {
            return finding.undecided(format!("`{contender}` was not measured on `{problems}` of {study}"));
        };
        let agrees = self.printed.agrees(value, self.digits);
        finding.verdict = Some(match (agrees, self.is_fitted, self.study.searched) {
            (false, ..) => Verdict::NotReproduced,
            (true, true, _) => Verdict::Fitted,
            (true, false, true) => Verdict::Attainable,
            (true, false, false) => Verdict::Reproduced,
        });
        finding.trial = rows.and_then(|(run, rows)| rows.first().map(|row| run.trial(row)));
        let what = format!("{} of {contender}", self.metric.label.to_lowercase());
        finding.ours = Some(Estimate { value, interval: None, what, n: values.len() });
        let verb = if agrees { "prints as" } else { "does not print as" };
        finding
            .because
            .push(format!("{contender} on {problems} of {study}: {value:.6}, which {verb} {}", self.printed));
        if agrees && self.is_fitted {
            finding
                .because
                .push("the study was fitted to this number, so that agreement says little".to_owned());
        }
        finding.because.extend(super::explored_share(self, self.explored, evidence));
        finding
    }

    fn holds(&self, evidence: &Evidence<'_>) -> Option<(String, bool)> {
        let study = self.explored?;
        let run = evidence.run(&study.name)?;
        let rows = run.rows(&self.settings.problems, &self.settings.contender);
        let values: Vec<f64> = rows.iter().filter_map(|row| run.value(row, self.metric)).collect();
        Some((study.name.clone(), self.printed.agrees(median(&values)?, self.digits)))
    }
}
