//! Tasks: what a study does with its problems and contenders; one a file, all in [`REGISTRY`].

mod formula_error;
mod plan;

use super::checked::Study;
use super::record::Batch;
use super::runner::Unit;
use crate::settings::{Settings, SettingsError};

/// A task with its settings.
pub trait Task: Send + Sync {
    /// Does one unit of work: everything that shares one prepared object.
    fn run(&self, study: &Study, unit: &Unit<'_>) -> Batch;

    /// The names of the unit's trials: one a query, racer and repeat, unless the task does something else.
    fn trials(&self, unit: &Unit<'_>) -> Vec<String> {
        let mut trials = Vec::new();
        for query in &unit.queries() {
            for racer in unit.racers {
                trials.extend((0..racer.contender.repeats).map(|repeat| unit.trial(query, racer, repeat)));
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
