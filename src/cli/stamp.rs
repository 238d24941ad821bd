//! The outputs of a step of `repro`, remembered so that they are not made again where nothing has changed.
//!
//! A stamp names everything that the files are made from: the program, the specs, the records by their manifests, and
//! the step's other inputs. It also has the hash of each file that was made. A stamp is believed only while all of
//! these are unchanged, and only by `repro`, which has just compared the records with their manifests. `judge`,
//! `render` and every `--check` always work.

use super::Failure;
use super::places::Places;
use base::hash::sha256;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::os::unix::fs::MetadataExt as _;
use std::path::{Path, PathBuf};
use std::{env, fs, io};
use study::manifest::Manifest;
use study::paper::Paper;
use study::store::write_whole;

/// A stamp as it is stored.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Stored {
    made_from: String,
    /// SHA-256 of each file.
    files: BTreeMap<PathBuf, String>,
}

/// Where the stamp of one step on one run of a paper lies, and what the step would work from now.
pub struct Stamp {
    path: PathBuf,
    made_from: String,
}

impl Stamp {
    /// The stamp of the step called `step`, which reads the specs and records of `paper`, and `more`.
    ///
    /// # Errors
    /// A manifest or the program itself that cannot be read.
    pub fn new(step: &str, paper: &Paper, places: &Places, more: &[String]) -> Result<Self, Failure> {
        let mut from = vec![program()?, paper.document.text().to_owned()];
        for study in &paper.studies {
            from.push(study.document.text().to_owned());
            from.push(fs::read_to_string(Manifest::path(&places.runs, &study.name))?);
        }
        let hashes: Vec<String> = from.iter().chain(more).map(|text| sha256(text.as_bytes())).collect();
        // However the paper is named, and from wherever: one place of one run.
        let run = sha256(fs::canonicalize(&places.runs)?.as_os_str().as_encoded_bytes());
        let name = format!("{step}-{}-{}.json", paper.id, &run[..12]);
        let path = places.scratch.join("cache").join(name);
        Ok(Self { path, made_from: sha256(hashes.concat().as_bytes()) })
    }

    /// Whether the step has worked from the same inputs, and every file that it made is unchanged.
    pub fn is_current(&self) -> bool {
        let text = fs::read(&self.path).unwrap_or_default();
        let Ok(stored) = serde_json::from_slice::<Stored>(&text) else { return false };
        stored.made_from == self.made_from
            && stored.files.iter().all(|(path, hash)| hash_of(path).is_ok_and(|found| found == *hash))
    }

    /// Keeps that the step made `files`. What cannot be kept is made again another time.
    pub fn keep(&self, files: impl IntoIterator<Item = PathBuf>) {
        let hashed = |path: PathBuf| -> io::Result<(PathBuf, String)> {
            let hash = hash_of(&path)?;
            Ok((fs::canonicalize(path)?, hash))
        };
        let files: io::Result<BTreeMap<_, _>> = files.into_iter().map(hashed).collect();
        let stored = files.map(|files| Stored { made_from: self.made_from.clone(), files });
        if let Some(text) = stored.ok().and_then(|stored| serde_json::to_vec(&stored).ok()) {
            let _ = write_whole(&self.path, &text);
        }
    }
}

/// The hash of the file at `path`.
///
/// # Errors
/// Those of reading it.
pub fn hash_of(path: &Path) -> io::Result<String> {
    fs::read(path).map(|bytes| sha256(&bytes))
}

/// What tells this build of the program from any other: its file, as it was put there.
fn program() -> io::Result<String> {
    let path = env::current_exe()?;
    let file = fs::metadata(&path)?;
    Ok(format!("{} {} {} {}.{}", path.display(), file.ino(), file.len(), file.mtime(), file.mtime_nsec()))
}
