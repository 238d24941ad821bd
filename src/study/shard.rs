//! Shards: deterministic parts of a list of units.

use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;
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

/// The shard, from 1, of the unit of this number. Units are dealt in turn, so that neighbours, which cost alike, are spread evenly.
pub fn shard_of(unit: usize, shards: usize) -> usize {
    unit % shards + 1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_shard_has_more_than_one_unit_above_another() {
        for (units, shards) in [(0, 3), (2, 3), (7, 3), (9, 3), (5, 1)] {
            let mut counts = vec![0; shards];
            (0..units).for_each(|unit| counts[shard_of(unit, shards) - 1] += 1);
            assert!(counts[0] - counts[shards - 1] <= 1, "{units} units: {counts:?}");
            assert_eq!(counts.iter().sum::<usize>(), units);
        }
    }

    #[test]
    fn shards_are_written_as_fractions() {
        assert_eq!(parse("3/64"), Ok((3, 64)));
        for wrong in ["0/4", "5/4", "3", "a/b", "1/0", "-1/4", "1/100001", ""] {
            assert!(parse(wrong).unwrap_err().contains("K/N with 1 ≤ K ≤ N"), "{wrong}");
        }
    }
}
