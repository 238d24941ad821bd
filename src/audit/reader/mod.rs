//! Reads tables and relations: CSV, Markdown, LaTeX, TOML.
//!
//! Nothing here judges. What cannot be read is a [`Fault`] with its place; all faults of a text are given together. Cells
//! stay strings, since trailing zeros count.

pub mod cells;
mod counts;
mod csv;
mod guess;
mod latex;
mod markdown;
mod toml;
mod units;

pub use cells::{Number, number, unit};
pub use guess::are_multiples;

use super::input::Input;
use super::meaning::{Count, Kind, Meaning, contradiction};
use super::sample::groups;
use super::statistic::Statistic;
use super::table::{Cell, Column, Fault, Place, Table, named_by};
use proofs::printed::Printed;

/// How a text is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Comma-, semicolon- or tab-separated values with one header line.
    Csv,
    /// Markdown: every pipe table in the text.
    Markdown,
    /// LaTeX: every tabular in the text.
    Latex,
    /// TOML: tables, cells, samples and relations.
    Toml,
}

impl Format {
    /// The format that a file's ending names.
    pub fn of_ending(ending: &str) -> Option<Self> {
        match ending.to_lowercase().as_str() {
            "csv" | "tsv" => Some(Self::Csv),
            "md" | "markdown" => Some(Self::Markdown),
            "tex" | "latex" => Some(Self::Latex),
            "toml" => Some(Self::Toml),
            _ => None,
        }
    }

