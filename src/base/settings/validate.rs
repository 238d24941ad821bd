//! Holds a parsed TOML value against a schema and finds every fault, each at its own key or value.
//!
//! It knows the part of JSON Schema that our types use; a test of the registries refuses a schema with any other word.

use super::nearest::{did_you_mean, nearest};
use super::renamed::{renamed, renamed_key};
use super::schema::Node;
use crate::text::{acts, brief, fault_of_name, written};
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// The largest number, either way, that is accepted where no other is given: a thousand kilometres in millimetres.
const LARGEST: f64 = 1e9;

/// The keys whose values are names: they stand in tables, in messages and in names of files.
const OF_NAMES: [&str; 3] = ["id", "label", "name"];

/// Something that is not accepted.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Fault {
    /// The bytes where it stands.
    pub(super) span: Range<usize>,
    /// What was found and what is accepted.
    pub(super) message: String,
}

impl Fault {
    fn new(span: Range<usize>, message: String) -> Self {
        Self { span, message }
    }
}

/// A value, what it is called in messages, and where that name stands.
#[derive(Clone, Copy)]
struct Subject<'a> {
    name: &'a str,
    key: Option<&'a Range<usize>>,
    value: &'a Spanned<DeValue<'a>>,
}

impl Subject<'_> {
    /// Where it stands; a table that no header of its own opens stands at its key.
    fn span(self) -> Range<usize> {
        let span = self.value.span();
        if span.is_empty() { self.key.cloned().unwrap_or(span) } else { span }
    }
}

/// What was found so far.
enum FoundFaults {
    /// Every fault, in words.
    All(Vec<Fault>),
    /// Whether there is any: branches that a value is tried on are many, and words for what nobody meant cost time.
    Any(bool),
}

impl FoundFaults {
    fn push(&mut self, fault: impl FnOnce() -> Fault) {
        match self {
            Self::All(faults) => faults.push(fault()),
            Self::Any(any) => *any = true,
        }
    }

    fn is_settled(&self) -> bool {
        matches!(self, Self::Any(true))
    }
}

/// Everything in `value` that `schema` does not accept.
pub(super) fn faults(schema: &serde_json::Value, value: &Spanned<DeValue<'_>>) -> Vec<Fault> {
    let mut faults = all_of(Node::root(schema), Subject { name: "", key: None, value });
    faults.sort_by_key(|fault| fault.span.start);
    faults
}

fn check(node: Node<'_>, subject: Subject<'_>, found: &mut FoundFaults) {
    if found.is_settled() {
        return;
    }
    for also in node.list("allOf") {
        match (also.part("if"), also.part("then")) {
            (Some(condition), Some(then)) if fits(condition, subject) => check(then, subject, found),
            (Some(_), _) => {}
            _ => check(also, subject, found),
        }
    }
    match node.branches().as_slice() {
        [] => plain(node, subject, found),
        [one] => check(*one, subject, found),
        several => choice(node, several, subject, found),
    }
}

fn all_of(node: Node<'_>, subject: Subject<'_>) -> Vec<Fault> {
    let mut found = FoundFaults::All(Vec::new());
    check(node, subject, &mut found);
    match found {
        FoundFaults::All(faults) => faults,
        FoundFaults::Any(_) => Vec::new(),
    }
}

fn fits(node: Node<'_>, subject: Subject<'_>) -> bool {
    let mut found = FoundFaults::Any(false);
    check(node, subject, &mut found);
    !found.is_settled()
}

/// A value that may be one of several things: the faults of the one that was meant.
fn choice(node: Node<'_>, branches: &[Node<'_>], subject: Subject<'_>, found: &mut FoundFaults) {
    if branches.iter().any(|branch| fits(*branch, subject)) {
        return;
    }
    if let FoundFaults::Any(any) = found {
        *any = true;
        return;
    }
    if let DeValue::String(word) = subject.value.get_ref() {
        let words: Vec<&str> = branches.iter().flat_map(|branch| branch.words()).collect();
        if !words.is_empty() {
            return found.push(|| no_such_word(subject, word, &words, &node.accepted()));
        }
    }
    if let DeValue::Table(table) = subject.value.get_ref()
        && tagged(branches, subject, table, found)
    {
        return;
    }
    let meant = branches.iter().filter(|branch| branch.kinds().iter().any(|kind| is_of(subject.value, kind)));
    match meant.map(|branch| all_of(*branch, subject)).min_by_key(Vec::len) {
        Some(faults) => faults.into_iter().for_each(|fault| found.push(|| fault)),
        None => found.push(|| refused(subject, &node.accepted())),
    }
}

