//! Pairs of trials with one key, and what was drawn independently among them.
//!
//! The unit of replication is an instance: all that ran on objects drawn from one seed, under every interpretation, by every contender.
//! Where a problem group has a single instance, as a map that a paper prints, each seed of a contender that draws is a unit.

use std::collections::{BTreeMap, BTreeSet};
use study::key::InstanceKey;
use study::record::{Batch, Row, Status};

/// Two trials with one key.
pub struct Pair<'r> {
    /// What it was drawn with.
    pub unit: Unit<'r>,
    /// The trial of each side.
    pub rows: [&'r Row; 2],
    /// Whether both sides drew the problem from one seed.
    pub is_same_instance: bool,
}

/// What was drawn independently.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Unit<'r> {
    /// The instance's seed, or, if that is not stored, its group and number.
    instance: Result<u64, (&'r str, u32)>,
    /// The contender's seed, where that is what was drawn.
    repeat: u32,
}

/// The instances of one study.
pub struct Instances<'r> {
    seeds: BTreeMap<&'r InstanceKey, u64>,
    /// Problem groups that have more than one instance.
    numbered: BTreeSet<&'r str>,
}

/// The paired trials, and the unpaired ones.
pub struct Paired<'r> {
    /// The pairs, in the order of the second side's records.
    pub pairs: Vec<Pair<'r>>,
    /// Trials of each side that have no partner.
    pub lone: [Vec<&'r Row>; 2],
}

impl<'r> Instances<'r> {
    /// The independent draws of a study's records.
    pub fn new(batch: &'r Batch) -> Self {
        let seeds = batch.preprocessing.iter().map(|row| (&*row.key, row.seed)).collect();
        let numbered =
            batch.rows.iter().filter(|row| row.instance() > 0).map(|row| &*row.key.on.group).collect();
        Self { seeds, numbered }
    }

    fn seed(&self, row: &Row) -> Option<u64> {
        self.seeds.get(&*row.key.on).copied()
    }

    /// What a trial was drawn with.
    pub fn unit(&self, row: &'r Row) -> Unit<'r> {
        let group = &*row.key.on.group;
        let repeat = if self.numbered.contains(group) { 0 } else { row.key.repeat };
        Unit { instance: self.seed(row).ok_or((group, row.instance())), repeat }
    }
}

/// The trials of two sides that have all of their key in common but for the contender; problems that could not be posed on
/// some side are left out.
pub fn paired<'r>(rows: [&[&'r Row]; 2], instances: [&Instances<'r>; 2]) -> Paired<'r> {
    let mut firsts: BTreeMap<_, &'r Row> = rows[0].iter().map(|row| (row.case(), *row)).collect();
    let mut found = Paired { pairs: Vec::new(), lone: [Vec::new(), Vec::new()] };
    for second in rows[1] {
        let Some(first) = firsts.remove(&second.case()) else {
            found.lone[1].push(second);
            continue;
        };
        if [first, second].iter().all(|row| row.status != Status::InvalidProblem) {
            let is_same_instance = instances[0].seed(first) == instances[1].seed(second);
            found.pairs.push(Pair {
                unit: instances[0].unit(first),
                rows: [first, second],
                is_same_instance,
            });
        }
    }
    found.lone[0].extend(firsts.into_values());
    found
}
