//! Whether some contenders' medians are below those of others on every problem, failures counted as infinite.
//!
//! Each comparison is a ratio of two medians with an interval; the largest ratio decides. With `by_inclusion`, what
//! follows from one contender's steps including another's is stated and held against the runs, not estimated from them.

use super::{Criterion, Entry, without};
use crate::analysis::context::Context;
use crate::analysis::criterion_result::CriterionResult;
use crate::analysis::evidence::{Evidence, Run};
use crate::analysis::inclusion::Inclusion;
use crate::analysis::metric::Metric;
use crate::analysis::number::{Ends, Number, parts, whole};
use crate::analysis::outcome::Outcome;
use crate::analysis::selection::{Selection, is_unended};
use crate::analysis::selection_spec::SelectionSpec;
use crate::analysis::statistic::{PLAN, or_infinite};
use crate::analysis::verdict::{Estimate, Quantity};
use base::settings::{Accepted, Faults, SettingsError};
use schemars::JsonSchema;
use serde::Deserialize;
use stats::bootstrap;
use stats::interval::Interval;
use stats::paired::EQUAL;
use stats::summary::median;
use std::collections::{BTreeMap, BTreeSet};
use study::record::{Row, Status};

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "least_of",
    about: "is a contender's median over seeds, failures infinite, below that of each other one on every problem?",
    revision: |_| 2,
    question: |settings| {
        without(settings, &["by_percent"]);
        Some("ratios of medians 1")
    },
    settings: Accepted::shape::<Settings>(),
    example: r#"
select = { study = "compare", problems = ["maps"], metric = "expansions" }
lower = "Weighted A*"
higher = ["A*"]
by_percent = 20
"#,
    build: |context| Ok(Box::new(LeastOf::new(context)?)),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The trials that are looked at: study, problems and metric.
    select: SelectionSpec,
    /// Contenders that are claimed to be below every one of `higher`, each by itself.
    lower: crate::analysis::selection_spec::Labels,
    /// Those that they are compared with.
    higher: crate::analysis::selection_spec::Labels,
    /// By how many per cent at least.
    #[serde(default)]
    #[schemars(range(min = 0.0, max = 99.9))]
    by_percent: f64,
    /// Whether the metric is the length of a path, so that a contender whose steps include another's is never longer.
    #[serde(default)]
    by_inclusion: bool,
}

struct LeastOf<'a> {
    selection: Selection<'a>,
    metric: &'static Metric,
    /// The pairs compared: the contender that is claimed to be lower, then the other.
    pairs: Vec<(String, String)>,
    by_percent: f64,
    inclusions: Vec<Inclusion>,
}

/// Fewest seeds with which medians of two contenders that draw decide. Of 4 each, all of one are below all of the
/// other's by chance once in 70 times; of 3 each once in 20 times. A contender with one seed does not draw; a problem that
/// was drawn does.
const FEWEST_SEEDS: usize = 4;

/// One contender on one problem.
struct Side {
    values: Vec<f64>,
    /// Values of the trials that ended within their budget.
    ended: Vec<f64>,
    median: f64,
    interval: [f64; 2],
}

impl<'a> LeastOf<'a> {
    fn new(context: &Context<'a>) -> Result<Self, SettingsError> {
        let settings: Settings = context.settings.read()?;
        let lower = settings.lower.listed();
        let higher = settings.higher.listed();
        for (key, labels) in [("lower", &lower), ("higher", &higher)] {
            if labels.is_empty() {
                let message = format!("`{key}` needs at least one contender");
                return Err(context.settings.error_at(key, message).about(key));
            }
        }
        if let Some(own) = lower.iter().find(|own| higher.contains(own)) {
            let message = format!("`{own}` is held against itself; another contender is accepted");
            return Err(context.settings.error_at("higher", message));
        }
        let named: Vec<&str> = lower.iter().chain(&higher).map(String::as_str).collect();
        let mut faults = Faults::default();
        if let Some(study) = context.paper.study(&settings.select.study) {
            faults.keep(context.check_contenders(&["lower", "higher"], study, &named));
        }
        let selection = faults.keep(Selection::new(context, &settings.select));
        let Some(selection) = selection.filter(|_| faults.is_empty()) else { return Err(faults.error()) };
        let metric = selection.metric(context)?;
        let with = |low: &String| higher.iter().map(|high| (low.clone(), high.clone())).collect::<Vec<_>>();
        let pairs: Vec<(String, String)> = lower.iter().flat_map(with).collect();
        let inclusion = |(low, high): &(String, String)| {
            if !settings.by_inclusion {
                return Ok(Inclusion::Open);
            }
            Inclusion::in_study(selection.study, context.point, low, high)
        };
        let inclusions = pairs.iter().map(inclusion).collect::<Result<_, _>>()?;
        Ok(Self { selection, metric, pairs, by_percent: settings.by_percent, inclusions })
    }

