//! Whether a contender's metric, or its saving over another contender, grows or falls with a column of the problem.

use super::{Check, Entry};
use crate::analysis::evidence::{Evidence, Run};
use crate::analysis::metric::Metric;
use crate::analysis::verdict::{Estimate, Finding, Verdict};
use crate::study::record::Status;
use crate::study::{Study, column};
use base::seed;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use stats::bootstrap::{self, Resampling};

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "trend",
    about: "does a contender's metric, or its saving over another, grow or fall with a column of the problem?",
    settings: Accepted::of::<Settings>(),
    example: r#"
study = "random"
problems = ["disjoint", "overlapping"]
metric = "nodes"
contender = "A*"
over = "obstacles"
rising = true
"#,
    build: |context| {
        let settings: Settings = context.settings.read()?;
        let contenders: Vec<&str> = [Some(&settings.contender), settings.against.as_ref()]
            .into_iter()
            .flatten()
            .map(String::as_str)
            .collect();
        let study = context.study(&settings.study, &settings.problems, &contenders)?;
        let metric = context.metric(&settings.metric, study)?;
        if column::find(&settings.over).is_none() {
            let message = format!("there is no column `{}` to look along", settings.over);
            return Err(context.settings.error_at("over", message));
        }
        let seed = seed::derive(0, &[&context.paper.id, &context.claim.id]);
        Ok(Box::new(Trend { settings, study, metric, seed }))
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
    /// Over whom it saves; without, the metric itself is looked at.
    against: Option<String>,
    /// The column along which the saving or the metric is claimed to change.
    over: String,
    /// Whether it is claimed to grow; to fall otherwise.
    rising: bool,
}

struct Trend<'a> {
    settings: Settings,
    study: &'a Study,
    metric: &'static Metric,
    seed: u64,
}

impl Trend<'_> {
    /// (column, saving in %) of every pair, or (column, metric) of every solved trial.
    fn points(&self, evidence: &Evidence<'_>) -> Vec<(f64, f64)> {
        let Some(run) = evidence.run(&self.settings.study) else { return Vec::new() };
        let groups = self.settings.problems.iter();
        match &self.settings.against {
            Some(against) => groups.flat_map(|group| self.savings(run, group, against)).collect(),
            None => groups.flat_map(|group| self.values(run, group)).collect(),
        }
    }

    fn savings(&self, run: &Run<'_>, group: &str, against: &str) -> Vec<(f64, f64)> {
        let pairs = run.pairs(group, against, &self.settings.contender);
        let points = pairs.iter().filter_map(|pair| {
            let base = run.value(pair.base, self.metric).filter(|base| *base > 0.0)?;
            let other = run.value(pair.other, self.metric)?;
            Some((pair.base.value(&self.settings.over)?, 100.0 * (1.0 - other / base)))
        });
        points.collect()
    }

    fn values(&self, run: &Run<'_>, group: &str) -> Vec<(f64, f64)> {
        let rows = run.rows(group, &self.settings.contender);
        let solved = rows.iter().filter(|row| row.status == Status::Solved);
        solved
            .filter_map(|row| Some((row.value(&self.settings.over)?, run.value(row, self.metric)?)))
            .collect()
    }

    /// What is looked at, and the unit of its slope.
    fn subject(&self) -> (String, &'static str) {
        let (own, metric) = (&self.settings.contender, self.metric.label.to_lowercase());
        match &self.settings.against {
            Some(against) => (format!("saving of {own} over {against} in {metric}"), "points"),
            None => (format!("{metric} of {own}"), self.metric.unit),
        }
    }
}

/// The slope of the least-squares line; `None` if all lie at one place.
fn slope(points: &[&(f64, f64)]) -> Option<f64> {
    let count = points.len() as f64;
    let (sum_x, sum_y) = points.iter().fold((0.0, 0.0), |sum, point| (sum.0 + point.0, sum.1 + point.1));
    let (mean_x, mean_y) = (sum_x / count, sum_y / count);
    let spread: f64 = points.iter().map(|(x, _)| (x - mean_x) * (x - mean_x)).sum();
    let joint: f64 = points.iter().map(|(x, y)| (x - mean_x) * (y - mean_y)).sum();
    (spread > 0.0).then(|| joint / spread)
}

impl Check for Trend<'_> {
    fn judge(&self, evidence: &Evidence<'_>) -> Finding {
        let points = self.points(evidence);
        let mut finding = Finding::of(ENTRY.name);
        let plan = Resampling { resamples: 2000, level: 0.95, seed: self.seed };
        let Some(found) = bootstrap::percentile(&points, slope, plan) else {
            return finding.undecided(format!("{} problems show no slope", points.len()));
        };
        let (subject, unit) = self.subject();
        let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
        let claimed = if self.settings.rising { 1.0 } else { -1.0 };
        let (low, high) = (claimed * found.interval.low, claimed * found.interval.high);
        finding.verdict = Some(if low.min(high) > 0.0 {
            if self.study.searched { Verdict::Attainable } else { Verdict::Reproduced }
        } else if low.max(high) < 0.0 {
            Verdict::NotReproduced
        } else {
            Verdict::Undecided
        });
        finding.because.push(format!(
            "{subject}, along {} on {} of {}: {:+.4}{unit} each (95 % interval {:+.4} to {:+.4}, {} problems)",
            self.settings.over,
            self.settings.problems.join(", "),
            self.settings.study,
            found.value,
            found.interval.low,
            found.interval.high,
            points.len()
        ));
        let what = format!("slope of {subject} along {}:{unit} each, bootstrap 95 %", self.settings.over);
        finding.ours = Some(Estimate::new(found.value, found.interval, what, points.len()));
        finding.say_what_settles(&[0.0], "pairs");
        finding
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_slope_of_points_on_a_line_is_the_lines() {
        let points: Vec<(f64, f64)> = (0..5).map(|x| (f64::from(x), 3.0 - 0.5 * f64::from(x))).collect();
        assert!((slope(&points.iter().collect::<Vec<_>>()).unwrap() + 0.5).abs() < 1e-15);
        assert_eq!(slope(&[&(1.0, 2.0), &(1.0, 3.0)]), None);
    }
}
