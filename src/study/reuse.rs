//! Which stored records stand for what a run would give: those that depend on nothing that has changed.
//!
//! A problem group that has changed takes all its trials with it; a contender that has changed takes its own.

use super::contender::Contender;
use super::error::StudyError;
use super::key::{InstanceKey, Owner, Text, TrialKey};
use super::manifest::Manifest;
use super::name::Names;
use super::record::{Batch, Kept, Row};
use super::runner::{BuiltStudy, Part};
use super::store::{
    GROUP_VALUES, Journal, KeptTraces, Records, Traces, read_numbers, salvaged, set_aside, set_parts_aside,
    set_records_aside,
};
use super::unit::{Entrant, Unit};
use engine::planner::Trace;
use std::collections::{BTreeMap, BTreeSet, VecDeque};
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
    /// What `folder` has of the study that `manifest` is about. What is damaged is set aside if `replaces_damaged`.
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

    /// What is sound of it, after the rest was set aside. A manifest that can be read names its files rightly, or their hashes would
    /// not be theirs.
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

/// Which stored trials may stand where nothing that they depend on has changed.
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
pub struct Reusable {
    /// Units that are stored whole.
    pub units: BTreeMap<usize, Batch>,
    /// Units with the trials of some contenders only.
    pub parts: BTreeMap<usize, Part>,
    /// The contenders of each of these units whose traces are stored; of all in a task that does without contenders.
    pub traces: BTreeMap<usize, Option<BTreeSet<Text>>>,
}

