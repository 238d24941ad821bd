//! Whether one contender is lower (or higher) than another: sign and size over instances, or all along a sweep at once.

use super::within::{OVERALL, overall};
use super::{Criterion, Entry, without};
use crate::analysis::context::Context;
use crate::analysis::criterion_result::CriterionResult;
use crate::analysis::evidence::Evidence;
use crate::analysis::number::{Ends, Number, ended, parts, whole};
use crate::analysis::outcome::Outcome;
use crate::analysis::selection::{self, Case, Instance, Selection, is_unended};
use crate::analysis::selection_spec::SelectionSpec;
use crate::analysis::statistic::{
    FEWEST_INSTANCES, OverallStatistic, PLAN, how, narrows, needs, tied, turned,
};
use crate::analysis::verdict::{Estimate, Quantity};
use base::settings::{Accepted, SettingsError};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use stats::bands::{Band, sup_t_between};
use stats::interval::Interval;
use stats::paired::snapped;
use study::key::SweepKey;
use study::name;
use study::record::Row;
use study::sweeps_of;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "lower",
    about: "is a contender lower than another on average over instances, or solves it more all along a sweep?",
    revision: |_| 3,
    question: |settings| {
        without(settings, &["is", "by_percent"]);
        if settings.get("select").and_then(|selection| selection.get("metric")).is_none() {
            return Some("difference solved along a sweep 1");
        }
        settings.insert("statistic".to_owned(), "reduction_percent".into());
        Some(OVERALL)
    },
    settings: Accepted::shape::<Settings>(),
    example: r#"
[select]
study = "compare"
problems = "maps"
metric = "opened"
contender = "Weighted A*"
against = "A*"
"#,
    build: |context| Ok(Box::new(Lower::new(context)?)),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The trials that are looked at; without a metric the share of solved queries, along the study's sweep.
    select: SelectionSpec,
    /// Whether it is claimed to be lower or higher than `against`.
    #[serde(default)]
    is: Way,
    /// The least difference in per cent. Along a sweep any difference counts.
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
    selection: Selection<'a>,
    way: Way,
    by_percent: f64,
}

impl<'a> Lower<'a> {
    fn new(context: &Context<'a>) -> Result<Self, SettingsError> {
        let settings: Settings = context.settings.read()?;
        let selection = Selection::new(context, &settings.select)?;
        selection.contender(context)?;
        selection.against(context)?;
        if selection.metric.is_none() && selection.sweep_points().iter().all(SweepKey::is_empty) {
            let message =
                format!("`select` needs a `metric`: study `{}` sweeps nothing", selection.study.name);
            return Err(context
                .settings
                .error_at("select", message)
                .about("metric")
                .about(&sweeps_of(&selection.study.name)));
        }
        Ok(Self { selection, way: settings.is, by_percent: settings.by_percent })
    }

    /// What the change of a contender says: a strict comparison that ties on every case is contradicted.
    fn found(&self, change: Interval, is_tied: bool) -> Outcome {
        if self.by_percent == 0.0 && is_tied {
            return Outcome::Fails;
        }
        outcome(self.way, self.by_percent, change)
    }

    /// The change over instances in a sentence, with how many of all cases go which way.
    fn sentence(
        &self,
        metric: &str,
        (value, Interval { low, high }): (f64, Interval),
        all: &Number,
    ) -> String {
        let &Number { below, equal, above, n, .. } = all;
        let change = if value == 0.0 {
            "unchanged".to_owned()
        } else {
            format!("{:.2} % {}", value.abs(), if value < 0.0 { "lower" } else { "higher" })
        };
        format!(
            "{}: {metric} {change} on the whole (95 % interval of the change {low:.2} to {high:.2}, {} over {n} instances); lower on \
             {below}, equal on {equal}, higher on {above} of {} cases{}",
            self.selection.description(),
            how(all.is_agreed),
            below + equal + above,
            self.selection.given_in_words(),
        )
    }

