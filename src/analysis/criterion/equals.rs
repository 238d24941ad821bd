//! Whether a number is, on every trial, what an oracle says, or what another contender finds.

use super::{Criterion, Entry};
use crate::analysis::censored;
use crate::analysis::context::Context;
use crate::analysis::criterion_result::CriterionResult;
use crate::analysis::evidence::{Evidence, Run};
use crate::analysis::metric::Metric;
use crate::analysis::number::{Number, whole};
use crate::analysis::outcome::Outcome;
use crate::analysis::selection::{Case, Instance, Selection, cases, most_cases};
use crate::analysis::selection_spec::SelectionSpec;
use crate::analysis::statistic::{SHARE_INTERVAL, Share, too_few};
use base::settings::{Accepted, SettingsError};
use schemars::JsonSchema;
use serde::Deserialize;
use study::record::{Row, Status};

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "equals",
    about: "is a metric, on every trial, what another metric or another contender says that it is?",
    revision: |_| 4,
    question: |_| Some("equal trials 1"),
    settings: Accepted::shape::<Settings>(),
    example: r#"
truth = "optimal_cost_cells"
[select]
study = "compare"
problems = "maps"
contender = "A*"
metric = "path_cost_cells"
"#,
    build: |context| Ok(Box::new(Equals::new(context)?)),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The trials that are looked at; with `against`, on the cases that both solve.
    select: SelectionSpec,
    /// The metric of the same trial that holds the truth; without it, the truth is the metric of the contender `against`.
    truth: Option<String>,
    /// How far metric and truth may be apart, in the metric's unit, beyond a billionth of the truth.
    #[serde(default)]
    #[schemars(range(min = 0.0, max = 1e9))]
    within: f64,
}

struct Equals<'a> {
    selection: Selection<'a>,
    metric: &'static Metric,
    truth: Option<&'static Metric>,
    within: f64,
}

/// Values this close are the same, relative.
const SAME: f64 = 1e-9;

impl<'a> Equals<'a> {
    fn new(context: &Context<'a>) -> Result<Self, SettingsError> {
        let settings: Settings = context.settings.read()?;
        let selection = Selection::new(context, &settings.select)?;
        selection.some_contender(context)?;
        let metric = selection.metric(context)?;
        let truth =
            settings.truth.as_ref().map(|name| context.metric("truth", name, selection.study)).transpose()?;
        if truth.is_some() == selection.against.is_some() {
            return Err(context
                .settings
                .error("one of `truth` and `select.against` is accepted")
                .about("truth")
                .about("against"));
        }
        Ok(Self { selection, metric, truth, within: settings.within })
    }
}

/// How far the numbers are apart at most, and in per cent on the whole.
const APART: &str = "apart";

/// What all trials say.
#[derive(Default)]
struct Tally<'e> {
    /// Trials that are the same, and trials, by instance.
    counts: Vec<[f64; 2]>,
    /// The largest difference.
    worst: f64,
    /// The sums of the metric and of the truth.
    sums: [f64; 2],
    /// The first trial that is not the same.
    wrong: Option<&'e Row>,
    /// Trials without an end, which could be either.
    unknown: usize,
    /// Trials that are not the same, of others.
    broken: usize,
}

