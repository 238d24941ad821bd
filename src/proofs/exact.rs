//! Exact arithmetic on printed numbers: rationals of 128-bit integers and the spans of values that print alike.
//!
//! Every operation is checked: where 128 bits do not suffice it gives `None`, and the caller says that the number was
//! not checked. Nothing is decided by a float.

use super::printed::{Digits, Printed};
use num_rational::Ratio;
use num_traits::{CheckedAdd as _, CheckedDiv as _, CheckedMul as _, CheckedSub as _};
use stats::interval::Interval;

/// An exact rational number.
pub type Exact = Ratio<i128>;

/// A printed number and how its digits are read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Print {
    /// What is printed.
    pub printed: Printed,
    /// How its digits end.
    pub digits: Digits,
}

/// True values between two exact ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Span {
    /// The lower end.
    pub low: Exact,
    /// Whether the span holds its lower end.
    pub low_closed: bool,
    /// The upper end.
    pub high: Exact,
    /// Whether the span holds its upper end.
    pub high_closed: bool,
}

/// The whole number `n`.
pub fn whole(n: impl Into<i128>) -> Exact {
    Exact::from_integer(n.into())
}

/// `a + b`, if 128 bits suffice.
pub fn add(a: Exact, b: Exact) -> Option<Exact> {
    in_64_bits(a, b, Ratio::checked_add).or_else(|| a.checked_add(&b))
}

/// `a − b`, if 128 bits suffice.
pub fn sub(a: Exact, b: Exact) -> Option<Exact> {
    in_64_bits(a, b, Ratio::checked_sub).or_else(|| a.checked_sub(&b))
}

/// `a b`, if 128 bits suffice.
pub fn mul(a: Exact, b: Exact) -> Option<Exact> {
    in_64_bits(a, b, Ratio::checked_mul).or_else(|| a.checked_mul(&b))
}

/// `a / b`, if `b` is not 0 and 128 bits suffice.
pub fn div(a: Exact, b: Exact) -> Option<Exact> {
    if b == whole(0) {
        return None;
    }
    in_64_bits(a, b, Ratio::checked_div).or_else(|| a.checked_div(&b))
}

/// A rational of 64-bit integers: a processor divides these by itself, and printed numbers are seldom longer.
type Short = Ratio<i64>;

/// What `operation` gives where 64 bits suffice; equal to what 128 bits give, since a ratio is kept in lowest terms.
fn in_64_bits(a: Exact, b: Exact, operation: fn(&Short, &Short) -> Option<Short>) -> Option<Exact> {
    let short = |long: Exact| {
        Some(Short::new_raw(i64::try_from(*long.numer()).ok()?, i64::try_from(*long.denom()).ok()?))
    };
    operation(&short(a)?, &short(b)?).map(long)
}

fn long(short: Short) -> Exact {
    Exact::new_raw(i128::from(*short.numer()), i128::from(*short.denom()))
}

/// The greatest integer not above `a`.
pub fn floor(a: Exact) -> i128 {
    a.numer().div_euclid(*a.denom())
}

/// The least integer not below `a`.
pub fn ceil(a: Exact) -> i128 {
    let rest = i128::from(a.numer().rem_euclid(*a.denom()) > 0);
    floor(a) + rest
}

/// The least multiple of `1 / scale` whose square is not below `a`, which is not negative; `scale` is above 0.
pub fn root_above(a: Exact, scale: i64) -> Option<Exact> {
    let squared = ceil(mul(a, whole(i128::from(scale) * i128::from(scale)))?);
    let down = squared.max(0).isqrt();
    Some(Exact::new(down + i128::from(down * down < squared), i128::from(scale)))
}

/// As certificates write it: `3/8`, or `3` for a whole number.
pub fn spelled(a: Exact) -> String {
    a.to_string()
}

/// The nearest float, or one next to it.
pub fn float(a: Exact) -> f64 {
    *a.numer() as f64 / *a.denom() as f64
}

/// A value in decimals for people, rounded to `decimals` places.
pub fn decimal(a: Exact, decimals: usize) -> String {
    format!("{:.decimals$}", float(a))
}

/// The rational that a decimal (`0.25`, `-3`) or a fraction (`1/64`) spells; none if it is neither.
pub fn parse(text: &str) -> Option<Exact> {
    let number = |text: &str| -> Option<Exact> {
        let printed: Printed = text.trim().parse().ok()?;
        Some(Exact::new(i128::from(printed.units()), i128::from(printed.scale())))
    };
    match text.split_once('/') {
        Some((above, below)) => div(number(above)?, number(below)?),
        None => number(text),
    }
}

impl Print {
    /// The closed hull of the true values that print so.
    pub fn interval(self) -> Interval {
        self.printed.interval(self.digits)
    }

    /// Whether the true value `x` would print so.
    pub fn agrees(self, x: f64) -> bool {
        self.printed.agrees(x, self.digits)
    }

    /// The number that the digits say.
    pub fn value(self) -> Exact {
        long(Short::new(self.printed.units(), self.printed.scale()))
    }

