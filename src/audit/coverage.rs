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
    fn numbers_in_words_in_cells_of_several_columns_and_in_own_macros_are_told() {
        let text = "\\newcommand{\\mine}{69}\n\\newcommand{\\size}[1]{\\fontsize{#1}{9}}\n\\begin{document}\n\
                    Twelve of \\multicolumn{2}{c}{88} and one \\textcolor{red!50}{77} in a 12cm gap, 12\\,345 or 1{,}234.\n\
                    \\begin{tabular}{p{3cm}}\\def\\two{2}\\href{a.b/7}{6}\n\\end{document}\n";
        let found: Vec<String> =
            said(text, None).iter().map(|line| line.split(" is ").next().unwrap().to_owned()).collect();
        let expected = ["4:1: Twelve", "4:30: 88", "4:61: 77", "4:70: 12", "4:80: 12345", "4:91: 1234"];
        assert_eq!(found[..2], ["1:1: 69", "5:1: 2"]);
        assert_eq!(found[2..8], expected);
        assert_eq!(found[8..], ["5:48: 6"]);
    }

    #[test]
    fn fractions_ordinals_and_numbers_right_behind_a_command_are_told() {
        let text = "A $\\frac12$, \\tfrac{3}{4} or \\frac{\\nodes}{7} of them.\n\\bf12 is the 3rd, the fourth and two thirds.\n\
                    The first second counts; half $\\alpha2$. % typed: half\n";
        let found: Vec<String> =
            said(text, None).iter().map(|line| line.split(" is ").next().unwrap().to_owned()).collect();
        let expected = [
            "1:4: 1/2",
            "1:14: 3/4",
            "1:44: 7",
            "2:4: 12",
            "2:14: 3",
            "2:23: fourth",
            "2:34: two",
            "2:38: thirds",
            "3:38: 2",
        ];
        assert_eq!(found, expected);
    }

    #[test]
    fn a_macro_that_is_called_like_the_files_and_is_not_there_is_told() {
        let file = "\\newcommand{\\zhangNodesOurs}{45}\n\\newcommand{\\zhangNodesPaper}{46}\n\\newcommand{\\zhangCostOurs}{13.40}\n";
        let told =
            |text: &str| coverage(text, file, None).iter().map(ToString::to_string).collect::<Vec<_>>();
        assert_eq!(
            told("\\zhangNodesOurs{} of \\zhangNodesTheirs{}, \\alpha, \\zhang.\n"),
            ["1:22: \\zhangNodesTheirs is called like the macros of the file, and is not among them"]
        );
        assert_eq!(told("\\newcommand{\\zhangMine}{x}\\zhangMine"), [""; 0]);
        // Two names that share nothing say nothing about a third.
        assert_eq!(coverage("\\nodesOld", MACROS, None), []);
    }

    #[test]
    fn what_a_comment_excuses_is_not_told() {
        let text =
            "We compare two planners on 45 maps with 8 neighbours. % typed: two, 8\nTwo again. % typed\n";
        let expected =
            ["1:28: 45 is typed by hand; macros of this value: \\nodes", "2:1: Two is backed by no macro"];
        assert_eq!(said(text, None), expected);
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
