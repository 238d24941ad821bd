//! Which stored records stand for what a run would give: those that depend on nothing that has changed.
//!
//! A problem group that has changed takes all its trials with it; a contender that has changed takes its own.

use super::contender::Contender;
use super::error::StudyError;
use super::key::{InstanceKey, Owner, Text, TrialKey};
use super::manifest::Manifest;
use super::record::{Batch, Kept, Row};
use super::runner::{BuiltStudy, Part, StoredUnit};
use super::store::{
    Journal, KeptTraces, Records, Shape, read_numbers, salvaged, set_aside, set_parts_aside,
    set_records_aside,
};
use super::unit::{Entrant, Unit};
use engine::planner::Trace;
use std::collections::{BTreeMap, BTreeSet};
use std::iter;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A study's stored records, and why they cannot be reused for the run that a manifest describes.
#[derive(Default)]
pub struct Before {
    /// The manifest and the records, without traces.
    pub stored: Option<(Manifest, Records)>,
    /// The traces.
    pub kept: KeptTraces,
    /// What has changed.
    pub why: Vec<String>,
    /// What of it was damaged and set aside.
    pub damage: Damage,
}

/// What of a stored run was damaged and set aside.
#[derive(Debug, Default)]
pub struct Damage {
    /// The new names of the files.
    pub aside: Vec<PathBuf>,
    /// Whether trials must run again to have all that was lost.
    pub is_of_trials: bool,
}

impl Before {
    /// The records in `folder` of the study that `manifest` describes. Damaged files are set aside if
    /// `replaces_damaged`.
    ///
    /// # Errors
    /// [`StudyError::Touched`] for a damaged file otherwise.
    pub fn read(folder: &Path, manifest: &Manifest, replaces_damaged: bool) -> Result<Self, StudyError> {
        if !Manifest::path(folder, &manifest.study).exists() {
            return Ok(Self::default());
        }
        match Self::stored(folder, manifest) {
            Err(StudyError::Touched(_)) if replaces_damaged => Self::salvaged(folder, manifest),
            other => other,
        }
    }

    fn stored(folder: &Path, manifest: &Manifest) -> Result<Self, StudyError> {
        let study = &manifest.study;
        let (before, records) = stored(folder, study)?;
        let kept = KeptTraces::stored(folder, study, &before.files)?;
        kept.owners()?;
        let why = manifest.differs_from(&before);
        Ok(Self { stored: Some((before, records)), kept, why, damage: Damage::default() })
    }

    /// The sound files, after the rest was set aside. A readable manifest names the right files, or their hashes would differ.
    fn salvaged(folder: &Path, manifest: &Manifest) -> Result<Self, StudyError> {
        let study = &manifest.study;
        let is_sealed = Manifest::read(folder, study).is_ok();
        let before = Manifest::read_unsealed(folder, study);
        let mut aside = Vec::new();
        if !is_sealed {
            aside.extend(set_aside(&Manifest::path(folder, study))?);
        }
        let Ok(before) = before else {
            aside.extend(set_records_aside(folder, study)?);
            return Ok(Self { damage: Damage { aside, is_of_trials: true }, ..Self::default() });
        };
        let (records, damaged) = salvaged(folder, study, &before.files);
        aside.extend(set_parts_aside(folder, study, &damaged)?);
        let has_traces = !damaged.contains(&"traces");
        let kept = if has_traces {
            KeptTraces::stored(folder, study, &before.files)?
        } else {
            KeptTraces::default()
        };
        let is_of_trials = damaged.iter().any(|part| *part != "times");
        let why = manifest.differs_from(&before);
        Ok(Self { stored: Some((before, records)), kept, why, damage: Damage { aside, is_of_trials } })
    }
}

/// The manifest and the records of `study` in `folder`, without traces.
///
/// # Errors
/// [`StudyError::Stored`] for a file that is missing, damaged, or not the one that the manifest speaks of.
pub fn stored(folder: &Path, study: &str) -> Result<(Manifest, Records), StudyError> {
    let manifest = Manifest::read(folder, study)?;
    let records = read_numbers(folder, study, &manifest.files)?;
    Ok((manifest, records))
}

