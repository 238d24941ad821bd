//! `replan schema`: the JSON Schema of every kind of TOML file, made from the same types that read the files.
//!
//! Everything registered has one form here, [`Item`]: for the schemas, for `replan list`, and for tests of both.
//!
//! In papers and studies, the settings of an entry are described by that entry. So an editor completes them, and
//! `replan check` finds every fault in all tables of all files at once.

use super::Failure;
use crate::analysis::{criterion, rule};
use crate::render::figure;
use base::settings::{Accepted, generator};
use clap::Args;
use engine::planner::{self, Build};
use schemars::{JsonSchema, SchemaGenerator};
use serde_json::{Map, Value, json};
use std::borrow::Cow;
use std::fs;
use std::path::{Path, PathBuf};
use study::files::{self, FileKind};
use study::{family, paper, preprocessing, task};

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
        for kind in files() {
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
            let kinds = files();
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
    files().iter().try_for_each(|kind| {
        let text = serde_json::to_string_pretty(&schema(kind.name)).expect("a schema is plain JSON") + "\n";
        fs::write(folder.join(file_name(kind.name)), text)
    })
}

/// The settings of each item that takes some, by its name.
fn parts(items: &[Item], generator: &mut SchemaGenerator) -> Vec<(&'static str, Value)> {
    items.iter().filter_map(|item| Some((item.name, item.settings?.within(generator)))).collect()
}

/// The schema of `kind` alone, with the definitions that `generator` has made.
fn whole(kind: &str, generator: SchemaGenerator) -> Value {
    let found = files().into_iter().find(|item| item.name == kind).and_then(|item| item.settings);
    found.map_or(Value::Bool(true), |accepted| accepted.whole_with(generator))
}

fn study(names: bool) -> Value {
    let mut generator = generator();
    let [planners, stages, families, tasks, figures] =
        [planners(), stages(), families(), tasks(), figures()].map(|items| parts(&items, &mut generator));
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
    let [criteria, rules] = [criteria(), rules()].map(|items| parts(&items, &mut generator));
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

/// What names an entry in a file, and the table of its settings; `{}` stands for its name.
#[derive(Clone, Copy)]
pub struct Frame(&'static str, &'static str);

const PLANNER: Frame = Frame("[[contender]]\nlabel = \"mine\"\nplanner = \"{}\"", "contender.settings");
const STAGE: Frame = Frame("[[contender.then]]\nstage = \"{}\"", "contender.then.settings");
const FAMILY: Frame = Frame("[[problems]]\nlabel = \"mine\"\nfamily = \"{}\"", "problems.settings");
const TASK: Frame = Frame("task = \"{}\"", "task_settings");
const CRITERION: Frame = Frame("[[claim]]\nid = \"mine\"\nat = \"section 1\"", "claim.check.{}");
const RULE: Frame = Frame("[[claim]]\nid = \"mine\"\nat = \"section 1\"", "claim.rule.{}");
const FIGURE: Frame = Frame("[[figure]]\nid = \"mine\"\nkind = \"{}\"\ncaption = \"…\"", "figure.settings");
const NONE: Frame = Frame("", "");

impl Item {
    /// Its example as a file has it; `None` if it takes no settings.
    pub fn shown(&self) -> Option<String> {
        let place = self.place();
        let mut text = self.frame.0.replace("{}", self.name);
        if !self.example.is_empty() {
            text += &format!("\n[{place}]");
        }
        for line in self.example.trim().lines() {
            // What is indented continues an array; brackets at the beginning of a line are a table's.
            let (brackets, rest) = line.split_at(line.len() - line.trim_start_matches('[').len());
            let within = if brackets.is_empty() { String::new() } else { format!("{brackets}{place}.") };
            text += &format!("\n{within}{rest}");
        }
        (!place.is_empty()).then_some(text)
    }

    /// The table of its settings in a file: `contender.settings`.
    pub fn place(&self) -> String {
        self.frame.1.replace("{}", self.name)
    }
}

/// Something that specs name.
pub struct Item {
    /// Its name.
    pub name: &'static str,
    /// One line on it.
    pub about: &'static str,
    /// Its settings, if it is a thing that is set.
    pub settings: Option<Accepted>,
    /// Settings that it can be built from; empty if it needs none.
    pub example: &'static str,
    /// A file of this repository that is one, if it is a kind of file.
    pub file: Option<&'static str>,
    /// The text before its settings in a file, with `{}` for its name, and the table of the settings.
    pub frame: Frame,
    /// The columns that it fills.
    pub columns: &'static [&'static str],
}

