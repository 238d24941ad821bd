//! Numbers in an author's LaTeX that no macro backs, and macros whose value is stale.
//!
//! A number counts if it stands in the text as such, in digits, in words, as an ordinal or as a fraction: not in a comment, a
//! label, a citation, a file's name, a length such as `2pt`, or a sub- or superscript, and not as part of a word. One that is no
//! result is excused by a comment on its line: `% typed: 2, twelve, 1/2`.

mod scan;

use scan::{commands, numbers, uncommented};
use std::collections::BTreeMap;

/// Something for the author to look at.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Remark {
    /// Whether it stands in the file of macros, and not in the text.
    pub in_macros: bool,
    /// Line there, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// What it is.
    pub kind: Kind,
}

/// What is to be looked at.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Kind {
    /// A number is typed by hand.
    Typed {
        /// The number.
        number: String,
        /// Macros with this very value.
        macros: Vec<String>,
    },
    /// A macro is used that is called like those of the file, and stands neither there nor in the text.
    Unknown {
        /// Its name.
        name: String,
    },
    /// A macro has another value than it should.
    Stale {
        /// Its name.
        name: String,
        /// Its value here.
        value: String,
        /// Its value now.
        now: Option<String>,
    },
}

/// What is said of it, in one line.
impl std::fmt::Display for Remark {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}:{}: ", self.line, self.column)?;
        match &self.kind {
            Kind::Typed { number, macros } if macros.is_empty() => {
                write!(f, "{number} is backed by no macro")
            }
            Kind::Typed { number, macros } => {
                let named: Vec<&str> = macros.iter().take(3).map(String::as_str).collect();
                write!(f, "{number} is typed by hand; macros of this value: {}", named.join(", "))
            }
            Kind::Unknown { name } => {
                write!(f, "{name} is called like the macros of the file, and is not among them")
            }
            Kind::Stale { name, value, now: Some(now) } => {
                write!(f, "{name} is {value}, but now it is {now}")
            }
            Kind::Stale { name, value, now: None } => {
                write!(f, "{name} is {value}, but there is no such number now")
            }
        }
    }
}

/// Macros by their names with backslash, each with its value and its line.
pub type Macros = BTreeMap<String, (String, usize)>;

/// The macros that a text defines.
pub fn macros(text: &str) -> Macros {
    let mut found = Macros::new();
    for (index, line) in text.lines().enumerate() {
        let line = uncommented(line);
        for command in ["\\newcommand", "\\renewcommand", "\\providecommand", "\\def"] {
            for (at, _) in line.match_indices(command) {
                let rest = line[at + command.len()..].trim_start_matches('*').trim_start();
                let rest = rest.strip_prefix('{').unwrap_or(rest);
                let Some(name) = rest.strip_prefix('\\') else { continue };
                let end = name.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(name.len());
                let (name, rest) = name.split_at(end);
                let body = rest.trim_start_matches('}').trim_start();
                let Some(body) = body.strip_prefix('{') else { continue };
                if let (Some(end), false) = (closing(body), name.is_empty()) {
                    found.insert(format!("\\{name}"), (body[..end].to_owned(), index + 1));
                }
            }
        }
    }
    found
}

/// Everything in `text` that the author should look at, given the file of macros and, if it is known, what that file would be
/// if it were made now.
pub fn coverage(text: &str, given: &str, current: Option<&str>) -> Vec<Remark> {
    let given = macros(given);
    let truth = current.map(macros);
    let mut remarks: Vec<Remark> = truth.iter().flat_map(|truth| stale(&given, truth)).collect();
    let known = truth.as_ref().unwrap_or(&given);
    let of_value = |number: &str| -> Vec<String> {
        let same = known.iter().filter(|(_, (value, _))| value == number);
        same.map(|(name, _)| name.clone()).collect()
    };
    let own = macros(text);
    for (name, (value, line)) in own.clone() {
        let kind = match known.get(&name) {
            Some((now, _)) if *now == value => continue,
            Some((now, _)) => Kind::Stale { name, value, now: Some(now.clone()) },
            None if is_number(&value) => Kind::Typed { macros: of_value(&value), number: value },
            None => continue,
        };
        remarks.push(Remark { in_macros: false, line, column: 1, kind });
    }
    remarks.extend(unknown(text, known, [&given, &own]));
    for found in numbers(text) {
        let kind = Kind::Typed { macros: of_value(&found.number), number: found.number };
        remarks.push(Remark { in_macros: false, line: found.line, column: found.column, kind });
    }
    remarks
}

/// The macros of the file, `given`, that have another value in `truth` or are not there.
fn stale(given: &Macros, truth: &Macros) -> Vec<Remark> {
    let now = |name: &String| truth.get(name).map(|(now, _)| now.clone());
    let differs = |(name, (value, _)): &(&String, &(String, usize))| now(name).as_ref() != Some(value);
    let remark = |(name, (value, line)): (&String, &(String, usize))| {
        let kind = Kind::Stale { name: name.clone(), value: value.clone(), now: now(name) };
        Remark { in_macros: true, line: *line, column: 1, kind }
    };
    given.iter().filter(differs).map(remark).collect()
}

/// The macros that `text` uses and that are called like those `known`, but stand neither there nor in `besides`.
fn unknown(text: &str, known: &Macros, besides: [&Macros; 2]) -> Vec<Remark> {
    let Some(stem) = stem(known) else { return Vec::new() };
    let is_called_so = |name: &str| name.len() > stem.len() && name.starts_with(&stem);
    let is_defined = |name: &str| besides.into_iter().chain([known]).any(|macros| macros.contains_key(name));
    let mut remarks = Vec::new();
    for found in commands(text) {
        let name = format!("\\{}", found.number);
        if is_called_so(&name) && !is_defined(&name) {
            let kind = Kind::Unknown { name };
            remarks.push(Remark { in_macros: false, line: found.line, column: found.column, kind });
        }
    }
    remarks
}

/// What the names of all macros of a file begin with, up to a capital letter: the paper's name; none if they share too little.
fn stem(known: &Macros) -> Option<String> {
    let (first, last) = (known.keys().next()?, known.keys().next_back()?);
    let shared = first.chars().zip(last.chars()).take_while(|(a, b)| a == b).count();
    let is_word = |end: usize| {
        [first, last].iter().all(|name| name[end..].starts_with(|c: char| c.is_ascii_uppercase()))
    };
    let end = (4..=shared).rev().find(|end| is_word(*end))?;
    (known.len() > 1).then(|| first[..end].to_owned())
}

/// Whether a macro's value is a number and nothing else.
fn is_number(value: &str) -> bool {
    let value = value.trim().trim_start_matches(['-', '−', '+']).trim_end_matches("\\%");
    value.starts_with(|c: char| c.is_ascii_digit())
        && value.chars().all(|c| c.is_ascii_digit() || ".,".contains(c))
}

/// Where the bracket that was opened before `text` is closed.
fn closing(text: &str) -> Option<usize> {
    let mut depth = 1;
    for (at, c) in text.char_indices() {
        depth += match c {
            '{' => 1,
            '}' => -1,
            _ => 0,
        };
        if depth == 0 {
            return Some(at);
        }
    }
    None
}
