//! Records on disk: Parquet files written whole or not at all, and the journal of a run that is not over.
//!
//! Every file is written beside its place under a temporary name, flushed to disk and renamed, so a reader sees
//! the old file or the new one. The journal is the one file that grows; a torn last line is dropped on reading.

mod describe;
mod journal;
mod pick;
mod read;
mod table;
mod traces;
mod write;

pub use journal::{Journal, journal_units};
pub use pick::KeptTraces;
pub use read::quoted;
pub(crate) use read::{UNREADABLE, unpanicked};
pub use traces::{GROUP_VALUES, TraceReader};
pub use write::{RecordWriter, Shape};

use self::read::{Instances, Stored};
use super::checked::Study;
use super::column;
use super::error::{REMEDY, StudyError};
use super::key::{KeyColumns, SweepKey};
use super::parquet::FrameReader;
use super::record::{Batch, Kept, Row, Timing};
use base::file::check_own;
use base::hash::{Hasher, sha256};
use std::collections::BTreeMap;
use std::fs;
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

/// The records of one study.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Records {
    /// Preprocessed objects, trials and traces.
    pub batch: Batch,
    /// Readings of the clock, of all sessions.
    pub times: Vec<Timing>,
}

/// The columns of a study's records besides those that every study has.
#[derive(Debug)]
pub struct Columns {
    /// Those of keys.
    pub keys: KeyColumns,
    /// Those that its trials can fill.
    pub values: Vec<&'static str>,
}

impl Columns {
    /// The columns of `study`.
    pub fn new(study: &Study) -> Self {
        Self { keys: study.key_columns(), values: study.columns().into_iter().collect() }
    }
}

/// How names of half-written files end.
const TEMPORARY: &str = ".tmp";

/// Where the part `part` of `study`'s records lies in `folder`.
pub fn part_path(folder: &Path, study: &str, part: &str) -> PathBuf {
    folder.join(format!("{study}.{part}.parquet"))
}

/// Traces on their way to a file, in the order of records.
pub struct Traces<'a> {
    /// The traces.
    pub each: Box<dyn Iterator<Item = Result<Kept, StudyError>> + 'a>,
    /// The sweep of one that belongs to a trial, if any does.
    pub sweep: Option<SweepKey>,
    /// How many numbers at most are read back at a time.
    pub group_values: usize,
}

impl<'a> Traces<'a> {
    /// Those that are held in memory.
    pub fn held(kept: &'a [Kept]) -> Self {
        Self {
            each: Box::new(kept.iter().cloned().map(Ok)),
            sweep: traces::sweep_of(kept),
            group_values: GROUP_VALUES,
        }
    }
}

/// Stages every part of `records` for `folder`, with `traces` in place of its own, and gives the hash of each file by
/// its part.
///
/// # Errors
/// [`StudyError::Io`]; no file has changed then. Those of `traces`.
pub fn stage_records(
    staged: &mut Staged,
    folder: &Path,
    study: &str,
    columns: &Columns,
    records: &Records,
    traces: Traces<'_>,
) -> Result<BTreeMap<String, String>, StudyError> {
    let mut shape = Shape { group_values: traces.group_values, ..Shape::new(traces.sweep.clone()) };
    shape.note(&records.batch.preprocessing);
    let mut files = RecordWriter::new(staged, folder, study, columns, shape)?;
    files.add_with(&records.batch, traces)?;
    files.finish(&records.times)
}

/// Reads every part of `study`'s records in `folder`, each checked against its hash in `hashes`.
///
/// # Errors
/// [`StudyError::Touched`] for a file that is missing or is not what the manifest speaks of.
pub fn read_records(
    folder: &Path,
    study: &str,
    hashes: &BTreeMap<String, String>,
) -> Result<Records, StudyError> {
    read_parts(folder, study, hashes, true)
}

/// As [`read_records`], without traces, so that numbers alone take little memory.
///
/// # Errors
/// As [`read_records`].
pub fn read_numbers(
    folder: &Path,
    study: &str,
    hashes: &BTreeMap<String, String>,
) -> Result<Records, StudyError> {
    read_parts(folder, study, hashes, false)
}

