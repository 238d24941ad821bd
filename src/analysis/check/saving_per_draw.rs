//! Whether a printed saving, the least or greatest over a draw's queries, could be that of one more draw.

use super::{Check, Entry};
use crate::analysis::draws::Compared;
use crate::analysis::evidence::Evidence;
use crate::analysis::metric::Metric;
use crate::analysis::verdict::{Estimate, Finding, Verdict};
use crate::study::Study;
use audit::printed::Printed;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use stats::proportion::predictive;
use stats::summary::mean;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "saving_per_draw",
    about: "does the printed least, greatest or mean saving over a draw's queries lie where one more draw of ours would?",
    settings: Accepted::of::<Settings>(),
    example: r#"
study = "length"
problems = "cell"
metric = "path_length_mm"
contender = "Improved A*"
against = "Original A*"
of_queries = "least"
whole_draws = true
"#,
    build: |context| {
        let settings: Settings = context.settings.read()?;
        let contenders = [settings.contender.as_str(), settings.against.as_str()];
        let study = context.study(&settings.study, std::slice::from_ref(&settings.problems), &contenders)?;
        let metric = context.metric(&settings.metric, study)?;
        let is_fitted = study.fitted_to.contains(&context.claim.id);
        Ok(Box::new(SavingPerDraw { settings, study, metric, printed: context.printed()?, is_fitted }))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The study whose records are looked at.
    study: String,
    /// The problem group, by its label.
    problems: String,
    /// The metric: a name that `replan list metrics` gives, or one that a reading gives a meaning.
    metric: String,
    /// The contender, by its label.
    contender: String,
    /// The contender that it is held against, by its label.
    against: String,
    /// What is taken of the savings on one draw's queries.
    of_queries: Statistic,
    /// Whether only draws count of which both solve every query: a least value falls with the number it is taken of.
    whole_draws: bool,
}

/// What is taken of the savings on one draw's queries.
#[derive(Deserialize, JsonSchema, Clone, Copy)]
#[serde(rename_all = "snake_case")]
enum Statistic {
    /// The smallest.
    Least,
    /// The mean.
    Mean,
    /// The largest.
    Greatest,
}

impl Statistic {
    fn of(self, savings: &[f64]) -> f64 {
        match self {
            Self::Least => savings.iter().copied().fold(f64::INFINITY, f64::min),
            Self::Greatest => savings.iter().copied().fold(f64::NEG_INFINITY, f64::max),
            Self::Mean => savings.iter().sum::<f64>() / savings.len() as f64,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Least => "least",
            Self::Mean => "mean",
            Self::Greatest => "greatest",
        }
    }
}

struct SavingPerDraw<'a> {
    settings: Settings,
    study: &'a Study,
    metric: &'static Metric,
    printed: Printed,
    is_fitted: bool,
}

impl Check for SavingPerDraw<'_> {
    fn judge(&self, evidence: &Evidence<'_>) -> Finding {
        let Settings { study, problems, contender, against, of_queries, whole_draws, .. } = &self.settings;
        let mut finding = Finding::of(ENTRY.name);
        let Some(run) = evidence.run(study) else { return finding };
        let compared =
            Compared { group: problems, contenders: [against, contender], query: None, whole: *whole_draws };
        let drawn = compared.savings_percent(run, self.metric);
        let draws: Vec<f64> = drawn.iter().map(|draw| of_queries.of(draw)).collect();
        let (Some(interval), Some(mean)) = (predictive(&draws, 0.95), mean(&draws)) else {
            return finding
                .undecided(format!("{} draws; a 95 % predictive interval takes at least 39", draws.len()));
        };
        let printed = self.printed.value();
        finding.verdict = Some(match interval.contains(printed) {
            true if self.is_fitted => Verdict::Fitted,
            true if self.study.searched => Verdict::Attainable,
            true => Verdict::Reproduced,
            // Both are savings, or both are losses.
            false if mean * printed > 0.0 => Verdict::DirectionOnly,
            false => Verdict::NotReproduced,
        });
        let name = of_queries.name();
        let what = format!("{name} saving over a draw's queries in %, mean and 95 % predictive interval");
        finding.ours = Some(Estimate::new(mean, interval, what, draws.len()));
        let pairs: usize = drawn.iter().map(Vec::len).sum();
        let which = if *whole_draws { "draws of which both solve every query" } else { "draws" };
        finding.because.push(format!(
            "{contender} against {against}: the {name} saving in {} over the queries that both solve ({pairs} on {} {which}) is \
             {mean:.1} % on average and lies in [{:.1}, {:.1}] % for one more draw; printed {} %, reached in {} draws",
            self.metric.label.to_lowercase(),
            draws.len(),
            interval.low,
            interval.high,
            self.printed,
            draws.iter().filter(|draw| **draw >= printed).count()
        ));
        finding
    }
}
