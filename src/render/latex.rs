//! LaTeX: booktabs tables and files of number macros.
//!
//! What is written compiles in a bare `article` with `booktabs` and nothing else. Text is escaped here;
//! a cell may also hold mathematics, which is taken as written.

use super::RenderError;
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// `text` as LaTeX shows it literally: special characters escaped, known signs in mathematics mode.
///
/// Signs of Unicode that have no entry here are kept; a UTF-8 source with a rich font shows them.
pub fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for character in text.chars() {
        match literal(character) {
            Some(latex) => safe.push_str(latex),
            None => safe.push(character),
        }
    }
    safe
}

/// How LaTeX writes a character that it would not print as it stands.
fn literal(character: char) -> Option<&'static str> {
    Some(match character {
        '\\' => "\\textbackslash{}",
        '{' => "\\{",
        '}' => "\\}",
        '$' => "\\$",
        '&' => "\\&",
        '#' => "\\#",
        '%' => "\\%",
        '_' => "\\_",
        '^' => "\\textasciicircum{}",
        '~' => "\\textasciitilde{}",
        '<' => "\\ensuremath{<}",
        '>' => "\\ensuremath{>}",
        '|' => "\\ensuremath{|}",
        '−' => "\\ensuremath{-}",
        '×' => "\\ensuremath{\\times}",
        '·' => "\\ensuremath{\\cdot}",
        '±' => "\\ensuremath{\\pm}",
        '≤' => "\\ensuremath{\\leq}",
        '≥' => "\\ensuremath{\\geq}",
        '≠' => "\\ensuremath{\\neq}",
        '∞' => "\\ensuremath{\\infty}",
        '→' => "\\ensuremath{\\to}",
        '√' => "\\ensuremath{\\surd}",
        '°' => "\\ensuremath{^\\circ}",
        '²' => "\\ensuremath{^2}",
        '³' => "\\ensuremath{^3}",
        '½' => "\\ensuremath{\\frac{1}{2}}",
        '–' => "--",
        '—' => "---",
        '…' => "\\ldots{}",
        '\u{2009}' | '\u{202f}' => "\\,",
        '\u{a0}' => "~",
        greek => return greek_letter(greek),
    })
}

fn greek_letter(letter: char) -> Option<&'static str> {
    Some(match letter {
        'α' => "\\ensuremath{\\alpha}",
        'β' => "\\ensuremath{\\beta}",
        'γ' => "\\ensuremath{\\gamma}",
        'δ' => "\\ensuremath{\\delta}",
        'θ' => "\\ensuremath{\\theta}",
        'λ' => "\\ensuremath{\\lambda}",
        'μ' | 'µ' => "\\ensuremath{\\mu}",
        'π' => "\\ensuremath{\\pi}",
        'ρ' => "\\ensuremath{\\rho}",
        'σ' => "\\ensuremath{\\sigma}",
        'φ' => "\\ensuremath{\\varphi}",
        'Δ' => "\\ensuremath{\\Delta}",
        'Σ' => "\\ensuremath{\\Sigma}",
        _ => return None,
    })
}

/// Where a column's cells stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Column {
    /// Text.
    Left,
    /// Short marks.
    Centre,
    /// Numbers with equal decimals.
    Right,
}

/// One cell of a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Cell {
    /// Text; it is escaped.
    Text(String),
    /// Text in bold; it is escaped.
    Bold(String),
    /// The inside of `$…$`, as written.
    Math(String),
    /// Text across several columns, centred; it is escaped. With a rule below it in a head.
    Across(usize, String),
}

impl Cell {
    fn columns(&self) -> usize {
        if let Self::Across(columns, _) = self { *columns } else { 1 }
    }

    fn latex(&self) -> String {
        match self {
            Self::Text(text) => escaped(text),
            Self::Bold(text) => format!("\\textbf{{{}}}", escaped(text)),
            Self::Math(source) => format!("${source}$"),
            Self::Across(columns, text) => format!("\\multicolumn{{{columns}}}{{c}}{{{}}}", escaped(text)),
        }
    }
}

impl<S: Into<String>> From<S> for Cell {
    fn from(text: S) -> Self {
        Self::Text(text.into())
    }
}

#[derive(Clone, Debug)]
enum Line {
    Head(Vec<Cell>),
    Row(Vec<Cell>),
    Group(String),
    Rule,
}

/// A table under construction: heads first, then rows.
#[derive(Clone, Debug)]
pub struct Table {
    label: String,
    caption: String,
    columns: Vec<Column>,
    lines: Vec<Line>,
    notes: Vec<String>,
}

impl Table {
    /// An empty table; `label` becomes `tab:label`.
    pub fn new(label: impl Into<String>, caption: impl Into<String>, columns: &[Column]) -> Self {
        let (label, caption) = (label.into(), caption.into());
        Self { label, caption, columns: columns.to_vec(), lines: Vec::new(), notes: Vec::new() }
    }

    /// Adds a line of the head.
    pub fn head(&mut self, cells: Vec<Cell>) -> &mut Self {
        self.lines.push(Line::Head(cells));
        self
    }

    /// Adds a row.
    pub fn row(&mut self, cells: Vec<Cell>) -> &mut Self {
        self.lines.push(Line::Row(cells));
        self
    }

    /// Adds a line in italics that opens a group of rows, with a rule above it unless it comes first.
    pub fn group(&mut self, name: impl Into<String>) -> &mut Self {
        if self.lines.iter().any(|line| matches!(line, Line::Row(_))) {
            self.lines.push(Line::Rule);
        }
        self.lines.push(Line::Group(name.into()));
        self
    }

    /// Adds a note below the table.
    pub fn note(&mut self, text: impl Into<String>) -> &mut Self {
        self.notes.push(text.into());
        self
    }

