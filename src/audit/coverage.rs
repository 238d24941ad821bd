//! Numbers in an author's LaTeX that no macro backs, and macros whose value is stale.
//!
//! A number counts if it stands in the text as such: in digits, in words, as an ordinal or as a fraction. Those in a comment, a
//! label, a citation, a file's name, a length such as `2pt`, a sub- or superscript or a part of a word do not. One that is no
//! result is excused by a comment on its line: `% typed: 2, twelve, 1/2`.

mod scan;

use scan::{Occurrence, scanned, uncommented};
use std::collections::BTreeMap;
use std::fmt;

/// Something for the author to look at.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Remark {
    /// Whether it stands in the file of macros, and not in the text.
    pub in_macros: bool,
    /// Line there, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// What is to be looked at.
    pub message: String,
}

impl fmt::Display for Remark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: {}", self.line, self.column, self.message)
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

/// Everything in `text` that the author should look at. `given` is the file of macros; `current` is that file as it
/// would be made today, if that is known.
pub fn coverage(text: &str, given: &str, current: Option<&str>) -> Vec<Remark> {
    let given = macros(given);
    let truth = current.map(macros);
    let known = truth.as_ref().unwrap_or(&given);
    let stale =
        given.iter().filter(|(name, (value, _))| known.get(*name).is_none_or(|(now, _)| now != value));
    let mut remarks: Vec<Remark> = stale
        .map(|(name, (value, line))| {
            let message = differs(name, value, known.get(name));
            Remark { in_macros: true, line: *line, column: 1, message }
        })
        .collect();
    let scan = scanned(text);
    let own = macros(text);
    let remark = |line, column, message| Remark { in_macros: false, line, column, message };
    for (name, (value, line)) in &own {
        let message = match known.get(name) {
            Some((now, _)) if now == value => continue,
            Some(now) => differs(name, value, Some(now)),
            None if is_number(value) => typed(value, known),
            None => continue,
        };
        remarks.push(remark(*line, 1, message));
    }
    let stem = stem(known);
    for Occurrence { line, column, number } in scan.commands {
        let name = format!("\\{number}");
        let is_called_so =
            stem.as_ref().is_some_and(|stem| name.len() > stem.len() && name.starts_with(stem));
        if is_called_so && ![known, &given, &own].iter().any(|macros| macros.contains_key(&name)) {
            let message = format!("{name} is called like the macros of the file, and is not among them");
            remarks.push(remark(line, column, message));
        }
    }
    remarks.extend(
        scan.numbers.into_iter().map(|found| remark(found.line, found.column, typed(&found.number, known))),
    );
    remarks
}

/// That a number is typed by hand, with macros of its value.
fn typed(number: &str, known: &Macros) -> String {
    let same = known.iter().filter(|(_, (value, _))| value == number).map(|(name, _)| name.as_str());
    match same.take(3).collect::<Vec<_>>().join(", ") {
        named if named.is_empty() => format!("{number} is backed by no macro"),
        named => format!("{number} is typed by hand; macros of this value: {named}"),
    }
}

/// That a macro has another value than it should.
fn differs(name: &str, value: &str, now: Option<&(String, usize)>) -> String {
    match now {
        Some((now, _)) => format!("{name} is {value}, but now it is {now}"),
        None => format!("{name} is {value}, but there is no such number now"),
    }
}

/// What the names of all macros of a file begin with, up to a capital letter: the paper's name; `None` if they share too little.
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
