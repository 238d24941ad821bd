//! The columns of a table, and those that it does not print: by how much one column exceeds another.

use super::table_spec::{ColumnSpec, RowSpec, TableSpec};
use base::settings::{Document, Faults, Spanned, none_called};

/// What stands in a cell for which the paper prints no number.
pub(super) const NOT_PRINTED: &str = "N/A";

/// A cell of a column that is a difference: the number, the place of the column that it is taken from, and the ids of both claims.
pub(super) struct Difference {
    pub(super) printed: Spanned<String>,
    pub(super) at: usize,
    pub(super) between: [String; 2],
}

/// The columns that a table prints, each with the number of its entry and its id.
pub(super) fn columns(table: &TableSpec) -> impl Iterator<Item = (&ColumnSpec, usize, &str)> {
    let entries = table.columns.iter().enumerate().filter(|(_, column)| column.difference.is_none());
    entries
        .flat_map(|(number, column)| column.id.listed().iter().map(move |id| (column, number, id.as_str())))
}

/// The columns of a table that are differences, each with the number of its entry and its id.
pub(super) fn differences(table: &TableSpec) -> impl Iterator<Item = (&ColumnSpec, usize, &str)> {
    let entries = table.columns.iter().enumerate().filter(|(_, column)| column.difference.is_some());
    entries
        .flat_map(|(number, column)| column.id.listed().iter().map(move |id| (column, number, id.as_str())))
}

impl TableSpec {
    pub(super) fn prefix(&self) -> &str {
        self.claims.as_ref().unwrap_or(&self.id)
    }

    pub(super) fn cell_id(&self, row: &RowSpec, column: &str) -> String {
        let own = row.cell.get(column).and_then(|cell| cell.id.clone());
        own.unwrap_or_else(|| format!("{}.{}.{column}", self.prefix(), row.id))
    }

    /// Whether what is `printed` in a row and the column called `id` is a claim.
    pub(super) fn is_claim(
        &self,
        row: &RowSpec,
        (column, id): (&ColumnSpec, &str),
        printed: &Spanned<String>,
    ) -> bool {
        let is_repeated = row.cell.get(id).is_some_and(|cell| cell.same_as.is_some());
        self.none.is_none() && column.none.is_none() && !is_repeated && printed.get_ref() != NOT_PRINTED
    }

    /// What stands in a row of the column `column`; `None` where one of its two numbers is not printed or is no testable claim.
    pub(super) fn difference(&self, row: &RowSpec, column: &ColumnSpec) -> Option<Difference> {
        let spoilt = [&self.untestable, &row.untestable, &column.untestable];
        if spoilt.into_iter().any(Option::is_some) {
            return None;
        }
        let [above, below] = column.difference.as_ref()?;
        let cell = |wanted: &Spanned<String>| {
            let cells = row.printed.iter().zip(columns(self)).enumerate();
            let mut own = cells.filter(|(_, (printed, (column, _, id)))| {
                id == wanted.get_ref()
                    && self.is_claim(row, (column, id), printed)
                    && column.untestable.is_none()
            });
            own.next().map(|(at, (printed, (.., id)))| (at, printed, self.cell_id(row, id)))
        };
        let ((at, one, first), (_, other, second)) = cell(above).zip(cell(below))?;
        let printed = one.with(subtracted(one.get_ref(), other.get_ref())?);
        Some(Difference { printed, at, between: [first, second] })
    }

    /// Both columns of a difference are columns that the paper prints.
    pub(super) fn check_differences(&self, document: &Document, number: usize, faults: &mut Faults) {
        let known: Vec<&str> = columns(self).map(|(.., id)| id).collect();
        for (column, entry, _) in differences(self) {
            for id in column.difference.iter().flatten() {
                if !known.contains(&id.get_ref().as_str()) {
                    let message = none_called("column", id.get_ref(), known.iter().copied());
                    let message = format!("table `{}`: {message}", self.id);
                    let error = document.error(id.span(), message);
                    faults.add(error.about(&format!("table.{number}.column.{entry}")));
                }
            }
        }
    }
}

/// The difference of two printed numbers, to the digits of the longer one; `None` of texts that are no numbers.
fn subtracted(one: &str, other: &str) -> Option<String> {
    let decimals = |text: &str| text.split_once('.').map_or(0, |(_, after)| after.len());
    let most = decimals(one).max(decimals(other));
    let units = |text: &str| -> Option<i128> {
        let (whole, after) = text.split_once('.').unwrap_or((text, ""));
        format!("{whole}{after:0<most$}").parse().ok()
    };
    let difference = units(one)?.checked_sub(units(other)?)?;
    let digits = format!("{:0>width$}", difference.unsigned_abs(), width = most + 1);
    let (whole, after) = digits.split_at(digits.len() - most);
    let sign = if difference < 0 { "-" } else { "" };
    Some(if most == 0 { format!("{sign}{whole}") } else { format!("{sign}{whole}.{after}") })
}

#[cfg(test)]
mod tests {
    use super::subtracted;

    #[test]
    fn printed_numbers_are_subtracted_digit_by_digit() {
        for (one, other, difference) in [
            ("114.71", "113.94", "0.77"),
            ("113.94", "114.71", "-0.77"),
            ("12", "3.5", "8.5"),
            ("-1.20", "-1.2", "0.00"),
            ("0.05", "1", "-0.95"),
            ("99", "100", "-1"),
        ] {
            assert_eq!(subtracted(one, other).as_deref(), Some(difference), "{one} less {other}");
        }
        assert_eq!(subtracted("N/A", "1"), None);
    }
}
