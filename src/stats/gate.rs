//! Whether something has become worse by more than a margin: what an interval says, and how many more units would tell.

use super::bootstrap::Estimate;
use super::proportion::units_for_margin;

/// More units than this are as good as none that could tell.
const MOST: usize = 10_000_000;

/// What an interval says of a margin.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Decision {
    /// All of the interval lies beyond the margin.
    Worse,
    /// None of it does.
    NotWorse,
    /// Some of it does.
    CannotTell {
        /// About how many more units an interval would need that lies on one side, if its middle stays where it is; none if
        /// the middle lies at the margin.
        more: Option<usize>,
    },
}

/// The verdict of a gate: whether the interval of `found` shows that it is worse by more than `margin`. Above 0 is
/// worse.
///
/// Either of the two firm answers is wrong with at most the probability of the interval's tail on that side. That
/// probability is greatest where the true change is the margin itself.
pub fn decide(found: &Estimate, margin: f64) -> Decision {
    let value = found.value;
    let interval = found.interval;
    if interval.low > margin {
        return Decision::Worse;
    }
    if interval.high <= margin {
        return Decision::NotWorse;
    }
    let apart = (value - margin).abs();
    let reach = if value > margin { value - interval.low } else { interval.high - value };
    let needed = (apart > 0.0 && reach.is_finite()).then(|| units_for_margin(reach, found.units, apart));
    let more = needed.map(|needed| needed.saturating_sub(found.units).max(1));
    Decision::CannotTell { more: more.filter(|more| *more < MOST) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bootstrap::Resampling;
    use crate::interval::Interval;
    use crate::pooled;
    use crate::proportion::clopper_pearson;
    use base::seed;
    use rand::RngExt as _;

    const MARGIN_PERCENT: f64 = 2.0;
    const RUNS: u64 = 1500;

    /// How often, of [`RUNS`] comparisons of so many instances each, the gate says worse and not worse of a true change.
    fn rates(change_percent: f64, instances: usize) -> [usize; 2] {
        let mut counts = [0, 0];
        for run in 0..RUNS {
            let stream = &mut seed::stream(seed::derive(run, &["gate", &change_percent.to_string()]));
            let mut normal = || (0..12).map(|_| stream.random::<f64>()).sum::<f64>() - 6.0;
            // Maps differ by a factor of two; what a planner changes on each by 10 %, around the true change.
            let mut sums = || {
                let base = libm::exp(0.7 * normal());
                [base * (1.0 + change_percent / 100.0) * (1.0 + 0.1 * normal()), base]
            };
            let sums: Vec<[f64; 2]> = (0..instances).map(|_| sums()).collect();
            let ratio =
                pooled::ratio_of_sums(&sums, Resampling { resamples: 500, level: 0.95, seed: run }).unwrap();
            let percent = |ratio: f64| 100.0 * (ratio - 1.0);
            let interval = Interval::new(percent(ratio.interval.low), percent(ratio.interval.high));
            match decide(&Estimate { value: percent(ratio.value), interval, ..ratio }, MARGIN_PERCENT) {
                Decision::Worse => counts[0] += 1,
                Decision::NotWorse => counts[1] += 1,
                Decision::CannotTell { .. } => {}
            }
        }
        counts
    }

    /// Whether so many of [`RUNS`] can come of a probability of at most `percent`.
    fn is_at_most(count: usize, percent: f64) -> bool {
        clopper_pearson(count, RUNS as usize, 0.999).unwrap().low <= percent / 100.0
    }

    #[test]
    fn false_alarms_and_misses_are_as_rare_as_promised() {
        // At the margin itself both words are as often wrong as they ever are. The percentile interval is a little short
        // of few instances of unlike size: 3.5 % of 100 in place of 2.5 %, and 5.5 % of 20.
        for (instances, bound_percent) in [(20, 5.5), (100, 3.5)] {
            let [worse, not_worse] = rates(MARGIN_PERCENT, instances);
            assert!(
                is_at_most(worse, bound_percent),
                "{instances} instances: {worse} false alarms of {RUNS}"
            );
            assert!(
                is_at_most(not_worse, bound_percent),
                "{instances} instances: {not_worse} misses of {RUNS}"
            );
            assert!(worse + not_worse > 30, "the gate says nothing");
        }
        let [worse, not_worse] = rates(0.0, 100);
        assert!(is_at_most(worse, 0.5), "equal planners: {worse} false alarms of {RUNS}");
        assert!(not_worse > RUNS as usize / 4, "equal planners: {not_worse} of {RUNS} pass");
        let [worse, not_worse] = rates(8.0, 100);
        assert!(worse as u64 > RUNS * 9 / 10, "8 % worse: {worse} of {RUNS} are caught");
        assert!(is_at_most(not_worse, 0.5), "8 % worse: {not_worse} of {RUNS} pass");
    }

    #[test]
    fn an_open_interval_says_how_many_more_units_would_close_it() {
        let found = |value: f64, half: f64| Estimate {
            value,
            interval: Interval::new(value - half, value + half),
            is_agreed: false,
            units: 100,
            undefined: 0,
        };
        assert_eq!(decide(&found(5.0, 2.0), 2.0), Decision::Worse);
        assert_eq!(decide(&found(-5.0, 2.0), 2.0), Decision::NotWorse);
        assert_eq!(decide(&found(0.0, 0.0), 0.0), Decision::NotWorse, "nothing has changed");
        // Twice as wide as it may be needs four times the instances.
        assert_eq!(decide(&found(1.0, 2.0), 2.0), Decision::CannotTell { more: Some(300) });
        assert_eq!(decide(&found(3.0, 2.0), 2.0), Decision::CannotTell { more: Some(300) });
        assert_eq!(decide(&found(2.0, 1.0), 2.0), Decision::CannotTell { more: None });
    }
}
