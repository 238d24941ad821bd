//! Whether the interval of a statistic lies within a margin about the printed number, or within accepted bounds.

use super::{Criterion, Entry};
use crate::analysis::censored;
use crate::analysis::context::Context;
use crate::analysis::criterion_result::{CriterionResult, refused_beyond};
use crate::analysis::evidence::Evidence;
use crate::analysis::metric::Metric;
use crate::analysis::outcome::Outcome;
use crate::analysis::selection::{self, Instance, Selection, solved};
use crate::analysis::selection_spec::SelectionSpec;
use crate::analysis::statistic::{FEWEST_INSTANCES, OverallStatistic, how, narrows, needs, plan};
use crate::analysis::verdict::Estimate;
use base::settings::{Accepted, SettingsError};
use schemars::JsonSchema;
use serde::Deserialize;
use stats::bootstrap::{Estimate as Estimated, Resampling};
use stats::interval::Interval;
use stats::paired::{self, snapped};

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "within",
    about: "does the interval of a mean, median, deviation, ratio or reduction lie within a margin or within bounds?",
    revision: |_| 4,
    settings: Accepted::shape::<Settings>(),
    example: r#"
of = { study = "compare", problems = "maps", contender = "Weighted A*", against = "A*", metric = "opened" }
statistic = "ratio"
accepted = [0.0, 0.5]
"#,
    build: |context| Ok(Box::new(Within::new(context)?)),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The trials that are looked at.
    of: SelectionSpec,
    /// What is taken of all instances.
    statistic: OverallStatistic,
    /// How far the statistic may be from the printed number, in its unit.
    #[schemars(range(min = 0.0, max = 1e9))]
    margin: Option<f64>,
    /// Two claims whose printed numbers' ratio the margin is about, in place of the claim's own number.
    printed_ratio: Option<[String; 2]>,
    /// The least and the greatest number of the statistic under which the claim holds; without `margin`.
    accepted: Option<[f64; 2]>,
}

struct Within<'a> {
    of: Selection<'a>,
    metric: &'static Metric,
    statistic: OverallStatistic,
    accepted: Interval,
    /// The printed number, if it is what the margin is about.
    printed: Option<f64>,
    plan: Resampling,
}

/// Means nearer to each other than by this share are equal: neither is the lower one.
const EQUAL: f64 = 1e-3;

/// The ratio of the numbers that two claims print.
fn ratio(context: &Context<'_>, above: &str, below: &str) -> Result<f64, SettingsError> {
    let ratio = context.print_of(above)?.printed.value() / context.print_of(below)?.printed.value();
    if ratio.is_finite() {
        return Ok(ratio);
    }
    let message = format!("claim `{below}` prints 0; a number to divide by is accepted");
    Err(context.settings.error_at("printed_ratio.1", message))
}

impl<'a> Within<'a> {
    fn new(context: &Context<'a>) -> Result<Self, SettingsError> {
        let settings: Settings = context.settings.read()?;
        let of = Selection::new(context, &settings.of)?;
        let metric = of.metric(context)?;
        of.contender(context)?;
        if settings.statistic.is_paired() {
            of.against(context)?;
        }
        if settings.statistic == OverallStatistic::RatioOfGroups && of.groups.len() != 2 {
            let message = format!("`of` names {} problem groups; two are accepted", of.groups.len());
            return Err(context.settings.error_at("of.problems", message));
        }
        let (accepted, printed) = match (settings.margin, settings.accepted) {
            (Some(margin), None) => {
                let printed = match &settings.printed_ratio {
                    Some([above, below]) => ratio(context, above, below)?,
                    None => context.print()?.printed.value(),
                };
                (Interval::new(printed - margin, printed + margin), Some(printed))
            }
            (None, Some([low, high])) => {
                context.rising("accepted", [low, high], [f64::MIN, f64::MAX])?;
                (Interval::new(low, high), None)
            }
            _ => {
                return Err(context
                    .settings
                    .error("one of `margin` and `accepted` is accepted")
                    .about("margin")
                    .about("accepted"));
            }
        };
        let plan = plan(&context.seed_names());
        Ok(Self { of, metric, statistic: settings.statistic, accepted, printed, plan })
    }

    /// What an interval says of the claim.
    fn outcome(&self, found: Interval) -> Outcome {
        let accepted = self.accepted;
        let found = on_bounds(self.accepted, found);
        if accepted.contains(found.low) && accepted.contains(found.high) {
            return Outcome::Holds;
        }
        if accepted.meets(found) {
            return Outcome::Open;
        }
        let middle = self.printed.unwrap_or_else(|| accepted.low.midpoint(accepted.high));
        let is_same_side = self.statistic.no_difference().is_some_and(|none| {
            let equal = if none == 0.0 { 100.0 * paired::EQUAL } else { EQUAL };
            let is_outside = !accepted.contains(none) || self.printed.is_some();
            let side = |low: f64, high: f64| low > none + equal || high < none - equal;
            is_outside && side(found.low, found.high) && (found.low > none) == (middle > none)
        });
        if is_same_side { Outcome::SignOnly } else { Outcome::Fails }
    }

