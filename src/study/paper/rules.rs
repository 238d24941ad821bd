//! What must hold in a paper as a whole: names that exist, tables that fit, a ledger without gaps.

use super::{ClaimSpec, Paper, Parts};
use crate::spec::OptionSpec;
use crate::{Reading, ReadingChoice};
use base::settings::{Faults, Spanned, none_called};
use std::collections::{BTreeMap, BTreeSet};

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
        self.check_readings(faults);
        self.check_premises(faults);
        self.check_votes(faults);
        self.check_departures(faults);
        self.check_explored(faults);
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

    /// A reading's name means the same in every study of the paper.
    fn check_readings(&self, faults: &mut Faults) {
        let all = self.readings();
        let each = self.studies.iter().flat_map(|s| s.readings.iter().enumerate().map(move |r| (s, r)));
        for (study, (index, reading)) in each {
            let first = all.iter().find(|known| known.id == reading.id).expect("every reading is listed");
            if first.default != reading.default || !first.options.keys().eq(reading.options.keys()) {
                let message = format!(
                    "reading `{}` has other options or another default in another study of the paper; one name must \
                     mean the same everywhere",
                    reading.id
                );
                faults.add(study.document.error_at(&format!("reading.{index}.id"), message));
            }
        }
    }

    /// A claim is meant under options that readings have.
    fn check_premises(&self, faults: &mut Faults) {
        let all = self.readings();
        for (index, claim) in self.claims.iter().enumerate() {
            for (id, message) in unknown_options(&claim.holds_when, &all) {
                let message = format!("claim `{}`, holds_when{message}", claim.id);
                let place = format!("claim.{index}.holds_when.{id}");
                faults.add(self.document.error_at(&place, message).about(&id).about("id"));
            }
        }
    }

    /// What a reading votes by is whole: numbers have sourced bounds, and a default that decides classes has a source.
    fn check_votes(&self, faults: &mut Faults) {
        let all = self.readings();
        let each = self.studies.iter().flat_map(|s| s.readings.iter().enumerate().map(move |r| (s, r)));
        for (study, (index, own)) in each {
            // It may hang on what could not be read, by these names.
            let mut wrong = |key: &str, message: String, of: &[&str]| {
                let place = format!("reading.{index}.{key}");
                let error = study.document.error_at(&place, format!("reading `{}`: {message}", own.id));
                faults.add(of.iter().fold(error, |error, name| error.about(name)));
            };
            let reading = all.iter().find(|known| known.id == own.id).expect("every reading is listed");
            if let Some(bounds) = own.bounds.as_ref().filter(|bounds| bounds.least > bounds.greatest) {
                let message = format!(
                    "least {} is above greatest {}; rising bounds are accepted",
                    bounds.least, bounds.greatest
                );
                wrong("bounds", message, &[]);
            }
            for (name, option) in &own.options {
                for message in option_faults(name, option, reading) {
                    wrong(&format!("option.{name}"), message, &["bounds", "value"]);
                }
                for (other, message) in unknown_options(&option.only_with, &all) {
                    let message = format!("option `{name}`, only_with{message}");
                    wrong(&format!("option.{name}.only_with.{other}"), message, &[&other, "id"]);
                }
            }
            if !reading.votes(&own.default) {
                let message = format!(
                    "the default `{}` needs `paper` or `practice` as other options have: what it is judged by votes",
                    own.default
                );
                wrong("default", message, &["bounds", "value", "paper", "practice"]);
            }
            if own.fitted && self.studies.iter().all(|study| study.fitted_to.is_empty()) {
                let message = "is fitted, but no study of the paper says what to; `fitted_to` is needed";
                wrong("fitted", message.to_owned(), &["fitted_to"]);
            }
        }
    }

    /// A contender departs from readings of other studies: over what it departs to, the option in hand of one that its study has
    /// would be laid.
    fn check_departures(&self, faults: &mut Faults) {
        let all = self.readings();
        for study in &self.studies {
            for (index, contender) in study.contenders.iter().enumerate() {
                let mut wrong = |message: String| {
                    let place = format!("contender.{index}.departs");
                    let message = format!("contender `{}`: {message}", contender.label);
                    let error = study.document.error_at(&place, message);
                    let named = contender.departs.iter().flat_map(|(id, option)| [id, option]);
                    faults.add(named.fold(error, |error, name| error.about(name)));
                };
                if let Err(message) = ReadingChoice::new(&all, &contender.departs) {
                    wrong(message);
                } else if let Some(own) =
                    study.readings.iter().find(|own| contender.departs.contains_key(&own.id))
                {
                    wrong(format!(
                        "departs from reading `{}`, which its study has; readings of other studies are accepted",
                        own.id
                    ));
                }
            }
        }
    }

    /// A study that is explored needs the paper's budget; a second seed is another one.
    fn check_explored(&self, faults: &mut Faults) {
        let late = self.explore.iter().flat_map(|explore| &explore.where_compatible);
        for name in late.filter(|name| self.study(name).is_none_or(|study| study.explore.is_none())) {
            let explored = self.studies.iter().filter(|study| study.explore.is_some());
            let message = none_called("explored study", name, explored.map(|study| study.name.as_str()));
            faults.add(self.document.error_at("explore.where_compatible", message).about(name));
        }
        for study in &self.studies {
            if study.explore.is_some() && self.explore.is_none() {
                let message = format!(
                    "study `{}` is explored; paper.toml then needs `[explore]` with `sample` and `trials`",
                    study.name
                );
                faults.add(study.document.error_at("explore", message).about("explore"));
            }
            let other = study.explore.as_ref().and_then(|explore| explore.stands_for.as_ref());
            if let Some(other) = other.filter(|other| self.study(other).is_none()) {
                let known = self.studies.iter().map(|study| study.name.as_str());
                let message = none_called("study", other, known);
                faults.add(study.document.error_at("explore.stands_for", message).about(other));
            }
            if study.second_seed == Some(study.seed) {
                let message =
                    format!("the second seed is the first, {}; another one is accepted", study.seed);
                faults.add(study.document.error_at("second_seed", message));
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

/// What is wrong with an option of `reading`: a number without bounds or bounds without a number, or an empty source.
fn option_faults(name: &str, option: &OptionSpec, reading: &Reading) -> Vec<String> {
    let mut faults = Vec::new();
    match &reading.bounds {
        Some(bounds) if reading.options[name].value.is_none() => {
            let range = format!("{} to {}", bounds.least, bounds.greatest);
            faults
                .push(format!("option `{name}` needs `value`: the number held against the bounds, {range}"));
        }
        None if option.value.is_some() => {
            faults.push(format!("option `{name}` has a `value`, which needs `bounds` to be held against"));
        }
        _ => {}
    }
    if [&option.paper, &option.practice].into_iter().flatten().any(|text| text.trim().is_empty()) {
        faults.push(format!("option `{name}` cites nothing; the source and its words are accepted"));
    }
    faults
}

/// Of options by reading those that are none of `all`, by reading; and readings of which none is named.
fn unknown_options(wanted: &BTreeMap<String, Vec<String>>, all: &[Reading]) -> Vec<(String, String)> {
    let fault = |(id, options): (&String, &Vec<String>)| -> Vec<(String, String)> {
        let Some(reading) = all.iter().find(|reading| reading.id == *id) else {
            let known = all.iter().map(|reading| reading.id.as_str());
            return vec![(id.clone(), format!(": {}", none_called("reading", id, known)))];
        };
        let known = || reading.options.keys().map(String::as_str);
        if options.is_empty() {
            let listed = known().collect::<Vec<_>>().join(", ");
            return vec![(id.clone(), format!(".{id}: names no option; the options are {listed}"))];
        }
        let unknown = options.iter().filter(|option| !reading.options.contains_key(*option));
        let told =
            |option: &String| (id.clone(), format!(".{id}: {}", none_called("option", option, known())));
        unknown.map(told).collect()
    };
    wanted.iter().flat_map(fault).collect()
}
