//! Why a refusal is no proof although the mathematics holds: it rests on a guess, or on a row that may sum up others.

use crate::checks::{Test, summary};
use crate::input::Input;
use crate::meaning::Kind;
use crate::table::{Quoted, Table};

/// Why what `test` refuses may be possible all the same, a sentence a reason.
pub(super) fn doubts(input: &Input, test: &dyn Test) -> Vec<String> {
    let of_summary = if test.is_about_summaries() { None } else { in_summary(input, test) };
    [guess(input, test), of_summary].into_iter().flatten().collect()
}

/// Whether a test is about the summary of others, which is what it should be: then what holds of one row need not hold of it.
pub(super) fn is_of_true_summary(input: &Input, test: &dyn Test) -> bool {
    let mut cells = test.numbers().iter().filter_map(|number| number.cell);
    !test.is_about_summaries() && cells.any(|cell| summary::is_true(input, cell))
}

/// That a test rests on what was guessed of a column.
fn guess(input: &Input, test: &dyn Test) -> Option<String> {
    let guessed = |number: &Quoted| {
        let [table, _, column] = number.cell?;
        let table = &input.tables[table];
        let is_guessed = |at: &usize| table.columns[*at].written.is_none();
        let own = Some(column).filter(|at| is_guessed(at) && !is_plain(table, *at));
        own.or_else(|| table.statistics().filter(is_guessed)).map(|at| &table.columns[at])
    };
    let column = test.numbers().iter().find_map(guessed)?;
    Some(format!(
        "that `{}` is `{}` was guessed, so that this is no proof: correct the header",
        column.name, column.annotation
    ))
}

/// Whether a column's guessed meaning cannot matter: it holds numbers whose meaning its rows or other columns give.
fn is_plain(table: &Table, column: usize) -> bool {
    let meaning = &table.columns[column].meaning;
    let says_little = meaning.n.is_none() && meaning.grain.is_none();
    says_little && (table.statistics().is_some() || meaning.kind == Kind::Value)
}

/// That a number stands in a row that may be the average or the total of others.
fn in_summary(input: &Input, test: &dyn Test) -> Option<String> {
    let label = |number: &Quoted| {
        let [table, row, _] = number.cell?;
        let table = &input.tables[table];
        let is_all = |at: &usize| {
            table.rows[row][*at].text.eq_ignore_ascii_case("all") && table.statistics().is_none()
        };
        let at = summary::label(table, row).or_else(|| (0..table.columns.len()).find(is_all))?;
        Some(&table.rows[row][at].text)
    };
    let name = test.numbers().iter().find_map(label)?;
    Some(format!("the row `{name}` is one like the others; it may sum them up, so that this is no proof"))
}
