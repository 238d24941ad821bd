//! Whether one contender is lower (or higher) than another: sign and size over instances, or all along a sweep at once.

use super::{Criterion, Entry};
use crate::analysis::censored::{self, filled};
use crate::analysis::context::Context;
use crate::analysis::criterion_result::CriterionResult;
use crate::analysis::evidence::Evidence;
use crate::analysis::outcome::Outcome;
use crate::analysis::selection::{self, Case, Instance, Selection, is_unended, solved};
use crate::analysis::selection_spec::SelectionSpec;
use crate::analysis::statistic::{
    FEWEST_INSTANCES, LEVEL, OverallStatistic, how, narrows, needs, plan, turned,
};
use crate::analysis::verdict::Estimate;
use base::settings::{Accepted, SettingsError};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use stats::bands::{Band, sup_t_between};
use stats::bootstrap::{Estimate as Estimated, Resampling};
use stats::interval::Interval;
use stats::paired::{self, snapped};
use stats::proportion::clopper_pearson;
use study::key::SweepKey;
use study::name;
use study::record::Row;
use study::sweeps_of;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "lower",
    about: "is a contender lower than another on average over instances, or solves it more all along a sweep?",
    revision: |_| 3,
    settings: Accepted::shape::<Settings>(),
    example: r#"
of = { study = "compare", problems = "maps", metric = "opened", contender = "Weighted A*", against = "A*" }
"#,
    build: |context| Ok(Box::new(Lower::new(context)?)),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The trials that are looked at; without a metric the share of solved queries, along the study's sweep.
    of: SelectionSpec,
    /// Whether it is claimed to be lower or higher than `against`.
    #[serde(default)]
    is: Way,
    /// By how many per cent at least; along a sweep it is any difference that counts.
    #[serde(default)]
    #[schemars(range(min = 0.0, max = 100.0))]
    by_percent: f64,
}

#[derive(Serialize, Deserialize, JsonSchema, Clone, Copy, Default, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
enum Way {
    /// Its numbers are below the other's; it solves less.
    #[default]
    Lower,
    /// Its numbers are above the other's; it solves more.
    Higher,
}

struct Lower<'a> {
    of: Selection<'a>,
    way: Way,
    by_percent: f64,
    plan: Resampling,
}

impl<'a> Lower<'a> {
    fn new(context: &Context<'a>) -> Result<Self, SettingsError> {
        let settings: Settings = context.settings.read()?;
        let of = Selection::new(context, &settings.of)?;
        of.contender(context)?;
        of.against(context)?;
        if of.metric.is_none() && of.sweep_points().iter().all(SweepKey::is_empty) {
            let message = format!("`of` needs a `metric`: study `{}` sweeps nothing", of.study.name);
            return Err(context
                .settings
                .error_at("of", message)
                .about("metric")
                .about(&sweeps_of(&of.study.name)));
        }
        let plan = plan(&context.seed_names());
        Ok(Self { of, way: settings.is, by_percent: settings.by_percent, plan })
    }

    fn change(&self, pairs: &[Vec<(f64, f64)>]) -> Option<Estimated> {
        OverallStatistic::ReductionPercent.of_pairs(pairs, self.plan).map(turned)
    }

    /// What pairs by instance say: a strict comparison that ties on every case is contradicted.
    fn found(&self, change: &Estimated, pairs: &[Vec<(f64, f64)>]) -> Outcome {
        if self.by_percent == 0.0 && is_tied(pairs) {
            return Outcome::Fails;
        }
        outcome(self.way, self.by_percent, change.interval)
    }

    /// The change over instances in a sentence, with how many of all cases go which way.
    fn sentence(&self, metric: &str, change: &Estimated, pairs: &[Vec<(f64, f64)>]) -> String {
        let Estimated { value, interval, units, .. } = change;
        let signs = paired::signs(&pairs.concat());
        format!(
            "{}: {metric} changes by {value:.2} % on the whole (95 % interval {:.2} to {:.2}, {} over {units} instances); lower on {}, \
             equal on {}, higher on {} of {} cases{}",
            self.of.description(),
            interval.low,
            interval.high,
            how(change),
            signs.lower,
            signs.equal,
            signs.higher,
            signs.lower + signs.equal + signs.higher,
            if self.of.all_ends { "" } else { " that both solve" },
        )
    }

