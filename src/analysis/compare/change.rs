//! Changes from one side to the other, metric by metric, with their intervals.

use super::pair::{Pair, Unit};
use super::run::Times;
use crate::analysis::metric::{Better, Metric};
use crate::analysis::statistic::{FEWEST_INSTANCES, LEVEL, PLAN};
use serde::Serialize;
use stats::bootstrap::{Estimate, Resampling};
use stats::interval::Interval;
use stats::paired::{Signs, signs};
use stats::{pooled, summary};
use std::collections::BTreeMap;
use study::record::{Row, Status};

/// The name under which the share of solved problems is compared, in per cent; its changes are in points.
pub const SOLVED: &str = "solved";

/// Stands for the number of a side that did not solve the problem: larger than any, and the middle between it and its
/// opposite is a number.
const FAILED: f64 = 1e300;

/// What has changed of one metric of one contender.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Change {
    /// The study.
    pub study: String,
    /// The contender, or the two.
    pub contender: String,
    /// The metric.
    pub metric: String,
    /// Its unit; empty for counts.
    pub unit: String,
    /// Which way is better: `lower` or `higher`.
    pub better: String,
    /// Pairs in which both sides have a number.
    pub pairs: usize,
    /// Pairs in which only the first side has a number, as the other did not solve the problem; then those in which only the second
    /// has one.
    pub one_sided: [usize; 2],
    /// How many instances were drawn independently, over all pairs.
    pub instances: usize,
    /// The mean of each side, over pairs in which both have a number.
    pub means: Option<[f64; 2]>,
    /// The change of the mean, in the unit.
    pub mean_change: Option<Measured>,
    /// The change of the mean in per cent of the first side's; `None` if that mean is not above 0.
    pub mean_change_percent: Option<Measured>,
    /// The median of the changes of all pairs, in the unit; a side that did not solve the problem counts as infinite.
    pub median_change: Option<Measured>,
    /// The share of pairs, in per cent, in which the second side is better; ties count half.
    pub improvement_percent: Option<Measured>,
    /// Pairs in which the second side is better.
    pub wins: usize,
    /// Pairs in which neither is.
    pub ties: usize,
    /// Pairs in which the first side is better.
    pub losses: usize,
    /// Whether the interval of the mean's change shows a change, and which.
    pub word: Word,
}

/// A number with its interval; an end that is not finite is none in JSON.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Measured {
    /// The number.
    pub value: f64,
    /// Its interval; `None` of fewer than two instances.
    pub interval: Option<[f64; 2]>,
}

/// What an interval says of a change.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Word {
    /// No pair differs.
    Equal,
    /// The second side is better.
    Better,
    /// The second side is worse.
    Worse,
    /// The interval holds zero change, or there are too few instances for an interval.
    Open,
}

impl Word {
    /// It as people read it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Equal => "equal",
            Self::Better => "better",
            Self::Worse => "worse",
            Self::Open => "open",
        }
    }
}

/// The numbers of all pairs of one metric of one contender.
pub struct Sample<'r> {
    pub study: &'r str,
    pub contender: &'r str,
    pub metric: &'static str,
    pub unit: &'static str,
    pub better: Better,
    pub is_time: bool,
    pub one_sided: [usize; 2],
    /// Both numbers of each pair by unit; a side that did not solve the problem has a number worse than any.
    by_unit: BTreeMap<Unit<'r>, Vec<(f64, f64)>>,
}

