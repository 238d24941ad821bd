//! A table of settings on its way from the spec to the entry that understands it.

use super::document::{in_words, parse};
use super::place::{Place, Sought, Written};
use super::reader;
use super::schema::defaults;
use super::validate::faults;
use super::{Accepted, Document, Faults, SettingsError, Spanned, schema_of};
use schemars::JsonSchema;
use serde::de::DeserializeOwned;
use std::collections::BTreeSet;
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
    /// Another table was laid over settings.
    Overlaid { under: Box<Settings>, over: Layer },
    /// It was put together from parts of other settings, which lie under these keys there.
    Parts { whole: Box<Settings>, keys: Vec<String>, whose: String },
    /// It was put together from tables of a document, the one whose values win first; faults that are in none of them stand at `span`.
    Layered { document: Arc<Document>, span: Range<usize>, layers: Vec<Part> },
    /// The program put it together.
    Composed(String),
}

/// A table of a document from which settings are put together.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// Where it stands.
    pub place: Place,
    /// The one key that is taken from it; every key if `None`.
    pub key: Option<&'static str>,
}

impl Part {
    /// Whether `sought` may stand in it.
    fn may_hold(&self, sought: Sought<'_>) -> bool {
        self.key.is_none_or(|key| sought.first() == key)
    }
}

/// A table that is laid over settings.
#[derive(Debug, Clone, PartialEq)]
struct Layer {
    /// On whose behalf.
    by: String,
    keys: BTreeSet<String>,
    /// Where it stands, or the parts of it, if a file holds them.
    places: Vec<Place>,
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

    /// Settings put together from `layers` of `document`, the one whose values win first. A fault is reported in the first layer that
    /// has what is wrong, and at `span` if none has.
    pub fn layered(document: &Arc<Document>, span: Range<usize>, layers: Vec<Part>, table: Table) -> Self {
        let origin = Origin::Layered { document: document.clone(), span, layers };
        Self { table, origin, filled: Vec::new() }
    }

    /// Changes the table's content; messages still name the place where it was written.
    pub fn change(&mut self, change: impl FnOnce(&mut Table)) {
        change(&mut self.table);
    }

    /// Whether some text in the table is `word`.
    pub fn names(&self, word: &str) -> bool {
        fn is_in(value: &toml::Value, word: &str) -> bool {
            match value {
                toml::Value::String(text) => text == word,
                toml::Value::Array(elements) => elements.iter().any(|inner| is_in(inner, word)),
                toml::Value::Table(table) => table.values().any(|inner| is_in(inner, word)),
                _ => false,
            }
        }
        self.table.values().any(|value| is_in(value, word))
    }

    /// The table itself.
    pub fn table(&self) -> &Table {
        &self.table
    }

    /// Settings that `whose` puts together from the parts of `whole` under `keys`. A fault is reported at the first
    /// part that has it.
    pub fn of_parts(whole: &Self, keys: &[&str], whose: impl Into<String>, table: Table) -> Self {
        let keys = keys.iter().map(|key| (*key).to_owned()).collect();
        let origin = Origin::Parts { whole: Box::new(whole.clone()), keys, whose: whose.into() };
        Self { table, origin, filled: Vec::new() }
    }

    /// These settings with the keys of `over` laid on top, on behalf of `by`.
    #[must_use]
    pub fn overlaid(&self, over: &Table, by: &str) -> Self {
        self.overlaid_from(over, by, Vec::new())
    }

    /// The same with a table that stands at `places`: what is wrong with its values is reported there.
    #[must_use]
    pub fn overlaid_from(&self, over: &Table, by: &str, places: Vec<Place>) -> Self {
        if over.iter().all(|(key, value)| self.table.get(key) == Some(value)) {
            return self.clone();
        }
        let mut table = self.table.clone();
        table.extend(over.iter().map(|(key, value)| (key.clone(), value.clone())));
        let over = Layer { by: by.to_owned(), keys: over.keys().cloned().collect(), places };
        let origin = Origin::Overlaid { under: Box::new(self.clone()), over };
        Self { table, origin, filled: self.filled.clone() }
    }

