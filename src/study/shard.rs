//! Shards: deterministic parts of a list of units of about equal cost, wherever the list comes from.

use serde::{Deserialize, Serialize};
use std::cmp::Reverse;
use std::collections::{BTreeSet, BinaryHeap};
use std::fmt;

/// Which shard of a run records belong to.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Shard {
    /// Its number, from 1.
    pub number: usize,
    /// How many there are.
    pub of: usize,
    /// SHA-256 of the plan that it was cut by.
    pub plan: String,
}

/// The units of one study that a shard runs.
#[derive(Debug, Clone)]
pub struct Portion {
    /// Which part of the plan it is.
    pub shard: Shard,
    /// Their numbers.
    pub units: BTreeSet<usize>,
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.of)
    }
}

/// The number of a shard and how many there are, written as `3/64`.
///
/// # Errors
/// What is wrong with it, and what is accepted.
pub fn parse(text: &str) -> Result<(usize, usize), String> {
    let wrong = || format!("`{text}` is no shard; K/N with 1 ≤ K ≤ N ≤ {MOST} is accepted, as 3/64");
    let (number, of) = text.split_once('/').ok_or_else(wrong)?;
    let (number, of) = number.parse().ok().zip(of.parse().ok()).ok_or_else(wrong)?;
    if (1..=of).contains(&number) && of <= MOST { Ok((number, of)) } else { Err(wrong()) }
}

/// The most shards of a run.
pub const MOST: usize = 100_000;

/// The shard, from 1, of each unit of these costs: the dearest unit first, each to the shard that has the least to do.
///
/// Equal costs go by their order, equal shards by their number, so that the same costs give the same shards everywhere. No
/// shard has more than 4/3 of what the best division would give its dearest one.
///
/// # Source
/// Graham, "Bounds on multiprocessing timing anomalies", SIAM J. Appl. Math. 17 (1969) 416–429, theorem 3.
pub fn cut(costs: &[u64], shards: usize) -> Vec<usize> {
    let mut order: Vec<usize> = (0..costs.len()).collect();
    order.sort_by_key(|unit| (Reverse(costs[*unit]), *unit));
    let mut loads: BinaryHeap<Reverse<(u64, usize)>> =
        (1..=shards).map(|shard| Reverse((0, shard))).collect();
    let mut shard_of = vec![0; costs.len()];
    for unit in order {
        let Reverse((load, shard)) = loads.pop().expect("there is at least one shard");
        shard_of[unit] = shard;
        loads.push(Reverse((load.saturating_add(costs[unit].max(1)), shard)));
    }
    shard_of
}

#[cfg(test)]
mod tests {
    use super::*;
    use base::seed;
    use rand::RngExt as _;

    #[test]
    fn every_unit_has_a_shard_and_no_shard_has_far_more_than_its_share() {
        let mut uneven = 0;
        for case in 0..100 {
            let stream = &mut seed::stream(seed::derive(case, &["cut"]));
            let units = stream.random_range(1..300_usize);
            let costs: Vec<u64> = (0..units).map(|_| 1 + stream.random_range(0..1000_u64).pow(2)).collect();
            let shards = stream.random_range(1..20_usize);
            let found = cut(&costs, shards);
            assert_eq!(found, cut(&costs, shards), "case {case}: another cut");
            let mut loads = vec![0; shards];
            found.iter().zip(&costs).for_each(|(shard, cost)| loads[shard - 1] += cost);
            let all = costs.iter().sum::<u64>();
            let dearest = costs.iter().copied().max().unwrap();
            // No division can do better than either of these.
            let bound = (all as f64 / shards as f64).max(dearest as f64) * 4.0 / 3.0 + dearest as f64 / 3.0;
            let most = loads.iter().copied().max().unwrap();
            assert!(most as f64 <= bound, "case {case}: {most} of {all} in {shards} shards");
            uneven += usize::from(costs.windows(2).any(|pair| pair[0] != pair[1]));
        }
        assert!(uneven > 90, "only {uneven} samples have different costs");
    }

    #[test]
    fn shards_are_written_as_fractions() {
        assert_eq!(parse("3/64"), Ok((3, 64)));
        for wrong in ["0/4", "5/4", "3", "a/b", "1/0", "-1/4", "1/100001", ""] {
            assert!(parse(wrong).unwrap_err().contains("K/N with 1 ≤ K ≤ N"), "{wrong}");
        }
    }
}
