//! Whether a contender's metric is lower on some problem groups than on others.

use super::{Check, Entry};
use crate::analysis::evidence::Evidence;
use crate::analysis::metric::Metric;
use crate::analysis::stats::bootstrap::{self, Plan};
use crate::analysis::verdict::{Estimate, Finding, Verdict};
use crate::seed;
use crate::study::Study;
use crate::study::record::Status;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "between_groups",
    about: "is a contender's metric lower on some problem groups than on others, on average?",
    build: |context| {
        let settings: Settings = context.settings.read()?;
        let groups: Vec<String> = settings.lower.iter().chain(&settings.higher).cloned().collect();
        let study = context.study(&settings.study, &groups, &[&settings.contender])?;
        let metric = context.metric(&settings.metric, study)?;
        let seed = seed::derive(0, &[&context.paper.id, &context.claim.id]);
        Ok(Box::new(BetweenGroups { settings, study, metric, seed }))
    },
};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Settings {
    study: String,
    metric: String,
    contender: String,
    /// The groups on which it is claimed to be lower.
    lower: Vec<String>,
    /// The groups on which it is claimed to be higher.
    higher: Vec<String>,
}

struct BetweenGroups<'a> {
    settings: Settings,
    study: &'a Study,
    metric: &'static Metric,
    seed: u64,
}

impl BetweenGroups<'_> {
    /// The metric on every solved problem of `groups`.
    fn values(&self, evidence: &Evidence<'_>, groups: &[String]) -> Vec<f64> {
        let Some(run) = evidence.run(&self.settings.study) else { return Vec::new() };
        let rows = groups.iter().flat_map(|group| run.rows(group, &self.settings.contender));
        let solved = rows.filter(|row| row.status == Status::Solved);
        solved.filter_map(|row| run.value(row, self.metric)).collect()
    }
}

/// The mean of the tagged values less that of the others; `None` if either has none.
fn difference(units: &[&(bool, f64)]) -> Option<f64> {
    let mean = |tag: bool| {
        let values: Vec<f64> = units.iter().filter(|unit| unit.0 == tag).map(|unit| unit.1).collect();
        (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
    };
    Some(mean(true)? - mean(false)?)
}

impl Check for BetweenGroups<'_> {
    fn judge(&self, evidence: &Evidence<'_>) -> Finding {
        let tagged = |groups: &[String], tag: bool| {
            self.values(evidence, groups).into_iter().map(move |value| (tag, value)).collect::<Vec<_>>()
        };
        let mut units = tagged(&self.settings.lower, false);
        units.extend(tagged(&self.settings.higher, true));
        let mut finding = Finding::of(ENTRY.name);
        let plan = Plan { resamples: 2000, level: 0.95, seed: self.seed };
        let Some(found) = bootstrap::percentile(&units, difference, plan) else {
            return finding.undecided(format!("{} problems were solved on both sides together", units.len()));
        };
        finding.verdict = Some(if found.interval.low > 0.0 {
            if self.study.searched { Verdict::Attainable } else { Verdict::Reproduced }
        } else if found.interval.high < 0.0 {
            Verdict::NotReproduced
        } else {
            Verdict::Undecided
        });
        finding.because.push(format!(
            "{} of {}: on {} less on {} of {}: {:.4} (95 % interval {:.4} to {:.4}, {} problems)",
            self.metric.label.to_lowercase(),
            self.settings.contender,
            self.settings.higher.join(", "),
            self.settings.lower.join(", "),
            self.settings.study,
            found.value,
            found.interval.low,
            found.interval.high,
            units.len()
        ));
        let what = format!("difference of mean {}, bootstrap 95 %", self.metric.label.to_lowercase());
        finding.ours = Some(Estimate::new(found.value, found.interval, what, units.len()));
        finding
    }
}
