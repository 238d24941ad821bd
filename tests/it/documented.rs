//! Everything registered documents itself: meanings, examples and schemas come from the types that read the files.

use crate::paper::Bench;
use base::settings::describe::undocumented;
use base::settings::{Document, Settings, SettingsError};
use engine::planner::{Ending, Request};
use replan::analysis::context::Context;
use replan::analysis::criterion;
use replan::analysis::rule;
use replan::cli::schema::{self, Item};
use replan::render::figure;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use study::family::Query;
use study::paper::Paper;
use study::preprocessing::Preprocessing;
use study::{Inputs, Interpretation, family, task};

fn everything() -> Vec<(&'static str, Vec<Item>)> {
    vec![
        ("planner", schema::planners()),
        ("stage", schema::stages()),
        ("family", schema::families()),
        ("task", schema::tasks()),
        ("criterion", schema::criteria()),
        ("rule", schema::rules()),
        ("figure", schema::figures()),
        ("file", schema::files()),
    ]
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn example(item: &Item) -> Settings {
    Settings::composed(format!("the example of {}", item.name), toml::from_str(item.example).unwrap())
}

fn committed_papers() -> Vec<Paper> {
    let folders = fs::read_dir(root().join("experiments")).unwrap();
    let mut folders: Vec<PathBuf> = folders.map(|entry| entry.unwrap().path()).collect();
    folders.sort();
    let load = |folder: &PathBuf| {
        Paper::load(folder, &Inputs::below(vec![folder.clone(), root().to_owned()])).unwrap()
    };
    folders.iter().map(load).collect()
}

/// The papers that `replan new` writes: their names and numbers are nobody's.
fn new_papers() -> Vec<Paper> {
    let bench = Bench::empty();
    let load = |template: &str| {
        bench.done(&["new", template, "--from", template]);
        let folder = bench.at(template);
        Paper::load(&folder, &Inputs::below(vec![folder.clone()])).unwrap()
    };
    ["arm", "cell", "grid"].map(load).into()
}

#[test]
fn every_key_of_everything_registered_has_a_meaning() {
    let mut bare = Vec::new();
    let mut keys = 0;
    for (kind, items) in everything() {
        for item in items {
            let schema = item.settings.expect("it is set").schema();
            keys += base::settings::describe::fields(&schema).len();
            bare.extend(undocumented(&schema).into_iter().map(|key| format!("{kind} {}: {key}", item.name)));
        }
    }
    assert!(keys > 400, "{keys} keys");
    assert!(bare.is_empty(), "{}", bare.join("\n"));
}

#[test]
fn every_example_of_a_planner_a_stage_a_family_and_a_task_builds() {
    let inputs = Inputs::below(vec![root().to_owned(), root().join("experiments/zhang")]);
    for item in schema::planners().iter().chain(&schema::stages()) {
        let entry = study::planner::find(item.name).unwrap();
        let built = match entry.build {
            engine::planner::Build::Planner(build) => build(&example(item)).map(|_| ()),
            engine::planner::Build::Stage(build) => build(&example(item)).map(|_| ()),
        };
        built.unwrap_or_else(|error| panic!("{}: {error}", item.name));
    }
    for item in schema::families() {
        let built = (family::find(item.name).unwrap().build)(&example(&item), &inputs);
        built.unwrap_or_else(|error| panic!("{}: {error}", item.name));
    }
    for item in schema::tasks() {
        let built = (task::find(item.name).unwrap().build)(&example(&item));
        built.unwrap_or_else(|error| panic!("{}: {error}", item.name));
    }
}

/// What the example of every family poses.
fn posed() -> Vec<(Preprocessing, Vec<Query>)> {
    let inputs = Inputs::below(vec![root().to_owned(), root().join("experiments/zhang")]);
    let pose = |item: Item| {
        let family = (family::find(item.name).unwrap().build)(&example(&item), &inputs).unwrap();
        // A set has its problems from 0 on.
        let seed = u64::from(!family.numbers_instances());
        let preprocessing = family.prepare(seed).unwrap_or_else(|invalid| panic!("{}: {invalid}", item.name));
        let queries = family.queries_for(seed);
        assert!(preprocessing.world.kind() == family.world() && !queries.is_empty(), "{}", item.name);
        (preprocessing, queries)
    };
    schema::families().into_iter().map(pose).collect()
}

#[test]
fn every_example_of_a_planner_solves_a_problem_of_an_example_of_a_family() {
    let posed = posed();
    let problems = || {
        posed
            .iter()
            .flat_map(|(preprocessing, queries)| queries.iter().map(move |query| (preprocessing, query)))
    };
    for item in schema::planners() {
        let entry = study::planner::find(item.name).unwrap();
        let engine::planner::Build::Planner(build) = entry.build else { panic!("{} is none", item.name) };
        if study::planner::is_recorded(entry) {
            continue; // tests/it/external and tests/it/import record and import trials.
        }
        let planner = build(&example(&item)).unwrap();
        let is_solved = |(preprocessing, query): (&Preprocessing, &Query)| {
            let Query { start, goal, .. } = query;
            let request = Request {
                world: &preprocessing.world,
                start,
                goal,
                expansions: 1_000_000,
                seed: 5,
                trace: false,
            };
            planner.plan(&request).is_ok_and(|plan| plan.ending == Ending::Solved)
        };
        let mut fitting =
            problems().filter(|(preprocessing, _)| preprocessing.world.kind().serves(entry.needs));
        assert!(fitting.any(is_solved), "{}: its example solves nothing", item.name);
    }
}

/// The keys under `schema` that are one value and may be left out without a word about what holds then.
fn silent_keys(schema: &Value, whole: &Value, path: &str, found: &mut BTreeSet<String>) {
    let required =
        |key: &str| schema["required"].as_array().is_some_and(|all| all.iter().any(|one| one == key));
    for (key, part) in schema["properties"].as_object().into_iter().flatten() {
        let name = part["$ref"].as_str().and_then(|to| to.strip_prefix("#/$defs/"));
        let meant = name.map_or(part, |name| &whole["$defs"][name]);
        let many = ["array", "object"].iter().any(|kind| meant["type"] == **kind);
        let may_be_null = part.to_string().contains("\"null\"");
        if !required(key) && !many && !may_be_null && part.get("default").is_none() {
            found.insert(format!("{path}{key}"));
        }
    }
}

#[test]
fn every_value_that_may_be_left_out_has_a_default_in_its_schema() {
    let mut found = BTreeSet::new();
    let mut keys = 0;
    for (kind, items) in everything() {
        for item in items {
            let schema = item.settings.expect("it is set").schema();
            keys += base::settings::describe::fields(&schema).len();
            silent_keys(&schema, &schema, &format!("{kind} {}: ", item.name), &mut found);
            for (name, part) in schema["$defs"].as_object().into_iter().flatten() {
                silent_keys(part, &schema, &format!("{kind} {}, {name}: ", item.name), &mut found);
            }
        }
    }
    assert!(keys > 400, "{keys} keys");
    assert_eq!(found, BTreeSet::new());
}

#[test]
fn every_example_is_shown_whole_as_it_stands_in_a_file_and_within_eighty_columns() {
    let mut shown = 0;
    let mut wide = Vec::new();
    for (kind, items) in everything().into_iter().filter(|(kind, _)| *kind != "file") {
        for item in items {
            let text = item.shown().unwrap_or_else(|| panic!("{kind} {} has no example", item.name));
            let whole: toml::Table =
                text.parse().unwrap_or_else(|error| panic!("{}: {error}\n{text}", item.name));
            let settings = item.place().split('.').try_fold(toml::Value::Table(whole), |at, key| match at {
                toml::Value::Array(all) => all.first()?.get(key).cloned(),
                at => at.get(key).cloned(),
            });
            let settings = settings.unwrap_or_else(|| toml::Value::Table(toml::Table::new()));
            let written: toml::Table = item.example.parse().unwrap();
            assert_eq!(settings, toml::Value::Table(written), "{kind} {}\n{text}", item.name);
            let too_wide = text.lines().filter(|line| line.chars().count() > 78);
            wide.extend(too_wide.map(|line| format!("{kind} {}: {line}", item.name)));
            shown += 1;
        }
    }
    assert!(shown > 70, "{shown} examples");
    assert!(wide.is_empty(), "{}", wide.join("\n"));
}

/// Builds the example with some claim of one of the papers.
fn builds_somewhere(
    item: &Item,
    papers: &[Paper],
    build: &dyn Fn(&Context<'_>) -> Result<(), SettingsError>,
) {
    let settings = example(item);
    let mut errors = BTreeSet::new();
    let builds = papers.iter().any(|paper| {
        let point = Interpretation::new(&paper.choices, &BTreeMap::new()).unwrap();
        paper.claims.iter().any(|claim| {
            let context = Context { claim, settings: &settings, paper, point: &point };
            build(&context).map_err(|error| errors.insert(error.to_string())).is_ok()
        })
    });
    assert!(builds, "{}: {errors:?}", item.name);
}

#[test]
fn every_example_of_a_criterion_and_a_rule_builds_in_a_new_paper_and_so_names_nothing_of_any_other() {
    let papers = new_papers();
    for item in schema::criteria() {
        let entry = criterion::find(item.name).unwrap();
        builds_somewhere(&item, &papers, &|context| (entry.build)(context).map(|_| ()));
    }
    for item in schema::rules() {
        let entry = rule::find(item.name).unwrap();
        builds_somewhere(&item, &papers, &|context| (entry.build)(context).map(|_| ()));
    }
}

#[test]
fn every_example_of_a_figure_builds_in_a_committed_paper() {
    let papers = committed_papers();
    for item in schema::figures() {
        let entry = figure::find(item.name).unwrap();
        let settings = example(&item);
        let mut errors = BTreeSet::new();
        let builds = papers.iter().any(|paper| {
            paper.studies.iter().any(|study| {
                let built = (entry.build)(&settings, study, paper);
                built.map_err(|error| errors.insert(error.to_string())).is_ok()
            })
        });
        assert!(builds, "{}: {errors:?}", item.name);
    }
}

/// The words of JSON Schema that the validator and the descriptions understand, and those that need no understanding.
const WORDS: [&str; 28] = [
    "$defs",
    "$ref",
    "$schema",
    "additionalProperties",
    "allOf",
    "anyOf",
    "const",
    "default",
    "description",
    "enum",
    "exclusiveMaximum",
    "exclusiveMinimum",
    "minLength",
    "format",
    "if",
    "items",
    "maxItems",
    "maximum",
    "minItems",
    "minimum",
    "oneOf",
    "prefixItems",
    "properties",
    "required",
    "then",
    "title",
    "type",
    "uniqueItems",
];

fn foreign_words(schema: &Value, found: &mut BTreeSet<String>) {
    let Some(table) = schema.as_object() else { return };
    for (word, value) in table {
        if !WORDS.contains(&word.as_str()) {
            found.insert(word.clone());
        }
        match (word.as_str(), value) {
            ("properties" | "$defs", Value::Object(parts)) => {
                parts.values().for_each(|part| foreign_words(part, found));
            }
            ("default", _) => {}
            (_, Value::Array(parts)) => parts.iter().for_each(|part| foreign_words(part, found)),
            (_, part) => foreign_words(part, found),
        }
    }
}

#[test]
fn no_schema_has_a_word_that_the_validator_does_not_know() {
    let mut found = BTreeSet::new();
    for kind in schema::files() {
        foreign_words(&schema::schema(kind.name), &mut found);
    }
    assert!(found.is_empty(), "{found:?}");
    foreign_words(&serde_json::json!({ "properties": { "a": { "pattern": "x" } } }), &mut found);
    assert_eq!(found.into_iter().collect::<Vec<_>>(), ["pattern"], "the search finds what is foreign");
}

#[test]
fn the_committed_schemas_are_current() {
    for kind in schema::files() {
        let path = root().join(format!("docs/schema/{}.schema.json", kind.name));
        let stored: Value = serde_json::from_str(&fs::read_to_string(&path).unwrap()).unwrap();
        assert!(stored == schema::schema(kind.name), "{}: run `replan schema`", path.display());
    }
    let stored = fs::read_dir(root().join("docs/schema")).unwrap().count();
    assert_eq!(stored, schema::files().len(), "docs/schema has a schema of no kind of file");
}

#[test]
fn every_committed_file_keeps_to_its_schema_and_a_misspelled_key_does_not() {
    let mut files = vec![
        ("robot", "data/robots/aubo_i10.toml".to_owned()),
        ("robot", "data/robots/motoman_up6.toml".to_owned()),
        ("robot", "data/robots/puma560.toml".to_owned()),
        ("robot", "data/robots/ur5.toml".to_owned()),
        ("cell_scene", "data/scenes/fu2018_cell.toml".to_owned()),
        ("cell_groups", "data/scenes/fu2018_groups.toml".to_owned()),
        ("plane_map", "data/scenes/fu2018_particle.toml".to_owned()),
    ];
    for scene in ["c1", "c2", "e1", "e2", "e3", "e4"] {
        files.push(("polyhedra_scene", format!("data/scenes/tang_{scene}.toml")));
    }
    for printed in fs::read_dir(root().join("docs/audit")).unwrap() {
        let name = printed.unwrap().file_name().into_string().unwrap();
        files.push(("audit_tables", format!("docs/audit/{name}")));
    }
    for paper in ["fu2018", "movingai_sample", "planar", "tang2023", "zhang"] {
        for entry in fs::read_dir(root().join("experiments").join(paper)).unwrap() {
            let name = entry.unwrap().file_name().into_string().unwrap();
            let kind = match name.as_str() {
                "paper.toml" => "paper",
                "crosscheck.toml" => "crosscheck",
                name => match name.strip_suffix(".toml") {
                    Some(_) => "study",
                    None => continue,
                },
            };
            files.push((kind, format!("experiments/{paper}/{name}")));
        }
    }
    for (kind, file) in files {
        let path = root().join(&file);
        let schema = schema::schema(kind);
        let document = Document::open(&path).unwrap();
        document.validate(&schema).unwrap_or_else(|error| panic!("{error}"));
        let wrong = Document::new(&path, format!("no_such_key = 1\n{}", document.text()));
        assert!(
            wrong.validate(&schema).unwrap_err().to_string().contains("unknown key `no_such_key`"),
            "{file}"
        );
    }
}

#[test]
fn a_switch_that_may_be_left_out_is_off() {
    // Records of settings hold every default but those of switches, so that a switch left out must stay off.
    let mut switches = 0;
    for (kind, items) in everything() {
        for item in items {
            let schema = item.settings.expect("it is set").schema();
            for (key, part) in schema["properties"].as_object().into_iter().flatten() {
                let default = part.get("default").and_then(Value::as_bool);
                switches += u32::from(default.is_some());
                let is_recorded = ["planner", "stage", "family", "task"].contains(&kind);
                assert!(!is_recorded || default != Some(true), "{kind} {}: {key}", item.name);
            }
        }
    }
    assert!(switches > 0, "no switch may be left out");
}