impl Equals<'_> {
    /// The truth and the number of one case; `None` if the claim does not look at it.
    fn pair(&self, run: &Run<'_>, case: &Case<'_>) -> Option<(f64, f64)> {
        let Some(truth) = self.truth else { return case.pair() };
        // What was not measured is as wrong as what is far off, unless the truth is unknown too.
        let own = run.value(case.row, self.metric).unwrap_or(f64::INFINITY);
        Some((run.value(case.row, truth)?, own))
    }

    fn tally<'e>(&self, run: &Run<'_>, instances: &[Instance<'e>]) -> Tally<'e> {
        let mut all = Tally::default();
        for instance in instances {
            let mut count = [0.0; 2];
            for case in &instance.cases {
                let pair = self.pair(run, case);
                let is_known = pair.is_some_and(|(_, own)| own.is_finite());
                let is_cut = !is_known && case.might_be_solved();
                all.unknown += usize::from(is_cut);
                let Some((truth, own)) = pair else { continue };
                let apart = (own - truth).abs();
                let is_same = apart <= self.within + SAME * truth.abs();
                count = [count[0] + f64::from(u8::from(is_same)), count[1] + 1.0];
                all.broken += usize::from(!is_same && !is_cut);
                all.worst = all.worst.max(apart);
                all.sums = [all.sums[0] + own, all.sums[1] + truth];
                all.wrong = all.wrong.or((!is_same && !is_cut).then_some(case.row));
            }
            if count[1] > 0.0 {
                all.counts.push(count);
            }
        }
        all
    }

    /// What the metric is held against.
    fn truth_name(&self) -> String {
        let other = || format!("that of {}", self.selection.against.as_deref().unwrap_or_default());
        self.truth.map_or_else(other, |truth| truth.label.to_lowercase())
    }
}

impl Criterion for Equals<'_> {
    fn numbers(&self, evidence: &Evidence<'_>) -> Vec<Number> {
        let instances = self.selection.instances(evidence);
        let Tally { counts, worst, sums, unknown, broken, .. } =
            self.selection.run(evidence).map(|run| self.tally(run, &instances)).unwrap_or_default();
        let refused = cases(&instances).filter(|case| case.row.status == Status::Rejected).count();
        let share = Share::new(&counts, most_cases(&instances));
        let percent = Some(100.0 * (sums[0] / sums[1] - 1.0)).filter(|percent| percent.is_finite());
        let apart =
            Number { part: APART.to_owned(), value: percent, greatest: Some(worst), ..Number::default() };
        let drawn = self.selection.drawn(&instances);
        let whole =
            Number { unended: unknown, above: broken, refused, drawn, ..Number::of_cases(&instances) };
        vec![Share::counted(share, &counts, whole), apart]
    }

    fn weigh(&self, numbers: &[Number]) -> CriterionResult {
        let found = whole(numbers);
        let [same, all] = [found.hits, found.chances];
        let outcome = match (all > 0.0, same == all) {
            (false, _) => Outcome::Open,
            (true, true) => Outcome::Holds,
            (true, false) => Outcome::Fails,
        };
        let metric = self.metric.label.to_lowercase();
        let truth = self.truth_name();
        let far = numbers.iter().find(|number| number.part == APART);
        let apart = far.and_then(|far| far.greatest.zip(far.value)).map(|(worst, percent)| {
            format!("; they are {worst:.4} apart at most, and {percent:+.2} % on the whole")
        });
        let apart = apart.unwrap_or_default();
        let mut because = vec![format!(
            "{}: {metric} is {truth} on {same} of {all} trials{apart}",
            self.selection.description()
        )];
        let refused = found.refused;
        because.extend((refused > 0).then(|| format!("{refused} of these paths the verifier refuses")));
        because.extend(
            censored::outside_in_words(&self.selection, found.outside).filter(|_| self.truth.is_none()),
        );
        let ours = Share::from_number(found).map(|share| {
            let what = format!("trials on which {metric} is {truth}");
            share.estimate(&what).of_cases([same as usize, all as usize])
        });
        CriterionResult {
            outcome: Some(outcome),
            ours,
            about_interval: SHARE_INTERVAL.to_owned(),
            because,
            units: "trials",
            // That something is wrong hangs on them only if nothing else is.
            censored: if found.above > 0 { 0 } else { found.unended },
            needs: too_few(found.drawn).filter(|_| outcome == Outcome::Holds),
            ..CriterionResult::default()
        }
    }

    fn show(&self, evidence: &Evidence<'_>, _: &[Number], found: &mut CriterionResult) {
        let Some(run) = self.selection.run(evidence) else { return };
        let wrong = self.tally(run, &self.selection.instances(evidence)).wrong;
        found.trial = wrong.map(|row| run.trial(row));
    }

    fn selections(&self) -> Vec<&Selection<'_>> {
        vec![&self.selection]
    }
}
