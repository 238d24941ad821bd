//! Whether one contender is lower than another, on average over problems or on every one.

use super::{Check, Entry};
use crate::analysis::evidence::Evidence;
use crate::analysis::metric::Metric;
use crate::analysis::verdict::{Estimate, Finding, Verdict};
use crate::study::Study;
use base::seed;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use stats::bootstrap::Resampling;
use stats::paired::{EQUAL, mean_difference, signs};
use stats::proportion::{units_for_margin, wilson};

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "ordering",
    about: "is one contender lower than another in a metric, on average or on every problem?",
    settings: Accepted::of::<Settings>(),
    example: r#"
study = "environments"
problems = ["EA", "EB"]
metric = "nodes"
lower = "Improved A*"
higher = "A*"
on = "every"
"#,
    build: |context| {
        let settings: Settings = context.settings.read()?;
        let contenders = [settings.lower.as_str(), settings.higher.as_str()];
        let study = context.study(&settings.study, &settings.problems, &contenders)?;
        let metric = context.metric(&settings.metric, study)?;
        let seed = seed::derive(0, &[&context.paper.id, &context.claim.id]);
        Ok(Box::new(Ordering { settings, study, metric, seed }))
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
    /// The contender that is claimed to be lower.
    lower: String,
    /// The contender that is claimed to be higher.
    higher: String,
    /// On which problems it is to hold.
    on: On,
}

/// On which problems the claim is to hold.
#[derive(Deserialize, JsonSchema, Clone, Copy, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
enum On {
    /// On average over the problems.
    Average,
    /// On every problem: one counterexample contradicts it.
    Every,
}

/// Why times of one session settle nothing.
const CLOCK: &str = "the interval is over problems within one session of one clock; sessions differ by more than it says, \
                     so that this settles nothing";

struct Ordering<'a> {
    settings: Settings,
    study: &'a Study,
    metric: &'static Metric,
    seed: u64,
}

impl Ordering<'_> {
    fn holds(&self) -> Verdict {
        if self.study.searched { Verdict::Attainable } else { Verdict::Reproduced }
    }

    fn on_every(&self, pairs: &[(f64, f64)], finding: &mut Finding) {
        let signs = signs(pairs);
        let kept = signs.lower;
        finding.verdict = Some(match pairs.len() {
            0 => Verdict::Undecided,
            n if kept == n => self.holds(),
            _ => Verdict::NotReproduced,
        });
        if let Some(interval) = wilson(kept, pairs.len(), 0.95) {
            let share = kept as f64 / pairs.len() as f64;
            let what = "share of problems on which it is lower, Wilson 95 %";
            finding.ours = Some(Estimate::new(share, interval, what, pairs.len()));
        }
    }

    fn on_average(&self, pairs: &[(f64, f64)], finding: &mut Finding) {
        let plan = Resampling { resamples: 2000, level: 0.95, seed: self.seed };
        let Some(mean) = mean_difference(pairs, plan) else {
            finding.verdict = Some(Verdict::Undecided);
            finding.because.push(format!("{} pairs were measured; at least 2 are needed", pairs.len()));
            return;
        };
        finding.verdict = Some(if mean.interval.high < 0.0 {
            self.holds()
        } else if mean.interval.low > 0.0 {
            Verdict::NotReproduced
        } else {
            Verdict::Undecided
        });
        if finding.verdict == Some(Verdict::Undecided) && mean.value != 0.0 {
            let needed = units_for_margin(mean.interval.half_width(), pairs.len(), mean.value.abs());
            finding.because.push(format!("about {needed} pairs would settle a mean difference of this size"));
        }
        if self.metric.is_clock() {
            finding.because.push(CLOCK.to_owned());
            finding.verdict = Some(Verdict::Undecided);
        }
        let what = format!("mean difference of {}, bootstrap 95 %", self.metric.title().to_lowercase());
        finding.ours = Some(Estimate::new(mean.value, mean.interval, what, pairs.len()));
    }
}

impl Check for Ordering<'_> {
    fn judge(&self, evidence: &Evidence<'_>) -> Finding {
        let Settings { study, problems, lower, higher, .. } = &self.settings;
        let found = evidence.measured(study, problems, self.metric, higher, lower);
        let pairs: Vec<(f64, f64)> = found.iter().map(|measured| measured.values).collect();
        let mut finding = Finding::of(ENTRY.name);
        let signs = signs(&pairs);
        finding.because.push(format!(
            "{} against {} on {} of {}: {} lower on {}, equal on {}, higher on {} of {} problems",
            self.settings.lower,
            self.settings.higher,
            super::listed(&self.settings.problems),
            self.settings.study,
            self.metric.label.to_lowercase(),
            signs.lower,
            signs.equal,
            signs.higher,
            pairs.len()
        ));
        finding.trial = found.iter().find(|m| m.values.1 > m.values.0 + EQUAL).map(|m| m.trial.clone());
        match self.settings.on {
            On::Every => self.on_every(&pairs, &mut finding),
            On::Average => self.on_average(&pairs, &mut finding),
        }
        finding
    }
}