/// The trials of `study` in `folder` without their numbers, if every part of its records has its hash in `hashes`.
///
/// # Errors
/// As [`read_records`].
pub fn read_endings(
    folder: &Path,
    study: &str,
    hashes: &BTreeMap<String, String>,
) -> Result<Vec<Row>, StudyError> {
    check_records(folder, study, hashes)?;
    let path = part_path(folder, study, "trials");
    let file = fs::File::open(&path).map_err(StudyError::io(&path, "opening the file"))?;
    let read = || FrameReader::open(file)?.columns(|name| column::find(name).is_none());
    Stored::read_by(path, read)?.guarded(|file| file.trials(&mut Instances::default()))
}

fn read_parts(
    folder: &Path,
    study: &str,
    hashes: &BTreeMap<String, String>,
    with_traces: bool,
) -> Result<Records, StudyError> {
    let instances = &mut Instances::default();
    let open = |part: &str| open(folder, study, part, hashes);
    Ok(Records {
        batch: Batch {
            rows: open("trials")?.guarded(|file| file.trials(instances))?,
            preprocessing: open("preprocessing")?.guarded(|file| file.preprocessing(instances))?,
            kept: if with_traces {
                open("traces")?.guarded(|file| file.traces(instances))?
            } else {
                Vec::new()
            },
        },
        times: open("times")?.guarded(|file| file.times(instances))?,
    })
}

/// The parts of a study's records.
const PARTS: [&str; 4] = ["trials", "preprocessing", "traces", "times"];

/// The sound parts of `study`'s records in `folder`, without traces, and the damaged parts.
pub fn salvaged(
    folder: &Path,
    study: &str,
    hashes: &BTreeMap<String, String>,
) -> (Records, Vec<&'static str>) {
    let instances = &mut Instances::default();
    let mut damaged: Vec<&'static str> = Vec::new();
    let rows = open(folder, study, "trials", hashes).and_then(|f| f.guarded(|file| file.trials(instances)));
    let preprocessing = open(folder, study, "preprocessing", hashes)
        .and_then(|f| f.guarded(|file| file.preprocessing(instances)));
    let times = open(folder, study, "times", hashes).and_then(|f| f.guarded(|file| file.times(instances)));
    let traces = KeptTraces::stored(folder, study, hashes);
    let are_sound = [rows.is_ok(), preprocessing.is_ok(), traces.is_ok(), times.is_ok()];
    damaged.extend(PARTS.iter().zip(are_sound).filter(|(_, is_sound)| !is_sound).map(|(part, _)| part));
    let batch = Batch {
        rows: rows.unwrap_or_default(),
        preprocessing: preprocessing.unwrap_or_default(),
        kept: Vec::new(),
    };
    (Records { batch, times: times.unwrap_or_default() }, damaged)
}

/// Renames the file at `path`, if there is one, so that it stays beside its place; its new name.
///
/// # Errors
/// [`StudyError::Io`].
pub fn set_aside(path: &Path) -> Result<Option<PathBuf>, StudyError> {
    if path.symlink_metadata().is_err() {
        return Ok(None);
    }
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let mut free = (1..).map(|number| path.with_file_name(format!("{name}.damaged-{number}")));
    let aside = free.find(|aside| aside.symlink_metadata().is_err()).expect("numbers do not end");
    fs::rename(path, &aside).map_err(StudyError::io(path, "setting the file aside"))?;
    Ok(Some(aside))
}

/// Sets aside these parts of `study`'s records in `folder`; their new names.
///
/// # Errors
/// [`StudyError::Io`].
pub fn set_parts_aside(folder: &Path, study: &str, parts: &[&str]) -> Result<Vec<PathBuf>, StudyError> {
    let aside = parts.iter().map(|part| set_aside(&part_path(folder, study, part)));
    Ok(aside.collect::<Result<Vec<_>, _>>()?.into_iter().flatten().collect())
}

/// As [`set_parts_aside`], of all parts.
///
/// # Errors
/// [`StudyError::Io`].
pub fn set_records_aside(folder: &Path, study: &str) -> Result<Vec<PathBuf>, StudyError> {
    set_parts_aside(folder, study, &PARTS)
}

