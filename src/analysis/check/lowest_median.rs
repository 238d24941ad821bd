//! Whether some contenders' medians are below those of others on every problem, failures counted as infinite.
//!
//! Each comparison is a ratio of two medians with an interval; the largest ratio decides. Where it is asked for, what
//! follows from one contender's steps including another's is stated and held against the runs, not estimated from them.

use super::{Check, Context, Entry};
use crate::analysis::evidence::{Evidence, Run};
use crate::analysis::inclusion::Inclusion;
use crate::analysis::metric::Metric;
use crate::analysis::verdict::{Estimate, Finding, Verdict};
use crate::study::Study;
use crate::study::record::{Row, Status};
use base::seed;
use base::settings::{Accepted, SettingsError};
use schemars::JsonSchema;
use serde::Deserialize;
use stats::bootstrap::{self, Resampling};
use stats::proportion::units_for_margin;
use stats::summary::median;
use std::collections::BTreeMap;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "lowest_median",
    about: "is a contender's median over seeds, failures infinite, below that of each other one on every problem?",
    settings: Accepted::of::<Settings>(),
    example: r#"
study = "methods"
problems = ["case 1", "case 2"]
metric = "plan_time_us"
lower = ["Chaos 5/8"]
higher = ["A* 8"]
by_percent = 50
"#,
    build: |context| Ok(Box::new(LowestMedian::new(context)?)),
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
    /// Contenders each of which is claimed to be below every one of `higher`.
    lower: Vec<String>,
    /// Those that they are compared with.
    higher: Vec<String>,
    /// By how much at least.
    #[serde(default)]
    by_percent: f64,
    /// The metric is the length of a path, so that steps that include others' never make it longer.
    #[serde(default)]
    by_inclusion: bool,
    /// A study of the same problems and contenders that explores readings.
    explored: Option<String>,
}

struct LowestMedian<'a> {
    settings: Settings,
    study: &'a Study,
    explored: Option<&'a Study>,
    metric: &'static Metric,
    inclusions: Vec<Inclusion>,
    seed: u64,
}

/// One contender on one problem.
struct Side {
    values: Vec<f64>,
    median: f64,
    interval: [f64; 2],
}

/// One comparison: the median over the other's, its interval from the ends of both.
struct Compared {
    name: String,
    medians: [f64; 2],
    ratio: f64,
    ends: [f64; 2],
    n: usize,
    inclusion: Inclusion,
    keeps: bool,
}

impl<'a> LowestMedian<'a> {
    fn new(context: &Context<'a>) -> Result<Self, SettingsError> {
        let settings: Settings = context.settings.read()?;
        let contenders: Vec<&str> =
            settings.lower.iter().chain(&settings.higher).map(String::as_str).collect();
        let study = context.study(&settings.study, &settings.problems, &contenders)?;
        let explored =
            settings.explored.as_ref().map(|name| context.study(name, &settings.problems, &contenders));
        let explored = explored.transpose()?;
        let (lower, higher, problems) = (&settings.lower, &settings.higher, &settings.problems);
        for (key, names) in [("lower", lower), ("higher", higher), ("problems", problems)] {
            if names.is_empty() {
                let message = format!("{key} is empty; at least one name is accepted");
                return Err(context.settings.error_at(key, message));
            }
        }
        if !(0.0..100.0).contains(&settings.by_percent) {
            let message = format!("by_percent is {}; 0 to below 100 is accepted", settings.by_percent);
            return Err(context.settings.error_at("by_percent", message));
        }
        let metric = context.metric(&settings.metric, study)?;
        let seed = seed::derive(0, &[&context.paper.id, &context.claim.id]);
        let mut inclusions = Vec::new();
        for (low, high) in pairs(&settings) {
            let said = settings.by_inclusion.then(|| Inclusion::of(study, context.point, low, high));
            inclusions.push(said.transpose()?.unwrap_or(Inclusion::Open));
        }
        Ok(Self { settings, study, explored, metric, inclusions, seed })
    }

    /// Below this a ratio is what the claim says.
    fn limit(&self) -> f64 {
        1.0 - self.settings.by_percent / 100.0
    }

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