    /// Below this a ratio is what the claim says.
    fn limit(&self) -> f64 {
        1.0 - self.by_percent / 100.0
    }

    /// The metric of every trial; infinite where it failed, and `unended` where it did not come to an end.
    fn values(&self, run: &Run<'_>, problem: &str, contender: &str, unended: Option<f64>) -> Vec<f64> {
        let value = |row: &&Row| or_infinite(run, row, self.metric, unended);
        self.selection.rows(run, problem, contender).iter().filter_map(value).collect()
    }

    /// What was drawn independently: seeds, or the repeated times where there is one seed.
    fn units(&self, run: &Run<'_>, problem: &str, contender: &str, values: &[f64]) -> Vec<f64> {
        if !self.metric.is_clock() || values.len() > 1 {
            return values.to_vec();
        }
        let rows = self.selection.rows(run, problem, contender);
        rows.iter().flat_map(|row| run.repeats(row, self.metric)).collect()
    }

    /// Every contender on `problem`, so that each bootstrap is made once: those claimed to be lower (0), then the others (1).
    fn sides(&self, run: &Run<'_>, problem: &str, unended: [f64; 2]) -> BTreeMap<(usize, &str), Side> {
        let mut sides = BTreeMap::new();
        for (place, contender) in self.pairs.iter().flat_map(|(low, high)| [(0, low), (1, high)]) {
            if sides.contains_key(&(place, contender.as_str())) {
                continue;
            }
            let values = self.values(run, problem, contender, Some(unended[place]));
            if let Some(median) = median(&values) {
                let units = self.units(run, problem, contender, &values);
                let found = bootstrap::median(&units, PLAN).map(|found| found.interval);
                let interval = found.map_or([units[0]; 2], |found| [found.low, found.high]);
                let ended = self.values(run, problem, contender, None);
                sides.insert((place, contender.as_str()), Side { values, ended, median, interval });
            }
        }
        sides
    }

    /// Every comparison with numbers on both sides. Trials without an end take the values that `ends` names: one for those claimed
    /// to be lower, one for the others.
    fn compared(&self, run: &Run<'_>, ends: Ends) -> Vec<Number> {
        let unended = match ends {
            Ends::Measured => [f64::INFINITY; 2],
            Ends::Least => [0.0, f64::INFINITY],
            Ends::Most => [f64::INFINITY, 0.0],
        };
        let mut all = Vec::new();
        for problem in &self.selection.groups {
            let sides = self.sides(run, problem, unended);
            let compared = (0..self.pairs.len()).filter_map(|index| self.compare(&sides, problem, index));
            all.extend(compared.map(|compared| Number { ends, ..compared }));
        }
        all
    }

    /// The problems that could be posed or did not run; if none could, all of them.
    fn posed(&self, run: &Run<'_>) -> Vec<&String> {
        let labels = || self.pairs.iter().flat_map(|(low, high)| [low, high]);
        let is_posed = |group: &&String| {
            let mut rows = labels().flat_map(|label| run.rows(group, label)).peekable();
            rows.peek().is_none() || rows.any(|row| row.status != Status::InvalidProblem)
        };
        let posed: Vec<&String> = self.selection.groups.iter().filter(is_posed).collect();
        if posed.is_empty() { self.selection.groups.iter().collect() } else { posed }
    }

    /// What the comparisons say, if they are all those that could be posed.
    fn outcome(&self, numbers: &[Number], ends: Ends) -> Outcome {
        let all = compared(numbers, ends);
        let posed = self.selection.groups.len() - left_out(numbers).len();
        let is_complete = !all.is_empty() && all.len() == self.pairs.len() * posed;
        if is_complete { outcome(&all, self.limit()) } else { Outcome::Open }
    }

    /// How many trials did not come to an end.
    fn unended(&self, run: &Run<'_>) -> usize {
        let labels: BTreeSet<&String> = self.pairs.iter().flat_map(|(low, high)| [low, high]).collect();
        let cases =
            self.selection.groups.iter().flat_map(|group| labels.iter().map(move |label| (group, *label)));
        let rows = cases.flat_map(|(group, label)| self.selection.rows(run, group, label));
        rows.filter(|row| is_unended(row)).count()
    }

