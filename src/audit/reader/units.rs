//! Units that stand in cells: one a column.

use super::{cells, unit_of};
use crate::meaning::Kind;
use crate::table::{Cell, Column, Fault, named_by};
use proofs::printed::Printed;

/// Refuses columns whose cells have other units than their header or each other, and sums of columns in different units:
/// such numbers do not compare.
pub(super) fn check(columns: &[Column], rows: &[Vec<Cell>], faults: &mut Vec<Fault>) {
    for (at, column) in columns.iter().enumerate() {
        if matches!(column.meaning.kind, Kind::Skip | Kind::Statistics) {
            continue;
        }
        let first = |at: usize| rows.iter().filter_map(|row| row.get(at)).find(|cell| cell.value.is_some());
        let unit = |at: usize, cell: &Cell| {
            let written = columns[at].meaning.unit.clone();
            written.unwrap_or_else(|| cells::unit(&cell.text).1.to_owned())
        };
        for name in &column.meaning.sum {
            let Some(part) = named_by(columns, at, name) else { continue };
            let (Some(total), Some(of)) = (first(at), first(part)) else { continue };
            let [own, other] = [unit(at, total), unit(part, of)];
            let is_written = columns[at].meaning.unit.is_some() || columns[part].meaning.unit.is_some();
            let is_half = is_written && (own.is_empty() || other.is_empty());
            if own != other && !is_half {
                let message = format!(
                    "column `{}`: `{}` is the sum of numbers such as `{}`, in {} and in {}; one unit is accepted in both",
                    column.name,
                    total.text,
                    of.text,
                    named(&own),
                    named(&other)
                );
                faults.push(Fault::new(total.place, message));
            }
        }
        in_cells(at, column, rows, faults);
        percents(at, column, rows, faults);
    }
}

/// Refuses columns that mix shares in per cent with shares of 1: `4.2%` above `0.042`.
fn percents(at: usize, column: &Column, rows: &[Vec<Cell>], faults: &mut Vec<Fault>) {
    let Kind::Share { whole } = column.meaning.kind else { return };
    let cells = || rows.iter().filter_map(|row| row.get(at).filter(|cell| cell.value.is_some()));
    let is_percent = |cell: &&Cell| cell.text.contains('%');
    let Some(percent) = cells().find(is_percent) else { return };
    let is_part = |cell: &&Cell| {
        let value = cell.value.map_or(0.0, Printed::value);
        !is_percent(cell) && value > 0.0 && value < 1.0
    };
    let wrong = if whole == 100 { cells().find(is_part) } else { Some(percent) };
    if let Some(cell) = wrong {
        let why = match whole {
            100 => format!(
                "has no % and is below 1, where `{}` is in per cent; write all in per cent",
                percent.text
            ),
            1 => "is in per cent, and the header says shares of 1; say `% of N`".to_owned(),
            _ => "is in per cent, and the header says counts; say `% of N`".to_owned(),
        };
        faults.push(Fault::new(cell.place, format!("column `{}`: `{}` {why}", column.name, cell.text)));
    }
}

/// Refuses cells whose unit is another than the header's, or than the first cell's.
fn in_cells(at: usize, column: &Column, rows: &[Vec<Cell>], faults: &mut Vec<Fault>) {
    let header = column.meaning.unit.clone().or_else(|| unit_of(&column.name));
    let header = header.as_deref();
    let mut first: Option<&str> = None;
    for cell in rows.iter().filter_map(|row| row.get(at).filter(|cell| cell.value.is_some())) {
        let is_percent = header.is_some_and(|header| !header.contains('%'))
            && cell.text.ends_with('%')
            && !cell.text.contains('±');
        let unit = if is_percent { "%" } else { cells::unit(&cell.text).1 };
        let (whose, expected) = match header {
            Some(header) if unit.is_empty() || unit == header => continue,
            Some(header) => ("its header", header),
            None => ("the first number", *first.get_or_insert(unit)),
        };
        if expected != unit {
            let message = format!(
                "column `{}`: `{}` has {}, and {whose} {}; one unit a column is accepted, best in its header",
                column.name,
                cell.text,
                named(unit),
                named(expected),
            );
            faults.push(Fault::new(cell.place, message));
        }
    }
}

fn named(unit: &str) -> String {
    if unit.is_empty() { "no unit".to_owned() } else { format!("the unit {unit}") }
}