    /// What was drawn independently: seeds, or the repeated readings of the clock where there is one seed.
    fn units(&self, run: &Run<'_>, problem: &str, contender: &str) -> Vec<f64> {
        let values = self.values(run, problem, contender);
        if !self.metric.is_clock() || values.len() > 1 {
            return values;
        }
        run.rows(problem, contender).iter().flat_map(|row| run.repeats(row, self.metric)).collect()
    }

    /// Every contender on `problem`, so that each bootstrap is made once.
    fn sides(&self, run: &Run<'_>, problem: &str) -> BTreeMap<&str, Side> {
        let all = self.settings.lower.iter().chain(&self.settings.higher);
        let side = |contender: &String| {
            let values = self.values(run, problem, contender);
            let median = median(&values)?;
            Some(Side { interval: self.interval(&self.units(run, problem, contender)), values, median })
        };
        all.filter_map(|contender| Some((contender.as_str(), side(contender)?))).collect()
    }

    /// Every comparison that both sides were measured for.
    fn compared(&self, run: &Run<'_>) -> Vec<Compared> {
        let mut all = Vec::new();
        for problem in &self.settings.problems {
            let sides = self.sides(run, problem);
            let count = 0..self.inclusions.len();
            all.extend(count.filter_map(|index| self.compare(&sides, problem, index)));
        }
        all
    }

    fn expected(&self) -> usize {
        self.settings.problems.len() * self.inclusions.len()
    }

    fn decided(&self, all: &[Compared]) -> Verdict {
        match verdict(all, self.limit()) {
            _ if all.len() < self.expected() => Verdict::Undecided,
            Verdict::Reproduced if self.study.searched => Verdict::Attainable,
            other => other,
        }
    }

    fn compare(&self, sides: &BTreeMap<&str, Side>, problem: &str, index: usize) -> Option<Compared> {
        let (lower, higher) = pairs(&self.settings).nth(index)?;
        let (one, other) = (sides.get(lower.as_str())?, sides.get(higher.as_str())?);
        let (low, high) = (&one.values, &other.values);
        let medians = [one.median, other.median];
        let [from, to] = [one.interval, other.interval];
        let inclusion = self.inclusions[index];
        Some(Compared {
            name: format!("{lower} against {higher}, {problem}"),
            medians,
            ratio: ratio(medians[0], medians[1]),
            // Wider than the interval of the ratio at either side's level, and so on the safe side.
            ends: [ratio(from[0], to[1]), ratio(from[1], to[0])],
            n: low.len().max(high.len()),
            inclusion,
            keeps: inclusion.is_kept(low, high),
        })
    }

    /// Bootstrap interval of the median over seeds; the value itself where there is one.
    fn interval(&self, values: &[f64]) -> [f64; 2] {
        let plan = Resampling { resamples: 500, level: 0.95, seed: self.seed };
        match bootstrap::median(values, plan) {
            Some(found) => [found.interval.low, found.interval.high],
            None => [values[0]; 2],
        }
    }

    fn because(&self, all: &[Compared]) -> Vec<String> {
        let label = self.metric.label.to_lowercase();
        let met = all.iter().filter(|one| one.ratio < self.limit()).count();
        let (percent, expected) = (self.settings.by_percent, self.expected());
        let mut because = vec![format!(
            "in {met} of {expected} comparisons the median {label} is less{}",
            if percent > 0.0 { format!(" by more than {percent} %") } else { String::new() }
        )];
        because.extend(theorem(all));
        because.extend(all.iter().map(|one| {
            format!(
                "{}: {:.4} against {:.4}, ratio {:.3}",
                one.name, one.medians[0], one.medians[1], one.ratio
            )
        }));
        because
    }
}

/// The verdict on comparisons whose ratios are all claimed to be below `limit`; undecided if one breaks a theorem.
fn verdict(all: &[Compared], limit: f64) -> Verdict {
    if all.iter().any(|one| !one.keeps) {
        return Verdict::Undecided;
    }
    if all.iter().all(|one| one.ends[1] < limit) {
        return Verdict::Reproduced;
    }
    if all.iter().all(|one| one.ends[0] < limit) {
        return Verdict::Undecided;
    }
    // Some ratio is certainly not below the margin; where every one is certainly below 1, the sign is right.
    let is_less = all.iter().all(|one| one.ends[1] < 1.0);
    if is_less { Verdict::DirectionOnly } else { Verdict::NotReproduced }
}

