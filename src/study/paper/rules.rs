//! What must hold in a paper as a whole: names that exist, tables that fit, a ledger without gaps.

use super::{ClaimSpec, Paper, Parts};
use base::settings::{Faults, Spanned, none_called};
use std::collections::BTreeSet;

impl Paper {
    /// What is wrong with the paper as a whole goes to `faults`.
    pub(super) fn check(&self, specs: &[ClaimSpec], faults: &mut Faults) {
        self.check_claim_ids(specs, faults);
        self.check_ids(faults);
        let claims: BTreeSet<&str> = self.claims.iter().map(|claim| claim.id.as_str()).collect();
        let studies: BTreeSet<&str> = self.studies.iter().map(|study| study.name.as_str()).collect();
        let figures: BTreeSet<&str> = self.figure_ids().chain(self.table_ids()).collect();
        self.check_parts(specs, &claims, faults);
        self.check_ledger(&claims, &studies, &figures, faults);
        for row in self.tables.iter().flat_map(|table| &table.rows) {
            self.known("claim", &row.claims, &claims, faults);
        }
        for table in &self.tables {
            for together in &table.jointly {
                self.known("claim", std::slice::from_ref(&together.claim), &claims, faults);
                self.known("claim", &together.cells, &claims, faults);
            }
        }
        self.check_report(&claims, &figures, faults);
        self.check_tables(faults);
        self.check_results(faults);
        self.check_choices(faults);
    }

    /// A part exists, belongs to one sentence or row, and is no sentence of parts itself.
    fn check_parts(&self, specs: &[ClaimSpec], claims: &BTreeSet<&str>, faults: &mut Faults) {
        let mut taken: BTreeSet<&str> = BTreeSet::new();
        for spec in specs {
            let kinds = [&spec.all_of, &spec.any_of, &spec.means_one_of, &spec.cells];
            for ids in kinds {
                self.known("claim", ids, claims, faults);
            }
            for part in kinds.into_iter().flatten() {
                let id = part.get_ref();
                let is_whole = self.claim(id).is_some_and(|claim| claim.parts != Parts::None);
                if !taken.insert(id) || is_whole {
                    let why = if is_whole { "has parts itself" } else { "is a part already" };
                    let message = format!("claim `{id}` {why}; a part counts with one sentence or row");
                    faults.add(self.document.error(part.span(), message));
                }
            }
        }
    }

    fn check_tables(&self, faults: &mut Faults) {
        for (number, table) in self.tables.iter().enumerate() {
            for (index, row) in table.rows.iter().enumerate() {
                let (claims, cells) = (row.claims.len(), row.cells.len());
                let fits = claims.max(cells) == table.columns.len() && claims.min(cells) == 0;
                if !fits && !self.document.is_part("table") {
                    let message = format!(
                        "row `{}` of table `{}` has {claims} claims and {cells} cells; either are accepted, one for each of \
                         the {} columns",
                        row.label,
                        table.id,
                        table.columns.len()
                    );
                    let place = if claims > 0 { "claims" } else { "label" };
                    faults
                        .add(self.document.error_at(&format!("table.{number}.row.{index}.{place}"), message));
                }
            }
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

/// What the names of all that is a `what` are called where one of them may be unread.
pub fn names_of(what: &str) -> String {
    format!("names of every {what}")
}
