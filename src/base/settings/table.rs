//! A table of settings on its way from the spec to the entry that understands it.

use super::document::{in_words, parse, part_of, span_of};
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
    /// Keys that were not written and stand in the table by their defaults.
    filled: Vec<String>,
}

#[derive(Debug, Clone, PartialEq)]
enum Origin {
    /// The table stands in the document.
    Written { document: Arc<Document>, span: Range<usize> },
    /// No table was written; faults stand at what names the entry.
    Absent { document: Arc<Document>, span: Range<usize>, whose: String },
    /// Another table was laid over settings, on behalf of `by`.
    Overlaid { under: Box<Settings>, by: String },
    /// The program put it together.
    Composed(String),
}

impl Settings {
    /// The settings that stand in `document` as `table`.
    pub fn written(document: &Arc<Document>, table: &Spanned<Table>) -> Self {
        let origin = Origin::Written { document: document.clone(), span: table.span() };
        Self { table: table.get_ref().clone(), origin, filled: Vec::new() }
    }

    /// The empty settings of `whose`, which stands at `span` of `document` without a table.
    pub fn absent(document: &Arc<Document>, span: Range<usize>, whose: impl Into<String>) -> Self {
        let origin = Origin::Absent { document: document.clone(), span, whose: whose.into() };
        Self { table: Table::new(), origin, filled: Vec::new() }
    }

    /// Settings that no file holds; `origin` says where they come from.
    pub fn composed(origin: impl Into<String>, table: Table) -> Self {
        Self { table, origin: Origin::Composed(origin.into()), filled: Vec::new() }
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
        let origin = Origin::Overlaid { under: Box::new(self.clone()), by: origin.to_owned() };
        Self { table, origin, filled: self.filled.clone() }
    }

    /// These settings with the values that hold where they leave a key out, so that a record of them says all that moved a
    /// number and a default that changes makes the record stale.
    ///
    /// Switches stay out: one that may be left out is off, and leaving it out cannot come to mean on.
    #[must_use]
    pub fn completed(mut self, accepted: Accepted) -> Self {
        for (key, value) in defaults(&accepted.schema()) {
            if !self.table.contains_key(&key) {
                self.filled.push(key.clone());
                self.table.insert(key, value);
            }
        }
        self
    }

    /// The keys that were left out, and the values that hold there.
    pub fn filled(&self) -> impl Iterator<Item = (&str, &toml::Value)> {
        self.filled.iter().filter_map(|key| Some((key.as_str(), self.table.get(key)?)))
    }

