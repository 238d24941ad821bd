//! The keys of a relation, and the numbers that they name.

use super::input::{Input, Relation};
use super::meaning::{contradiction, natural};
use super::reader::{Number, number, unit};
use super::sample::Sample;
use super::table::{Fault, Quoted};
use proofs::exact::{self, Exact, Print};
use toml::Value;

impl Relation {
    /// A fault at its place.
    pub fn fault(&self, message: impl std::fmt::Display) -> Fault {
        Fault::new(self.place, format!("relation `{}`: {message}", self.check))
    }

    /// What is wrong with a key, at its place, or at the relation's own without it.
    fn fault_of(&self, key: &str, what: impl std::fmt::Display) -> Fault {
        let place = self.keys.get(key).map_or(self.place, |(_, place)| *place);
        Fault { place, ..self.fault(format!("`{key}` {what}")) }
    }

    /// The value of a key; none without it.
    fn value(&self, key: &str) -> Option<&Value> {
        self.keys.get(key).map(|(value, _)| value)
    }

    /// Whether it has a key.
    pub fn has(&self, key: &str) -> bool {
        self.keys.contains_key(key)
    }

    /// A text; none without the key.
    ///
    /// # Errors
    /// If it is no text.
    pub fn text(&self, key: &str) -> Result<Option<&str>, Fault> {
        match self.value(key) {
            None => Ok(None),
            Some(Value::String(text)) => Ok(Some(text)),
            Some(other) => Err(self.fault_of(key, format!("is {other}; a text in quotes is accepted"))),
        }
    }

    /// One of some words; the first without the key.
    ///
    /// # Errors
    /// If it is another.
    pub fn word(&self, key: &str, accepted: &[&'static str]) -> Result<&'static str, Fault> {
        let Some(text) = self.text(key)? else { return Ok(accepted[0]) };
        let found = accepted.iter().find(|word| **word == text).copied();
        found.ok_or_else(|| self.fault_of(key, format!("is `{text}`; accepted: {}", accepted.join(", "))))
    }

    /// A whole number above 0; none without the key.
    ///
    /// # Errors
    /// If it is none.
    pub fn natural(&self, key: &str) -> Result<Option<u64>, Fault> {
        let Some(value) = self.value(key) else { return Ok(None) };
        let found = value.as_integer().and_then(|number| natural(&number.to_string()));
        let accepted = "a whole number from 1 to 1000000000 is accepted";
        found.map(Some).ok_or_else(|| self.fault_of(key, format!("is {value}; {accepted}")))
    }

    /// As [`natural`](Self::natural), and it must be there.
    ///
    /// # Errors
    /// If it is not there or no such number.
    pub fn needed(&self, key: &str) -> Result<u64, Fault> {
        self.natural(key)?.ok_or_else(|| self.fault_of(key, "is missing; a whole number is accepted"))
    }

    /// An exact number, written as a text or a whole number; none without the key.
    ///
    /// # Errors
    /// If it is none.
    pub fn exact(&self, key: &str) -> Result<Option<Exact>, Fault> {
        let Some(value) = self.value(key) else { return Ok(None) };
        let found = match value {
            Value::String(text) => exact::parse(text),
            Value::Integer(number) => Some(exact::whole(*number)),
            _ => None,
        };
        let accepted = "a decimal or a fraction in quotes is accepted, so that its digits stay";
        found.map(Some).ok_or_else(|| self.fault_of(key, format!("is {value}; {accepted}")))
    }

    /// The least and the greatest value, `least` and `most`; none without the keys.
    ///
    /// # Errors
    /// If one is no number, or the least is above the greatest.
    pub fn ends(&self) -> Result<[Option<Exact>; 2], Fault> {
        let [least, most] = [self.exact("least")?, self.exact("most")?];
        match contradiction::of_ends(least, most) {
            Some(why) => Err(self.fault(why)),
            None => Ok([least, most]),
        }
    }

    /// A point `"X:Y"`; none without the key.
    ///
    /// # Errors
    /// If it is none.
    pub fn point(&self, key: &str) -> Result<Option<[Exact; 2]>, Fault> {
        let Some(text) = self.text(key)? else { return Ok(None) };
        let found = super::meaning::point(text);
        found.map(Some).ok_or_else(|| self.fault_of(key, format!("is `{text}`; a point \"X:Y\" is accepted")))
    }

    /// A printed number, by name or as it stands.
    ///
    /// # Errors
    /// If it is missing, names no cell, or is no number.
    pub fn number(&self, key: &str, input: &Input) -> Result<Quoted, Fault> {
        let text = self.text(key)?.ok_or_else(|| {
            self.fault_of(key, "is missing; a printed number or the name of a cell in quotes is accepted")
        })?;
        self.resolve(key, text, input)
    }

    /// Printed numbers, each by name or as it stands.
    ///
    /// # Errors
    /// If the list is missing, or one of them names no cell or is no number.
    pub fn numbers(&self, key: &str, input: &Input) -> Result<Vec<Quoted>, Fault> {
        let list = self.value(key).and_then(Value::as_array).filter(|list| !list.is_empty());
        let accepted = "a list of printed numbers or names of cells in quotes is accepted";
        let list = list.ok_or_else(|| self.fault_of(key, format!("is missing or no list; {accepted}")))?;
        let one = |value: &Value| {
            let text =
                value.as_str().ok_or_else(|| self.fault_of(key, format!("holds {value}; {accepted}")))?;
            self.resolve(key, text, input)
        };
        list.iter().map(one).collect()
    }

    /// A sample, by name.
    ///
    /// # Errors
    /// If the key is missing or names none.
    pub fn sample(&self, key: &str, input: &Input) -> Result<Sample, Fault> {
        let name = self.text(key)?.unwrap_or_default();
        let mut found = input.samples(name);
        match (found.pop(), found.len()) {
            (Some(sample), 0) => Ok(sample),
            (Some(_), others) => Err(self.ambiguous(key, name, others + 1, "samples")),
            (None, _) => {
                let mut known = Vec::new();
                input.each_sample(&mut |sample| known.push(sample.path.clone()));
                known.truncate(20);
                let known = known.join(", ");
                Err(self.fault_of(key, format!("is `{name}`, which names no sample; there are: {known}")))
            }
        }
    }

    fn ambiguous(&self, key: &str, name: &str, count: usize, what: &str) -> Fault {
        self.fault_of(
            key,
            format!("is `{name}`, which names {count} {what}; a name that stands once is accepted"),
        )
    }

    /// The printed number that `text` under `key` is or names.
    ///
    /// # Errors
    /// If it names no cell and is no number, or names several cells.
    pub fn resolve(&self, key: &str, text: &str, input: &Input) -> Result<Quoted, Fault> {
        let mut cells = input.cells(text);
        match (cells.pop(), cells.len()) {
            (Some(quoted), 0) => return Ok(quoted),
            (Some(_), others) => return Err(self.ambiguous(key, text, others + 1, "cells")),
            (None, _) => {}
        }
        let name = if self.name.is_empty() { key.to_owned() } else { format!("{key} of {}", self.name) };
        match number(text) {
            Ok(_) if !unit(text).1.is_empty() => {
                let accepted =
                    "numbers that are held against each other are written without units, all in one";
                Err(self.fault_of(key, format!("is `{text}`; {accepted}")))
            }
            Ok(Number::Plain { value, spread: None }) => {
                let print = Print { printed: value, digits: self.digits };
                Ok(Quoted { name, place: self.place, print, cell: None })
            }
            _ => {
                Err(self
                    .fault_of(key, format!("is `{text}`, which is neither a number nor the name of a cell")))
            }
        }
    }
}
