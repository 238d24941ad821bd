//! Whether a printed range of savings, both ends together, could be that of one more draw.

use super::{Check, Entry};
use crate::analysis::draws::Compared;
use crate::analysis::evidence::Evidence;
use crate::analysis::metric::Metric;
use crate::analysis::verdict::{Estimate, Finding, Verdict};
use crate::study::Study;
use audit::printed::Digits;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use stats::interval::Interval;
use stats::proportion::clopper_pearson;
use stats::summary::median;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "savings_within",
    about: "do the savings on all queries of a draw lie between two printed ones often enough for the range to be one draw's?",
    settings: Accepted::of::<Settings>(),
    example: r#"
study = "length"
problems = "cell"
metric = "path_length_mm"
contender = "Improved A*"
against = "Original A*"
least = "length.least"
greatest = "length.greatest"
refused_below = 0.05
"#,
    build: |context| {
        let settings: Settings = context.settings.read()?;
        let contenders = [settings.contender.as_str(), settings.against.as_str()];
        let study = context.study(&settings.study, std::slice::from_ref(&settings.problems), &contenders)?;
        let metric = context.metric(&settings.metric, study)?;
        let end = |id: &String| context.printed_of(id).map(|(printed, _)| printed.interval(Digits::Rounded));
        let (least, greatest) = (end(&settings.least)?.low, end(&settings.greatest)?.high);
        if least > greatest {
            let message = format!(
                "the claim `{}`, named as `least`, prints more than `{}`, named as `greatest`; the other way round is accepted",
                settings.least, settings.greatest
            );
            return Err(context.settings.error_at("least", message));
        }
        let range = Interval::new(least, greatest);
        Ok(Box::new(SavingsWithin { settings, study, metric, range }))
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
    /// The claims that print the ends of the range.
    least: String,
    /// The claim that prints the greatest saving.
    greatest: String,
    /// The range is refused if fewer than this share of draws of which both solve every query stay within it.
    refused_below: f64,
}

struct SavingsWithin<'a> {
    settings: Settings,
    study: &'a Study,
    metric: &'static Metric,
    /// The printed range, as far as its ends may have been rounded.
    range: Interval,
}

impl Check for SavingsWithin<'_> {
    fn judge(&self, evidence: &Evidence<'_>) -> Finding {
        let Settings { study, problems, contender, against, refused_below, .. } = &self.settings;
        let mut finding = Finding::of(ENTRY.name);
        let Some(run) = evidence.run(study) else { return finding };
        let compared =
            Compared { group: problems, contenders: [against, contender], query: None, whole: true };
        let draws = compared.savings_percent(run, self.metric);
        let within =
            draws.iter().filter(|draw| draw.iter().all(|saving| self.range.contains(*saving))).count();
        let Some(interval) = clopper_pearson(within, draws.len(), 0.95) else {
            return finding.undecided("no draw has all its queries solved by both");
        };
        // The printed draw is counted with ours, as if it were one that stays within.
        let rank = (within + 1) as f64 / (draws.len() + 1) as f64;
        finding.verdict = Some(match rank >= *refused_below {
            true if self.study.searched => Verdict::Attainable,
            true => Verdict::Reproduced,
            false => Verdict::NotReproduced,
        });
        let share = within as f64 / draws.len() as f64;
        let what = "share of draws within the range, Clopper–Pearson 95 %";
        finding.ours = Some(Estimate::new(share, interval, what, draws.len()));
        let count = |is: &dyn Fn(&f64) -> bool| draws.iter().filter(|draw| draw.iter().all(is)).count();
        let all: Vec<f64> = draws.iter().flatten().copied().collect();
        finding.because.push(format!(
            "{contender} against {against}: on {within} of {} draws of which both solve every query all savings in {} lie in \
             [{}, {}] % (rank {rank:.3}, refused below {refused_below}); the lower end alone holds on {}, the upper end alone on {}; \
             the median saving over their queries is {:.1} %",
            draws.len(),
            self.metric.label.to_lowercase(),
            self.range.low,
            self.range.high,
            count(&|saving| *saving >= self.range.low),
            count(&|saving| *saving <= self.range.high),
            median(&all).unwrap_or(f64::NAN)
        ));
        finding
    }
}
