//! Whether our mean change between two contenders agrees with a printed reduction within the margin.

use super::{Check, Entry};
use crate::analysis::evidence::Evidence;
use crate::analysis::metric::Metric;
use crate::analysis::verdict::{Estimate, Finding, Verdict};
use crate::study::Study;
use audit::printed::Printed;
use base::seed;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use stats::bootstrap::Resampling;
use stats::interval::Interval;
use stats::paired::ratio_of_means;
use stats::proportion::units_for_margin;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "compare",
    about: "does the mean reduction of a metric, over paired problems, agree with the printed one within a margin?",
    settings: Accepted::of::<Settings>(),
    example: r#"
study = "ensemble"
problems = ["simple cells 10 %", "simple cells 20 %", "simple cells 30 %", "simple rectangles 10 %", "simple rectangles 20 %", "simple rectangles 30 %", "simple bars 10 %", "simple bars 20 %", "simple bars 30 %"]
metric = "plan_time_us"
contender = "Improved A*"
against = "A*"
within_points = 5
"#,
    build: |context| {
        let settings: Settings = context.settings.read()?;
        let contenders = [settings.contender.as_str(), settings.against.as_str()];
        let study = context.study(&settings.study, &settings.problems, &contenders)?;
        if settings.within_points.is_nan() || settings.within_points <= 0.0 {
            let message = format!("within_points is {}; more than 0 is accepted", settings.within_points);
            return Err(context.settings.error_at("within_points", message));
        }
        let metric = context.metric(&settings.metric, study)?;
        let is_fitted = study.fitted_to.contains(&context.claim.id);
        let seed = seed::derive(0, &[&context.paper.id, &context.claim.id]);
        Ok(Box::new(Compare { settings, study, metric, printed: context.printed()?, is_fitted, seed }))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The study whose records are looked at.
    study: String,
    /// The problem groups, by their labels.
    problems: Vec<String>,
    /// The metric: a name that `replan list metrics` gives, or one that a reading gives a meaning.
    metric: String,
    /// The contender, by its label.
    contender: String,
    /// The contender that it is held against, by its label.
    against: String,
    /// How far ours may be from the printed reduction, in percentage points.
    within_points: f64,
}

struct Compare<'a> {
    settings: Settings,
    study: &'a Study,
    metric: &'static Metric,
    printed: Printed,
    is_fitted: bool,
    seed: u64,
}

impl Compare<'_> {
    fn verdict(&self, reduction: Interval) -> Verdict {
        let (printed, margin) = (self.printed.value(), self.settings.within_points);
        let accepted = Interval::new(printed - margin, printed + margin);
        let inside = accepted.contains(reduction.low) && accepted.contains(reduction.high);
        let same_sign = if printed > 0.0 { reduction.low > 0.0 } else { reduction.high < 0.0 };
        match (inside, accepted.meets(reduction), same_sign) {
            (true, _, _) if self.is_fitted => Verdict::Fitted,
            (true, _, _) if self.study.searched => Verdict::Attainable,
            (true, _, _) => Verdict::Reproduced,
            (false, true, _) => Verdict::Undecided,
            (false, false, true) => Verdict::DirectionOnly,
            (false, false, false) => Verdict::NotReproduced,
        }
    }
}

impl Check for Compare<'_> {
    fn judge(&self, evidence: &Evidence<'_>) -> Finding {
        let Settings { study, problems, contender, against, .. } = &self.settings;
        let measured = evidence.measured(study, problems, self.metric, against, contender);
        let pairs: Vec<(f64, f64)> = measured.iter().map(|measured| measured.values).collect();
        let plan = Resampling { resamples: 2000, level: 0.95, seed: self.seed };
        let mut finding = Finding::of(ENTRY.name);
        let Some(ratio) = ratio_of_means(&pairs, plan) else {
            return finding.undecided(format!("{} pairs were measured; at least 2 are needed", pairs.len()));
        };
        let percent = |ratio: f64| 100.0 * (1.0 - ratio);
        let reduction = Interval::new(percent(ratio.interval.high), percent(ratio.interval.low));
        let verdict = self.verdict(reduction);
        finding.verdict = Some(verdict);
        let what = format!("mean reduction of {} in %, bootstrap 95 %", self.metric.label.to_lowercase());
        finding.ours = Some(Estimate::new(percent(ratio.value), reduction, what, pairs.len()));
        finding.because.push(format!(
            "{} against {} on {} of {}: {:.2} % (95 % interval {:.2} to {:.2}, {} pairs); printed {} %, margin {} points",
            self.settings.contender,
            self.settings.against,
            super::listed(&self.settings.problems),
            self.settings.study,
            percent(ratio.value),
            reduction.low,
            reduction.high,
            pairs.len(),
            self.printed,
            self.settings.within_points
        ));
        if verdict == Verdict::Undecided {
            let needed =
                units_for_margin(reduction.half_width(), pairs.len(), self.settings.within_points / 2.0);
            finding.because.push(format!("about {needed} pairs would give an interval of half the margin"));
        }
        finding
    }
}
