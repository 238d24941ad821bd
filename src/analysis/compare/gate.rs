//! Gates: metrics that must not become worse by more than a margin, and the decision of their intervals.

use super::change::{Measured, SOLVED, Sample, joint_plan};
use crate::analysis::metric::{self, Better};
use crate::analysis::statistic::needs;
use base::settings::did_you_mean;
use serde::Serialize;
use stats::bootstrap::Estimate;
use stats::gate::{Decision, decide};
use stats::interval::Interval;

/// A metric and what it may change by for the worse.
#[derive(Debug, Clone, PartialEq)]
pub struct Gate {
    /// As it was written.
    pub text: String,
    metric: String,
    /// The margin, with its sign.
    by: f64,
    /// Whether the margin is in per cent of the first side's mean; otherwise it is in the metric's unit.
    is_percent: bool,
}

/// What a gate says of one contender of one study.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Passed {
    /// The gate, as it was written.
    pub gate: String,
    /// The study.
    pub study: String,
    /// The contender, or the two.
    pub contender: String,
    /// The change of the mean in the gate's unit, with the interval that decides.
    pub change: Option<Measured>,
    /// Level of that interval; higher than 95 % where several lines are looked at together.
    pub level: f64,
    /// What it says.
    pub outcome: Outcome,
    /// About how many more instances would decide it; `None` if it is decided, or if no number would.
    pub more_instances: Option<usize>,
    /// Why it is undetermined, if it is.
    pub why: Option<String>,
}

/// What a gate says.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// Worse by more than the margin.
    Worse,
    /// Not worse by more than it.
    NotWorse,
    /// Neither is known.
    CannotTell,
}

impl Gate {
    /// The gate written as `text`: `expansions +2%`, `path_cost_cells +0.5`, `solved -1%`.
    ///
    /// # Errors
    /// What is wrong with it, and what is accepted.
    pub fn parse(text: &str) -> Result<Self, String> {
        let shape =
            || format!("--gate: `{text}` is not `METRIC ±NUMBER` or `METRIC ±NUMBER%`, as `expansions +2%`");
        let (name, by) = text.trim().split_once(char::is_whitespace).ok_or_else(shape)?;
        let (by, is_percent) =
            by.trim().strip_suffix('%').map_or((by.trim(), false), |by| (by.trim_end(), true));
        let by: f64 = by.parse().ok().filter(|by: &f64| by.is_finite()).ok_or_else(shape)?;
        let better = match metric::find(name) {
            Some(metric) if metric.better != Better::Neither => metric.better,
            _ if name == SOLVED => Better::Higher,
            _ => return Err(unknown_metric("--gate", name)),
        };
        let worse = if better == Better::Higher { -1.0 } else { 1.0 };
        if by * worse < 0.0 {
            let (way, sign) = if worse > 0.0 { ("lower", '+') } else { ("higher", '-') };
            return Err(format!(
                "--gate: `{text}`: {way} is better, so a margin for the worse is {sign}{}{}",
                by.abs(),
                if is_percent { "%" } else { "" }
            ));
        }
        // A share is in per cent already: its changes are points.
        let is_percent = is_percent && name != SOLVED;
        Ok(Self { text: text.trim().to_owned(), metric: name.to_owned(), by, is_percent })
    }

    /// Whether `sample` is of its metric.
    fn looks_at(&self, sample: &Sample<'_>) -> bool {
        self.metric == sample.metric
    }
}

/// The message about a metric that cannot be compared.
pub fn unknown_metric(flag: &str, name: &str) -> String {
    let known: Vec<&str> = metric::METRICS
        .iter()
        .filter(|metric| metric.better != Better::Neither)
        .map(|metric| metric.name)
        .collect();
    let is_one = metric::find(name).is_some();
    let why = if is_one { " (neither way of it is better)" } else { "" };
    let hint = did_you_mean(name, known.iter().copied().chain([SOLVED]));
    format!(
        "{flag}: `{name}` is no metric that can be compared{why}{hint}; {SOLVED}, {} can",
        known.join(", ")
    )
}