    /// The true values that print so.
    pub fn span(self) -> Span {
        let ends = self.printed.half_units(self.digits);
        let half = 2 * self.printed.scale();
        Span {
            low: long(Short::new(ends.low, half)),
            low_closed: ends.low_closed,
            high: long(Short::new(ends.high, half)),
            high_closed: ends.high_closed,
        }
    }
}

impl Span {
    /// The one value `at`.
    pub fn point(at: Exact) -> Self {
        Self::closed(at, at)
    }

    /// Everything from `low` to `high`, both included.
    pub fn closed(low: Exact, high: Exact) -> Self {
        Self { low, low_closed: true, high, high_closed: true }
    }

    /// Whether `x` is a member.
    pub fn contains(&self, x: Exact) -> bool {
        (self.low < x || self.low_closed && self.low == x)
            && (x < self.high || self.high_closed && self.high == x)
    }

    /// Whether it has no member.
    pub fn is_empty(&self) -> bool {
        self.low > self.high || self.low == self.high && !(self.low_closed && self.high_closed)
    }

    /// What both hold; it may be empty.
    #[must_use]
    pub fn meet(&self, other: &Self) -> Self {
        let (low, low_closed) = match self.low.cmp(&other.low) {
            std::cmp::Ordering::Less => (other.low, other.low_closed),
            std::cmp::Ordering::Equal => (self.low, self.low_closed && other.low_closed),
            std::cmp::Ordering::Greater => (self.low, self.low_closed),
        };
        let (high, high_closed) = match self.high.cmp(&other.high) {
            std::cmp::Ordering::Less => (self.high, self.high_closed),
            std::cmp::Ordering::Equal => (self.high, self.high_closed && other.high_closed),
            std::cmp::Ordering::Greater => (other.high, other.high_closed),
        };
        Self { low, low_closed, high, high_closed }
    }

    /// The members that are not outside of the ends given.
    #[must_use]
    pub fn cut(&self, [least, most]: [Option<Exact>; 2]) -> Self {
        let mut cut = *self;
        if let Some(least) = least.filter(|least| *least > cut.low) {
            (cut.low, cut.low_closed) = (least, true);
        }
        if let Some(most) = most.filter(|most| *most < cut.high) {
            (cut.high, cut.high_closed) = (most, true);
        }
        cut
    }

    /// Whether the two have a member in common.
    pub fn meets(&self, other: &Self) -> bool {
        !self.meet(other).is_empty()
    }

    /// The sums of a member of each.
    pub fn plus(&self, other: &Self) -> Option<Self> {
        Some(Self {
            low: add(self.low, other.low)?,
            low_closed: self.low_closed && other.low_closed,
            high: add(self.high, other.high)?,
            high_closed: self.high_closed && other.high_closed,
        })
    }

    /// Every member times `factor`, which is above 0.
    pub fn times(&self, factor: Exact) -> Option<Self> {
        Some(Self { low: mul(self.low, factor)?, high: mul(self.high, factor)?, ..*self })
    }

    /// The quotients of a member by one of `other`; none if `other` may be 0, where they are unbounded.
    pub fn over(&self, other: &Self) -> Option<Self> {
        if other.high < whole(0) {
            return self.negated().over(&other.negated());
        }
        if other.low <= whole(0) {
            return None;
        }
        let [least, most] = [(other.low, other.low_closed), (other.high, other.high_closed)];
        // 0 over anything is 0, whether or not the divisor's end is a member.
        let end = |(a, is_member): (Exact, bool), (b, is_attained): (Exact, bool)| {
            Some((div(a, b)?, is_member && (is_attained || a == whole(0))))
        };
        let (low, low_closed) =
            end((self.low, self.low_closed), if self.low < whole(0) { least } else { most })?;
        let (high, high_closed) =
            end((self.high, self.high_closed), if self.high < whole(0) { most } else { least })?;
        Some(Self { low, low_closed, high, high_closed })
    }

    /// Every member with the other sign.
    #[must_use]
    pub fn negated(&self) -> Self {
        Self { low: -self.high, low_closed: self.high_closed, high: -self.low, high_closed: self.low_closed }
    }

    /// The squares of the members that are not negative; an empty span if there are none.
    pub fn squared(&self) -> Option<Self> {
        let cut = self.not_negative();
        Some(Self { low: mul(cut.low, cut.low)?, high: mul(cut.high, cut.high)?, ..cut })
    }

    /// The members that are not negative.
    #[must_use]
    pub fn not_negative(&self) -> Self {
        if self.low < whole(0) { Self { low: whole(0), low_closed: true, ..*self } } else { *self }
    }

    /// The first and the last whole number among the members; the first is above the last if there is none.
    pub fn integers(&self) -> (i128, i128) {
        let (mut first, mut last) = (ceil(self.low), floor(self.high));
        if !self.low_closed && whole(first) == self.low {
            first += 1;
        }
        if !self.high_closed && whole(last) == self.high {
            last -= 1;
        }
        (first, last)
    }

    /// Whether a multiple of `step`, which is above 0, is a member.
    pub fn has_multiple_of(&self, step: Exact) -> Option<bool> {
        let (first, last) = self.times(step.recip())?.integers();
        Some(first <= last)
    }
}

#[cfg(test)]
mod tests;
