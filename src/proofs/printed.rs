//! A printed number, kept as its digits.
//!
//! Papers round, truncate, and do both in one table. A printed number is therefore a set of true values, and
//! the set depends on how the digits end. Ends of the sets are exact: they are held in half units of the last
//! printed place.

use stats::interval::Interval;
use std::{fmt, str::FromStr};

/// A text is no printed decimal number.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("`{text}` is not a printed number; one looks like 14.65, -0.5 or 270, with 15 digits at most")]
pub struct NotANumber {
    /// The text found.
    pub text: String,
}

/// How the digits of a printed number end.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Digits {
    /// Rounded to nearest; a tie may have gone either way.
    Rounded,
    /// Rounded to nearest, a tie away from zero.
    HalfUp,
    /// Rounded to nearest, a tie to the even digit.
    HalfEven,
    /// Cut off, towards zero.
    Truncated,
    /// Rounded down, towards minus infinity.
    Floor,
    /// Rounded up, towards plus infinity.
    Ceiling,
    /// Rounded to nearest or cut off.
    Unknown,
    /// Any of the above.
    #[default]
    Any,
}

impl Digits {
    /// Every way, with the name that annotations and certificates use.
    pub const NAMED: [(&'static str, Self); 8] = [
        ("any", Self::Any),
        ("nearest", Self::Rounded),
        ("half up", Self::HalfUp),
        ("half even", Self::HalfEven),
        ("truncation", Self::Truncated),
        ("floor", Self::Floor),
        ("ceiling", Self::Ceiling),
        ("nearest or truncation", Self::Unknown),
    ];

    /// The name that annotations and certificates use.
    pub fn name(self) -> &'static str {
        Self::NAMED.iter().find(|(_, digits)| *digits == self).map_or("any", |(name, _)| name)
    }
}

/// One more than the greatest number that the digits without their point may be.
const LIMIT: u64 = 10_u64.pow(15);

/// A decimal number as printed: `units` in the last of `decimals` places.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Printed {
    units: i64,
    decimals: u32,
    /// How many digits count, where zeros at the end are not written.
    significant: Option<u32>,
}

/// The true values that print alike, in half units of the last place; an end is a member only if `closed`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct HalfUnits {
    pub(super) low: i64,
    pub(super) low_closed: bool,
    pub(super) high: i64,
    pub(super) high_closed: bool,
}

impl Printed {
    /// The number `units / 10^decimals`.
    ///
    /// # Panics
    /// With more than 15 digits, or more than 15 decimals: [`FromStr`] refuses such a text.
    pub fn from_units(units: i64, decimals: u32) -> Self {
        assert!(units.unsigned_abs() < LIMIT && decimals <= 15, "{units} with {decimals} decimals");
        Self { units, decimals, significant: None }
    }

    /// The number if `significant` digits count and zeros at its end were left out: with 6, 67.408 stands for 67.4080. None if
    /// it contradicts that: by a zero at the end of its decimals, or by more digits.
    pub fn with_zeros_left_out(self, significant: u32) -> Option<Self> {
        // Digits before the first one that counts are none: 0.097 has its first at the second decimal.
        let units = self.units.unsigned_abs();
        let length = if units == 0 { self.decimals + 1 } else { units.ilog10() + 1 };
        if self.decimals > 0 && units.is_multiple_of(10) || length > significant {
            return None;
        }
        let more = significant - length;
        let widened = 10_i64.checked_pow(more).and_then(|scale| self.units.checked_mul(scale));
        let widened = widened.filter(|units| units.unsigned_abs() < LIMIT && self.decimals + more <= 15);
        // Where 15 digits do not hold the zeros, the number is read as it is typed, which allows more.
        let (units, decimals) =
            widened.map_or((self.units, self.decimals), |units| (units, self.decimals + more));
        Some(Self { units, decimals, significant: Some(significant) })
    }

    /// The number as it was typed, without the zeros that [`with_zeros_left_out`](Self::with_zeros_left_out) adds.
    #[must_use]
    pub fn as_typed(mut self) -> Self {
        while self.significant.is_some() && self.decimals > 0 && self.units % 10 == 0 {
            (self.units, self.decimals) = (self.units / 10, self.decimals - 1);
        }
        Self { significant: None, ..self }
    }

    /// The number with all digits that it is read to have: 67.4080 where 67.408 has six that count.
    #[must_use]
    pub fn as_read(self) -> Self {
        Self { significant: None, ..self }
    }

    /// How many digits count, where zeros at the end are not written.
    pub fn significant(self) -> Option<u32> {
        self.significant
    }

