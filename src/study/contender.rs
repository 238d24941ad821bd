//! Contenders: pipelines of a planner and stages under a label, at one point of the sweeps.

use super::choice::{Choice, Interpretation};
use super::key::{SweepKey, SweepValue};
use super::{name, planner};
use base::settings::{Faults, Place, Settings, SettingsError};
use engine::planner::{Build, Entry, Invalid, Plan, Planner, Request, Stage};
use std::collections::BTreeMap;
use std::mem::discriminant;
use std::ops::Range;
use std::sync::Arc;
use toml::Table;

/// A pipeline under a label.
#[derive(Debug, Clone)]
pub struct Contender {
    /// Its name in records and tables.
    pub label: String,
    /// Its number among the study's contenders as they are written, from 0.
    pub place: usize,
    /// How many seeds it runs on each problem.
    pub repeats: u32,
    /// Whether the spec asks for more than one seed: the trials' names then carry a number.
    pub is_numbered: bool,
    /// The planner, then the stages that tidy its plan.
    pub stages: Vec<StageUse>,
    /// Choices that its settings do not take from the interpretation, each with the option taken in its place.
    pub departs: BTreeMap<String, String>,
}

/// An entry of the planner registry with its settings.
#[derive(Debug, Clone)]
pub struct StageUse {
    /// The planner, or the stage that tidies a plan.
    pub entry: &'static Entry,
    /// Where the study names it.
    pub named: Range<usize>,
    /// The settings that the study gives it.
    pub settings: Settings,
}

/// A contender that is ready to run.
pub struct Pipeline {
    /// The planner built from its settings.
    pub planner: Box<dyn Planner>,
    /// The stages that tidy its plan.
    pub stages: Vec<Box<dyn Stage>>,
}

impl Contender {
    /// Whether its trials are recorded and not repeated.
    pub fn is_recorded(&self) -> bool {
        self.stages.iter().any(|stage| planner::is_recorded(stage.entry))
    }

    /// Whether its trials were recorded elsewhere, and imported.
    pub fn is_elsewhere(&self) -> bool {
        self.stages.iter().any(|stage| stage.entry.name == planner::recorded::ENTRY.name)
    }

    /// Whether some option of `choice` sets something of its trials: of its stages, or of every problem.
    pub fn is_set_by(&self, choice: &Choice) -> bool {
        let uses = |name: &String| self.stages.iter().any(|stage| stage.entry.name == name);
        choice.options.values().any(|option| {
            !option.problem.is_empty()
                || option.stage.keys().any(uses)
                || option.contender.get(&self.label).is_some_and(|own| own.keys().any(uses))
        })
    }

    /// The pipeline under the interpretation `point` with the sweep's settings laid on top.
    ///
    /// # Errors
    /// The settings errors of all entries.
    pub fn pipeline(&self, point: &Interpretation, sweep: &SweepPoint) -> Result<Pipeline, SettingsError> {
        let mut planner = None;
        let mut stages = Vec::new();
        let mut faults = Faults::default();
        for stage in &self.stages {
            let settings = stage.effective(&self.label, point, sweep);
            match stage.entry.build {
                Build::Planner(build) => planner = faults.keep(build(&settings)),
                Build::Stage(build) => stages.extend(faults.keep(build(&settings))),
            }
        }
        faults.done()?;
        let planner = planner.expect("a checked contender starts with a planner");
        Ok(Pipeline { planner, stages })
    }
}

/// Pipelines that were built: most options change few contenders, so that one pipeline serves many interpretations.
#[derive(Default)]
pub struct Pipelines {
    built: Vec<(usize, Vec<Table>, Arc<Pipeline>)>,
}

impl Pipelines {
    /// The pipeline of `contender` under the interpretation `point` with the sweep's settings laid on top, built if it was not yet.
    ///
    /// # Errors
    /// Those of [`Contender::pipeline`].
    pub fn pipeline(
        &mut self,
        contender: &Contender,
        point: &Interpretation,
        sweep: &SweepPoint,
    ) -> Result<Arc<Pipeline>, SettingsError> {
        let settings = |stage: &StageUse| stage.effective(&contender.label, point, sweep).table().clone();
        let settings: Vec<Table> = contender.stages.iter().map(settings).collect();
        let is_it = |(place, tables, _): &&(usize, Vec<Table>, Arc<Pipeline>)| {
            *place == contender.place && *tables == settings
        };
        if let Some((_, _, pipeline)) = self.built.iter().find(is_it) {
            return Ok(pipeline.clone());
        }
        let pipeline = Arc::new(contender.pipeline(point, sweep)?);
        self.built.push((contender.place, settings, pipeline.clone()));
        Ok(pipeline)
    }
}

impl StageUse {
    /// Whether it can be built from `settings`.
    ///
    /// # Errors
    /// Those of its entry.
    pub fn built(&self, settings: &Settings) -> Result<(), SettingsError> {
        match self.entry.build {
            Build::Planner(build) => build(settings).map(drop),
            Build::Stage(build) => build(settings).map(drop),
        }
    }

    /// Its settings in the contender called `label` with the interpretation's and the sweep's laid on top.
    pub fn effective(&self, label: &str, interpretation: &Interpretation, sweep: &SweepPoint) -> Settings {
        let read = interpretation.over_stage(label, self.entry.name, self.settings.clone());
        sweep.over_stage(self.entry.name, read)
    }
}

