//! The numbers that no check looked at, so that silence is no pass.

use crate::checks::Test;
use crate::input::Input;
use crate::meaning::{Kind, Meaning};
use crate::statistic::Statistic;
use crate::table::{Place, Quoted, Table};
use std::collections::{BTreeMap, BTreeSet};

/// A column, a row of a statistic, or a sample of a TOML file, that no check looked at.
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
            all.extend(of_rows(table));
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

/// Rows of a table of statistics whose first word names none, each word once.
fn of_rows(table: &Table) -> Vec<Unseen> {
    let Some(names) = table.statistics() else { return Vec::new() };
    let mut unknown: BTreeMap<&str, Place> = BTreeMap::new();
    for row in &table.rows {
        let Some(name) = row.get(names).filter(|name| Statistic::named(&name.text).is_none()) else {
            continue;
        };
        if row.iter().any(|cell| cell.value.is_some()) {
            unknown.entry(&name.text).or_insert(name.place);
        }
    }
    let unseen = |(name, place): (&str, Place)| Unseen {
        place,
        name: format!("row `{name}`"),
        advice: format!("no statistic is called so; there are {}", Statistic::WORDS),
    };
    unknown.into_iter().map(unseen).collect()
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
        Kind::Statistic(Statistic::Mean) => {
            "alone a mean may be anything; say `n=N` with `integers` or `tick=Q`, or `of=NAME` here and at its deviation or ends"
        }
        Kind::Statistic(_) => "say `of=NAME` here and at the other statistics of the same values",
        Kind::Samples => "no column `rises` with it",
        Kind::Value => "say what it is, as `mean`, `% of N`, `a+b√2`, or `skip` (`--list` has all)",
    };
    Some(Unseen { place: cell.place, name: format!("column `{}`", column.name), advice: advice.to_owned() })
}