/// What `gates` say of `samples`; all lines hold together with the level of every interval.
///
/// # Errors
/// A gate on a metric that no pair has.
pub fn pass(gates: &[Gate], samples: &[Sample<'_>], of_two_runs: bool) -> Result<Vec<Passed>, String> {
    let looked_at = |gate: &Gate| samples.iter().filter(|sample| gate.looks_at(sample)).count();
    if let Some(blind) = gates.iter().find(|gate| looked_at(gate) == 0) {
        return Err(format!("--gate: no pair of trials has a `{}`, solved by both or by one", blind.metric));
    }
    let lines = gates.iter().map(looked_at).sum();
    let of_gate = |gate| {
        let looked_at = samples.iter().filter(move |sample| Gate::looks_at(gate, sample));
        looked_at.map(move |sample| one(gate, sample, lines, of_two_runs))
    };
    Ok(gates.iter().flat_map(of_gate).collect())
}

fn one(gate: &Gate, sample: &Sample<'_>, lines: usize, of_two_runs: bool) -> Passed {
    let plan = joint_plan(lines);
    let found = sample.mean_changes(plan)[usize::from(gate.is_percent)];
    let (outcome, more_instances, why) = verdict(gate, sample, found.as_ref(), of_two_runs);
    Passed {
        gate: gate.text.clone(),
        study: sample.study.to_owned(),
        contender: sample.contender.to_owned(),
        change: Measured::new(found.map(|found| found.value), found),
        level: plan.level,
        outcome,
        more_instances,
        why,
    }
}

fn verdict(
    gate: &Gate,
    sample: &Sample<'_>,
    found: Option<&Estimate>,
    of_two_runs: bool,
) -> (Outcome, Option<usize>, Option<String>) {
    let cannot = |more, why: String| (Outcome::CannotTell, more, Some(why));
    if sample.is_time && of_two_runs {
        let why = "each run has one session of the clock, and no interval covers how much sessions differ";
        return cannot(None, why.to_owned());
    }
    if let Some(fewest) = needs(sample.instances()) {
        let why = format!("{} instances, of {fewest} that an interval needs", sample.instances());
        return cannot(Some(fewest - sample.instances()), why);
    }
    let Some(found) = found else { return cannot(None, "the first side's mean is not above 0".to_owned()) };
    let worse = sample.worse();
    let ends = [found.interval.low * worse, found.interval.high * worse];
    let interval = Interval::new(ends[0].min(ends[1]), ends[0].max(ends[1]));
    match decide(&Estimate { value: found.value * worse, interval, ..*found }, gate.by * worse) {
        Decision::Worse => (Outcome::Worse, None, None),
        Decision::NotWorse if sample.one_sided[0] > 0 => {
            let lost = sample.one_sided[0];
            cannot(None, format!("{lost} problems that the first side solved have no number on the second"))
        }
        Decision::NotWorse => (Outcome::NotWorse, None, None),
        Decision::CannotTell { more } => cannot(more, "the interval holds the margin".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gates_are_read_as_they_are_written_and_a_margin_for_the_better_is_refused() {
        let read = |text: &str| Gate::parse(text).map(|gate| (gate.metric, gate.by, gate.is_percent));
        assert_eq!(read("expansions +2%"), Ok(("expansions".to_owned(), 2.0, true)));
        assert_eq!(read(" path_cost_cells  +0.5 "), Ok(("path_cost_cells".to_owned(), 0.5, false)));
        assert_eq!(read("solved -1 %"), Ok(("solved".to_owned(), -1.0, false)), "points");
        assert_eq!(read("expansions 0%"), Ok(("expansions".to_owned(), 0.0, true)));
        for (text, complaint) in [
            ("expansions", "is not `METRIC ±NUMBER`"),
            ("expansions two", "is not `METRIC ±NUMBER`"),
            ("expansions +inf", "is not `METRIC ±NUMBER`"),
            ("expansions -2%", "lower is better, so a margin for the worse is +2%"),
            ("solved +1%", "higher is better, so a margin for the worse is -1%"),
            (
                "expansion +2%",
                "`expansion` is no metric that can be compared (did you mean `expansions`?); solved, ",
            ),
            ("components +2%", "(neither way of it is better)"),
        ] {
            let error = read(text).unwrap_err();
            assert!(error.contains(complaint), "{text}: {error}");
        }
    }
}
