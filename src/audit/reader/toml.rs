//! TOML with tables, cells, samples and relations between them.

use super::Raw;
use crate::input::Input;
use crate::meaning::{self, Meaning};
use crate::named_check;
use crate::statistic::Statistic;
use crate::table::{Fault, Place};
use proofs::printed::Digits;
use serde::Deserialize;
use std::collections::BTreeMap;
use toml::{Spanned, Value};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Document {
    /// A remark on the whole file; not used.
    #[serde(default, rename = "about")]
    _about: String,
    rounding: Option<Spanned<String>>,
    #[serde(default)]
    cells: BTreeMap<String, Spanned<String>>,
    #[serde(default)]
    table: Vec<TableText>,
    #[serde(default)]
    sample: Vec<Spanned<Keys>>,
    #[serde(default)]
    relation: Vec<Spanned<Keys>>,
}

/// The keys of a table, each with where its value stands.
type Keys = BTreeMap<String, Spanned<Value>>;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct TableText {
    name: Spanned<String>,
    text: Spanned<String>,
}

/// What is accepted where numbers of different places meet.
const WITHOUT: &str = "numbers that are held against each other are written without, all in one unit";

/// Reads the document; none, with a fault, if it is no TOML or has other fields.
pub fn read(text: &str, faults: &mut Vec<Fault>) -> Option<Input> {
    let line = |at: usize| Place {
        line: 1 + text.get(..at).map_or(0, |before| before.matches('\n').count()),
        cell: 0,
    };
    let document: Document = match toml::from_str(text) {
        Ok(document) => document,
        Err(error) => {
            let place = line(error.span().map_or(0, |span| span.start));
            faults.push(Fault::new(place, error.message().to_owned()));
            return None;
        }
    };
    let digits = digits_of(document.rounding.as_ref(), line, faults);
    let raw = |table: &TableText| raw_of(table, line(table.text.span().start), faults);
    let raws: Vec<Raw> = document.table.iter().filter_map(raw).collect();
    let mut input = Input::of_tables(super::tables(raws, faults));
    for (name, cell) in document.cells {
        let place = line(cell.span().start);
        match number_of(cell.get_ref()) {
            Ok(value) => input.name(name, value, digits, place),
            Err(message) => faults.push(Fault::new(place, format!("cell `{name}`: {message}"))),
        }
    }
    let placed = |keys: Keys| -> BTreeMap<String, (Value, Place)> {
        let one = |(key, value): (String, Spanned<Value>)| {
            let place = line(value.span().start);
            (key, (value.into_inner(), place))
        };
        keys.into_iter().map(one).collect()
    };
    for sample in document.sample {
        let place = line(sample.span().start);
        if let Err(fault) = take_sample(&mut input, placed(sample.into_inner()), digits, place) {
            faults.push(fault);
        }
    }
    for relation in document.relation {
        let place = line(relation.span().start);
        match named_check::read(placed(relation.into_inner()), digits, place) {
            Ok(relation) => input.relations.push(relation),
            Err(fault) => faults.push(fault),
        }
    }
    Some(input)
}

/// The one number, without a unit, that a named cell holds.
fn number_of(text: &str) -> Result<super::Printed, String> {
    match super::cells::number(text)? {
        _ if !super::unit(text).1.is_empty() => Err(format!("`{text}` has a unit; {WITHOUT}")),
        super::Number::Plain { value, spread: None } => Ok(value),
        _ => Err("one number is accepted here".to_owned()),
    }
}

/// The table whose text starts at `place`; none, with a fault, if it is not one Markdown table.
fn raw_of(table: &TableText, place: Place, faults: &mut Vec<Fault>) -> Option<Raw> {
    // The text of a string in three quotes starts a line below its quotes.
    let mut found = super::markdown::raw(table.text.get_ref(), place.line + 1, faults);
    let name = table.name.get_ref();
    match found.pop() {
        Some(raw) if found.is_empty() => Some(Raw { name: name.clone(), ..raw }),
        _ => {
            faults.push(Fault::new(place, format!("table `{name}`: its text must hold one Markdown table")));
            None
        }
    }
}

/// How digits end where no annotation says otherwise; unknown words are faults at the place that `line` gives.
fn digits_of(
    rounding: Option<&Spanned<String>>,
    line: impl Fn(usize) -> Place,
    faults: &mut Vec<Fault>,
) -> Digits {
    let Some(name) = rounding else { return Digits::Any };
    meaning::rounding(name.get_ref()).unwrap_or_else(|| {
        let message =
            format!("rounding `{}` is not known; accepted: {}", name.get_ref(), meaning::roundings());
        faults.push(Fault::new(line(name.span().start), message));
        Digits::Any
    })
}

/// Takes a sample: its name, what it is, and its statistics.
fn take_sample(
    input: &mut Input,
    mut keys: BTreeMap<String, (Value, Place)>,
    digits: Digits,
    place: Place,
) -> Result<(), Fault> {
    let text = |value: Option<(Value, Place)>| match value {
        None => Ok((String::new(), place)),
        Some((Value::String(text), at)) => Ok((text, at)),
        Some((other, at)) => Err(Fault::new(at, format!("`{other}` is no text in quotes"))),
    };
    let (name, _) = text(keys.remove("name"))?;
    let (is, at) = text(keys.remove("is"))?;
    let mut meaning = Meaning::parse(&is).map_err(|message| Fault::new(at, message))?;
    if meaning.digits == Digits::Any {
        meaning.digits = digits;
    }
    let mut statistics = Vec::new();
    for (key, value) in keys {
        let fault = |message: String| Fault::new(value.1, message);
        let statistic = Statistic::named(&key).ok_or_else(|| {
            fault(format!("sample `{name}` has the key `{key}`; accepted: name, is, mean, sd, se, min, q25, median, q75, max, total"))
        })?;
        let (text, _) = text(Some(value.clone()))?;
        if !super::unit(&text).1.is_empty() {
            return Err(fault(format!("sample `{name}`: `{text}` has a unit; {WITHOUT}")));
        }
        match super::cells::number(&text).map_err(fault)? {
            super::Number::Plain { value, spread: None } => {
                statistics.push((statistic, super::widened(value, meaning.significant).map_err(fault)?));
            }
            _ => return Err(fault(format!("sample `{name}`: `{key}` must be one number in quotes"))),
        }
    }
    if statistics.is_empty() {
        let message = format!("sample `{name}` has no statistic; a mean, sd, min, … is needed");
        return Err(Fault::new(place, message));
    }
    input.take_sample(&name, &meaning, &statistics, place);
    Ok(())
}