    /// Instances of which there are too few; of two groups each needs as many, but for one in which nothing is drawn.
    fn needs(&self, instances: &[Instance<'_>], units: usize) -> Option<usize> {
        if self.statistic != OverallStatistic::RatioOfGroups {
            return needs(units);
        }
        let of_group = |group: &String| instances.iter().filter(|instance| instance.group == group).count();
        let is_enough = |group: &String| of_group(group) == 1 && !self.of.study.is_drawn(group);
        self.of.groups.iter().filter(|group| !is_enough(group)).find_map(|group| needs(of_group(group)))
    }

    /// The printed values that an interval of ours would not refuse.
    fn printed_within(&self, found: Interval) -> Interval {
        let margin = (self.accepted.high - self.accepted.low) / 2.0;
        Interval::new(found.low - margin, found.high + margin)
    }

    fn estimated(&self, instances: &[Instance<'_>]) -> Option<Estimated> {
        self.statistic.estimate(instances, self.plan)
    }

    /// How many cases without a number could turn what was found.
    fn censored(&self, instances: &[Instance<'_>], found: Interval, outcome: Outcome) -> usize {
        let others = self.statistic.otherwise(&self.of, instances, self.plan);
        // What they may make of it reaches from the one to the other: two that both fail may do so on either side.
        let both = |one: Interval, two: Interval| Interval::new(one.low.min(two.low), one.high.max(two.high));
        let whole = others.iter().copied().fold(found, both);
        let turned = others.into_iter().chain([whole]).any(|interval| self.outcome(interval) != outcome);
        match turned {
            false => 0,
            true if self.statistic.is_paired() => selection::censored(instances),
            true => selection::unended(instances),
        }
    }
}

/// An interval whose ends are those of `accepted` where rounding alone parts them.
fn on_bounds(accepted: Interval, found: Interval) -> Interval {
    let on = |end: f64, bound: f64| snapped(end, bound, bound.abs().max(1.0));
    let [low, high] = [found.low, found.high].map(|end| on(on(end, accepted.low), accepted.high));
    Interval::new(low, high)
}

impl Criterion for Within<'_> {
    fn find(&self, evidence: &Evidence<'_>) -> CriterionResult {
        let instances = self.of.instances(evidence);
        let Some(found) = self.estimated(&instances).filter(|found| found.interval.low.is_finite()) else {
            let counted =
                instances.iter().filter(|instance| instance.cases.iter().any(|case| case.value.is_some()));
            return CriterionResult::too_few(counted.count(), instances.len(), FEWEST_INSTANCES)
                .hanging_on(selection::unended(&instances));
        };
        let outcome = self.outcome(found.interval);
        let metric = self.metric.label.to_lowercase();
        let what = format!("{} of {metric}, {} 95 % over instances", self.statistic.name(), how(&found));
        let Interval { low, high } = found.interval;
        let accepted = match self.printed {
            Some(printed) => format!("printed {printed}, margin {}", self.accepted.high - printed),
            None => format!("accepted {} to {}", self.accepted.low, self.accepted.high),
        };
        let agreed = if found.is_agreed { " that all agree" } else { "" };
        let because = format!(
            "{}: {} of {metric} {:.4} (95 % interval {low:.4} to {high:.4}, {} instances{agreed}); {accepted}",
            self.of.description(),
            self.statistic.name(),
            found.value,
            found.units,
        );
        let ours = Estimate::new(found.value, found.interval, what, found.units).of_cases(solved(&instances));
        CriterionResult {
            outcome: Some(outcome),
            ours: Some(ours),
            trial: self.shown(evidence, &instances, found.value),
            because: vec![because],
            limits: vec![self.accepted.low, self.accepted.high],
            units: "instances",
            censored: self.censored(&instances, found.interval, outcome),
            refused: censored::refused(&instances),
            needs: self.needs(&instances, found.units),
            power: self.printed.map(|_| refused_beyond(self.printed_within(found.interval))),
            narrows: narrows(found.is_agreed),
            ..CriterionResult::default()
        }
    }

    fn selections(&self) -> Vec<&Selection<'_>> {
        vec![&self.of]
    }
}

impl Within<'_> {
    /// The trial whose own number is nearest to the statistic.
    fn shown(&self, evidence: &Evidence<'_>, instances: &[Instance<'_>], value: f64) -> Option<String> {
        let own = |case: &selection::Case<'_>| match self.statistic {
            OverallStatistic::Ratio => {
                case.pair().filter(|(base, _)| *base > 0.0).map(|(base, own)| own / base)
            }
            OverallStatistic::ReductionPercent => case.saving_percent(),
            _ => case.value,
        };
        selection::nearest(&self.of, evidence, instances, own, value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_of_the_same_steps_in_another_order_lie_on_a_bound() {
        let (one, other) = (0.1 + 0.2 + 0.3, 0.3 + 0.2 + 0.1);
        assert!(one > other, "the sample shows no rounding");
        for accepted in [Interval::new(0.0, other), Interval::new(one, 1.0)] {
            let found = on_bounds(accepted, Interval::new(other, one));
            assert!(accepted.contains(found.low) && accepted.contains(found.high), "{accepted:?}: {found:?}");
        }
        let apart = Interval::new(other - 1e-6, one + 1e-6);
        assert_eq!(on_bounds(Interval::new(other, one), apart), apart);
    }
}