    /// What a comparison is called.
    fn name(&self, problem: &str, index: usize) -> String {
        let (lower, higher) = &self.pairs[index];
        format!("{lower} against {higher}, {problem}")
    }

    /// The problem and the pair that each comparison is of, by its name.
    fn places(&self) -> BTreeMap<String, (&String, usize)> {
        let of_group = |group| (0..self.pairs.len()).map(move |index| (group, index));
        let all = self.selection.groups.iter().flat_map(of_group);
        all.map(|(group, index)| (self.name(group, index), (group, index))).collect()
    }

    /// The median of one side over the other's, its interval from the ends of both.
    fn compare(&self, sides: &BTreeMap<(usize, &str), Side>, problem: &str, index: usize) -> Option<Number> {
        let (lower, higher) = &self.pairs[index];
        let (one, other) = (sides.get(&(0, lower.as_str()))?, sides.get(&(1, higher.as_str()))?);
        let [from, to] = [one.interval, other.interval];
        let trials = [one.values.len(), other.values.len()];
        // A contender with one seed does not draw, unless the problem itself was drawn: one trial is then one of many.
        let fewest = if self.selection.study.is_drawn(problem) { 1 } else { 2 };
        let keeps = self.inclusions[index].is_kept(&one.ended, &other.ended);
        Some(Number {
            part: self.name(problem, index),
            value: Some(ratio(one.median, other.median)),
            // Wider than the interval of the ratio at either side's level, and so on the safe side.
            interval: Some(Interval::new(ratio(from[0], to[1]), ratio(from[1], to[0]))),
            least: Some(one.median),
            greatest: Some(other.median),
            n: trials[0].max(trials[1]),
            drawn: trials.into_iter().filter(|trials| *trials >= fewest).min(),
            above: usize::from(!keeps),
            ..Number::default()
        })
    }

    fn because(&self, numbers: &[Number]) -> Vec<String> {
        let all = compared(numbers, Ends::Measured);
        let label = self.metric.label.to_lowercase();
        let met = all.iter().filter(|one| one.value < Some(self.limit())).count();
        let by = if self.by_percent > 0.0 {
            format!(" by more than {} %", self.by_percent)
        } else {
            String::new()
        };
        let left = left_out(numbers);
        let all_of = self.pairs.len() * (self.selection.groups.len() - left.len());
        let left =
            (!left.is_empty()).then(|| format!("left out, for it cannot be posed: {}", left.join(", ")));
        let mut because = vec![format!("in {met} of {all_of} comparisons the median {label} is less{by}")];
        because.extend(left);
        because.extend(self.theorem(&all));
        because.extend(all.iter().map(|one| {
            let [low, high, ratio] = [one.least, one.greatest, one.value].map(Option::unwrap_or_default);
            format!("{}: {low:.4} against {high:.4}, ratio {ratio:.3}", one.part)
        }));
        because
    }

    /// What set inclusion says of the comparisons, where it says anything.
    fn theorem(&self, all: &[&Number]) -> Option<String> {
        let places = self.places();
        let kinds =
            all.iter().filter_map(|one| places.get(&one.part)).map(|(_, index)| self.inclusions[*index]);
        let kinds: Vec<Inclusion> = kinds.collect();
        let count = |kind| kinds.iter().filter(|own| **own == kind).count();
        let (longer, shorter) = (count(Inclusion::NeverLonger), count(Inclusion::NeverShorter));
        let equal = count(Inclusion::Equal);
        let broken = all.iter().filter(|one| one.above > 0).count();
        (longer + shorter + equal > 0).then(|| {
            let kept = match broken {
                0 => "the runs keep to both".to_owned(),
                broken => format!("{broken} of them do not keep to it, so the program is wrong"),
            };
            format!(
                "by set inclusion, on any map, {longer} of {} cannot be longer (all steps of the other are its own) and {} cannot \
                 be shorter; {kept}, and only the other {} are measured",
                all.len(),
                shorter + equal,
                all.len() - longer - shorter - equal
            )
        })
    }
}

/// The comparisons if cases without an end ended so.
fn compared(numbers: &[Number], ends: Ends) -> Vec<&Number> {
    parts(numbers, ends).into_iter().filter(|part| part.value.is_some()).collect()
}

/// The problems that could not be posed.
fn left_out(numbers: &[Number]) -> Vec<&str> {
    let parts = parts(numbers, Ends::Measured).into_iter();
    parts.filter(|part| part.value.is_none()).map(|part| part.part.as_str()).collect()
}

