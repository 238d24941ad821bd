//! Why a refusal is no proof although the mathematics holds: it rests on a guess, or on a row that may sum up others.

use crate::checks::Test;
use crate::input::Input;
use crate::meaning::Kind;
use crate::table::{Quoted, Table};

/// What rows are called that sum up the others; what holds of one trial's row may not hold of them.
const SUMMARIES: [&str; 9] = ["all", "average", "averaged", "avg", "avg.", "mean", "overall", "sum", "total"];

/// Why what `test` refuses may be possible all the same, a sentence a reason.
pub(super) fn doubts(input: &Input, test: &dyn Test) -> Vec<String> {
    [guess(input, test), summary(input, test)].into_iter().flatten().collect()
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

/// Whether nothing that was guessed of a column counts: it holds numbers, of which rows or other columns say what they are.
fn is_plain(table: &Table, column: usize) -> bool {
    let meaning = &table.columns[column].meaning;
    let says_little = meaning.n.is_none() && meaning.grain.is_none();
    says_little && (table.statistics().is_some() || meaning.kind == Kind::Value)
}

/// That a number stands in a row that may be the average or the total of others.
fn summary(input: &Input, test: &dyn Test) -> Option<String> {
    let label = |number: &Quoted| {
        let [table, row, _] = number.cell?;
        let table = &input.tables[table];
        let is_summary = |name: &&str| SUMMARIES.contains(&name.to_lowercase().as_str());
        let labels =
            table.rows[row].iter().filter(|cell| cell.value.is_none()).map(|cell| cell.text.as_str());
        labels.filter(|_| table.statistics().is_none()).find(is_summary)
    };
    let name = test.numbers().iter().find_map(label)?;
    Some(format!("the row `{name}` is one like the others; it may sum them up, so that this is no proof"))
}
