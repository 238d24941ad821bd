//! The kinds of TOML file that replan reads from a paper's folder and from `data/`, and how one is told from another.

use super::family::{cell_queries, plane_queries};
use super::spec::StudySpec;
use base::settings::{Accepted, Document, Faults, SettingsError};
use engine::kinematics::robot;
use engine::space::{cell, polyhedra};
use std::sync::Arc;

/// A kind of file.
#[derive(Debug)]
pub struct FileKind {
    /// Its name: for `replan list files`, and the stem of its schema.
    pub name: &'static str,
    /// One line for `replan list`.
    pub about: &'static str,
    /// What it may hold.
    pub accepted: Accepted,
}

/// Every kind that a file may be taken for, in the order of their names; `paper.toml` and `crosscheck.toml` go by their
/// names.
pub static KINDS: &[FileKind] = &[
    FileKind {
        name: "cell_groups",
        about: "start and goal poses of an arm for the family cell_queries",
        accepted: cell_queries::GROUPS_FILE,
    },
    FileKind {
        name: "cell_scene",
        about: "what stands around an arm: data/scenes/fu2018_cell.toml",
        accepted: cell::SCENE_FILE,
    },
    FileKind {
        name: "plane_map",
        about: "polygons in a plane for the family plane_queries: data/scenes/fu2018_particle.toml",
        accepted: plane_queries::MAP_FILE,
    },
    FileKind {
        name: "polyhedra_scene",
        about: "convex obstacles around a point: data/scenes/tang_e1.toml",
        accepted: polyhedra::SCENE_FILE,
    },
    FileKind {
        name: "robot",
        about: "an arm's joints, limits, capsules and tool: data/robots/motoman_up6.toml",
        accepted: robot::ROBOT_FILE,
    },
    FileKind {
        name: "study",
        about: "problems, contenders, sweeps, readings and figures: any other TOML file beside paper.toml",
        accepted: Accepted::of::<StudySpec>(),
    },
];

/// The kind, other than a study, that `document` is: it has neither `paper` nor `question`, as every study has, and more of
/// its keys are that kind's than a study's.
pub fn other_than_study(document: &Document) -> Option<&'static FileKind> {
    if document.has("paper") || document.has("question") {
        return None;
    }
    let shared = |kind: &FileKind| {
        let schema = kind.accepted.schema();
        let keys = schema.get("properties").and_then(|keys| keys.as_object());
        keys.map_or(0, |keys| keys.keys().filter(|key| document.has(key)).count())
    };
    let (studies, others): (Vec<_>, Vec<_>) = KINDS.iter().partition(|kind| kind.name == "study");
    let as_study = studies.into_iter().map(shared).max().unwrap_or(0);
    let fits = |kind: &&&FileKind| document.validate(&kind.accepted.schema()).is_ok();
    let others = || others.iter().filter(|kind| shared(kind) > as_study);
    others().find(fits).or_else(|| others().max_by_key(|kind| shared(kind))).copied()
}

/// What is wrong with a file of that kind, which it says.
///
/// # Errors
/// Every fault, with what the file was taken for.
pub fn validate(document: &Arc<Document>, kind: &FileKind) -> Result<(), SettingsError> {
    let mut faults = Faults::default();
    if let Err(error) = document.validate(&kind.accepted.schema()) {
        error.each().into_iter().for_each(|fault| {
            faults.add(
                fault.prefixed(&format!(
                    "without `paper` and `question` this is no study but a {}: ",
                    kind.name
                )),
            );
        });
    }
    faults.done()
}