    /// The table as a `table` environment, under a comment that says how it was `made`.
    ///
    /// # Errors
    /// [`RenderError::RowWidth`] if a line does not fill the columns.
    pub fn latex(&self, made: &str) -> Result<String, RenderError> {
        let comment: String = made.lines().fold(String::new(), |all, line| all + "% " + line + "\n");
        let columns: String = self.columns.iter().map(|column| column_letter(*column)).collect();
        let (caption, label) = (escaped(&self.caption), &self.label);
        let mut text = format!(
            "{comment}\\begin{{table}}[htbp]\n\\centering\n\\caption{{{caption}}}\n\\label{{tab:{label}}}\n\
             \\begin{{tabular}}{{@{{}}{columns}@{{}}}}\n\\toprule\n"
        );
        let mut in_head = self.lines.iter().any(|line| matches!(line, Line::Head(_)));
        for (index, line) in self.lines.iter().enumerate() {
            if in_head && !matches!(line, Line::Head(_)) {
                text.push_str("\\midrule\n");
                in_head = false;
            }
            text.push_str(&self.line(index, line)?);
        }
        text.push_str("\\bottomrule\n\\end{tabular}\n");
        for note in &self.notes {
            writeln!(text, "\\par\\smallskip{{\\footnotesize {}}}", escaped(note))
                .expect("a string takes everything");
        }
        text.push_str("\\end{table}\n");
        Ok(text)
    }

    fn line(&self, index: usize, line: &Line) -> Result<String, RenderError> {
        let expected = self.columns.len();
        Ok(match line {
            Line::Rule => "\\midrule\n".to_owned(),
            Line::Group(name) => {
                format!("\\multicolumn{{{expected}}}{{@{{}}l}}{{\\textit{{{}}}}} \\\\\n", escaped(name))
            }
            Line::Head(cells) | Line::Row(cells) => {
                let found: usize = cells.iter().map(Cell::columns).sum();
                if found != expected {
                    let table = self.label.clone();
                    return Err(RenderError::RowWidth { table, row: index, found, expected });
                }
                let row: Vec<String> = cells.iter().map(Cell::latex).collect();
                let rules = if matches!(line, Line::Head(_)) { head_rules(cells) } else { String::new() };
                // A row that opens with a bracket would be read as the optional argument of the one above.
                let guard = if row[0].starts_with(['[', '*']) { "{}" } else { "" };
                format!("{guard}{} \\\\\n{rules}", row.join(" & "))
            }
        })
    }
}

fn column_letter(column: Column) -> char {
    match column {
        Column::Left => 'l',
        Column::Centre => 'c',
        Column::Right => 'r',
    }
}

/// Rules below the cells of a head that lie across several columns.
fn head_rules(cells: &[Cell]) -> String {
    let (mut first, mut rules) = (1, String::new());
    for cell in cells {
        let next = first + cell.columns();
        if matches!(cell, Cell::Across(_, text) if !text.is_empty()) {
            write!(rules, "\\cmidrule(lr){{{first}-{}}}", next - 1).expect("a string takes everything");
        }
        first = next;
    }
    if rules.is_empty() { rules } else { rules + "\n" }
}

/// The macro name of a key: words in camel case, digits in words, since TeX takes letters only.
///
/// # Errors
/// [`RenderError::EmptyMacro`] if the key has neither letter nor digit.
pub fn macro_name(key: &str) -> Result<String, RenderError> {
    const DIGITS: [&str; 10] =
        ["Zero", "One", "Two", "Three", "Four", "Five", "Six", "Seven", "Eight", "Nine"];
    let (mut name, mut capital) = (String::new(), false);
    for character in key.chars() {
        if let Some(digit) = character.to_digit(10) {
            name.push_str(DIGITS[digit as usize]);
            capital = true;
        } else if character.is_ascii_alphabetic() {
            name.push(if capital { character.to_ascii_uppercase() } else { character });
            capital = false;
        } else {
            capital = !name.is_empty();
        }
    }
    if name.is_empty() { Err(RenderError::EmptyMacro(key.to_owned())) } else { Ok(name) }
}

/// A file of numbers: one `\newcommand` each, so that a text can quote them without copying.
#[derive(Clone, Debug, Default)]
pub struct Numbers {
    macros: BTreeMap<String, (String, String)>,
}

impl Numbers {
    /// Adds `value` (text; it is escaped) under the macro name of `key`.
    ///
    /// # Errors
    /// [`RenderError::EmptyMacro`] if the key gives no name, [`RenderError::DuplicateMacro`] if another
    /// key gave the same.
    pub fn add(&mut self, key: &str, value: &str) -> Result<(), RenderError> {
        let name = macro_name(key)?;
        if let Some((first, _)) = self.macros.get(&name) {
            let (first, second) = (first.clone(), key.to_owned());
            return Err(RenderError::DuplicateMacro { name, first, second });
        }
        self.macros.insert(name, (key.to_owned(), value.to_owned()));
        Ok(())
    }

    /// The file, macros in order of their names, under a comment that says how it was `made`.
    ///
    /// Names start with `prefix` so that they meet no command of LaTeX.
    pub fn latex(&self, prefix: &str, made: &str) -> String {
        let mut text = made.lines().fold(String::new(), |all, line| all + "% " + line + "\n");
        for (name, (key, value)) in &self.macros {
            let mut letters = name.chars();
            let first = letters.next().map(|letter| letter.to_ascii_uppercase()).unwrap_or_default();
            let (rest, value) = (letters.as_str(), escaped(value));
            writeln!(text, "\\newcommand{{\\{prefix}{first}{rest}}}{{{value}}} % {key}")
                .expect("a string takes everything");
        }
        text
    }
}

#[cfg(test)]
mod tests;
