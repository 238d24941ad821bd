//! Checked studies: every name is looked up, every settings table is understood, before a trial runs.

mod load;

use super::error::StudyError;
use super::family::{self, Family};
use super::reading::{self, Reading, ReadingChoice};
use super::spec::{BudgetSpec, ExploreSpec, FigureSpec, QuickSpec, TimingSpec, TrialsSpec};
use super::{Inputs, task};
use base::seed;
use base::settings::{Document, Settings, SettingsError};
use engine::planner::{self, Build, Planner, Stage};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use toml::Table;

/// A checked study.
#[derive(Debug, Clone)]
pub struct Study {
    /// Its name: the stem of its file.
    pub name: String,
    /// The paper's name: the folder's.
    pub paper: String,
    /// The question it answers.
    pub question: String,
    /// The root of every seed.
    pub seed: u64,
    /// What is done with the problems.
    pub task: &'static task::Entry,
    /// The task's settings.
    pub task_settings: Settings,
    /// Inputs were searched for.
    pub searched: bool,
    /// Claims that something was fitted to.
    pub fitted_to: Vec<String>,
    /// Groups of problems.
    pub groups: Vec<Group>,
    /// What is compared.
    pub contenders: Vec<Contender>,
    /// Factors that the paper varies.
    pub sweeps: Vec<Sweep>,
    /// The readings.
    pub readings: Vec<Reading>,
    /// Makes a plain run cover other readings than the defaults.
    pub explore: Option<ExploreSpec>,
    /// Limits on each trial.
    pub budget: BudgetSpec,
    /// How clocks are read.
    pub timing: Option<TimingSpec>,
    /// Trials whose exhibits are kept.
    pub keeps: Vec<TrialsSpec>,
    /// What `--quick` cuts down to.
    pub quick: QuickSpec,
    /// Figures drawn from it.
    pub figures: Vec<FigureSpec>,
    /// The file it was read from.
    pub document: Arc<Document>,
}

/// A group of problems.
#[derive(Debug, Clone)]
pub struct Group {
    /// Its name in records.
    pub label: String,
    /// The family they are drawn from.
    pub family: &'static family::Entry,
    /// How many independent draws.
    pub replicates: u32,
    /// The name of its draws, if it shares them with other groups.
    pub draw: Option<String>,
    /// Whether the spec asks for more than one draw: their names then carry a number.
    pub is_numbered: bool,
    /// The family's settings.
    pub settings: Settings,
}

impl Group {
    /// The family under the reading `point`.
    ///
    /// # Errors
    /// A settings error of the family, or an input file that is missing or wrong.
    pub fn family(&self, point: &ReadingChoice, inputs: &Inputs) -> Result<Box<dyn Family>, StudyError> {
        (self.family.build)(&self.settings_under(point), inputs)
    }

    fn settings_under(&self, point: &ReadingChoice) -> Settings {
        point
            .over_problem()
            .fold(self.settings.clone(), |settings, (over, origin)| settings.overlaid(over, origin))
    }
}

