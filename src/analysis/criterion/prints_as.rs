//! Whether a number that was measured prints as the paper's.

use super::{Criterion, Entry};
use crate::analysis::context::Context;
use crate::analysis::criterion_result::CriterionResult;
use crate::analysis::evidence::Evidence;
use crate::analysis::metric::Metric;
use crate::analysis::number::{Number, whole};
use crate::analysis::outcome::Outcome;
use crate::analysis::selection::{Selection, cases};
use crate::analysis::selection_spec::SelectionSpec;
use crate::analysis::statistic::too_few;
use crate::analysis::verdict::Estimate;
use base::settings::{Accepted, SettingsError};
use proofs::exact::Print;
use schemars::JsonSchema;
use serde::Deserialize;
use stats::interval::Interval;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "prints_as",
    about: "does a number that is the same in every trial print as the paper's?",
    revision: |_| 3,
    question: |_| Some("extremes 1"),
    settings: Accepted::shape::<Settings>(),
    example: r#"
[select]
study = "compare"
problems = "maps"
contender = "A*"
metric = "path_cost_cells"
"#,
    build: |context| Ok(Box::new(PrintsAs::new(context)?)),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The trials that are looked at.
    select: SelectionSpec,
}

struct PrintsAs<'a> {
    selection: Selection<'a>,
    metric: &'static Metric,
    print: Print,
}

impl<'a> PrintsAs<'a> {
    fn new(context: &Context<'a>) -> Result<Self, SettingsError> {
        let settings: Settings = context.settings.read()?;
        let selection = Selection::new(context, &settings.select)?;
        selection.contender(context)?;
        let metric = selection.metric(context)?;
        Ok(Self { metric, selection, print: context.print()? })
    }
}

impl Criterion for PrintsAs<'_> {
    fn numbers(&self, evidence: &Evidence<'_>) -> Vec<Number> {
        let instances = self.selection.instances(evidence);
        let values: Vec<f64> = cases(&instances).filter_map(|case| case.value).collect();
        let extreme = |pick: fn(f64, f64) -> f64| values.iter().copied().reduce(pick);
        vec![Number {
            least: extreme(f64::min),
            greatest: extreme(f64::max),
            n: values.len(),
            drawn: self.selection.drawn(&instances),
            ..Number::of_cases(&instances)
        }]
    }

    fn weigh(&self, numbers: &[Number]) -> CriterionResult {
        let found = whole(numbers);
        let who = self.selection.description();
        let metric = self.metric.label.to_lowercase();
        let Some((low, high)) = found.least.zip(found.greatest) else {
            return CriterionResult::open(format!("{who}: {metric} was not measured"));
        };
        let agree = [low, high].map(|value| self.print.agrees(value));
        let outcome = match agree {
            [true, true] => Outcome::Holds,
            [false, false] if !self.print.interval().meets(Interval::new(low, high)) => Outcome::Fails,
            _ => Outcome::Open,
        };
        let verb = if agree == [true, true] { "prints as" } else { "does not print as" };
        let number = if low == high { format!("{low:.6}") } else { format!("{low:.6} to {high:.6}") };
        let ours = Estimate::bare(low, format!("{metric} of {}", self.selection.contenders[0]), found.n);
        CriterionResult {
            outcome: Some(outcome),
            ours: Some(ours.of_cases(found.cases())),
            // One that would print so leaves open what is not the same in every trial.
            censored: if outcome == Outcome::Open { 0 } else { found.unended },
            because: vec![format!("{who}: {metric} {number}, which {verb} {}", self.print.printed)],
            power: Some("power: any other printed number would have been refused".to_owned()),
            needs: too_few(found.drawn).filter(|_| outcome == Outcome::Holds),
            ..CriterionResult::default()
        }
    }

    fn show(&self, evidence: &Evidence<'_>, _: &[Number], found: &mut CriterionResult) {
        let instances = self.selection.instances(evidence);
        found.trial = self.selection.trial(evidence, cases(&instances).find(|case| case.value.is_some()));
    }

    fn selections(&self) -> Vec<&Selection<'_>> {
        vec![&self.selection]
    }
}
