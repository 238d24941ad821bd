//! Pipe tables in Markdown; each takes its name from the heading above it.

use super::Raw;
use crate::table::{Fault, Place};

/// Whether a line is the rule below a table's header: `|---|:--:|`.
pub fn is_rule(line: &str) -> bool {
    let line = line.trim();
    line.contains('|') && line.contains('-') && line.chars().all(|c| "|-: \t".contains(c))
}

/// Every table in `text`, whose first line is number `first`.
pub fn raw(text: &str, first: usize, faults: &mut Vec<Fault>) -> Vec<Raw> {
    let lines: Vec<&str> = text.lines().collect();
    let mut tables = Vec::new();
    let mut name = String::new();
    let mut at = 0;
    while at < lines.len() {
        let line = lines[at].trim();
        if line.starts_with('#') {
            line.trim_start_matches('#').trim().clone_into(&mut name);
        }
        let has_rule = lines.get(at + 1).is_some_and(|next| is_rule(next));
        if !(line.contains('|') && has_rule && !is_rule(line)) {
            at += 1;
            continue;
        }
        let header = split(line);
        let mut raw = Raw { name: name.clone(), line: first + at, mark: '|', header, rows: Vec::new() };
        at += 2;
        while let Some(line) = lines.get(at).filter(|line| line.contains('|')) {
            let texts = split(line);
            if texts.len() == raw.header.len() {
                raw.rows.push((first + at, texts));
            } else {
                let message = format!("{} cells, where the header has {}", texts.len(), raw.header.len());
                faults.push(Fault::new(Place { line: first + at, cell: 0 }, message));
            }
            at += 1;
        }
        tables.push(raw);
    }
    tables
}

/// The cells of a line; a bar after a backslash divides nothing.
fn split(line: &str) -> Vec<String> {
    let line = line.trim();
    let line = line.strip_prefix('|').unwrap_or(line);
    let mut cells = vec![String::new()];
    let mut is_escaped = false;
    for c in line.chars() {
        match cells.last_mut() {
            Some(cell) if c != '|' || is_escaped => cell.push(c),
            _ => cells.push(String::new()),
        }
        is_escaped = c == '\\';
    }
    if cells.last().is_some_and(|cell| cell.trim().is_empty()) && cells.len() > 1 {
        cells.pop();
    }
    cells.into_iter().map(|cell| cell.trim().to_owned()).collect()
}
