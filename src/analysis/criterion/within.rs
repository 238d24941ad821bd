//! Whether the interval of a statistic lies within a margin about the printed number, or within accepted bounds.

use super::{Criterion, Entry, without};
use crate::analysis::context::Context;
use crate::analysis::criterion_result::{CriterionResult, refused_beyond};
use crate::analysis::evidence::Evidence;
use crate::analysis::metric::Metric;
use crate::analysis::number::{Ends, Number, ended, parts, whole};
use crate::analysis::outcome::Outcome;
use crate::analysis::selection::{self, Instance, Selection};
use crate::analysis::selection_spec::SelectionSpec;
use crate::analysis::statistic::{FEWEST_INSTANCES, OverallStatistic, how, narrows, needs};
use crate::analysis::verdict::{Estimate, Quantity};
use base::settings::{Accepted, SettingsError};
use base::text::computed;
use schemars::JsonSchema;
use serde::Deserialize;
use stats::interval::Interval;
use stats::paired::{self, snapped};

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "within",
    about: "does the interval of a mean, quantile, deviation, ratio, mean of ratios or reduction lie within a margin or within bounds?",
    revision: |_| 4,
    question: |settings| {
        without(settings, &["margin", "margin_percent", "printed_ratio", "accepted"]);
        Some(OVERALL)
    },
    settings: Accepted::shape::<Settings>(),
    example: r#"
statistic = "ratio"
accepted = [0.0, 0.5]
[select]
study = "compare"
problems = "maps"
contender = "Weighted A*"
against = "A*"
metric = "opened"
"#,
    build: |context| Ok(Box::new(Within::new(context)?)),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The trials that are looked at.
    select: SelectionSpec,
    /// What is taken of all instances.
    statistic: OverallStatistic,
    /// How far the statistic may be from the printed number, in its unit.
    #[schemars(range(min = 0.0, max = 1e9))]
    margin: Option<f64>,
    /// The same, in per cent of the printed number.
    #[schemars(range(min = 0.0, max = 1000.0))]
    margin_percent: Option<f64>,
    /// Two claims whose printed numbers' ratio the margin is about, in place of the claim's own number.
    printed_ratio: Option<[String; 2]>,
    /// The least and the greatest number of the statistic under which the claim holds; without `margin`.
    accepted: Option<[f64; 2]>,
}

struct Within<'a> {
    selection: Selection<'a>,
    metric: &'static Metric,
    statistic: OverallStatistic,
    accepted: Interval,
    /// The printed number, if it is what the margin is about.
    printed: Option<f64>,
}

/// What the numbers of a statistic over all instances are called.
pub(super) const OVERALL: &str = "overall 1";

/// A statistic over all instances, what it would be if cases without a number had any that they may have had and, of two contenders, how
/// many cases go which way.
pub(super) fn overall(
    selection: &Selection<'_>,
    statistic: OverallStatistic,
    evidence: &Evidence<'_>,
) -> Vec<Number> {
    let instances = selection.instances(evidence);
    let pairs = selection::pairs(&instances);
    let signs = paired::signs(&pairs.concat());
    let has_number = |instance: &&Instance<'_>| instance.cases.iter().any(|case| case.value.is_some());
    let measured =
        if statistic.is_paired() { pairs.len() } else { instances.iter().filter(has_number).count() };
    let counted = Number {
        measured,
        below: signs.lower,
        equal: signs.equal,
        above: signs.higher,
        ..Number::of_cases(&instances)
    };
    let mut numbers = vec![counted.estimated(statistic.estimate(&instances))];
    let others = [Ends::Least, Ends::Most].into_iter().zip(statistic.otherwise(selection, &instances));
    numbers.extend(others.map(|(ends, interval)| Number::ended(ends, interval)));
    let of_group = |group: &String| {
        let n = instances.iter().filter(|instance| instance.group == group).count();
        let drawn = selection.study.is_drawn(group).then_some(n);
        Number { part: group.clone(), n, drawn, ..Number::default() }
    };
    let is_parted = statistic == OverallStatistic::RatioOfGroups;
    numbers.extend(selection.groups.iter().filter(|_| is_parted).map(of_group));
    numbers
}

/// Means nearer to each other than by this share are equal: neither is the lower one.
const EQUAL: f64 = 1e-3;

/// The ratio of the numbers that two claims print.
fn ratio(context: &Context<'_>, above: &str, below: &str) -> Result<f64, SettingsError> {
    let value = |id| context.print_of("printed_ratio", id).map(|print| print.printed.value());
    let ratio = value(above)? / value(below)?;
    if ratio.is_finite() {
        return Ok(ratio);
    }
    let message = format!("claim `{below}` prints 0; a number to divide by is accepted");
    Err(context.settings.error_at("printed_ratio.1", message))
}

