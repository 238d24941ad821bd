//! Intervals for a share of independent trials, and where one value ranks among instances.
//!
//! Special functions come from `libm`, so that the same counts give the same bits everywhere.

use super::{paired, summary};
use crate::interval::Interval;

/// The normal quantile: the `z` below which a standard normal value falls with probability `share`.
///
/// Solved by bisection on `libm::erfc` to the last bit that moves it.
///
/// # Panics
/// If `share` is not inside (0, 1).
pub fn normal_quantile(share: f64) -> f64 {
    assert!(share > 0.0 && share < 1.0, "a normal quantile at {share}; shares lie inside (0, 1)");
    if share > 0.5 {
        return -normal_quantile(1.0 - share);
    }
    bisect(-40.0, 0.0, |z| libm::erfc(-z / std::f64::consts::SQRT_2) / 2.0 < share)
}

/// The two-sided normal multiplier of a `level`: 1.96 for 0.95.
pub fn normal_multiplier(level: f64) -> f64 {
    normal_quantile(f64::midpoint(1.0, level))
}

/// Wilson's score interval for a share, from `hits` of `trials`; none without trials.
///
/// # Panics
/// If `hits > trials`, or `level` is not inside (0, 1).
///
/// # Source
/// Wilson, JASA 22 (1927) 209–212; Brown, Cai & `DasGupta`, Statistical Science 16 (2001) 101–133, eq. 4.
pub fn wilson(hits: usize, trials: usize, level: f64) -> Option<Interval> {
    assert!(hits <= trials, "{hits} hits in {trials} trials");
    (trials > 0).then(|| wilson_of_share(hits as f64 / trials as f64, trials as f64, level))
}

/// Clopper and Pearson's exact interval for a share, from `hits` of `trials`; none without trials.
///
/// # Panics
/// If `hits > trials`, or `level` is not inside (0, 1).
///
/// # Source
/// Clopper & Pearson, Biometrika 26 (1934) 404–413.
pub fn clopper_pearson(hits: usize, trials: usize, level: f64) -> Option<Interval> {
    assert!(hits <= trials && level > 0.0 && level < 1.0, "{hits} hits in {trials} trials at level {level}");
    let tail = (1.0 - level) / 2.0;
    let least = |hits: usize| bisect(0.0, 1.0, |share| at_least(hits, trials, share) < tail);
    (trials > 0).then(|| {
        let low = if hits == 0 { 0.0 } else { least(hits) };
        // P(X ≤ hits) at a share is P(X ≥ trials − hits) at its complement.
        let high = if hits == trials { 1.0 } else { 1.0 - least(trials - hits) };
        Interval::new(low, high)
    })
}

/// An interval for a share, from `instances` of hits and chances that all agree on it, whatever they are drawn from; none for other
/// instances, and without any.
///
/// So many as agree leave, at the level, at most a part m of all instances that differ, with (1 − m)ⁿ = (1 − level) / 2. Those
/// may be hits throughout or misses throughout, so that a share v lies from v − m·v to v + m·(1 − v). At v = 1 or 0 this is
/// exact: if the values are in [0, 1], P(all are 1) ≤ meanⁿ. Between them, v was not known before it was drawn. That all agree on
/// a value that fewer than 1 − m of the instances have is no likelier than (1 − m)ⁿ⁻¹, below 5 % from six instances on at 0.95.
/// Instances of unequal chances weigh unequally, and one that differs may be the largest: the interval is wider by the `most`
/// chances that an instance can have, or that one has, over the mean number.
///
/// # Panics
/// If `level` is not inside (0, 1).
///
/// # Source
/// Clopper & Pearson, Biometrika 26 (1934) 404–413, at n of n; P(X = 1) ≤ E X for X in [0, 1] is Markov's inequality.
pub fn mean_of_agreed(instances: &[[f64; 2]], most: f64, level: f64) -> Option<Interval> {
    assert!(level > 0.0 && level < 1.0, "an interval at level {level}");
    let [first_hits, first_chances] = *instances.first()?;
    let is_same = |[hits, chances]: &[f64; 2]| *chances > 0.0 && hits * first_chances == first_hits * chances;
    let [seen, all] = instances
        .iter()
        .fold([0.0, 0.0], |[seen, all]: [f64; 2], [_, chances]| [seen.max(*chances), all + chances]);
    let differ = may_differ(instances.len(), level) * most.max(seen) * instances.len() as f64 / all;
    instances.iter().all(is_same).then(|| {
        let share = first_hits / first_chances;
        Interval::new((share - share * differ).max(0.0), (share + (1.0 - share) * differ).min(1.0))
    })
}