    /// The format that a text looks like.
    pub fn of_text(text: &str) -> Self {
        if latex::is_latex(text) {
            return Self::Latex;
        }
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

/// Faults of one file that are reported one by one, at most.
const FAULTS: usize = 50;

/// Reads a text.
///
/// # Errors
/// Every fault found up to 50, and how many more there are.
pub fn read(text: &str, format: Format) -> Result<Input, Vec<Fault>> {
    let mut faults = Vec::new();
    let input = match format {
        Format::Csv => csv::raw(text, &mut faults).map(|raw| Input::of_tables(tables([raw], &mut faults))),
        Format::Markdown => Some(Input::of_tables(tables(markdown::raw(text, 1, &mut faults), &mut faults))),
        Format::Latex => Some(Input::of_tables(tables(latex::raw(text, &mut faults), &mut faults))),
        Format::Toml => toml::read(text, &mut faults),
    };
    let is_empty = input.as_ref().is_none_or(Input::is_empty);
    if faults.is_empty() && is_empty {
        let message = "there is no table here; a CSV with a header line, a Markdown table with a line |---|---| below its \
                       header, a tabular of LaTeX, or TOML with [[table]], [[sample]] or [[relation]] is accepted";
        faults.push(Fault::new(Place { line: 1, cell: 0 }, message));
    }
    if let Some(Fault { place, .. }) = faults.get(FAULTS) {
        let more = Fault::new(*place, format!("{} more faults like these", faults.len() - FAULTS));
        faults.truncate(FAULTS);
        faults.push(more);
    }
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
    guess::join(&mut columns);
    guess::take_n(&mut columns, &raw.rows);
    check_references(&columns, raw.line, faults);
    check_groups(&columns, raw.line, faults);
    let mut rows = Vec::with_capacity(raw.rows.len());
    for (line, texts) in raw.rows {
        let cells = texts.iter().zip(&columns).enumerate().filter_map(|(index, (text, column))| {
            let place = Place { line, cell: index + 1 };
            match cell(text, column, place) {
                Ok(cell) => Some(cell),
                Err(message) => {
                    faults.push(Fault::new(place, format!("column `{}`: {message}", column.name)));
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

/// The column that a header cell describes; guessed if it has no annotation. A unit in brackets is none. An arrow may stand
/// behind both.
fn column(raw: &Raw, index: usize, header: &str) -> Result<Column, String> {
    let plain = cells::plain(header).0;
    let (text, arrow) = without_arrow(plain.trim());
    let named = |name: &str| format!("{} {arrow}", name.trim()).trim().to_owned();
    let mut name = named(text);
    let mut unit = "";
    if let Some((before, annotation)) = text.strip_suffix(']').and_then(|text| text.rsplit_once('[')) {
        let annotation = annotation.trim();
        match Meaning::parse(annotation) {
            Ok(mut meaning) => {
                let annotation = annotation.to_owned();
                meaning.unit = meaning.unit.or_else(|| unit_of(before.trim()));
                meaning.better = meaning.better.or_else(|| guess::better_by_arrow(arrow));
                return Ok(Column {
                    name: named(before),
                    meaning,
                    written: Some(annotation.clone()),
                    annotation,
                });
            }
            Err(_) if cells::is_unit(annotation) => (name, unit) = (named(before), annotation),
            Err(message) => return Err(message),
        }
    }
    let texts = raw.rows.iter().filter_map(|(_, texts)| texts.get(index).map(String::as_str));
    let annotation = guess::annotation(&name, unit, &texts.take(1000).collect::<Vec<_>>());
    let meaning = Meaning::parse(&annotation).unwrap_or_default();
    Ok(Column { name, meaning, written: None, annotation })
}

/// A header without the arrow that says which way is better, and the arrow.
fn without_arrow(header: &str) -> (&str, &str) {
    let arrows = ["$\\downarrow$", "$\\uparrow$", "\\downarrow", "\\uparrow", "↓", "↑"];
    let found = arrows.into_iter().find_map(|arrow| Some((header.strip_suffix(arrow)?.trim_end(), arrow)));
    found.filter(|(name, _)| !name.is_empty()).unwrap_or((header, ""))
}

/// The unit that a name ends in: `time (ms)`. The word `min` may be the least value.
fn unit_of(name: &str) -> Option<String> {
    let unit = name.strip_suffix(')')?.rsplit_once('(')?.1.trim();
    (cells::is_unit(unit) && Statistic::named(unit).is_none()).then(|| unit.to_owned())
}

/// Columns of the same values, or parts of one whole, must not contradict each other.
fn check_groups(columns: &[Column], line: usize, faults: &mut Vec<Fault>) {
    let of_group = groups(columns).into_iter().flat_map(|group| {
        let all: Vec<usize> = group.columns.iter().map(|(at, _)| *at).collect();
        (1..=all.len()).map(move |end| all[..end].to_vec())
    });
    let parts = |at: &usize| columns[*at].meaning.parts.clone();
    let with_parts = (0..columns.len()).filter(|at| parts(at).is_some());
    let of_whole = with_parts.map(|at| (0..=at).filter(|other| parts(other) == parts(&at)).collect());
    let together: Vec<(&str, Vec<usize>)> = of_group
        .map(|all| ("statistics of the same values; another `of=NAME` is accepted where they are not", all))
        .chain(
            of_whole
                .map(|all| ("parts of one whole; another `parts=NAME` is accepted where they are not", all)),
        )
        .collect();
    for (are, group) in together {
        let Some((at, before)) = group.split_last() else { continue };
        let contrary = before.iter().find_map(|before| {
            let what = contradiction::of_values(&columns[*before].meaning, &columns[*at].meaning)?;
            Some((before, what))
        });
        if let Some((before, what)) = contrary {
            let [first, second] =
                [before, at].map(|at| format!("{} [{}]", columns[*at].name, columns[*at].annotation));
            let message = format!(
                "`{first}` and `{second}` contradict each other: both say {what}, and they are {are}"
            );
            faults.push(Fault::new(Place { line, cell: at + 1 }, message));
        }
    }
}

/// Every column that an annotation names must be there, be one alone, and be another one.
fn check_references(columns: &[Column], line: usize, faults: &mut Vec<Fault>) {
    let names: Vec<&str> = columns.iter().map(|column| column.name.as_str()).collect();
    for (index, column) in columns.iter().enumerate() {
        for name in column.meaning.named_columns() {
            let why = if !names.contains(&name) {
                format!("names the column `{name}`; there are: {}", names.join(", "))
            } else if named_by(columns, index, name) == Some(index) {
                "names itself; another column is accepted".to_owned()
            } else if named_by(columns, index, name).is_none() {
                let count = names.iter().filter(|other| **other == name).count();
                format!(
                    "names the column `{name}`, which stands {count} times; a name that stands once is accepted"
                )
            } else {
                continue;
            };
            let message = format!("column `{}` {why}", column.name);
            faults.push(Fault::new(Place { line, cell: index + 1 }, message));
        }
    }
}

/// Reads a cell as its column's kind demands.
fn cell(text: &str, column: &Column, place: Place) -> Result<Cell, String> {
    let (plain, is_bold) = cells::plain(text);
    let mut cell = Cell { place, text: plain, is_bold, value: None, spread: None, k_of_n: None };
    if matches!(column.meaning.kind, Kind::Skip | Kind::Statistics) {
        return Ok(cell);
    }
    match cells::number(&cell.text)? {
        Number::Missing => {}
        Number::Plain { value, spread } => {
            let widened = |value| widened(value, column.meaning.significant);
            (cell.value, cell.spread) = (Some(widened(value)?), spread.map(widened).transpose()?);
        }
        Number::Fraction { k_of_n, percent } => {
            cell.value =
                of_fraction(k_of_n, percent, column).map_err(|why| format!("`{}` {why}", cell.text))?;
            cell.k_of_n = Some(k_of_n);
        }
    }
    Ok(cell)
}

/// The number that a fraction prints in its column: the count where counts are printed, else the percentage beside it.
fn of_fraction(
    k_of_n: [u64; 2],
    percent: Option<Printed>,
    column: &Column,
) -> Result<Option<Printed>, String> {
    let [k, n] = k_of_n;
    match (&column.meaning.n, &column.meaning.kind) {
        (_, Kind::Share { whole: 0 }) if percent.is_some() => {
            Err(format!("is a count and a percentage; say `% of {n}` in the header"))
        }
        (Some(Count::Number(header_n)), Kind::Share { .. }) if *header_n != n => {
            Err(format!("is of {n}, and the header says of {header_n}; one of both is accepted"))
        }
        (_, Kind::Share { whole: 0 }) => Ok(k.to_string().parse().ok()),
        (_, Kind::Share { .. }) => Ok(percent),
        _ => Err(format!(
            "is {k} of {n}; say `count of {n}` in the header, or `% of {n}` where a percentage stands beside it"
        )),
    }
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

/// A header line with an annotation for every column, as written or as guessed, for the author to correct.
pub fn stub(table: &Table) -> Vec<String> {
    let header =
        |Column { name, annotation, .. }: &Column| format!("{name} [{annotation}]").trim_start().to_owned();
    table.columns.iter().map(header).collect()
}

/// Whether the texts of a column name statistics: `mean`, `std`, `25%`. Queries may be called `q1`, `q2`, and shares are printed as
/// `75%`, so that one word of another kind is needed.
fn are_statistics(texts: &[&str]) -> bool {
    let named = |text: &&&str| Statistic::named(&cells::plain(text).0).is_some();
    let count = texts.iter().filter(named).count();
    let is_word = |c: char| c.is_alphabetic() && c != 'q';
    let has_word =
        texts.iter().filter(named).any(|text| cells::plain(text).0.to_lowercase().starts_with(is_word));
    count >= 3 && 2 * count > texts.len() && has_word
}
