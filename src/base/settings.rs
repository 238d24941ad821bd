//! TOML as it was written: documents that can say where in them a value stands.
//!
//! Settings travel from a spec to the entry that understands them as the table they were written as; only that
//! entry's file knows the fields. Whoever reads a table and finds it wrong gets an error with the file, line and
//! column of the value, also after the table was handed through several floors.

use serde::de::{DeserializeOwned, IntoDeserializer as _};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};
use toml::de::{DeTable, DeValue};
use toml::{Spanned, Table};

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
}

impl SettingsError {
    /// What is wrong, without the place.
    pub fn message(self) -> String {
        match self {
            Self::Unreadable { reason, .. } => reason,
            Self::At { message, .. } | Self::Composed { message, .. } => message,
        }
    }
}

/// A TOML file held in memory with its path.
///
/// Its text stays until the program ends: tables of it are read again and again under one reading after another, and
/// what was parsed once refers to the text.
#[derive(Debug)]
pub struct Document {
    path: PathBuf,
    text: &'static str,
    parsed: OnceLock<Result<Spanned<DeValue<'static>>, toml::de::Error>>,
}

impl PartialEq for Document {
    fn eq(&self, other: &Self) -> bool {
        (&self.path, self.text) == (&other.path, other.text)
    }
}

impl Document {
    /// Reads the file at `path`.
    ///
    /// # Errors
    /// [`SettingsError::Unreadable`] if it is missing, not readable, or not UTF-8 (with the first bad byte).
    pub fn open(path: &Path) -> Result<Arc<Self>, SettingsError> {
        let unreadable = |reason: String| SettingsError::Unreadable { path: path.to_owned(), reason };
        let bytes = std::fs::read(path).map_err(|e| unreadable(e.to_string()))?;
        let text = String::from_utf8(bytes).map_err(|e| {
            let at = e.utf8_error().valid_up_to();
            unreadable(format!("byte {at} is not UTF-8; TOML files are UTF-8 text"))
        })?;
        Ok(Self::new(path, text))
    }

    /// A document with the given text, as if read from `path`.
    pub fn new(path: &Path, text: String) -> Arc<Self> {
        Arc::new(Self { path: path.to_owned(), text: text.leak(), parsed: OnceLock::new() })
    }

    /// The path it was read from.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The text as read.
    pub fn text(&self) -> &str {
        self.text
    }

    /// The whole document as a `T`.
    ///
    /// # Errors
    /// [`SettingsError::At`] for a syntax error, an unknown key, a missing key or a value of the wrong kind.
    pub fn read<T: DeserializeOwned>(&self) -> Result<T, SettingsError> {
        if self.text.trim().is_empty() {
            return Err(self.error(0..0, "the file is empty; a TOML table is expected"));
        }
        let value = self.parsed()?.clone();
        T::deserialize(value.into_deserializer()).map_err(|e| self.toml_error(&e, None))
    }

    fn parsed(&self) -> Result<&Spanned<DeValue<'static>>, SettingsError> {
        self.parsed.get_or_init(|| parse(self.text)).as_ref().map_err(|e| self.toml_error(e, None))
    }

    /// An error at the byte range `span` of this document.
    pub fn error(&self, span: Range<usize>, message: impl Into<String>) -> SettingsError {
        let start = span.start.min(self.text.len());
        let before = &self.text[..start];
        let line_start = before.rfind('\n').map_or(0, |i| i + 1);
        SettingsError::At {
            path: self.path.clone(),
            line: before.matches('\n').count() + 1,
            column: self.text[line_start..start].chars().count() + 1,
            message: message.into(),
            excerpt: printable(self.text[line_start..].lines().next().unwrap_or_default().trim_end()),
        }
    }

    fn toml_error(&self, error: &toml::de::Error, fallback: Option<Range<usize>>) -> SettingsError {
        let span = error.span().or(fallback).unwrap_or(0..0);
        self.error(span, in_words(error.message()))
    }
}

