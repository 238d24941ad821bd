//! Reads tables and relations: CSV, Markdown, TOML.
//!
//! Nothing here judges. What cannot be read is a [`Fault`] with its place; all faults of a text are given together. Cells
//! stay strings, since trailing zeros count.

mod cells;
mod counts;
mod csv;
mod guess;
mod markdown;
mod toml;
mod units;

pub use cells::{Number, number, unit};

use super::input::Input;
use super::meaning::{Kind, Meaning};
use super::printed::Printed;
use super::statistic::Statistic;
use super::table::{Cell, Column, Fault, Place, Table};

/// How a text is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Comma-, semicolon- or tab-separated values with one header line.
    Csv,
    /// Markdown: every pipe table in the text.
    Markdown,
    /// TOML: tables, cells, samples and relations.
    Toml,
}

impl Format {
    /// The format that a file's ending names.
    pub fn of_ending(ending: &str) -> Option<Self> {
        match ending.to_lowercase().as_str() {
            "csv" | "tsv" => Some(Self::Csv),
            "md" | "markdown" => Some(Self::Markdown),
            "toml" => Some(Self::Toml),
            _ => None,
        }
    }

    /// The format that a text looks like.
    pub fn of_text(text: &str) -> Self {
        if text.lines().any(markdown::is_rule) {
            return Self::Markdown;
        }
        let is_toml = |line: &str| {
            let line = line.trim();
            let key = line.split_once('=').map(|(key, _)| key.trim());
            line.starts_with('[') && line.ends_with(']')
                || key.is_some_and(|key| {
                    !key.is_empty() && key.chars().all(|c| c.is_alphanumeric() || "_-\"".contains(c))
                })
        };
        let first = text.lines().find(|line| !line.trim().is_empty() && !line.trim_start().starts_with('#'));
        if first.is_some_and(is_toml) { Self::Toml } else { Self::Csv }
    }
}

/// A table before its cells are read: where its lines stand, and texts.
struct Raw {
    name: String,
    line: usize,
    /// What divides the cells of a line.
    mark: char,
    header: Vec<String>,
    rows: Vec<(usize, Vec<String>)>,
}

/// The most faults that are told.
const FAULTS: usize = 50;

/// Reads a text.
///
/// # Errors
/// Every fault found, 50 at most.
pub fn read(text: &str, format: Format) -> Result<Input, Vec<Fault>> {
    let mut faults = Vec::new();
    let input = match format {
        Format::Csv => csv::raw(text, &mut faults).map(|raw| Input::of_tables(tables([raw], &mut faults))),
        Format::Markdown => Some(Input::of_tables(tables(markdown::raw(text, 1, &mut faults), &mut faults))),
        Format::Toml => toml::read(text, &mut faults),
    };
    let is_empty = input.as_ref().is_none_or(Input::is_empty);
    if faults.is_empty() && is_empty {
        let message = "there is no table here; a CSV with a header line, a Markdown table with a line |---|---| below its \
                       header, or TOML with [[table]], [[sample]] or [[relation]] is accepted";
        faults.push(Fault::new(Place { line: 1, cell: 0 }, message));
    }
    faults.truncate(FAULTS);
    match input {
        Some(input) if faults.is_empty() => Ok(input),
        _ => Err(faults),
    }
}

fn tables(raws: impl IntoIterator<Item = Raw>, faults: &mut Vec<Fault>) -> Vec<Table> {
    raws.into_iter().filter_map(|raw| table(raw, faults)).collect()
}

/// Reads a table's header and cells.
fn table(raw: Raw, faults: &mut Vec<Fault>) -> Option<Table> {
    let mut columns = Vec::new();
    for (index, header) in raw.header.iter().enumerate() {
        let place = Place { line: raw.line, cell: index + 1 };
        match column(&raw, index, header) {
            Ok(column) => columns.push(column),
            Err(message) => faults.push(Fault::new(place, message)),
        }
    }
    if columns.len() != raw.header.len() {
        return None;
    }
    check_references(&columns, raw.line, faults);
    let mut rows = Vec::with_capacity(raw.rows.len());
    for (line, texts) in raw.rows {
        let cells = texts.iter().zip(&columns).enumerate().filter_map(|(index, (text, column))| {
            let place = Place { line, cell: index + 1 };
            match cell(text, column, place) {
                Ok(cell) => Some(cell),
                Err(message) => {
                    if faults.len() < FAULTS {
                        faults.push(Fault::new(place, format!("column `{}`: {message}", column.name)));
                    }
                    None
                }
            }
        });
        rows.push(cells.collect());
    }
    if faults.is_empty() {
        counts::check(&columns, &rows, faults);
        units::check(&columns, &rows, faults);
    }
    Some(Table { name: raw.name, line: raw.line, mark: raw.mark, columns, rows })
}