/// Finishes a run that was killed while it renamed its files. Files of `study` that stand whole beside their places are
/// put there, so that records and manifest are of one run again. `files` gives the hashes in a whole manifest, which is
/// put at `manifest`. The caller holds the folder's lock.
pub fn finish_put(
    folder: &Path,
    study: &str,
    manifest: &Path,
    files: impl Fn(&Path) -> Option<BTreeMap<String, String>>,
) {
    let begin = format!("{}.", manifest.file_name().unwrap_or_default().to_string_lossy());
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        let Some(end) = name.strip_prefix(&begin).filter(|end| end.ends_with(TEMPORARY)) else { continue };
        let Some(hashes) = files(&entry.path()) else { continue };
        let beside = |path: &Path| {
            path.with_file_name(format!("{}.{end}", path.file_name().unwrap_or_default().to_string_lossy()))
        };
        let is_file = |path: &Path, hash: &String| hash_of(path).is_ok_and(|found| found == *hash);
        let paths = hashes.iter().map(|(part, hash)| (part_path(folder, study, part), hash));
        let left: Vec<(PathBuf, &String)> = paths.filter(|(path, hash)| !is_file(path, hash)).collect();
        if left.iter().all(|(path, hash)| is_file(&beside(path), hash)) {
            let staged = left.into_iter().map(|(path, _)| (beside(&path), path));
            let manifest = (entry.path(), manifest.to_owned());
            let files = staged.chain([manifest]).collect();
            // What cannot be put there is refused as damage by who reads it.
            let _ = Staged { files }.put();
        }
    }
}

/// Refuses records of `study` in `folder` if a file is gone or does not have its hash in `hashes`.
///
/// # Errors
/// [`StudyError::Touched`].
pub fn check_records(
    folder: &Path,
    study: &str,
    hashes: &BTreeMap<String, String>,
) -> Result<(), StudyError> {
    for (part, hash) in hashes {
        let path = part_path(folder, study, part);
        check(&path, &hash_of(&path)?, Some(hash))?;
    }
    Ok(())
}

/// The SHA-256 of the file at `path`, which is not held in memory.
fn hash_of(path: &Path) -> Result<String, StudyError> {
    let mut hasher = Hasher::default();
    let copied = check_own(path)
        .and_then(|()| fs::File::open(path))
        .and_then(|mut file| io::copy(&mut file, &mut hasher));
    copied.map_err(|error| unreadable(path, &error))?;
    Ok(hasher.finish())
}

/// The traces of `study` in `folder`, to be read one group at a time; they must have their hash among `hashes`.
///
/// # Errors
/// As [`read_records`].
pub fn open_traces(
    folder: &Path,
    study: &str,
    hashes: &BTreeMap<String, String>,
) -> Result<TraceReader, StudyError> {
    let path = part_path(folder, study, "traces");
    check(&path, &hash_of(&path)?, hashes.get("traces"))?;
    TraceReader::open(&path)
}

/// A file that its manifest names and that is gone or cannot be read.
fn unreadable(path: &Path, error: &io::Error) -> StudyError {
    read::touched(path, &format!("cannot be read ({error})"))
}

/// Refuses a file that is not the one that a manifest names.
fn check(path: &Path, found: &str, wanted: Option<&String>) -> Result<(), StudyError> {
    let wanted = wanted.map_or("none", String::as_str);
    if found == wanted {
        return Ok(());
    }
    let message = format!(
        "{}: is not the file that the manifest names (sha256 {}… instead of {}…): truncated, edited, or from another spec; \
         {REMEDY}",
        path.display(),
        &found[..12],
        wanted.get(..12).unwrap_or(wanted)
    );
    Err(StudyError::Touched(message))
}

/// The part `part` of `study`'s records in `folder`, which must have its hash among `hashes`.
fn open(
    folder: &Path,
    study: &str,
    part: &str,
    hashes: &BTreeMap<String, String>,
) -> Result<Stored, StudyError> {
    let path = part_path(folder, study, part);
    let bytes = check_own(&path).and_then(|()| fs::read(&path)).map_err(|e| unreadable(&path, &e))?;
    check(&path, &sha256(&bytes), hashes.get(part))?;
    Stored::open(path, bytes)
}

/// The part `part` of `study`'s records in `folder` as comma-separated values, checked as in [`read_records`].
///
/// # Errors
/// As [`read_records`].
pub fn csv(
    folder: &Path,
    study: &str,
    part: &str,
    hashes: &BTreeMap<String, String>,
) -> Result<String, StudyError> {
    open(folder, study, part, hashes)?.guarded(|file| Ok(file.csv()))
}

/// Files that are written, but not in their places yet: all of them are put there, or none.
///
/// A disk that fills up is noticed while files are staged, before any of them replaces an older one.
#[derive(Debug, Default)]
pub struct Staged {
    files: Vec<(PathBuf, PathBuf)>,
}