impl<'a> Within<'a> {
    fn new(context: &Context<'a>) -> Result<Self, SettingsError> {
        let settings: Settings = context.settings.read()?;
        let selection = Selection::new(context, &settings.select)?;
        let metric = selection.metric(context)?;
        selection.contender(context)?;
        if settings.statistic.is_paired() {
            selection.against(context)?;
        }
        if settings.statistic == OverallStatistic::RatioOfGroups && selection.groups.len() != 2 {
            let message =
                format!("`select` names {} problem groups; two are accepted", selection.groups.len());
            return Err(context.settings.error_at("select.problems", message));
        }
        let printed = || match &settings.printed_ratio {
            Some([above, below]) => ratio(context, above, below),
            None => Ok(context.print()?.printed.value()),
        };
        let about =
            |printed: f64, margin: f64| (Interval::new(printed - margin, printed + margin), Some(printed));
        let (accepted, printed) = match (settings.margin, settings.margin_percent, settings.accepted) {
            (Some(margin), None, None) => about(printed()?, margin),
            (None, Some(percent), None) => {
                let printed = printed()?;
                about(printed, percent / 100.0 * printed.abs())
            }
            (None, None, Some([low, high])) => {
                context.rising("accepted", [low, high], [f64::MIN, f64::MAX])?;
                (Interval::new(low, high), None)
            }
            _ => {
                return Err(context
                    .settings
                    .error("one of `margin`, `margin_percent` and `accepted` is accepted")
                    .about("margin")
                    .about("margin_percent")
                    .about("accepted"));
            }
        };
        Ok(Self { selection, metric, statistic: settings.statistic, accepted, printed })
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

    /// How many instances are needed, where there are too few; of two groups each needs as many, but for one in which nothing is drawn.
    fn needs(numbers: &[Number]) -> Option<usize> {
        let groups = parts(numbers, Ends::Measured);
        if groups.is_empty() {
            return needs(whole(numbers).n);
        }
        let is_enough = |group: &&Number| group.n == 1 && group.drawn.is_none();
        groups.into_iter().filter(|group| !is_enough(group)).find_map(|group| needs(group.n))
    }

    /// The printed values that an interval of ours would not refuse.
    fn printed_within(&self, found: Interval) -> Interval {
        let margin = (self.accepted.high - self.accepted.low) / 2.0;
        Interval::new(found.low - margin, found.high + margin)
    }

    /// How many cases without a number could turn what was found.
    fn censored(&self, numbers: &[Number], found: Interval, outcome: Outcome) -> usize {
        // What they may make of it reaches from the one to the other: two that both fail may do so on either side.
        let both = |one: Interval, two: Interval| Interval::new(one.low.min(two.low), one.high.max(two.high));
        let reach = ended(numbers).fold(found, both);
        let turned = ended(numbers).chain([reach]).any(|interval| self.outcome(interval) != outcome);
        let cases = whole(numbers);
        match turned {
            false => 0,
            true if self.statistic.is_paired() => cases.censored,
            true => cases.unended,
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
    fn numbers(&self, evidence: &Evidence<'_>) -> Vec<Number> {
        overall(&self.selection, self.statistic, evidence)
    }

    fn weigh(&self, numbers: &[Number]) -> CriterionResult {
        let all = whole(numbers);
        let Some((value, interval)) = all.found().filter(|(_, interval)| interval.low.is_finite()) else {
            return CriterionResult::too_few(all.measured, all.ran, FEWEST_INSTANCES).hanging_on(all.unended);
        };
        let outcome = self.outcome(interval);
        let metric = self.metric.label.to_lowercase();
        let what = format!("{} of {metric}", self.statistic.name());
        let ours = Estimate::new(value, interval, what, all.n);
        let ours = match self.statistic {
            OverallStatistic::ReductionPercent => ours.measures(Quantity::LessPercent, metric.as_str()),
            OverallStatistic::Ratio | OverallStatistic::MeanOfRatios => {
                ours.measures(Quantity::Ratio, metric.as_str())
            }
            _ => ours,
        };
        let Interval { low, high } = interval;
        let accepted = match self.printed {
            Some(printed) => {
                format!("printed {}, margin {}", computed(printed), computed(self.accepted.high - printed))
            }
            None => format!("accepted {} to {}", computed(self.accepted.low), computed(self.accepted.high)),
        };
        let agreed = if all.is_agreed { " that all agree" } else { "" };
        let spread =
            if low < high { format!("95 % interval {low:.4} to {high:.4}, ") } else { String::new() };
        let because = format!(
            "{}: {} of {metric} {value:.4} ({spread}{} instances{agreed}); {accepted}",
            self.selection.description(),
            self.statistic.name(),
            all.n,
        );
        CriterionResult {
            outcome: Some(outcome),
            ours: Some(ours.of_cases(all.cases())),
            about_interval: format!(", {} 95 % over instances", how(all.is_agreed)),
            because: vec![because],
            limits: vec![self.accepted.low, self.accepted.high],
            units: "instances",
            censored: self.censored(numbers, interval, outcome),
            refused: all.refused,
            needs: Self::needs(numbers),
            power: self.printed.map(|_| refused_beyond(self.printed_within(interval))),
            narrows: narrows(all.is_agreed),
            ..CriterionResult::default()
        }
    }

    /// The trial whose own number is nearest to the statistic.
    fn show(&self, evidence: &Evidence<'_>, numbers: &[Number], found: &mut CriterionResult) {
        let Some(value) = whole(numbers).value.filter(|_| found.ours.is_some()) else { return };
        let own = |case: &selection::Case<'_>| match self.statistic {
            OverallStatistic::Ratio | OverallStatistic::MeanOfRatios => {
                case.pair().filter(|(base, _)| *base > 0.0).map(|(base, own)| own / base)
            }
            OverallStatistic::ReductionPercent => case.saving_percent(),
            _ => case.value,
        };
        found.trial =
            selection::nearest(&self.selection, evidence, &self.selection.instances(evidence), own, value);
    }

    fn selections(&self) -> Vec<&Selection<'_>> {
        vec![&self.selection]
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
