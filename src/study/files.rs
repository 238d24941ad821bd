//! The kinds of TOML file that replan reads from a paper's folder and from `data/`, and how it recognises each.

use super::StudyError;
use super::family::{cell_queries, plane_queries};
use super::spec::StudySpec;
use base::settings::{Accepted, Document, SettingsError};
use engine::kinematics::robot;
use engine::space::{cell, polyhedra};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};

/// A kind of TOML file: what it may hold, and an example.
#[derive(Debug)]
pub struct FileKind {
    /// Its name: for `replan list files`, and the stem of its schema.
    pub name: &'static str,
    /// One line for `replan list`.
    pub about: &'static str,
    /// What it may hold.
    pub accepted: Accepted,
    /// A file of the kind in this repository.
    pub example: &'static str,
}

/// Every kind that a file may be taken for, in the order of their names; `paper.toml` and `crosscheck.toml` go by their
/// names.
pub static KINDS: &[FileKind] = &[
    FileKind {
        name: "cell_groups",
        about: "start and goal poses of an arm for the family cell_queries",
        accepted: cell_queries::GROUPS_FILE,
        example: "data/scenes/gallery_puma560.toml",
    },
    FileKind {
        name: "cell_scene",
        about: "what stands around an arm: data/scenes/fu2018_cell.toml",
        accepted: cell::SCENE_FILE,
        example: "data/scenes/gallery_wall.toml",
    },
    FileKind {
        name: "plane_map",
        about: "polygons in a plane for the family plane_queries: data/scenes/fu2018_particle.toml",
        accepted: plane_queries::MAP_FILE,
        example: "data/scenes/fu2018_particle.toml",
    },
    FileKind {
        name: "polyhedra_scene",
        about: "convex obstacles around a point: data/scenes/tang_e1.toml",
        accepted: polyhedra::SCENE_FILE,
        example: "data/scenes/tang_e1.toml",
    },
    FileKind {
        name: "robot",
        about: "an arm's joints, limits, capsules and tool: data/robots/motoman_up6.toml",
        accepted: robot::ROBOT_FILE,
        example: "data/robots/puma560.toml",
    },
    FileKind {
        name: "study",
        about: "problems, contenders, sweeps and figures: any other TOML file beside paper.toml",
        accepted: Accepted::shape::<StudySpec>(),
        example: "experiments/movingai_sample/scenarios.toml",
    },
];

/// The kind of a paper's studies.
pub const STUDY: &str = "study";
/// The name of a file that is of no kind of ours.
pub const FOREIGN: &str = "file of something else";

/// Files of a paper's folder that are no studies: the paper itself, and the questions to an independent judge.
const NO_STUDIES: [&str; 2] = ["paper.toml", "crosscheck.toml"];

/// The TOML files in `folder` besides those of `NO_STUDIES` and hidden ones, in the order of their names.
///
/// # Errors
/// What the system refuses.
pub fn beside(folder: &Path) -> Result<Vec<PathBuf>, StudyError> {
    let entries = fs::read_dir(folder).map_err(StudyError::io(folder, "listing the folder"))?;
    let is_meant = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        name.ends_with(".toml") && !name.starts_with('.') && !NO_STUDIES.contains(&&*name)
    };
    let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
    let mut files: Vec<PathBuf> = paths.filter(is_meant).collect();
    files.sort();
    Ok(files)
}

/// The schema of the kind of file called `name`, without the settings of the entries that it names.
pub fn schema(name: &str) -> Value {
    let kind = KINDS.iter().find(|kind| kind.name == name);
    kind.map_or(Value::Bool(true), |kind| (*kind.accepted.schema()).clone())
}

/// The kind of `document`.
///
/// A study has `paper` or `question`. A document with neither is of another kind if two things hold. At least half of its keys,
/// and more than a study has of them, are that kind's. And some table or list under one of them is as that kind has it, since
/// `name` and `tool` are keys of many files. Of the rest a study is what has some key of one, what `paper` speaks of, and what is no
/// TOML.
pub fn kind_of(document: &Document, paper: &Document) -> &'static str {
    let keys = document.keys();
    if ["paper", "question"].iter().any(|key| keys.contains(key)) {
        return STUDY;
    }
    let shared = |kind: &FileKind| {
        let schema = kind.accepted.schema();
        keys.iter().filter(|key| schema.get("properties").is_some_and(|all| all.get(key).is_some())).count()
    };
    let as_study = KINDS.iter().filter(|kind| kind.name == STUDY).map(shared).max().unwrap_or(0);
    let is_like = |kind: &FileKind| document.likeness(&kind.accepted.schema()) > 0;
    let is_most = |kind: &FileKind| shared(kind) > as_study && 2 * shared(kind) >= keys.len();
    let others = || KINDS.iter().filter(|kind| is_most(kind) && is_like(kind));
    let fits = |kind: &&FileKind| document.validate(&kind.accepted.schema()).is_ok();
    let other = others().find(fits).or_else(|| others().max_by_key(|kind| shared(kind)));
    let stem = document.path().file_stem().unwrap_or_default().to_string_lossy();
    match other {
        Some(kind) => kind.name,
        None if as_study > 0 || !document.is_toml() || paper.contains_word(&stem) => STUDY,
        None => FOREIGN,
    }
}

/// The faults of a file of `kind`, other than a study.
///
/// # Errors
/// Every fault, with what the file was taken for.
pub fn validate(document: &Document, kind: &str) -> Result<(), SettingsError> {
    let before = format!("without `paper` and `question` this is no study but a {kind}: ");
    document.validate(&schema(kind)).map_err(|error| error.prefixed(&before))
}