    /// Over instances.
    fn on_average(&self, evidence: &Evidence<'_>, metric: &str) -> CriterionResult {
        let instances = self.of.instances(evidence);
        let pairs = selection::pairs(&instances);
        let Some(change) = self.change(&pairs) else {
            return CriterionResult::too_few(pairs.len(), instances.len(), FEWEST_INSTANCES);
        };
        let Estimated { value, interval, units, .. } = change;
        let found = self.found(&change, &pairs);
        let is_other = |pairs: Vec<Vec<(f64, f64)>>| {
            self.change(&pairs).is_some_and(|filled| self.found(&filled, &pairs) != found)
        };
        let is_turned = filled(&self.of, &instances).into_iter().any(is_other);
        let what = format!("change of {metric} in %, {} 95 % over instances", how(&change));
        let of_case = |case: &Case<'_>| case.saving_percent().map(|saving| -saving);
        CriterionResult {
            outcome: Some(found),
            ours: Some(Estimate::new(value, interval, what, units).of_cases(solved(&instances))),
            trial: selection::nearest(&self.of, evidence, &instances, of_case, value),
            because: std::iter::once(self.sentence(metric, &change, &pairs)).chain(tied(&pairs)).collect(),
            limits: vec![0.0, if self.way == Way::Higher { self.by_percent } else { 0.0 - self.by_percent }],
            units: "instances",
            needs: needs(units),
            narrows: narrows(change.is_agreed),
            censored: if is_turned { selection::censored(&instances) } else { 0 },
            refused: censored::refused(&instances),
            ..CriterionResult::default()
        }
    }

    /// The curve of each instance: how many points more of its queries are solved than by the other, along the sweep. What did not
    /// end is not solved or, if so wanted, is solved on the one side alone.
    fn curves(&self, instances: &[Instance<'_>], unended: [bool; 2]) -> Vec<Vec<f64>> {
        let points = self.of.sweep_points();
        let is_solved = |row: &Row, unended: bool| row.is_solved() || unended && is_unended(row);
        let at = |instance: &Instance<'_>, point: &SweepKey| {
            let instance = instance.at(point);
            let base = instance.percent(|case| case.base.is_some_and(|base| is_solved(base, unended[0])))?;
            Some(instance.percent(|case| is_solved(case.row, unended[1]))? - base)
        };
        instances
            .iter()
            .filter_map(|instance| points.iter().map(|point| at(instance, point)).collect())
            .collect()
    }

