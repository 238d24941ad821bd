//! Whether a metric differs among problems that are claimed to give different numbers.

use super::super::Criterion;
use super::{Settings, places};
use crate::analysis::context::Context;
use crate::analysis::criterion_result::CriterionResult;
use crate::analysis::evidence::{Evidence, Run};
use crate::analysis::metric::Metric;
use crate::analysis::outcome::Outcome;
use crate::analysis::selection::is_unended;
use crate::analysis::selection_spec::Labels;
use crate::analysis::statistic::or_infinite;
use base::settings::SettingsError;
use stats::summary::median;
use study::Study;
use study::record::{Row, Status};

/// A claim that a metric is not the same on all problems of each set.
pub(super) struct Differs<'a> {
    study: &'a Study,
    contender: String,
    metric: &'static Metric,
    sets: Vec<Vec<String>>,
}

impl<'a> Differs<'a> {
    /// The criterion of the claim of `context`, which `settings` ask for.
    pub(super) fn new(context: &Context<'a>, settings: Settings) -> Result<Self, SettingsError> {
        let (places, metric) = places(context, &settings)?;
        let contenders = settings.contenders.listed();
        let ([place], [contender]) = (&places[..], &contenders[..]) else {
            return Err(context.settings.error_at("differ", "`differ` takes one place and one contender"));
        };
        context.groups("differ", place.study, &Labels::Several(settings.differ.concat()))?;
        Ok(Self { study: place.study, contender: contender.clone(), metric, sets: settings.differ })
    }
}

impl Differs<'_> {
    /// The trials on one problem that could be posed.
    fn rows<'e>(&self, run: &'e Run<'_>, group: &str) -> Vec<&'e Row> {
        let mut rows = run.rows(group, &self.contender);
        rows.retain(|row| row.status != Status::InvalidProblem);
        rows
    }

    /// The median on one problem, failures infinite, of the trials that came to an end.
    fn median(&self, run: &Run<'_>, problem: &str) -> Option<f64> {
        let rows = self.rows(run, problem).into_iter();
        median(&rows.filter_map(|row| or_infinite(run, row, self.metric, None)).collect::<Vec<_>>())
    }
}

impl Criterion for Differs<'_> {
    fn find(&self, evidence: &Evidence<'_>) -> CriterionResult {
        let Some(run) = evidence.run(&self.study.name) else { return CriterionResult::default() };
        let mut found = CriterionResult { existential: true, ..CriterionResult::default() };
        let mut differ = 0;
        let mut alike = None;
        for set in &self.sets {
            let values: Vec<Option<f64>> = set.iter().map(|problem| self.median(run, problem)).collect();
            let spelled = |(problem, value): (&String, &Option<f64>)| match value {
                Some(value) => format!("{problem} {value:.4}"),
                None => format!("{problem} –"),
            };
            found.because.push(set.iter().zip(&values).map(spelled).collect::<Vec<_>>().join(", "));
            let known: Vec<f64> = values.into_iter().flatten().collect();
            let is_other = |value: &f64| (value - known[0]).abs() > 1e-9;
            let differs = known.len() == set.len() && known.iter().any(is_other);
            differ += usize::from(differs);
            alike = alike.or(set.last().filter(|_| !differs));
        }
        found.outcome = Some(match differ {
            0 => Outcome::Fails,
            all if all == self.sets.len() => Outcome::Holds,
            _ => Outcome::SignOnly,
        });
        let cut =
            self.sets.iter().flatten().flat_map(|group| self.rows(run, group)).filter(|row| is_unended(row));
        found.censored = cut.count();
        // A problem that should have given another number, where there is one.
        let shown = alike.or(self.sets.iter().flatten().next());
        let first = shown.and_then(|group| self.rows(run, group).into_iter().next());
        found.trial = first.map(|row| run.trial(row));
        let metric = self.metric.label.to_lowercase();
        found.because.push(format!(
            "{metric} of {} differs in {differ} of {} sets",
            self.contender,
            self.sets.len()
        ));
        found
    }

    fn studies(&self) -> Vec<&Study> {
        vec![self.study]
    }

    fn results(&self, evidence: &Evidence<'_>) -> String {
        let Some(run) = evidence.run(&self.study.name) else { return String::new() };
        let of_group = |group: &String| {
            let rows = run.rows(group, &self.contender).into_iter();
            let values: Vec<Option<u64>> =
                rows.map(|row| run.value(row, self.metric).map(f64::to_bits)).collect();
            format!("{group} {values:?}\n")
        };
        self.sets.iter().flatten().map(of_group).collect()
    }
}
