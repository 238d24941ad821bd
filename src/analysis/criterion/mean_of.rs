//! Whether a printed mean could be that of so many instances like ours.

use super::{Criterion, Entry};
use crate::analysis::censored;
use crate::analysis::context::Context;
use crate::analysis::criterion_result::{CriterionResult, refused_beyond};
use crate::analysis::evidence::Evidence;
use crate::analysis::metric::Metric;
use crate::analysis::outcome::Outcome;
use crate::analysis::selection::{self, Case, Instance, Selection, by_instance, solved};
use crate::analysis::selection_spec::SelectionSpec;
use crate::analysis::statistic::{FEWEST_INSTANCES, LEVEL, mean, needs, plan};
use crate::analysis::verdict::Estimate;
use base::settings::{Accepted, SettingsError};
use schemars::JsonSchema;
use serde::Deserialize;
use stats::bootstrap::Resampling;
use stats::interval::Interval;
use stats::means::{interval_of_mean, predicted_mean};

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "mean_of",
    about: "could the printed number be the mean of so many instances like ours, with 95 % probability?",
    revision: |_| 1,
    settings: Accepted::shape::<Settings>(),
    example: r#"
of = { study = "compare", problems = "maps", contender = "A*", metric = "path_cost_cells" }
instances = 500
"#,
    build: |context| Ok(Box::new(MeanOf::new(context)?)),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The trials that are looked at; with `against`, by how much the contender's number exceeds the other's on the same problem.
    of: SelectionSpec,
    /// Of how many instances the printed number is the mean.
    #[schemars(range(min = 1))]
    instances: u32,
}

/// A printed mean with the trials that it is held against.
pub(super) struct MeanOf<'a> {
    /// The trials.
    pub(super) of: Selection<'a>,
    /// The metric.
    pub(super) metric: &'static Metric,
    /// Of how many instances it is the mean.
    pub(super) instances: usize,
    /// The printed number.
    pub(super) printed: f64,
    /// The numbers that print so.
    pub(super) rounded: Interval,
    plan: Resampling,
}

impl<'a> MeanOf<'a> {
    pub(super) fn new(context: &Context<'a>) -> Result<Self, SettingsError> {
        let settings: Settings = context.settings.read()?;
        let of = Selection::new(context, &settings.of)?;
        of.contender(context)?;
        let metric = of.metric(context)?;
        let print = context.print()?;
        let rounded = match &context.claim.difference {
            // Both of the numbers are rounded.
            Some([above, below]) => {
                let [above, below] =
                    [context.print_of(above)?.interval(), context.print_of(below)?.interval()];
                Interval::new(above.low - below.high, above.high - below.low)
            }
            None => print.interval(),
        };
        let printed = print.printed.value();
        let instances = settings.instances as usize;
        Ok(Self { of, metric, instances, printed, rounded, plan: plan(&context.seed_names()) })
    }

    /// The number of a case: the metric, or by how much it exceeds the other contender's.
    pub(super) fn number(&self, case: &Case<'_>) -> Option<f64> {
        match self.of.against {
            Some(_) => case.pair().map(|(base, own)| own - base),
            None => case.value,
        }
    }

    /// The mean number of each instance that has one.
    fn values(&self, instances: &[Instance<'_>]) -> Vec<f64> {
        let numbers = by_instance(instances, |case| self.number(case));
        numbers.iter().filter_map(|numbers| mean(numbers)).collect()
    }

    /// What our instances say of the printed number.
    fn outcome(&self, values: &[f64]) -> Option<Outcome> {
        let predicted = predicted_mean(values, self.instances, self.plan)?.interval;
        if predicted.meets(self.rounded) {
            return Some(Outcome::Holds);
        }
        let of_mean = interval_of_mean(values, LEVEL)?;
        // Both say that the contender has more, or both that it has less.
        let is_same_sign = (of_mean.low * self.printed).min(of_mean.high * self.printed) > 0.0;
        Some(if self.of.against.is_some() && is_same_sign { Outcome::SignOnly } else { Outcome::Fails })
    }

    /// How many cases without an end could turn what was found: those of each instance give the least, then more than all others.
    fn censored(&self, instances: &[Instance<'_>], found: Outcome) -> usize {
        let unended = selection::unended(instances);
        let values = self.values(instances);
        if unended == 0 {
            return 0;
        }
        let far = values.iter().fold(0.0, |most: f64, value| most.max(value.abs())) * values.len() as f64;
        let least = if self.of.against.is_some() { -far } else { 0.0 };
        let filled = |end: f64| {
            let number = |case: &Case<'_>| if case.is_unended() { Some(end) } else { self.number(case) };
            let numbers = by_instance(instances, number);
            self.outcome(&numbers.iter().filter_map(|numbers| mean(numbers)).collect::<Vec<_>>())
        };
        let is_turned = [least, far].into_iter().any(|end| filled(end) != Some(found));
        // Ends that both refuse may do so on either side.
        if is_turned || found != Outcome::Holds { unended } else { 0 }
    }
}

impl Criterion for MeanOf<'_> {
    fn find(&self, evidence: &Evidence<'_>) -> CriterionResult {
        let instances = self.of.instances(evidence);
        let values = self.values(&instances);
        let found = predicted_mean(&values, self.instances, self.plan).zip(self.outcome(&values));
        let Some((found, outcome)) = found else {
            return CriterionResult::too_few(values.len(), instances.len(), FEWEST_INSTANCES)
                .hanging_on(selection::unended(&instances));
        };
        let metric = self.metric.label.to_lowercase();
        let what = match &self.of.against {
            Some(_) => format!("mean difference of {metric}"),
            None => format!("mean of {metric}"),
        };
        let Interval { low, high } = found.interval;
        let because = format!(
            "{}: {what} {:.4} over {} instances; a mean of {} lies in [{low:.4}, {high:.4}] with 95 % probability; printed {}",
            self.of.description(),
            found.value,
            found.units,
            self.instances,
            self.printed
        );
        let half = self.rounded.half_width();
        let kept = Interval::new(low - half, high + half);
        let shown = format!("{what}; the interval is that of a mean of {} instances, 95 %", self.instances);
        CriterionResult {
            outcome: Some(outcome),
            ours: Some(
                Estimate::new(found.value, found.interval, shown, found.units).of_cases(solved(&instances)),
            ),
            trial: selection::nearest(&self.of, evidence, &instances, |case| self.number(case), found.value),
            because: vec![because],
            units: "instances",
            censored: self.censored(&instances, outcome),
            refused: censored::refused(&instances),
            needs: needs(found.units).filter(|_| !found.is_agreed),
            power: Some(refused_beyond(kept)),
            ..CriterionResult::default()
        }
    }

    fn selections(&self) -> Vec<&Selection<'_>> {
        vec![&self.of]
    }
}