/// The most of all instances that may differ where `n` agree, at the level: m of [`mean_of_agreed`].
pub fn may_differ(n: usize, level: f64) -> f64 {
    1.0 - libm::pow((1.0 - level) / 2.0, 1.0 / n as f64)
}

/// The interval of the mean of numbers that cannot leave `[least, most]` and all agree: a part m of all may differ, at the level, by
/// as much as the ends let it. None for other numbers.
pub fn agreed_between(values: &[f64], [least, most]: [f64; 2], level: f64) -> Option<Interval> {
    let value = *values.first()?;
    let differ = may_differ(values.len(), level);
    let is_agreed = values.iter().all(|other| *other == value);
    is_agreed.then(|| Interval::new(value - differ * (value - least), value + differ * (most - value)))
}

/// The interval of the ratio of two sums, `[above, below]` of each instance, where every instance has the same ratio; none for other
/// instances, for fewer than two, or without anything below.
///
/// As in [`mean_of_agreed`] a part m of all instances may differ. A ratio has no end above, so those need a word:
/// in them the number above is off by no more than the larger of the instance's two numbers. A ratio v then lies within
/// v ± m·max(1, |v|), as much wider as the largest instance has below over the mean one, and not below 0 if no number is. Ratios that
/// rounding alone parts agree.
///
/// # Panics
/// If `level` is not inside (0, 1).
pub fn ratio_of_agreed(instances: &[[f64; 2]], level: f64) -> Option<Interval> {
    assert!(level > 0.0 && level < 1.0, "an interval at level {level}");
    let [above, below] = instances.iter().fold([0.0, 0.0], |sum, [a, b]| [sum[0] + a, sum[1] + b]);
    let ratio = above / below;
    let is_same = |[a, b]: &[f64; 2]| *b >= 0.0 && (a - ratio * b).abs() <= paired::EQUAL * (ratio * b).abs();
    if instances.len() < 2 || below.is_nan() || below <= 0.0 || !instances.iter().all(is_same) {
        return None;
    }
    let most = instances.iter().map(|[_, b]| *b).fold(0.0, f64::max);
    let wider = most * instances.len() as f64 / below;
    let half = may_differ(instances.len(), level) * wider * ratio.abs().max(1.0);
    let low = if ratio < 0.0 { ratio - half } else { (ratio - half).max(0.0) };
    Some(Interval::new(low, ratio + half))
}

/// The least number of units that must all agree for the interval of [`mean_of_agreed`] to be no wider than `width`.
///
/// # Panics
/// If `width` or `level` is not inside (0, 1).
pub fn agreeing_for_width(width: f64, level: f64) -> usize {
    assert!(width > 0.0 && width < 1.0 && level > 0.0 && level < 1.0, "a width of {width} at level {level}");
    (libm::log((1.0 - level) / 2.0) / libm::log1p(-width)).ceil() as usize
}

/// The number of units for which an interval fits `margin` to either side, if `units` gave it `half_width`.
///
/// Half widths of means and of smooth functions of them shrink as one over the square root.
///
/// # Panics
/// If `margin` is not positive.
pub fn units_for_margin(half_width: f64, units: usize, margin: f64) -> usize {
    assert!(margin > 0.0, "a margin of {margin}");
    let ratio = half_width / margin;
    (units as f64 * ratio * ratio).ceil() as usize
}

/// Where one value stands among instances.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rank {
    /// Instances below the value.
    pub below: usize,
    /// Instances equal to it.
    pub equal: usize,
    /// Instances above it.
    pub above: usize,
}

impl Rank {
    /// The rank of `value` among `instances`.
    ///
    /// # Panics
    /// If a number is NaN.
    pub fn new(value: f64, instances: &[f64]) -> Self {
        assert!(!value.is_nan() && instances.iter().all(|instance| !instance.is_nan()), "NaN in a rank");
        let count =
            |is: fn(&f64, &f64) -> bool| instances.iter().filter(|instance| is(instance, &value)).count();
        Self { below: count(|a, b| a < b), equal: count(|a, b| a == b), above: count(|a, b| a > b) }
    }

