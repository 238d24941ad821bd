//! Rules for a paper as a whole: names that exist, tables that fit, an inventory without gaps.

use super::columns::columns;
use super::table_spec::TableSpec;
use super::{Claim, ClaimSpec, Paper, Parts};
use base::settings::{Faults, Spanned, none_called};
use std::collections::BTreeSet;

/// How many claims of a paper may be headlines.
const HEADLINES: usize = 8;

impl Paper {
    /// What is wrong with the paper as a whole goes to `faults`.
    pub(super) fn check(&self, specs: &[ClaimSpec], tables: &[TableSpec], faults: &mut Faults) {
        self.check_claim_ids(faults);
        self.check_ids(faults);
        let claims: BTreeSet<&str> = self.claims.iter().map(|claim| claim.id.as_str()).collect();
        let studies: BTreeSet<&str> = self.studies.iter().map(|study| study.name.as_str()).collect();
        let figures: BTreeSet<&str> = self.figure_ids().chain(self.table_ids()).collect();
        let with: Vec<&Spanned<String>> =
            tables.iter().flat_map(|table| &table.rows).flat_map(|row| &row.with).collect();
        self.check_parts(specs, &with, &claims, faults);
        self.check_repeated(tables, faults);
        self.check_headlines(faults);
        self.check_inventory(&claims, &studies, &figures, faults);
        self.check_report(&claims, &figures, faults);
        self.check_results(faults);
        self.check_choices(faults);
    }

    /// A part exists, belongs to one sentence or row, and is no sentence of parts itself.
    fn check_parts(
        &self,
        specs: &[ClaimSpec],
        with: &[&Spanned<String>],
        claims: &BTreeSet<&str>,
        faults: &mut Faults,
    ) {
        let mut taken: BTreeSet<&str> = self.cells_of_rows().collect();
        let written = |spec| ClaimSpec::kinds(spec).into_iter().flatten();
        for part in with.iter().copied().chain(specs.iter().flat_map(written)) {
            self.known("claim", std::slice::from_ref(part), claims, faults);
            let id = part.get_ref();
            let is_whole = self.claim(id).is_some_and(|claim| claim.parts != Parts::None);
            if !taken.insert(id) || is_whole {
                let why = if is_whole { "has parts itself" } else { "is a part already" };
                let message = format!("claim `{id}` {why}; a part counts with one sentence or row");
                faults.add(self.document.error(part.span(), message));
            }
        }
    }

    /// A number that two tables print of the same trials is one claim, which the cell of the second names as `same_as`.
    fn check_repeated(&self, tables: &[TableSpec], faults: &mut Faults) {
        let cells: Vec<&Claim> = self.cells.iter().filter_map(|id| self.claim(id)).collect();
        let table = |cell: &Claim| cell.written.around().last().map(str::to_owned);
        for (place, cell) in cells.iter().enumerate().filter(|(_, cell)| cell.criteria().next().is_some()) {
            let is_same = |other: &&&Claim| other.tests_alike(cell) && table(other) != table(cell);
            if let Some(other) = cells[..place].iter().find(is_same) {
                let message = format!(
                    "`{}` prints the number that `{}` prints of the same trials; same_as = \"{}\" under its row's `cell` counts it once",
                    cell.id, other.id, other.id
                );
                faults.add(self.document.error_at(&cell.written.printed, message));
            }
        }
        for (table, row) in tables.iter().flat_map(|table| table.rows.iter().map(move |row| (table, row))) {
            for (printed, (.., id)) in row.printed.iter().zip(columns(table)) {
                let Some(same) = row.cell.get(id).and_then(|cell| cell.same_as.as_ref()) else { continue };
                let number = Some(printed.get_ref());
                if !cells.iter().any(|cell| cell.id == *same.get_ref() && cell.printed.as_ref() == number) {
                    let message =
                        format!("same_as: no cell `{}` prints {}", same.get_ref(), printed.get_ref());
                    faults.add(self.document.error(same.span(), message));
                }
            }
        }
    }

    /// The cells that are parts of rows of tables.
    fn cells_of_rows(&self) -> impl Iterator<Item = &str> {
        let cells: BTreeSet<&String> = self.cells.iter().collect();
        let rows = self.claims.iter().filter(|claim| matches!(claim.parts, Parts::Cells(_)));
        rows.flat_map(|row| row.parts.ids()).filter(move |id| cells.contains(id)).map(String::as_str)
    }

    /// Few claims say what the paper is about.
    fn check_headlines(&self, faults: &mut Faults) {
        let headlines: Vec<&Claim> = self.claims.iter().filter(|claim| claim.headline).collect();
        for claim in headlines.iter().skip(HEADLINES) {
            let message = format!(
                "the paper has {} headline claims; at most {HEADLINES} are accepted, so `{}` is one too many",
                headlines.len(),
                claim.id
            );
            let place = format!("{}.headline", claim.written.own);
            faults.add(self.document.error_at(&place, message));
        }
    }

    pub(super) fn known(
        &self,
        what: &str,
        names: &[Spanned<String>],
        known: &BTreeSet<&str>,
        faults: &mut Faults,
    ) {
        for name in names {
            if !known.contains(name.get_ref().as_str()) {
                let message = none_called(what, name.get_ref(), known.iter().copied());
                let error = self.document.error(name.span(), message).about(name.get_ref());
                let error = error.about(&names_of(what));
                faults.add(if what == "study" { error } else { error.about("id") });
            }
        }
    }
}

/// The words for the names of all things called `what`, where one of them may be unread.
pub fn names_of(what: &str) -> String {
    format!("names of every {what}")
}
