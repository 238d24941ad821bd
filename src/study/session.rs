//! A run from beginning to end: resume or reuse, trials, clock, records, manifest.

use super::checked::Study;
use super::lock::Lock;
use super::manifest::{Manifest, key};
use super::reading::ReadingChoice;
use super::record::{Batch, Row, Status};
use super::runner::{BuiltStudy, Progress};
use super::store::{Journal, Records, Staged, read_records, remove_temporaries, stage_records};
use super::unit::Unit;
use super::{Inputs, StudyError};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::AtomicBool;

/// How to run.
pub struct Options<'a> {
    /// The right to write where records go.
    pub lock: &'a Lock,
    /// The readings to run; the first is the one that clocks are read under.
    pub points: &'a [ReadingChoice],
    /// Where input files are.
    pub inputs: &'a Inputs,
    /// The command line, for the manifest.
    pub command: String,
    /// SHA-256 of the paper's claims.
    pub claims: String,
    /// Cut down by `--quick`.
    pub quick: bool,
    /// Run everything again, even what is stored and unchanged.
    pub fresh: bool,
    /// How many threads; the machine's number if absent.
    pub threads: Option<usize>,
    /// Set to stop after the units at work.
    pub stop: &'a AtomicBool,
    /// Who watches.
    pub progress: &'a dyn Progress,
}

/// What a run did.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// The manifest that was written.
    pub manifest: Manifest,
    /// How many trials there are.
    pub trials: usize,
    /// How many units came from the journal of an interrupted run.
    pub resumed: usize,
    /// How many units came from stored records.
    pub reused: usize,
    /// How many units there are.
    pub units: usize,
    /// Why stored trials were not reused; empty if there were none or all were.
    pub why: Vec<String>,
    /// Trials that were run again and now differ from what was stored under equal dependencies.
    pub moved: Vec<String>,
    /// Trials that brought neither a path nor the answer that there is none, by status.
    pub odd: Vec<UnexpectedStatus>,
}

/// Trials of one status that a reader may not have expected.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UnexpectedStatus {
    /// The status.
    pub status: Status,
    /// How many there are.
    pub count: usize,
    /// The first of them.
    pub trial: String,
    /// Why it ended so.
    pub reason: String,
}

impl UnexpectedStatus {
    /// Those among `rows`, in the order of [`Status::ALL`].
    fn among(rows: &[Row]) -> Vec<Self> {
        let is_odd = |status: &Status| ![Status::Solved, Status::NoPath].contains(status);
        let of = |status: Status| {
            let all: Vec<&Row> = rows.iter().filter(|row| row.status == status).collect();
            let first = all.first()?;
            let reason = first.reason.clone().unwrap_or_default();
            Some(Self { status, count: all.len(), trial: first.trial.clone(), reason })
        };
        Status::ALL.into_iter().filter(is_odd).filter_map(of).collect()
    }
}

/// Runs what is stale of `study`; where nothing is, the stored run stays as it is.
///
/// # Errors
/// [`StudyError::Interrupted`] if it was stopped, and those of the file system. Records that existed before stay as they
/// are unless the run succeeds.
pub fn run(study: &Study, options: &Options<'_>) -> Result<Report, StudyError> {
    let (built, folder) = (BuiltStudy::new(study, options.points, options.inputs)?, options.lock.folder());
    let (claims, command) = (options.claims.clone(), options.command.clone());
    let mut manifest = Manifest::new(study, options.points, &built, claims, command, options.quick)?;
    remove_temporaries(folder, &study.name);
    let (journal, mut done) = Journal::open(&journal_path(folder, &study.name), &manifest.depends)?;
    let (resumed, units) = (done.len(), built.units().len());
    let Before { stored, why } = before(folder, &manifest);
    let found = match &stored {
        Some((before, records)) if !options.fresh => reusable(&built, &manifest, before, records),
        _ => BTreeMap::new(),
    };
    let reused = found.keys().filter(|index| !done.contains_key(index)).count();
    if let Some((before, records)) = &stored
        && reused == units
        && (&before.spec, &before.depends) == (&manifest.spec, &manifest.depends)
    {
        journal.remove()?;
        let (manifest, rows) = (before.clone(), &records.batch.rows);
        let (trials, odd) = (rows.len(), UnexpectedStatus::among(rows));
        return Ok(Report { manifest, trials, resumed, reused, units, why, moved: Vec::new(), odd });
    }
    if let Some((before, _)) = stored.as_ref().filter(|_| reused > 0) {
        // These trials were seen under the former claims, so that a margin which has moved since stays marked.
        manifest.claims.clone_from(&before.claims);
    }
    done = found.into_iter().chain(done).collect();
    let journal = Mutex::new(journal);
    let pool = pool(options.threads);
    let batch = pool.install(|| built.run(done, &journal, options.stop, options.progress))?;
    let times = built.time(options.stop, options.progress)?;
    let moved = stored.map_or_else(Vec::new, |(before, records)| moved(&manifest, &before, &records, &batch));
    let records = Records { batch, times };
    write(study, folder, &mut manifest, &records)?;
    journal.into_inner().expect("no thread panicked while it wrote").remove()?;
    let (trials, odd) = (records.batch.rows.len(), UnexpectedStatus::among(&records.batch.rows));
    Ok(Report { manifest, trials, resumed, reused, units, why, moved, odd })
}

/// What is stored of a study, and why it cannot stand for the run that `manifest` describes.
struct Before {
    stored: Option<(Manifest, Records)>,
    why: Vec<String>,
}

