//! Names of claims, studies, figures and tables: they stand in files' names, in links and in cells of tables, so that they are
//! plain, each once.

use super::Paper;
use super::rules::names_of;
use base::settings::{Document, Faults};
use base::text::{MOST_OF_NAME, brief};
use std::collections::BTreeSet;

/// What is wrong with `name`, which stands in tables and links, if anything is.
fn wrong(what: &str, name: &str) -> Option<String> {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '.' | '-');
    let is_accepted = (1..=MOST_OF_NAME).contains(&name.len()) && name.chars().all(is_plain);
    (!is_accepted).then(|| {
        format!(
            "the {what} is called \"{}\"; 1 to {MOST_OF_NAME} of a to z, A to Z, 0 to 9, `_`, `.` and `-` are accepted as its name",
            brief(name).escape_debug()
        )
    })
}

/// What it is called that all cells of a row or table, which stands where `place` leads to, are there twice.
pub(super) fn twice(place: &str) -> String {
    format!("twice in {place}")
}

impl Paper {
    /// Names of claims are plain, each once; so are those of studies, which are those of their files.
    pub(super) fn check_claim_ids(&self, faults: &mut Faults) {
        let mut seen = BTreeSet::new();
        for claim in &self.claims {
            if let Some(message) = wrong("claim", &claim.id) {
                faults.add(self.document.error_at(&claim.written.id, message));
                faults.unread(names_of("claim"));
            }
            if !seen.insert(&claim.id) {
                let message = format!("another claim or cell is called `{}` already", claim.id);
                let error = self.document.error_at(&claim.written.id, message);
                faults.add(claim.written.around().fold(error, |error, around| error.about(&twice(around))));
                // That its cells are there twice follows.
                faults.unread(twice(claim.written.own.trim_end_matches(".whole")));
            }
        }
        for study in &self.studies {
            if let Some(message) = wrong("study", &study.name) {
                faults.add(study.document.error(0..0, message + ": that of its file"));
                faults.unread(names_of("study"));
            }
        }
    }

    /// Ids of figures and tables are names of files: plain ones, each once.
    pub(super) fn check_ids(&self, faults: &mut Faults) {
        let mut placed: Vec<(&Document, String, &String)> = Vec::new();
        for study in &self.studies {
            let ids = study.figures.iter().enumerate();
            placed.extend(
                ids.clone().map(|(at, f)| (&*study.document, format!("figure.{at}.id"), f.id.get_ref())),
            );
            let tables = ids.filter_map(|(at, figure)| Some((at, figure.table.as_ref()?)));
            placed.extend(tables.map(|(at, id)| (&*study.document, format!("figure.{at}.table"), id)));
        }
        let results = self.results.iter().enumerate();
        placed.extend(
            results.map(|(index, t)| (&*self.document, format!("results.{index}.id"), t.id.get_ref())),
        );
        let tables = self.tables.iter().enumerate();
        placed.extend(tables.map(|(index, table)| (&*self.document, format!("table.{index}.id"), &table.id)));
        let mut seen = BTreeSet::from(["numbers"]);
        for (document, place, id) in placed {
            let is_plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
            if id.is_empty() || !id.chars().all(is_plain) {
                let shown = id.escape_debug();
                let message =
                    format!("the id `{shown}` names files; a to z, 0 to 9 and _ are accepted in it");
                faults.add(document.error_at(&place, message));
                for what in ["figure", "figure or table"] {
                    faults.unread(names_of(what));
                }
            } else if !seen.insert(id) {
                let message = format!("another figure or table of the paper is called `{id}` already");
                faults.add(document.error_at(&place, message));
            }
        }
    }
}