impl Reusable {
    /// What of the run that `manifest` describes stands in `records`, which `before` describes.
    pub fn new(
        built: &BuiltStudy<'_>,
        manifest: &Manifest,
        before: &Manifest,
        records: &Records,
        keeps: Keeps,
    ) -> Self {
        let mut found = Self::default();
        if manifest.quick != before.quick {
            return found;
        }
        let mut stored = by_instance(&records.batch);
        for (index, unit) in built.units().iter().enumerate() {
            let interpretation = &unit.key.interpretation;
            let problem = |of: &Manifest| of.problem(&unit.key).map(str::to_owned);
            let Some(batch) = stored.remove(&unit.key) else { continue };
            if problem(manifest) != problem(before) {
                continue;
            }
            let labels: BTreeSet<Text> = unit.entrants.iter().map(|entrant| entrant.label.clone()).collect();
            let is_there = if labels.is_empty() {
                keeps.repeated && is_prepared(&batch)
            } else {
                !batch.rows.is_empty()
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
            found.put(built, index, unit, batch, labels.len(), same);
        }
        found
    }

    /// Notes what is stored of a unit; of its so many `contenders` those in `same` have not changed.
    fn put(
        &mut self,
        built: &BuiltStudy<'_>,
        index: usize,
        unit: &Unit<'_>,
        mut stored: Batch,
        contenders: usize,
        same: BTreeSet<Text>,
    ) {
        if contenders == 0 {
            // A task that does without contenders depends on its problems alone.
            self.units.insert(index, stored);
            self.traces.insert(index, None);
        } else if same.len() == contenders && is_prepared(&stored) {
            self.units.insert(index, built.in_order(unit, [&stored, &Batch::default()]));
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

/// Whether what was built before queries is among the records of a unit; the file that holds it may have been damaged.
fn is_prepared(stored: &Batch) -> bool {
    !stored.preprocessing.is_empty()
}

/// The records of each instance.
fn by_instance(batch: &Batch) -> BTreeMap<Arc<InstanceKey>, Batch> {
    let mut instances: BTreeMap<Arc<InstanceKey>, Batch> = BTreeMap::new();
    for row in &batch.preprocessing {
        instances.entry(row.key.clone()).or_default().preprocessing.push(row.clone());
    }
    for row in &batch.rows {
        instances.entry(row.key.on.clone()).or_default().rows.push(row.clone());
    }
    instances
}

/// The traces of a run on their way to its records: those of trials that ran are in the journal, the others in the file of the
/// run before.
pub struct Gathered<'r, 'a> {
    built: &'r BuiltStudy<'a>,
    journal: &'r mut Journal,
    before: KeptTraces,
    reused: BTreeMap<usize, Option<BTreeSet<Text>>>,
}

impl<'r, 'a> Gathered<'r, 'a> {
    /// Those of a run that took over what `reused` says of `before`.
    pub fn new(
        built: &'r BuiltStudy<'a>,
        journal: &'r mut Journal,
        before: KeptTraces,
        reused: BTreeMap<usize, Option<BTreeSet<Text>>>,
    ) -> Self {
        Self { built, journal, before, reused }
    }

    /// All of them in the order of records; `rows` are the run's.
    ///
    /// # Errors
    /// Those of the file of the run before.
    pub fn all(mut self, rows: &[Row]) -> Result<Traces<'r>, StudyError>
    where
        'a: 'r,
    {
        let built = self.built;
        let units = built.units();
        let numbers: BTreeMap<&Arc<InstanceKey>, usize> =
            units.iter().map(|unit| &unit.key).zip(0..).collect();
        let is_taken = |owner: &&Owner| match owner {
            Owner::Instance(_) => false,
            Owner::Trial(key) => {
                let of_unit = numbers.get(&key.on).and_then(|unit| self.reused.get(unit));
                of_unit.is_some_and(|taken| taken.as_ref().is_none_or(|taken| taken.contains(&key.contender)))
            }
        };
        let has_trials = self.journal.sweep().is_some() || self.before.owners()?.iter().any(is_taken);
        let sweep = rows.first().filter(|_| has_trials).map(|row| row.key.sweep.clone());
        let mut units = units.into_iter().enumerate();
        let mut unit = VecDeque::new();
        let each = std::iter::from_fn(move || {
            while unit.is_empty() {
                let (index, next) = units.next()?;
                match self.of_unit(index, &next) {
                    Ok(kept) => unit.extend(kept),
                    Err(error) => return Some(Err(error)),
                }
            }
            unit.pop_front().map(Ok)
        });
        Ok(Traces { each: Box::new(each), sweep, group_values: GROUP_VALUES })
    }

    fn of_unit(&mut self, index: usize, unit: &Unit<'_>) -> Result<Vec<Kept>, StudyError> {
        let ran = self.journal.traces(index)?;
        let Some(reused) = self.reused.get(&index) else { return Ok(ran) };
        let mut by_owner: BTreeMap<Owner, Vec<Trace>> = BTreeMap::new();
        for Kept { of, trace } in ran {
            by_owner.entry(of).or_default().push(trace);
        }
        let owners: Vec<Owner> = if reused.is_none() {
            self.before.owners()?.into_iter().filter(|of| *of.on() == unit.key).cloned().collect()
        } else {
            let trials = self.built.trials(unit).into_iter().map(Owner::Trial);
            iter::once(Owner::from(&unit.key)).chain(trials).collect()
        };
        let is_reused = |of: &Owner| match (of, reused) {
            (Owner::Trial(key), Some(reused)) => reused.contains(&key.contender),
            _ => true,
        };
        let mut all = Vec::new();
        for of in owners {
            let traces = match by_owner.remove(&of) {
                Some(traces) => traces,
                None if is_reused(&of) => self.before.take(&of)?,
                None => continue,
            };
            all.extend(traces.into_iter().map(|trace| Kept { of: of.clone(), trace }));
        }
        Ok(all)
    }
}

/// Trials whose problem and contender are unchanged but whose row is not what was stored, by their names.
pub fn moved(manifest: &Manifest, before: &Manifest, old: &Batch, new: &Batch, names: &Names) -> Vec<String> {
    let old: BTreeMap<&TrialKey, &Row> = old.rows.iter().map(|row| (&row.key, row)).collect();
    let unchanged = |row: &&Row| {
        let interpretation = &row.key.on.interpretation;
        let label = &row.key.contender;
        manifest.problem(&row.key.on) == before.problem(&row.key.on)
            && manifest.contender(interpretation, label) == before.contender(interpretation, label)
    };
    let differs = |row: &&Row| old.get(&row.key).is_some_and(|stored| *stored != *row);
    new.rows.iter().filter(differs).filter(unchanged).map(|row| names.trial(&row.key)).collect()
}

#[cfg(test)]
mod tests;
