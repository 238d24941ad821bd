//! Whether a printed mean could be that of so many instances like ours.

use super::{Criterion, Entry, without};
use crate::analysis::context::Context;
use crate::analysis::criterion_result::{CriterionResult, refused_beyond};
use crate::analysis::evidence::Evidence;
use crate::analysis::metric::Metric;
use crate::analysis::number::{Ends, Number, whole};
use crate::analysis::outcome::Outcome;
use crate::analysis::selection::{self, Case, Instance, Selection, by_instance};
use crate::analysis::selection_spec::SelectionSpec;
use crate::analysis::statistic::{FEWEST_INSTANCES, LEVEL, PLAN, mean, needs, standard_deviation};
use crate::analysis::verdict::Estimate;
use base::settings::{Accepted, SettingsError};
use schemars::JsonSchema;
use serde::Deserialize;
use stats::interval::Interval;
use stats::means::{FEWEST_NORMAL, interval_of_mean, predicted_mean, predicted_normal};
use study::paper::Claim;
use toml::Value;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "mean_of",
    about: "could the printed number be the mean of so many instances like ours, with 95 % probability?",
    revision: |_| 1,
    question: |settings| {
        // A mean of few is resampled, and takes the instances one by one.
        let few =
            settings.get("instances").and_then(Value::as_integer).is_some_and(|n| n < FEWEST_NORMAL as i64);
        without(settings, &["instances"]);
        Some(if few { "means of few 1" } else { "means 1" })
    },
    settings: Accepted::shape::<Settings>(),
    example: r#"
instances = 500
[select]
study = "compare"
problems = "maps"
contender = "A*"
metric = "path_cost_cells"
"#,
    build: |context| Ok(Box::new(MeanOf::new(context)?)),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The trials that are looked at; with `against`, by how much the contender's number exceeds the other's on the same problem.
    select: SelectionSpec,
    /// How many instances the printed mean is over.
    #[schemars(range(min = 1))]
    instances: u32,
}

/// The contenders whose mean `claim` holds against a printed one, and the one that they are compared with.
pub(super) fn contenders(claim: &Claim) -> Vec<String> {
    let settings = claim.check(ENTRY.name).and_then(|settings| settings.read::<Settings>().ok());
    let compared = |settings: Settings| {
        settings.select.contender.listed().into_iter().chain(settings.select.against).collect()
    };
    settings.map_or_else(Vec::new, compared)
}

/// A printed mean with the trials that it is held against.
pub(super) struct MeanOf<'a> {
    /// The trials.
    pub(super) selection: Selection<'a>,
    /// The metric.
    pub(super) metric: &'static Metric,
    /// How many instances the printed mean is over.
    pub(super) instances: usize,
    /// The printed number.
    pub(super) printed: f64,
    /// The numbers that round to the printed one.
    pub(super) rounded: Interval,
}

impl<'a> MeanOf<'a> {
    pub(super) fn new(context: &Context<'a>) -> Result<Self, SettingsError> {
        let settings: Settings = context.settings.read()?;
        let selection = Selection::new(context, &settings.select)?;
        selection.contender(context)?;
        let metric = selection.metric(context)?;
        let print = context.print()?;
        let rounded = match &context.claim.difference {
            // Both of the numbers are rounded.
            Some([above, below]) => {
                let interval = |id| context.print_of("difference", id).map(proofs::exact::Print::interval);
                let [above, below] = [interval(above)?, interval(below)?];
                Interval::new(above.low - below.high, above.high - below.low)
            }
            None => print.interval(),
        };
        let printed = print.printed.value();
        let instances = settings.instances as usize;
        Ok(Self { selection, metric, instances, printed, rounded })
    }

    /// The number of a case: the metric, or by how much it exceeds the other contender's.
    pub(super) fn number(&self, case: &Case<'_>) -> Option<f64> {
        match self.selection.against {
            Some(_) => case.pair().map(|(base, own)| own - base),
            None => case.value,
        }
    }

