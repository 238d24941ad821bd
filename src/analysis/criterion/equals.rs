//! Whether a number is, on every trial, what an oracle says, or what another contender finds.

use super::{Context, Criterion, Entry, Found};
use crate::analysis::class::Outcome;
use crate::analysis::evidence::Evidence;
use crate::analysis::metric::Metric;
use crate::analysis::selection::{Selection, SelectionSpec};
use crate::analysis::statistic::{self, plan};
use crate::analysis::verdict::Estimate;
use crate::study::Study;
use crate::study::record::{Row, Status};
use base::settings::{Accepted, SettingsError};
use schemars::JsonSchema;
use serde::Deserialize;
use stats::bootstrap::Resampling;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "equals",
    about: "is a metric, on every trial, what another metric or another contender says that it is?",
    settings: Accepted::of::<Settings>(),
    example: r#"
of = { study = "success", problems = "cell", contender = "Original A*", metric = "found" }
truth = "connected"
"#,
    build: |context| Ok(Box::new(Equals::new(context)?)),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The trials that are looked at; with `against`, on the cases that both solve.
    of: SelectionSpec,
    /// The metric of the same trial that is the truth; without it the metric of the contender `against` is.
    truth: Option<String>,
    /// How far they may be apart, in the metric's unit, beyond a billionth of the truth.
    #[serde(default)]
    #[schemars(range(min = 0.0))]
    within: f64,
}

struct Equals<'a> {
    of: Selection<'a>,
    metric: &'static Metric,
    truth: Option<&'static Metric>,
    within: f64,
    plan: Resampling,
}

/// Values this close are the same, relative.
const SAME: f64 = 1e-9;

impl<'a> Equals<'a> {
    fn new(context: &Context<'a>) -> Result<Self, SettingsError> {
        let settings: Settings = context.settings.read()?;
        let of = Selection::new(context, &settings.of)?;
        let metric = of.metric(context)?;
        let truth = settings.truth.as_ref().map(|name| context.metric(name, of.study)).transpose()?;
        if truth.is_some() == of.against.is_some() {
            return Err(context.settings.error("one of `truth` and `of.against` is accepted"));
        }
        Ok(Self { of, metric, truth, within: settings.within, plan: plan(&context.seed_names()) })
    }
}

impl Criterion for Equals<'_> {
    fn find(&self, evidence: &Evidence<'_>) -> Found {
        let Some(run) = self.of.run(evidence) else { return Found::default() };
        let draws = self.of.draws(evidence);
        let (mut counts, mut worst, mut sums, mut wrong): (Vec<[f64; 2]>, f64, [f64; 2], Option<&Row>) =
            (Vec::new(), 0.0, [0.0; 2], None);
        for draw in &draws {
            let mut count = [0.0; 2];
            for case in &draw.cases {
                let pair = match self.truth {
                    None => case.pair(),
                    // What was not measured is as wrong as what is far off, unless the truth is unknown too.
                    Some(truth) => run
                        .value(case.row, truth)
                        .map(|truth| (truth, run.value(case.row, self.metric).unwrap_or(f64::INFINITY))),
                };
                let Some((truth, own)) = pair else { continue };
                let apart = (own - truth).abs();
                let is_same = apart <= self.within + SAME * truth.abs();
                count = [count[0] + f64::from(u8::from(is_same)), count[1] + 1.0];
                worst = worst.max(apart);
                sums = [sums[0] + own, sums[1] + truth];
                if !is_same {
                    wrong = wrong.or(Some(case.row));
                }
            }
            counts.push(count);
        }
        let total = counts.iter().fold([0.0, 0.0], |sum, count| [sum[0] + count[0], sum[1] + count[1]]);
        let outcome = match total {
            [_, 0.0] => Outcome::Open,
            [same, all] if same == all => Outcome::Holds,
            _ => Outcome::Fails,
        };
        let what = self.truth.map_or_else(
            || format!("that of {}", self.of.against.as_deref().unwrap_or_default()),
            |truth| truth.label.to_lowercase(),
        );
        let metric = self.metric.label.to_lowercase();
        let refused =
            draws.iter().flat_map(|draw| &draw.cases).filter(|case| case.row.status == Status::Rejected);
        let mut because = vec![format!(
            "{}: {metric} is {what} on {} of {} trials; they are {worst:.4} apart at most, and {:+.2} % on the whole",
            self.of.said(),
            total[0],
            total[1],
            100.0 * (sums[0] / sums[1] - 1.0)
        )];
        let refused = refused.count();
        because.extend((refused > 0).then(|| format!("{refused} of these paths the verifier refuses")));
        let counts: Vec<[f64; 2]> = counts.into_iter().filter(|count| count[1] > 0.0).collect();
        let ours = statistic::share(&counts, self.plan).map(|(share, interval, how)| {
            let what = format!("share of trials on which {metric} is {what}, {how}");
            Estimate::new(share, interval, what, counts.len()).of_cases(total.map(|count| count as usize))
        });
        let trial = wrong.map(|row| run.trial(row));
        Found { outcome: Some(outcome), ours, trial, because, units: "trials", ..Found::default() }
    }

    fn studies(&self) -> Vec<&Study> {
        vec![self.of.study]
    }

    fn is_clock(&self) -> bool {
        self.of.is_clock()
    }
}