    /// Another number with as many decimals, as it would be printed here; `units` are its digits without their point.
    /// None if it has too many digits.
    pub fn with_units(self, units: i64) -> Option<Self> {
        let other = (units.unsigned_abs() < LIMIT).then_some(Self { units, ..self })?;
        match self.significant {
            None => Some(other),
            Some(significant) => other.as_typed().with_zeros_left_out(significant),
        }
    }

    /// The number that the digits say.
    pub fn value(self) -> f64 {
        self.units as f64 / self.scale() as f64
    }

    /// How many digits stand after the point.
    pub fn decimals(self) -> u32 {
        self.decimals
    }

    /// The digits without their point: 1465 for 14.65.
    pub fn units(self) -> i64 {
        self.units
    }

    /// How many units of the last place make one: 100 for 14.65.
    pub fn scale(self) -> i64 {
        10_i64.pow(self.decimals)
    }

    /// The closed hull of the true values that would print so.
    ///
    /// The end that truncation would not reach (14.66 for a truncated 14.65) is included here and is not
    /// accepted by [`agrees`](Self::agrees).
    pub fn interval(self, digits: Digits) -> Interval {
        let ends = self.half_units(digits);
        let half = 2.0 * self.scale() as f64;
        Interval::new(ends.low as f64 / half, ends.high as f64 / half)
    }

    /// Whether the true value `x` would print so.
    ///
    /// A float within a billionth of the last place of an end counts as that end. Lengths on the lattice are
    /// decided without floats by [`lattice`](super::lattice).
    pub fn agrees(self, x: f64, digits: Digits) -> bool {
        let ends = self.half_units(digits);
        let y = x * 2.0 * self.scale() as f64;
        let slack = 1e-9 + 4.0 * f64::EPSILON * y.abs();
        let above = |end: i64, closed: bool| y > end as f64 + if closed { -slack } else { slack };
        let below = |end: i64, closed: bool| y < end as f64 + if closed { slack } else { -slack };
        above(ends.low, ends.low_closed) && below(ends.high, ends.high_closed)
    }

    pub(super) fn half_units(self, digits: Digits) -> HalfUnits {
        let centre = 2 * self.units;
        let from = |low: i64, low_closed: bool, high: i64, high_closed: bool| HalfUnits {
            low: centre + low,
            low_closed,
            high: centre + high,
            high_closed,
        };
        let is_even = self.units % 2 == 0;
        let sign = self.units.signum();
        match digits {
            Digits::Rounded => from(-1, true, 1, true),
            Digits::HalfUp => from(-1, sign > 0, 1, sign < 0),
            Digits::HalfEven => from(-1, is_even, 1, is_even),
            Digits::Truncated if sign > 0 => from(0, true, 2, false),
            Digits::Truncated if sign < 0 => from(-2, false, 0, true),
            Digits::Floor => from(0, true, 2, false),
            Digits::Ceiling => from(-2, false, 0, true),
            Digits::Unknown if sign > 0 => from(-1, true, 2, false),
            Digits::Unknown if sign < 0 => from(-2, false, 1, true),
            Digits::Truncated | Digits::Unknown | Digits::Any => from(-2, false, 2, false),
        }
    }
}

impl HalfUnits {
    /// Whether a value that compares with an end as `cmp` says of it is a member.
    pub(super) fn holds(self, mut cmp: impl FnMut(i64) -> std::cmp::Ordering) -> bool {
        let (low, high) = (cmp(self.low), cmp(self.high));
        (low.is_gt() || self.low_closed && low.is_eq()) && (high.is_lt() || self.high_closed && high.is_eq())
    }
}

impl FromStr for Printed {
    type Err = NotANumber;

    fn from_str(text: &str) -> Result<Self, NotANumber> {
        let refuse = || NotANumber { text: text.to_owned() };
        let (negative, body) = match text.strip_prefix(['-', '−']) {
            Some(body) => (true, body),
            None => (false, text),
        };
        let (whole, fraction) = body.split_once('.').unwrap_or((body, ""));
        let digits = format!("{whole}{fraction}");
        let well_formed = !whole.is_empty()
            && body.contains('.') != fraction.is_empty()
            && digits.len() <= 15
            && digits.bytes().all(|byte| byte.is_ascii_digit());
        if !well_formed {
            return Err(refuse());
        }
        let units: i64 = digits.parse().map_err(|_| refuse())?;
        Ok(Self::from_units(if negative { -units } else { units }, fraction.len() as u32))
    }
}

