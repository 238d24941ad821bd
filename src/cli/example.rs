//! Examples of entries as they stand in a paper's files, within the terminal's columns.

use toml::{Table, Value};

/// The most columns of an example, its indentation left out.
const COLUMNS: usize = 78;

/// The settings in `example` as TOML under the header `place`, after the lines of `before`; what is too long for a line is
/// broken where TOML allows it.
pub fn shown(before: &str, place: &str, example: &str) -> String {
    let table: Table = example.parse().unwrap_or_default();
    let mut lines: Vec<String> = before.lines().map(str::to_owned).collect();
    if !table.is_empty() {
        section(&format!("[{place}]"), place, &table, &mut lines);
    }
    lines.join("\n")
}

fn section(header: &str, place: &str, table: &Table, lines: &mut Vec<String>) {
    lines.push(header.to_owned());
    let mut later = Vec::new();
    for (key, value) in table {
        let line = format!("{} = {value}", quoted(key));
        match value {
            _ if line.chars().count() <= COLUMNS => lines.push(line),
            Value::Table(inner) => later.push((key, inner, false)),
            Value::Array(all) if all.iter().all(Value::is_table) => {
                later.extend(all.iter().filter_map(Value::as_table).map(|inner| (key, inner, true)));
            }
            other => lines.extend(broken(&quoted(key), other)),
        }
    }
    for (key, inner, is_one_of) in later {
        let place = format!("{place}.{}", quoted(key));
        let header = if is_one_of { format!("[[{place}]]") } else { format!("[{place}]") };
        section(&header, &place, inner, lines);
    }
}

/// A value that is too long for one line: an array over several, a text in three quotes.
fn broken(key: &str, value: &Value) -> Vec<String> {
    let (open, words, close) = match value {
        Value::Array(all) => (
            format!("{key} = ["),
            all.iter().map(|one| format!("{one},")).collect::<Vec<_>>(),
            "]".to_owned(),
        ),
        Value::String(text) if !text.contains(['\\', '"', '\n']) => {
            let words = text.split_inclusive(' ').map(str::to_owned).collect();
            (format!("{key} = \"\"\"\\"), words, "\"\"\"".to_owned())
        }
        other => return vec![format!("{key} = {other}")],
    };
    let is_text = value.is_str();
    let mut lines = vec![open, String::new()];
    for word in words {
        let last = lines.last_mut().expect("there are two");
        let gap = if is_text || last.is_empty() { "" } else { " " };
        if last.chars().count() + word.chars().count() + 3 > COLUMNS {
            if is_text {
                last.push('\\');
            }
            lines.push(format!("  {word}"));
        } else if last.is_empty() {
            *last = format!("  {word}");
        } else {
            *last += &format!("{gap}{word}");
        }
    }
    if is_text {
        lines.last_mut().expect("there are two").push_str(&close);
    } else {
        lines.push(close);
    }
    lines
}

/// A key as TOML writes it.
fn quoted(key: &str) -> String {
    let is_bare = |c: char| c.is_ascii_alphanumeric() || "_-".contains(c);
    if !key.is_empty() && key.chars().all(is_bare) { key.to_owned() } else { Value::from(key).to_string() }
}
