//! Tables as they are printed: cells as strings with their places, and the meaning of each column.

use super::meaning::{Kind, Meaning};
use base::text::visible;
use proofs::exact::Print;
use proofs::printed::Printed;
use std::fmt;

/// Where something stands in a text: the line, from 1, and the cell in it, from 1; cell 0 is the line itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    /// Line, from 1.
    pub line: usize,
    /// Cell in the line, from 1; 0 for the whole line.
    pub cell: usize,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.cell == 0 { write!(f, "{}", self.line) } else { write!(f, "{}:{}", self.line, self.cell) }
    }
}

/// Something in the input that cannot be read, with its place, what was found and what is accepted.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fault {
    /// Where.
    pub place: Place,
    /// What was found and what is accepted.
    pub message: String,
}

impl Fault {
    /// A fault at a place; characters that cannot be seen are named in its message.
    pub fn new(place: Place, message: impl Into<String>) -> Self {
        Self { place, message: visible(&message.into()).into_owned() }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.place, self.message)
    }
}

/// A cell as printed.
#[derive(Debug, Clone, PartialEq)]
pub struct Cell {
    /// Where it stands.
    pub place: Place,
    /// Its text, without marks of emphasis.
    pub text: String,
    /// Whether it is printed bold.
    pub is_bold: bool,
    /// The number before any `±` or bracket; none for text and for what is missing.
    pub value: Option<Printed>,
    /// The number after `±` or in brackets.
    pub spread: Option<Printed>,
    /// The k of n that it is printed as: `29/30`.
    pub k_of_n: Option<[u64; 2]>,
}

/// A column with its meaning, written or guessed.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Its name, without the annotation.
    pub name: String,
    /// What it is.
    pub meaning: Meaning,
    /// The annotation that says so; `None` if it was guessed.
    pub written: Option<String>,
    /// The annotation that was written or guessed.
    pub annotation: String,
}

/// A table with what its header says of its columns.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// Its name: the heading above it, or what the TOML calls it; may be empty.
    pub name: String,
    /// The line of its header.
    pub line: usize,
    /// What divides the cells of a line: a bar, a comma, a semicolon, a tab.
    pub mark: char,
    /// Its columns from the left.
    pub columns: Vec<Column>,
    /// Its rows, each with as many cells as there are columns.
    pub rows: Vec<Vec<Cell>>,
}

impl Table {
    /// The number in a cell with the reading of its digits; `None` if the cell holds none.
    pub fn print(&self, row: usize, column: usize) -> Option<Print> {
        let value = self.rows.get(row)?.get(column)?.value?;
        Some(Print { printed: value, digits: self.columns[column].meaning.digits })
    }

    /// The name of a row: its first cell that is no number, with the statistic that it holds, or its number.
    pub fn row_name(&self, row: usize) -> String {
        let cells = self.rows.get(row).map_or(&[][..], Vec::as_slice);
        let text = cells.iter().position(|cell| cell.value.is_none() && !cell.text.is_empty());
        let Some(text) = text else { return format!("row {}", row + 1) };
        let statistic = self.statistics().filter(|at| *at != text).and_then(|at| cells.get(at));
        let name = cells[text].text.clone();
        statistic.map_or(name.clone(), |statistic| format!("{name} {}", statistic.text))
    }

    /// The column that names each row's statistic.
    pub fn statistics(&self) -> Option<usize> {
        self.columns.iter().position(|column| column.meaning.kind == Kind::Statistics)
    }

    /// What a column is called, with its statistic where another column has the same name.
    pub fn column_name(&self, column: usize) -> String {
        let Column { name, meaning, .. } = &self.columns[column];
        let is_twin = |(at, other): (usize, &Column)| at != column && other.name == *name;
        match meaning.kind {
            Kind::Statistic(statistic) if self.columns.iter().enumerate().any(is_twin) => {
                format!("{} of {name}", statistic.name())
            }
            _ => name.clone(),
        }
    }

    /// The places of all columns called `name`, from 0.
    pub fn columns_named<'a>(&'a self, name: &'a str) -> impl Iterator<Item = usize> + 'a {
        (0..self.columns.len()).filter(move |at| self.columns[*at].name == name)
    }
}

/// The column that the annotation of the column `by` names: the only one of that name, or of them the only one of the same kind.
/// None if there is none, or if it may be one of two.
pub fn named_by(columns: &[Column], by: usize, name: &str) -> Option<usize> {
    let only = |found: Vec<usize>| (found.len() == 1).then(|| found[0]);
    let all: Vec<usize> = (0..columns.len()).filter(|at| columns[*at].name == name).collect();
    let is_alike = |at: &usize| columns[*at].meaning.kind == columns[by].meaning.kind;
    only(all.clone()).or_else(|| only(all.into_iter().filter(is_alike).collect()))
}

/// A printed number with its name and place.
#[derive(Debug, Clone, PartialEq)]
pub struct Quoted {
    /// What it is called in findings: `success of RRT`.
    pub name: String,
    /// Where it stands.
    pub place: Place,
    /// Its digits.
    pub print: Print,
    /// Its table, row and column, where it has some.
    pub cell: Option<[usize; 3]>,
}

/// The number in a cell with its name.
pub fn quoted(index: usize, table: &Table, row: usize, column: usize) -> Option<Quoted> {
    let print = table.print(row, column)?;
    let of = if table.name.is_empty() { String::new() } else { format!("{}: ", table.name) };
    let name = format!("{of}{} of {}", table.column_name(column), table.row_name(row));
    Some(Quoted { name, place: table.rows[row][column].place, print, cell: Some([index, row, column]) })
}
