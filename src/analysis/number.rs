//! Numbers of stored trials under one interpretation: everything that a criterion weighs, and everything stored of an
//! exploration.
//!
//! A criterion takes its numbers from the trials once. It then compares them with a margin or a printed number, which
//! needs no trial. The first number of each list is the whole. The others are its parts, or its value if cases without
//! an end had ended.

use super::censored::{outside, refused};
use super::selection::{Instance, censored, solved, unended};
use stats::bootstrap::Estimate;
use stats::interval::Interval;

/// The values taken for cases without an end, or without a number that they may have had.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Ends {
    /// They are left out.
    #[default]
    Measured,
    /// They go one way as far as they can: the least numbers, misses, or a difference against the contender.
    Least,
    /// They go the other way as far as they can.
    Most,
}

impl Ends {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Measured, Self::Least, Self::Most];

    /// Its name in the table of estimates.
    pub fn name(self) -> &'static str {
        match self {
            Self::Measured => "measured",
            Self::Least => "least",
            Self::Most => "most",
        }
    }
}

/// One number with its interval, and what it rests on.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Number {
    /// Which comparison, sweep point or cell it belongs to, where a test has several; empty for the whole.
    pub part: String,
    /// The values taken for cases without an end.
    pub ends: Ends,
    /// The number.
    pub value: Option<f64>,
    /// Its interval.
    pub interval: Option<Interval>,
    /// Whether all instances agree on it.
    pub is_agreed: bool,
    /// Whether the interval is exact, however few the instances.
    pub is_exact: bool,
    /// The independent units that it rests on.
    pub n: usize,
    /// The instances that ran.
    pub ran: usize,
    /// The instances that have what is compared.
    pub measured: usize,
    /// The instances of groups that are drawn; none if no group is.
    pub drawn: Option<usize>,
    /// Cases that are solved by everyone who is compared.
    pub solved: usize,
    /// Cases.
    pub total: usize,
    /// Cases without an end, whose outcome could go either way.
    pub unended: usize,
    /// Cases without a number, though they could have had one.
    pub censored: usize,
    /// Cases with a path that the verifier refuses.
    pub refused: usize,
    /// Cases to which a claim about what is solved does not apply.
    pub outside: usize,
    /// Cases below what they are compared with, or cases for the claim.
    pub below: usize,
    /// Cases that are equal.
    pub equal: usize,
    /// Cases above, or cases against the claim.
    pub above: usize,
    /// Hits.
    pub hits: f64,
    /// Chances.
    pub chances: f64,
    /// The least number.
    pub least: Option<f64>,
    /// The greatest.
    pub greatest: Option<f64>,
    /// The standard deviation over the units.
    pub deviation: Option<f64>,
    /// Numbers in order, where one alone does not say enough: one an instance, or a cell's products with others.
    pub values: Vec<f64>,
}

impl Number {
    /// The counts over all cases of `instances`.
    pub fn of_cases(instances: &[Instance<'_>]) -> Self {
        let [solved, total] = solved(instances);
        Self {
            ran: instances.len(),
            solved,
            total,
            unended: unended(instances),
            censored: censored(instances),
            refused: refused(instances),
            outside: outside(instances),
            ..Self::default()
        }
    }

    /// These counts with an estimate, if there is one.
    #[must_use]
    pub fn estimated(self, found: Option<Estimate>) -> Self {
        let Some(Estimate { value, interval, is_agreed, units, .. }) = found else { return self };
        Self { value: Some(value), interval: Some(interval), is_agreed, n: units, ..self }
    }

    /// The interval that results if cases without an end take these values.
    pub fn ended(ends: Ends, interval: Interval) -> Self {
        Self { ends, interval: Some(interval), ..Self::default() }
    }

    /// Whether both numbers of every case are equal.
    pub fn is_tied(&self) -> bool {
        self.equal > 0 && self.below + self.above == 0
    }

    /// The value with its interval.
    pub fn found(&self) -> Option<(f64, Interval)> {
        self.value.zip(self.interval)
    }

    /// The cases that are solved, and all.
    pub fn cases(&self) -> [usize; 2] {
        [self.solved, self.total]
    }
}

/// The intervals of the whole if cases without an end had ended.
pub fn ended(numbers: &[Number]) -> impl Iterator<Item = Interval> {
    let ended = numbers.iter().filter(|number| number.ends != Ends::Measured && number.part.is_empty());
    ended.filter_map(|number| number.interval)
}

/// The parts, as cases that ended so give them.
pub fn parts(numbers: &[Number], ends: Ends) -> Vec<&Number> {
    numbers.iter().filter(|number| number.ends == ends && !number.part.is_empty()).collect()
}

/// The whole, as it was measured.
///
/// # Panics
/// If there is none: a criterion's numbers begin with it.
pub fn whole(numbers: &[Number]) -> &Number {
    &numbers[0]
}

/// The numbers of one question under one interpretation, and how the trials behind them came about.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Numbers {
    /// The numbers. Those that rest on the clock come once for each stored session, once if none is stored.
    pub by_session: Vec<Vec<Number>>,
    /// The stored sessions of the clock; 0 for numbers that rest on none.
    pub sessions: usize,
    /// Whether trials of all studies that it looks at ran under the interpretation.
    pub is_covered: bool,
    /// Whether every problem group that it looks at could be posed.
    pub is_posed: bool,
    /// The share of returned paths that the verifier refuses, from 0 to 1.
    pub refused: f64,
    /// Cases without an end in instances that do not count.
    pub left_out: usize,
    /// A hash of the trials' results, if it was requested.
    pub trials: String,
}
