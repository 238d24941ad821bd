//! What must hold in a paper as a whole: names that exist, tables that fit, an inventory without gaps.

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

/// What the names of all that is a `what` are called where one of them may be unread.
pub fn names_of(what: &str) -> String {
    format!("names of every {what}")
}