/// The comparison that shows what was found: one that breaks a theorem, or else the largest.
fn shown<'n>(all: &[&'n Number]) -> Option<&'n Number> {
    let broken = all.iter().find(|one| one.above > 0).copied();
    broken.or_else(|| largest(all))
}

fn largest<'n>(all: &[&'n Number]) -> Option<&'n Number> {
    let ratio = |one: &Number| one.value.unwrap_or_default();
    all.iter().copied().max_by(|a, b| ratio(a).total_cmp(&ratio(b)))
}

/// What comparisons say whose ratios are all claimed to be below `limit`; that one breaks a theorem speaks against all of it.
fn outcome(all: &[&Number], limit: f64) -> Outcome {
    let intervals = || all.iter().filter_map(|one| one.interval);
    if all.iter().any(|one| one.above > 0) {
        return Outcome::Fails;
    }
    if intervals().all(|ends| ends.high < limit) {
        return Outcome::Holds;
    }
    if intervals().all(|ends| ends.low < limit) {
        return Outcome::Open;
    }
    // Some ratio is certainly not below the margin; where every one is certainly below 1, the sign is right.
    let is_less = intervals().all(|ends| ends.high < 1.0);
    if is_less { Outcome::SignOnly } else { Outcome::Fails }
}

fn ratio(a: f64, b: f64) -> f64 {
    // Two zeros and two failures are equal, and so are sums of the same steps in another order.
    let ratio = a / b;
    if a == b || (ratio - 1.0).abs() <= EQUAL { 1.0 } else { ratio }
}

impl Criterion for LeastOf<'_> {
    /// Every comparison and every problem that could not be posed, a part each.
    fn numbers(&self, evidence: &Evidence<'_>) -> Vec<Number> {
        let Some(run) = self.selection.run(evidence) else { return vec![Number::default()] };
        let unended = self.unended(run);
        let posed = self.posed(run);
        let left = self.selection.groups.iter().filter(|group| !posed.contains(group));
        let left = left.map(|group| Number { part: group.clone(), ..Number::default() });
        let ends = Ends::ALL.into_iter().filter(|ends| *ends == Ends::Measured || unended > 0);
        let compared = ends.flat_map(|ends| self.compared(run, ends));
        std::iter::once(Number { unended, ..Number::default() }).chain(left).chain(compared).collect()
    }

    fn weigh(&self, numbers: &[Number]) -> CriterionResult {
        let all = compared(numbers, Ends::Measured);
        let outcome = self.outcome(numbers, Ends::Measured);
        let ours = largest(&all).and_then(|one| one.found().zip(Some(one))).map(|((ratio, ends), one)| {
            let metric = self.metric.label.to_lowercase();
            let what = format!(
                "% of the other's median {metric}, failures infinite, the largest of {}: {}",
                all.len(),
                one.part
            );
            let is_finite = ends.low.is_finite() && ends.high.is_finite();
            let interval = is_finite.then_some([100.0 * ends.low, 100.0 * ends.high]);
            let ours = Estimate { interval, ..Estimate::bare(100.0 * ratio, what, one.n) };
            ours.measures(Quantity::PercentOfOther, format!("median {metric}"))
        });
        let unended = whole(numbers).unended;
        let is_turned = unended > 0
            && [Ends::Least, Ends::Most].into_iter().any(|ends| self.outcome(numbers, ends) != outcome);
        let is_few = |one: &&Number| one.drawn.is_some_and(|trials| trials < FEWEST_SEEDS);
        CriterionResult {
            outcome: Some(outcome),
            ours,
            censored: if is_turned { unended } else { 0 },
            because: self.because(numbers),
            limits: vec![100.0 * self.limit()],
            units: "seeds",
            needs: Some(FEWEST_SEEDS).filter(|_| all.iter().any(is_few)),
            ..CriterionResult::default()
        }
    }

    fn show(&self, evidence: &Evidence<'_>, numbers: &[Number], found: &mut CriterionResult) {
        let places = self.places();
        let shown = shown(&compared(numbers, Ends::Measured)).and_then(|one| places.get(&one.part).copied());
        let Some(((problem, index), run)) = shown.zip(self.selection.run(evidence)) else { return };
        let first = self.selection.rows(run, problem, &self.pairs[index].0).into_iter().next();
        found.trial = first.map(|row| run.trial(row));
    }

    fn selections(&self) -> Vec<&Selection<'_>> {
        vec![&self.selection]
    }
}

#[cfg(test)]
mod tests;
