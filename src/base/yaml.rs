//! YAML and JSON files in memory, each value with its place: of JSON, which is YAML too, nothing more is known here.

use crate::settings::{Document, SettingsError, did_you_mean};
use crate::solid::Source;
use crate::text::brief;
use saphyr_parser::{Event, Parser, ScanError};
use std::collections::BTreeSet;
use std::ops::Range;

/// How many lists and tables may stand in each other: dropping a value takes stack for each.
const DEEPEST: usize = 64;

/// How YAML writes that there is no value, and what the parser makes of a key without one.
const NOTHING: &str = "~";

/// A value and where it stands.
#[derive(Debug, Clone)]
pub(crate) struct Node {
    /// The bytes where it begins.
    pub at: Range<usize>,
    data: Data,
}

#[derive(Debug, Clone)]
enum Data {
    Word(String),
    List(Vec<Node>),
    Table(Vec<(String, Node)>),
}

/// A YAML file being read.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Yaml<'a>(pub Source<'a>);

impl Yaml<'_> {
    /// What the document holds.
    ///
    /// # Errors
    /// A syntax error at its place, behind the document too; a key that is given twice in one table; anchors; a second document.
    pub fn parse(document: &Document) -> Result<Node, SettingsError> {
        let text = document.text();
        let places = Places::new(text);
        let fault = |index: usize, message: &str| Source(document).fault(&places.byte(index), message);
        let scan = |error: ScanError| {
            fault(error.marker().index(), &format!("this is neither YAML nor JSON: {}", error.info()))
        };
        let mut open: Vec<Open> = Vec::new();
        let mut root = None;
        for event in Parser::new_from_str(text) {
            let (event, span) = event.map_err(scan)?;
            let index = span.start.index();
            let node = |data| Node { at: places.byte(index), data };
            let begun = match event {
                Event::SequenceStart(..) => Some(Data::List(Vec::new())),
                Event::MappingStart(..) => Some(Data::Table(Vec::new())),
                _ => None,
            };
            if let Some(data) = begun {
                if open.len() == DEEPEST {
                    return Err(fault(
                        index,
                        &format!("this stands in {DEEPEST} lists and tables; less are accepted"),
                    ));
                }
                open.push(Open { node: node(data), key: None, names: BTreeSet::new() });
                continue;
            }
            let done = match event {
                Event::Scalar(word, ..) => node(Data::Word(word.into_owned())),
                Event::SequenceEnd | Event::MappingEnd => open.pop().expect("what ends has begun").node,
                Event::DocumentStart(_) if root.is_some() => {
                    return Err(fault(index, "a second document begins here; a file of one is accepted"));
                }
                Event::Alias(_) => {
                    return Err(fault(index, "this is a YAML alias; values written out are accepted"));
                }
                _ => continue,
            };
            match open.last_mut() {
                None => root = Some(done),
                Some(holder) => holder.put(done).map_err(|twice| {
                    let message = format!("`{}` is given twice; once is accepted", brief(&twice.key));
                    Source(document).fault(&twice.at, message)
                })?,
            }
        }
        root.ok_or_else(|| fault(0, "the file is empty; a table is accepted"))
    }

    /// The value under `key`, which must be there.
    pub fn get<'n>(self, node: &'n Node, key: &str) -> Result<&'n Node, SettingsError> {
        self.find(node, key)?.ok_or_else(|| {
            let known = node.keys().collect::<Vec<_>>().join("`, `");
            self.0.fault(&node.at, format!("there is no `{key}`; found are `{known}`"))
        })
    }

    /// The value under `key`, if there is one.
    pub fn find<'n>(self, node: &'n Node, key: &str) -> Result<Option<&'n Node>, SettingsError> {
        Ok(self.table(node)?.iter().find(|(name, _)| name == key).map(|(_, value)| value))
    }

    /// Refuses every key of a table but these.
    pub fn only(self, node: &Node, known: &[&str]) -> Result<(), SettingsError> {
        match self.table(node)?.iter().find(|(key, _)| !known.contains(&key.as_str())) {
            None => Ok(()),
            Some((key, node)) => Err(self.0.fault(&node.at, unknown(key, known))),
        }
    }

    /// The entries of a table.
    pub fn table(self, node: &Node) -> Result<&[(String, Node)], SettingsError> {
        match &node.data {
            Data::Table(entries) => Ok(entries),
            _ => Err(self.0.fault(&node.at, format!("found {}; a table is accepted", node.what()))),
        }
    }

    /// The elements of a list.
    pub fn list(self, node: &Node) -> Result<&[Node], SettingsError> {
        match &node.data {
            Data::List(elements) => Ok(elements),
            _ => Err(self.0.fault(&node.at, format!("found {}; a list is accepted", node.what()))),
        }
    }

    /// A word.
    pub fn word(self, node: &Node) -> Result<&str, SettingsError> {
        match &node.data {
            Data::Word(word) => Ok(word),
            _ => Err(self.0.fault(&node.at, format!("found {}; a word is accepted", node.what()))),
        }
    }

    /// Yes or no, in the words of YAML 1.1 or as 1 and 0, in quotes or without.
    pub fn truth(self, node: &Node, key: &str) -> Result<bool, SettingsError> {
        match self.word(node)?.to_lowercase().as_str() {
            "true" | "yes" | "on" | "y" | "1" => Ok(true),
            "false" | "no" | "off" | "n" | "0" => Ok(false),
            _ => Err(self.0.fault(
                &node.at,
                format!("{key} is {}; true or false, yes or no, 1 or 0 is accepted", node.what()),
            )),
        }
    }

    /// A finite number.
    pub fn number(self, node: &Node, key: &str) -> Result<f64, SettingsError> {
        let number: Option<f64> = match &node.data {
            Data::Word(word) => word.parse().ok(),
            _ => None,
        };
        // As written: of `1e400` an infinity is read.
        let accepted = if number.is_some() { "a finite number" } else { "a number" };
        let wrong = || self.0.fault(&node.at, format!("{key} is {}; {accepted} is accepted", node.what()));
        number.filter(|number| number.is_finite()).ok_or_else(wrong)
    }

    /// Any number of finite numbers.
    pub fn numbers(self, node: &Node, key: &str) -> Result<Vec<f64>, SettingsError> {
        self.list(node)?.iter().map(|element| self.number(element, key)).collect()
    }

    /// `N` finite numbers.
    pub fn exactly<const N: usize>(self, node: &Node, key: &str) -> Result<[f64; N], SettingsError> {
        let numbers = self.numbers(node, key)?;
        let found = numbers.len();
        numbers
            .try_into()
            .map_err(|_| self.0.fault(&node.at, format!("{key} has {found} numbers; {N} are accepted")))
    }
}

