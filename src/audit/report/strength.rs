//! The power of a test: how much of what could be printed it refuses.

use super::effort::Effort;
use crate::checks::{Test, Window};
use proofs::exact::{Exact, Print, ceil, floor, mul, whole};
use proofs::printed::Printed;
use std::fmt;

/// The share of printable values that a check would have refused.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Power {
    /// The least printable value that was tried …
    pub low: Printed,
    /// … and the greatest.
    pub high: Printed,
    /// How many were tried: all of them, or a spread-out sample.
    pub tried: usize,
    /// How many of them the check refuses.
    pub refused: usize,
    /// Why this range.
    pub why: &'static str,
    /// Whether the check refuses what is printed, and that lies outside of the range.
    pub is_beyond: bool,
}

impl Power {
    /// The share refused.
    pub fn share(self) -> f64 {
        self.refused as f64 / self.tried.max(1) as f64
    }

    /// The same where the check refuses `printed` itself, which a sample may have left out: a power of nothing beside a
    /// refusal would be wrong.
    #[must_use]
    pub(super) fn beside_a_refusal(self, printed: Printed) -> Self {
        let is_beyond = !(self.low.units()..=self.high.units()).contains(&printed.units());
        let one = usize::from(!is_beyond && self.refused == 0);
        Self { is_beyond, tried: self.tried + one, refused: self.refused + one, ..self }
    }
}

/// In words: the share of refused prints, the prints that were tried, and why these.
impl fmt::Display for Power {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { low, high, tried, refused, why, is_beyond } = self;
        let share = format!("{:.0}", 100.0 * self.share());
        // No rounding to nothing or to all.
        let share = match share.as_str() {
            "0" if *refused > 0 => "less than 1".to_owned(),
            "100" if refused < tried => "more than 99".to_owned(),
            _ => share,
        };
        write!(f, "refuses {share} % of {tried} values from {low} to {high}, {why}")?;
        if *is_beyond { write!(f, ", and what is printed beyond them") } else { Ok(()) }
    }
}

/// How much of what could be printed instead of the first number the test refuses; `None` if the effort does not suffice.
pub(super) fn power(test: &dyn Test, prints: &[Print], most: i128, effort: &Effort) -> Option<Power> {
    let first = prints[0].printed;
    let (low, high, why) = window(test, first)?;
    let count = i128::from(high - low) + 1;
    let is_sampled = count > most;
    let mut tried = 0;
    let mut refused = 0;
    let mut all = prints.to_vec();
    for index in 0..count.min(most) {
        // Multiples of the golden section spread evenly and fall in step with no grid.
        let share = (index as f64 * 0.618_033_988_749_894_9).fract();
        let at = if is_sampled { (share * count as f64) as i64 } else { index as i64 };
        let Some(printed) = first.with_units(low + at) else { continue };
        if effort.is_used_up() {
            return None;
        }
        all[0].printed = printed;
        tried += 1;
        refused += usize::from(effort.decide_change(test, &all) == Some(false));
    }
    let end = |units| Printed::from_units(units, first.decimals());
    Some(Power { low: end(low), high: end(high), tried, refused, why, is_beyond: false })
}

/// The least and the greatest print of the first number, in units of its last place, and why these.
pub fn window(test: &dyn Test, first: Printed) -> Option<(i64, i64, &'static str)> {
    let limit = 10_i64.pow(15) - 1;
    let (low, high, why) = if let Some(Window { ends: [low, high], why }) = test.window() {
        let units = |end: Exact| mul(end, whole(first.scale()));
        (i64::try_from(ceil(units(low)?)).ok()?, i64::try_from(floor(units(high)?)).ok()?, why)
    } else {
        let around = first.units().abs().max(100);
        let why = if first.units().abs() < 100 {
            "100 units of the last place to either side"
        } else {
            "between 0 and twice the printed one"
        };
        (first.units() - around, first.units() + around, why)
    };
    let (low, high) = (low.max(-limit), high.min(limit));
    (low <= high).then_some((low, high, why))
}
