//! Whether a metric, or a saving, grows along a column.

use super::{Criterion, Entry};
use crate::analysis::context::Context;
use crate::analysis::criterion_result::CriterionResult;
use crate::analysis::evidence::Evidence;
use crate::analysis::metric::Metric;
use crate::analysis::outcome::Outcome;
use crate::analysis::selection::{self, Case, Instance, Selection, by_instance, cases, solved};
use crate::analysis::selection_spec::SelectionSpec;
use crate::analysis::statistic::{FEWEST_INSTANCES, needs, plan};
use crate::analysis::verdict::Estimate;
use base::settings::{Accepted, SettingsError};
use schemars::JsonSchema;
use serde::Deserialize;
use stats::bootstrap::Resampling;
use stats::interval::Interval;
use stats::{pooled, summary};
use study::column;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "trend",
    about: "does a metric, or what a contender saves, grow along a column? the slope over instances, with medians",
    revision: |_| 3,
    settings: Accepted::shape::<Settings>(),
    example: r#"
of = { study = "compare", problems = "maps", contender = "A*", metric = "opened" }
over = "path_cost_cells"
rising = true
"#,
    build: |context| Ok(Box::new(Trend::new(context)?)),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The trials that are looked at; with `against`, what is saved against it in per cent.
    of: SelectionSpec,
    /// The column along which it is claimed to change.
    over: String,
    /// Whether it is claimed to grow; to fall otherwise.
    rising: bool,
}

struct Trend<'a> {
    of: Selection<'a>,
    metric: &'static Metric,
    over: String,
    rising: bool,
    plan: Resampling,
}

impl<'a> Trend<'a> {
    fn new(context: &Context<'a>) -> Result<Self, SettingsError> {
        let settings: Settings = context.settings.read()?;
        let of = Selection::new(context, &settings.of)?;
        of.some_contender(context)?;
        let metric = of.metric(context)?;
        if column::find(&settings.over).is_none() {
            let message = format!("there is no column `{}` to look along", settings.over);
            return Err(context.settings.error_at("over", message));
        }
        let plan = plan(&context.seed_names());
        Ok(Self { of, metric, over: settings.over, rising: settings.rising, plan })
    }

    /// How many cases without an end could turn what was found: each is given a number below or above all that were seen
    /// together, whichever goes against a slope that rises, then against one that falls.
    fn censored(&self, instances: &[Instance<'_>], outcome: Outcome) -> usize {
        let seen: Vec<(f64, f64)> = cases(instances).filter_map(|case| self.point(case)).collect();
        let middle = summary::mean(&seen.iter().map(|(x, _)| *x).collect::<Vec<_>>());
        let Some(middle) = middle else { return 0 };
        let least = seen.iter().fold(0.0, |least: f64, (_, y)| least.min(*y));
        let most = seen.iter().fold(0.0, |most: f64, (_, y)| most.max(y.abs())) * seen.len() as f64;
        // One whose place is not known either may stand anywhere.
        let is_lost = |case: &Case<'_>| case.is_unended() && case.row.value(&self.over).is_none();
        if cases(instances).any(is_lost) {
            return selection::unended(instances);
        }
        let number = |case: &Case<'_>, rising: bool| {
            let place = case.row.value(&self.over).filter(|_| case.is_unended());
            self.point(case).or_else(|| place.map(|x| (x, if (x > middle) == rising { most } else { least })))
        };
        let turned = [true, false].into_iter().any(|rising| {
            let points = by_instance(instances, |case| number(case, rising));
            pooled::slope(&points, self.plan).is_some_and(|found| self.outcome(found.interval) != outcome)
        });
        if turned { selection::unended(instances) } else { 0 }
    }

    /// The trial that does most for the slope that was found.
    fn shown(&self, evidence: &Evidence<'_>, instances: &[Instance<'_>], outcome: Outcome) -> Option<String> {
        let (places, numbers): (Vec<f64>, Vec<f64>) =
            cases(instances).filter_map(|case| self.point(case)).unzip();
        let place = summary::mean(&places)?;
        let number = summary::mean(&numbers)?;
        let sign = if self.rising == (outcome != Outcome::Fails) { -1.0 } else { 1.0 };
        let against = |case: &Case<'_>| self.point(case).map(|(x, y)| sign * (x - place) * (y - number));
        selection::least(&self.of, evidence, instances, against)
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
    fn find(&self, evidence: &Evidence<'_>) -> CriterionResult {
        let instances = self.of.instances(evidence);
        let points = by_instance(&instances, |case| self.point(case));
        let Some(found) = pooled::slope(&points, self.plan) else {
            return CriterionResult::too_few(points.len(), instances.len(), FEWEST_INSTANCES);
        };
        let outcome = self.outcome(found.interval);
        let metric = self.metric.label.to_lowercase();
        let (subject, unit) = match &self.of.against {
            Some(_) => (format!("saving in {metric}"), "points"),
            None => (metric, self.metric.unit),
        };
        let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
        let medians = summary::medians_by_thirds(&points.concat());
        let medians = medians.iter().map(|median| format!("{median:.3}")).collect::<Vec<_>>().join(", ");
        let because = format!(
            "{}: {subject} along {} changes by {:+.4}{unit} each (95 % interval {:+.4} to {:+.4}, {} instances); medians by thirds of {} {}",
            self.of.description(),
            self.over,
            found.value,
            found.interval.low,
            found.interval.high,
            found.units,
            self.over,
            medians,
        );
        let what =
            format!("slope of {subject} along {}:{unit} each, bootstrap 95 % over instances", self.over);
        CriterionResult {
            outcome: Some(outcome),
            ours: Some(Estimate::from_bootstrap(found, what).of_cases(solved(&instances))),
            trial: self.shown(evidence, &instances, outcome),
            because: vec![because],
            limits: vec![0.0],
            units: "instances",
            censored: self.censored(&instances, outcome),
            needs: needs(found.units),
            ..CriterionResult::default()
        }
    }

    fn selections(&self) -> Vec<&Selection<'_>> {
        vec![&self.of]
    }
}
