//! Groups of problems drawn from one family.

use super::choice::{Change, Interpretation};
use super::contender::SweepPoint;
use super::error::StudyError;
use super::family::{Entry, Family};
use super::inputs::Inputs;
use super::key::SweepKey;
use super::verification::CORNER_COLUMNS;
use base::settings::{Settings, SettingsError};
use std::sync::Arc;
use toml::Table;

/// A group of problems.
#[derive(Debug, Clone)]
pub struct Group {
    /// Its name in records.
    pub label: String,
    /// Its number among the study's groups as they are written, from 0.
    pub place: usize,
    /// The family they are drawn from.
    pub family: &'static Entry,
    /// How many independent instances.
    pub instances: u32,
    /// The name of its instances, if it shares them with other groups.
    pub shared_instances: Option<String>,
    /// Whether the spec asks for more than one instance: their names then carry a number.
    pub is_numbered: bool,
    /// What it lays over the settings of planners and stages, if anything.
    pub stage: Option<Change>,
    /// The family's settings.
    pub settings: Settings,
    /// The points of the sweeps over its settings; one empty point without such sweeps.
    pub points: Vec<SweepPoint>,
    /// The names of the queries of every instance; none where the family could not be built.
    pub queries: Vec<String>,
    /// Whether the seed decides anything of what is posed.
    pub is_drawn: bool,
    /// The noun for its instances, in the plural.
    pub noun: &'static str,
}

impl Group {
    /// The point of the sweeps over its settings that is called `key`; the first if none is.
    pub fn point(&self, key: &SweepKey) -> &SweepPoint {
        self.points.iter().find(|point| point.key == *key).unwrap_or(&self.points[0])
    }

    /// The interpretation `point` as contenders see it on its problems: on top of what the group lays over planners and stages.
    pub fn seen_by_contenders(&self, point: &Interpretation) -> Interpretation {
        self.stage.as_ref().map_or_else(|| point.clone(), |change| point.above(change))
    }

    /// The columns of trials on its problems: those of its family and, between corners of cells, the length of a shortest path.
    pub fn columns(&self) -> impl Iterator<Item = &'static str> {
        let is_cornered =
            self.settings.table().get("vertices").and_then(toml::Value::as_str) == Some("corners");
        let more = if is_cornered { CORNER_COLUMNS } else { &[] };
        self.family.columns.iter().chain(more).copied()
    }

    /// The family at the point `at` of the sweeps, under the interpretation `point`.
    ///
    /// # Errors
    /// A settings error of the family, or an input file that is missing or wrong.
    pub fn family(
        &self,
        at: &SweepPoint,
        point: &Interpretation,
        inputs: &Inputs,
    ) -> Result<Box<dyn Family>, StudyError> {
        (self.family.build)(&self.settings_under(at, point), inputs)
    }

    /// Builds its family from `settings`, to find faults. Faults of a file that they name are reported elsewhere.
    ///
    /// # Errors
    /// Those of the settings.
    pub fn built(&self, settings: &Settings, inputs: &Inputs) -> Result<(), SettingsError> {
        match (self.family.build)(settings, inputs) {
            Err(StudyError::Settings(error)) => Err(error),
            _ => Ok(()),
        }
    }

    /// The family's settings under an interpretation, with those of the point `at` of the sweeps on top.
    pub fn settings_under(&self, at: &SweepPoint, interpretation: &Interpretation) -> Settings {
        let read = interpretation.over_problem(self.settings.clone(), |over| self.accepts(over));
        at.over_problem(read)
    }

    /// Whether `over` sets something, and the family has all that it sets.
    pub fn accepts(&self, over: &Table) -> bool {
        !over.is_empty() && over.keys().all(|key| self.family.settings.has(key))
    }
}

/// Families that were built: most options change no problem, so that one family serves many of them.
#[derive(Default)]
pub struct Families {
    built: Vec<(&'static Entry, Table, Arc<dyn Family>)>,
}

impl Families {
    /// The family of `group` at the point `at` of the sweeps, under the interpretation `point`, built if it was not yet.
    ///
    /// # Errors
    /// Those of [`Group::family`].
    pub fn family(
        &mut self,
        (group, at): (&Group, &SweepPoint),
        point: &Interpretation,
        inputs: &Inputs,
    ) -> Result<Arc<dyn Family>, StudyError> {
        let settings = group.settings_under(at, point);
        let is_it = |(entry, table, _): &&(&'static Entry, Table, Arc<dyn Family>)| {
            std::ptr::eq(*entry, group.family) && table == settings.table()
        };
        if let Some((_, _, family)) = self.built.iter().find(is_it) {
            return Ok(family.clone());
        }
        let family: Arc<dyn Family> = (group.family.build)(&settings, inputs)?.into();
        self.built.push((group.family, settings.table().clone(), family.clone()));
        Ok(family)
    }
}
