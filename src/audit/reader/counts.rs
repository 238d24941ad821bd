//! Numbers of trials that stand in a column of their own: each must be one.

use crate::meaning::{Count, natural};
use crate::table::{Cell, Column, Fault, named_by};

/// Refuses rows in which a number is printed and its n is missing, 0, negative or not whole.
pub(super) fn check(columns: &[Column], rows: &[Vec<Cell>], faults: &mut Vec<Fault>) {
    for (at, column) in columns.iter().enumerate() {
        // A row without n is no fault of a guess.
        let Some(Count::Column(name)) = column.meaning.n.as_ref().filter(|_| column.written.is_some()) else {
            continue;
        };
        let Some(of) = named_by(columns, at, name) else { continue };
        for row in rows {
            let (Some(number), Some(n)) = (row.get(at), row.get(of)) else { continue };
            let is_count = natural(&n.text).is_some();
            if number.value.is_some() && !is_count {
                let found = if n.text.is_empty() { "missing".to_owned() } else { format!("`{}`", n.text) };
                let message = format!(
                    "column `{name}` is the n of column `{}`, and here it is {found}; a whole number from 1 to 1000000000 is accepted",
                    column.name
                );
                faults.push(Fault::new(n.place, message));
            }
        }
    }
}