    /// The settings as a `T`, held against the schema of `T` first.
    ///
    /// # Errors
    /// Every key and value that is not accepted, with its place if a file holds it.
    pub fn read<T: DeserializeOwned + JsonSchema + 'static>(&self) -> Result<T, SettingsError> {
        match &self.origin {
            Origin::Written { document, span } => {
                let value = find(document.parsed()?, span);
                document
                    .read_value(value.ok_or_else(|| self.error("the table is no longer where it was read"))?)
            }
            _ => self.read_composed(),
        }
    }

    /// The settings as a `T`, of a table that no file holds as it is.
    fn read_composed<T: DeserializeOwned + JsonSchema + 'static>(&self) -> Result<T, SettingsError> {
        // Through text, so that every type is deserialized from one kind of value only: half the code.
        let text = toml::to_string(&self.table).expect("a table that was read can be written");
        let value = parse(&text).map_err(|e| self.error(in_words(e.message())))?;
        let mut all = Faults::default();
        for fault in faults(&schema_of::<T>(), &value) {
            let error = self.error_at(&path_to(&value, &fault.span), fault.message);
            all.add(fault.lacks.into_iter().fold(error, |error, key| error.about(&key)));
        }
        all.done()?;
        T::deserialize(value.into_deserializer()).map_err(|e| self.error(in_words(e.message())))
    }

    /// An error about these settings as a whole.
    pub fn error(&self, message: impl Into<String>) -> SettingsError {
        self.error_at("", message)
    }

    /// An error about the value that `path` leads to: keys and numbers of elements from 0, as in `panels.0.claim`.
    /// The place is that of the innermost value on the way that the settings have.
    pub fn error_at(&self, path: &str, message: impl Into<String>) -> SettingsError {
        self.placed(message.into(), &|table| span_of(table, path))
    }

    /// An error about `word`, a name that these settings give: at the first text that is it inside the value that `within`
    /// leads to, and under a key that starts with one of `keys`; if there is none, at the first text that is it at all.
    pub fn error_about(
        &self,
        within: &str,
        keys: &[&str],
        word: &str,
        message: impl Into<String>,
    ) -> SettingsError {
        self.placed(message.into(), &|table| {
            let part = part_of(table, within);
            let found = text(part, "", keys, word).or_else(|| text(table, "", keys, word));
            let found = found.or_else(|| text(part, "", &[""], word));
            found.or_else(|| text(table, "", &[""], word)).unwrap_or_else(|| part.span())
        })
        .about(word)
    }

    /// An error at the span that `at` finds in the table as it is written.
    fn placed(&self, message: String, at: &dyn Fn(&Written<'_>) -> Range<usize>) -> SettingsError {
        match &self.origin {
            Origin::Written { document, span } => {
                let value = document.parsed().ok().and_then(|whole| find(whole, span));
                document.error(value.map_or_else(|| span.clone(), at), message)
            }
            Origin::Absent { document, span, whose } => {
                document.error(span.clone(), format!("{whose}: {message}"))
            }
            Origin::Overlaid { under, by } => under.placed(message, at).under(by),
            Origin::Composed(origin) => SettingsError::Composed { origin: origin.clone(), message },
        }
    }
}

/// A value as a document has it.
type Written<'t> = toml::Spanned<DeValue<'t>>;

/// The keys and numbers of elements that lead to the innermost value around `span`.
fn path_to(value: &Written<'_>, span: &Range<usize>) -> String {
    let around = |inner: &Range<usize>| inner.start <= span.start && span.end <= inner.end;
    let step = match value.get_ref() {
        DeValue::Table(table) => table
            .iter()
            .find(|(key, inner)| around(&key.span()) || around(&inner.span()))
            .map(|(key, inner)| (key.get_ref().to_string(), inner)),
        DeValue::Array(array) => {
            let found = array.iter().enumerate().find(|(_, inner)| around(&inner.span()));
            found.map(|(index, inner)| (index.to_string(), inner))
        }
        _ => None,
    };
    step.map_or_else(String::new, |(step, inner)| format!("{step}.{}", path_to(inner, span)))
}

/// The table inside `value` that has exactly this span.
fn find<'a, 't>(value: &'a Written<'t>, span: &Range<usize>) -> Option<&'a Written<'t>> {
    if value.span() == *span && value.get_ref().is_table() {
        return Some(value);
    }
    match value.get_ref() {
        DeValue::Table(table) => table.iter().find_map(|(_, v)| find(v, span)),
        DeValue::Array(array) => array.iter().find_map(|v| find(v, span)),
        _ => None,
    }
}

/// Where the first text inside `value` that is `word` stands, of those whose nearest key starts with one of `keys`; `key` is
/// the nearest above `value`.
fn text(value: &Written<'_>, key: &str, keys: &[&str], word: &str) -> Option<Range<usize>> {
    match value.get_ref() {
        DeValue::String(found) => {
            (found == word && keys.iter().any(|start| key.starts_with(start))).then(|| value.span())
        }
        DeValue::Table(table) => {
            let found = table.iter().filter_map(|(key, inner)| text(inner, key.get_ref(), keys, word));
            found.min_by_key(|span| span.start)
        }
        DeValue::Array(array) => array.iter().find_map(|inner| text(inner, key, keys, word)),
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
