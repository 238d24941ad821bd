//! What is left of a document without what its schema does not accept: so that one mistake hides no other.

use super::document::parse;
use super::reader;
use super::schema::Node;
use super::validate::faults;
use super::{Document, Faults, Settings, SettingsError, schema_of};
use schemars::JsonSchema;
use serde::de::DeserializeOwned;
use serde_json::Value;
use std::collections::BTreeSet;
use std::ops::Range;
use std::sync::Arc;
use toml::de::{DeArray, DeTable, DeValue};
use toml::{Spanned, Table};

/// Rounds after which a document is given up: what is taken away may leave something else without a key that it needs.
const ROUNDS: usize = 20;

impl Document {
    /// What is accepted of the document as a `T`, and the document without the rest, which goes to `faults`; none if that leaves
    /// nothing that can be read.
    pub fn read_rest<T: DeserializeOwned + JsonSchema + 'static>(
        self: &Arc<Self>,
        faults: &mut Faults,
    ) -> Option<(T, Arc<Self>)> {
        if self.text().trim().is_empty() {
            return faults.keep(self.read::<T>()).map(|read| (read, self.clone()));
        }
        let rest = self.salvaged(&schema_of::<T>(), faults);
        let read = faults.keep(rest.read::<T>());
        read.map(|read| (read, rest))
    }

    /// The document without what `schema` does not accept; that goes to `faults`, with the names that went with it.
    ///
    /// What a table at the top must have is filled in with something that is accepted. A document that is no TOML stays as it
    /// is.
    pub fn salvaged(self: &Arc<Self>, schema: &Value, faults: &mut Faults) -> Arc<Self> {
        match self.validate(schema) {
            Err(refused) if self.parsed().is_ok() => faults.add(refused),
            _ => return self.clone(),
        }
        let mut names = Vec::new();
        let salvaged = self.in_part(|value| salvage(schema, value, &mut names));
        for name in names {
            faults.unread(name);
        }
        salvaged
    }
}

impl Settings {
    /// What `build` finds wrong with what `schema` accepts of these settings, where it does not accept all.
    ///
    /// What it does not accept is taken from `example`, as that has it and with its numbers doubled: a message of both times does not
    /// hang on it.
    pub fn faults_beside(
        &self,
        schema: &Value,
        example: &str,
        build: impl Fn(&Self) -> Option<SettingsError>,
    ) -> Vec<SettingsError> {
        let [first, again] = [1, 2].map(|times| {
            let error = self.mended(schema, example, times).and_then(|mended| build(&mended));
            error.map_or_else(Vec::new, SettingsError::each)
        });
        let is_certain =
            |error: &SettingsError| !matches!(error, SettingsError::Composed { .. }) && again.contains(error);
        first.into_iter().filter(is_certain).collect()
    }

    /// These settings with what `schema` does not accept as `example` has it, times `times`; none if `schema` accepts them, or not
    /// even then.
    fn mended(&self, schema: &Value, example: &str, times: i32) -> Option<Self> {
        let text = toml::to_string(self.table()).ok()?;
        let mut value = parse(&text).ok()?;
        if faults(schema, &value).is_empty() {
            return None;
        }
        let example: Table = toml::from_str(example).ok()?;
        salvage(schema, &mut value, &mut Vec::new());
        let mut table = reader::read::<Table>(&value).ok()?;
        table.retain(|key, value| self.table().get(key) == Some(value));
        let kept: BTreeSet<String> = table.keys().cloned().collect();
        let is_missing = |key: &String| !kept.contains(key);
        let filled: Vec<_> = example.into_iter().filter(|(key, _)| is_missing(key)).collect();
        // What stands in a file cannot be doubled, so that nothing tells what hangs on it.
        if filled.iter().any(|(_, value)| value.as_str().is_some_and(|text| text.contains('/'))) {
            return None;
        }
        table.extend(filled.into_iter().map(|(key, value)| (key, multiplied(value, times))));
        let mended =
            parse(&toml::to_string(&table).ok()?).is_ok_and(|value| faults(schema, &value).is_empty());
        mended.then(|| Self::remains(self, kept, table))
    }
}

/// A value whose numbers are `times` as large.
fn multiplied(value: toml::Value, times: i32) -> toml::Value {
    match value {
        toml::Value::Integer(number) => toml::Value::Integer(number.saturating_mul(times.into())),
        toml::Value::Float(number) => toml::Value::Float(number * f64::from(times)),
        toml::Value::Array(all) => {
            toml::Value::Array(all.into_iter().map(|one| multiplied(one, times)).collect())
        }
        toml::Value::Table(table) => {
            let times = |(key, value)| (key, multiplied(value, times));
            toml::Value::Table(table.into_iter().map(times).collect())
        }
        other => other,
    }
}

