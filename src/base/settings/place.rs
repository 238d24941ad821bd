//! Where tables and values of settings stand, and the place of an error about them.

use super::document::{inner, span_of};
use super::{Document, SettingsError};
use std::ops::Range;
use std::sync::Arc;
use toml::de::DeValue;

/// A value as a document has it.
pub(super) type Written<'t> = toml::Spanned<DeValue<'t>>;

/// Where a table stands, or one value that is laid over settings: its document, and the keys and numbers of elements from 0 that
/// lead to it.
#[derive(Debug, Clone)]
pub struct Place {
    pub(super) document: Arc<Document>,
    steps: Vec<String>,
    /// The key that a value is laid under, and the way to where that key is named.
    named: Option<(String, Vec<String>)>,
}

/// Equal tables say the same wherever they stand.
impl PartialEq for Place {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Place {
    /// The table in `document` that `steps` lead to.
    pub fn of_table(document: &Arc<Document>, steps: &[&str]) -> Self {
        let steps = steps.iter().map(|step| (*step).to_owned()).collect();
        Self { document: document.clone(), steps, named: None }
    }

    /// The table inside this one that `steps` lead to.
    #[must_use]
    pub fn inside(&self, steps: &[&str]) -> Self {
        let mut inside = self.clone();
        inside.steps.extend(steps.iter().map(|step| (*step).to_owned()));
        inside
    }

    /// The value inside this table that `value` leads to, laid under `key`, which stands where `named` leads to.
    #[must_use]
    pub fn of_value(&self, key: &str, named: &[&str], value: &[&str]) -> Self {
        let named = Some((key.to_owned(), self.inside(named).steps));
        Self { named, ..self.inside(value) }
    }

    /// An error at the table, or at the innermost value on the way to it that there is.
    pub fn error(&self, message: impl Into<String>) -> SettingsError {
        let span = self.document.parsed().map_or(0..0, |whole| {
            let found = self.steps.iter().try_fold(whole, |value, step| inner(value, step).ok_or(value));
            found.unwrap_or_else(|innermost| innermost).span()
        });
        self.document.error(span, message)
    }

    fn at(&self, steps: &[String]) -> Option<&Written<'_>> {
        let whole = self.document.parsed().ok()?;
        steps.iter().try_fold(whole, |value, step| inner(value, step))
    }

    /// Where `sought` stands in this table, if the table has all of the way to it.
    pub(super) fn find_whole(&self, sought: Sought<'_>) -> Option<Range<usize>> {
        let table = self.at(&self.steps)?;
        let Sought::Value(path) = sought else { return sought.exactly(table) };
        let mut steps = path.split('.').filter(|step| !step.is_empty()).peekable();
        steps.peek()?;
        steps.try_fold(table, inner).map(toml::Spanned::span)
    }

    /// Where `sought` stands here, if it does.
    pub(super) fn find(&self, sought: Sought<'_>) -> Option<Range<usize>> {
        let Some((key, named)) = &self.named else {
            return self.at(&self.steps).and_then(|table| sought.exactly(table));
        };
        let (Sought::Value(path) | Sought::Key(path)) = sought;
        let is_key = matches!(sought, Sought::Key(_)) && path == key;
        let is_it = sought.first() == key;
        is_it.then(|| self.at(if is_key { named } else { &self.steps })).flatten().map(toml::Spanned::span)
    }
}

/// The place of an error about settings.
#[derive(Clone, Copy)]
pub(super) enum Sought<'a> {
    /// The value that a path leads to.
    Value(&'a str),
    /// The key that a path ends with.
    Key(&'a str),
}

impl Sought<'_> {
    /// The key of the table that it lies under; empty if it is the table itself.
    pub(super) fn first(&self) -> &str {
        let (Self::Value(path) | Self::Key(path)) = self;
        path.split('.').next().unwrap_or_default()
    }

    /// Where it stands in the table, or as near to it as there is anything.
    pub(super) fn near(&self, table: &Written<'_>) -> Range<usize> {
        let (Self::Value(path) | Self::Key(path)) = self;
        self.exactly(table).unwrap_or_else(|| span_of(table, path))
    }

    /// Where it stands in the table, if it does.
    pub(super) fn exactly(&self, table: &Written<'_>) -> Option<Range<usize>> {
        match self {
            Self::Value(path) => {
                inner(table, self.first()).filter(|_| !path.is_empty()).map(|_| span_of(table, path))
            }
            Self::Key(path) => {
                let (before, key) = path.rsplit_once('.').unwrap_or(("", path));
                let mut holder = before.split('.').filter(|step| !step.is_empty());
                let holder = holder.try_fold(table, |value, step| inner(value, step))?;
                let mut keys = holder.get_ref().as_table()?.iter().map(|(key, _)| key);
                keys.find(|found| found.get_ref() == key).map(toml::Spanned::span)
            }
        }
    }
}
