//! `replan schema`: the JSON Schema of every kind of TOML file, made from the same types that read the files.
//!
//! In papers and studies, the settings of an entry are described by that entry. So an editor completes them, and
//! `replan check` finds every fault in all tables of all files at once.

use super::Failure;
use super::list::{self, Item};
use base::settings::generator;
use clap::Args;
use schemars::SchemaGenerator;
use serde_json::{Map, Value, json};
use std::fs;
use std::path::{Path, PathBuf};

/// Writes JSON Schemas.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Schema {
    /// The folder for the schemas, one `<kind>.schema.json` each
    #[arg(default_value = "docs/schema")]
    folder: PathBuf,
}

const EXAMPLES: &str = "Examples:
  replan schema
  replan schema my/schemas";

impl Schema {
    /// Runs the command.
    pub(super) fn run(self) -> Result<(), Failure> {
        write_all(&self.folder)?;
        for kind in list::files() {
            say!("{}", self.folder.join(file_name(kind.name)).display());
        }
        Ok(())
    }
}

/// The schema of the kind of file called `kind`; of a table without any rule if there is no such kind.
pub fn schema(kind: &str) -> Value {
    made(kind, true)
}

/// The same, but it accepts unknown names of entries: the code that looks them up has better messages.
pub fn schema_of_any_names(kind: &str) -> Value {
    made(kind, false)
}

fn made(kind: &str, names: bool) -> Value {
    let mut schema = match kind {
        "study" => study(names),
        "paper" => paper(names),
        other => {
            let kinds = list::files();
            let found = kinds.iter().find(|item| item.name == other).and_then(|item| item.settings);
            found.map_or(Value::Bool(true), |accepted| (*accepted.schema()).clone())
        }
    };
    if let Some(root) = schema.as_object_mut() {
        root.insert("title".to_owned(), json!(format!("replan: {}", kind.replace('_', " "))));
    }
    schema
}

/// The name of the file of the schema of `kind`.
fn file_name(kind: &str) -> String {
    format!("{kind}.schema.json")
}

/// Writes the schema of every kind of file into `folder`.
///
/// # Errors
/// A folder or file that cannot be written.
pub(super) fn write_all(folder: &Path) -> std::io::Result<()> {
    fs::create_dir_all(folder)?;
    list::files().iter().try_for_each(|kind| {
        let text = serde_json::to_string_pretty(&schema(kind.name)).expect("a schema is plain JSON") + "\n";
        fs::write(folder.join(file_name(kind.name)), text)
    })
}

/// The settings of each item that takes some, by its name.
fn parts(items: &[Item], generator: &mut SchemaGenerator) -> Vec<(&'static str, Value)> {
    items.iter().filter_map(|item| Some((item.name, item.settings?.within(generator)))).collect()
}

/// The schema of `kind` alone, with what `generator` was asked for.
fn whole(kind: &str, generator: SchemaGenerator) -> Value {
    let found = list::files().into_iter().find(|item| item.name == kind).and_then(|item| item.settings);
    found.map_or(Value::Bool(true), |accepted| accepted.whole_with(generator))
}

fn study(names: bool) -> Value {
    let mut generator = generator();
    let [planners, stages, families, tasks, figures] =
        [list::planners(), list::stages(), list::families(), list::tasks(), list::figures()]
            .map(|items| parts(&items, &mut generator));
    let mut root = whole("study", generator);
    // Sweeps and interpretations fill in what a contender or a group leaves out: nothing is required there.
    choose(&mut root, Some("ContenderSpec"), ("planner", "settings"), &planners, false, names);
    choose(&mut root, Some("StageSpec"), ("stage", "settings"), &stages, false, names);
    choose(&mut root, Some("ProblemsSpec"), ("family", "settings"), &families, false, names);
    choose(&mut root, None, ("task", "task_settings"), &tasks, false, names);
    choose(&mut root, Some("FigureSpec"), ("kind", "settings"), &figures, true, names);
    root
}

fn paper(names: bool) -> Value {
    let mut generator = generator();
    let [criteria, rules] = [list::criteria(), list::rules()].map(|items| parts(&items, &mut generator));
    let several = |part: &Value| json!({ "type": "array", "items": part });
    let shown = criteria.iter().map(|(name, part)| (*name, several(part))).collect();
    let mut root = whole("paper", generator);
    for (key, entries) in [("check", criteria), ("shows", shown), ("rule", rules)] {
        let place = format!("/$defs/ClaimSpec/properties/{key}");
        if let Some(table) = root.pointer_mut(&place).and_then(Value::as_object_mut) {
            let entries: Map<String, Value> =
                entries.into_iter().map(|(name, part)| (name.to_owned(), part)).collect();
            table.insert("properties".to_owned(), Value::Object(entries));
            if names {
                table.insert("additionalProperties".to_owned(), Value::Bool(false));
            }
        }
    }
    root
}

/// Makes the table `holder` (the whole file if none) take, under the key `settings`, those of the entry that its key
/// `name` names.
fn choose(
    root: &mut Value,
    holder: Option<&str>,
    (name, settings): (&str, &str),
    entries: &[(&'static str, Value)],
    whole: bool,
    names: bool,
) {
    let known: Vec<&str> = entries.iter().map(|(name, _)| *name).collect();
    let mut rules = Vec::new();
    for (entry, part) in entries {
        let part = if whole { part.clone() } else { without_required(root, part) };
        rules.push(json!({
            "if": { "properties": { name: { "const": entry } }, "required": [name] },
            "then": { "properties": { settings: part } },
        }));
    }
    let place = holder.map_or_else(String::new, |holder| format!("/$defs/{holder}"));
    let Some(table) = root.pointer_mut(&place).and_then(Value::as_object_mut) else { return };
    if names
        && let Some(key) =
            table.get_mut("properties").and_then(|keys| keys.get_mut(name)).and_then(Value::as_object_mut)
    {
        key.insert("type".to_owned(), json!("string"));
        key.insert("enum".to_owned(), json!(known));
    }
    table.insert("allOf".to_owned(), Value::Array(rules));
}

/// A copy of the part that misses no key.
fn without_required(root: &Value, part: &Value) -> Value {
    let place = part.get("$ref").and_then(Value::as_str).and_then(|name| name.strip_prefix('#'));
    let mut copy = place.and_then(|place| root.pointer(place)).unwrap_or(part).clone();
    if let Some(table) = copy.as_object_mut() {
        table.remove("required");
    }
    copy
}
