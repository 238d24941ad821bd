//! What is wrong with a document: one fault, or all of a file at once.

use std::path::PathBuf;

/// What is wrong with a document or a table in it.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SettingsError {
    /// The file cannot be read.
    #[error("{}: {reason}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the system said.
        reason: String,
    },
    /// The file is read, but a value in it is not what was expected.
    #[error("{}:{line}:{column}: {message}{}", path.display(), below(excerpt))]
    At {
        /// The file.
        path: PathBuf,
        /// Line, from 1.
        line: usize,
        /// Column in characters, from 1.
        column: usize,
        /// What was found and what is accepted.
        message: String,
        /// The line itself.
        excerpt: String,
    },
    /// A table that was put together by the program (a reading or a sweep laid over a spec) is wrong.
    #[error("{origin}: {message}")]
    Composed {
        /// What put it together.
        origin: String,
        /// What was found and what is accepted.
        message: String,
    },
    /// Several things are wrong: two or more, none of them of this kind, in the order of their places.
    #[error("{}", lines(.0))]
    Several(Vec<SettingsError>),
}

impl SettingsError {
    /// What is wrong, without the place.
    pub fn message(self) -> String {
        match self {
            Self::Unreadable { reason, .. } => reason,
            Self::At { message, .. } | Self::Composed { message, .. } => message,
            Self::Several(errors) => errors.into_iter().map(Self::message).collect::<Vec<_>>().join("; "),
        }
    }

    /// The same with `before` in front of what is wrong.
    #[must_use]
    pub fn prefixed(self, before: &str) -> Self {
        match self {
            Self::At { path, line, column, message, excerpt } => {
                Self::At { path, line, column, message: format!("{before}{message}"), excerpt }
            }
            Self::Composed { origin, message } => {
                Self::Composed { origin, message: format!("{before}{message}") }
            }
            Self::Several(errors) => {
                Self::Several(errors.into_iter().map(|error| error.prefixed(before)).collect())
            }
            unreadable @ Self::Unreadable { .. } => unreadable,
        }
    }

    /// Each fault by itself.
    pub fn each(self) -> Vec<Self> {
        match self {
            Self::Several(errors) => errors,
            one => vec![one],
        }
    }

    /// File, line and column; what has no file goes last.
    fn place(&self) -> (bool, Option<&PathBuf>, usize, usize) {
        match self {
            Self::At { path, line, column, .. } => (false, Some(path), *line, *column),
            Self::Unreadable { path, .. } => (false, Some(path), 0, 0),
            Self::Composed { .. } | Self::Several(_) => (true, None, 0, 0),
        }
    }
}

/// The excerpt on a line of its own; nothing if it is empty.
fn below(excerpt: &str) -> String {
    if excerpt.is_empty() { String::new() } else { format!("\n    {excerpt}") }
}

fn lines(errors: &[SettingsError]) -> String {
    errors.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
}

/// Faults gathered from several places, each once, so that who wrote a file sees all of them in one round.
#[derive(Debug, Default)]
pub struct Faults(Vec<SettingsError>);

impl Faults {
    /// Adds what is wrong.
    pub fn add(&mut self, error: SettingsError) {
        for fault in error.each() {
            if !self.0.contains(&fault) {
                self.0.push(fault);
            }
        }
    }

    /// Adds what is wrong where nothing was found yet: a second look that says the same in other words adds nothing.
    pub fn add_elsewhere(&mut self, error: SettingsError) {
        for fault in error.each() {
            if !self.0.iter().any(|known| known.place() == fault.place()) {
                self.0.push(fault);
            }
        }
    }

    /// The value if there is one; otherwise what is wrong is added.
    pub fn keep<T>(&mut self, result: Result<T, SettingsError>) -> Option<T> {
        result.map_err(|error| self.add(error)).ok()
    }

    /// Whether nothing is wrong so far.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// All that is wrong, in the order of the places; only for who has added a fault.
    pub fn error(mut self) -> SettingsError {
        self.0.sort_by(|a, b| a.place().cmp(&b.place()));
        if self.0.len() == 1 { self.0.remove(0) } else { SettingsError::Several(self.0) }
    }

    /// Nothing, or all that is wrong.
    ///
    /// # Errors
    /// As [`error`](Self::error), if there is any.
    pub fn done(self) -> Result<(), SettingsError> {
        if self.is_empty() { Ok(()) } else { Err(self.error()) }
    }
}