/// Stored trials that may stand, since nothing that they depend on has changed.
#[derive(Debug, Clone, Copy)]
pub struct Keeps {
    /// Those that can be repeated.
    pub repeated: bool,
    /// Those that are recorded.
    pub recorded: bool,
}

impl Keeps {
    fn keeps(self, contender: &Contender) -> bool {
        if contender.is_recorded() { self.recorded } else { self.repeated }
    }
}

/// What of a run is stored, by the number of the unit.
#[derive(Default)]
pub struct Reusable<'s> {
    /// Units that are stored whole.
    pub units: BTreeMap<usize, StoredUnit<'s>>,
    /// Units with the trials of some contenders only.
    pub parts: BTreeMap<usize, Part<'s>>,
    /// By unit, the contenders whose traces are stored; `None` stands for all, in a task without contenders.
    pub traces: BTreeMap<usize, Option<BTreeSet<Text>>>,
}

impl<'s> Reusable<'s> {
    /// The trials in `records`, described by `before`, that stand for the run that `manifest` describes.
    pub fn new(
        built: &BuiltStudy<'_>,
        manifest: &Manifest,
        before: &Manifest,
        records: &'s Records,
        keeps: Keeps,
    ) -> Self {
        let mut found = Self::default();
        if manifest.quick != before.quick {
            return found;
        }
        let mut stored = by_instance(&records.batch);
        for (index, unit) in built.units().enumerate() {
            let interpretation = &unit.key.interpretation;
            let problem = |of: &Manifest| of.problem(&unit.key).map(str::to_owned);
            let Some(records) = stored.remove(&*unit.key) else { continue };
            if problem(manifest) != problem(before) {
                continue;
            }
            let labels: BTreeSet<Text> = unit.entrants.iter().map(|entrant| entrant.label.clone()).collect();
            let is_there = if labels.is_empty() {
                keeps.repeated && !records.preprocessing.is_empty()
            } else {
                !records.rows.is_empty()
            };
            if !is_there {
                continue;
            }
            let is_same = |entrant: &&&Entrant<'_>| {
                let label = &entrant.label;
                manifest.contender(interpretation, label) == before.contender(interpretation, label)
                    && keeps.keeps(entrant.contender)
            };
            let same = unit.entrants.iter().filter(is_same).map(|entrant| entrant.label.clone()).collect();
            found.put(index, records, labels.len(), same);
        }
        found
    }

    /// Notes what is stored of a unit; of its so many `contenders` those in `same` have not changed.
    fn put(&mut self, index: usize, mut stored: StoredUnit<'s>, contenders: usize, same: BTreeSet<Text>) {
        if contenders == 0 {
            // A task that does without contenders depends on its problems alone.
            self.units.insert(index, stored);
            self.traces.insert(index, None);
        } else if same.len() == contenders && !stored.preprocessing.is_empty() {
            // The file of what was built before queries may have been damaged.
            self.units.insert(index, stored);
            self.traces.insert(index, Some(same));
        } else if !same.is_empty() {
            let is_same = |key: &TrialKey| same.contains(&key.contender);
            stored.rows.retain(|row| is_same(&row.key));
            self.traces.insert(index, Some(same.clone()));
            self.parts.insert(index, Part { contenders: same, stored });
        }
    }

    /// How many trials are stored of units that are not stored whole.
    pub fn kept(&self) -> usize {
        self.parts.values().map(|part| part.stored.rows.len()).sum()
    }
}

/// The records of each instance.
fn by_instance(batch: &Batch) -> BTreeMap<&InstanceKey, StoredUnit<'_>> {
    let mut instances: BTreeMap<&InstanceKey, StoredUnit<'_>> = BTreeMap::new();
    for row in &batch.preprocessing {
        instances.entry(&row.key).or_default().preprocessing.push(row);
    }
    for row in &batch.rows {
        instances.entry(&row.key.on).or_default().rows.push(row);
    }
    instances
}

/// The records of a run on their way to its files: new ones in the journal, the others from the run before.
pub struct Gathered<'r, 'a> {
    built: &'r BuiltStudy<'a>,
    journal: Journal,
    before: KeptTraces,
    reused: Reusable<'r>,
}