    /// These settings as those of another entry that is like this one, called `label`: with the keys of `own`, which stands at `place`.
    #[must_use]
    pub fn like(&self, own: &Table, label: &str, place: Place) -> Self {
        let mut like = self.overlaid_from(own, &format!("like `{label}`"), vec![place]);
        like.filled.retain(|key| !own.contains_key(key));
        like
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

    /// The keys that were written and stand otherwise in `over`.
    pub fn hidden_by(&self, over: &Table) -> Vec<String> {
        let is_hidden = |key: &str, value: &toml::Value| {
            let is_filled = self.filled.iter().any(|filled| filled == key);
            !is_filled && self.table.get(key).is_some_and(|own| own != value)
        };
        over.iter().filter(|(key, value)| is_hidden(key, value)).map(|(key, _)| key.clone()).collect()
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
        let value = self.parsed_against(&schema_of::<T>(), &text)?;
        reader::read(&value).map_err(|e| self.error(in_words(&e.message)))
    }

    /// The table again as parsed from its `text`, held against a schema.
    fn parsed_against<'t>(
        &self,
        schema: &serde_json::Value,
        text: &'t str,
    ) -> Result<Written<'t>, SettingsError> {
        let value = parse(text).map_err(|e| self.error(in_words(e.message())))?;
        let mut all = Faults::default();
        for fault in faults(schema, &value) {
            let (path, is_key) = path_to(&value, &fault.span).unwrap_or_default();
            let path = path.trim_end_matches('.');
            let sought = if is_key { Sought::Key(path) } else { Sought::Value(path) };
            all.add(self.placed(fault.message, sought));
        }
        all.done()?;
        Ok(value)
    }

    /// An error about these settings as a whole.
    pub fn error(&self, message: impl Into<String>) -> SettingsError {
        self.error_at("", message)
    }

    /// An error about the value that `path` leads to: keys and numbers of elements from 0, as in `panels.0.claim`.
    /// The place is that of the innermost value on the way that the settings have.
    pub fn error_at(&self, path: &str, message: impl Into<String>) -> SettingsError {
        self.placed(message.into(), Sought::Value(path))
    }

    /// That there is no `fault` with the value that `path` leads to.
    ///
    /// # Errors
    /// There is one, reported as by [`error_at`](Self::error_at).
    pub fn accept_without(&self, path: &str, fault: Option<String>) -> Result<(), SettingsError> {
        fault.map_or(Ok(()), |fault| Err(self.error_at(path, fault)))
    }

    /// An error about `word`, a name that these settings give where one of `paths` leads. A path goes to every element of an array
    /// unless it gives the number of one. The error stands at the first such text, otherwise as near to the first path as there is anything.
    pub fn error_about(&self, paths: &[&str], word: &str, message: impl Into<String>) -> SettingsError {
        let whole = toml::Value::Table(self.table.clone());
        let found = paths.iter().find_map(|path| path_of(&whole, &path.split('.').collect::<Vec<_>>(), word));
        self.error_at(found.as_deref().unwrap_or(paths[0]), message).about(word)
    }

    /// An error at the place of `sought`: in the uppermost table that holds it, and where none does, in the lowest.
    fn placed(&self, message: String, sought: Sought<'_>) -> SettingsError {
        match &self.origin {
            Origin::Written { document, span } => {
                let table = document.parsed().ok().and_then(|whole| find(whole, span));
                document.error(table.map_or_else(|| span.clone(), |table| sought.near(table)), message)
            }
            Origin::Absent { document, span, whose } => {
                // That the table itself could not be read is reported already.
                document.error(span.clone(), format!("{whose}: {message}")).about("settings")
            }
            Origin::Overlaid { under, over } => {
                let found = over.places.iter().find_map(|place| Some((place, place.find(sought)?)));
                if let Some((place, span)) = found {
                    return place.document.error(span, message);
                }
                let is_over = over.places.is_empty() && over.keys.contains(sought.first());
                let error =
                    if is_over { under.lowest(message, sought) } else { under.placed(message, sought) };
                error.under(&over.by)
            }
            Origin::Parts { whole, keys, whose } => {
                let message = format!("{whose}: {message}");
                let (Sought::Value(path) | Sought::Key(path)) = sought;
                let holds = |key: &&String| part_in(&whole.table, key, sought.first());
                let key = keys.iter().find(holds).or(keys.first()).map_or("", String::as_str);
                let path = if key.is_empty() { path.to_owned() } else { format!("{key}.{path}") };
                let is_key = matches!(sought, Sought::Key(_));
                whole.placed(message, if is_key { Sought::Key(&path) } else { Sought::Value(&path) })
            }
            Origin::Layered { document, span, layers } => {
                let parts = || layers.iter().filter(|part| part.may_hold(sought));
                let whole = parts().find_map(|part| part.place.find_whole(sought));
                let found = whole.or_else(|| parts().find_map(|part| part.place.find(sought)));
                document.error(found.unwrap_or_else(|| span.clone()), message)
            }
            Origin::Composed(origin) => SettingsError::Composed { origin: origin.clone(), message },
        }
    }

    /// The same in the lowest table.
    fn lowest(&self, message: String, sought: Sought<'_>) -> SettingsError {
        match &self.origin {
            Origin::Overlaid { under, over } => under.lowest(message, sought).under(&over.by),
            _ => self.placed(message, sought),
        }
    }
}

