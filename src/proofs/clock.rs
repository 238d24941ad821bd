//! Whether printed times are ticks of a coarse clock, and how often random digits would look like ticks.

use super::exact::{Exact, Print};
use super::printed::{Digits, Printed};

/// A clock's tick as a fraction of a second.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Tick {
    /// Seconds …
    pub numerator: u32,
    /// … per this many ticks; neither is zero.
    pub denominator: u32,
}

/// The first and the last number of ticks that print so, the first above the last if there is none; no answer if 128 bits
/// do not suffice. `tick` is above 0.
pub fn ticks(print: Print, tick: Exact) -> Option<(i128, i128)> {
    Some(print.span().times(tick.recip())?.integers())
}

impl Tick {
    /// 1/64 s, the interrupt period of a PC clock (15.625 ms).
    pub const SIXTY_FOURTH: Self = Self { numerator: 1, denominator: 64 };

    /// How many ticks print as `seconds`; none if no whole number does. The fewest, where several do.
    pub fn count(self, seconds: Printed, digits: Digits) -> Option<u64> {
        let tick = Exact::new(i128::from(self.numerator), i128::from(self.denominator));
        let (first, last) = ticks(Print { printed: seconds, digits }, tick)?;
        let first = first.max(0);
        (first <= last).then(|| u64::try_from(first).ok()).flatten()
    }

    /// The share of all prints with `decimals` places that some whole number of ticks prints as.
    ///
    /// Counted over one period of the clock against the print (`numerator` seconds), so exactly.
    ///
    /// # Panics
    /// With more than 6 decimals: a million prints a second are enough to count.
    pub fn share_of_prints(self, decimals: u32, digits: Digits) -> f64 {
        assert!(decimals <= 6, "{decimals} decimals");
        let all = 10_i64.pow(decimals) * i64::from(self.numerator);
        // One period on, where no print has zero's two-sided set of values.
        let prints = (all..2 * all).map(|units| Printed::from_units(units, decimals));
        prints.filter(|&print| self.count(print, digits).is_some()).count() as f64 / all as f64
    }

    /// The probability that every one of `times` is a whole number of ticks when their digits are random,
    /// uniform over the prints of their own decimals and independent.
    ///
    /// For one tick named in advance. With a tick chosen among several, add up their chances.
    pub fn chance(self, times: &[Printed], digits: Digits) -> f64 {
        times.iter().map(|time| self.share_of_prints(time.decimals(), digits)).product()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn printed(text: &str) -> Printed {
        text.parse().unwrap()
    }

    #[test]
    fn the_arm_papers_times_are_ticks_of_a_sixty_fourth() {
        let tick = Tick::SIXTY_FOURTH;
        assert_eq!(tick.count(printed("11.9063"), Digits::Rounded), Some(762));
        assert_eq!(tick.count(printed("10.0625"), Digits::Rounded), Some(644));
        assert_eq!(tick.count(printed("11.9062"), Digits::Truncated), Some(762));
        assert_eq!(tick.count(printed("11.9063"), Digits::Truncated), None);
        assert_eq!(tick.count(printed("11.9100"), Digits::Unknown), None);
        let times = [printed("11.9063"), printed("10.0625")];
        // Four decimals: 64 ticks a second; 16 of them (2, 6, 10, …) are ties and may print either way.
        assert_eq!(tick.share_of_prints(4, Digits::Truncated), 64.0 / 1e4);
        assert_eq!(tick.share_of_prints(4, Digits::Rounded), 80.0 / 1e4);
        assert_eq!(tick.chance(&times, Digits::Truncated), 0.0064 * 0.0064);
    }

    #[test]
    fn ticks_are_what_writing_out_their_multiples_gives() {
        for (numerator, denominator) in [(1, 64), (1, 100), (1, 60), (3, 7), (2, 1)] {
            let tick = Tick { numerator, denominator };
            let mut hits = 0;
            for units in 0..600 {
                let print = Printed::from_units(units, 2);
                // The oracle multiplies in floats; no tick here falls within its slack of an end but on it.
                let seconds = |k: u32| f64::from(k) * f64::from(numerator) / f64::from(denominator);
                let found = (0..600).find(|&k| print.agrees(seconds(k), Digits::Unknown));
                assert_eq!(tick.count(print, Digits::Unknown), found.map(u64::from), "{print} of {tick:?}");
                hits += u32::from(found.is_some());
            }
            assert!(hits > 2, "{tick:?} is never met");
        }
        assert_eq!(Tick { numerator: 1, denominator: 100 }.share_of_prints(2, Digits::Rounded), 1.0);
        assert_eq!(Tick { numerator: 2, denominator: 1 }.share_of_prints(1, Digits::Rounded), 1.0 / 20.0);
    }
}
