//! What the package is made of: its checks, the schema of its files, and what it stands on.

use crate::pages::{is_writing, repository};
use proofs::printed::Digits;
use replan_audit::checks::{Entry, FromRelation, REGISTRY, find};
use serde_json::{Map, Value, json};
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;

#[test]
fn every_file_of_a_check_is_registered_under_its_own_name_in_order() {
    let folder = fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("checks")).unwrap();
    let files = folder.map(|entry| entry.unwrap().path());
    let checks = files.filter(|path| fs::read_to_string(path).unwrap().contains("pub static ENTRY: Entry"));
    let mut names: Vec<String> =
        checks.map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned()).collect();
    names.sort();
    assert_eq!(REGISTRY.iter().map(|entry| entry.name).collect::<Vec<_>>(), names);
    assert!(names.iter().all(|name| find(name).is_some_and(|entry| entry.name == name)));
    assert!(find("no such thing").is_none());
}

/// Every library that the program is made of.
const CRATES: &str = "
    adler2 anstream anstyle anstyle_parse anstyle_query arraydeque bitflags block_buffer cfg_if clap
    clap_builder clap_lex colorchoice const_oid cpufeatures crc32fast crossbeam_deque crossbeam_epoch
    crossbeam_utils crypto_common csv csv_core digest dyn_clone either fdeflate flate2 foldhash
    hashbrown hashlink hybrid_array is_terminal_polyfill itoa libm linux_raw_sys memchr miniz_oxide
    num_integer num_rational num_traits png rand rand_core rand_pcg rayon rayon_core ref_cast
    replan_audit replan_base replan_proofs replan_stats roxmltree rustix ryu saphyr_parser schemars
    self_cell serde serde_core serde_json serde_spanned sha2 simd_adler32 strsim terminal_size thiserror
    toml toml_datetime toml_parser toml_writer typenum utf8parse winnow zmij";

#[test]
fn the_audit_stands_on_proofs_stats_and_base_alone() {
    let mut tree = Command::new(env!("CARGO"));
    tree.args([
        "tree",
        "--offline",
        "--locked",
        "--package",
        "replan-audit",
        "--edges",
        "normal,no-proc-macro",
    ]);
    let tree = tree
        .args(["--prefix", "none", "--format", "{lib}", "--no-dedupe"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    let listed = String::from_utf8(tree.stdout).unwrap();
    let found: BTreeSet<&str> = listed.lines().collect();
    assert_eq!(found, CRATES.split_whitespace().collect(), "{}", String::from_utf8_lossy(&tree.stderr));
}

/// The statistics of a sample that have words of their own; quantiles are written `q25` or `25%`.
const STATISTICS: [(&str, &str); 8] = [
    ("mean", "The mean as printed."),
    ("sd", "The standard deviation as printed."),
    ("se", "The standard error of the mean as printed."),
    ("min", "The least value as printed."),
    ("q25", "The lower quartile as printed; any other quantile likewise."),
    ("median", "The median as printed."),
    ("q75", "The upper quartile as printed."),
    ("max", "The greatest value as printed."),
];

fn text(about: &str) -> Value {
    json!({ "type": "string", "description": about })
}

fn rounding(about: &str) -> Value {
    let words: Vec<&str> = Digits::NAMED.iter().map(|(name, _)| *name).collect();
    json!({ "type": "string", "enum": words, "description": about })
}

fn table(about: &str, keys: &Map<String, Value>, required: &[&str]) -> Value {
    json!({
        "type": "object",
        "description": about,
        "properties": keys,
        "required": required,
        "additionalProperties": false,
    })
}

/// One relation, by the check that it names.
fn relations() -> Vec<Value> {
    let forms = REGISTRY.iter().filter_map(|entry| Some((entry, entry.relation.as_ref()?)));
    let relation = |(entry, form): (&&Entry, &FromRelation)| {
        let about = |(key, meaning): &(&str, &str)| ((*key).to_owned(), json!({ "description": meaning }));
        let mut keys: Map<String, Value> = form.keys.iter().map(about).collect();
        keys.insert(
            "check".to_owned(),
            json!({ "type": "string", "const": entry.name, "description": entry.about }),
        );
        keys.insert("name".to_owned(), text("What it is called in the report."));
        keys.insert("rounding".to_owned(), rounding("How its printed digits end."));
        table(entry.about, &keys, &["check"])
    };
    forms.map(relation).collect()
}

fn sample() -> Value {
    let mut keys = Map::from_iter(STATISTICS.map(|(key, about)| (key.to_owned(), text(about))));
    keys.insert("name".to_owned(), text("Its name."));
    keys.insert("is".to_owned(), text("What it is, as a table's head says it: `mean; n=10; whole`."));
    keys.insert("total".to_owned(), text("The sum as printed."));
    json!({
        "type": "object",
        "properties": keys,
        "additionalProperties": text("A quantile as printed, by its share: `q90`."),
    })
}

/// The schema of a file of printed tables, cells, samples and relations.
fn schema() -> Value {
    let printed = Map::from_iter([
        ("name".to_owned(), text("Its name.")),
        ("text".to_owned(), text("One Markdown table, heads and all.")),
    ]);
    let [mut about, mut digits] = [
        text("What the file holds, for readers."),
        rounding("How printed digits end where nothing else says so."),
    ];
    about["default"] = json!("");
    digits["default"] = json!(Digits::Any.name());
    let keys = json!({
        "about": about,
        "rounding": digits,
        "cells": {
            "type": "object",
            "description": "Printed numbers by name.",
            "additionalProperties": text("The number, digits and all."),
        },
        "table": {
            "type": "array",
            "description": "Printed tables.",
            "items": table("A printed table.", &printed, &["name", "text"]),
        },
        "sample": { "type": "array", "description": "Samples with their printed statistics.", "items": sample() },
        "relation": {
            "type": "array",
            "description": "Relations between printed numbers that checks ask of.",
            "items": { "oneOf": relations() },
        },
    });
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "replan: audit tables",
        "type": "object",
        "properties": keys,
        "additionalProperties": false,
    })
}

#[test]
fn the_committed_schema_has_every_key_of_every_check_and_no_other() {
    let path = repository("docs/schema/audit_tables.schema.json");
    let text = serde_json::to_string_pretty(&schema()).unwrap() + "\n";
    if is_writing() {
        fs::write(&path, &text).unwrap();
    }
    let stored = fs::read_to_string(&path).unwrap();
    assert!(stored == text, "{} is stale; REPLAN_WRITE=1 writes it", path.display());
}