/// A factor that the paper varies.
#[derive(Debug, Clone)]
pub struct Sweep {
    /// The setting.
    pub key: String,
    /// Whose setting it is.
    pub whose: Swept,
    /// Its number among the study's sweeps as they are written, from 0.
    pub number: usize,
    /// Its values, in the paper's order.
    pub values: Vec<toml::Value>,
    /// Whether its values are drawn within an instance.
    pub nested: bool,
    /// Where it stands.
    pub place: Place,
}

/// Whose setting a sweep varies.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Swept {
    /// That of a planner or stage.
    Stage(String),
    /// That of problem groups, by label; `*` at the end stands for any ending.
    Problems(Vec<String>),
}

impl Sweep {
    /// The planner or stage whose setting it is.
    pub fn entry(&self) -> Option<&str> {
        match &self.whose {
            Swept::Stage(name) => Some(name),
            Swept::Problems(_) => None,
        }
    }

    /// Whether it varies a setting of the problem group called `label`.
    pub fn is_over(&self, label: &str) -> bool {
        let is_meant = |pattern: &String| match pattern.strip_suffix('*') {
            Some(beginning) => label.starts_with(beginning),
            None => pattern == label,
        };
        matches!(&self.whose, Swept::Problems(patterns) if patterns.iter().any(is_meant))
    }

    /// Its values as records have them: all of one kind, words where kinds are mixed; `None` for a value that is neither a
    /// number nor a word nor a truth value.
    pub fn key_values(&self) -> Option<Vec<SweepValue>> {
        let value = |value: &toml::Value| match value {
            toml::Value::Boolean(flag) => Some(SweepValue::Flag(*flag)),
            toml::Value::Integer(whole) => Some(SweepValue::Whole(*whole)),
            toml::Value::Float(real) => Some(SweepValue::Real(*real)),
            toml::Value::String(text) => Some(SweepValue::Text(text.as_str().into())),
            _ => None,
        };
        let mut values = self.values.iter().map(value).collect::<Option<Vec<_>>>()?;
        let is_one_kind = values.windows(2).all(|two| discriminant(&two[0]) == discriminant(&two[1]));
        let are_numbers = values.iter().all(|value| value.as_f64().is_some());
        for value in values.iter_mut().filter(|_| !is_one_kind) {
            *value = match value.as_f64().filter(|_| are_numbers) {
                Some(number) => SweepValue::Real(number),
                None => SweepValue::Text(value.to_string().into()),
            };
        }
        Some(values)
    }
}

/// One value of each of some sweeps.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SweepPoint {
    /// What names it in records; empty without sweeps.
    pub key: SweepKey,
    /// What it lays over settings and where that stands, by planner or stage; over problems under an empty name.
    over: BTreeMap<String, (Table, Vec<Place>)>,
}

impl SweepPoint {
    /// Every combination of the values of `sweeps`, the first sweep varying slowest; one empty point without sweeps.
    pub fn all<'s>(sweeps: impl Iterator<Item = &'s Sweep>) -> Vec<Self> {
        let mut points = vec![Self::default()];
        for sweep in sweeps {
            let values = sweep.key_values().expect("a checked sweep has values that records can have");
            let values: Vec<_> = values.into_iter().zip(&sweep.values).enumerate().collect();
            let with = |point: &Self, (index, (value, written)): &(usize, (SweepValue, &toml::Value))| {
                let mut next = point.clone();
                next.key = point.key.and(&SweepKey::new(vec![(sweep.key.as_str().into(), value.clone())]));
                let (over, places) =
                    next.over.entry(sweep.entry().unwrap_or_default().to_owned()).or_default();
                over.insert(sweep.key.clone(), (*written).clone());
                places.push(sweep.place.of_value(&sweep.key, &["key"], &["values", &index.to_string()]));
                next
            };
            points =
                points.iter().flat_map(|point| values.iter().map(move |value| with(point, value))).collect();
        }
        points
    }

    /// What lies in both: `other` is a point of other sweeps.
    #[must_use]
    pub fn and(&self, other: &Self) -> Self {
        let over = self.over.clone().into_iter().chain(other.over.clone()).collect();
        Self { key: self.key.and(&other.key), over }
    }

    /// The settings of a problem with what it lays over them.
    #[must_use]
    pub fn over_problem(&self, settings: Settings) -> Settings {
        self.over_stage("", settings)
    }

    /// The settings of the planner or stage called `entry` with what it lays over them.
    #[must_use]
    pub fn over_stage(&self, entry: &str, settings: Settings) -> Settings {
        match self.over.get(entry) {
            Some((table, places)) => {
                settings.overlaid_from(table, &format!("sweep {}", name::sweep(&self.key)), places.clone())
            }
            None => settings,
        }
    }
}

impl Pipeline {
    /// Runs the planner and, on its plan, every stage.
    ///
    /// # Errors
    /// [`Invalid`] if the planner says that the query cannot be posed.
    pub fn plan(&self, request: &Request<'_>) -> Result<Plan, Invalid> {
        let plan = self.planner.plan(request)?;
        Ok(self.stages.iter().fold(plan, |plan, stage| stage.refine(request, plan)))
    }
}
