//! The inventory: everything that a paper prints, and the claims and figures that answer it.
//!
//! It is complete by rule, both ways. Each numbered figure, table and equation has a row. Each printed number is listed
//! where it is printed, and each claim's number is among them.

use super::{Claim, Paper, PrintedCell, PrintedTable, cells_named, printed_by};
use base::settings::{Faults, Spanned};
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeSet;

/// One thing that the paper prints and what answers it.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct InventoryRow {
    /// `Fig. 4`, `Table 1`, `Eq. 2`, or the place of a sentence.
    pub item: Spanned<String>,
    /// What it shows or says.
    pub says: String,
    /// Claims that answer it; a name that ends in `.*` stands for all cells of tables that begin so.
    #[serde(default)]
    pub claims: Vec<Spanned<String>>,
    /// Our figures and tables that stand beside it.
    #[serde(default)]
    pub figures: Vec<Spanned<String>>,
    /// Studies that carry it out.
    #[serde(default)]
    pub studies: Vec<Spanned<String>>,
    /// The numbers printed there.
    #[serde(default)]
    pub numbers: Vec<NumbersRow>,
    /// Why nothing can answer it.
    pub none: Option<String>,
}

/// Printed numbers that are answered in one way.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NumbersRow {
    /// The claims that print them, in the order in which they are printed; a name that ends in `.*` stands for all cells of tables that
    /// begin so. Where there is `printed`, the one claim that they answer together.
    #[serde(default)]
    pub claims: Vec<Spanned<String>>,
    /// Printed numbers that are no claim's own, with their digits, in the paper's order.
    #[serde(default)]
    pub printed: Vec<Spanned<String>>,
    /// The table that prints them, where its cells are no claims.
    pub table: Option<Spanned<String>>,
    /// How many of the numbers are inputs: they stand digit by digit in the studies or in a file, which `none` names.
    pub inputs: Option<Spanned<u32>>,
    /// Why no claim answers them: what else they are.
    pub none: Option<String>,
}

impl Paper {
    /// Refuses a row that is not answered, a name in one that nothing has, and printed things without a row.
    pub(super) fn check_inventory(
        &self,
        claims: &BTreeSet<&str>,
        studies: &BTreeSet<&str>,
        figures: &BTreeSet<&str>,
        faults: &mut Faults,
    ) {
        for row in &self.inventory {
            self.check_named(&row.claims, claims, faults);
            self.known("figure or table", &row.figures, figures, faults);
            self.known("study", &row.studies, studies, faults);
            for numbers in &row.numbers {
                self.check_named(&numbers.claims, claims, faults);
                let tables: BTreeSet<&str> = self.tables.iter().map(|table| table.id.as_str()).collect();
                self.known("table of the paper", numbers.table.as_slice(), &tables, faults);
            }
        }
        for row in &self.inventory {
            row.numbers.iter().for_each(|numbers| self.check_numbers(numbers, faults));
            self.check_row(row, faults);
        }
        self.check_counts(faults);
        self.check_claims_are_listed(faults);
    }

    /// A row has an answer or the reason why there is none; a figure's is a figure of ours.
    fn check_row(&self, row: &InventoryRow, faults: &mut Faults) {
        let item = row.item.get_ref();
        let is_figure = row.item.get_ref().starts_with("Fig. ");
        let is_answered = !(row.claims.is_empty() && row.studies.is_empty() && row.figures.is_empty());
        let message = match &row.none {
            Some(_) if !row.figures.is_empty() || is_answered && !is_figure => {
                format!("inventory row `{item}` has an answer and `none`, the reason why there is none")
            }
            None if is_figure && row.figures.is_empty() => {
                format!(
                    "{item} of the paper needs `figures`, ours beside it, or `none`, why there is no such figure"
                )
            }
            None if !is_answered && row.numbers.is_empty() => format!(
                "inventory row `{item}` needs claims, figures, studies or numbers that answer it, or `none` with the reason"
            ),
            _ => return,
        };
        faults.add(self.document.error(row.item.span(), message));
    }

    /// Every claim that is named exists, and so does some cell of a name that stands for several.
    pub(super) fn check_named(
        &self,
        names: &[Spanned<String>],
        claims: &BTreeSet<&str>,
        faults: &mut Faults,
    ) {
        let is_some = |name: &&Spanned<String>| {
            cells_named(name.get_ref(), &self.cells).iter().any(|id| id != name.get_ref())
        };
        let single: Vec<Spanned<String>> = names.iter().filter(|name| !is_some(name)).cloned().collect();
        self.known("claim", &single, claims, faults);
    }