/// Whether the table that `path` leads to in `table`, itself if it is empty, has `key`.
fn part_in(table: &Table, path: &str, key: &str) -> bool {
    if path.is_empty() {
        return table.contains_key(key);
    }
    let mut steps = path.split('.');
    let first = steps.next().and_then(|step| table.get(step));
    let value = steps.fold(first, |value, step| match value? {
        toml::Value::Array(elements) => elements.get(step.parse::<usize>().ok()?),
        value => value.get(step),
    });
    value.is_some_and(|value| value.get(key).is_some())
}

/// The keys and numbers of elements that lead to the first text that is `word` where `steps` lead in `value`.
fn path_of(value: &toml::Value, steps: &[&str], word: &str) -> Option<String> {
    match (value, steps) {
        (toml::Value::String(text), []) => (text == word).then(String::new),
        (toml::Value::Table(table), [step, rest @ ..]) => {
            path_of(table.get(*step)?, rest, word).map(|path| format!("{step}.{path}"))
        }
        (toml::Value::Array(elements), _) => {
            let number: Option<usize> = steps.first().and_then(|step| step.parse().ok());
            let rest = if number.is_some() { &steps[1..] } else { steps };
            let meant =
                elements.iter().enumerate().filter(|(index, _)| number.is_none_or(|own| own == *index));
            let mut found = meant.map(|(index, own)| Some(format!("{index}.{}", path_of(own, rest, word)?)));
            found.find_map(|path| path)
        }
        _ => None,
    }
}

/// The keys and numbers of elements that lead to what has exactly this span, and whether it is a key.
fn path_to(value: &Written<'_>, span: &Range<usize>) -> Option<(String, bool)> {
    if value.span() == *span {
        return Some((String::new(), false));
    }
    let inside = |step: String, inner: &Written<'_>| {
        path_to(inner, span).map(|(rest, is_key)| (format!("{step}.{rest}"), is_key))
    };
    match value.get_ref() {
        // What stands under a header of its own lies outside the span of its table.
        DeValue::Table(table) => table.iter().find_map(|(key, inner)| {
            let step = key.get_ref().to_string();
            if key.span() == *span { Some((step, true)) } else { inside(step, inner) }
        }),
        DeValue::Array(array) => {
            array.iter().enumerate().find_map(|(index, inner)| inside(index.to_string(), inner))
        }
        _ => None,
    }
}

/// The table inside `value` that has exactly this span.
fn find<'a, 't>(value: &'a Written<'t>, span: &Range<usize>) -> Option<&'a Written<'t>> {
    if value.span() == *span && value.get_ref().is_table() {
        return Some(value);
    }
    match value.get_ref() {
        DeValue::Table(table) => table.iter().find_map(|(_, v)| find(v, span)),
        // What belongs to an element, also under a header of its own, stands before the next element.
        DeValue::Array(array) => {
            let after = array.partition_point(|element| element.span().start <= span.start);
            find(&array[after.checked_sub(1)?], span)
        }
        _ => None,
    }
}
