//! A table of settings on its way from the spec to the entry that understands it.

use super::document::{in_words, parse, span_of};
use super::validate::faults;
use super::{Accepted, Document, Faults, SettingsError, Spanned, schema_of};
use schemars::JsonSchema;
use serde::de::{DeserializeOwned, IntoDeserializer as _};
use std::ops::Range;
use std::sync::Arc;
use toml::Table;
use toml::de::DeValue;

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

    /// These settings with the values that hold where they leave a key out, so that a record of them says all that moved a
    /// number and a default that changes makes the record stale.
    ///
    /// Switches stay out: one that may be left out is off, and leaving it out cannot come to mean on.
    #[must_use]
    pub fn completed(mut self, accepted: Accepted) -> Self {
        for (key, value) in defaults(&accepted.schema()) {
            self.table.entry(key).or_insert(value);
        }
        self
    }

    /// The settings as a `T`, held against the schema of `T` first.
    ///
    /// # Errors
    /// Every key and value that is not accepted, with its place if a file holds it.
    pub fn read<T: DeserializeOwned + JsonSchema + 'static>(&self) -> Result<T, SettingsError> {
        match &self.origin {
            Origin::Composed(origin) => read_composed(origin, &self.table),
            Origin::Written { document, span } => {
                let value = find(document.parsed()?, span);
                document
                    .read_value(value.ok_or_else(|| self.error("the table is no longer where it was read"))?)
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

    /// An error about the value that `path` leads to: keys and numbers of elements from 0, as in `panels.0.claim`.
    /// The place is that of the innermost value on the way that the settings have.
    pub fn error_at(&self, path: &str, message: impl Into<String>) -> SettingsError {
        match &self.origin {
            Origin::Written { document, span } => {
                let value = document.parsed().ok().and_then(|whole| find(whole, span));
                document.error(value.map_or_else(|| span.clone(), |value| span_of(value, path)), message)
            }
            Origin::Composed(_) => self.error(message),
        }
    }

    /// An error about `word`, a name that these settings give: at the first text of the table that is it.
    pub fn error_about(&self, word: &str, message: impl Into<String>) -> SettingsError {
        match &self.origin {
            Origin::Written { document, span } => {
                let whole = document.parsed().ok().and_then(|whole| find(whole, span));
                let at = whole.and_then(|table| text(table, word)).unwrap_or_else(|| span.clone());
                document.error(at, message)
            }
            Origin::Composed(_) => self.error(message),
        }
    }

    fn place(&self) -> String {
        match &self.origin {
            Origin::Composed(origin) => origin.clone(),
            Origin::Written { document, span } => {
                let line = document.text()[..span.start].matches('\n').count() + 1;
                format!("{}:{line}", document.path().display())
            }
        }
    }
}

fn read_composed<T: DeserializeOwned + JsonSchema + 'static>(
    origin: &str,
    table: &Table,
) -> Result<T, SettingsError> {
    let error = |message: String| SettingsError::Composed { origin: origin.to_owned(), message };
    // Through text, so that every type is deserialized from one kind of value only: half the code.
    let text = toml::to_string(table).expect("a table that was read can be written");
    let value = parse(&text).map_err(|e| error(in_words(e.message())))?;
    let mut all = Faults::default();
    for fault in faults(&schema_of::<T>(), &value) {
        all.add(error(fault.message));
    }
    all.done()?;
    T::deserialize(value.into_deserializer()).map_err(|e| error(in_words(e.message())))
}

/// The table inside `value` that has exactly this span.
fn find<'a, 't>(
    value: &'a toml::Spanned<DeValue<'t>>,
    span: &Range<usize>,
) -> Option<&'a toml::Spanned<DeValue<'t>>> {
    if value.span() == *span && value.get_ref().is_table() {
        return Some(value);
    }
    match value.get_ref() {
        DeValue::Table(table) => table.iter().find_map(|(_, v)| find(v, span)),
        DeValue::Array(array) => array.iter().find_map(|v| find(v, span)),
        _ => None,
    }
}

/// Where the first text inside `value` that is `word` stands.
fn text(value: &toml::Spanned<DeValue<'_>>, word: &str) -> Option<Range<usize>> {
    match value.get_ref() {
        DeValue::String(found) => (found == word).then(|| value.span()),
        DeValue::Table(table) => {
            let found = table.iter().filter_map(|(_, inner)| text(inner, word));
            found.min_by_key(|span| span.start)
        }
        DeValue::Array(array) => array.iter().find_map(|inner| text(inner, word)),
        _ => None,
    }
}

/// What the keys of a table are where they are left out, switches aside.
fn defaults(schema: &serde_json::Value) -> Vec<(String, toml::Value)> {
    let keys = schema.get("properties").and_then(serde_json::Value::as_object).into_iter().flatten();
    let said = keys.filter_map(|(key, part)| Some((key.clone(), part.get("default")?)));
    said.filter(|(_, value)| !matches!(value, serde_json::Value::Null | serde_json::Value::Bool(false)))
        .filter_map(|(key, value)| Some((key, toml::Value::try_from(value).ok()?)))
        .collect()
}
