//! Numbers in an author's LaTeX that no macro backs, and macros whose value is stale.
//!
//! A number counts if it stands in the text as such: not in a comment, a label, a citation, a file's name, a length such as
//! `2pt`, or a sub- or superscript, and not as part of a word. Which of those that are left should be macros is for the
//! author to say.

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
            Kind::Stale { name, value, now: Some(now) } => {
                write!(f, "{name} is {value}, but now it is {now}")
            }
            Kind::Stale { name, value, now: None } => {
                write!(f, "{name} is {value}, but there is no such number now")
            }
        }
    }
}

/// Commands whose arguments hold no number of the text.
const SILENT: &[&str] = &[
    "label",
    "ref",
    "eqref",
    "cref",
    "Cref",
    "autoref",
    "pageref",
    "cite",
    "citep",
    "citet",
    "nocite",
    "includegraphics",
    "input",
    "include",
    "usepackage",
    "documentclass",
    "begin",
    "end",
    "vspace",
    "hspace",
    "bibliography",
    "bibliographystyle",
    "url",
    "href",
    "setcounter",
    "addtocounter",
    "setlength",
    "addtolength",
    "hypersetup",
    "geometry",
    "color",
    "definecolor",
    "newcommand",
    "renewcommand",
    "providecommand",
    "def",
    "multicolumn",
    "cmidrule",
    "hline",
];

/// The macros that a text defines: name with backslash, value, and line.
pub fn macros(text: &str) -> BTreeMap<String, (String, usize)> {
    let mut found = BTreeMap::new();
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
    let mut remarks = Vec::new();
    for (name, (value, line)) in truth.iter().flat_map(|_| &given) {
        let now = truth.as_ref().and_then(|truth| truth.get(name)).map(|(now, _)| now.clone());
        if now.as_ref() != Some(value) {
            let kind = Kind::Stale { name: name.clone(), value: value.clone(), now };
            remarks.push(Remark { in_macros: true, line: *line, column: 1, kind });
        }
    }
    let known = truth.as_ref().unwrap_or(&given);
    for (name, (value, line)) in macros(text) {
        if let Some((now, _)) = known.get(&name).filter(|(now, _)| *now != value) {
            remarks.push(Remark {
                in_macros: false,
                line,
                column: 1,
                kind: Kind::Stale { name, value, now: Some(now.clone()) },
            });
        }
    }
    let mut by_value: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    for (name, (value, _)) in known {
        by_value.entry(value).or_default().push(name.clone());
    }
    for (line, column, number) in numbers(text) {
        let macros = by_value.get(number.as_str()).cloned().unwrap_or_default();
        remarks.push(Remark { in_macros: false, line, column, kind: Kind::Typed { number, macros } });
    }
    remarks
}

/// Every number that stands in the text as such: line, column, digits.
fn numbers(text: &str) -> Vec<(usize, usize, String)> {
    let body = text.find("\\begin{document}").map_or(0, |at| at + "\\begin{document}".len());
    let end = text.find("\\end{document}").unwrap_or(text.len()).max(body);
    let first = text[..body].matches('\n').count();
    let mut scan = Scan { silent: 0, found: Vec::new() };
    for (index, line) in text[body..end].split('\n').enumerate() {
        let offset = if index == 0 {
            text[..body].rsplit('\n').next().map_or(0, |before| before.chars().count())
        } else {
            0
        };
        scan.line(first + index + 1, offset, uncommented(line));
    }
    scan.found
}

/// A walk through the text, line by line.
struct Scan {
    /// Open brackets of an argument that is not looked at.
    silent: usize,
    found: Vec<(usize, usize, String)>,
}

impl Scan {
    fn line(&mut self, line: usize, offset: usize, text: &str) {
        let chars: Vec<char> = text.chars().collect();
        let mut at = 0;
        while at < chars.len() {
            let c = chars[at];
            if self.silent > 0 {
                self.silent = match c {
                    '{' | '[' => self.silent + 1,
                    '}' | ']' => self.silent - 1,
                    _ => self.silent,
                };
                // Another argument may follow at once.
                self.silent += usize::from(self.silent == 0 && matches!(chars.get(at + 1), Some('{' | '[')));
                at += 1 + usize::from(
                    self.silent == 1 && matches!((c, chars.get(at + 1)), ('}' | ']', Some('{' | '['))),
                );
            } else if c == '\\' {
                at = self.command(&chars, at + 1);
            } else if c.is_ascii_digit() {
                at = self.number(&chars, at, line, offset);
            } else {
                at += 1;
            }
        }
    }

