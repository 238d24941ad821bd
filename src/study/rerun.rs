//! Reruns a seeded sample of stored trials and compares every row.

use super::choice::Interpretation;
use super::key::{InstanceKey, TrialKey};
use super::manifest::Manifest;
use super::record::Row;
use super::runner::BuiltStudy;
use super::store::read_numbers;
use super::unit::Unit;
use super::{Inputs, Study, StudyError};
use base::seed;
use rand::RngExt as _;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::Arc;

/// What a sample of stored trials came out as.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Rerun {
    /// How many trials were run again.
    pub trials: usize,
    /// Those whose row is not what is stored.
    pub differ: Vec<String>,
}

/// Runs `count` stored trials of `study` that can be repeated, drawn from the study's seed, on `threads` threads, and compares them, and whatever
/// their units run besides, with the stored rows.
///
/// # Errors
/// [`StudyError::Stored`] if there is no sound run in `folder`.
pub fn rerun(
    study: &Study,
    inputs: &Inputs,
    folder: &Path,
    count: usize,
    threads: usize,
) -> Result<Rerun, StudyError> {
    let manifest = Manifest::read(folder, &study.name)?;
    let records = read_numbers(folder, &study.name, &manifest.files)?;
    let points: Vec<Interpretation> = study
        .trial_interpretations()?
        .into_iter()
        .filter(|point| manifest.covers(&point.key(&study.choices)))
        .collect();
    let built = BuiltStudy::new(study, &points, inputs)?;
    let recorded: BTreeSet<&str> = study.recorded().collect();
    let mut rows = records.batch.rows.clone();
    rows.retain(|row| !recorded.contains(&*row.key.contender));
    let wanted = sample(study, &rows, count);
    let mut units: Vec<Unit<'_>> = built.units().filter(|unit| wanted.contains_key(&unit.key)).collect();
    for unit in &mut units {
        unit.entrants.retain(|entrant| !entrant.contender.is_recorded());
    }
    units.iter().try_for_each(|unit| built.check_files(unit))?;
    let pool = super::runner::pool(Some(threads));
    let again = pool.install(|| units.par_iter().map(|unit| built.run_unit(unit)).collect::<Vec<_>>());
    let stored: BTreeMap<&TrialKey, &Row> = records.batch.rows.iter().map(|row| (&row.key, row)).collect();
    let rows: Vec<Row> = again.into_iter().flat_map(|batch| batch.rows).collect();
    let is_other = |row: &&Row| stored.get(&row.key).is_none_or(|stored| *stored != *row);
    let came: BTreeSet<&TrialKey> = rows.iter().map(|row| &row.key).collect();
    let lost = wanted.values().flatten().filter(|trial| !came.contains(trial));
    let differ = rows.iter().filter(is_other).map(|row| &row.key).chain(lost);
    let differ = differ.map(|key| built.names().trial(key)).collect();
    Ok(Rerun { trials: rows.len(), differ })
}

/// The trials drawn, by unit.
fn sample(study: &Study, rows: &[Row], count: usize) -> BTreeMap<Arc<InstanceKey>, BTreeSet<TrialKey>> {
    let mut stream = seed::stream(seed::derive(study.seed, &[&study.paper, &study.name, "rerun"]));
    let picks = (0..count.min(rows.len())).map(|_| &rows[stream.random_range(0..rows.len())]);
    let mut sample: BTreeMap<Arc<InstanceKey>, BTreeSet<TrialKey>> = BTreeMap::new();
    for row in picks {
        sample.entry(row.key.on.clone()).or_default().insert(row.key.clone());
    }
    sample
}
