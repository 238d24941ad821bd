//! Records on disk: Parquet files written whole or not at all, and the journal of a run that is not over.
//!
//! Every file is written beside its place under a temporary name, flushed to disk and renamed, so a reader sees
//! the old file or the new one. The journal is the one file that grows; a torn last line is dropped on reading.

mod describe;
mod journal;
mod read;
mod table;

pub use journal::Journal;

use self::read::{Draws, Stored};
use super::StudyError;
use super::key::KeyColumns;
use super::record::{Batch, Timing};
use base::hash::sha256;
use std::collections::BTreeMap;
use std::fs;
use std::io::{ErrorKind, Write as _};
use std::path::{Path, PathBuf};

/// The records of one study.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Records {
    /// Prepared objects, trials and exhibits.
    pub batch: Batch,
    /// Clock readings.
    pub times: Vec<Timing>,
}

/// The columns of a study's records besides those that every study has.
#[derive(Debug)]
pub struct Columns<'a> {
    /// Those of keys.
    pub keys: KeyColumns,
    /// Those that its trials can fill.
    pub values: &'a [&'static str],
}

/// The kinds of file that hold a study's records.
const PARTS: [&str; 4] = ["trials", "prepared", "exhibits", "times"];

/// How names of half-written files end.
const TEMPORARY: &str = ".tmp";

/// Where the part `part` of `study`'s records lies in `folder`.
pub fn part_path(folder: &Path, study: &str, part: &str) -> PathBuf {
    folder.join(format!("{study}.{part}.parquet"))
}

/// Stages every part of `records` for `folder` and gives the hash of each file by its part.
///
/// # Errors
/// [`StudyError::Io`]; no file has changed then.
pub fn stage_records(
    staged: &mut Staged,
    folder: &Path,
    study: &str,
    columns: &Columns<'_>,
    records: &Records,
) -> Result<BTreeMap<String, String>, StudyError> {
    let keys = &columns.keys;
    let parts = [
        table::trials(&records.batch.rows, keys, columns.values),
        table::prepared(&records.batch.prepared, keys),
        table::exhibits(&records.batch.kept, keys),
        table::times(&records.times, keys),
    ];
    let mut hashes = BTreeMap::new();
    for (part, frame) in PARTS.into_iter().zip(parts) {
        let bytes = table::to_parquet(frame, keys);
        staged.add(&part_path(folder, study, part), &bytes)?;
        hashes.insert(part.to_owned(), sha256(&bytes));
    }
    Ok(hashes)
}

/// Reads every part of `study`'s records in `folder`, each checked against its hash in `hashes`.
///
/// # Errors
/// [`StudyError::Stored`] for a file that is missing, [`StudyError::Touched`] for one that is not what the manifest speaks of.
pub fn read_records(
    folder: &Path,
    study: &str,
    hashes: &BTreeMap<String, String>,
) -> Result<Records, StudyError> {
    let open = |part: &str| -> Result<Stored, StudyError> {
        let path = part_path(folder, study, part);
        let bytes = fs::read(&path)
            .map_err(|e| StudyError::stored(&path, format!("cannot be read ({e}); run the study again")))?;
        let (found, wanted) = (sha256(&bytes), hashes.get(part).map_or("none", String::as_str));
        if found != wanted {
            let message = format!(
                "{}: is not the file that the manifest names (sha256 {}… instead of {}…): truncated, edited, or from \
                 another spec; run the study again",
                path.display(),
                &found[..12],
                wanted.get(..12).unwrap_or(wanted)
            );
            return Err(StudyError::Touched(message));
        }
        Stored::open(path, bytes)
    };
    let draws = &mut Draws::default();
    Ok(Records {
        batch: Batch {
            rows: open("trials")?.trials(draws)?,
            prepared: open("prepared")?.prepared(draws)?,
            kept: open("exhibits")?.exhibits(draws)?,
        },
        times: open("times")?.times(draws)?,
    })
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
        let folder = path.parent().unwrap_or(Path::new("."));
        fs::create_dir_all(folder).map_err(StudyError::io(folder, "creating the folder"))?;
        let io = || StudyError::io(path, "writing the file");
        if path.is_dir() {
            return Err(io()(ErrorKind::IsADirectory.into()));
        }
        let mut name = path.file_name().unwrap_or_default().to_owned();
        name.push(format!(".{}{TEMPORARY}", std::process::id()));
        let temporary = folder.join(name);
        self.files.push((temporary.clone(), path.to_owned()));
        let written = fs::File::create(&temporary).and_then(|mut file| {
            file.write_all(bytes)?;
            file.sync_all()
        });
        written.map_err(io())
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
