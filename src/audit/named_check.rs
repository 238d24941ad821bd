//! The check that a relation names, and the test that this check makes of it.

use super::checks::{Entry, FromRelation, REGISTRY, Test, find};
use super::input::{Input, Relation};
use super::meaning::{rounding, roundings};
use super::table::{Fault, Place};
use proofs::printed::Digits;
use std::collections::BTreeMap;
use toml::Value;

/// The relation with these keys.
///
/// # Errors
/// If it names no check, or one that has no form in TOML, or a key that the check does not have.
pub fn read(
    mut keys: BTreeMap<String, (Value, Place)>,
    digits: Digits,
    place: Place,
) -> Result<Relation, Fault> {
    let fault = |message: String| Fault::new(place, message);
    let mut text = |key: &str| match keys.remove(key) {
        Some((Value::String(text), place)) => Ok((text, place)),
        None => Ok((String::new(), place)),
        Some((other, at)) => Err(Fault::new(at, format!("`{key}` is {other}; a text in quotes is accepted"))),
    };
    let (check, of_check) = text("check")?;
    let (name, _) = text("name")?;
    let (read, of_rounding) = text("rounding")?;
    if check.is_empty() {
        let known: Vec<&str> =
            REGISTRY.iter().flat_map(|entry| &entry.relation).flat_map(FromRelation::names).collect();
        let unknown: Vec<String> =
            keys.keys().filter(|key| !known.contains(&key.as_str())).map(|key| format!("`{key}`")).collect();
        let which = match unknown.as_slice() {
            [] => String::new(),
            keys => format!("; no relation has {}", keys.join(", ")),
        };
        return Err(fault(format!(
            "`check` is missing{which}; the name of a check is accepted, as check = \"ratio\""
        )));
    }
    let known = || {
        let forms = REGISTRY.iter().filter(|entry| entry.relation.is_some()).map(|entry| entry.name);
        forms.collect::<Vec<_>>().join(", ")
    };
    let form = find(&check).and_then(|entry| entry.relation.as_ref());
    let form = form.ok_or_else(|| {
        Fault::new(of_check, format!("check `{check}` is no relation; accepted: {}", known()))
    })?;
    let digits = match read.as_str() {
        "" => digits,
        other => rounding(other).ok_or_else(|| {
            Fault::new(of_rounding, format!("rounding `{other}` is not known; accepted: {}", roundings()))
        })?,
    };
    if let Some((key, (_, at))) = keys.iter().find(|(key, _)| !form.names().contains(&key.as_str())) {
        let message = format!("check `{check}` has no key `{key}`; it has {}", form.names().join(", "));
        return Err(Fault::new(*at, message));
    }
    Ok(Relation { check, name, place, digits, keys })
}

/// The test that a relation asks for.
///
/// # Errors
/// What the check refuses of the relation.
pub fn test(relation: &Relation, input: &Input) -> Result<(&'static Entry, Box<dyn Test>), Fault> {
    let entry = find(&relation.check)
        .ok_or_else(|| relation.fault(format!("there is no check `{}`", relation.check)))?;
    let form = entry.relation.as_ref().ok_or_else(|| relation.fault("it has no form in TOML"))?;
    Ok((entry, (form.build)(relation, input)?))
}