    /// The mean number of each instance that has one, as `number` takes it of a case, as all of them together.
    fn means(
        &self,
        instances: &[Instance<'_>],
        ends: Ends,
        number: impl Fn(&Case<'_>) -> Option<f64>,
    ) -> Number {
        let numbers = by_instance(instances, number);
        let values: Vec<f64> = numbers.iter().filter_map(|numbers| mean(numbers)).collect();
        let first = values.first().copied();
        let is_agreed = values.iter().all(|value| Some(*value) == first);
        let n = values.len();
        let value = if is_agreed { first } else { mean(&values) };
        let deviation = standard_deviation(&values);
        let greatest = values.iter().copied().reduce(farther);
        let is_few = n.min(self.instances) < FEWEST_NORMAL;
        let values = if is_few { values } else { Vec::new() };
        Number { ends, value, is_agreed, n, greatest, deviation, values, ..Number::default() }
    }

    /// Where a mean of as many instances as are printed lies.
    fn predicted(&self, means: &Number) -> Option<Interval> {
        let (value, deviation) = means.value.zip(means.deviation)?;
        if means.is_agreed {
            return Some(Interval::new(value, value));
        }
        if means.n.min(self.instances) < FEWEST_NORMAL {
            return predicted_mean(&means.values, self.instances, PLAN).map(|found| found.interval);
        }
        Some(predicted_normal([value, deviation], means.n, self.instances, LEVEL))
    }

    /// What our instances say of the printed number.
    fn outcome(&self, means: &Number) -> Option<Outcome> {
        if self.predicted(means)?.meets(self.rounded) {
            return Some(Outcome::Holds);
        }
        let of_mean = interval_of_mean([means.value?, means.deviation?], means.n, LEVEL);
        // Both say that the contender has more, or both that it has less.
        let is_same_sign = (of_mean.low * self.printed).min(of_mean.high * self.printed) > 0.0;
        Some(if self.selection.against.is_some() && is_same_sign {
            Outcome::SignOnly
        } else {
            Outcome::Fails
        })
    }

    /// How many cases without an end could turn what was found.
    fn censored(&self, numbers: &[Number], found: Outcome) -> usize {
        let is_turned = numbers[1..].iter().any(|ended| self.outcome(ended) != Some(found));
        // Ends that both refuse may do so on either side.
        if is_turned || found != Outcome::Holds { numbers[0].unended } else { 0 }
    }
}

/// The number that is farther from 0, without its sign.
fn farther(one: f64, other: f64) -> f64 {
    one.abs().max(other.abs())
}

impl Criterion for MeanOf<'_> {
    /// The mean of the instances, and what it would be if the cases without an end gave the least, then more than all others.
    fn numbers(&self, evidence: &Evidence<'_>) -> Vec<Number> {
        let instances = self.selection.instances(evidence);
        let cases = Number::of_cases(&instances);
        let Number { value, is_agreed, n, greatest, deviation, values, .. } =
            self.means(&instances, Ends::Measured, |case| self.number(case));
        let far = greatest.map_or(0.0, f64::abs) * n as f64;
        let least = if self.selection.against.is_some() { -far } else { 0.0 };
        let ends = [(Ends::Least, least), (Ends::Most, far)].into_iter().filter(|_| cases.unended > 0);
        let ended = ends.map(|(ends, end)| {
            let number = |case: &Case<'_>| if case.is_unended() { Some(end) } else { self.number(case) };
            self.means(&instances, ends, number)
        });
        let all = Number { value, is_agreed, n, greatest, deviation, values, ..cases };
        std::iter::once(all).chain(ended).collect()
    }

    fn weigh(&self, numbers: &[Number]) -> CriterionResult {
        let all = whole(numbers);
        let Some((interval, outcome)) = self.predicted(all).zip(self.outcome(all)) else {
            return CriterionResult::too_few(all.n, all.ran, FEWEST_INSTANCES).hanging_on(all.unended);
        };
        let value = all.value.unwrap_or_default();
        let metric = self.metric.label.to_lowercase();
        let what = match &self.selection.against {
            Some(_) => format!("mean difference of {metric}"),
            None => format!("mean of {metric}"),
        };
        let Interval { low, high } = interval;
        let because = format!(
            "{}: {what} {value:.4} over {} instances; a mean of {} lies in [{low:.4}, {high:.4}] with 95 % probability; printed {}",
            self.selection.description(),
            all.n,
            self.instances,
            self.printed
        );
        let half = self.rounded.half_width();
        let kept = Interval::new(low - half, high + half);
        CriterionResult {
            outcome: Some(outcome),
            ours: Some(Estimate::new(value, interval, what, all.n).of_cases(all.cases())),
            about_interval: format!("; the interval is that of a mean of {} instances, 95 %", self.instances),
            because: vec![because],
            units: "instances",
            censored: if all.unended > 0 { self.censored(numbers, outcome) } else { 0 },
            refused: all.refused,
            needs: needs(all.n).filter(|_| !all.is_agreed),
            power: Some(refused_beyond(kept)),
            ..CriterionResult::default()
        }
    }

    fn show(&self, evidence: &Evidence<'_>, numbers: &[Number], found: &mut CriterionResult) {
        let Some(value) = whole(numbers).value.filter(|_| found.ours.is_some()) else { return };
        let instances = self.selection.instances(evidence);
        found.trial =
            selection::nearest(&self.selection, evidence, &instances, |case| self.number(case), value);
    }

    fn selections(&self) -> Vec<&Selection<'_>> {
        vec![&self.selection]
    }
}
