//! Records on disk: Parquet files written whole or not at all, and the journal of a run that is not over.
//!
//! Every file is written beside its place under a temporary name, flushed to disk and renamed, so a reader sees
//! the old file or the new one. The journal is the one file that grows; a torn last line is dropped on reading.

mod journal;
mod table;

pub use journal::Journal;

use super::StudyError;
use super::record::{Batch, Timing};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};

/// The records of one study.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Records {
    /// Prepared objects, trials and exhibits.
    pub batch: Batch,
    /// Clock readings.
    pub times: Vec<Timing>,
}

/// The kinds of file that hold a study's records.
const PARTS: [&str; 4] = ["trials", "prepared", "exhibits", "times"];

/// Where the part `part` of `study`'s records lies in `folder`.
pub fn part_path(folder: &Path, study: &str, part: &str) -> PathBuf {
    folder.join(format!("{study}.{part}.parquet"))
}

/// Writes every part of `records` into `folder` and returns the hash of each file by its name.
///
/// # Errors
/// [`StudyError::Io`]; files that were not reached keep what they held.
pub fn write_records(
    folder: &Path,
    study: &str,
    columns: &[&'static str],
    records: &Records,
) -> Result<BTreeMap<String, String>, StudyError> {
    let parts = [
        table::trials(&records.batch.rows, columns),
        table::prepared(&records.batch.prepared),
        table::exhibits(&records.batch.kept),
        table::times(&records.times),
    ];
    let mut hashes = BTreeMap::new();
    for (part, frame) in PARTS.into_iter().zip(parts) {
        let path = part_path(folder, study, part);
        let bytes = table::to_parquet(frame);
        write_whole(&path, &bytes)?;
        hashes.insert(part.to_owned(), sha256(&bytes));
    }
    Ok(hashes)
}

/// Reads every part of `study`'s records in `folder`, each checked against its hash in `hashes`.
///
/// # Errors
/// [`StudyError::Stored`] for a file that is missing, truncated or not the one that the manifest speaks of.
pub fn read_records(
    folder: &Path,
    study: &str,
    hashes: &BTreeMap<String, String>,
) -> Result<Records, StudyError> {
    let open = |part: &str| -> Result<table::Stored, StudyError> {
        let path = part_path(folder, study, part);
        let bytes = fs::read(&path)
            .map_err(|e| StudyError::stored(&path, format!("cannot be read ({e}); run the study again")))?;
        let (found, wanted) = (sha256(&bytes), hashes.get(part).map_or("none", String::as_str));
        if found != wanted {
            let message = format!(
                "is not the file that the manifest names (sha256 {}… instead of {}…): truncated, edited, or from \
                 another spec; run the study again",
                &found[..12],
                wanted.get(..12).unwrap_or(wanted)
            );
            return Err(StudyError::stored(&path, message));
        }
        table::Stored::open(path, bytes)
    };
    Ok(Records {
        batch: Batch {
            rows: open("trials")?.trials()?,
            prepared: open("prepared")?.prepared()?,
            kept: open("exhibits")?.exhibits()?,
        },
        times: open("times")?.times()?,
    })
}

/// Writes `bytes` to `path`, whole or not at all.
///
/// # Errors
/// [`StudyError::Io`] with the path and what was being done.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), StudyError> {
    let folder = path.parent().unwrap_or(Path::new("."));
    fs::create_dir_all(folder).map_err(StudyError::io(folder, "creating the folder"))?;
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(format!(".{}.tmp", std::process::id()));
    let temporary = folder.join(name);
    let written = fs::File::create(&temporary).and_then(|mut file| {
        file.write_all(bytes)?;
        file.sync_all()
    });
    let renamed = written.and_then(|()| fs::rename(&temporary, path));
    renamed.map_err(|e| {
        // The half-written file is of no use to anyone; if even removing it fails, the first error says more.
        let _ = fs::remove_file(&temporary);
        StudyError::io(path, "writing the file")(e)
    })
}

/// The SHA-256 of `bytes` in hexadecimal.
pub fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().fold(String::new(), |mut text, byte| {
        let _ = write!(text, "{byte:02x}");
        text
    })
}
