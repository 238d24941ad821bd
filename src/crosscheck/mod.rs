//! The independent judge: robots, scenes and paths as MuJoCo is asked about them, and its answers beside ours.
//!
//! A [`Case`] is one robot in one scene. [`Case::write`] puts models (MJCF) and questions (Parquet) into a folder; the
//! Python modules in `crosscheck/` answer them there; [`Case::compare`] compares. Everything that is asked derives from
//! files and a seed, so that questions need not be kept to understand the answers.
//!
//! Compared are frames of links and tool, contact of every pair that may touch, distances where separated, and joints
//! beyond their limits. Depth of penetration is not: MuJoCo's is unreliable. Every case carries errors made on
//! purpose ([`control`]); if one goes unnoticed, the cross-check fails whatever else agrees.

mod case;
mod chapter;
mod compare;
pub mod control;
mod mjcf;
mod model;
mod path;
mod planar;
mod sample;
mod spec;
mod stored;
mod subject;
mod table;
#[cfg(test)]
mod tests;

pub use case::{Case, Outcome};
pub use chapter::{Depicted, chapter, list, table as verdict_table};
pub use compare::{Disagreement, FRAME_TOLERANCE, Line, TIE_M};
pub use spec::{FILE, Picture, SPEC, Sources, Spec};
pub use table::ANSWERED;

use base::settings::SettingsError;
use std::path::PathBuf;
use study::StudyError;

/// Why a cross-check cannot be posed or judged.
#[derive(Debug, thiserror::Error)]
pub enum CrosscheckError {
    /// The spec is wrong.
    #[error(transparent)]
    Settings(#[from] SettingsError),
    /// A stored run cannot be used.
    #[error(transparent)]
    Study(#[from] StudyError),
    /// A file cannot be written.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// A file with answers is missing or does not answer what was asked.
    #[error("{}: {reason}", path.display())]
    Answer {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
}