/// The column that a header cell describes; guessed if it has no annotation.
fn column(raw: &Raw, index: usize, header: &str) -> Result<Column, String> {
    let plain = cells::plain(header).0;
    if let Some((name, annotation)) = plain.strip_suffix(']').and_then(|text| text.rsplit_once('[')) {
        let meaning = Meaning::parse(annotation)?;
        let written = Some(annotation.trim().to_owned());
        return Ok(Column { name: name.trim().to_owned(), meaning, written });
    }
    let texts = raw.rows.iter().filter_map(|(_, texts)| texts.get(index).map(String::as_str));
    let annotation = guess::annotation(&plain, &texts.take(1000).collect::<Vec<_>>());
    let meaning = Meaning::parse(&annotation).unwrap_or_default();
    Ok(Column { name: plain.trim().to_owned(), meaning, written: None })
}

/// Every column that an annotation names must be there.
fn check_references(columns: &[Column], line: usize, faults: &mut Vec<Fault>) {
    let names: Vec<&str> = columns.iter().map(|column| column.name.as_str()).collect();
    for (index, column) in columns.iter().enumerate() {
        for name in column.meaning.named_columns() {
            if !names.contains(&name) {
                let message = format!(
                    "column `{}` names the column `{name}`; there are: {}",
                    column.name,
                    names.join(", ")
                );
                faults.push(Fault::new(Place { line, cell: index + 1 }, message));
            }
        }
    }
}

/// Reads a cell by what its column is.
fn cell(text: &str, column: &Column, place: Place) -> Result<Cell, String> {
    let (plain, is_bold) = cells::plain(text);
    let mut cell = Cell { place, text: plain, is_bold, value: None, spread: None };
    if matches!(column.meaning.kind, Kind::Skip | Kind::Statistics) {
        return Ok(cell);
    }
    match cells::number(&cell.text)? {
        Number::Missing => {}
        Number::Plain { value, spread } => {
            let widened = |value| widened(value, column.meaning.significant);
            (cell.value, cell.spread) = (Some(widened(value)?), spread.map(widened).transpose()?);
        }
    }
    Ok(cell)
}

/// The number with the zeros at its end that `digits=D` says were left out.
fn widened(value: Printed, significant: Option<u32>) -> Result<Printed, String> {
    let Some(significant) = significant else { return Ok(value) };
    value.with_zeros_left_out(significant).ok_or_else(|| {
        format!(
            "`{value}` contradicts digits={significant}, by which a number has {significant} digits at most and no zero at \
             the end of its decimals; leave digits={significant} out"
        )
    })
}

/// The header line of [`stub`], divided as the table's own.
pub fn stub_line(table: &Table) -> String {
    let cells = stub(table);
    if table.mark == '|' {
        return format!("| {} |", cells.join(" | "));
    }
    let quoted = |cell: &String| match cell.split('[').next() {
        Some(name) if name.contains([table.mark, '"']) => format!("\"{}\"", cell.replace('"', "")),
        _ if table.mark != ',' && cell.contains(table.mark) => format!("\"{cell}\""),
        _ => cell.clone(),
    };
    cells.iter().map(quoted).collect::<Vec<_>>().join(&table.mark.to_string())
}

/// A header line with an annotation for every column, to be corrected: what was written, or what was guessed.
pub fn stub(table: &Table) -> Vec<String> {
    let names = |column: &Column| column.name.clone();
    let texts: Vec<String> = table.columns.iter().map(names).collect();
    let column_texts = |index: usize| {
        table.rows.iter().take(1000).filter_map(move |row| row.get(index).map(|cell| cell.text.as_str()))
    };
    let header = texts.iter().enumerate().map(|(index, name)| {
        let guessed = || guess::annotation(name, &column_texts(index).collect::<Vec<_>>());
        let annotation = table.columns[index].written.clone().unwrap_or_else(guessed);
        format!("{name} [{annotation}]").trim_start().to_owned()
    });
    header.collect()
}

/// Whether the texts of a column name statistics: `mean`, `std`, `25%`.
fn are_statistics(texts: &[&str]) -> bool {
    let named = texts.iter().filter(|text| Statistic::named(&cells::plain(text).0).is_some()).count();
    named >= 3 && 2 * named > texts.len()
}
