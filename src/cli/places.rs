//! Where a paper is read from and where its outputs go.
//!
//! Only a full run with the studies' own seed and default readings may write the committed places; everything else
//! goes below `target/replan/` or where `--out` says.

use super::{Failure, How, Which};
use crate::study::paper::Paper;
use crate::study::{Inputs, Point, Study};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Where the papers of the project lie.
pub const EXPERIMENTS: &str = "experiments";

/// Where things are.
#[derive(Debug, Clone)]
pub struct Places {
    /// The paper's folder.
    pub folder: PathBuf,
    /// Where its records and verdicts are.
    pub runs: PathBuf,
    /// Where its figures and tables are.
    pub plots: PathBuf,
    /// The report that holds its chapter.
    pub report: PathBuf,
    /// Where input files are looked for.
    pub inputs: Inputs,
}

impl Places {
    /// The places of the paper that `which` names; `variant` is what sets a run apart from a full default one.
    ///
    /// # Errors
    /// If there is no such paper; the message lists those that exist.
    pub fn find(which: &Which, variant: &str) -> Result<Self, Failure> {
        let named = Path::new(EXPERIMENTS).join(&which.paper);
        let given = PathBuf::from(&which.paper);
        let (folder, is_own) = if named.join("paper.toml").is_file() {
            (named, false)
        } else if given.join("paper.toml").is_file() {
            (given, true)
        } else {
            return Err(unknown(&which.paper));
        };
        let id = paper_id(&folder)?;
        let root = match (&which.out, variant, is_own) {
            (Some(out), _, _) => out.clone(),
            (None, "", false) => PathBuf::from("."),
            (None, "", true) => folder.join("out"),
            (None, variant, _) => PathBuf::from(format!("target/replan/{id}-{variant}")),
        };
        let root = if root == Path::new(".") { PathBuf::new() } else { root };
        Ok(Self {
            runs: root.join("data/runs").join(&id),
            plots: root.join("plots").join(&id),
            report: root.join("paper_repro.md"),
            inputs: Inputs { roots: vec![folder.clone(), PathBuf::new()] },
            folder,
        })
    }
}

/// Every paper of the project, by name.
pub fn papers() -> Vec<String> {
    let entries = std::fs::read_dir(EXPERIMENTS).into_iter().flatten().flatten();
    let mut names: Vec<String> = entries
        .filter(|entry| entry.path().join("paper.toml").is_file())
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

fn paper_id(folder: &Path) -> Result<String, Failure> {
    let absolute = std::fs::canonicalize(folder)?;
    Ok(absolute.file_name().unwrap_or_default().to_string_lossy().into_owned())
}

fn unknown(name: &str) -> Failure {
    let known = papers();
    let known = if known.is_empty() {
        format!(
            "there is no folder `{EXPERIMENTS}` with papers here; run replan from the project's own folder"
        )
    } else {
        format!("the papers are {}", known.join(", "))
    };
    Failure::input(format!("`{name}` is neither a paper nor a folder with a paper.toml; {known}"))
}

impl How {
    /// What sets this run apart from a full default one; empty if nothing does.
    pub fn variant(&self) -> String {
        let mut parts = Vec::new();
        if self.quick {
            parts.push("quick".to_owned());
        }
        parts.extend(self.seed.map(|seed| format!("seed-{seed}")));
        parts.extend(
            self.readings.as_deref().map(|readings| format!("readings-{}", crate::study::slug(readings))),
        );
        parts.join("-")
    }

    /// The paper with its studies cut down and reseeded as asked.
    pub fn apply(&self, mut paper: Paper) -> Paper {
        let change = |mut study: Study| {
            study.seed = self.seed.unwrap_or(study.seed);
            if self.quick { study.quick() } else { study }
        };
        paper.studies = paper.studies.into_iter().map(change).collect();
        paper
    }

    /// The readings to run, of which the first is the one that claims are judged under.
    ///
    /// # Errors
    /// An unknown reading or option.
    pub fn points(&self, study: &Study) -> Result<Vec<Point>, Failure> {
        match self.readings.as_deref() {
            None if study.explore.is_none() => Ok(vec![self.point(&study.readings)?]),
            None | Some("all") => Ok(study.trial_points()?),
            Some(_) => Ok(vec![self.point(&study.readings)?.for_trials(&study.readings)]),
        }
    }

    /// The reading that claims are judged under, over `readings`.
    ///
    /// # Errors
    /// An option that is not among a reading's. Readings that a study does not have are left to others.
    pub fn point(&self, readings: &[crate::study::Reading]) -> Result<Point, Failure> {
        let mut chosen = BTreeMap::new();
        for part in
            self.readings.as_deref().filter(|text| *text != "all").iter().flat_map(|text| text.split(','))
        {
            let Some((id, option)) = part.split_once('=') else {
                return Err(Failure::input(format!(
                    "--readings: `{part}` is not `reading=option`; `all` or `a=x,b=y` is accepted"
                )));
            };
            if readings.iter().any(|reading| reading.id == id) {
                chosen.insert(id.to_owned(), option.to_owned());
            }
        }
        Point::new(readings, &chosen).map_err(|message| Failure::input(format!("--readings: {message}")))
    }

    /// Refuses readings that no study of the paper has.
    ///
    /// # Errors
    /// The first unknown reading, with those that exist.
    pub fn check_readings(&self, paper: &Paper) -> Result<(), Failure> {
        let known = paper.readings();
        for part in
            self.readings.as_deref().filter(|text| *text != "all").iter().flat_map(|text| text.split(','))
        {
            let id = part.split('=').next().unwrap_or(part);
            if !known.iter().any(|reading| reading.id == id) {
                let ids: Vec<&str> = known.iter().map(|reading| reading.id.as_str()).collect();
                let message =
                    format!("--readings: there is no reading `{id}`; the readings are {}", ids.join(", "));
                return Err(Failure::input(message));
            }
        }
        Ok(())
    }
}