    /// Over instances.
    fn on_average(&self, numbers: &[Number], metric: &str) -> CriterionResult {
        let all = whole(numbers);
        let Some((value, interval)) = all.found().map(|(value, interval)| (0.0 - value, turned(interval)))
        else {
            return CriterionResult::too_few(all.measured, all.ran, FEWEST_INSTANCES);
        };
        let found = self.found(interval, all.is_tied());
        // What fills in for those that are missing ties with nothing.
        let is_turned = ended(numbers).any(|filled| self.found(turned(filled), false) != found);
        let what = format!("change of {metric} in %");
        let ours = Estimate::new(value, interval, what, all.n).measures(Quantity::MorePercent, metric);
        CriterionResult {
            outcome: Some(found),
            ours: Some(ours.of_cases(all.cases())),
            about_interval: format!(", {} 95 % over instances", how(all.is_agreed)),
            because: std::iter::once(self.sentence(metric, (value, interval), all))
                .chain(all.is_tied().then(|| tied(all.measured)).flatten())
                .collect(),
            limits: vec![0.0, if self.way == Way::Higher { self.by_percent } else { 0.0 - self.by_percent }],
            units: "instances",
            needs: needs(all.n),
            narrows: narrows(all.is_agreed),
            censored: if is_turned { all.censored } else { 0 },
            refused: all.refused,
            ..CriterionResult::default()
        }
    }