/// Finds the branch that a table names, by a key whose word tells the branches apart or by a key that one branch has.
fn tagged(branches: &[Node<'_>], subject: Subject<'_>, table: &DeTable<'_>, found: &mut FoundFaults) -> bool {
    let tables: Vec<Node<'_>> =
        branches.iter().copied().filter(|branch| branch.properties().next().is_some()).collect();
    let Some(first) = tables.first() else { return false };
    let tag = first
        .properties()
        .map(|(key, _)| key)
        .find(|key| tables.iter().all(|branch| tag_word(*branch, key).is_some()));
    let Some(tag) = tag else {
        let named = tables.iter().find(|branch| branch.required().any(|key| table.get(key).is_some()));
        let named = named.or(tables.first().filter(|_| tables.len() == 1));
        return named.map(|branch| check(*branch, subject, found)).is_some();
    };
    let words: Vec<&str> = tables.iter().filter_map(|branch| tag_word(*branch, tag)).collect();
    let accepted = words.iter().map(|word| format!("\"{word}\"")).collect::<Vec<_>>().join(", ");
    let Some(value) = table.get(tag) else {
        let message = || format!("missing key `{tag}`; accepted: {accepted}");
        found.push(|| Fault::new(subject.span(), message()));
        return true;
    };
    let inner = Subject { name: tag, key: None, value };
    match value.get_ref().as_str() {
        Some(written) => match tables.iter().find(|branch| tag_word(**branch, tag) == Some(written)) {
            Some(branch) => check(*branch, subject, found),
            None => found.push(|| no_such_word(inner, written, &words, &accepted)),
        },
        None => found.push(|| refused(inner, &accepted)),
    }
    true
}

/// The one word that `key` may be in a branch.
fn tag_word<'a>(branch: Node<'a>, key: &str) -> Option<&'a str> {
    branch.property(key)?.text("const")
}

fn plain(node: Node<'_>, subject: Subject<'_>, found: &mut FoundFaults) {
    let words = node.words();
    if !words.is_empty() {
        match subject.value.get_ref() {
            DeValue::String(word) if words.contains(&word.as_ref()) => {}
            DeValue::String(word) => {
                found.push(|| no_such_word(subject, word, &words, &node.accepted()));
            }
            _ => found.push(|| refused(subject, &node.accepted())),
        }
        return;
    }
    let kinds = node.kinds();
    if !kinds.is_empty() && !kinds.iter().any(|kind| is_of(subject.value, kind)) {
        return found.push(|| refused(subject, &node.accepted()));
    }
    match subject.value.get_ref() {
        DeValue::Table(table) => keys(node, subject, table, found),
        DeValue::Array(elements) => array(node, subject, elements, found),
        DeValue::String(text) if text.contains(acts) => found.push(|| {
            let message =
                format!("`{}` holds a control character; text that can be seen is accepted", subject.name);
            Fault::new(subject.span(), message)
        }),
        DeValue::String(text) if (text.trim().chars().count() as u64) < node.least_length() => {
            found.push(|| refused(subject, &node.accepted()));
        }
        DeValue::String(name) if OF_NAMES.contains(&subject.name) => {
            if let Some(fault) = fault_of_name(name) {
                found.push(|| Fault::new(subject.span(), format!("`{}` {fault}", subject.name)));
            }
        }
        value => {
            if number(value).is_some_and(|number| number.is_finite() && !is_usable(node, number)) {
                found.push(|| refused(subject, &node.accepted_within(LARGEST)));
            } else if number(value).is_some_and(|number| !is_within(node, number)) {
                found.push(|| refused(subject, &node.accepted()));
            } else if let Some(limit) = whole(value).and_then(|whole| node.limit_passed(whole)) {
                found.push(|| refused(subject, &format!("{} (no further than {limit})", node.accepted())));
            }
        }
    }
}

fn is_within(node: Node<'_>, number: f64) -> bool {
    let (low, high) = node.bounds();
    let (above, below) = node.open_bounds();
    is_usable(node, number) && low <= number && number <= high && above < number && number < below
}

/// Whether sums and products of such numbers stay finite, in single precision too.
fn is_usable(node: Node<'_>, number: f64) -> bool {
    number.is_finite() && (number.abs() <= LARGEST || !node.kinds().contains(&"number"))
}

