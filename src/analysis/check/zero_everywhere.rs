//! Whether a count that should be 0 is 0 on every path that contenders return, refused ones included.

use super::{Check, Entry};
use crate::analysis::evidence::{Evidence, Run};
use crate::analysis::metric::Metric;
use crate::analysis::verdict::{Estimate, Finding, Verdict};
use crate::study::record::{Row, Status};
use base::seed;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use stats::bootstrap::{Resampling, percentile};
use std::collections::BTreeMap;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "zero_everywhere",
    about: "is a count 0 on every path that contenders return, those that the verifier refuses included?",
    settings: Accepted::of::<Settings>(),
    example: r#"
study = "variants"
problems = "cell"
contenders = ["Improved A*, CLOSED in sequence", "Original A*, CLOSED in sequence"]
metric = "unjoined_legs"
"#,
    build: |context| {
        let settings: Settings = context.settings.read()?;
        let problems = std::slice::from_ref(&settings.problems);
        let contenders: Vec<&str> = settings.contenders.iter().map(String::as_str).collect();
        let study = context.study(&settings.study, problems, &contenders)?;
        let metric = context.metric(&settings.metric, study)?;
        let seed = seed::derive(0, &[&context.paper.id, &context.claim.id]);
        Ok(Box::new(ZeroEverywhere { settings, metric, seed }))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The study whose records are looked at.
    study: String,
    /// The problem group, by its label.
    problems: String,
    /// The contenders, by their labels.
    contenders: Vec<String>,
    /// The metric: a name that `replan list metrics` gives, or one that a reading gives a meaning.
    metric: String,
}

struct ZeroEverywhere {
    settings: Settings,
    metric: &'static Metric,
    seed: u64,
}

/// Of the paths on one draw: all, those with a count above 0, and those that the verifier refuses.
type Tally = [usize; 3];

fn share(tallies: &[&Tally]) -> Option<f64> {
    let sum = |i: usize| tallies.iter().map(|tally| tally[i]).sum::<usize>() as f64;
    (sum(0) > 0.0).then(|| sum(1) / sum(0))
}

impl ZeroEverywhere {
    /// The paths that a contender returned, each as a tally of one.
    fn returned<'a>(&self, run: &'a Run<'_>, contender: &str) -> impl Iterator<Item = (&'a Row, Tally)> {
        run.rows(&self.settings.problems, contender).into_iter().filter_map(|row| {
            let is_refused = row.status == Status::Rejected;
            let is_returned = row.status == Status::Solved || is_refused;
            let value = run.value(row, self.metric).filter(|_| is_returned)?;
            Some((row, [1, usize::from(value > 0.0), usize::from(is_refused)]))
        })
    }
}

impl Check for ZeroEverywhere {
    fn judge(&self, evidence: &Evidence<'_>) -> Finding {
        let Settings { study, contenders, .. } = &self.settings;
        let mut finding = Finding::of(ENTRY.name);
        let Some(run) = evidence.run(study) else { return finding };
        let mut draws: BTreeMap<u32, Tally> = BTreeMap::new();
        for contender in contenders {
            let mut own: Tally = [0; 3];
            for (row, seen) in self.returned(run, contender) {
                for tally in [&mut own, draws.entry(row.draw()).or_default()] {
                    tally.iter_mut().zip(seen).for_each(|(sum, one)| *sum += one);
                }
                if seen[1] > 0 && finding.trial.is_none() {
                    finding.trial = Some(run.trial(row));
                }
            }
            finding.because.push(format!(
                "{contender}: of {} paths returned, {} ({:.0} %) have {} above 0 and the verifier refuses {} ({:.0} %)",
                own[0],
                own[1],
                100.0 * own[1] as f64 / own[0].max(1) as f64,
                self.metric.label.to_lowercase(),
                own[2],
                100.0 * own[2] as f64 / own[0].max(1) as f64
            ));
        }
        let tallies: Vec<Tally> = draws.into_values().collect();
        let all: usize = tallies.iter().map(|tally| tally[0]).sum();
        let wrong: usize = tallies.iter().map(|tally| tally[1]).sum();
        finding.verdict = Some(match (all, wrong) {
            (0, _) => Verdict::Undecided,
            (_, 0) => Verdict::Reproduced,
            _ => Verdict::NotReproduced,
        });
        let plan = Resampling { resamples: 2000, level: 0.95, seed: self.seed };
        if let Some(found) = percentile(&tallies, share, plan) {
            let what = "share of paths on which it is above 0, bootstrap over draws, 95 %";
            finding.ours = Some(Estimate::new(found.value, found.interval, what, tallies.len()));
        }
        finding
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_share_is_of_paths_and_not_of_draws() {
        assert_eq!(share(&[&[3, 1, 0], &[1, 1, 1]]), Some(0.5));
        assert_eq!(share(&[&[0, 0, 0]]), None);
    }
}