/// Takes away what is not accepted, gathers the names in it, and gives the keys at the top under which it stood.
fn salvage(schema: &Value, value: &mut Spanned<DeValue<'_>>, names: &mut Vec<String>) -> BTreeSet<String> {
    let mut parted = BTreeSet::new();
    for _ in 0..ROUNDS {
        let refused = faults(schema, value);
        if refused.is_empty() {
            break;
        }
        for fault in refused {
            names.extend(fault.lacks);
            parted.extend(key_of(value.get_ref(), &fault.span));
            if !remove(value.get_mut(), &fault.span, names) {
                fill(Node::root(schema), value);
            }
        }
    }
    parted
}

/// The key at the top under which what is at `span` stands.
fn key_of(value: &DeValue<'_>, span: &Range<usize>) -> Option<String> {
    let holds = |value: &Spanned<DeValue<'_>>| remove(&mut value.get_ref().clone(), span, &mut Vec::new());
    let found = value
        .as_table()?
        .iter()
        .find(|(key, inner)| key.span() == *span || inner.span() == *span || holds(inner));
    found.map(|(key, _)| key.get_ref().to_string())
}

/// Removes the key or element that stands at `span`, and gathers the names inside; whether there was one.
fn remove(value: &mut DeValue<'_>, span: &Range<usize>, names: &mut Vec<String>) -> bool {
    let is_it = |key: Option<Range<usize>>, value: &Spanned<DeValue<'_>>| {
        key.is_some_and(|key| key == *span) || value.span() == *span
    };
    match value {
        DeValue::Table(table) => {
            let holds = |list: &Spanned<DeValue<'_>>| {
                list.get_ref().as_array().is_some_and(|all| all.iter().any(|one| is_it(None, one)))
            };
            // A list of tables with headers of their own stands where its first table does, which is what is meant.
            let found = table.iter().find(|(key, inner)| is_it(Some(key.span()), inner) && !holds(inner));
            if let Some(key) = found.map(|(key, _)| key.get_ref().clone()) {
                names.push(key.to_string());
                if let Some(gone) = table.remove(&*key) {
                    gather(gone.get_ref(), names);
                }
                return true;
            }
            // A list that lacks an element may be too short.
            names.extend(
                table.iter().filter(|(_, list)| holds(list)).map(|(key, _)| key.get_ref().to_string()),
            );
            table.iter_mut().any(|(_, inner)| remove(inner.get_mut(), span, names))
        }
        DeValue::Array(elements) => {
            if elements.iter().any(|inner| is_it(None, inner)) {
                let all = std::mem::replace(elements, DeArray::new()).into_iter();
                let (gone, kept): (Vec<_>, Vec<_>) = all.partition(|inner| is_it(None, inner));
                for inner in &gone {
                    gather(inner.get_ref(), names);
                }
                *elements = kept.into_iter().collect();
                return true;
            }
            elements.iter_mut().any(|inner| remove(inner.get_mut(), span, names))
        }
        _ => false,
    }
}

/// Every text inside `value`: any of them may be a name that is used elsewhere.
fn gather(value: &DeValue<'_>, names: &mut Vec<String>) {
    match value {
        DeValue::String(text) => names.push(text.to_string()),
        DeValue::Table(table) => table.iter().for_each(|(key, inner)| {
            names.push(key.get_ref().to_string());
            gather(inner.get_ref(), names);
        }),
        DeValue::Array(elements) => elements.iter().for_each(|inner| gather(inner.get_ref(), names)),
        _ => {}
    }
}

/// Fills in what the table at the top must have and has not.
fn fill(node: Node<'_>, value: &mut Spanned<DeValue<'_>>) {
    let DeValue::Table(table) = value.get_mut() else { return };
    let missing: Vec<&str> = node.required().filter(|key| table.get(*key).is_none()).collect();
    for key in missing {
        if let Some(inner) = node.property(key).and_then(plain) {
            table.insert(Spanned::new(0..0, key.to_owned().into()), Spanned::new(0..0, inner));
        }
    }
}

/// A value that is likely to be accepted.
fn plain<'t>(node: Node<'_>) -> Option<DeValue<'t>> {
    let node = node.branches().first().copied().unwrap_or(node);
    let parsed = |text: &'static str| DeValue::parse(text).ok().map(Spanned::into_inner);
    match node.kinds().first().copied()? {
        "integer" | "number" => parsed("1"),
        "boolean" => parsed("false"),
        "string" => {
            Some(DeValue::String(node.words().first().copied().unwrap_or_default().to_owned().into()))
        }
        "array" => Some(DeValue::Array(DeArray::new())),
        _ => {
            let mut table = Spanned::new(0..0, DeValue::Table(DeTable::new()));
            fill(node, &mut table);
            Some(table.into_inner())
        }
    }
}
