//! Whether something holds on every case: one counterexample ends it.

use super::{Criterion, Entry};
use crate::analysis::censored;
use crate::analysis::context::Context;
use crate::analysis::criterion_result::CriterionResult;
use crate::analysis::evidence::{Evidence, Run};
use crate::analysis::number::{Number, whole};
use crate::analysis::outcome::Outcome;
use crate::analysis::selection::{self, Case, Instance, Selection, cases, most_cases};
use crate::analysis::selection_spec::SelectionSpec;
use crate::analysis::statistic::{SHARE_INTERVAL, Share, tied, too_few};
use base::settings::{Accepted, SettingsError};
use schemars::JsonSchema;
use serde::Deserialize;
use stats::paired::EQUAL;
use study::record::Row;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "on_every",
    about: "does it hold on every case that a contender is lower, within a bound, accepted, or solves what another solves?",
    // Since 5, a few cases that all tie are too few.
    revision: |settings| {
        if settings.get("that").is_some_and(|that| that.as_str() == Some("lower")) { 5 } else { 4 }
    },
    question: |_| Some("every case 1"),
    settings: Accepted::shape::<Settings>(),
    example: r#"
that = "lower"
[select]
study = "compare"
problems = "maps"
contender = "Weighted A*"
against = "A*"
metric = "opened"
"#,
    build: |context| Ok(Box::new(OnEvery::new(context)?)),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The trials that are looked at.
    select: SelectionSpec,
    /// What is to hold on each.
    that: Condition,
    /// The bound of `at_most`, `above` and `at_most_times`.
    bound: Option<f64>,
}

#[derive(Deserialize, JsonSchema, Clone, Copy, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
enum Condition {
    /// The metric is below the other contender's, on every case that both solve.
    Lower,
    /// The metric is at most `bound` times the other contender's, on every case that both solve.
    AtMostTimes,
    /// The metric is at most `bound` on every path that comes back, those that the verifier refuses too.
    AtMost,
    /// The metric is above `bound` on every case that is solved.
    Above,
    /// It is solved wherever the other contender solves it.
    Solved,
    /// The verifier accepts every path that comes back.
    Accepted,
}

struct OnEvery<'a> {
    selection: Selection<'a>,
    that: Condition,
    bound: f64,
}

/// How one case speaks.
#[derive(Clone, Copy, PartialEq, Eq)]
enum CaseOutcome {
    /// For it.
    For,
    /// Neither way: equal.
    Equal,
    /// Against it.
    Against,
}

impl<'a> OnEvery<'a> {
    fn new(context: &Context<'a>) -> Result<Self, SettingsError> {
        let settings: Settings = context.settings.read()?;
        let selection = Selection::new(context, &settings.select)?;
        selection.some_contender(context)?;
        let that = settings.that;
        let is_bounded = matches!(that, Condition::AtMost | Condition::Above | Condition::AtMostTimes);
        if is_bounded != settings.bound.is_some() {
            let needs = if is_bounded { "needs a `bound`" } else { "takes no `bound`" };
            let message = format!("this kind of `that` {needs}");
            return Err(context.settings.error_at("that", message).about("bound"));
        }
        if !matches!(that, Condition::AtMost | Condition::Above | Condition::Accepted) {
            selection.against(context)?;
        }
        if !matches!(that, Condition::Solved | Condition::Accepted) {
            selection.metric(context)?;
        }
        Ok(Self { selection, that, bound: settings.bound.unwrap_or_default() })
    }

    /// How a case speaks; `None` if the claim does not look at it.
    fn outcome_of_case(&self, run: &Run<'_>, case: &Case<'_>) -> Option<CaseOutcome> {
        let holds = |holds| if holds { CaseOutcome::For } else { CaseOutcome::Against };
        let side = |gap: f64| match gap {
            gap if gap < -EQUAL => CaseOutcome::For,
            gap if gap > EQUAL => CaseOutcome::Against,
            _ => CaseOutcome::Equal,
        };
        match self.that {
            Condition::Lower => case.pair().map(|(base, own)| side(own - base)),
            Condition::AtMostTimes => case.pair().map(|(base, own)| holds(own <= self.bound * base + EQUAL)),
            Condition::Above => case.value.map(|value| holds(value > self.bound + EQUAL)),
            Condition::AtMost => {
                let value = run.value(case.row, self.selection.metric?).filter(|_| case.row.is_returned());
                value.map(|value| holds(value <= self.bound + EQUAL))
            }
            Condition::Solved => {
                let is_asked = case.base.is_some_and(Row::is_solved) && !selection::is_unended(case.row);
                is_asked.then(|| holds(case.row.is_solved()))
            }
            Condition::Accepted => case.row.is_returned().then(|| holds(case.row.is_solved())),
        }
    }

    /// What is to hold, in words.
    fn claim(&self) -> String {
        let metric = self.selection.metric.map_or_else(String::new, |metric| metric.title().to_lowercase());
        match self.that {
            Condition::Lower => format!("{metric} is lower"),
            Condition::AtMostTimes => format!("{metric} is at most {} times the other's", self.bound),
            Condition::AtMost => format!("{metric} is at most {}", self.bound),
            Condition::Above => format!("{metric} is above {}", self.bound),
            Condition::Solved => "it is solved where the other solves it".to_owned(),
            Condition::Accepted => "the verifier accepts the path that comes back".to_owned(),
        }
    }

