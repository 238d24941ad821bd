//! Everything registered, in one form: for `replan list`, for the schemas of files, and for tests of both.

use super::example;
use crate::analysis::{criterion, rule};
use crate::render::figure;
use base::settings::Accepted;
use engine::planner::{self, Build};
use schemars::{JsonSchema, Schema, SchemaGenerator};
use std::borrow::Cow;
use study::files::{self, FileKind};
use study::{family, paper, preprocessing, task};

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
    /// Its example as a file has it, wrapped to the terminal; `None` if it takes no settings.
    pub fn shown(&self) -> Option<String> {
        let [before, place] = [self.frame.0, self.frame.1].map(|text| text.replace("{}", self.name));
        (!place.is_empty()).then(|| example::shown(&before, &place, self.example))
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

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
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
