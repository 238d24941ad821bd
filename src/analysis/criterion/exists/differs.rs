//! Whether a metric differs among problems that are claimed to give different numbers.

use super::super::Criterion;
use super::{Settings, places};
use crate::analysis::context::Context;
use crate::analysis::criterion_result::CriterionResult;
use crate::analysis::evidence::{Evidence, Run};
use crate::analysis::metric::Metric;
use crate::analysis::number::{Ends, Number, parts, whole};
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

impl Differs<'_> {
    /// The numbers by set.
    fn in_sets<'n>(&self, numbers: &'n [Number]) -> Vec<Vec<&'n Number>> {
        let mut all = parts(numbers, Ends::Measured).into_iter();
        self.sets.iter().map(|set| all.by_ref().take(set.len()).collect()).collect()
    }
}

/// Whether all problems of a set have a number, and not the same.
fn differs(set: &[&Number]) -> bool {
    let values: Option<Vec<f64>> = set.iter().map(|number| number.value).collect();
    values.is_some_and(|values| values.iter().any(|value| (value - values[0]).abs() > 1e-9))
}

impl Criterion for Differs<'_> {
    /// The median on each problem.
    fn numbers(&self, evidence: &Evidence<'_>) -> Vec<Number> {
        let Some(run) = evidence.run(&self.study.name) else { return vec![Number::default()] };
        let problems: Vec<&String> = self.sets.iter().flatten().collect();
        let cut = problems.iter().flat_map(|group| self.rows(run, group)).filter(|row| is_unended(row));
        let of_problem = |problem: &&String| {
            let part = (*problem).clone();
            Number { part, value: self.median(run, problem), ..Number::default() }
        };
        let whole = Number { unended: cut.count(), ..Number::default() };
        std::iter::once(whole).chain(problems.iter().map(of_problem)).collect()
    }

    fn weigh(&self, numbers: &[Number]) -> CriterionResult {
        let mut found = CriterionResult { existential: true, ..CriterionResult::default() };
        let spelled = |number: &&Number| match number.value {
            Some(value) => format!("{} {value:.4}", number.part),
            None => format!("{} –", number.part),
        };
        let sets = self.in_sets(numbers);
        let differ = sets.iter().filter(|set| differs(set)).count();
        let lines = sets.iter().map(|set| set.iter().map(spelled).collect::<Vec<_>>().join(", "));
        found.because.extend(lines);
        found.outcome = Some(match differ {
            0 => Outcome::Fails,
            all if all == self.sets.len() => Outcome::Holds,
            _ => Outcome::SignOnly,
        });
        found.censored = whole(numbers).unended;
        let metric = self.metric.label.to_lowercase();
        found.because.push(format!(
            "{metric} of {} differs in {differ} of {} sets",
            self.contender,
            self.sets.len()
        ));
        found
    }

    /// A problem that should have given another number, where there is one.
    fn show(&self, evidence: &Evidence<'_>, numbers: &[Number], found: &mut CriterionResult) {
        let Some(run) = evidence.run(&self.study.name) else { return };
        let sets = self.in_sets(numbers);
        let alike = sets.iter().find(|set| !differs(set)).and_then(|set| set.last());
        let shown = alike.or_else(|| sets.first()?.first());
        let first = shown.and_then(|number| self.rows(run, &number.part).into_iter().next());
        found.trial = first.map(|row| run.trial(row));
    }

    fn counts_refused(&self) -> bool {
        self.metric.is_of_search
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
