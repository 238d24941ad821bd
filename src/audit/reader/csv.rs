//! Comma-, semicolon- and tab-separated values.

use super::Raw;
use crate::table::{Fault, Place};

/// The table in `text`; none, with a fault, if there is no header or rows are ragged.
pub fn raw(text: &str, faults: &mut Vec<Fault>) -> Option<Raw> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let (line, header, start) = header(text)?;
    let delimiter = delimiter(header);
    let header = split(header, delimiter);
    let mut rows = Vec::new();
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .delimiter(delimiter as u8)
        .comment(Some(b'#'))
        .from_reader(&text.as_bytes()[start..]);
    let mut record = csv::StringRecord::new();
    loop {
        match reader.read_record(&mut record) {
            Ok(false) => break,
            Ok(true) => {
                let at = line + record.position().map_or(0, |position| position.line() as usize);
                let texts: Vec<String> = record.iter().map(str::to_owned).collect();
                if texts.len() == header.len() {
                    rows.push((at, texts));
                } else {
                    faults.push(ragged(at, texts.len(), header.len(), delimiter));
                }
            }
            Err(error) => {
                let at = error.position().map_or(line, |position| line + position.line() as usize);
                faults.push(Fault::new(Place { line: at, cell: 0 }, format!("this is no CSV: {error}")));
                break;
            }
        }
    }
    Some(Raw { name: String::new(), line, mark: delimiter, header, rows })
}

/// The first line that is neither empty nor a comment, with its number and where the next one starts.
fn header(text: &str) -> Option<(usize, &str, usize)> {
    let mut start = 0;
    for (index, whole) in text.split_inclusive('\n').enumerate() {
        start += whole.len();
        let line = whole.trim_end_matches(['\n', '\r']);
        if !line.trim().is_empty() && !line.starts_with('#') {
            return Some((index + 1, line, start));
        }
    }
    None
}

fn ragged(line: usize, found: usize, expected: usize, delimiter: char) -> Fault {
    let message = format!(
        "{found} cells, where the header has {expected}; cells are divided by `{}`, and one that contains it stands in \
         double quotes",
        delimiter.escape_default()
    );
    Fault::new(Place { line, cell: 0 }, message)
}

/// What divides the cells of a header line: a tab or semicolon outside brackets, else a comma.
fn delimiter(header: &str) -> char {
    ['\t', ';'].into_iter().find(|mark| split(header, *mark).len() > 1).unwrap_or(',')
}

/// The cells of a header line. Commas in brackets or quotes divide nothing, so that annotations need no quotes.
fn split(header: &str, delimiter: char) -> Vec<String> {
    let mut cells = vec![String::new()];
    let mut is_quoted = false;
    let mut depth = 0_i32;
    for c in header.chars() {
        match c {
            '"' => is_quoted = !is_quoted,
            '[' if !is_quoted => depth += 1,
            ']' if !is_quoted => depth -= 1,
            _ => {}
        }
        if c == delimiter && !is_quoted && depth <= 0 {
            cells.push(String::new());
        } else if let (false, Some(cell)) = (c == '"', cells.last_mut()) {
            cell.push(c);
        }
    }
    cells
}
