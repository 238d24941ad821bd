//! Units that stand in cells: one a column.

use super::FAULTS;
use super::cells;
use crate::meaning::Kind;
use crate::table::{Cell, Column, Fault};

/// Refuses columns of which cells have different units, and sums of columns in different units: such numbers do not compare.
pub(super) fn check(columns: &[Column], rows: &[Vec<Cell>], faults: &mut Vec<Fault>) {
    for (at, column) in columns.iter().enumerate() {
        if matches!(column.meaning.kind, Kind::Skip | Kind::Statistics) {
            continue;
        }
        let own = |at: usize| rows.iter().filter_map(|row| row.get(at)).find(|cell| cell.value.is_some());
        for name in &column.meaning.sum {
            let part = columns.iter().position(|column| column.name == *name).and_then(own);
            let (Some(total), Some(part)) = (own(at), part) else { continue };
            if cells::unit(&total.text).1 != cells::unit(&part.text).1 {
                let message = format!(
                    "column `{}`: `{}` is the sum of numbers such as `{}`; one unit is accepted in both",
                    column.name, total.text, part.text
                );
                faults.push(Fault::new(total.place, message));
            }
        }
        let cells = rows.iter().filter_map(|row| row.get(at).filter(|cell| cell.value.is_some()));
        let mut first: Option<&str> = None;
        for cell in cells {
            let unit = cells::unit(&cell.text).1;
            if *first.get_or_insert(unit) != unit && faults.len() < FAULTS {
                let named = |unit: &str| {
                    if unit.is_empty() { "no unit".to_owned() } else { format!("the unit {unit}") }
                };
                let message = format!(
                    "column `{}`: `{}` has {}, and the first number {}; one unit a column is accepted, best in its header",
                    column.name,
                    cell.text,
                    named(unit),
                    named(first.unwrap_or_default()),
                );
                faults.push(Fault::new(cell.place, message));
            }
        }
    }
}