impl<'r, 'a> Gathered<'r, 'a> {
    /// The records of a run that takes over `reused` of the run before, whose traces are `before`.
    pub fn new(
        built: &'r BuiltStudy<'a>,
        journal: Journal,
        before: KeptTraces,
        reused: Reusable<'r>,
    ) -> Self {
        Self { built, journal, before, reused }
    }

    /// What must be known of them before the first is written.
    ///
    /// # Errors
    /// Those of the file of the run before.
    pub fn shape(&self) -> Result<Shape, StudyError> {
        let mut shape = self.journal.shape().clone();
        let parts = self.reused.parts.values().map(|part| &part.stored);
        let stored = self.reused.units.values().chain(parts);
        shape.note(stored.flat_map(|unit| unit.preprocessing.iter().copied()));
        if shape.sweep.is_none() {
            let units = self.built.units();
            let numbers: BTreeMap<Arc<InstanceKey>, usize> = units.map(|unit| unit.key).zip(0..).collect();
            shape.sweep = self.before.owners()?.into_iter().find_map(|owner| {
                let Owner::Trial(key) = owner else { return None };
                let taken = self.reused.traces.get(numbers.get(&key.on)?)?;
                let is_taken = taken.as_ref().is_none_or(|taken| taken.contains(&key.contender));
                is_taken.then(|| key.sweep.clone())
            });
        }
        Ok(shape)
    }

    /// The records of the unit numbered `index`.
    ///
    /// # Errors
    /// Those of the journal and of the file of the run before.
    pub fn unit(&mut self, index: usize, unit: &Unit<'_>) -> Result<Batch, StudyError> {
        let ran = self.journal.take(index)?;
        let stored = || self.reused.units.get(&index).map(|stored| self.built.stored_whole(unit, stored));
        let mut batch = ran.or_else(stored).unwrap_or_default();
        let Some(reused) = self.reused.traces.get(&index) else { return Ok(batch) };
        let mut by_owner: BTreeMap<Owner, Vec<Trace>> = BTreeMap::new();
        for Kept { owner, trace } in batch.kept.drain(..) {
            by_owner.entry(owner).or_default().push(trace);
        }
        let owners: Vec<Owner> = if reused.is_none() {
            self.before.owners()?.into_iter().filter(|owner| *owner.on() == unit.key).cloned().collect()
        } else {
            let trials = self.built.trials(unit).into_iter().map(Owner::Trial);
            iter::once(Owner::from(&unit.key)).chain(trials).collect()
        };
        let is_reused = |owner: &Owner| match (owner, reused) {
            (Owner::Trial(key), Some(reused)) => reused.contains(&key.contender),
            _ => true,
        };
        for owner in owners {
            let traces = match by_owner.remove(&owner) {
                Some(traces) => traces,
                None if is_reused(&owner) => self.before.take(&owner)?,
                None => continue,
            };
            batch.kept.extend(traces.into_iter().map(|trace| Kept { owner: owner.clone(), trace }));
        }
        Ok(batch)
    }

    /// Removes the journal: the records are in their places.
    ///
    /// # Errors
    /// [`StudyError::Io`].
    pub fn remove_journal(self) -> Result<(), StudyError> {
        self.journal.remove()
    }
}

/// Trials whose problem and contender are unchanged but whose row is not what was stored, by their names.
pub struct Moved<'r> {
    manifest: &'r Manifest,
    before: &'r Manifest,
    old: BTreeMap<&'r TrialKey, &'r Row>,
}

impl<'r> Moved<'r> {
    /// The moved trials of the run that `manifest` describes, since the one before.
    pub fn new(manifest: &'r Manifest, before: &'r Manifest, old: &'r [Row]) -> Self {
        Self { manifest, before, old: old.iter().map(|row| (&row.key, row)).collect() }
    }

    /// Whether `row` is a moved trial.
    pub fn has(&self, row: &Row) -> bool {
        let Self { manifest, before, old } = self;
        let interpretation = &row.key.on.interpretation;
        let label = &row.key.contender;
        old.get(&row.key).is_some_and(|stored| *stored != row)
            && manifest.problem(&row.key.on) == before.problem(&row.key.on)
            && manifest.contender(interpretation, label) == before.contender(interpretation, label)
    }
}

#[cfg(test)]
mod tests;