    /// The numbers of a row, each with the claim that prints it or that all of them answer.
    pub fn numbers(&self, row: &NumbersRow) -> Vec<(String, Option<String>)> {
        if let Some(id) = &row.table {
            let cells =
                self.tables.iter().filter(|table| table.id == *id.get_ref()).flat_map(PrintedTable::cells);
            let is_number = |cell: &&PrintedCell| cell.printed.parse::<f64>().is_ok();
            return cells.filter(is_number).map(|cell| (cell.printed.clone(), cell.claim.clone())).collect();
        }
        if row.printed.is_empty() {
            let named = row.claims.iter().flat_map(|name| cells_named(name.get_ref(), &self.cells));
            let own = named.filter_map(|id| self.claim(id)).filter(|claim| claim.difference.is_none());
            return own.filter_map(|claim| Some((claim.printed.clone()?, Some(claim.id.clone())))).collect();
        }
        let answer = row.claims.first().map(|claim| claim.get_ref().clone());
        row.printed.iter().map(|printed| (printed.get_ref().clone(), answer.clone())).collect()
    }

    /// A number is printed by a claim or a table, or has a claim that answers it with others, or a reason why none does. None stands
    /// in two places.
    fn check_numbers(&self, numbers: &NumbersRow, faults: &mut Faults) {
        let NumbersRow { claims, printed, table, inputs, none } = numbers;
        let first = printed.first().or(claims.first()).or(table.as_ref()).map(Spanned::span);
        let Some(first) = first.or(inputs.as_ref().map(Spanned::span)) else { return };
        let is_one_way = match (printed.len(), claims.len(), table, inputs) {
            (0, 1.., None, None) => none.is_none(),
            (0, 0, Some(_), None) => true,
            (0, 0, None, Some(_)) => none.is_some(),
            (1.., claims, None, None) => claims == usize::from(none.is_none()),
            _ => false,
        };
        if !is_one_way {
            let message = "numbers need `claims` that print them, or a `table`, or `printed` with one claim that answers them or with \
                           `none`, the reason why none does, or `inputs` with `none`, where they stand";
            return faults.add(self.document.error(first, message));
        }
        for claim in claims {
            let Some(known) = self.claim(claim.get_ref()) else { continue };
            let message = match (&known.printed, printed.is_empty()) {
                (Some(own), false) => {
                    format!("claim `{}` prints {own} itself; without `printed` it is accepted", known.id)
                }
                (None, true) => format!("claim `{}` prints no number; `printed` is needed", known.id),
                _ => continue,
            };
            faults.add(self.document.error(claim.span(), message).about(&printed_by(&known.id)));
        }
    }

    /// The number of every claim is listed in a row that names the claim.
    fn check_claims_are_listed(&self, faults: &mut Faults) {
        if self.prints.numbers == 0 {
            return;
        }
        let mut listed: BTreeSet<String> = BTreeSet::new();
        for row in &self.inventory {
            let numbers: Vec<_> = row.numbers.iter().flat_map(|numbers| self.numbers(numbers)).collect();
            // Several claims may speak of a number that is printed once.
            let named = row.claims.iter().flat_map(|name| cells_named(name.get_ref(), &self.cells));
            let prints = |id: &&str| {
                let printed = self.claim(id).and_then(|claim| claim.printed.as_ref());
                numbers.iter().any(|(number, _)| Some(number) == printed)
            };
            listed.extend(named.filter(prints).map(str::to_owned));
            listed.extend(numbers.iter().filter_map(|(_, claim)| claim.clone()));
        }
        let is_printed = |claim: &&Claim| claim.difference.is_none() && !listed.contains(&claim.id);
        for claim in self.claims.iter().filter(is_printed) {
            let Some(printed) = &claim.printed else { continue };
            let message =
                format!("no row of the inventory lists the number {printed} for claim `{}`", claim.id);
            faults.add(self.document.error_at(&claim.written.printed, message));
        }
    }

    /// Every numbered figure, table and equation has a row, and as many numbers are listed as are printed.
    fn check_counts(&self, faults: &mut Faults) {
        let items: BTreeSet<&str> = self.inventory.iter().map(|row| row.item.get_ref().as_str()).collect();
        for (kind, key, count) in [
            ("Fig.", "figures", self.prints.figures),
            ("Table", "tables", self.prints.tables),
            ("Eq.", "equations", self.prints.equations),
        ] {
            for number in 1..=count {
                let item = format!("{kind} {number}");
                if !items.contains(item.as_str()) {
                    let message =
                        format!("the inventory has no row for {item}; the paper has {count} of its kind");
                    faults.add(self.document.error_at(&format!("prints.{key}"), message));
                }
            }
        }
        let count = |row: &NumbersRow| {
            self.numbers(row).len() + row.inputs.as_ref().map_or(0, |inputs| *inputs.get_ref() as usize)
        };
        let listed: usize = self.inventory.iter().flat_map(|row| &row.numbers).map(count).sum();
        if listed != self.prints.numbers as usize {
            let message = format!(
                "the inventory lists {listed} printed numbers; `numbers` says {}",
                self.prints.numbers
            );
            faults.add(self.document.error_at("prints.numbers", message));
        }
    }
}