    /// How many instances there were.
    pub fn instances(self) -> usize {
        self.below + self.equal + self.above
    }

    /// The share of instances at or below the value; none without instances.
    pub fn share_at_most(self) -> Option<f64> {
        (self.instances() > 0).then(|| (self.below + self.equal) as f64 / self.instances() as f64)
    }

    /// The exact interval of [`share_at_most`](Self::share_at_most) for the population of instances.
    pub fn interval_at_most(self, level: f64) -> Option<Interval> {
        clopper_pearson(self.below + self.equal, self.instances(), level)
    }

    /// Two-sided Monte Carlo p-value that the value is one more such instance: twice the smaller tail, the value
    /// counted in it, at most 1.
    ///
    /// # Source
    /// Davison & Hinkley, *Bootstrap Methods and their Application* (1997), section 4.2.
    pub fn p_two_sided(self) -> f64 {
        let tail = (self.below + self.equal).min(self.above + self.equal) + 1;
        (2.0 * tail as f64 / (self.instances() + 1) as f64).min(1.0)
    }
}

/// An interval that holds the next instance with probability at least `level`, whatever the distribution.
///
/// Ends are order statistics: with n exchangeable draws the next one falls outside the k-th from either end
/// with probability at most 2k / (n + 1). None if even the extremes do not reach the level (below 39 instances at
/// 0.95).
///
/// # Panics
/// If an instance is NaN or `level` is not inside (0, 1).
///
/// # Source
/// Wilks, Annals of Mathematical Statistics 12 (1941) 91–96.
pub fn predictive(instances: &[f64], level: f64) -> Option<Interval> {
    assert!(level > 0.0 && level < 1.0, "a predictive interval at level {level}");
    let sorted = summary::sorted(instances);
    // The nudge undoes what 1 - 0.95 loses, so that 39 instances reach 0.95.
    let cut = ((1.0 - level) * (sorted.len() + 1) as f64 / 2.0 + 1e-9).floor() as usize;
    (cut > 0).then(|| Interval::new(sorted[cut - 1], sorted[sorted.len() - cut]))
}

fn wilson_of_share(share: f64, trials: f64, level: f64) -> Interval {
    let z = normal_multiplier(level);
    let z2 = z * z / trials;
    let centre = (share + z2 / 2.0) / (1.0 + z2);
    let half = z / (1.0 + z2) * (share * (1.0 - share) / trials + z2 / (4.0 * trials)).sqrt();
    Interval::new((centre - half).max(0.0), (centre + half).min(1.0))
}

/// P(X ≥ hits) for a binomial X, summed from its largest term outwards.
fn at_least(hits: usize, trials: usize, share: f64) -> f64 {
    if hits == 0 {
        return 1.0;
    }
    if share <= 0.0 || share >= 1.0 {
        return f64::from(share >= 1.0);
    }
    let n = trials as f64;
    let odds = share / (1.0 - share);
    let mode = (((n + 1.0) * share) as usize).clamp(hits, trials);
    let m = mode as f64;
    let log_choose = libm::lgamma(n + 1.0) - libm::lgamma(m + 1.0) - libm::lgamma(n - m + 1.0);
    let peak = libm::exp(log_choose + m * libm::log(share) + (n - m) * libm::log1p(-share));
    let up = (mode + 1..=trials).scan(1.0, |term, k| {
        *term *= odds * (n - k as f64 + 1.0) / k as f64;
        Some(*term)
    });
    let down = (hits..mode).rev().scan(1.0, |term, k| {
        *term *= (k as f64 + 1.0) / (odds * (n - k as f64));
        Some(*term)
    });
    let tail = |terms: &mut dyn Iterator<Item = f64>| terms.take_while(|&term| term > 1e-18).sum::<f64>();
    peak * (1.0 + tail(&mut { up }) + tail(&mut { down }))
}

/// The point between `low` and `high` up to which `is_below` holds, to the last bit.
pub(super) fn bisect(mut low: f64, mut high: f64, is_below: impl Fn(f64) -> bool) -> f64 {
    loop {
        let middle = f64::midpoint(low, high);
        if middle <= low || middle >= high {
            return middle;
        }
        if is_below(middle) { low = middle } else { high = middle }
    }
}

#[cfg(test)]
mod tests;