impl Staged {
    /// Writes `bytes` beside `path`.
    ///
    /// # Errors
    /// [`StudyError::Io`] with the path and what was being done, also if a folder stands in its place.
    pub fn add(&mut self, path: &Path, bytes: &[u8]) -> Result<(), StudyError> {
        let mut out = self.begin(path)?;
        let written = out.write_all(bytes).and_then(|()| out.finish());
        written.map(drop).map_err(StudyError::io(path, "writing the file"))
    }

    /// Begins a file beside `path`.
    ///
    /// # Errors
    /// As [`add`](Self::add).
    fn begin(&mut self, path: &Path) -> Result<Hashed, StudyError> {
        let folder = path.parent().unwrap_or(Path::new("."));
        fs::create_dir_all(folder).map_err(StudyError::io(folder, "creating the folder"))?;
        let io = || StudyError::io(path, "writing the file");
        if path.is_dir() {
            return Err(io()(ErrorKind::IsADirectory.into()));
        }
        let mut name = path.file_name().unwrap_or_default().to_owned();
        name.push(format!(".{}{TEMPORARY}", std::process::id()));
        let temporary = folder.join(name);
        remove_litter(path);
        self.files.push((temporary.clone(), path.to_owned()));
        // What was planted under the temporary name is replaced, not written through.
        let _ = fs::remove_file(&temporary);
        let file = fs::File::create_new(&temporary).map_err(io())?;
        Ok(Hashed { file, hasher: Hasher::default() })
    }

    /// Puts every file in its place, in the order in which they were added.
    ///
    /// # Errors
    /// [`StudyError::Io`].
    pub fn put(mut self) -> Result<(), StudyError> {
        self.files.drain(..).try_for_each(|(temporary, path)| {
            fs::rename(&temporary, &path).map_err(StudyError::io(&path, "writing the file"))
        })
    }
}

/// A file whose bytes are hashed on their way.
struct Hashed {
    file: fs::File,
    hasher: Hasher,
}

impl Hashed {
    /// Flushes the file to disk and gives its SHA-256.
    fn finish(self) -> io::Result<String> {
        self.file.sync_all().map(|()| self.hasher.finish())
    }
}

impl Write for Hashed {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = self.file.write(bytes)?;
        self.hasher.write_all(&bytes[..count])?;
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Drop for Staged {
    fn drop(&mut self) {
        for (temporary, _) in &self.files {
            // A half-written file is of no use to anyone; if even removing it fails, the first error says more.
            let _ = fs::remove_file(temporary);
        }
    }
}

/// Writes `bytes` to `path`, whole or not at all.
///
/// # Errors
/// [`StudyError::Io`] with the path and what was being done.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), StudyError> {
    let mut staged = Staged::default();
    staged.add(path, bytes)?;
    staged.put()
}

/// Writes `bytes` to `path` unless a file is there already, which stays. Of several writers, one is first.
///
/// # Errors
/// [`StudyError::Io`] with the path and what was being done.
pub fn write_first(path: &Path, bytes: &[u8]) -> Result<(), StudyError> {
    let mut staged = Staged::default();
    staged.add(path, bytes)?;
    let linked = staged.files.iter().try_for_each(|(temporary, path)| fs::hard_link(temporary, path));
    match linked {
        Err(error) if error.kind() == ErrorKind::AlreadyExists => Ok(()),
        other => other.map_err(StudyError::io(path, "writing the file")),
    }
}

/// Removes what commands that were killed left half-written beside `path`: their processes live no more.
fn remove_litter(path: &Path) {
    let folder = path.parent().unwrap_or(Path::new("."));
    let begin = format!("{}.", path.file_name().unwrap_or_default().to_string_lossy());
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        let process = name.strip_prefix(&begin).and_then(|rest| rest.strip_suffix(TEMPORARY)?.parse().ok());
        if process.is_some_and(|process| !external::is_living(process)) {
            let _ = fs::remove_file(entry.path());
        }
    }
}

/// Removes what a killed run of `study` left half-written in `folder`; only for who holds the folder's lock.
pub fn remove_temporaries(folder: &Path, study: &str) {
    let prefix = format!("{study}.");
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        if name.starts_with(&prefix) && name.ends_with(TEMPORARY) {
            // What cannot be removed does no harm but taking room.
            let _ = fs::remove_file(entry.path());
        }
    }
}

#[cfg(test)]
mod tests;
