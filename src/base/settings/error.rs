//! Faults of a document: one, or all of a file at once.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// What is wrong with a document or a table in it.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SettingsError {
    /// The file cannot be read.
    #[error("{}: {reason}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The system's message.
        reason: String,
    },
    /// The file is read, but a value in it is not what was expected.
    #[error("{}:{line}:{column}: {}{message}{}", path.display(), laid_over(with), below(excerpt))]
    At {
        /// The file.
        path: PathBuf,
        /// Line, from 1.
        line: usize,
        /// Column in characters, from 1.
        column: usize,
        /// What was laid over what stands there: options, sweeps.
        with: Vec<String>,
        /// The names that were looked up, if it was not found.
        about: Box<[Box<str>]>,
        /// What was found and what is accepted.
        message: String,
        /// The line itself.
        excerpt: Box<str>,
    },
    /// A table that was put together by the program (an option or a sweep laid over a spec) is wrong.
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
            Self::At { path, line, column, with, about, message, excerpt } => {
                let message = format!("{before}{message}");
                Self::At { path, line, column, with, about, message, excerpt }
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

    /// The same places with other words for what is wrong there.
    #[must_use]
    pub fn reworded(self, words: &str) -> Self {
        match self {
            Self::At { path, line, column, with, about, excerpt, .. } => {
                Self::At { path, line, column, with, about, message: words.to_owned(), excerpt }
            }
            Self::Several(errors) => {
                Self::Several(errors.into_iter().map(|error| error.reworded(words)).collect())
            }
            other => other,
        }
    }

    /// The same with `by` laid over what stands there.
    #[must_use]
    pub(super) fn under(mut self, by: &str) -> Self {
        match &mut self {
            Self::At { with, .. } => with.push(by.to_owned()),
            Self::Composed { message, .. } => *message = format!("with {by}: {message}"),
            Self::Unreadable { .. } | Self::Several(_) => {}
        }
        self
    }

    /// The same, as a fault of the name `word`, which was looked up and not found. Where something of the name could not be
    /// read ([`Faults::unread`]), it gets no message. A fault may be of several names.
    #[must_use]
    pub fn about(mut self, word: &str) -> Self {
        if let Self::At { about, .. } = &mut self {
            let known = std::mem::take(about).into_vec();
            *about = known.into_iter().chain([word.into()]).collect();
        }
        self
    }

    /// Whether it is reported at a place in `path`, or at no place.
    pub fn is_in(&self, path: &Path) -> bool {
        match self {
            Self::Unreadable { path: own, .. } | Self::At { path: own, .. } => own == path,
            Self::Composed { .. } => true,
            Self::Several(errors) => errors.iter().all(|error| error.is_in(path)),
        }
    }

    /// Each fault by itself.
    pub fn each(self) -> Vec<Self> {
        match self {
            Self::Several(errors) => errors,
            one => vec![one],
        }
    }

    /// The same thing at the same place, whatever was laid over it. Ranges that are accepted there may differ: one number may leave maps
    /// of several sizes.
    fn repeats(&self, known: &Self) -> bool {
        let found = |message: &str| match message.split_once("; ") {
            Some((found, range))
                if [" is accepted", " are accepted"].iter().any(|end| range.ends_with(end)) =>
            {
                found.to_owned()
            }
            _ => message.to_owned(),
        };
        match (self, known) {
            (Self::At { message: own, .. }, Self::At { message, .. }) => {
                self.place() == known.place() && found(own) == found(message)
            }
            _ => self == known,
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

/// The most faults of one file that a message tells.
const MOST_OF_FILE: usize = 50;

/// Each fault on a line of its own; of a file with very many the first ones, and how many more there are.
fn lines(errors: &[SettingsError]) -> String {
    let mut counts: BTreeMap<Option<&PathBuf>, usize> = BTreeMap::new();
    let mut lines = Vec::new();
    for error in errors {
        let count = counts.entry(error.place().1).or_default();
        *count += 1;
        if *count <= MOST_OF_FILE {
            lines.push(error.to_string());
        }
    }
    for (path, count) in counts.into_iter().filter(|(_, count)| *count > MOST_OF_FILE) {
        let path = path.map_or_else(String::new, |path| format!("{}: ", path.display()));
        lines.push(format!("{path}{} more faults like these", count - MOST_OF_FILE));
    }
    lines.join("\n")
}

fn laid_over(with: &[String]) -> String {
    if with.is_empty() { String::new() } else { format!("with {}: ", with.join(", ")) }
}

/// Faults gathered from several places, each once, so that who wrote a file sees all of them in one round.
#[derive(Debug, Default)]
pub struct Faults {
    found: Vec<SettingsError>,
    /// Names of what could not be read.
    unread: BTreeSet<String>,
}

impl Faults {
    /// Adds a fault. One that occurs under several interpretations is reported once, with what they have in common.
    pub fn add(&mut self, error: SettingsError) {
        for fault in error.each() {
            match self.found.iter_mut().find(|known| fault.repeats(known)) {
                Some(SettingsError::At { with: known, .. }) => {
                    if let SettingsError::At { with, .. } = &fault {
                        known.retain(|by| with.contains(by));
                    }
                }
                Some(_) => {}
                None => self.found.push(fault),
            }
        }
    }

    /// The value if there is one; otherwise what is wrong is added.
    pub fn keep<T>(&mut self, result: Result<T, SettingsError>) -> Option<T> {
        result.map_err(|error| self.add(error)).ok()
    }

    /// The values that there are, in order; what is wrong with the others is added.
    pub fn keep_each<T>(&mut self, results: impl IntoIterator<Item = Result<T, SettingsError>>) -> Vec<T> {
        results.into_iter().filter_map(|result| self.keep(result)).collect()
    }

    /// The value, unless something is wrong.
    ///
    /// # Errors
    /// All that is wrong, as [`error`](Self::error).
    ///
    /// # Panics
    /// If there is no value and nothing was added that says why.
    pub fn or<T>(self, value: Option<T>) -> Result<T, SettingsError> {
        self.done()?;
        Ok(value.expect("what is missing was reported as a fault"))
    }

    /// Says that something called `name` is there but could not be read, for a reason that was added: that the name is not
    /// found elsewhere is no fault then.
    pub fn unread(&mut self, name: impl Into<String>) {
        self.unread.insert(name.into());
    }

    /// Whether something is wrong in the file at `path`.
    pub fn are_in(&self, path: &Path) -> bool {
        self.found.iter().any(|fault| fault.place().1.is_some_and(|own| own == path))
    }

    /// Whether nothing is wrong so far.
    pub fn is_empty(&self) -> bool {
        self.found.is_empty()
    }

    /// All that is wrong, in the order of the places; only for who has added a fault.
    pub fn error(mut self) -> SettingsError {
        let is_sure = |fault: &SettingsError| match fault {
            SettingsError::At { about, .. } => !about.iter().any(|name| self.unread.contains(&**name)),
            _ => true,
        };
        self.found.retain(is_sure);
        self.found.sort_by(|a, b| a.place().cmp(&b.place()));
        if self.found.len() == 1 { self.found.remove(0) } else { SettingsError::Several(self.found) }
    }

    /// Nothing, or all that is wrong.
    ///
    /// # Errors
    /// As [`error`](Self::error), if there is any.
    pub fn done(self) -> Result<(), SettingsError> {
        if self.is_empty() { Ok(()) } else { Err(self.error()) }
    }
}
