//! What no check looked at, so that silence is no pass; and what rests on a guess, so that it is no proof.

use crate::checks::Test;
use crate::input::Input;
use crate::meaning::{Kind, Meaning};
use crate::statistic::Statistic;
use crate::table::{Place, Quoted, Table};
use std::collections::BTreeSet;

/// A column, or a sample of a TOML file, that no check looked at.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unseen {
    /// Where it starts.
    pub place: Place,
    /// What it is called.
    pub name: String,
    /// What to write so that a check looks.
    pub advice: String,
}

/// What tests have looked at.
#[derive(Default)]
pub(super) struct Seen {
    /// Tables and columns.
    columns: BTreeSet<[usize; 2]>,
    /// Numbers that stand in no table.
    names: BTreeSet<(Place, String)>,
}

impl Seen {
    /// Notes the numbers of a test.
    pub(super) fn take(&mut self, test: &dyn Test) {
        for Quoted { name, place, cell, .. } in test.numbers() {
            match cell {
                Some([table, _, column]) => drop(self.columns.insert([*table, *column])),
                None => drop(self.names.insert((*place, name.clone()))),
            }
        }
    }

    /// Everything with a number that no test was about.
    pub(super) fn others(&self, input: &Input) -> Vec<Unseen> {
        let mut all = Vec::new();
        for (index, table) in input.tables.iter().enumerate() {
            let columns = (0..table.columns.len()).filter(|at| !self.columns.contains(&[index, *at]));
            all.extend(columns.filter_map(|at| of_column(table, at)));
        }
        for sample in &input.samples {
            let is_seen = sample
                .numbers
                .iter()
                .any(|(_, number)| self.names.contains(&(number.place, number.name.clone())));
            if let (false, Some((_, first))) = (is_seen, sample.numbers.first()) {
                let advice = "say n, the grain of its values, or more of its statistics".to_owned();
                all.push(Unseen { place: first.place, name: format!("sample `{}`", sample.name), advice });
            }
        }
        all
    }
}

fn of_column(table: &Table, at: usize) -> Option<Unseen> {
    let column = &table.columns[at];
    let is_named = |other: &Meaning| other.named_columns().contains(&column.name.as_str());
    if table.columns.iter().any(|other| is_named(&other.meaning)) {
        return None;
    }
    let cell = table.rows.iter().filter_map(|row| row.get(at)).find(|cell| cell.value.is_some())?;
    let has_statistics = table.statistics().is_some();
    let advice = match &column.meaning.kind {
        Kind::Skip | Kind::Statistics => return None,
        _ if has_statistics => "say `n=N`, `integers` or `tick=Q`, or add rows of other statistics",
        Kind::Share { .. } => "say of how many, as `% of 250`",
        Kind::Of(Statistic::Mean) => {
            "alone a mean may be anything; say `n=N` with `integers` or `tick=Q`, or `of=NAME` here and at its deviation or ends"
        }
        Kind::Of(_) => "say `of=NAME` here and at the other statistics of the same values",
        Kind::Samples => "no column `rises` with it",
        Kind::Value => "say what it is, as `mean`, `% of N`, `a+b√2`, or `skip` (`--list` has all)",
    };
    Some(Unseen { place: cell.place, name: format!("column `{}`", column.name), advice: advice.to_owned() })
}

/// That a test rests on what was guessed of a column, in words. Where rows name statistics, that alone is no guess.
pub(super) fn rests_on_a_guess(input: &Input, test: &dyn Test) -> Option<String> {
    let guessed = |number: &Quoted| {
        let [table, _, column] = number.cell?;
        let table = &input.tables[table];
        let column = &table.columns[column];
        let says_little = column.meaning.n.is_none() && column.meaning.grain.is_none();
        let is_plain = says_little && (table.statistics().is_some() || column.meaning.kind == Kind::Value);
        (column.written.is_none() && !is_plain).then_some(column)
    };
    let column = test.numbers().iter().find_map(guessed)?;
    Some(format!(
        "that `{}` is `{}` was guessed, so that this is no proof: correct the header",
        column.name, column.annotation
    ))
}