/// The excerpt on a line of its own; nothing if it is empty.
fn below(excerpt: &str) -> String {
    if excerpt.is_empty() { String::new() } else { format!("\n    {excerpt}") }
}

/// A parser's message on one line, with Rust's names of types in words.
fn in_words(message: &str) -> String {
    const WORDS: [(&str, &str); 9] = [
        ("expected u64", "expected a whole number of 0 or more"),
        ("expected u32", "expected a whole number of 0 or more"),
        ("expected u16", "expected a whole number from 0 to 65535"),
        ("expected u8", "expected a whole number from 0 to 255"),
        ("expected usize", "expected a whole number of 0 or more"),
        ("expected i64", "expected a whole number"),
        ("expected i32", "expected a whole number"),
        ("expected f64", "expected a number"),
        ("wanted string or table", "expected a string"),
    ];
    let line = message.trim().replace('\n', "; ");
    WORDS.into_iter().fold(line, |text, (rust, words)| text.replace(rust, words))
}

/// `line` with control characters replaced, so that a binary file taken for TOML cannot steer a terminal.
fn printable(line: &str) -> String {
    line.chars().map(|c| if c.is_control() && c != '\t' { char::REPLACEMENT_CHARACTER } else { c }).collect()
}

/// A table of settings and where it was written.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    table: Table,
    origin: Origin,
}

#[derive(Debug, Clone, PartialEq)]
enum Origin {
    Written { document: Arc<Document>, span: Range<usize> },
    Composed(String),
}

impl Settings {
    /// The settings that stand in `document` as `table`.
    pub fn written(document: &Arc<Document>, table: &Spanned<Table>) -> Self {
        let origin = Origin::Written { document: document.clone(), span: table.span() };
        Self { table: table.get_ref().clone(), origin }
    }

    /// Settings that no file holds; `origin` says where they come from.
    pub fn composed(origin: impl Into<String>, table: Table) -> Self {
        Self { table, origin: Origin::Composed(origin.into()) }
    }

    /// The table itself.
    pub fn table(&self) -> &Table {
        &self.table
    }

    /// These settings with the keys of `over` laid on top, on behalf of `origin`.
    #[must_use]
    pub fn overlaid(&self, over: &Table, origin: &str) -> Self {
        if over.iter().all(|(key, value)| self.table.get(key) == Some(value)) {
            return self.clone();
        }
        let mut table = self.table.clone();
        table.extend(over.iter().map(|(key, value)| (key.clone(), value.clone())));
        Self::composed(format!("{} with {origin}", self.place()), table)
    }

    /// The settings as a `T`.
    ///
    /// # Errors
    /// [`SettingsError::At`] or [`SettingsError::Composed`] with the key or value found and what is accepted.
    pub fn read<T: DeserializeOwned>(&self) -> Result<T, SettingsError> {
        match &self.origin {
            Origin::Composed(origin) => {
                // Through text, so that every type is deserialized from one kind of value only: half the code.
                let text = toml::to_string(&self.table).expect("a table that was read can be written");
                let value = parse(&text).and_then(|value| T::deserialize(value.into_deserializer()));
                value.map_err(|e| SettingsError::Composed {
                    origin: origin.clone(),
                    message: in_words(e.message()),
                })
            }
            Origin::Written { document, span } => {
                let value = find(document.parsed()?, span);
                let value = value.ok_or_else(|| self.error("the table is no longer where it was read"))?;
                T::deserialize(value.clone().into_deserializer())
                    .map_err(|e| document.toml_error(&e, Some(span.clone())))
            }
        }
    }

    /// An error about these settings as a whole.
    pub fn error(&self, message: impl Into<String>) -> SettingsError {
        match &self.origin {
            Origin::Written { document, span } => document.error(span.clone(), message),
            Origin::Composed(origin) => {
                SettingsError::Composed { origin: origin.clone(), message: message.into() }
            }
        }
    }

