//! The description of one entry that `replan list` prints: its meaning, each of its keys, and an example, within 80
//! columns.

use super::catalogue::Item;
use super::places::home;
use base::file::read_text;
use base::settings::describe::{Default, Field, fields};

/// Terminals have at least this many columns.
const COLUMNS: usize = 80;
/// And so many rows.
const ROWS: usize = 24;

/// `first` and then the words of `text`, on lines of 80 columns, those after the first indented by `indent`.
pub fn wrapped(first: &str, text: &str, indent: usize) -> String {
    crate::render::prose::plain(first, text, indent, COLUMNS)
}

/// Everything that is known of `item`.
pub fn explained(item: &Item) -> String {
    let mut parts = vec![item.name.to_owned(), wrapped("  ", item.about, 2)];
    if !item.columns.is_empty() {
        parts.push(wrapped("  It fills the columns ", &format!("{}.", item.columns.join(", ")), 2));
    }
    match item.settings.map(|accepted| fields(&accepted.schema())) {
        Some(keys) if keys.is_empty() => parts.push("\nIt has no settings.".to_owned()),
        Some(keys) => {
            parts.push("\nKeys".to_owned());
            parts.extend(keys.iter().map(key));
        }
        None => {
            parts.push("\nIt has no settings of its own; the family of the problems has them.".to_owned());
        }
    }
    if let Some(file) = item.file {
        parts.push(format!("\nExample\n  {file}"));
        parts.extend(short(file));
    }
    if let Some(example) = item.shown() {
        parts.push("\nExample".to_owned());
        parts.extend(example.lines().map(|line| format!("  {line}")));
    }
    parts.join("\n")
}

/// What the project's `file` says without its comments, indented, if it is here and fits a terminal.
fn short(file: &str) -> Option<String> {
    let text = read_text(&home(None).ok()?.join(file)).ok()?;
    let lines: Vec<String> =
        text.lines().filter(|line| !line.starts_with('#')).map(|line| format!("    {line}")).collect();
    let fits = lines.len() <= ROWS && lines.iter().all(|line| line.chars().count() <= COLUMNS);
    fits.then(|| lines.join("\n").replace("    \n", "\n").trim_end().to_owned())
}

fn key(field: &Field) -> String {
    let unit = field.unit.map_or_else(String::new, |unit| format!(" ({unit})"));
    let default = match &field.default {
        Default::Required => "; required".to_owned(),
        Default::Value(value) => format!("; {value} if left out"),
        Default::Absent => "; may be left out".to_owned(),
    };
    let mut lines =
        vec![wrapped(&format!("  {}: ", field.name), &format!("{}{unit}{default}", field.accepted), 6)];
    if !field.meaning.is_empty() {
        lines.push(wrapped("      ", &field.meaning, 6));
    }
    for (word, about) in &field.words {
        lines.push(wrapped(&format!("      \"{word}\": "), about, 10));
    }
    lines.join("\n")
}
