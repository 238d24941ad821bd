//! Whether a printed number could be that of one more of our instances: a printed cell is one instance, not a mean.

use super::{Criterion, Entry, without};
use crate::analysis::context::Context;
use crate::analysis::criterion_result::{CriterionResult, refused_beyond};
use crate::analysis::evidence::Evidence;
use crate::analysis::number::{Ends, Number, whole};
use crate::analysis::outcome::Outcome;
use crate::analysis::selection::{Instance, Selection};
use crate::analysis::selection_spec::SelectionSpec;
use crate::analysis::statistic::{InstanceStatistic, LEVEL, PLAN, mean};
use crate::analysis::verdict::{Estimate, Quantity};
use base::settings::{self, Accepted, SettingsError};
use proofs::exact::Print;
use proofs::printed::Printed;
use schemars::JsonSchema;
use serde::Deserialize;
use stats::bootstrap;
use stats::interval::Interval;
use stats::proportion::{Rank, predictive};
use stats::summary::median;
use study::paper::Claim;
use toml::Value;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "one_instance",
    about: "does the printed number lie where one more instance of ours would, with 95 % probability?",
    revision: |_| 2,
    question: |settings| {
        without(settings, &["label", "premises"]);
        Some("each instance 1")
    },
    settings: Accepted::shape::<Settings>(),
    example: r#"
statistic = "mean"
[select]
study = "compare"
problems = "maps"
contender = "A*"
metric = "path_cost_cells"
"#,
    build: |context| Ok(Box::new(OneInstance::new(context)?)),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The trials that are looked at; with `against`, what is saved against it in per cent.
    select: SelectionSpec,
    /// What is taken of each instance.
    #[serde(default)]
    statistic: InstanceStatistic,
    /// What these instances are, where several sets are shown beside each other.
    label: Option<String>,
    /// Further premises that the instances rest on.
    #[serde(default)]
    premises: Vec<String>,
}

/// Instances of one kind.
#[derive(Debug, Clone)]
pub struct Instances {
    /// What they are.
    pub label: String,
    /// The statistic of each; printed twins of the claim's number are set to it.
    pub values: Vec<f64>,
    /// Instances without a number.
    pub unsolved: usize,
    /// Accepted maps and maps tried, where instances were conditioned.
    pub acceptance: Option<[u64; 2]>,
}

struct OneInstance<'a> {
    selection: Selection<'a>,
    statistic: InstanceStatistic,
    label: Option<String>,
    premises: Vec<String>,
    print: Print,
}

/// The instances that the claim of `context` is held against, one set a criterion of this name that it decides or shows by.
///
/// # Errors
/// A settings error of the criterion.
pub fn instances(context: &Context<'_>, evidence: &Evidence<'_>) -> Result<Vec<Instances>, SettingsError> {
    let criteria = context.claim.criteria().filter(|(name, _)| *name == ENTRY.name);
    criteria
        .map(|(_, settings)| {
            let one = OneInstance::new(&Context { settings, ..*context })?;
            Ok(one.held(&one.numbers(evidence)))
        })
        .collect()
}

/// Percentages that an interval covers from which on it refuses next to nothing, and decides nothing either.
const NO_POWER_POINTS: f64 = 80.0;

/// Whether an interval of per cents is so wide that it refuses next to nothing.
fn is_wide(interval: Interval) -> bool {
    interval.high - interval.low >= NO_POWER_POINTS
}

/// Whether a number of ours with this interval, which some interpretation gave, has no power for a claim that is judged by this criterion.
pub fn is_powerless(claim: &Claim, [low, high]: [f64; 2]) -> bool {
    let is_saving = |settings: &settings::Settings| {
        let selection = settings.table().get("select").and_then(Value::as_table);
        selection.is_some_and(|selection| selection.contains_key("against"))
    };
    claim.check(ENTRY.name).is_some_and(is_saving) && is_wide(Interval::new(low, high))
}

impl<'a> OneInstance<'a> {
    fn new(context: &Context<'a>) -> Result<Self, SettingsError> {
        let Settings { select, statistic, label, premises } = context.settings.read::<Settings>()?;
        let selection = Selection::new(context, &select)?;
        selection.contender(context)?;
        if statistic != InstanceStatistic::SolvedPercent {
            selection.metric(context)?;
        }
        Ok(Self { selection, statistic, label, premises, print: context.print()? })
    }

    /// What is taken of each instance, in words.
    fn title(&self) -> String {
        match (self.selection.metric, &self.selection.against) {
            (Some(metric), Some(_)) => {
                format!(
                    "{} saving in {} over an instance's queries, %",
                    self.statistic.name(),
                    metric.label.to_lowercase()
                )
            }
            (Some(metric), None) => format!("{} {}", self.statistic.name(), metric.title().to_lowercase()),
            (None, _) => format!("{}, %", self.statistic.name()),
        }
    }

