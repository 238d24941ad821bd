//! Tasks: what a study does with its problems and contenders; one a file, all in [`REGISTRY`].

mod formula_error;
mod plan;

use super::key::{SweepKey, TrialKey};
use super::preprocessing::Preprocessing;
use super::record::{Batch, PreprocessingRow, Row, Status, Values};
use super::unit::Unit;
use base::settings::{Accepted, Settings, SettingsError};
use engine::planner::{Invalid, Value};

/// A task with its settings.
pub trait Task: Send + Sync {
    /// Does one unit of work: everything that shares one preprocessed object.
    fn run(&self, unit: &Unit<'_>) -> Batch;

    /// Does several units of one family and seed, which differ in their contenders alone; as [`run`](Self::run) of each, but
    /// what they share may be made once.
    fn run_alike(&self, units: &[&Unit<'_>]) -> Vec<Batch> {
        units.iter().map(|unit| self.run(unit)).collect()
    }

    /// What stands in a contender's place in its trials, where it does not run contenders.
    fn labels(&self) -> Vec<String> {
        Vec::new()
    }

    /// What names the unit's trials, in the order of records: one a query, entrant and repeat, or one a label of the task's own.
    fn trials(&self, unit: &Unit<'_>) -> Vec<TrialKey> {
        let mut trials: Vec<TrialKey> = self.labels().iter().map(|label| key(unit, label)).collect();
        if !trials.is_empty() {
            return trials;
        }
        // The loop needs only names, so nothing is drawn.
        for query in unit.family.queries() {
            for entrant in &unit.entrants {
                trials
                    .extend((0..entrant.contender.repeats).map(|repeat| unit.trial(query, entrant, repeat)));
            }
        }
        trials
    }
}

/// A registered task.
#[derive(Debug)]
pub struct Entry {
    /// The name that specs use; also its file's name.
    pub name: &'static str,
    /// One line for `replan list`.
    pub about: &'static str,
    /// Raised whenever a change moves what it records.
    pub revision: u32,
    /// The columns that it fills besides those of planners and families.
    pub columns: &'static [&'static str],
    /// The shape of its settings, which documents them.
    pub settings: Accepted,
    /// Settings that it can be built from, as TOML: for `replan list`, and for a test that builds it from them.
    pub example: &'static str,
    /// How to build it from its settings.
    pub build: fn(&Settings) -> Result<Box<dyn Task>, SettingsError>,
}

/// Every task, in the order of their names.
pub static REGISTRY: &[&Entry] = &[&formula_error::ENTRY, &plan::ENTRY];

/// The entry called `name`.
pub fn find(name: &str) -> Option<&'static Entry> {
    REGISTRY.iter().copied().find(|entry| entry.name == name)
}

/// The task of a study that names none.
pub fn default() -> &'static Entry {
    &plan::ENTRY
}

#[cfg(test)]
mod tests;

/// The row of a unit's preprocessed object.
fn preprocessing_row(unit: &Unit<'_>, preprocessing: Result<&Preprocessing, &Invalid>) -> PreprocessingRow {
    PreprocessingRow {
        key: unit.key.clone(),
        kind: unit.group.family.preprocessing.to_owned(),
        seed: unit.seed,
        reason: preprocessing.err().map(|invalid| invalid.0.clone()),
        values: preprocessing.map(|p| named(&p.values)).unwrap_or_default(),
    }
}

fn named<'a>(values: impl IntoIterator<Item = (&'a &'static str, &'a Value)>) -> Values {
    values.into_iter().map(|(name, value)| (*name, *value)).collect()
}

/// The key of the row that stands under `label`.
fn key(unit: &Unit<'_>, label: &str) -> TrialKey {
    let on = unit.key.clone();
    TrialKey { on, query: None, contender: label.into(), sweep: SweepKey::default(), repeat: 0 }
}

/// A row without values that stands under `label`, where a contender does.
fn labelled_row(unit: &Unit<'_>, label: &str) -> Row {
    Row {
        key: key(unit, label),
        seed: Some(unit.seed),
        status: Status::Crashed,
        reason: None,
        values: Values::default(),
    }
}
