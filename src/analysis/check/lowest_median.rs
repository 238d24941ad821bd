//! Whether one contender's median is below those of others on every problem, failures counted as infinite.

use super::{Check, Entry};
use crate::analysis::evidence::{Evidence, Run};
use crate::analysis::metric::Metric;
use crate::analysis::stats::bootstrap::{self, Plan};
use crate::analysis::stats::summary::median;
use crate::analysis::verdict::{Estimate, Finding, Verdict};
use crate::seed;
use crate::study::Study;
use crate::study::record::{Row, Status};
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "lowest_median",
    about: "is a contender's median over seeds, failures infinite, below that of each other one on every problem?",
    build: |context| {
        let settings: Settings = context.settings.read()?;
        let contenders: Vec<&str> =
            settings.lower.iter().chain(&settings.higher).map(String::as_str).collect();
        let study = context.study(&settings.study, &settings.problems, &contenders)?;
        if settings.lower.is_empty() || settings.higher.is_empty() || settings.problems.is_empty() {
            return Err(context
                .settings
                .error("`lower`, `higher` and `problems` each need at least one name"));
        }
        if !(0.0..100.0).contains(&settings.by_percent) {
            let message = format!("by_percent is {}; 0 to below 100 is accepted", settings.by_percent);
            return Err(context.settings.error(message));
        }
        let metric = context.metric(&settings.metric, study)?;
        let seed = seed::derive(0, &[&context.paper.id, &context.claim.id]);
        Ok(Box::new(LowestMedian { settings, study, metric, seed }))
    },
};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Settings {
    study: String,
    problems: Vec<String>,
    metric: String,
    /// Contenders each of which is claimed to be below every one of `higher`.
    lower: Vec<String>,
    /// Those that they are compared with.
    higher: Vec<String>,
    /// By how much at least.
    #[serde(default)]
    by_percent: f64,
}

struct LowestMedian<'a> {
    settings: Settings,
    study: &'a Study,
    metric: &'static Metric,
    seed: u64,
}

/// One comparison: the reduction of the median in percent, its interval if both sides have one.
struct Compared {
    text: String,
    reduction: f64,
    ends: [f64; 2],
    n: usize,
}

impl LowestMedian<'_> {
    /// The metric of every trial that was run; infinite where it failed.
    fn values(&self, run: &Run<'_>, problem: &str, contender: &str) -> Vec<f64> {
        let value = |row: &&Row| match (row.status, run.value(row, self.metric)) {
            // The clock is read for some seeds only: one that was not timed has not failed.
            (_, None) if self.metric.is_clock() => None,
            (Status::Solved, Some(value)) => Some(value),
            (_, _) => Some(f64::INFINITY),
        };
        run.rows(problem, contender).iter().filter_map(value).collect()
    }

    fn compare(&self, run: &Run<'_>, problem: &str, lower: &str, higher: &str) -> Option<Compared> {
        let (low, high) = (self.values(run, problem, lower), self.values(run, problem, higher));
        let (a, b) = (median(&low)?, median(&high)?);
        let reduction = |a: f64, b: f64| if a == b { 0.0 } else { 100.0 * (1.0 - a / b) };
        let [from, to] = [self.interval(&low), self.interval(&high)];
        // The reduction's interval from the ends of both: wider than either level, and on the safe side.
        let ends = [reduction(from[1], to[0]), reduction(from[0], to[1])];
        Some(Compared {
            text: format!("{problem}: {lower} {a:.4} against {higher} {b:.4}, {:.1} % less", reduction(a, b)),
            reduction: reduction(a, b),
            ends,
            n: low.len().max(high.len()),
        })
    }

    /// Bootstrap interval of the median over seeds; the value itself where there is one seed.
    fn interval(&self, values: &[f64]) -> [f64; 2] {
        let plan = Plan { resamples: 1000, level: 0.95, seed: self.seed };
        let of = |picks: &[&f64]| median(&picks.iter().map(|value| **value).collect::<Vec<_>>());
        match bootstrap::percentile(values, of, plan) {
            Some(found) => [found.interval.low, found.interval.high],
            None => [values[0]; 2],
        }
    }
}

impl Check for LowestMedian<'_> {
    fn judge(&self, evidence: &Evidence<'_>) -> Finding {
        let mut finding = Finding { check: ENTRY.name.to_owned(), ..Finding::default() };
        let Settings { study, problems, lower, higher, by_percent, .. } = &self.settings;
        let Some(run) = evidence.run(study) else { return finding };
        let mut all = Vec::new();
        for problem in problems {
            for (low, high) in lower.iter().flat_map(|low| higher.iter().map(move |high| (low, high))) {
                all.extend(self.compare(run, problem, low, high));
            }
        }
        let expected = problems.len() * lower.len() * higher.len();
        let above = |value: f64| value > *by_percent;
        finding.verdict = Some(if all.len() < expected {
            Verdict::Undecided
        } else if all.iter().all(|one| above(one.ends[0])) {
            if self.study.searched { Verdict::Attainable } else { Verdict::Reproduced }
        } else if all.iter().any(|one| one.ends[1] <= 0.0) {
            Verdict::NotReproduced
        } else if all.iter().all(|one| one.ends[0] > 0.0) && all.iter().any(|one| one.ends[1] <= *by_percent)
        {
            Verdict::DirectionOnly
        } else {
            Verdict::Undecided
        });
        let least = all.iter().min_by(|a, b| a.reduction.total_cmp(&b.reduction));
        finding.ours = least.map(|one| Estimate {
            value: one.reduction,
            interval: one.ends.iter().all(|end| end.is_finite()).then_some(one.ends),
            what: format!("least reduction of the median {} in %", self.metric.label.to_lowercase()),
            n: one.n,
        });
        finding.because.push(format!(
            "{} of {expected} comparisons of medians show more than {by_percent} % less {}",
            all.iter().filter(|one| above(one.reduction)).count(),
            self.metric.label.to_lowercase()
        ));
        finding.because.extend(all.into_iter().map(|one| one.text));
        finding
    }
}
