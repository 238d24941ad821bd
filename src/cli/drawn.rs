//! What was drawn of a paper, so that `repro` draws nothing again where nothing has changed.
//!
//! A stamp names all that files are made from – the program, the specs, the records by their manifests, the verdicts – and each
//! file that was made, by its hash. It is believed only while all of them are as they were, and only by `repro`, which has just
//! held the records to their manifests and judged: `render` always draws, and so does every `--check`.

use super::Failure;
use super::places::Places;
use crate::analysis::verdict::Verdicts;
use crate::render::output::{CROSSCHECK, Outputs};
use base::hash::sha256;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::os::unix::fs::MetadataExt as _;
use std::path::{Path, PathBuf};
use std::{env, fs, io};
use study::manifest::Manifest;
use study::paper::Paper;
use study::store::write_whole;

/// All that the files of a paper are made from, and the files.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Stamp {
    made_from: String,
    /// SHA-256 of each file in the paper's folder of plots, by its name.
    files: BTreeMap<String, String>,
    /// SHA-256 of the report.
    report: String,
}

/// Where the stamp of what is drawn of one run of a paper lies, and what would be drawn from it now.
pub struct Drawn {
    path: PathBuf,
    made_from: String,
}

impl Drawn {
    /// What `verdicts`, which were just judged by the records of `paper`, would be drawn from.
    ///
    /// # Errors
    /// A manifest or the program itself that cannot be read.
    pub fn new(paper: &Paper, places: &Places, verdicts: &Verdicts) -> Result<Self, Failure> {
        let mut from = vec![program()?, paper.document.text().to_owned(), verdicts.text()];
        for study in &paper.studies {
            from.push(study.document.text().to_owned());
            from.push(fs::read_to_string(Manifest::path(&places.runs, &study.name))?);
        }
        // The chapter leads to it where there is one.
        from.push(places.plots.join(CROSSCHECK).is_file().to_string());
        let hashes: Vec<String> = from.iter().map(|text| sha256(text.as_bytes())).collect();
        // However the paper is named, and from wherever: one place of one run.
        fs::create_dir_all(&places.plots)?;
        let run = sha256(fs::canonicalize(&places.plots)?.as_os_str().as_encoded_bytes());
        let name = format!("drawn-{}-{}.json", paper.id, &run[..12]);
        let path = places.scratch.join("cache").join(name);
        Ok(Self { path, made_from: sha256(hashes.concat().as_bytes()) })
    }

    /// Whether that is what was drawn, and every file is as it was.
    pub fn is_current(&self, places: &Places) -> bool {
        let text = fs::read(&self.path).unwrap_or_default();
        let Ok(stamp) = serde_json::from_slice::<Stamp>(&text) else { return false };
        stamp.made_from == self.made_from
            && stamp.files.iter().all(|(name, hash)| is_as(&places.plots.join(name), hash))
            && is_as(&places.report, &stamp.report)
    }

    /// Keeps that `outputs` and the report were made from it. What cannot be kept is drawn again another time.
    pub fn keep(&self, places: &Places, outputs: &Outputs) {
        let files = outputs.files.iter().map(|output| (output.name.clone(), sha256(&output.bytes))).collect();
        let stamp = |report| Stamp { made_from: self.made_from.clone(), files, report };
        let stamp = hash_of(&places.report).ok().filter(|_| outputs.undrawn.is_empty()).map(stamp);
        if let Some(text) = stamp.and_then(|stamp| serde_json::to_vec(&stamp).ok()) {
            let _ = write_whole(&self.path, &text);
        }
    }
}

fn is_as(path: &Path, hash: &str) -> bool {
    hash_of(path).is_ok_and(|found| found == hash)
}

fn hash_of(path: &Path) -> io::Result<String> {
    fs::read(path).map(|bytes| sha256(&bytes))
}

/// What tells this build of the program from any other: its file, as it was put there.
fn program() -> io::Result<String> {
    let path = env::current_exe()?;
    let file = fs::metadata(&path)?;
    Ok(format!("{} {} {} {}.{}", path.display(), file.ino(), file.len(), file.mtime(), file.mtime_nsec()))
}