/// The number as it is typed.
impl fmt::Display for Printed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.significant.is_some() {
            return self.as_typed().fmt(f);
        }
        let sign = if self.units < 0 { "-" } else { "" };
        let units = self.units.abs();
        let scale = self.scale();
        write!(f, "{sign}{}", units / scale)?;
        if self.decimals > 0 {
            write!(f, ".{:0width$}", units % scale, width = self.decimals as usize)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn printed(text: &str) -> Printed {
        text.parse().unwrap()
    }

    #[test]
    fn digits_survive_reading_and_writing() {
        for text in ["14.65", "270.00", "8.5", "69", "0.0018", "-41", "-0.05", "0.00"] {
            assert_eq!(printed(text).to_string(), text);
        }
        assert_eq!(printed("270.00").decimals(), 2);
        assert_eq!(printed("−0.5").value(), -0.5);
        for text in ["", ".5", "5.", "1e3", "+4", "1 000", "14,65", "--1", "1.2.3", "1234567890123456", "4٣"]
        {
            assert_eq!(text.parse::<Printed>(), Err(NotANumber { text: text.to_owned() }));
        }
    }

    #[test]
    fn significant_digits_give_back_the_zeros_left_out() {
        for (text, full) in [
            ("2.5", "2.50000"),
            ("216", "216.000"),
            ("0.968027", "0.968027"),
            ("0.5", "0.500000"),
            ("-67.408", "-67.4080"),
            ("108226", "108226"),
            ("0", "0.00000"),
        ] {
            let read = printed(text).with_zeros_left_out(6).unwrap();
            assert_eq!((read.to_string(), read.as_typed()), (text.to_owned(), printed(text)));
            let full = printed(full);
            assert_eq!((read.units(), read.decimals()), (full.units(), full.decimals()), "{text}");
        }
        for text in ["1234567", "2.50", "0.0", "123.4567"] {
            assert_eq!(
                printed(text).with_zeros_left_out(6),
                None,
                "{text} contradicts six digits without zeros"
            );
        }
        // Next to 9.99999 stands 10, with one decimal fewer.
        let next = printed("9.99999").with_zeros_left_out(6).unwrap().with_units(1_000_000).unwrap();
        assert_eq!((next.to_string(), next.decimals()), ("10".to_owned(), 4));
    }

    #[test]
    fn the_interval_is_what_prints_so() {
        for (text, digits, low, high) in [
            ("14.65", Digits::Rounded, 14.645, 14.655),
            ("14.65", Digits::Truncated, 14.65, 14.66),
            ("14.65", Digits::Unknown, 14.645, 14.66),
            ("-14.65", Digits::Truncated, -14.66, -14.65),
            ("-14.65", Digits::Unknown, -14.66, -14.645),
            ("0.0", Digits::Truncated, -0.1, 0.1),
            ("69", Digits::Rounded, 68.5, 69.5),
        ] {
            assert_eq!(printed(text).interval(digits), Interval::new(low, high), "{text} {digits:?}");
        }
    }

    #[test]
    fn agreement_is_what_formatting_the_number_gives() {
        // The oracle writes the number out; the sample walks through ends and between them.
        let (mut yes, mut no) = (0, 0);
        for thousandth in -40_000..=40_000_i64 {
            let x = thousandth as f64 / 1000.0 + 1e-5;
            let rounded = format!("{x:.2}");
            let cut = x.abs() * 100.0;
            let truncated = Printed::from_units(cut.floor() as i64 * if x < 0.0 { -1 } else { 1 }, 2);
            assert!(printed(&rounded).agrees(x, Digits::Rounded), "{x} as {rounded}");
            assert!(truncated.agrees(x, Digits::Truncated), "{x} as {truncated}");
            for other in [printed(&rounded), truncated] {
                let either = other == printed(&rounded) || other == truncated;
                assert_eq!(other.agrees(x, Digits::Unknown), either);
                assert_eq!(other.agrees(x, Digits::Rounded), other == printed(&rounded), "{x} as {other}");
                let is_cut = other.agrees(x, Digits::Truncated);
                assert_eq!(is_cut, other == truncated, "{x} as {other}");
                if is_cut { yes += 1 } else { no += 1 }
            }
        }
        assert!(yes > 50_000 && no > 10_000, "one-sided sample: {yes} and {no}");
    }

    #[test]
    fn floats_at_an_end_count_as_the_end() {
        // 14.65 as a sum of floats may fall a bit short; 14.66 must not print as a truncated 14.65.
        assert!(printed("14.65").agrees(14.65 - 1e-14, Digits::Truncated));
        assert!(!printed("14.65").agrees(14.66 - 1e-14, Digits::Truncated));
        assert!(printed("14.65").agrees(14.655 + 1e-14, Digits::Rounded));
        assert!(!printed("0.0018").agrees(0.0019, Digits::Unknown));
        for digits in [Digits::Truncated, Digits::Unknown] {
            assert!(!printed("-14.65").agrees(-14.66, digits) && printed("-14.65").agrees(-14.65, digits));
            assert!(!printed("0.0").agrees(-0.1, digits) && printed("0.0").agrees(-0.09, digits));
        }
    }
}