    /// The curve of each instance: how many points more of its queries are solved than by the other, along the sweep. Queries
    /// without an end count as unsolved, or as solved on the sides that `unended` names.
    fn curves(&self, instances: &[Instance<'_>], unended: [bool; 2]) -> Vec<Vec<f64>> {
        let points = self.selection.sweep_points();
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
        sup_t_between(&self.curves(instances, unended), [-100.0, 100.0], PLAN)
    }

    /// By how much more is solved at each point of the sweep, a part each. First as measured, then as if one contender had solved
    /// all that did not end: the other, then this one.
    fn numbers_along(&self, evidence: &Evidence<'_>) -> Vec<Number> {
        let instances = self.selection.instances(evidence);
        let n = self.curves(&instances, [false; 2]).len();
        let mut numbers = vec![Number { n, ..Number::of_cases(&instances) }];
        let unended = numbers[0].unended > 0;
        for (ends, solved) in Ends::ALL.into_iter().zip([[false; 2], [true, false], [false, true]]) {
            let band = self.band(&instances, solved).filter(|_| ends == Ends::Measured || unended);
            let Some(Band { mean, band, .. }) = band else { continue };
            let points = self.selection.sweep_points().into_iter().zip(mean.into_iter().zip(band));
            numbers.extend(points.map(|(point, (mean, interval))| {
                let part = name::sweep(&point);
                Number { part, ends, value: Some(mean), interval: Some(interval), n, ..Number::default() }
            }));
        }
        numbers
    }

    /// Where along the sweep the difference is least on the claim's side.
    fn least(&self, points: &[&Number]) -> usize {
        let sign = if self.way == Way::Higher { 1.0 } else { -1.0 };
        let signed = |index: usize| sign * points[index].value.unwrap_or_default();
        (0..points.len()).min_by(|a, b| signed(*a).total_cmp(&signed(*b))).unwrap_or(0)
    }

    /// The outcome along the sweep if cases without an end ended so, and how many points lie on the claim's side.
    fn all_along(&self, numbers: &[Number], ends: Ends) -> Option<(Outcome, usize)> {
        let band: Vec<Interval> =
            parts(numbers, ends).into_iter().filter_map(|point| point.interval).collect();
        (!band.is_empty()).then(|| all_along(self.way, &band))
    }

    fn along_sweep(&self, numbers: &[Number]) -> CriterionResult {
        let all = whole(numbers);
        let points = parts(numbers, Ends::Measured);
        let Some((outcome, beyond)) = self.all_along(numbers, Ends::Measured) else {
            return CriterionResult::too_few(all.n, all.ran, FEWEST_INSTANCES);
        };
        let least = points[self.least(&points)];
        let (mean, band) = least.found().expect("every point has a band");
        let because = format!(
            "{}: the mean share of solved queries differs by {mean:.1} points (band {:.1} to {:.1}) at {}, where it is least on the claim's \
             side; the simultaneous 95 % band over {} instances is on that side at {beyond} of {} points",
            self.selection.description(),
            band.low,
            band.high,
            least.part,
            all.n,
            points.len(),
        );
        let what = format!("least mean difference in points, at {}", least.part);
        let ours = Estimate::new(mean, band, what, all.n).measures(Quantity::MorePoints, "solved queries");
        let is_turned = [Ends::Least, Ends::Most]
            .into_iter()
            .filter_map(|ends| self.all_along(numbers, ends))
            .any(|(other, _)| other != outcome);
        CriterionResult {
            outcome: Some(outcome),
            ours: Some(ours.of_cases(all.cases())),
            about_interval: ", simultaneous 95 % band".to_owned(),
            because: vec![because],
            limits: vec![0.0],
            units: "instances",
            censored: if is_turned { all.unended } else { 0 },
            needs: needs(all.n),
            ..CriterionResult::default()
        }
    }

    /// The trial that speaks least for the claim where along the sweep it is least.
    fn shown_along(&self, evidence: &Evidence<'_>, numbers: &[Number]) -> Option<String> {
        let points = parts(numbers, Ends::Measured);
        let point = self
            .selection
            .sweep_points()
            .into_iter()
            .nth(self.least(&points))
            .filter(|_| !points.is_empty())?;
        let sign = if self.way == Way::Higher { 1.0 } else { -1.0 };
        let against = |case: &Case<'_>| case.row.key.sweep.has(&point).then(|| sign * solved_more(case));
        selection::least(&self.selection, evidence, &self.selection.instances(evidence), against)
    }
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
    fn numbers(&self, evidence: &Evidence<'_>) -> Vec<Number> {
        match self.selection.metric {
            Some(_) => overall(&self.selection, OverallStatistic::ReductionPercent, evidence),
            None => self.numbers_along(evidence),
        }
    }

    fn weigh(&self, numbers: &[Number]) -> CriterionResult {
        match self.selection.metric {
            Some(metric) => self.on_average(numbers, &metric.label.to_lowercase()),
            None => self.along_sweep(numbers),
        }
    }

    fn show(&self, evidence: &Evidence<'_>, numbers: &[Number], found: &mut CriterionResult) {
        found.trial = if self.selection.metric.is_none() {
            self.shown_along(evidence, numbers)
        } else {
            let nearest = |change: f64| {
                let of_case = |case: &Case<'_>| case.saving_percent().map(|saving| -saving);
                selection::nearest(
                    &self.selection,
                    evidence,
                    &self.selection.instances(evidence),
                    of_case,
                    change,
                )
            };
            whole(numbers).value.and_then(|reduction| nearest(0.0 - reduction))
        };
    }

    fn selections(&self) -> Vec<&Selection<'_>> {
        vec![&self.selection]
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
        let outcome = |pair: (f64, f64), instances: usize| {
            let found = OverallStatistic::ReductionPercent.of_pairs(&vec![vec![pair]; instances]).unwrap();
            assert!(found.is_agreed && found.interval.half_width() > 0.0, "{found:?}");
            outcome(Way::Lower, 10.0, turned(found.interval))
        };
        assert_eq!(outcome((5.0, 5.0), 20), Outcome::Open, "one instance in six may differ");
        assert_eq!(outcome((5.0, 5.0), 200), Outcome::Fails, "a tenth less is out of reach");
        assert_eq!(outcome((5.0, 1.0), 20), Outcome::Holds);
    }
}