fn before(folder: &Path, manifest: &Manifest) -> Before {
    if !Manifest::path(folder, &manifest.study).exists() {
        return Before { stored: None, why: Vec::new() };
    }
    match stored(folder, &manifest.study) {
        Ok((before, records)) => {
            let why = manifest.differs_from(&before);
            Before { stored: Some((before, records)), why }
        }
        Err(error) => Before { stored: None, why: vec![format!("what is stored cannot be used: {error}")] },
    }
}

/// Puts records and manifest in their places, the manifest last: it says which records are whole.
fn write(study: &Study, folder: &Path, manifest: &mut Manifest, records: &Records) -> Result<(), StudyError> {
    let columns: Vec<&'static str> = study.columns().into_iter().collect();
    let mut staged = Staged::default();
    manifest.files = stage_records(&mut staged, folder, &study.name, &columns, records)?;
    manifest.stage(&mut staged, folder)?;
    staged.put()
}

/// The trial called `trial` run alone, without touching any file, and the same row as it is stored.
///
/// # Errors
/// [`StudyError::UnknownTrial`].
pub fn run_one(
    study: &Study,
    points: &[ReadingChoice],
    inputs: &Inputs,
    folder: &Path,
    trial: &str,
) -> Result<(Batch, Option<Row>), StudyError> {
    let built = BuiltStudy::new(study, points, inputs)?;
    let units = built.units();
    let owner = units.iter().find(|unit| built.trials(unit).iter().any(|name| name == trial));
    // What a task finds may have rows of its own, below a trial's name.
    let is_below = |name: &str| trial.strip_prefix(name).is_some_and(|rest| rest.starts_with('/'));
    let owner =
        owner.or_else(|| units.iter().find(|unit| built.trials(unit).iter().any(|name| is_below(name))));
    let unknown = || {
        let first = units.first().and_then(|unit| built.trials(unit).into_iter().next());
        let hint = format!("its first one is `{}/{}`", study.name, first.unwrap_or_default());
        StudyError::UnknownTrial { study: study.name.clone(), trial: trial.to_owned(), hint }
    };
    let owner = owner.ok_or_else(unknown)?;
    let wanted = Some(BTreeSet::from([trial.to_owned()]));
    let mut batch = built.run_unit(&Unit { name: owner.name.clone(), keeps_all: true, wanted, ..*owner });
    batch.rows.retain(|row| row.trial == trial);
    batch.kept.retain(|kept| kept.of == trial);
    let before = if Manifest::path(folder, &study.name).exists() {
        let (_, records) = stored(folder, &study.name)?;
        records.batch.rows.into_iter().find(|row| row.trial == trial)
    } else {
        None
    };
    if batch.rows.is_empty() && before.is_none() {
        return Err(unknown());
    }
    Ok((batch, before))
}

fn journal_path(folder: &Path, study: &str) -> std::path::PathBuf {
    folder.join(format!("{study}.journal"))
}

/// A pool of `threads` threads; of the machine's number if absent.
pub(super) fn pool(threads: Option<usize>) -> rayon::ThreadPool {
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads.unwrap_or(0))
        .build()
        .expect("the system gives a process its first threads")
}

fn stored(folder: &Path, study: &str) -> Result<(Manifest, Records), StudyError> {
    let manifest = Manifest::read(folder, study)?;
    let records = read_records(folder, study, &manifest.files)?;
    Ok((manifest, records))
}

/// The units of which every record is stored and depends on nothing that has changed.
fn reusable(
    built: &BuiltStudy<'_>,
    manifest: &Manifest,
    before: &Manifest,
    records: &Records,
) -> BTreeMap<usize, Batch> {
    let mut batches: BTreeMap<usize, Batch> = BTreeMap::new();
    if manifest.contenders != before.contenders {
        return batches;
    }
    let units = built.units();
    let is_same = |unit: &Unit<'_>| {
        let key = key(unit.point.name(), &unit.group.label);
        manifest.problems.get(&key) == before.problems.get(&key)
    };
    let same = units.iter().enumerate().filter(|(_, unit)| is_same(unit));
    let by_name: BTreeMap<&str, usize> = same.map(|(index, unit)| (unit.name.as_str(), index)).collect();
    let mut by_draw = BTreeMap::new();
    let mut owners: BTreeMap<&str, usize> = BTreeMap::new();
    for row in &records.batch.prepared {
        let Some(index) = by_name.get(row.prepared.as_str()) else { continue };
        by_draw.insert((row.reading.as_str(), row.group.as_str(), row.replicate), *index);
        owners.insert(&row.prepared, *index);
        batches.entry(*index).or_default().prepared.push(row.clone());
    }
    for row in &records.batch.rows {
        let draw = (row.reading.as_str(), row.group.as_str(), row.replicate);
        let Some(index) = by_draw.get(&draw) else { continue };
        owners.insert(&row.trial, *index);
        batches.entry(*index).or_default().rows.push(row.clone());
    }
    for kept in &records.batch.kept {
        let Some(index) = owners.get(kept.of.as_str()) else { continue };
        batches.entry(*index).or_default().kept.push(kept.clone());
    }
    batches
}

/// Trials whose problem and contender are unchanged but whose row is not what was stored.
fn moved(manifest: &Manifest, before: &Manifest, records: &Records, batch: &Batch) -> Vec<String> {
    let old: BTreeMap<&str, &Row> = records.batch.rows.iter().map(|row| (row.trial.as_str(), row)).collect();
    let unchanged = |row: &Row| {
        let (problem, contender) = (key(&row.reading, &row.group), key(&row.reading, &row.contender));
        manifest.problems.get(&problem) == before.problems.get(&problem)
            && manifest.contenders.get(&contender) == before.contenders.get(&contender)
    };
    let differs = |row: &&Row| old.get(row.trial.as_str()).is_some_and(|stored| *stored != *row);
    batch.rows.iter().filter(|row| unchanged(row)).filter(differs).map(|row| row.trial.clone()).collect()
}
