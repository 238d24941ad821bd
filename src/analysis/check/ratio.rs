//! Whether the ratio of two contenders' means of a metric, over paired problems, lies within bounds.

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
use stats::interval::Interval;
use stats::paired::ratio_of_means;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "ratio",
    about: "does the ratio of two contenders' means of a metric, over paired problems, lie within bounds?",
    settings: Accepted::of::<Settings>(),
    example: r#"
study = "environments"
problems = ["E1", "E2", "E3", "E4"]
metric = "nodes"
contender = "Improved A*"
against = "A*"
accepted = [0.0, 0.5]
"#,
    build: |context| {
        let settings: Settings = context.settings.read()?;
        let contenders = [settings.contender.as_str(), settings.against.as_str()];
        let study = context.study(&settings.study, &settings.problems, &contenders)?;
        let metric = context.metric(&settings.metric, study)?;
        let [low, high] = settings.accepted;
        if !(0.0..=high).contains(&low) {
            let message = format!("accepted is [{low}, {high}]; two rising ratios of 0 or more are accepted");
            return Err(context.settings.error_at("accepted", message));
        }
        let seed = seed::derive(0, &[&context.paper.id, &context.claim.id]);
        Ok(Box::new(Ratio { settings, study, metric, seed }))
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
    /// The least and the greatest ratio under which the claim counts as reproduced.
    accepted: [f64; 2],
}

/// Means nearer to each other than by this share are equal: neither is the lower one.
const EQUAL: f64 = 1e-3;

struct Ratio<'a> {
    settings: Settings,
    study: &'a Study,
    metric: &'static Metric,
    seed: u64,
}

impl Ratio<'_> {
    fn pairs(&self, evidence: &Evidence<'_>) -> Vec<(f64, f64)> {
        let Some(run) = evidence.run(&self.settings.study) else { return Vec::new() };
        let of_group = |group: &String| {
            let pairs = run.pairs(group, &self.settings.against, &self.settings.contender);
            let values = pairs.iter().filter_map(|pair| {
                Some((run.value(pair.base, self.metric)?, run.value(pair.other, self.metric)?))
            });
            values.collect::<Vec<_>>()
        };
        self.settings.problems.iter().flat_map(of_group).collect()
    }
}

/// The verdict on a ratio that is claimed to lie within `accepted`.
fn verdict([low, high]: [f64; 2], ratio: Interval, searched: bool) -> Verdict {
    let accepted = Interval::new(low, high);
    let same_side = (high < 1.0 && ratio.high < 1.0 - EQUAL) || (low > 1.0 && ratio.low > 1.0 + EQUAL);
    if accepted.contains(ratio.low) && accepted.contains(ratio.high) {
        if searched { Verdict::Attainable } else { Verdict::Reproduced }
    } else if accepted.meets(ratio) {
        Verdict::Undecided
    } else if same_side {
        Verdict::DirectionOnly
    } else {
        Verdict::NotReproduced
    }
}

impl Check for Ratio<'_> {
    fn judge(&self, evidence: &Evidence<'_>) -> Finding {
        let pairs = self.pairs(evidence);
        let mut finding = Finding::of(ENTRY.name);
        let plan = Resampling { resamples: 2000, level: 0.95, seed: self.seed };
        let Some(found) = ratio_of_means(&pairs, plan) else {
            return finding.undecided(format!("{} pairs were measured; at least 2 are needed", pairs.len()));
        };
        finding.verdict = Some(verdict(self.settings.accepted, found.interval, self.study.searched));
        finding.because.push(format!(
            "{} of {} over that of {} on {} of {}: {:.4} (95 % interval {:.4} to {:.4}, {} pairs); accepted {} to {}",
            self.metric.label.to_lowercase(),
            self.settings.contender,
            self.settings.against,
            self.settings.problems.join(", "),
            self.settings.study,
            found.value,
            found.interval.low,
            found.interval.high,
            pairs.len(),
            self.settings.accepted[0],
            self.settings.accepted[1]
        ));
        let what = format!("ratio of mean {}, bootstrap 95 %", self.metric.label.to_lowercase());
        finding.ours = Some(Estimate::new(found.value, found.interval, what, pairs.len()));
        finding.say_what_settles(&self.settings.accepted, "pairs");
        finding
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sign_alone_is_right_only_where_the_means_differ() {
        for (low, high, searched, verdict_wanted) in [
            (1.06, 1.2, false, Verdict::Reproduced),
            (1.06, 1.2, true, Verdict::Attainable),
            (1.02, 1.2, false, Verdict::Undecided),
            (1.01, 1.02, false, Verdict::DirectionOnly),
            (1.0 + 1e-9, 1.0 + 2e-9, false, Verdict::NotReproduced),
            (0.9, 0.95, false, Verdict::NotReproduced),
        ] {
            let found = verdict([1.05, 10.0], Interval::new(low, high), searched);
            assert_eq!(found, verdict_wanted, "{low} to {high}");
        }
    }
}
