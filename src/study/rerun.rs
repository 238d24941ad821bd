//! Reruns a seeded sample of stored trials and compares every row.

use super::manifest::Manifest;
use super::reading::ReadingChoice;
use super::record::Row;
use super::runner::BuiltStudy;
use super::store::read_records;
use super::unit::Unit;
use super::{Inputs, Study, StudyError};
use base::seed;
use rand::RngExt as _;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// What a sample of stored trials came out as.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Rerun {
    /// How many trials were run again.
    pub trials: usize,
    /// Those whose row is not what is stored.
    pub differ: Vec<String>,
}

/// Runs `count` stored trials of `study`, drawn from the study's seed, on `threads` threads, and compares them, and whatever
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
    let records = read_records(folder, &study.name, &manifest.files)?;
    let points: Vec<ReadingChoice> = study
        .trial_points()?
        .into_iter()
        .filter(|p| manifest.readings.iter().any(|r| r == p.name()))
        .collect();
    let built = BuiltStudy::new(study, &points, inputs)?;
    let wanted = sample(study, &records.batch.rows, count);
    let mut units = built.units();
    for unit in &mut units {
        unit.wanted = wanted.get(&place(unit)).cloned();
    }
    units.retain(|unit| unit.wanted.is_some());
    let pool = super::session::pool(Some(threads));
    let again = pool.install(|| units.par_iter().map(|unit| built.run_unit(unit)).collect::<Vec<_>>());
    let stored: BTreeMap<&str, &Row> =
        records.batch.rows.iter().map(|row| (row.trial.as_str(), row)).collect();
    let rows: Vec<Row> = again.into_iter().flat_map(|batch| batch.rows).collect();
    let is_other = |row: &&Row| stored.get(row.trial.as_str()).is_none_or(|stored| *stored != *row);
    let came: BTreeSet<&str> = rows.iter().map(|row| row.trial.as_str()).collect();
    let lost = wanted.values().flatten().filter(|trial| !came.contains(trial.as_str())).cloned();
    let differ = rows.iter().filter(is_other).map(|row| row.trial.clone()).chain(lost).collect();
    Ok(Rerun { trials: rows.len(), differ })
}

type Place = (String, u32, String);

fn place(unit: &Unit<'_>) -> Place {
    (unit.group.label.clone(), unit.replicate, unit.point.name().to_owned())
}

/// The names of the trials drawn, by unit.
fn sample(study: &Study, rows: &[Row], count: usize) -> BTreeMap<Place, BTreeSet<String>> {
    let mut stream = seed::stream(seed::derive(study.seed, &[&study.paper, &study.name, "rerun"]));
    let picks = (0..count.min(rows.len())).map(|_| &rows[stream.random_range(0..rows.len())]);
    let mut sample: BTreeMap<Place, BTreeSet<String>> = BTreeMap::new();
    for row in picks {
        let place = (row.group.clone(), row.replicate, row.reading.clone());
        sample.entry(place).or_default().insert(row.trial.clone());
    }
    sample
}
