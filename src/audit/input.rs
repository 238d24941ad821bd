//! The input of an audit: tables, samples, named cells, and relations between them.

use super::meaning::Meaning;
use super::sample::{self, Sample};
use super::statistic::Statistic;
use super::table::{Place, Quoted, Table, quoted};
use proofs::exact::Print;
use proofs::printed::{Digits, Printed};
use std::collections::BTreeMap;
use toml::Value;

/// Everything that was read.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Input {
    /// The tables, in the order of the file.
    pub tables: Vec<Table>,
    /// Samples that were written down as such.
    pub samples: Vec<Sample>,
    /// Relations between printed numbers.
    pub relations: Vec<Relation>,
    /// Single numbers that relations name, by their names.
    cells: BTreeMap<String, Quoted>,
}

/// A check of numbers that are named.
#[derive(Debug, Clone, PartialEq)]
pub struct Relation {
    /// The check's name.
    pub check: String,
    /// What it is called; may be empty.
    pub name: String,
    /// Where it stands.
    pub place: Place,
    /// How digits end.
    pub digits: Digits,
    /// Its other keys, each with its value and where that stands.
    pub(super) keys: BTreeMap<String, (Value, Place)>,
}

impl Input {
    /// The input that consists of these tables. Cells of tables with a name are called `table/row/column`.
    pub fn of_tables(tables: Vec<Table>) -> Self {
        Self { tables, ..Self::default() }
    }

    /// Whether there is nothing to look at.
    pub fn is_empty(&self) -> bool {
        self.tables.is_empty() && self.samples.is_empty() && self.relations.is_empty()
    }

    /// Names a cell.
    pub fn name(&mut self, name: String, printed: Printed, digits: Digits, place: Place) {
        let quoted = Quoted { name: name.clone(), place, print: Print { printed, digits }, cell: None };
        self.cells.insert(name, quoted);
    }

    /// Takes a sample by its statistics.
    pub fn take_sample(
        &mut self,
        name: &str,
        meaning: &Meaning,
        statistics: &[(Statistic, Printed)],
        place: Place,
    ) {
        let quoted = |(statistic, printed): &(Statistic, Printed)| {
            let print = Print { printed: *printed, digits: meaning.digits };
            let name = format!("{} of {name}", statistic.name());
            (*statistic, Quoted { name, place, print, cell: None })
        };
        let numbers = statistics.iter().map(quoted).collect();
        self.samples.push(sample::of_meaning(name, meaning, sample::number(meaning), numbers));
    }

    /// The cells of this name: one under `cells`, or all at `table/row/column`.
    pub fn cells(&self, name: &str) -> Vec<Quoted> {
        if let Some(cell) = self.cells.get(name) {
            return vec![cell.clone()];
        }
        let mut found = Vec::new();
        for (index, table) in self.tables.iter().enumerate() {
            let Some(rest) = name.strip_prefix(table.name.as_str()).and_then(|rest| rest.strip_prefix('/'))
            else {
                continue;
            };
            for row in 0..table.rows.len() {
                let column = rest.strip_prefix(table.row_name(row).as_str());
                let Some(column) = column.and_then(|rest| rest.strip_prefix('/')) else { continue };
                found.extend(table.columns_named(column).filter_map(|at| quoted(index, table, row, at)));
            }
        }
        found
    }

    /// The samples of this name: those in a column of a table of statistics are called `table/column`.
    pub fn samples(&self, name: &str) -> Vec<Sample> {
        let mut found = Vec::new();
        self.each_sample(&mut |sample| {
            if sample.name == name || sample.path == name {
                found.push(sample.clone());
            }
        });
        found
    }

    /// Gives every sample: those written down, and those in the rows and columns of tables.
    pub fn each_sample(&self, give: &mut dyn FnMut(&Sample)) {
        self.samples.iter().for_each(&mut *give);
        for (index, table) in self.tables.iter().enumerate() {
            sample::each(index, table, give);
        }
    }
}
