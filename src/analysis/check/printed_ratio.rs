//! Whether the ratio of two printed numbers is that of a contender's numbers on two problems: what is left to compare
//! where the unit (a machine, a program) is unknown.

use super::{Check, Context, Entry};
use crate::analysis::evidence::{Evidence, Run};
use crate::analysis::metric::Metric;
use crate::analysis::verdict::{Estimate, Finding, Verdict};
use base::settings::{Accepted, SettingsError};
use schemars::JsonSchema;
use serde::Deserialize;
use stats::summary::median;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "printed_ratio",
    about: "is the ratio of two printed numbers that of a contender's medians on two problems, by each of some metrics?",
    settings: Accepted::of::<Settings>(),
    example: r#"
of = ["case1.time", "case2.time"]
study = "methods"
problems = ["case 1", "case 2"]
contender = "A* 8"
metrics = ["plan_time_us", "expansions", "generated", "list_operations"]
within_percent = 10
"#,
    build: |context| Ok(Box::new(PrintedRatio::new(context)?)),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// Two claims: one whose number is divided, and one whose number it is divided by.
    of: [String; 2],
    /// The study whose records are looked at.
    study: String,
    /// The problem of each.
    problems: [String; 2],
    /// The contender, by its label.
    contender: String,
    /// What may stand for the printed numbers; the first is shown.
    metrics: Vec<String>,
    /// How far ours may be from the printed ratio.
    within_percent: f64,
}

struct PrintedRatio {
    settings: Settings,
    /// The printed ratio, and its ends by the digits.
    printed: [f64; 3],
    metrics: Vec<&'static Metric>,
}

impl PrintedRatio {
    fn new(context: &Context<'_>) -> Result<Self, SettingsError> {
        let settings: Settings = context.settings.read()?;
        let study = context.study(&settings.study, &settings.problems, &[settings.contender.as_str()])?;
        let metrics = settings.metrics.iter().map(|name| context.metric(name, study));
        let metrics = metrics.collect::<Result<Vec<_>, _>>()?;
        if metrics.is_empty() {
            return Err(context.settings.error_at("metrics", "metrics is empty; at least one is accepted"));
        }
        if settings.within_percent.is_nan() || settings.within_percent <= 0.0 {
            let message = format!("within_percent is {}; more than 0 is accepted", settings.within_percent);
            return Err(context.settings.error_at("within_percent", message));
        }
        let [(one, of_one), (two, of_two)] =
            [context.printed_of(&settings.of[0])?, context.printed_of(&settings.of[1])?];
        let (a, b) = (one.interval(of_one), two.interval(of_two));
        if b.low <= 0.0 {
            let message = format!("claim `{}` may print 0; a ratio needs more", settings.of[1]);
            return Err(context.settings.error_at("of.1", message));
        }
        let printed = [one.value() / two.value(), a.low / b.high, a.high / b.low];
        Ok(Self { settings, printed, metrics })
    }

    fn ratio(&self, run: &Run<'_>, metric: &Metric) -> Option<(f64, usize)> {
        let values = |problem: &String| -> Vec<f64> {
            let rows = run.rows(problem, &self.settings.contender);
            rows.iter().filter_map(|row| run.value(row, metric)).collect()
        };
        let [one, two] = self.settings.problems.each_ref().map(values);
        Some((median(&one)? / median(&two)?, one.len().min(two.len())))
    }
}

impl Check for PrintedRatio {
    fn judge(&self, evidence: &Evidence<'_>) -> Finding {
        let mut finding = Finding::of(ENTRY.name);
        let Some(run) = evidence.run(&self.settings.study) else { return finding };
        let ours = self.metrics.iter().filter_map(|metric| Some((*metric, self.ratio(run, metric)?)));
        let ours: Vec<(&Metric, (f64, usize))> = ours.collect();
        let [printed, low, high] = self.printed;
        let slack = self.settings.within_percent / 100.0;
        let is_near = |ratio: f64| ratio >= low * (1.0 - slack) && ratio <= high * (1.0 + slack);
        let near = ours.iter().filter(|(_, (ratio, _))| is_near(*ratio)).count();
        let same_side = ours.iter().all(|(_, (ratio, _))| (*ratio > 1.0) == (printed > 1.0));
        finding.verdict = Some(if ours.len() < self.metrics.len() {
            Verdict::Undecided
        } else if near == ours.len() {
            Verdict::Reproduced
        } else if same_side {
            Verdict::DirectionOnly
        } else {
            Verdict::NotReproduced
        });
        let [one, two] = &self.settings.problems;
        finding.because.push(format!("the printed ratio of {one} to {two} is {printed:.4}"));
        finding.because.extend(ours.iter().map(|(metric, (ratio, _))| {
            format!("ours of {} by {}: {ratio:.3}", self.settings.contender, metric.label.to_lowercase())
        }));
        finding.ours = ours.first().map(|(metric, (value, n))| Estimate {
            value: *value,
            interval: None,
            what: format!("{} of {}, {one} over {two}", metric.label.to_lowercase(), self.settings.contender),
            n: *n,
        });
        finding
    }
}