    /// How many cases might have been a counterexample and are not known to be none.
    fn unknown(&self, instances: &[Instance<'_>]) -> usize {
        match self.that {
            Condition::Solved => {
                let might_part = |case: &&Case<'_>| {
                    let [own, base] =
                        [Some(case.row), case.base].map(|row| row.is_some_and(selection::is_unended));
                    own && (base || case.base.is_some_and(Row::is_solved)) || base && !case.row.is_solved()
                };
                cases(instances).filter(might_part).count()
            }
            // What ended without a number is outside of a claim about what is solved, or what comes back.
            Condition::Lower
            | Condition::AtMostTimes
            | Condition::Above
            | Condition::AtMost
            | Condition::Accepted => cases(instances).filter(|case| case.might_be_solved()).count(),
        }
    }

    fn outcomes<'e>(&self, run: &Run<'_>, instances: &'e [Instance<'e>]) -> Vec<Vec<(CaseOutcome, &'e Row)>> {
        let of_instance = |instance: &'e Instance<'e>| {
            instance
                .cases
                .iter()
                .filter_map(|case| Some((self.outcome_of_case(run, case)?, case.row)))
                .collect()
        };
        instances.iter().map(of_instance).collect()
    }
}

impl Criterion for OnEvery<'_> {
    fn numbers(&self, evidence: &Evidence<'_>) -> Vec<Number> {
        let instances = self.selection.instances(evidence);
        let outcomes =
            self.selection.run(evidence).map(|run| self.outcomes(run, &instances)).unwrap_or_default();
        let count =
            |wanted: CaseOutcome| outcomes.iter().flatten().filter(|(says, _)| *says == wanted).count();
        let hits_of = |instance: &Vec<(CaseOutcome, &Row)>| {
            let hits = instance.iter().filter(|(says, _)| *says == CaseOutcome::For).count();
            [hits as f64, instance.len() as f64]
        };
        let counts: Vec<[f64; 2]> = outcomes.iter().map(hits_of).collect();
        let whole = Number {
            below: count(CaseOutcome::For),
            equal: count(CaseOutcome::Equal),
            above: count(CaseOutcome::Against),
            unended: self.unknown(&instances),
            drawn: self.selection.drawn(&instances),
            ..Number::of_cases(&instances)
        };
        vec![Share::counted(Share::new(&counts, most_cases(&instances)), &counts, whole)]
    }

    fn weigh(&self, numbers: &[Number]) -> CriterionResult {
        let all = whole(numbers);
        let (kept, equal, broken) = (all.below, all.equal, all.above);
        let outcome = match (kept, equal, broken) {
            (0, 0, 0) => Outcome::Open,
            (_, 0, 0) => Outcome::Holds,
            // Never the other way round, but not always so either.
            (1.., _, 0) => Outcome::Open,
            // One counterexample ends it, and so does a strict comparison that ties on every case.
            _ => Outcome::Fails,
        };
        let equally = if equal > 0 { format!(", equal on {equal}") } else { String::new() };
        let because = format!(
            "{}: {} on {kept} of {} cases{equally}, the contrary on {broken}",
            self.selection.description(),
            self.claim(),
            kept + equal + broken
        );
        // One counterexample is enough; that cases are equal is not.
        let unknown = if broken > 0 { 0 } else { all.unended };
        let left = (unknown > 0).then(|| format!("{unknown} more cases have no number to compare"));
        let outside = censored::outside_in_words(&self.selection, all.outside)
            .filter(|_| self.that != Condition::Solved);
        let tie = all.drawn.filter(|_| all.is_tied()).and_then(tied);
        let share =
            Share::from_number(all).map(|share| share.estimate(&format!("cases on which {}", self.claim())));
        CriterionResult {
            outcome: Some(outcome),
            ties: if outcome == Outcome::Open { equal } else { 0 },
            ours: share.map(|ours| ours.of_cases(all.cases())),
            about_interval: SHARE_INTERVAL.to_owned(),
            because: std::iter::once(because).chain(tie).chain(left).chain(outside).collect(),
            units: "cases",
            censored: unknown,
            // One counterexample is enough; that the first few cases hold, or tie, is not.
            needs: too_few(all.drawn).filter(|_| broken == 0 && outcome != Outcome::Open),
            ..CriterionResult::default()
        }
    }

    /// A counterexample or, where there is none, a case that is equal.
    fn show(&self, evidence: &Evidence<'_>, _: &[Number], found: &mut CriterionResult) {
        let Some(run) = self.selection.run(evidence) else { return };
        let instances = self.selection.instances(evidence);
        let outcomes = self.outcomes(run, &instances);
        let first = |wanted: CaseOutcome| outcomes.iter().flatten().find(|(says, _)| *says == wanted);
        let shown = first(CaseOutcome::Against).or_else(|| first(CaseOutcome::Equal));
        found.trial = shown.map(|(_, row)| run.trial(row));
        found.because.extend(censored::not_posed(&self.selection, evidence));
    }

    fn selections(&self) -> Vec<&Selection<'_>> {
        vec![&self.selection]
    }
}
