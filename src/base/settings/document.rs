//! A TOML file in memory: its text, its values, and the place of each value.

use super::reader::{self, Refused};
use super::validate::{Fault, faults};
use super::{Faults, SettingsError, schema_of};
use crate::file;
use crate::text::{around, bounded};
use schemars::JsonSchema;
use self_cell::self_cell;
use serde::de::DeserializeOwned;
use std::collections::BTreeSet;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A TOML file held in memory with its path. It is parsed once, however often its tables are read.
#[derive(Debug)]
pub struct Document {
    path: PathBuf,
    parsed: Parsed,
}

/// The most bytes of a spec: twenty thousand boxes have room, and `check` reads them in seconds.
const MOST_OF_SPEC: usize = 2_000_000;

/// What a text says, or why it is no TOML.
type Outcome<'t> = Result<Spanned<DeValue<'t>>, toml::de::Error>;

// What is parsed refers to its text, and the TOML library has no parsed value that owns it.
self_cell! {
    struct Parsed {
        owner: String,
        #[covariant]
        dependent: Outcome,
    }
    impl {Debug}
}

impl PartialEq for Document {
    fn eq(&self, other: &Self) -> bool {
        (&self.path, self.text()) == (&other.path, other.text())
    }
}

impl Document {
    /// Reads the file at `path`.
    ///
    /// # Errors
    /// [`SettingsError::Unreadable`] if it is missing, not readable, or not UTF-8 (with the first bad byte).
    pub fn open(path: &Path) -> Result<Arc<Self>, SettingsError> {
        let unreadable = |reason: String| SettingsError::Unreadable { path: path.to_owned(), reason };
        Ok(Self::new(path, file::read_text(path).map_err(|e| unreadable(e.to_string()))?))
    }

    /// A document with the given text, as if read from `path`.
    pub fn new(path: &Path, text: String) -> Arc<Self> {
        Arc::new(Self { path: path.to_owned(), parsed: Parsed::new(text, |text| parse(text)) })
    }

    /// The path it was read from.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The text as read.
    pub fn text(&self) -> &str {
        self.parsed.borrow_owner()
    }

    /// The whole document as a `T`, held against the schema of `T` first.
    ///
    /// # Errors
    /// A syntax error, or every unknown key, missing key and value that is not accepted, each at its own place.
    pub fn read<T: DeserializeOwned + JsonSchema + 'static>(&self) -> Result<T, SettingsError> {
        let bytes = self.text().len();
        if bytes > MOST_OF_SPEC {
            let message = format!("the file has {bytes} bytes; a spec of at most {MOST_OF_SPEC} is accepted");
            return Err(self.error(0..0, message));
        }
        if self.text().trim().is_empty() {
            return Err(self.error(0..0, "the file is empty; a TOML table is expected"));
        }
        let value = self.parsed()?;
        self.refuse(faults(&schema_of::<T>(), value))?;
        reader::read(value).map_err(|e| self.refused(e, value.span()))
    }

    /// The whole document as a `T` that has no schema: what the program itself wrote.
    ///
    /// # Errors
    /// The first syntax error, unknown key, missing key or value of the wrong kind.
    pub fn read_stored<T: DeserializeOwned>(&self) -> Result<T, SettingsError> {
        let value = self.parsed()?;
        reader::read(value).map_err(|e| self.refused(e, value.span()))
    }

    /// Everything in the document that `schema` does not accept.
    ///
    /// # Errors
    /// A syntax error, or every fault at its own place.
    pub fn validate(&self, schema: &serde_json::Value) -> Result<(), SettingsError> {
        self.refuse(faults(schema, self.parsed()?))
    }

    /// Whether it is TOML.
    pub fn is_toml(&self) -> bool {
        self.parsed().is_ok()
    }

    /// The keys at its top; none if it is not TOML.
    pub fn keys(&self) -> Vec<&str> {
        let table = self.parsed().ok().and_then(|value| value.get_ref().as_table());
        table.into_iter().flatten().map(|(key, _)| key.get_ref().as_ref()).collect()
    }

    /// Every text in quotes, whether it is TOML or not: a name that it gives is among them.
    pub fn quoted(&self) -> BTreeSet<&str> {
        self.text().lines().flat_map(|line| line.split(['"', '\'']).skip(1)).collect()
    }

    /// Whether some value in it is the text `word`.
    pub fn contains_word(&self, word: &str) -> bool {
        self.parsed().is_ok_and(|value| contains_word(value.get_ref(), word))
    }

    /// An error at the byte range `span` of this document.
    pub fn error(&self, span: Range<usize>, message: impl Into<String>) -> SettingsError {
        let text = self.text();
        let start = span.start.min(text.len());
        let before = &text[..start];
        let line_start = before.rfind('\n').map_or(0, |i| i + 1);
        let column = text[line_start..start].chars().count();
        let line = text[line_start..].lines().next().unwrap_or_default().trim_end();
        SettingsError::At {
            path: self.path.clone(),
            line: before.matches('\n').count() + 1,
            column: column + 1,
            with: Vec::new(),
            about: Box::default(),
            message: bounded(&message.into()).into_owned(),
            excerpt: around(line, column).into(),
        }
    }

    /// An error at the value that `path` leads to, by keys and by the numbers of elements from 0: `inventory.0.item`.
    /// If the document ends before that, the place is that of the innermost value on the way.
    pub fn error_at(&self, path: &str, message: impl Into<String>) -> SettingsError {
        let span = self.parsed().map_or(0..0, |value| span_of(value, path));
        self.error(span, message)
    }

    /// An error at the key that `steps` lead to, by keys and by the numbers of elements from 0. If the document ends
    /// before that, as [`error_at`](Self::error_at).
    pub fn error_at_key(&self, steps: &[&str], message: impl Into<String>) -> SettingsError {
        let span = self.parsed().map_or(0..0, |value| key_span_of(value, steps));
        self.error(span, message)
    }

    /// Whether it has the value that `steps` lead to, by keys and by the numbers of elements from 0.
    pub fn has(&self, steps: &[&str]) -> bool {
        self.parsed()
            .is_ok_and(|value| steps.iter().try_fold(value, |value, step| inner(value, step)).is_some())
    }

    pub(super) fn parsed(&self) -> Result<&Spanned<DeValue<'_>>, SettingsError> {
        self.parsed.borrow_dependent().as_ref().map_err(|e| self.toml_error(e, 0..0))
    }

    pub(super) fn read_value<T: DeserializeOwned + JsonSchema + 'static>(
        &self,
        value: &Spanned<DeValue<'_>>,
    ) -> Result<T, SettingsError> {
        self.refuse(faults(&schema_of::<T>(), value))?;
        reader::read(value).map_err(|e| self.refused(e, value.span()))
    }

    fn refuse(&self, found: Vec<Fault>) -> Result<(), SettingsError> {
        let mut all = Faults::default();
        for fault in found {
            all.add(self.error(fault.span, fault.message));
        }
        all.done()
    }

    fn refused(&self, refused: Refused, fallback: Range<usize>) -> SettingsError {
        self.error(refused.span.unwrap_or(fallback), in_words(&refused.message))
    }

    fn toml_error(&self, error: &toml::de::Error, fallback: Range<usize>) -> SettingsError {
        self.error(error.span().unwrap_or(fallback), in_words(error.message()))
    }
}