    fn place(&self) -> String {
        match &self.origin {
            Origin::Composed(origin) => origin.clone(),
            Origin::Written { document, span } => {
                let line = document.text[..span.start].matches('\n').count() + 1;
                format!("{}:{line}", document.path.display())
            }
        }
    }
}

fn parse(text: &str) -> Result<Spanned<DeValue<'_>>, toml::de::Error> {
    let whole = DeTable::parse(text)?;
    Ok(Spanned::new(whole.span(), DeValue::Table(whole.into_inner())))
}

/// The table inside `value` that has exactly this span.
fn find<'a, 't>(value: &'a Spanned<DeValue<'t>>, span: &Range<usize>) -> Option<&'a Spanned<DeValue<'t>>> {
    if value.span() == *span && value.get_ref().is_table() {
        return Some(value);
    }
    match value.get_ref() {
        DeValue::Table(table) => table.iter().find_map(|(_, v)| find(v, span)),
        DeValue::Array(array) => array.iter().find_map(|v| find(v, span)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde::Deserialize;

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Outer {
        #[serde(rename = "part")]
        parts: Vec<Part>,
    }

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Part {
        settings: Spanned<Table>,
    }

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    #[expect(dead_code, reason = "read by the deserializer only")]
    struct Inner {
        weight: f64,
    }

    fn second_part(text: &str) -> Settings {
        let document = Document::new(Path::new("a.toml"), text.to_owned());
        let outer: Outer = document.read().unwrap();
        Settings::written(&document, &outer.parts[1].settings)
    }

    #[test]
    fn an_error_in_a_table_read_later_has_the_line_and_column_of_the_key() {
        for (text, line, column, part) in [
            ("[[part]]\nsettings = { weight = 1 }\n[[part]]\nsettings = { wait = 1 }\n", 4, 14, "`wait`"),
            (
                "[[part]]\n[part.settings]\nweight = 1\n[[part]]\n[part.settings]\nweight = 'x'\n",
                6,
                10,
                "\"x\"",
            ),
        ] {
            let error = second_part(text).read::<Inner>().unwrap_err();
            let SettingsError::At { line: l, column: c, message, .. } = &error else { panic!("{error}") };
            assert_eq!((*l, *c), (line, column), "{error}");
            assert!(message.contains(part), "{error}");
        }
    }

    #[test]
    fn an_overlay_that_changes_nothing_keeps_the_place() {
        let settings =
            second_part("[[part]]\nsettings = { weight = 1 }\n[[part]]\nsettings = { weight = 2 }\n");
        let same: Table = toml::from_str("weight = 2").unwrap();
        let other: Table = toml::from_str("weight = 'heavy'").unwrap();
        assert_eq!(settings.overlaid(&same, "reading weight"), settings);
        let error = settings.overlaid(&other, "reading weight").read::<Inner>().unwrap_err().to_string();
        assert!(error.starts_with("a.toml:4 with reading weight: "), "{error}");
    }

    #[test]
    fn settings_put_together_may_be_empty_and_read_as_they_were_put_together() {
        #[derive(Debug, Deserialize)]
        #[serde(deny_unknown_fields)]
        struct Nothing {}
        let Nothing {} = Settings::composed("a task without settings", Table::new()).read().unwrap();
        let text = "share = 0.1\nsize = [3, 4]\nname = \"a\\\"b\"\n[inner]\nleast = 5e-324\n";
        let table: Table = toml::from_str(text).unwrap();
        assert_eq!(Settings::composed("a sweep", table.clone()).read::<Table>().unwrap(), table);
    }

    #[test]
    fn an_empty_document_and_a_broken_one_say_so() {
        let read = |text: &str| {
            Document::new(Path::new("a.toml"), text.to_owned()).read::<Outer>().unwrap_err().to_string()
        };
        assert!(read(" \n").contains("a.toml:1:1: the file is empty"), "{}", read(" \n"));
        assert!(read("[[part]\n").starts_with("a.toml:1:"), "{}", read("[[part]\n"));
    }
}
