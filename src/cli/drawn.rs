//! What was drawn of a paper, so that `repro` draws nothing again where nothing has changed.
//!
//! A stamp names all that files are made from – the program, the specs, the records by their manifests, the verdicts – and each
//! file that was made, by its hash. It is believed only while all of them are as they were, and only by `repro`, which has just
//! held the records to their manifests and judged: `render` always draws, and so does every `--check`.

use super::Failure;
use super::places::Places;
use crate::analysis::verdict::Verdicts;
use crate::render::output::{CROSSCHECK, Outputs};
use crate::study::manifest::Manifest;
use crate::study::paper::Paper;
use crate::study::store::write_whole;
use base::hash::sha256;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::os::unix::fs::MetadataExt as _;
use std::path::PathBuf;
use std::{env, fs, io};

/// All that the files of a paper are made from, and the files.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Stamp {
    made_from: String,
    /// SHA-256 of each file.
    files: BTreeMap<PathBuf, String>,
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
    pub fn of(paper: &Paper, places: &Places, verdicts: &Verdicts) -> Result<Self, Failure> {
        let mut from = vec![program()?, paper.document.text().to_owned(), verdicts.text()];
        for study in &paper.studies {
            from.push(study.document.text().to_owned());
            from.push(fs::read_to_string(Manifest::path(&places.runs, &study.name))?);
        }
        // The chapter leads to it where there is one.
        from.push(places.plots.join(CROSSCHECK).is_file().to_string());
        let hashes: Vec<String> = from.iter().map(|text| sha256(text.as_bytes())).collect();
        let run = sha256(format!("{:?} {:?}", fs::canonicalize(".")?, places.plots).as_bytes());
        let name = format!("drawn-{}-{}.json", paper.id, &run[..12]);
        let path = places.home.join("target/replan/cache").join(name);
        Ok(Self { path, made_from: sha256(hashes.concat().as_bytes()) })
    }

    /// Whether that is what was drawn, and every file is as it was.
    pub fn is_current(&self) -> bool {
        let stamp: Option<Stamp> =
            fs::read(&self.path).ok().and_then(|text| serde_json::from_slice(&text).ok());
        stamp.is_some_and(|stamp| {
            let is_same = |(path, hash): (&PathBuf, &String)| hash_of(path).is_ok_and(|found| found == *hash);
            stamp.made_from == self.made_from && stamp.files.iter().all(is_same)
        })
    }

    /// Keeps that `outputs` and the report were made from it. What cannot be kept is drawn again another time.
    pub fn keep(&self, places: &Places, outputs: &Outputs) {
        let drawn = outputs.files.iter().map(|output| places.plots.join(&output.name));
        let hashed = |path: PathBuf| {
            let hash = hash_of(&path)?;
            Ok((path, hash))
        };
        let files = drawn.chain([places.report.clone()]).map(hashed).collect::<io::Result<_>>();
        let text = files
            .ok()
            .and_then(|files| serde_json::to_vec(&Stamp { made_from: self.made_from.clone(), files }).ok());
        if let Some(text) = text.filter(|_| outputs.undrawn.is_empty()) {
            let _ = write_whole(&self.path, &text);
        }
    }
}

fn hash_of(path: &PathBuf) -> io::Result<String> {
    fs::read(path).map(|bytes| sha256(&bytes))
}

/// What tells this build of the program from any other: its file, as it was put there.
fn program() -> io::Result<String> {
    let path = env::current_exe()?;
    let file = fs::metadata(&path)?;
    Ok(format!("{} {} {} {}.{}", path.display(), file.ino(), file.len(), file.mtime(), file.mtime_nsec()))
}