    /// What the interval of one more instance says.
    fn outcome(&self, interval: Interval, values: &[f64]) -> Outcome {
        let printed = self.print.printed.value();
        if interval.contains(printed) {
            return Outcome::Holds;
        }
        let mean = bootstrap::mean(values, PLAN).filter(|_| self.selection.against.is_some());
        // Both are savings, or both are losses.
        let is_same = |Interval { low, high }: Interval| (low * printed).min(high * printed) > 0.0;
        if mean.is_some_and(|mean| is_same(mean.interval)) { Outcome::SignOnly } else { Outcome::Fails }
    }

    /// The number of an instance if what did not end lies above all others, or below; where solved queries are counted, they are counted as
    /// solved.
    fn ended(&self, instance: &Instance<'_>, lost: f64) -> Option<f64> {
        let unended = instance.cases.iter().filter(|case| case.is_unended()).count();
        let own = self.statistic.value(instance);
        if self.statistic == InstanceStatistic::SolvedPercent {
            let more = if lost > 0.0 { 100.0 * unended as f64 / instance.cases.len() as f64 } else { 0.0 };
            return own.map(|own| own + more);
        }
        // One more number would move a mean either way, a least one down and a greatest one up.
        let is_moved = match self.statistic {
            InstanceStatistic::Least => lost < 0.0,
            InstanceStatistic::Greatest => lost > 0.0,
            InstanceStatistic::Mean | InstanceStatistic::SolvedPercent => true,
        };
        if unended > 0 && (is_moved || own.is_none()) { Some(lost) } else { own }
    }

    /// How many cases without an end could turn what was found.
    fn censored(&self, numbers: &[Number], found: Outcome) -> usize {
        let filled: Option<Vec<Interval>> =
            numbers[1..].iter().map(|ended| predictive(&ended.values, LEVEL)).collect();
        let Some([below, above]) = filled.as_deref() else { return 0 };
        let printed = self.print.printed.value();
        // It may be ordinary if it lies between the two, and must be if it lies within both.
        let may_hold = below.low <= printed && printed <= above.high;
        let must_hold = below.contains(printed) && above.contains(printed);
        let turned = if found == Outcome::Holds { !must_hold } else { may_hold };
        if turned { whole(numbers).unended } else { 0 }
    }

    /// The instances that the printed number is held against.
    fn held(&self, numbers: &[Number]) -> Instances {
        let all = whole(numbers);
        let twin = |value: &f64| {
            if self.print.agrees(*value) { self.print.printed.value() } else { *value }
        };
        let values: Vec<f64> = all.values.iter().map(twin).collect();
        Instances {
            label: self.label.clone().unwrap_or_else(|| self.selection.description()),
            unsolved: all.ran - values.len(),
            values,
            acceptance: (all.hits > 0.0).then_some([all.hits as u64, all.chances as u64]),
        }
    }
}

/// The rank of `printed` among `instances` in words.
fn rank_sentence(instances: &Instances, printed: Printed) -> String {
    let rank = Rank::new(printed.value(), &instances.values);
    let Some(share) = rank.share_at_most().zip(rank.interval_at_most(LEVEL)) else {
        return format!("{}: no instance has a number", instances.label);
    };
    let middle = median(&instances.values).map_or(String::new(), |median| format!("median {median:.2}"));
    let range = predictive(&instances.values, LEVEL).map_or(String::new(), |range| {
        format!(", one more instance lies in [{:.2}, {:.2}] with 95 % probability", range.low, range.high)
    });
    let unsolved = if instances.unsolved > 0 {
        format!(" ({} more have none)", instances.unsolved)
    } else {
        String::new()
    };
    let accepted = instances.acceptance.map_or(String::new(), |[accepted, tried]| {
        let percent = 100.0 * accepted as f64 / tried as f64;
        format!(", {accepted} accepted of {tried} maps tried ({percent:.3} %)")
    });
    let place = place(rank, share, &unsolved);
    format!("{}: {middle}{range}; printed {printed}, {place}{accepted}", instances.label)
}

/// Where a number stands among instances beside unsolved ones, in words; the share at or below it comes with its interval.
fn place(rank: Rank, (share, interval): (f64, Interval), unsolved: &str) -> String {
    let count = rank.instances();
    let percent = 100.0 * share;
    let [low, high] = [interval.low, interval.high].map(|end| 100.0 * end);
    if rank.below == count {
        let beyond = 100.0 - low;
        return format!(
            "above all {count} instances{unsolved}: at most {beyond:.1} % of such instances reach it"
        );
    }
    if rank.above == count {
        return format!(
            "below all {count} instances{unsolved}: at most {high:.1} % of such instances reach it"
        );
    }
    format!(
        "with {percent:.1} % of {count} instances{unsolved} at or below it ({low:.1} to {high:.1} %), {} equal to it",
        rank.equal
    )
}

