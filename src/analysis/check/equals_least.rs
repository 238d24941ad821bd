//! Whether a contender attains, on every problem, the least that another one finds.

use super::{Check, Entry};
use crate::analysis::draws::Compared;
use crate::analysis::evidence::Evidence;
use crate::analysis::metric::Metric;
use crate::analysis::verdict::{Estimate, Finding, Verdict};
use base::seed;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use stats::bootstrap::{Resampling, percentile};

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "equals_least",
    about: "does a contender attain the least value, which another contender finds, on every problem that both solve?",
    settings: Accepted::of::<Settings>(),
    example: r#"
study = "length"
problems = "cell"
metric = "local_paths"
contender = "Original A*"
least = "Roadmap fewest hops"
"#,
    build: |context| {
        let settings: Settings = context.settings.read()?;
        let contenders = [settings.contender.as_str(), settings.least.as_str()];
        let study = context.study(&settings.study, std::slice::from_ref(&settings.problems), &contenders)?;
        let metric = context.metric(&settings.metric, study)?;
        let seed = seed::derive(0, &[&context.paper.id, &context.claim.id]);
        Ok(Box::new(EqualsLeast { settings, metric, seed }))
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
    /// The contender that finds the least value.
    least: String,
}

struct EqualsLeast {
    settings: Settings,
    metric: &'static Metric,
    seed: u64,
}

/// Values this close are the same, relative.
const SAME: f64 = 1e-9;

fn is_least((least, own): &(f64, f64)) -> bool {
    *own <= least * (1.0 + SAME)
}

/// Pairs that attain the least, as a share of all.
fn share(draws: &[&Vec<(f64, f64)>]) -> Option<f64> {
    let all: Vec<&(f64, f64)> = draws.iter().flat_map(|draw| draw.iter()).collect();
    let attained = all.iter().filter(|pair| is_least(pair)).count();
    (!all.is_empty()).then(|| attained as f64 / all.len() as f64)
}

impl Check for EqualsLeast {
    fn judge(&self, evidence: &Evidence<'_>) -> Finding {
        let Settings { study, problems, contender, least, .. } = &self.settings;
        let mut finding = Finding::of(ENTRY.name);
        let Some(run) = evidence.run(study) else { return finding };
        let compared =
            Compared { group: problems, contenders: [least, contender], query: None, whole: false };
        let draws = compared.values(run, self.metric);
        let pairs: Vec<&(f64, f64)> = draws.iter().flatten().collect();
        let attained = pairs.iter().filter(|pair| is_least(pair)).count();
        finding.verdict = Some(match pairs.len() {
            0 => Verdict::Undecided,
            all if attained == all => Verdict::Reproduced,
            _ => Verdict::NotReproduced,
        });
        let sum = |get: fn(&(f64, f64)) -> f64| pairs.iter().map(|pair| get(pair)).sum::<f64>();
        finding.because.push(format!(
            "{contender} attains the {} of {least} on {attained} of {} problems that both solve, and is {:.1} % above it on the whole",
            self.metric.label.to_lowercase(),
            pairs.len(),
            100.0 * (sum(|pair| pair.1) / sum(|pair| pair.0) - 1.0)
        ));
        let plan = Resampling { resamples: 2000, level: 0.95, seed: self.seed };
        if let Some(found) = percentile(&draws, share, plan) {
            let what = "share of problems on which the least is attained, bootstrap over draws, 95 %";
            finding.ours = Some(Estimate::new(found.value, found.interval, what, draws.len()));
        }
        finding
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_is_no_excess_and_a_ppm_is() {
        assert!(is_least(&(1000.0, 1000.0 + 1e-10)) && !is_least(&(1000.0, 1000.001)));
        assert_eq!(share(&[&vec![(2.0, 2.0), (2.0, 3.0)], &vec![(1.0, 1.0), (1.0, 1.0)]]), Some(0.75));
    }
}