    /// Passes a command's name and, if it is a silent one, enters its arguments.
    fn command(&mut self, chars: &[char], start: usize) -> usize {
        let end = (start..chars.len()).find(|at| !chars[*at].is_ascii_alphabetic()).unwrap_or(chars.len());
        let name: String = chars[start..end].iter().collect();
        let mut next = end.max(start + usize::from(end == start));
        if SILENT.contains(&name.as_str()) {
            let mut opening = end;
            while chars.get(opening) == Some(&'*') {
                opening += 1;
            }
            if matches!(chars.get(opening), Some('{' | '[')) {
                self.silent = 1;
                next = opening + 1;
            }
        }
        next
    }

    /// Takes a number, unless it is part of a word, a length, or a script.
    fn number(&mut self, chars: &[char], start: usize, line: usize, offset: usize) -> usize {
        let is_part = |at: usize| {
            let is_point = chars[at] == '.' && chars.get(at + 1).is_some_and(char::is_ascii_digit);
            chars[at].is_ascii_digit() || is_point
        };
        let end = (start..chars.len()).find(|at| !is_part(*at)).unwrap_or(chars.len());
        let before = start.checked_sub(1).map(|at| chars[at]);
        let in_script = before == Some('{') && start >= 2 && matches!(chars[start - 2], '_' | '^');
        let in_word = before.is_some_and(|c| c.is_alphanumeric() || matches!(c, '_' | '^'));
        let after: String = chars[end..].iter().take(4).collect();
        let is_length = ["pt", "cm", "mm\\", "em", "ex", "in\\", "\\tex", "\\lin", "\\col"]
            .iter()
            .any(|unit| after.starts_with(unit));
        if !in_word && !in_script && !is_length {
            self.found.push((line, offset + start + 1, chars[start..end].iter().collect()));
        }
        end
    }
}

/// A line without its comment.
fn uncommented(line: &str) -> &str {
    let mut is_escaped = false;
    for (at, c) in line.char_indices() {
        if c == '%' && !is_escaped {
            return &line[..at];
        }
        is_escaped = c == '\\' && !is_escaped;
    }
    line
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

#[cfg(test)]
mod tests {
    use super::*;

    const MACROS: &str = "% made by replan\n\\newcommand{\\nodes}{45} % nodes\n\\newcommand{\\cost}{13.40}\n";

    fn said(text: &str, current: Option<&str>) -> Vec<String> {
        coverage(text, MACROS, current).iter().map(ToString::to_string).collect()
    }

    #[test]
    fn numbers_typed_by_hand_are_told_and_macros_are_not() {
        let text = "\\documentclass[11pt]{article}\n\\begin{document}\nWe open \\nodes{} and not 69 nodes, cost 13.40.% 7\n\
                    As Table~\\ref{tab:2} and \\cite[p.~3]{hart1968} say, A2 and $x_1$, $10^{3}$, 50\\,\\%.\n\
                    \\includegraphics[width=0.5\\textwidth]{fig4}\\vspace{2pt} 12pt\n\\end{document}\n99\n";
        let found = said(text, None);
        assert_eq!(
            found,
            [
                "3:26: 69 is backed by no macro",
                "3:41: 13.40 is typed by hand; macros of this value: \\cost",
                "4:68: 10 is backed by no macro",
                "4:77: 50 is backed by no macro"
            ]
        );
    }

    #[test]
    fn a_macro_that_differs_from_the_current_value_is_stale() {
        let now = MACROS.replace("45", "46").replace("\\newcommand{\\cost}{13.40}\n", "");
        let found = said("no numbers", Some(&now));
        let expected =
            ["3:1: \\cost is 13.40, but there is no such number now", "2:1: \\nodes is 45, but now it is 46"];
        assert_eq!(found, expected);
        let found = said("\\newcommand{\\nodes}{44}", None);
        assert_eq!(found, ["1:1: \\nodes is 44, but now it is 45"]);
        assert_eq!(said("\\nodes", Some(MACROS)), [""; 0]);
    }
}