impl<'r> Sample<'r> {
    /// Whether problems are solved: 100 or 0 each.
    pub fn solved(study: &'r str, contender: &'r str, pairs: &[Pair<'r>]) -> Self {
        let share = |row: &Row| if row.status == Status::Solved { 100.0 } else { 0.0 };
        let mut sample = Self::empty(study, contender, SOLVED, "%", Better::Higher);
        for pair in pairs {
            let [first, second] = pair.rows.map(share);
            sample.by_unit.entry(pair.unit).or_default().push((first, second));
        }
        sample
    }

    /// A metric.
    pub fn of_metric(
        study: &'r str,
        contender: &'r str,
        metric: &'static Metric,
        pairs: &[Pair<'r>],
        times: [&Times<'r>; 2],
    ) -> Self {
        let readers = times.map(|times| metric.reader(|row| times.get(&row.key).copied()));
        let mut sample = Self::empty(study, contender, metric.name, &metric.unit, metric.better);
        sample.is_time = metric.is_time();
        let failed = sample.worse() * FAILED;
        for pair in pairs {
            let is_solved = pair.rows.map(|row| row.status == Status::Solved);
            let number = |side: usize| readers[side](pair.rows[side]).filter(|_| is_solved[side]);
            let numbers = match (number(0), number(1)) {
                (Some(first), Some(second)) => (first, second),
                (Some(first), None) if !is_solved[1] => {
                    sample.one_sided[0] += 1;
                    (first, failed)
                }
                (None, Some(second)) if !is_solved[0] => {
                    sample.one_sided[1] += 1;
                    (failed, second)
                }
                _ => continue,
            };
            sample.by_unit.entry(pair.unit).or_default().push(numbers);
        }
        sample
    }

    fn empty(
        study: &'r str,
        contender: &'r str,
        metric: &'static str,
        unit: &'static str,
        better: Better,
    ) -> Self {
        let one_sided = [0, 0];
        let by_unit = BTreeMap::new();
        let is_time = false;
        Self { study, contender, metric, unit, better, is_time, one_sided, by_unit }
    }

    /// 1 if a larger number is worse, −1 if a smaller one is.
    pub fn worse(&self) -> f64 {
        if self.better == Better::Higher { -1.0 } else { 1.0 }
    }

    /// How many pairs it has.
    pub fn pairs(&self) -> usize {
        self.by_unit.values().map(Vec::len).sum()
    }

    /// How many instances it has.
    pub fn instances(&self) -> usize {
        self.by_unit.len()
    }

    /// Pairs that both sides have a number of, by unit.
    fn finite(&self) -> Vec<Vec<(f64, f64)>> {
        let is_finite = |(first, second): &&(f64, f64)| first.abs() < FAILED && second.abs() < FAILED;
        let of_unit = |pairs: &Vec<(f64, f64)>| pairs.iter().filter(is_finite).copied().collect::<Vec<_>>();
        self.by_unit.values().map(of_unit).filter(|pairs| !pairs.is_empty()).collect()
    }

    /// The change of the mean, in the unit and in per cent of the first side's. Instances that all agree leave no width, unlike for
    /// a claim: a run that repeats another has not changed, whatever other instances might do.
    pub fn mean_changes(&self, plan: Resampling) -> [Option<Estimate>; 2] {
        let units = self.finite();
        let sums = |of: fn(&(f64, f64)) -> [f64; 2]| -> Vec<[f64; 2]> {
            let add = |sum: [f64; 2], pair: &(f64, f64)| [sum[0] + of(pair)[0], sum[1] + of(pair)[1]];
            units.iter().map(|pairs| pairs.iter().fold([0.0, 0.0], add)).collect()
        };
        let percent = |ratio: f64| 100.0 * (ratio - 1.0);
        let of_ratio = |ratio: Estimate| {
            let interval = Interval::new(percent(ratio.interval.low), percent(ratio.interval.high));
            Estimate { value: percent(ratio.value), interval, ..ratio }
        };
        let change = pooled::ratio_of_sums(&sums(|(first, second)| [second - first, 1.0]), plan);
        let ratio = pooled::ratio_of_sums(&sums(|(first, second)| [*second, *first]), plan);
        [change, ratio.map(of_ratio)]
    }

    /// The change as a whole.
    pub fn change(&self) -> Change {
        let finite = self.finite().concat();
        let all = self.by_unit.values().flatten().copied().collect::<Vec<_>>();
        let mean = |of: fn(&(f64, f64)) -> f64| summary::mean(&finite.iter().map(of).collect::<Vec<_>>());
        let means = mean(|pair| pair.0).zip(mean(|pair| pair.1));
        let [change, percent] = self.mean_changes(PLAN);
        let Signs { lower, equal, higher } = signs(&all);
        let (wins, losses) = if self.worse() > 0.0 { (lower, higher) } else { (higher, lower) };
        Change {
            study: self.study.to_owned(),
            contender: self.contender.to_owned(),
            metric: self.metric.to_owned(),
            unit: self.unit.to_owned(),
            better: self.better.name().to_owned(),
            pairs: finite.len(),
            one_sided: self.one_sided,
            instances: self.instances(),
            means: means.map(|(first, second)| [first, second]),
            mean_change: Measured::new(means.map(|(first, second)| second - first), change),
            mean_change_percent: means
                .filter(|(first, _)| *first > 0.0)
                .and_then(|(first, second)| Measured::new(Some(100.0 * (second / first - 1.0)), percent)),
            median_change: self.median(&all),
            improvement_percent: self.improvement(&all, wins, equal),
            wins,
            ties: equal,
            losses,
            word: self.word(change.as_ref(), equal == all.len()),
        }
    }

    fn median(&self, all: &[(f64, f64)]) -> Option<Measured> {
        let change = |(first, second): &(f64, f64)| second - first;
        let of_unit = |pairs: &Vec<(f64, f64)>| pairs.iter().map(change).collect::<Vec<_>>();
        let found = pooled::median(&self.by_unit.values().map(of_unit).collect::<Vec<_>>(), PLAN);
        let median = summary::median(&all.iter().map(change).collect::<Vec<_>>());
        Measured::new(median, found).map(Measured::unbounded)
    }

    fn improvement(&self, all: &[(f64, f64)], wins: usize, ties: usize) -> Option<Measured> {
        let hits = |pairs: &Vec<(f64, f64)>| {
            let Signs { lower, equal, higher } = signs(pairs);
            let won = if self.worse() > 0.0 { lower } else { higher };
            [100.0 * (won as f64 + 0.5 * equal as f64), pairs.len() as f64]
        };
        let found = pooled::ratio_of_sums(&self.by_unit.values().map(hits).collect::<Vec<_>>(), PLAN);
        let share = 100.0 * (wins as f64 + 0.5 * ties as f64) / all.len() as f64;
        Measured::new((!all.is_empty()).then_some(share), found)
    }

    fn word(&self, change: Option<&Estimate>, is_equal: bool) -> Word {
        let worse = self.worse();
        match change.filter(|found| found.units >= FEWEST_INSTANCES).map(|found| found.interval) {
            _ if is_equal => Word::Equal,
            Some(interval) if interval.low * worse > 0.0 && interval.high * worse > 0.0 => Word::Worse,
            Some(interval) if interval.low * worse < 0.0 && interval.high * worse < 0.0 => Word::Better,
            _ => Word::Open,
        }
    }
}

/// A bootstrap for a gate: `lines` of them are looked at together, and all of them are to hold with [`LEVEL`].
pub fn joint_plan(lines: usize) -> Resampling {
    let lines = lines.max(1);
    Resampling {
        level: 1.0 - (1.0 - LEVEL) / lines as f64,
        resamples: PLAN.resamples * lines.min(10),
        ..PLAN
    }
}

impl Measured {
    /// A number with its interval, if it has one.
    pub fn new(value: Option<f64>, found: Option<Estimate>) -> Option<Self> {
        let interval = found.map(|found| [found.interval.low, found.interval.high]);
        value.map(|value| Self { value, interval })
    }

    /// The same with what stands for a failure infinite.
    fn unbounded(self) -> Self {
        let open = |end: f64| if end.abs() > FAILED / 4.0 { end.signum() * f64::INFINITY } else { end };
        Self { value: open(self.value), interval: self.interval.map(|ends| ends.map(open)) }
    }
}