fn contains_word(value: &DeValue<'_>, word: &str) -> bool {
    match value {
        DeValue::String(text) => text == word,
        DeValue::Table(table) => table.iter().any(|(_, inner)| contains_word(inner.get_ref(), word)),
        DeValue::Array(elements) => elements.iter().any(|inner| contains_word(inner.get_ref(), word)),
        _ => false,
    }
}

/// A parser's message on one line.
pub(super) fn in_words(message: &str) -> String {
    message.trim().replace('\n', "; ")
}

pub(super) fn parse(text: &str) -> Result<Spanned<DeValue<'_>>, toml::de::Error> {
    let whole = DeTable::parse(text)?;
    Ok(Spanned::new(whole.span(), DeValue::Table(whole.into_inner())))
}

/// Where the value that `path` leads to stands inside `value`.
pub(super) fn span_of(value: &Spanned<DeValue<'_>>, path: &str) -> Range<usize> {
    part_of(value, path).span()
}

/// Where the key that `steps` lead to stands inside `value`; where the innermost value on the way stands if there is none.
fn key_span_of(value: &Spanned<DeValue<'_>>, steps: &[&str]) -> Range<usize> {
    let Some((step, rest)) = steps.split_first() else { return value.span() };
    match inner(value, step) {
        Some(next) if !rest.is_empty() => key_span_of(next, rest),
        _ => {
            let mut keys = value.get_ref().as_table().into_iter().flatten().map(|(key, _)| key);
            keys.find(|key| key.get_ref() == step).map_or_else(|| value.span(), Spanned::span)
        }
    }
}

/// The value that `path` leads to inside `value`, or the innermost on the way that there is.
pub(super) fn part_of<'a, 't>(value: &'a Spanned<DeValue<'t>>, path: &str) -> &'a Spanned<DeValue<'t>> {
    let mut found = value;
    for step in path.split('.') {
        match inner(found, step) {
            Some(next) => found = next,
            None => break,
        }
    }
    found
}

/// The value under the key, or the element of the number, that `step` is inside `value`.
pub(super) fn inner<'a, 't>(value: &'a Spanned<DeValue<'t>>, step: &str) -> Option<&'a Spanned<DeValue<'t>>> {
    match value.get_ref() {
        DeValue::Table(table) => table.get(step),
        DeValue::Array(array) => step.parse::<usize>().ok().and_then(|index| array.get(index)),
        _ => None,
    }
}
