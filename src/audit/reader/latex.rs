//! Tables in LaTeX: every `tabular`, named by its caption.
//!
//! Rules, sizes and colours are dropped; a `\multicolumn` stands in its first cell. The first line with cells is the header.

use super::Raw;
use crate::table::{Fault, Place};

/// Whether a text holds a table of LaTeX.
pub fn is_latex(text: &str) -> bool {
    text.contains("\\begin{tabular")
}

/// Every table in `text`.
pub fn raw(text: &str, faults: &mut Vec<Fault>) -> Vec<Raw> {
    let mut tables: Vec<Raw> = Vec::new();
    let mut caption = String::new();
    let mut open: Option<Raw> = None;
    let mut row = String::new();
    for (number, line) in text.lines().enumerate() {
        let line = without_comment(line).trim();
        if let Some(words) = argument(line, "\\caption") {
            if let Some(table) = tables.last_mut().filter(|table| table.name.is_empty() && open.is_none()) {
                words.clone_into(&mut table.name);
            } else {
                words.clone_into(&mut caption);
            }
        }
        if line.contains("\\begin{tabular") {
            let name = std::mem::take(&mut caption);
            open = Some(Raw { name, line: number + 1, mark: '&', header: Vec::new(), rows: Vec::new() });
            row.clear();
            continue;
        }
        if line.contains("\\end{tabular") {
            tables.extend(open.take().filter(|table| !table.header.is_empty()));
            continue;
        }
        let Some(table) = &mut open else { continue };
        row += line;
        row.push(' ');
        let Some((cells, _)) = row.split_once("\\\\") else { continue };
        let cells = split(cells);
        row.clear();
        if table.header.is_empty() {
            table.line = number + 1;
            table.header = cells;
        } else if cells.len() == table.header.len() {
            table.rows.push((number + 1, cells));
        } else {
            let message = format!("{} cells, where the header has {}", cells.len(), table.header.len());
            faults.push(Fault::new(Place { line: number + 1, cell: 0 }, message));
        }
    }
    if let Some(table) = open {
        faults.push(Fault::new(Place { line: table.line, cell: 0 }, "the tabular has no `\\end{tabular}`"));
    }
    tables
}

/// A line before a `%` that begins a comment.
fn without_comment(line: &str) -> &str {
    let begins = |at: &usize| line[..*at].chars().rev().take_while(|c| *c == '\\').count() % 2 == 0;
    let found = line.match_indices('%').map(|(at, _)| at).find(begins);
    found.map_or(line, |at| &line[..at])
}

/// What stands in the braces behind `command`, up to the brace that closes them.
fn argument<'t>(text: &'t str, command: &str) -> Option<&'t str> {
    let (_, rest) = text.split_once(command)?;
    let rest = rest.split_once('{')?.1;
    let mut depth = 1;
    let end = rest.find(|c| {
        depth += i32::from(c == '{') - i32::from(c == '}');
        depth == 0
    });
    Some(&rest[..end?])
}

/// The commands that stand alone in a line of cells and show nothing.
const RULES: [&str; 8] = [
    "\\hline",
    "\\toprule",
    "\\midrule",
    "\\bottomrule",
    "\\cline",
    "\\cmidrule",
    "\\rowcolor",
    "\\centering",
];

/// The cells of a row, each as plain as it can be read.
fn split(row: &str) -> Vec<String> {
    let mut row = row.trim();
    while let Some(rule) = RULES.iter().find(|rule| row.starts_with(**rule)) {
        row = row[rule.len()..].trim_start();
        for [open, close] in [['(', ')'], ['[', ']'], ['{', '}']] {
            if let Some((_, rest)) = row.strip_prefix(open).and_then(|rest| rest.split_once(close)) {
                row = rest.trim_start();
            }
        }
    }
    let mut cells = vec![String::new()];
    let mut is_escaped = false;
    for c in row.chars() {
        match cells.last_mut() {
            Some(cell) if c != '&' || is_escaped => cell.push(c),
            _ => cells.push(String::new()),
        }
        is_escaped = c == '\\';
    }
    cells.into_iter().flat_map(|cell| spread(cell.trim())).collect()
}

/// A cell, and the empty ones that it covers.
fn spread(cell: &str) -> Vec<String> {
    let Some(rest) = cell.strip_prefix("\\multicolumn{") else { return vec![plain(cell)] };
    let count = rest.split('}').next().and_then(|count| count.trim().parse().ok()).unwrap_or(1_usize);
    let inner =
        rest.split_once('}').and_then(|(_, rest)| argument(rest.split_once('}')?.1, "")).unwrap_or_default();
    let mut cells = vec![String::new(); count.clamp(1, 1000)];
    cells[0] = plain(inner);
    cells
}

fn plain(cell: &str) -> String {
    if ["--", "---"].contains(&cell) {
        return "–".to_owned();
    }
    let pairs = [
        ("\\pm", "±"),
        ("\\%", "%"),
        ("\\&", "&"),
        ("\\_", "_"),
        ("\\#", "#"),
        ("\\,", ""),
        ("~", " "),
        ("\\mathbf{", "\\textbf{"),
    ];
    let text = pairs.into_iter().fold(cell.to_owned(), |text, (from, to)| text.replace(from, to));
    let text = if text.matches('$').count() % 2 == 0 { text.replace('$', "") } else { text };
    let marks = ["\\textbf", "\\underline"].into_iter();
    marks.fold(text, |text, mark| around_the_spread(&text, mark).unwrap_or(text))
}

/// A number that alone stands in the braces behind `mark`, with its spread in them as well.
fn around_the_spread(text: &str, mark: &str) -> Option<String> {
    let inner = argument(text, mark).filter(|inner| text.starts_with(&format!("{mark}{{{inner}}}")))?;
    let spread = text[mark.len() + inner.len() + 2..].trim_start();
    spread.starts_with(['±', '(']).then(|| format!("{mark}{{{inner} {spread}}}"))
}