/// Every one that is claimed to be lower with every other.
fn pairs(settings: &Settings) -> impl Iterator<Item = (&String, &String)> {
    settings.lower.iter().flat_map(|low| settings.higher.iter().map(move |high| (low, high)))
}

fn ratio(a: f64, b: f64) -> f64 {
    // Two zeros and two failures are equal.
    if a == b { 1.0 } else { a / b }
}

/// What set inclusion says of the comparisons, where it says anything.
fn theorem(all: &[Compared]) -> Option<String> {
    let count = |kind| all.iter().filter(|one| one.inclusion == kind).count();
    let (longer, shorter) = (count(Inclusion::NeverLonger), count(Inclusion::NeverShorter));
    let equal = count(Inclusion::Equal);
    let broken = all.iter().filter(|one| !one.keeps).count();
    (longer + shorter + equal > 0).then(|| {
        let kept = match broken {
            0 => "the runs keep to both".to_owned(),
            broken => format!("{broken} of them do not keep to it, so that the program is wrong"),
        };
        format!(
            "by set inclusion, on any map, {longer} of {} cannot be longer (all steps of the other are its own) and {} cannot \
             be shorter; {kept}, and only the other {} are measured",
            all.len(),
            shorter + equal,
            all.len() - longer - shorter - equal
        )
    })
}

/// How many units it would take to tell a ratio from the limit that its interval straddles.
fn needed(one: &Compared, limit: f64) -> Option<String> {
    let [low, high] = one.ends;
    let straddles = low < limit && limit <= high && high.is_finite() && one.n > 1;
    let margin = (one.ratio - limit).abs();
    (straddles && margin > 0.0).then(|| {
        let units = units_for_margin((high - low) / 2.0, one.n, margin);
        format!(
            "{}: the interval straddles {limit:.2}; about {units} seeds, not {}, would decide it",
            one.name, one.n
        )
    })
}

impl Check for LowestMedian<'_> {
    fn judge(&self, evidence: &Evidence<'_>) -> Finding {
        let mut finding = Finding::of(ENTRY.name);
        let Some(run) = evidence.run(&self.settings.study) else { return finding };
        let all = self.compared(run);
        let verdict = self.decided(&all);
        finding.verdict = Some(verdict);
        finding.because = self.because(&all);
        if verdict == Verdict::Undecided {
            finding.because.extend(all.iter().filter_map(|one| needed(one, self.limit())));
        }
        finding.because.extend(super::explored_share(self, self.explored, evidence));
        let largest = all.iter().max_by(|a, b| a.ratio.total_cmp(&b.ratio));
        finding.ours = largest.map(|one| Estimate {
            value: 100.0 * one.ratio,
            interval: one.ends.iter().all(|end| end.is_finite()).then_some(one.ends.map(|end| 100.0 * end)),
            what: format!(
                "% of the other's median {}, the largest of {}: {}",
                self.metric.label.to_lowercase(),
                all.len(),
                one.name
            ),
            n: one.n,
        });
        finding
    }

    fn holds(&self, evidence: &Evidence<'_>) -> Option<(String, bool)> {
        let study = self.explored?;
        let run = evidence.run(&study.name)?;
        let mut all = true;
        for problem in &self.settings.problems {
            let medians = |contenders: &[String]| -> Option<Vec<f64>> {
                contenders.iter().map(|contender| median(&self.values(run, problem, contender))).collect()
            };
            let (low, high) = (medians(&self.settings.lower)?, medians(&self.settings.higher)?);
            all &= low.iter().all(|low| high.iter().all(|high| ratio(*low, *high) < self.limit()));
        }
        Some((study.name.clone(), all))
    }

    fn verdict(&self, evidence: &Evidence<'_>) -> Option<Verdict> {
        let run = evidence.run(&self.settings.study)?;
        Some(self.decided(&self.compared(run)))
    }
}

#[cfg(test)]
mod tests;