impl Node {
    /// The keys of a table; of other values none.
    pub fn keys(&self) -> impl Iterator<Item = &str> {
        let entries: &[(String, Self)] = if let Data::Table(entries) = &self.data { entries } else { &[] };
        entries.iter().map(|(key, _)| key.as_str())
    }

    /// Whether it is a list.
    pub fn is_list(&self) -> bool {
        matches!(self.data, Data::List(_))
    }

    /// Whether it holds nothing: no element, no key, no word.
    pub fn is_empty(&self) -> bool {
        match &self.data {
            Data::Word(word) => word.is_empty() || word == NOTHING,
            Data::List(elements) => elements.is_empty(),
            Data::Table(entries) => entries.is_empty(),
        }
    }

    /// Whether it may be a set of problems: a list of tables, or one that is empty.
    pub fn may_be_set(&self) -> bool {
        matches!(&self.data, Data::List(elements) if elements.is_empty())
            || self.is_list() && self.has_tables()
    }

    /// Whether it is a table or a list that holds one.
    pub fn has_tables(&self) -> bool {
        let is_table = |element: &Self| matches!(element.data, Data::Table(_));
        matches!(&self.data, Data::List(elements) if elements.iter().any(is_table)) || is_table(self)
    }

    fn what(&self) -> String {
        match &self.data {
            Data::Word(word) if word.is_empty() || word == NOTHING => "nothing".to_owned(),
            Data::Word(word) => format!("`{}`", brief(word)),
            Data::List(elements) => format!("a list of {}", elements.len()),
            Data::Table(_) => "a table".to_owned(),
        }
    }
}

/// The message that `key` is none of the `known` ones.
pub(crate) fn unknown(key: &str, known: &[&str]) -> String {
    let hint = did_you_mean(key, known.iter().copied());
    format!("unknown key `{}`{hint}; accepted: {}", brief(key), known.join(", "))
}

/// A key that a table has already, and where the second value stands.
struct Twice {
    key: String,
    at: Range<usize>,
}

/// A list or table that has not ended.
struct Open {
    node: Node,
    /// The key under which the next value stands.
    key: Option<String>,
    /// The keys that a table has already.
    names: BTreeSet<String>,
}

impl Open {
    /// Puts a value where it belongs: into a list, or as a key or the value of the key before it into a table.
    fn put(&mut self, value: Node) -> Result<(), Twice> {
        match &mut self.node.data {
            Data::List(elements) => elements.push(value),
            Data::Table(entries) => match (self.key.take(), value.data) {
                (Some(key), _) if !self.names.insert(key.clone()) => return Err(Twice { key, at: value.at }),
                (Some(key), data) => entries.push((key, Node { at: value.at, data })),
                (None, Data::Word(key)) => self.key = Some(key),
                (None, _) => self.key = Some(String::new()),
            },
            Data::Word(_) => unreachable!("a word holds nothing"),
        }
        Ok(())
    }
}

/// From the characters that the parser counts to bytes.
struct Places {
    /// The byte of every character, if they are not the same.
    bytes: Option<Vec<usize>>,
}

impl Places {
    fn new(text: &str) -> Self {
        Self { bytes: (!text.is_ascii()).then(|| text.char_indices().map(|(at, _)| at).collect()) }
    }

    fn byte(&self, index: usize) -> Range<usize> {
        let at = self.bytes.as_ref().map_or(index, |bytes| bytes.get(index).copied().unwrap_or(usize::MAX));
        at..at
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    fn refusal(text: String) -> String {
        let document = Document::new(Path::new("deep.yaml"), text);
        Yaml::parse(&document).map_or_else(|error| error.to_string(), |_| String::new())
    }

    #[test]
    fn what_is_deep_or_long_is_refused_with_a_short_message() {
        for opening in ["- ", "{a: ", "["] {
            let message = refusal(opening.repeat(100_000));
            assert!(
                message.starts_with("deep.yaml:1:") && message.len() < 1000,
                "{opening}: {message:.1000}"
            );
        }
        let long = "x".repeat(1000);
        let message = refusal(format!("{long}: 1\n{long}: 2\n"));
        assert!(message.contains("is given twice") && message.len() < 500, "{message:.1000}");
    }
}
