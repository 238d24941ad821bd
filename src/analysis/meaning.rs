//! What a claim means: how it is judged, and a hash of that.
//!
//! The hash is of values: the printed number, and what each criterion and rule that decides selects, computes and accepts.
//! Wording, order, ids of claims, and keys that say what holds without them change no hash. A claim that is named stands there by
//! the number that it prints or, where it must be met as well, by its meaning. A word of specs that is renamed keeps its hash ([`in_first_words`]);
//! any other change of the text that is hashed needs a new [`FORM`], which histories of claims record as such.

use super::{criterion, rule};
use base::hash::sha256;
use base::settings::{Settings, first_word, in_first_words};
use std::collections::{BTreeMap, BTreeSet};
use study::paper::{Claim, Paper, Parts, TestRole};
use toml::{Table, Value};

/// The form of the text that is hashed.
pub const FORM: u32 = 1;

/// How many digits of a hash are kept.
pub const DIGITS: usize = 16;

/// The keys under which criteria and rules name claims for the numbers that they print.
const CLAIM_KEYS: [&str; 9] =
    ["after", "against", "baseline", "before", "claims", "length", "printed_ratio", "turn", "with"];

/// The key under which they name claims that must be met as well.
const GIVEN: &str = "given";

/// The keys of words that are shown and decide nothing.
const WORD_KEYS: [&str; 3] = ["chosen", "label", "premises"];

/// What every claim of `paper` means, by id, as [`meaning`].
pub fn meanings(paper: &Paper) -> BTreeMap<String, Vec<String>> {
    paper.claims.iter().map(|claim| (claim.id.clone(), meaning(paper, claim))).collect()
}

/// The meaning of `claim`: its hash, and the studies whose trials the claim and its parts use.
pub fn meaning(paper: &Paper, claim: &Claim) -> Vec<String> {
    let parts = claim.parts.ids().iter().filter_map(|id| paper.claim(id));
    let studies: BTreeSet<&str> = parts.chain([claim]).flat_map(Claim::studies).collect();
    std::iter::once(hash(paper, claim)).chain(studies.into_iter().map(str::to_owned)).collect()
}

/// One hash of the claims of `paper`, by their ids and what they mean.
pub fn digest(paper: &Paper) -> String {
    let line = |claim: &Claim| format!("{} {}\n", claim.id, hash(paper, claim));
    brief(&paper.claims.iter().map(line).collect::<String>())
}

/// The hash of what `claim` means.
pub fn hash(paper: &Paper, claim: &Claim) -> String {
    let own = |claim: &Claim| text(paper, claim, &|given| brief(&text(paper, given, &number_of)));
    let part = |id: &String| paper.claim(id).map_or_else(String::new, |part| brief(&own(part)));
    let kind = match &claim.parts {
        Parts::None => "",
        Parts::AllOf(_) => "all_of",
        Parts::AnyOf(_) => "any_of",
        Parts::MeansOneOf(_) => "means_one_of",
        Parts::Cells(_) => "cells",
    };
    let mut parts: Vec<String> = claim.parts.ids().iter().map(part).collect();
    parts.sort();
    brief(&format!("{kind} {parts:?}\n{}", own(claim)))
}

/// The first digits of the hash of `text` in this form.
fn brief(text: &str) -> String {
    sha256(format!("form {FORM}\n{text}").as_bytes())[..DIGITS].to_owned()
}

/// The number that `claim` prints.
fn number_of(claim: &Claim) -> String {
    format!("{:?} {:?}", claim.printed, claim.digits)
}

/// What `claim` asks, parts aside, with what `given` makes of claims that must be met as well: they may name each other.
fn text(paper: &Paper, claim: &Claim, given: &dyn Fn(&Claim) -> String) -> String {
    let Claim { printed, digits, untestable, theorem, holds_when, .. } = claim;
    let flags = (untestable.is_some(), theorem.is_some());
    let mut text = format!("{printed:?} {digits:?} {flags:?} {holds_when:?}\n");
    let mut tests: Vec<String> = Vec::new();
    for (kind, name, settings) in claim.tests().filter(|(kind, ..)| *kind != TestRole::Shown) {
        let mut table = settings.table().clone();
        let entry = if kind == TestRole::Rule { rule::find(name) } else { criterion::find(name) };
        let usual = entry.map(|entry| Settings::composed(name, Table::new()).completed(entry.settings));
        let is_usual = |key: &str, value: &Value| {
            usual.iter().flat_map(Settings::filled).any(|(own, usual)| own == key && is_same(usual, value))
        };
        table.retain(|key, value| !is_usual(key, value));
        tests.push(format!(
            "{} {}\n",
            first_word(name),
            canonical_table(paper, &in_first_words(&table), given)
        ));
    }
    tests.sort();
    text.extend(tests);
    text
}

fn is_same(one: &Value, other: &Value) -> bool {
    number(one).map_or_else(|| one == other, |value| number(other) == Some(value))
}

fn number(value: &Value) -> Option<f64> {
    value.as_float().or_else(|| value.as_integer().map(|value| value as f64))
}

fn canonical_table(paper: &Paper, table: &Table, given: &dyn Fn(&Claim) -> String) -> String {
    let kept = table.iter().filter(|(key, _)| !WORD_KEYS.contains(&key.as_str()));
    let each = kept.filter_map(|(key, value)| Some((key.as_str(), canonical(paper, key, value, given)?)));
    let sorted: BTreeMap<&str, String> = each.collect();
    let each: Vec<String> = sorted.into_iter().map(|(key, value)| format!("{key} = {value}")).collect();
    format!("{{{}}}", each.join(", "))
}

/// `value`, which stands under `key`; `None` for a switch that is off and a list of nothing. A list of one is that one.
fn canonical(paper: &Paper, key: &str, value: &Value, given: &dyn Fn(&Claim) -> String) -> Option<String> {
    Some(match value {
        Value::Boolean(false) => return None,
        Value::Array(values) if values.is_empty() => return None,
        Value::Array(values) if values.len() == 1 => return canonical(paper, key, &values[0], given),
        Value::Array(values) => {
            let each = values.iter().map(|value| canonical(paper, key, value, given).unwrap_or_default());
            format!("[{}]", each.collect::<Vec<_>>().join(", "))
        }
        Value::Table(table) => canonical_table(paper, table, given),
        Value::String(text) => match paper.claim(text) {
            Some(claim) if key == GIVEN => given(claim),
            Some(claim) if CLAIM_KEYS.contains(&key) => number_of(claim),
            _ => format!("{:?}", first_word(text)),
        },
        other => number(other).map_or_else(|| other.to_string(), |value| value.to_string()),
    })
}