/// A thing that is set, from what its registry has of it.
fn item(
    frame: Frame,
    [name, about, example]: [&'static str; 3],
    settings: Accepted,
    columns: &'static [&'static str],
) -> Item {
    Item { name, about, settings: Some(settings), example, file: None, frame, columns }
}

fn planners_or_stages(first: bool) -> Vec<Item> {
    let fits = |entry: &&planner::Entry| matches!(entry.build, Build::Planner(_)) == first;
    let frame = if first { PLANNER } else { STAGE };
    let planners = study::planner::all().filter(fits);
    planners.map(|e| item(frame, [e.name, e.about, e.example], e.settings, e.columns)).collect()
}

/// Planners: the first in a contender's pipeline.
pub fn planners() -> Vec<Item> {
    planners_or_stages(true)
}

/// Stages: the others.
pub fn stages() -> Vec<Item> {
    planners_or_stages(false)
}

/// Families of problems.
pub fn families() -> Vec<Item> {
    let families = family::REGISTRY.iter();
    families.map(|e| item(FAMILY, [e.name, e.about, e.example], e.settings, e.columns)).collect()
}

/// Tasks.
pub fn tasks() -> Vec<Item> {
    task::REGISTRY.iter().map(|e| item(TASK, [e.name, e.about, e.example], e.settings, e.columns)).collect()
}

/// Criteria of claims.
pub fn criteria() -> Vec<Item> {
    criteria_or_rules(criterion::REGISTRY, CRITERION)
}

/// Rules of arithmetic on printed numbers.
pub fn rules() -> Vec<Item> {
    criteria_or_rules(rule::REGISTRY, RULE)
}

fn criteria_or_rules(registry: &[&criterion::Entry], frame: Frame) -> Vec<Item> {
    registry.iter().map(|e| item(frame, [e.name, e.about, e.example], e.settings, &[])).collect()
}

/// Kinds of figure.
pub fn figures() -> Vec<Item> {
    figure::REGISTRY.iter().map(|e| item(FIGURE, [e.name, e.about, e.example], e.settings, &[])).collect()
}

/// Kinds of preprocessed object, which have no settings of their own: their family's make them.
pub fn preprocessing() -> Vec<Item> {
    let kind = |e: &&preprocessing::Entry| Item {
        name: e.name,
        about: e.about,
        settings: None,
        example: "",
        file: None,
        frame: NONE,
        columns: e.columns,
    };
    preprocessing::REGISTRY.iter().map(kind).collect()
}

/// What `replan-audit` reads: the committed schema, which its tests hold to its checks.
struct AuditTables;

impl JsonSchema for AuditTables {
    fn schema_name() -> Cow<'static, str> {
        "AuditTables".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> schemars::Schema {
        serde_json::from_str(include_str!("../../docs/schema/audit_tables.schema.json"))
            .expect("it is a schema")
    }
}

/// Kinds of TOML file that replan reads, in the order of their names.
pub fn files() -> Vec<Item> {
    let named = [
        FileKind {
            name: "audit_tables",
            about: "printed tables, samples and relations for replan audit: docs/audit/zhang.toml",
            accepted: Accepted::shape::<AuditTables>(),
            example: "docs/audit/fu2018.toml",
        },
        FileKind {
            name: "crosscheck",
            about: "the questions to an independent judge: crosscheck.toml in a paper's folder",
            accepted: super::crosscheck::FILE,
            example: "experiments/gallery/crosscheck.toml",
        },
        FileKind {
            name: "paper",
            about: "a paper's source, inventory, claims and tables: paper.toml in its folder",
            accepted: paper::FILE,
            example: "experiments/movingai_sample/paper.toml",
        },
        FileKind {
            name: "planner_protocol",
            about: "lines of JSON that planners from outside and replan write: docs/PLANNER_PROTOCOL.md",
            accepted: Accepted::shape::<external::message::Messages>(),
            example: "docs/PLANNER_PROTOCOL.md",
        },
    ];
    let kind = |kind: &FileKind| Item {
        file: Some(kind.example),
        ..item(NONE, [kind.name, kind.about, ""], kind.accepted, &[])
    };
    let mut all: Vec<Item> = named.iter().chain(files::KINDS).map(kind).collect();
    all.sort_by_key(|item| item.name);
    all
}
