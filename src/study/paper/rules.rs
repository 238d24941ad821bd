//! What must hold in a paper as a whole: names that exist, tables that fit, a ledger without gaps.

use super::{ClaimSpec, Paper, TableSpec};
use base::settings::{SettingsError, Spanned};
use std::collections::BTreeSet;

impl Paper {
    pub(super) fn check(&self, specs: &[ClaimSpec]) -> Result<(), SettingsError> {
        let mut seen = BTreeSet::new();
        for spec in specs {
            if !seen.insert(spec.id.get_ref()) {
                let message = format!("claim `{}` stands twice", spec.id.get_ref());
                return Err(self.document.error(spec.id.span(), message));
            }
        }
        self.check_ids()?;
        let claims: BTreeSet<&str> = self.claims.iter().map(|claim| claim.id.as_str()).collect();
        let studies: BTreeSet<&str> = self.studies.iter().map(|study| study.name.as_str()).collect();
        let figures: BTreeSet<&str> = self.figure_ids().chain(self.table_ids()).collect();
        for row in &self.ledger {
            self.known("claim", &row.claims, &claims)?;
            self.known("figure or table", &row.figures, &figures)?;
            self.known("study", &row.studies, &studies)?;
            let answered = !(row.claims.is_empty() && row.figures.is_empty() && row.studies.is_empty());
            if answered == row.none.is_some() {
                let message = format!(
                    "ledger row `{}` needs claims, figures or studies that answer it, or `none` with the reason, and \
                     not both",
                    row.item.get_ref()
                );
                return Err(self.document.error(row.item.span(), message));
            }
        }
        for row in self.tables.iter().flat_map(|table| &table.rows) {
            self.known("claim", &row.claims, &claims)?;
        }
        for table in &self.tables {
            self.known("claim", &table.jointly, &claims)?;
        }
        self.check_findings(&claims)?;
        self.check_tables()?;
        self.check_results()?;
        self.check_readings()?;
        self.check_numbering()
    }

    /// Ids of figures and tables are names of files: plain ones, each once.
    fn check_ids(&self) -> Result<(), SettingsError> {
        let figures = self.studies.iter().flat_map(|s| s.figures.iter().map(move |f| (&s.document, &f.id)));
        let results = self.results.iter().map(|table| (&self.document, &table.id));
        let mut placed: Vec<_> =
            figures.chain(results).map(|(document, id)| (document, id.get_ref(), id.span())).collect();
        for TableSpec { id, .. } in &self.tables {
            let before = "id = ";
            let at =
                self.document.text().find(&format!("{before}\"{id}\"")).map_or(0, |at| at + before.len());
            placed.push((&self.document, id, at..at + id.len()));
        }
        let mut seen = BTreeSet::from(["numbers"]);
        for (document, id, span) in placed {
            let is_plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
            if id.is_empty() || !id.chars().all(is_plain) {
                let message = format!("the id `{id}` names files; a to z, 0 to 9 and _ are accepted in it");
                return Err(document.error(span, message));
            }
            if !seen.insert(id) {
                let message = format!("another figure or table of the paper is called `{id}` already");
                return Err(document.error(span, message));
            }
        }
        Ok(())
    }

    /// A reading's name means the same in every study of the paper.
    fn check_readings(&self) -> Result<(), SettingsError> {
        for (study, reading) in self.studies.iter().flat_map(|s| s.readings.iter().map(move |r| (s, r))) {
            let all = self.readings();
            let first = all.iter().find(|known| known.id == reading.id).expect("every reading is listed");
            if first.default != reading.default || !first.options.keys().eq(reading.options.keys()) {
                let message = format!(
                    "reading `{}` has other options or another default in another study of the paper; one name must \
                     mean the same everywhere",
                    reading.id
                );
                return Err(study.document.error(0..0, message));
            }
        }
        Ok(())
    }

    fn check_tables(&self) -> Result<(), SettingsError> {
        for table in &self.tables {
            for row in &table.rows {
                let (claims, cells) = (row.claims.len(), row.cells.len());
                if claims.max(cells) != table.columns.len() || claims.min(cells) > 0 {
                    let message = format!(
                        "row `{}` of table `{}` has {claims} claims and {cells} cells; either are accepted, one for each of \
                         the {} columns",
                        row.label,
                        table.id,
                        table.columns.len()
                    );
                    let span = row.claims.first().map_or(0..0, Spanned::span);
                    return Err(self.document.error(span, message));
                }
            }
        }
        Ok(())
    }

    fn known(
        &self,
        what: &str,
        names: &[Spanned<String>],
        known: &BTreeSet<&str>,
    ) -> Result<(), SettingsError> {
        for name in names {
            if !known.contains(name.get_ref().as_str()) {
                let list: Vec<&str> = known.iter().copied().collect();
                let message =
                    format!("there is no {what} `{}`; there are {}", name.get_ref(), list.join(", "));
                return Err(self.document.error(name.span(), message));
            }
        }
        Ok(())
    }

    /// Every numbered figure, table and equation must have a row.
    fn check_numbering(&self) -> Result<(), SettingsError> {
        let items: BTreeSet<&str> = self.ledger.iter().map(|row| row.item.get_ref().as_str()).collect();
        for (kind, count) in
            [("Fig.", self.prints.figures), ("Table", self.prints.tables), ("Eq.", self.prints.equations)]
        {
            for number in 1..=count {
                let item = format!("{kind} {number}");
                if !items.contains(item.as_str()) {
                    let message =
                        format!("the ledger has no row for {item}; the paper has {count} of its kind");
                    return Err(self.document.error(0..0, message));
                }
            }
        }
        Ok(())
    }
}
