//! Whether a metric, or a saving, grows along a column.

use super::{Criterion, Entry, without};
use crate::analysis::context::Context;
use crate::analysis::criterion_result::CriterionResult;
use crate::analysis::evidence::Evidence;
use crate::analysis::metric::Metric;
use crate::analysis::number::{Ends, Number, ended, whole};
use crate::analysis::outcome::Outcome;
use crate::analysis::selection::{self, Case, Instance, Selection, by_instance, cases};
use crate::analysis::selection_spec::SelectionSpec;
use crate::analysis::statistic::{FEWEST_INSTANCES, PLAN, needs};
use crate::analysis::verdict::Estimate;
use base::settings::{Accepted, SettingsError};
use schemars::JsonSchema;
use serde::Deserialize;
use stats::interval::Interval;
use stats::{pooled, summary};
use study::column;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "trend",
    about: "does a metric, or what a contender saves, grow along a column? the slope over instances, with medians",
    revision: |_| 3,
    question: |settings| {
        without(settings, &["rising"]);
        Some("slope 1")
    },
    settings: Accepted::shape::<Settings>(),
    example: r#"
over = "path_cost_cells"
rising = true
[select]
study = "compare"
problems = "maps"
contender = "A*"
metric = "opened"
"#,
    build: |context| Ok(Box::new(Trend::new(context)?)),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The trials that are looked at; with `against`, what is saved against it in per cent.
    select: SelectionSpec,
    /// The column along which it is claimed to change.
    over: String,
    /// Whether it is claimed to grow; to fall otherwise.
    rising: bool,
}

struct Trend<'a> {
    selection: Selection<'a>,
    metric: &'static Metric,
    over: String,
    rising: bool,
}

impl<'a> Trend<'a> {
    fn new(context: &Context<'a>) -> Result<Self, SettingsError> {
        let settings: Settings = context.settings.read()?;
        let selection = Selection::new(context, &settings.select)?;
        selection.some_contender(context)?;
        let metric = selection.metric(context)?;
        if column::find(&settings.over).is_none() {
            let message = format!("there is no column `{}` to look along", settings.over);
            return Err(context.settings.error_at("over", message));
        }
        Ok(Self { selection, metric, over: settings.over, rising: settings.rising })
    }

    /// Two slopes, in which each case without an end lies far below or above all seen numbers: whichever goes against a rise, then
    /// whichever goes against a fall.
    fn slopes_ended(&self, instances: &[Instance<'_>]) -> Vec<Interval> {
        let seen: Vec<(f64, f64)> = cases(instances).filter_map(|case| self.point(case)).collect();
        let middle = summary::mean(&seen.iter().map(|(x, _)| *x).collect::<Vec<_>>());
        let Some(middle) = middle.filter(|_| selection::unended(instances) > 0) else { return Vec::new() };
        let least = seen.iter().fold(0.0, |least: f64, (_, y)| least.min(*y));
        let most = seen.iter().fold(0.0, |most: f64, (_, y)| most.max(y.abs())) * seen.len() as f64;
        // One whose place is not known either may stand anywhere.
        let is_lost = |case: &Case<'_>| case.might_be_solved() && case.row.value(&self.over).is_none();
        if cases(instances).any(is_lost) {
            return vec![Interval::new(f64::NEG_INFINITY, f64::INFINITY)];
        }
        let number = |case: &Case<'_>, rising: bool| {
            let place = case.row.value(&self.over).filter(|_| case.might_be_solved());
            self.point(case).or_else(|| place.map(|x| (x, if (x > middle) == rising { most } else { least })))
        };
        let slope = |rising: bool| pooled::slope(&by_instance(instances, |case| number(case, rising)), PLAN);
        [true, false].into_iter().filter_map(slope).map(|found| found.interval).collect()
    }

    /// The trial that does most for the slope that was found.
    fn shown(&self, evidence: &Evidence<'_>, instances: &[Instance<'_>], outcome: Outcome) -> Option<String> {
        let (places, numbers): (Vec<f64>, Vec<f64>) =
            cases(instances).filter_map(|case| self.point(case)).unzip();
        let place = summary::mean(&places)?;
        let number = summary::mean(&numbers)?;
        let sign = if self.rising == (outcome != Outcome::Fails) { -1.0 } else { 1.0 };
        let against = |case: &Case<'_>| self.point(case).map(|(x, y)| sign * (x - place) * (y - number));
        selection::least(&self.selection, evidence, instances, against)
    }

    fn point(&self, case: &Case<'_>) -> Option<(f64, f64)> {
        let number = if case.base.is_some() { case.saving_percent() } else { case.value };
        Some((case.row.value(&self.over)?, number?))
    }

    fn outcome(&self, slope: Interval) -> Outcome {
        let (against, along) = if self.rising { (slope.high, slope.low) } else { (-slope.low, -slope.high) };
        if along > 0.0 {
            Outcome::Holds
        } else if against < 0.0 {
            Outcome::Fails
        } else {
            Outcome::Open
        }
    }
}

impl Criterion for Trend<'_> {
    fn numbers(&self, evidence: &Evidence<'_>) -> Vec<Number> {
        let instances = self.selection.instances(evidence);
        let points = by_instance(&instances, |case| self.point(case));
        let values = summary::medians_by_thirds(&points.concat());
        let counted = Number { measured: points.len(), values, ..Number::of_cases(&instances) };
        let whole = counted.estimated(pooled::slope(&points, PLAN));
        let others = [Ends::Least, Ends::Most].into_iter().zip(self.slopes_ended(&instances));
        std::iter::once(whole).chain(others.map(|(ends, interval)| Number::ended(ends, interval))).collect()
    }

    fn weigh(&self, numbers: &[Number]) -> CriterionResult {
        let all = whole(numbers);
        let Some((value, interval)) = all.found() else {
            return CriterionResult::too_few(all.measured, all.ran, FEWEST_INSTANCES);
        };
        let outcome = self.outcome(interval);
        let metric = self.metric.label.to_lowercase();
        let (subject, unit) = match &self.selection.against {
            Some(_) => (format!("saving in {metric}"), "points"),
            None => (metric, self.metric.unit.as_str()),
        };
        let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
        let medians = all.values.iter().map(|median| format!("{median:.3}")).collect::<Vec<_>>().join(", ");
        let because = format!(
            "{}: {subject} along {} changes by {value:+.4}{unit} each (95 % interval {:+.4} to {:+.4}, {} instances); medians by thirds of {} {}",
            self.selection.description(),
            self.over,
            interval.low,
            interval.high,
            all.n,
            self.over,
            medians,
        );
        let what = format!("slope of {subject} along {}:{unit} each", self.over);
        let is_turned = ended(numbers).any(|slope| self.outcome(slope) != outcome);
        CriterionResult {
            outcome: Some(outcome),
            ours: Some(Estimate::new(value, interval, what, all.n).of_cases(all.cases())),
            about_interval: ", bootstrap 95 % over instances".to_owned(),
            because: vec![because],
            limits: vec![0.0],
            units: "instances",
            censored: if is_turned { all.unended } else { 0 },
            needs: needs(all.n),
            ..CriterionResult::default()
        }
    }

    fn show(&self, evidence: &Evidence<'_>, _: &[Number], found: &mut CriterionResult) {
        let outcome = found.outcome.filter(|_| found.ours.is_some());
        found.trial =
            outcome.and_then(|outcome| self.shown(evidence, &self.selection.instances(evidence), outcome));
    }

    fn selections(&self) -> Vec<&Selection<'_>> {
        vec![&self.selection]
    }
}
