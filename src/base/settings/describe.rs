//! The keys of a table for people, made from the schema that files are checked against.

use super::schema::Node;
use serde_json::Value;

/// A key of a table.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Field {
    /// The key, after the keys of the tables that hold it: `panels.title`.
    pub name: String,
    /// What it means.
    pub meaning: String,
    /// The unit, if the key says one.
    pub unit: Option<&'static str>,
    /// What is accepted.
    pub accepted: String,
    /// Whether it must be given, or what holds if it is not.
    pub default: Default,
    /// The words that it may be, with their meanings, if it is one of several and they have any.
    pub words: Vec<(String, String)>,
}

/// What holds if a key is left out.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Default {
    /// It must be given.
    Required,
    /// This value.
    Value(String),
    /// Nothing: what its meaning says holds then.
    Absent,
}

/// Keys end in their unit.
const UNITS: [(&str, &str); 23] = [
    ("_deg_s", "degrees a second"),
    ("_rad_s", "radians a second"),
    ("_mm_s", "millimetres a second"),
    ("_m_s", "metres a second"),
    ("_deg", "degrees"),
    ("_rad", "radians"),
    ("_mm", "millimetres"),
    ("_cm", "centimetres"),
    ("_m", "metres"),
    ("_ms", "milliseconds"),
    ("_us", "microseconds"),
    ("_ns", "nanoseconds"),
    ("_s", "seconds"),
    ("_px", "pixels"),
    ("_pt", "points of 1/72 inch"),
    ("_cells", "cells"),
    ("_steps", "steps"),
    ("_share", "a share of 1"),
    ("_percent", "percent"),
    ("_turns", "whole turns"),
    ("_sides", "sides"),
    ("_points", "percentage points"),
    ("_per_cell", "for each cell"),
];

/// The unit that the key `name` says.
pub fn unit(name: &str) -> Option<&'static str> {
    UNITS.iter().find(|(suffix, _)| name.ends_with(suffix)).map(|(_, unit)| *unit)
}

/// The first sentence of `text`, without its full stop, on one line.
pub fn first_sentence(text: &str) -> String {
    let line = on_one_line(text.split("\n\n").next().unwrap_or_default());
    let end = line.find(". ").unwrap_or(line.len());
    line[..end].trim_end_matches('.').to_owned()
}

fn on_one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Every key that a table of the shape `schema` may hold, those that must be given first, each followed by those inside.
pub fn fields(schema: &Value) -> Vec<Field> {
    let mut all = Vec::new();
    gather(Node::root(schema), "", 0, &mut all);
    all
}

/// The keys in `schema` that say no meaning.
pub fn undocumented(schema: &Value) -> Vec<String> {
    fields(schema).into_iter().filter(|field| field.meaning.is_empty()).map(|field| field.name).collect()
}

/// Deeper tables than this are files of their own, or a mistake.
const DEEPEST: usize = 6;

fn gather(node: Node<'_>, before: &str, depth: usize, all: &mut Vec<Field>) {
    if depth > DEEPEST {
        return;
    }
    let must: Vec<&str> = node.required().collect();
    let (first, second): (Vec<_>, Vec<_>) = node.properties().partition(|(key, _)| must.contains(key));
    for (key, part) in first.into_iter().chain(second) {
        let Some(inner) = node.property(key) else { continue };
        let name = format!("{before}{key}");
        all.push(field(&name, node, part, inner, must.contains(&key)));
        for table in tables(inner) {
            gather(table, &format!("{name}."), depth + 1, all);
        }
    }
}

fn field(name: &str, holder: Node<'_>, part: Node<'_>, inner: Node<'_>, required: bool) -> Field {
    // A key that tells several tables apart says what its table is.
    let table = || inner.get("const").and_then(|_| holder.text("description"));
    let meaning =
        part.text("description").or_else(|| inner.text("description")).or_else(table).unwrap_or_default();
    let default = match part.get("default").or_else(|| inner.get("default")) {
        _ if required => Default::Required,
        Some(value) if !value.is_null() => Default::Value(in_toml(value)),
        _ => Default::Absent,
    };
    let words = inner.branches().into_iter().flat_map(|branch| {
        let about = branch.text("description").map(on_one_line).unwrap_or_default();
        branch.words().into_iter().map(move |word| (word.to_owned(), about.clone()))
    });
    Field {
        name: name.to_owned(),
        meaning: on_one_line(meaning),
        unit: unit(name),
        accepted: inner.accepted(),
        default,
        words: words.filter(|(_, about)| !about.is_empty()).collect(),
    }
}

/// The tables that a value holds: it itself, its elements, its values by name, whatever it may be.
fn tables(node: Node<'_>) -> Vec<Node<'_>> {
    if let Some(items) = node.part("items") {
        return tables(items);
    }
    let branches = node.branches();
    if !branches.is_empty() {
        return branches.into_iter().flat_map(tables).collect();
    }
    match node.part("additionalProperties") {
        Some(part) if node.properties().next().is_none() => tables(part),
        _ if node.properties().next().is_some() => vec![node],
        _ => Vec::new(),
    }
}

fn in_toml(value: &Value) -> String {
    match value {
        Value::Object(table) if table.values().all(Value::is_null) => "an empty table".to_owned(),
        Value::Object(table) => {
            let given = table.iter().filter(|(_, value)| !value.is_null());
            let given: Vec<String> =
                given.map(|(key, value)| format!("{key} = {}", in_toml(value))).collect();
            format!("{{ {} }}", given.join(", "))
        }
        other => other.to_string(),
    }
}
