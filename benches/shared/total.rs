//! An `f64` in total order, as the crate `pathfinding` asks of costs.

use pathfinding::num_traits::Zero;
use std::cmp::Ordering;
use std::ops::Add;

/// An `f64` in total order.
#[derive(Clone, Copy, PartialEq)]
pub struct Total(pub f64);

impl Eq for Total {}

impl PartialOrd for Total {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Total {
    fn cmp(&self, other: &Self) -> Ordering {
        self.0.total_cmp(&other.0)
    }
}

impl Add for Total {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}

impl Zero for Total {
    fn zero() -> Self {
        Self(0.0)
    }

    fn is_zero(&self) -> bool {
        self.0 == 0.0
    }
}
