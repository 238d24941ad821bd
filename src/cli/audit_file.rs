//! What the TOML tables of `replan audit` may hold, put together from its checks.

use audit::checks::REGISTRY;
use audit::printed::Digits;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde_json::{Map, Value, json};
use std::borrow::Cow;

/// The schema of a file of printed tables, cells, samples and relations.
pub struct AuditFile;

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
    let relation = |(entry, form): (&&audit::checks::Entry, &audit::checks::FromRelation)| {
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

impl JsonSchema for AuditFile {
    fn schema_name() -> Cow<'static, str> {
        "AuditFile".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
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
        let whole = json!({ "type": "object", "properties": keys, "additionalProperties": false });
        Schema::try_from(whole).expect("an object is a schema")
    }
}