/// Families that were built: most readings change no problem, so that one family serves many of them.
#[derive(Default)]
pub struct Families {
    built: Vec<(&'static family::Entry, Table, Arc<dyn Family>)>,
}

impl Families {
    /// The family of `group` under the reading `point`, built if it was not yet.
    ///
    /// # Errors
    /// Those of [`Group::family`].
    pub fn of(
        &mut self,
        group: &Group,
        point: &ReadingChoice,
        inputs: &Inputs,
    ) -> Result<Arc<dyn Family>, StudyError> {
        let settings = group.settings_under(point);
        let is_it = |(entry, table, _): &&(&'static family::Entry, Table, Arc<dyn Family>)| {
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

/// A pipeline under a label.
#[derive(Debug, Clone)]
pub struct Contender {
    /// Its name in records and tables.
    pub label: String,
    /// How many seeds it runs on each problem.
    pub repeats: u32,
    /// Whether the spec asks for more than one seed: the trials' names then carry a number.
    pub is_numbered: bool,
    /// The planner, then the stages that tidy its plan.
    pub stages: Vec<StageUse>,
    /// Readings, with the option, that its settings take in place of the one in hand.
    pub departs: BTreeMap<String, String>,
}

/// An entry of the planner registry with its settings.
#[derive(Debug, Clone)]
pub struct StageUse {
    /// The entry.
    pub entry: &'static planner::Entry,
    /// Its settings.
    pub settings: Settings,
}

/// A contender that is ready to run.
pub struct Pipeline {
    /// The planner.
    pub planner: Box<dyn Planner>,
    /// The stages that tidy its plan.
    pub stages: Vec<Box<dyn Stage>>,
}

impl Contender {
    /// The pipeline under the reading `point` with the sweep's settings laid on top.
    ///
    /// # Errors
    /// A settings error of an entry.
    pub fn pipeline(&self, point: &ReadingChoice, sweep: &SweepPoint) -> Result<Pipeline, SettingsError> {
        let mut planner = None;
        let mut stages = Vec::new();
        for stage in &self.stages {
            let settings = stage.effective(point, sweep);
            match stage.entry.build {
                Build::Planner(build) => planner = Some(build(&settings)?),
                Build::Stage(build) => stages.push(build(&settings)?),
            }
        }
        let planner = planner.expect("a checked contender starts with a planner");
        Ok(Pipeline { planner, stages })
    }
}

impl StageUse {
    /// Its settings with the reading's and the sweep's laid on top.
    pub fn effective(&self, point: &ReadingChoice, sweep: &SweepPoint) -> Settings {
        let read = point
            .over_stage(self.entry.name)
            .fold(self.settings.clone(), |settings, (over, origin)| settings.overlaid(over, origin));
        match sweep.over.get(self.entry.name) {
            Some(table) => read.overlaid(table, &format!("sweep {}", sweep.name)),
            None => read,
        }
    }
}

/// A factor that the paper varies.
#[derive(Debug, Clone)]
pub struct Sweep {
    /// The setting.
    pub key: String,
    /// The planner or stage whose setting it is.
    pub of: String,
    /// Its values, in the paper's order.
    pub values: Vec<toml::Value>,
}

/// One value of every sweep.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SweepPoint {
    /// Its name in records; empty without sweeps.
    pub name: String,
    over: BTreeMap<String, Table>,
}

impl Study {
    /// The default point and, for every other option, the point that differs in it alone.
    ///
    /// # Errors
    /// A reading whose default is not among its options.
    pub fn single_options(&self) -> Result<Vec<ReadingChoice>, StudyError> {
        self.points(0)
    }

    /// Every point that the study explores if it is asked to: [`single_options`](Self::single_options) and the
    /// sample of their product that the spec asks for.
    ///
    /// # Errors
    /// As [`single_options`](Self::single_options).
    pub fn explored(&self) -> Result<Vec<ReadingChoice>, StudyError> {
        self.points(self.explore.map_or(0, |explore| explore.sample))
    }

    /// The points of [`explored`](Self::explored) as trials see them: those that run the same trials appear once.
    ///
    /// # Errors
    /// As [`single_options`](Self::single_options).
    pub fn trial_points(&self) -> Result<Vec<ReadingChoice>, StudyError> {
        let mut points: Vec<ReadingChoice> = Vec::new();
        for point in self.explored()? {
            let point = point.for_trials(&self.readings);
            if !points.contains(&point) {
                points.push(point);
            }
        }
        Ok(points)
    }

    fn points(&self, sample: u32) -> Result<Vec<ReadingChoice>, StudyError> {
        let seed = seed::derive(self.seed, &[&self.paper, &self.name, "explore"]);
        reading::explored(&self.readings, sample, seed)
            .map_err(|message| StudyError::from(self.document.error(self.key_span("reading"), message)))
    }

    /// Every combination of the sweeps' values, the first sweep varying slowest; one empty point without sweeps.
    pub fn sweep_points(&self) -> Vec<SweepPoint> {
        self.sweeps.iter().fold(vec![SweepPoint::default()], |points, sweep| {
            let with = |point: &SweepPoint, value: &toml::Value| {
                let mut next = point.clone();
                next.over.entry(sweep.of.clone()).or_default().insert(sweep.key.clone(), value.clone());
                let comma = if next.name.is_empty() { "" } else { "," };
                next.name += &format!("{comma}{}={}", sweep.key, value.to_string().trim_matches('"'));
                next
            };
            points.iter().flat_map(|point| sweep.values.iter().map(move |value| with(point, value))).collect()
        })
    }

    /// Every column that its records can have.
    pub fn columns(&self) -> BTreeSet<&'static str> {
        let counted = self.contenders.iter().flat_map(|c| &c.stages).flat_map(|stage| stage.entry.columns);
        let posed = self.groups.iter().flat_map(|group| group.family.columns);
        let timed = self.timing.iter().flat_map(|_| [super::clock::COLUMN].iter());
        counted.chain(posed).chain(self.task.columns).chain(timed).copied().collect()
    }

    /// Which trials on the problem group `group` keep their exhibits: those that figures show, and `keep`.
    pub fn kept(&self, group: &str) -> impl Iterator<Item = &TrialsSpec> {
        let shown = self.figures.iter().flat_map(|figure| &figure.shows);
        shown.chain(&self.keeps).filter(move |trials| trials.problems == group)
    }

    /// The study cut down to what `--quick` keeps.
    #[must_use]
    pub fn quick(mut self) -> Self {
        for group in &mut self.groups {
            group.replicates = group.replicates.min(self.quick.replicates);
        }
        for contender in &mut self.contenders {
            contender.repeats = contender.repeats.min(self.quick.repeats.unwrap_or(u32::MAX));
        }
        self.budget = self.quick.budget.unwrap_or(self.budget);
        self.timing = self.timing.map(|full| self.quick.timing.unwrap_or(full));
        self.task_settings = self.quick_task_settings();
        self
    }

    fn quick_task_settings(&self) -> Settings {
        let over = self.quick.task_settings.as_ref();
        over.map_or_else(|| self.task_settings.clone(), |over| self.task_settings.overlaid(over, "--quick"))
    }
}

/// `label` in lower case with everything but letters and digits turned into dashes, `*` spelled out: part of a
/// trial's name that any shell takes as it is.
pub fn slug(label: &str) -> String {
    let spelled = label.to_lowercase().replace('*', "-star").replace('+', "-plus");
    let dashed: String = spelled.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).collect();
    dashed.split('-').filter(|part| !part.is_empty()).collect::<Vec<_>>().join("-")
}