fn array(node: Node<'_>, subject: Subject<'_>, elements: &[Spanned<DeValue<'_>>], found: &mut FoundFaults) {
    let (least, most) = node.counts();
    if !(least..=most).contains(&(elements.len() as u64)) {
        return found.push(|| refused(subject, &node.accepted()));
    }
    let mut each: Vec<Node<'_>> = node.list("prefixItems").collect();
    let rest = node.part("items");
    for (index, value) in elements.iter().enumerate() {
        if each.len() == index {
            each.extend(rest);
        }
        let Some(item) = each.get(index) else { return };
        let name = format!("{}[{index}]", subject.name);
        check(*item, Subject { name: &name, key: subject.key, value }, found);
    }
}

fn keys(node: Node<'_>, subject: Subject<'_>, table: &DeTable<'_>, found: &mut FoundFaults) {
    let other = node.part("additionalProperties");
    let mut meant = Vec::new();
    for (key, value) in table {
        let name = key.get_ref().as_ref();
        let span = key.span();
        if let Some(fault) = fault_of_name(name) {
            found.push(|| Fault::new(span, format!("the key `{}` {fault}", brief(name))));
            continue;
        }
        match node.property(name).or(other) {
            Some(part) if !part.refuses_all() => {
                check(part, Subject { name, key: Some(&span), value }, found);
            }
            Some(_) if matches!(found, FoundFaults::Any(_)) => *found = FoundFaults::Any(true),
            Some(_) => {
                let known = || node.properties().map(|(key, _)| key);
                let now = renamed("keys")
                    .get(name)
                    .and_then(|now| known().find(|key| key == now || now.contains(&format!("`{key}`"))));
                meant.extend(now.or_else(|| nearest(name, known())));
                found.push(|| Fault::new(span, unknown(node, name)));
            }
            None => {}
        }
    }
    // A key that is only misspelled is not missing as well.
    for key in node.required().filter(|key| table.get(*key).is_none() && !meant.contains(key)) {
        found.push(|| Fault::new(subject.span(), missing(node, key)));
    }
}

fn unknown(node: Node<'_>, name: &str) -> String {
    if let Some(message) = renamed_key(name) {
        return message;
    }
    let known: Vec<&str> = node.properties().map(|(key, _)| key).collect();
    let hint = did_you_mean(name, known.iter().copied());
    let known: Vec<String> = known.iter().map(|key| format!("`{key}`")).collect();
    let accepted = if known.is_empty() { "no key".to_owned() } else { known.join(", ") };
    format!("unknown key `{}`{hint}; accepted: {accepted}", brief(name))
}

fn missing(node: Node<'_>, key: &str) -> String {
    let own = node.properties().find(|(name, _)| *name == key).and_then(|(_, part)| part.text("description"));
    let meaning =
        own.map_or_else(String::new, |text| format!(" ({})", super::describe::first_sentence(text)));
    let accepted =
        node.property(key).map_or_else(String::new, |part| format!("; {} is accepted", part.accepted()));
    format!("missing key `{key}`{meaning}{accepted}")
}

fn refused(subject: Subject<'_>, accepted: &str) -> Fault {
    let found = shown(subject.value.get_ref());
    let accepted = match number(subject.value.get_ref()) {
        Some(number) if !number.is_finite() => accepted.replace("a number", "a finite number"),
        _ => accepted.to_owned(),
    };
    let name = if subject.name.is_empty() { "the value".to_owned() } else { format!("`{}`", subject.name) };
    Fault::new(subject.span(), format!("{name} is {found}; {accepted} is accepted"))
}

fn no_such_word(subject: Subject<'_>, word: &str, known: &[&str], accepted: &str) -> Fault {
    let hint = did_you_mean(word, known.iter().copied());
    let message = format!("`{}` is \"{}\"{hint}; {accepted} is accepted", subject.name, brief(word));
    Fault::new(subject.span(), message)
}

fn is_of(value: &Spanned<DeValue<'_>>, kind: &str) -> bool {
    match value.get_ref() {
        DeValue::String(_) => kind == "string",
        DeValue::Integer(_) => kind == "integer" || kind == "number",
        DeValue::Float(_) => kind == "number",
        DeValue::Boolean(_) => kind == "boolean",
        DeValue::Datetime(_) => false,
        DeValue::Array(_) => kind == "array",
        DeValue::Table(_) => kind == "object",
    }
}

/// The number that a value is; a whole number that no float holds exactly is rounded, which no bound of ours is near.
pub(super) fn number(value: &DeValue<'_>) -> Option<f64> {
    match value {
        DeValue::Integer(_) => whole(value).map(|whole| whole as f64),
        DeValue::Float(real) => real.as_str().parse().ok(),
        _ => None,
    }
}

/// The whole number that a value is; one that no machine holds is as far from zero as a number here can be.
pub(super) fn whole(value: &DeValue<'_>) -> Option<i128> {
    let DeValue::Integer(whole) = value else { return None };
    let furthest = if whole.as_str().starts_with('-') { i128::MIN } else { i128::MAX };
    Some(i128::from_str_radix(whole.as_str(), whole.radix()).unwrap_or(furthest))
}

fn shown(value: &DeValue<'_>) -> String {
    match value {
        DeValue::String(text) => format!("\"{}\"", brief(text)),
        DeValue::Integer(whole) => whole.to_string(),
        // As a number, not as it is written: what is wrong in a table and in a copy of it is one thing.
        DeValue::Float(real) => match real.as_str().parse::<f64>() {
            Ok(number) if number.is_finite() => written(&number),
            Ok(number) => number.to_string().to_lowercase(),
            Err(_) => real.to_string(),
        },
        DeValue::Boolean(boolean) => boolean.to_string(),
        DeValue::Datetime(time) => time.to_string(),
        DeValue::Array(elements) => format!("an array of {}", elements.len()),
        DeValue::Table(_) => "a table".to_owned(),
    }
}