    fn band(&self, instances: &[Instance<'_>], unended: [bool; 2]) -> Option<Band> {
        sup_t_between(&self.curves(instances, unended), [-100.0, 100.0], self.plan)
    }

    /// How many cases without an end could turn what was found along the sweep: as if the other alone solved them, then this one.
    fn unended_along(&self, instances: &[Instance<'_>], outcome: Outcome) -> usize {
        let unended = selection::unended(instances);
        let is_other = |one: [bool; 2]| {
            self.band(instances, one).is_some_and(|found| all_along(self.way, &found.band).0 != outcome)
        };
        let is_turned = unended > 0 && [[true, false], [false, true]].into_iter().any(is_other);
        if is_turned { unended } else { 0 }
    }

    /// Along the sweep.
    fn along_sweep(&self, evidence: &Evidence<'_>) -> CriterionResult {
        let instances = self.of.instances(evidence);
        let units = self.curves(&instances, [false; 2]).len();
        let Some(Band { mean, band, .. }) = self.band(&instances, [false; 2]) else {
            return CriterionResult::too_few(units, instances.len(), FEWEST_INSTANCES);
        };
        let points = self.of.sweep_points();
        let at = |index: usize| name::sweep(&points[index]);
        let sign = if self.way == Way::Higher { 1.0 } else { -1.0 };
        let signed = |index: usize| sign * mean[index];
        let least = (0..mean.len()).min_by(|a, b| signed(*a).total_cmp(&signed(*b))).unwrap_or(0);
        let (outcome, beyond) = all_along(self.way, &band);
        let because = format!(
            "{}: the mean share of solved queries differs by {:.1} points (band {:.1} to {:.1}) at {}, where it is least on the claim's \
             side; the simultaneous 95 % band over {} instances is on that side at {beyond} of {} points",
            self.of.description(),
            mean[least],
            band[least].low,
            band[least].high,
            at(least),
            units,
            band.len(),
        );
        let what = format!("least mean difference in points, at {}, simultaneous 95 % band", at(least));
        let against =
            |case: &Case<'_>| case.row.key.sweep.has(&points[least]).then(|| sign * solved_more(case));
        CriterionResult {
            outcome: Some(outcome),
            ours: Some(Estimate::new(mean[least], band[least], what, units).of_cases(solved(&instances))),
            trial: selection::least(&self.of, evidence, &instances, against),
            because: vec![because],
            limits: vec![0.0],
            units: "instances",
            censored: self.unended_along(&instances, outcome),
            needs: needs(units),
            ..CriterionResult::default()
        }
    }
}

/// Whether both numbers of every case are equal.
fn is_tied(pairs: &[Vec<(f64, f64)>]) -> bool {
    let signs = paired::signs(&pairs.concat());
    signs.equal > 0 && signs.lower + signs.higher == 0
}

/// What is said of cases that all tie: the most instances on which they might not.
fn tied(pairs: &[Vec<(f64, f64)>]) -> Option<String> {
    let bound = clopper_pearson(0, pairs.len(), LEVEL).filter(|_| is_tied(pairs))?;
    Some(format!("every case ties: at most {:.1} % of instances could differ (95 %)", 100.0 * bound.high))
}

/// By how many a case is solved more than by the other: 1, 0 or -1.
fn solved_more(case: &Case<'_>) -> f64 {
    let [own, other] = [case.row.is_solved(), case.base.is_some_and(Row::is_solved)];
    f64::from(i8::from(own) - i8::from(other))
}

/// What a simultaneous band says, and at how many points it lies on the claim's side.
fn all_along(way: Way, band: &[Interval]) -> (Outcome, usize) {
    let toward = |b: &Interval| if way == Way::Higher { (b.low, b.high) } else { (-b.high, -b.low) };
    let beyond = band.iter().filter(|b| toward(b).0 > 0.0).count();
    let outcome = if beyond == band.len() {
        Outcome::Holds
    } else if band.iter().any(|b| toward(b).1 < 0.0) {
        Outcome::Fails
    } else if beyond > 0 {
        Outcome::SignOnly
    } else {
        Outcome::Open
    };
    (outcome, beyond)
}

/// What the interval of a change in per cent says of a claim that it goes one way, by so much at least.
fn outcome(way: Way, by_percent: f64, change: Interval) -> Outcome {
    let Interval { low, high } = change;
    let [near, far] = if way == Way::Higher { [low, high] } else { [-high, -low] };
    // Sums of the same steps in another order differ in their last digits: that is no change, nor short of a margin.
    let [near, far] = [near, far].map(|end| snapped(snapped(end, by_percent, 100.0), 0.0, 100.0));
    if near > 0.0 && near >= by_percent {
        Outcome::Holds
    } else if far < 0.0 || (near == 0.0 && far == 0.0) {
        Outcome::Fails
    } else if far >= by_percent {
        Outcome::Open
    } else if near > 0.0 {
        Outcome::SignOnly
    } else {
        Outcome::Fails
    }
}

impl Criterion for Lower<'_> {
    fn find(&self, evidence: &Evidence<'_>) -> CriterionResult {
        match self.of.metric {
            Some(metric) => self.on_average(evidence, &metric.label.to_lowercase()),
            None => self.along_sweep(evidence),
        }
    }

    fn selections(&self) -> Vec<&Selection<'_>> {
        vec![&self.of]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_an_interval_of_changes_says() {
        for (by, low, high, expected) in [
            (0.0, -9.0, -1.0, Outcome::Holds),
            (0.0, -9.0, 1.0, Outcome::Open),
            (0.0, 1.0, 9.0, Outcome::Fails),
            (0.0, 0.0, 0.0, Outcome::Fails),
            (50.0, -70.0, -60.0, Outcome::Holds),
            (50.0, -60.0, -40.0, Outcome::Open),
            (50.0, -40.0, -10.0, Outcome::SignOnly),
            (50.0, -40.0, 10.0, Outcome::Fails),
            (50.0, 10.0, 20.0, Outcome::Fails),
        ] {
            assert_eq!(outcome(Way::Lower, by, Interval::new(low, high)), expected, "{by} {low} {high}");
            let mirrored = outcome(Way::Higher, by, Interval::new(-high, -low));
            assert_eq!(mirrored, expected, "higher by {by}: {} to {}", -high, -low);
        }
    }

    #[test]
    fn sums_of_the_same_steps_in_another_order_are_no_change_and_meet_a_margin() {
        let (one, other) = (0.1 + 0.2 + 0.3, 0.3 + 0.2 + 0.1);
        for (own, base) in [(one, other), (other, one)] {
            let change = 100.0 * (own / base - 1.0);
            assert!(change != 0.0, "the sample shows no rounding");
            let interval = Interval::new(change, change);
            assert_eq!(outcome(Way::Lower, 0.0, interval), Outcome::Fails, "{change}");
            assert_eq!(outcome(Way::Higher, 0.0, interval), Outcome::Fails, "{change}");
        }
        // A fifth less is a fifth less, though 1 - 0.8 is not 0.2.
        let fifth = 100.0 * (8.0 / 10.0 - 1.0);
        assert!(-fifth < 20.0, "the sample shows no rounding: {fifth}");
        assert_eq!(outcome(Way::Lower, 20.0, Interval::new(fifth, fifth)), Outcome::Holds);
    }

    #[test]
    fn instances_that_all_agree_do_not_prove_that_nothing_changes() {
        let of = |pair: (f64, f64), instances: usize| {
            let found = OverallStatistic::ReductionPercent
                .of_pairs(&vec![vec![pair]; instances], plan(&["agreed"]))
                .unwrap();
            assert!(found.is_agreed && found.interval.half_width() > 0.0, "{found:?}");
            outcome(Way::Lower, 10.0, turned(found).interval)
        };
        assert_eq!(of((5.0, 5.0), 20), Outcome::Open, "one instance in six may differ");
        assert_eq!(of((5.0, 5.0), 200), Outcome::Fails, "a tenth less is out of reach");
        assert_eq!(of((5.0, 1.0), 20), Outcome::Holds);
    }
}
