//! The errors between a spec and its records.

use base::settings::SettingsError;
use std::path::PathBuf;

/// The advice where a stored file is not the one that was written.
pub const REMEDY: &str = "put back the file that was written, or `run` with --replace-damaged, which sets it aside and keeps what is sound";

/// An error of the study floor.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    /// A spec or settings table is wrong.
    #[error(transparent)]
    Settings(#[from] SettingsError),
    /// A folder or file that must exist does not.
    #[error("{}: {what}", path.display())]
    Missing {
        /// The place.
        path: PathBuf,
        /// What was expected there.
        what: String,
    },
    /// The file system refused.
    #[error("{}: {doing}: {source}", path.display())]
    Io {
        /// The file or folder.
        path: PathBuf,
        /// What was being done.
        doing: &'static str,
        /// The system's message.
        source: std::io::Error,
    },
    /// A stored file cannot be used.
    #[error("{}: {reason}", path.display())]
    Stored {
        /// The file.
        path: PathBuf,
        /// What is wrong with it, and what helps.
        reason: String,
    },
    /// A stored file is not what would be written now: truncated, edited, of another version, or of a spec that has changed.
    #[error("{0}")]
    Touched(String),
    /// Another process is running into the same folder.
    #[error("{}: another run is writing here; wait for it or choose another place with --out", path.display())]
    Busy {
        /// The folder.
        path: PathBuf,
    },
    /// A person or the system stopped the run.
    #[error(
        "interrupted: {kept} of {total} units of study `{study}` are kept; the same command goes on from there"
    )]
    Interrupted {
        /// The study.
        study: String,
        /// Units that are in the journal.
        kept: usize,
        /// Units in all.
        total: usize,
    },
    /// A contender needs a program that is not there.
    #[error(
        "study `{study}`: contender `{contender}` cannot run: {lacks}; stored trials stay readable without it"
    )]
    Lacks {
        /// The study.
        study: String,
        /// The contender.
        contender: String,
        /// What is missing, and what helps.
        lacks: String,
    },
    /// A problem group needs files that are not there.
    #[error(
        "study `{study}`: problems `{group}` cannot be posed: {lacks}; stored trials stay readable without it"
    )]
    LacksFiles {
        /// The study.
        study: String,
        /// The problem group.
        group: String,
        /// What is missing, and what helps.
        lacks: String,
    },
    /// The study has no trial of this name.
    #[error("study `{study}` has no trial `{trial}`{near}; {hint}")]
    UnknownTrial {
        /// The study.
        study: String,
        /// The name that was given, without the study's.
        trial: String,
        /// Which of its trials may have been meant.
        near: String,
        /// Trials that it has.
        hint: String,
    },
}

impl StudyError {
    /// An input/output error at `path` while `doing` something.
    pub fn io(path: impl Into<PathBuf>, doing: &'static str) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.into();
        move |source| Self::Io { path, doing, source }
    }

    /// A stored text that is not what was written; `again` writes it again.
    pub fn touched(error: SettingsError, again: &str) -> Self {
        let reworded = error.reworded(&format!(
            "is not what replan wrote: truncated, edited, or of another version; {again}"
        ));
        Self::Touched(reworded.to_string())
    }

    /// A stored file that cannot be used.
    pub fn stored(path: impl Into<PathBuf>, reason: impl Into<String>) -> Self {
        Self::Stored { path: path.into(), reason: reason.into() }
    }
}