impl Criterion for OneInstance<'_> {
    fn numbers(&self, evidence: &Evidence<'_>) -> Vec<Number> {
        let drawn = self.selection.instances(evidence);
        let tried: Vec<f64> = self.selection.run(evidence).map_or_else(Vec::new, |run| {
            let preprocessing = self.selection.groups.iter().flat_map(|group| run.preprocessing(group));
            preprocessing.filter_map(|row| Some(row.values.get("tries")?.as_f64())).collect()
        });
        let values: Vec<f64> = drawn.iter().filter_map(|instance| self.statistic.value(instance)).collect();
        let (hits, chances) = (tried.len() as f64, tried.iter().sum());
        let all = Number { n: values.len(), values, hits, chances, ..Number::of_cases(&drawn) };
        let ends = [(Ends::Least, f64::NEG_INFINITY), (Ends::Most, f64::INFINITY)];
        let ended = ends.into_iter().filter(|_| all.unended > 0).map(|(ends, lost)| {
            let values = drawn.iter().filter_map(|instance| self.ended(instance, lost)).collect();
            Number { ends, values, ..Number::default() }
        });
        let ended: Vec<Number> = ended.collect();
        std::iter::once(all).chain(ended).collect()
    }

    fn weigh(&self, numbers: &[Number]) -> CriterionResult {
        let all = whole(numbers);
        let instances = self.held(numbers);
        let found = predictive(&instances.values, LEVEL).zip(mean(&instances.values));
        let Some((interval, mean)) = found else {
            return CriterionResult {
                premises: self.premises.clone(),
                ..CriterionResult::too_few(instances.values.len(), all.ran, 39)
            };
        };
        let outcome = self.outcome(interval, &instances.values);
        let is_percent =
            self.statistic == InstanceStatistic::SolvedPercent || self.selection.against.is_some();
        let powerless = is_percent && is_wide(interval);
        let mut because = vec![rank_sentence(&instances, self.print.printed)];
        because.extend(powerless.then(|| {
            format!(
                "no power: the interval covers {NO_POWER_POINTS} points or more, so almost any printed value would fit; more instances of ours do not narrow it, since the paper prints one"
            )
        }));
        let what = format!("{}: mean", self.title());
        let ours = Estimate::new(mean, interval, what, instances.values.len());
        let ours = match self.selection.metric.filter(|_| self.selection.against.is_some()) {
            Some(metric) => ours.measures(Quantity::LessPercent, metric.label.to_lowercase()),
            None => ours,
        };
        CriterionResult {
            outcome: Some(outcome),
            ours: Some(ours.of_cases(all.cases())),
            about_interval: ", 95 % predictive interval of one more instance".to_owned(),
            because,
            premises: self.premises.clone(),
            powerless,
            power: Some(refused_beyond(interval)),
            censored: self.censored(numbers, outcome),
            units: "instances",
            ..CriterionResult::default()
        }
    }

    fn show(&self, evidence: &Evidence<'_>, _: &[Number], found: &mut CriterionResult) {
        if found.ours.is_none() {
            return;
        }
        let drawn = self.selection.instances(evidence);
        let apart = |instance: &&Instance<'_>| {
            self.statistic
                .value(instance)
                .map_or(f64::INFINITY, |own| (own - self.print.printed.value()).abs())
        };
        let nearest = drawn.iter().min_by(|a, b| apart(a).total_cmp(&apart(b)));
        found.trial = self.selection.trial(evidence, nearest.and_then(|instance| instance.cases.first()));
    }

    fn selections(&self) -> Vec<&Selection<'_>> {
        vec![&self.selection]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_beyond_all_instances_has_no_rank_in_per_cent() {
        let placed = |printed: f64| {
            let rank = Rank::new(printed, &[1.0, 2.0, 3.0, 4.0]);
            let share = rank.share_at_most().zip(rank.interval_at_most(LEVEL)).unwrap();
            place(rank, share, " (2 more have none)")
        };
        // One side of the exact interval of 0 of 4: 1 - 0.025^(1/4) = 60.2 %.
        assert_eq!(
            placed(4.5),
            "above all 4 instances (2 more have none): at most 60.2 % of such instances reach it"
        );
        assert_eq!(
            placed(0.5),
            "below all 4 instances (2 more have none): at most 60.2 % of such instances reach it"
        );
        assert!(placed(4.0).starts_with("with 100.0 % of 4 instances"), "{}", placed(4.0));
        assert!(placed(2.5).starts_with("with 50.0 % of 4 instances"), "{}", placed(2.5));
    }
}
