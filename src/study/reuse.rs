//! Which stored records stand for what a run would give: those that depend on nothing that has changed.
//!
//! A problem group that has changed takes all its trials with it; a contender that has changed takes its own.

use super::contender::Contender;
use super::error::StudyError;
use super::key::{DrawKey, Owner, Text, TrialKey};
use super::manifest::Manifest;
use super::name::Names;
use super::record::{Batch, Row};
use super::runner::{BuiltStudy, Part};
use super::store::{Records, read_records};
use super::unit::{Entrant, Unit};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::Arc;

/// What is stored of a study, and why it cannot stand for the run that a manifest describes.
pub struct Before {
    /// The manifest and the records.
    pub stored: Option<(Manifest, Records)>,
    /// What has changed.
    pub why: Vec<String>,
}

impl Before {
    /// What `folder` has of the study that `manifest` is about.
    pub fn read(folder: &Path, manifest: &Manifest) -> Self {
        if !Manifest::path(folder, &manifest.study).exists() {
            return Self { stored: None, why: Vec::new() };
        }
        match stored(folder, &manifest.study) {
            Ok((before, records)) => {
                let why = manifest.differs_from(&before);
                Self { stored: Some((before, records)), why }
            }
            Err(error) => Self { stored: None, why: vec![format!("what is stored cannot be used: {error}")] },
        }
    }
}

/// The manifest and the records of `study` in `folder`.
///
/// # Errors
/// [`StudyError::Stored`] for a file that is missing, damaged, or not the one that the manifest speaks of.
pub fn stored(folder: &Path, study: &str) -> Result<(Manifest, Records), StudyError> {
    let manifest = Manifest::read(folder, study)?;
    let records = read_records(folder, study, &manifest.files)?;
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
    /// Units of which everything is stored.
    pub units: BTreeMap<usize, Batch>,
    /// Units of which some contenders' trials are.
    pub parts: BTreeMap<usize, Part>,
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
        let mut stored = by_draw(&records.batch);
        for (index, unit) in built.units().iter().enumerate() {
            let reading = &unit.key.reading;
            let problem = |of: &Manifest| of.problem(reading, &unit.key.group).map(str::to_owned);
            let Some(batch) = stored.remove(&unit.key) else { continue };
            if problem(manifest) != problem(before) || batch.prepared.is_empty() {
                continue;
            }
            let labels: BTreeSet<Text> = unit.entrants.iter().map(|entrant| entrant.label.clone()).collect();
            if labels.is_empty() && !keeps.repeated {
                continue;
            }
            let is_same = |entrant: &&&Entrant<'_>| {
                let label = &entrant.label;
                manifest.contender(reading, label) == before.contender(reading, label)
                    && keeps.keeps(entrant.contender)
            };
            let same = unit.entrants.iter().filter(is_same).map(|entrant| entrant.label.clone()).collect();
            found.put(built, index, unit, batch, labels.len(), same);
        }
        found
    }

    /// Notes what is stored of a unit of which `same` of so many contenders have not changed.
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
        } else if same.len() == contenders {
            self.units.insert(index, built.in_order(unit, [&stored, &Batch::default()]));
        } else if !same.is_empty() {
            let is_same = |key: &TrialKey| same.contains(&key.contender);
            stored.rows.retain(|row| is_same(&row.key));
            stored.kept.retain(|kept| matches!(&kept.of, Owner::Trial(key) if is_same(key)));
            self.parts.insert(index, Part { contenders: same, stored });
        }
    }

    /// How many trials are stored of units of which others are not.
    pub fn kept(&self) -> usize {
        self.parts.values().map(|part| part.stored.rows.len()).sum()
    }
}

/// The records of each draw.
fn by_draw(batch: &Batch) -> BTreeMap<Arc<DrawKey>, Batch> {
    let mut draws: BTreeMap<Arc<DrawKey>, Batch> = BTreeMap::new();
    for row in &batch.prepared {
        draws.entry(row.key.clone()).or_default().prepared.push(row.clone());
    }
    for row in &batch.rows {
        draws.entry(row.key.on.clone()).or_default().rows.push(row.clone());
    }
    for kept in &batch.kept {
        let on = match &kept.of {
            Owner::Draw(key) => key,
            Owner::Trial(key) => &key.on,
        };
        draws.entry(on.clone()).or_default().kept.push(kept.clone());
    }
    draws
}

/// Trials whose problem and contender are unchanged but whose row is not what was stored, by their names.
pub fn moved(manifest: &Manifest, before: &Manifest, old: &Batch, new: &Batch, names: &Names) -> Vec<String> {
    let old: BTreeMap<&TrialKey, &Row> = old.rows.iter().map(|row| (&row.key, row)).collect();
    let unchanged = |row: &&Row| {
        let (reading, group, label) = (&row.key.on.reading, &row.key.on.group, &row.key.contender);
        manifest.problem(reading, group) == before.problem(reading, group)
            && manifest.contender(reading, label) == before.contender(reading, label)
    };
    let differs = |row: &&Row| old.get(&row.key).is_some_and(|stored| *stored != *row);
    new.rows.iter().filter(differs).filter(unchanged).map(|row| names.trial(&row.key)).collect()
}

#[cfg(test)]
mod tests;
