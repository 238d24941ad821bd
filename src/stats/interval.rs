//! The closed interval of the real line that audits and statistics share.

/// All reals from `low` to `high`, both ends included; an end may be infinite.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// The least member.
    pub low: f64,
    /// The greatest member.
    pub high: f64,
}

impl Interval {
    /// The interval from `low` to `high`.
    ///
    /// # Panics
    /// If `low <= high` does not hold, NaN included.
    pub fn new(low: f64, high: f64) -> Self {
        assert!(low <= high, "an interval from {low} to {high}");
        Self { low, high }
    }

    /// Whether `x` lies in the interval.
    pub fn contains(self, x: f64) -> bool {
        self.low <= x && x <= self.high
    }

    /// Whether the two have a point in common; touching ends count.
    pub fn meets(self, other: Self) -> bool {
        self.low <= other.high && other.low <= self.high
    }

    /// Half of the distance between the ends.
    pub fn half_width(self) -> f64 {
        (self.high - self.low) / 2.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intervals_meet_exactly_when_they_share_a_point() {
        let unit = Interval::new(0.0, 1.0);
        for (low, high, meets) in [(1.0, 2.0, true), (-1.0, 0.0, true), (1.5, 2.0, false), (0.2, 0.3, true)] {
            let other = Interval::new(low, high);
            assert_eq!(unit.meets(other), meets, "{other:?}");
            assert_eq!(other.meets(unit), meets, "{other:?}");
        }
        assert!(unit.contains(1.0) && !unit.contains(1.1) && !unit.contains(-0.1));
        assert_eq!(Interval::new(-1.0, 3.0).half_width(), 2.0);
    }
}
