//! From a spec to checked types: every name is looked up, every settings table is understood, before a trial runs.

use super::error::StudyError;
use super::family::{self, Family};
use super::reading::{Point, Reading};
use super::spec::{
    BudgetSpec, ContenderSpec, FigureSpec, ProblemsSpec, QuickSpec, StageSpec, StudySpec, TimingSpec,
    TrialsSpec,
};
use super::{Inputs, task};
use crate::planner::{self, Build, Planner, Stage};
use crate::settings::{Document, Settings, SettingsError};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::Arc;
use toml::{Spanned, Table};

/// A checked study.
#[derive(Debug)]
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
#[derive(Debug)]
pub struct Group {
    /// Its name in records.
    pub label: String,
    /// The family they are drawn from.
    pub family: &'static family::Entry,
    /// How many independent draws.
    pub replicates: u32,
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
    pub fn family(&self, point: &Point, inputs: &Inputs) -> Result<Box<dyn Family>, StudyError> {
        let settings = point
            .over_problem()
            .fold(self.settings.clone(), |settings, (over, origin)| settings.overlaid(over, origin));
        (self.family.build)(&settings, inputs)
    }
}

/// A pipeline under a label.
#[derive(Debug)]
pub struct Contender {
    /// Its name in records and tables.
    pub label: String,
    /// How many seeds it runs on each problem.
    pub repeats: u32,
    /// Whether the spec asks for more than one seed: the trials' names then carry a number.
    pub is_numbered: bool,
    /// The planner, then the stages that tidy its plan.
    pub stages: Vec<StageUse>,
}

/// An entry of the planner registry with its settings.
#[derive(Debug)]
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
    pub fn pipeline(&self, point: &Point, sweep: &SweepPoint) -> Result<Pipeline, SettingsError> {
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
    pub fn effective(&self, point: &Point, sweep: &SweepPoint) -> Settings {
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
#[derive(Debug)]
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
    /// Reads and checks the study in `path`.
    ///
    /// # Errors
    /// Every name that does not exist, every settings table that its entry does not understand, every label
    /// that is used twice: with file, line, column, what was found and what is accepted.
    pub fn load(path: &Path, inputs: &Inputs) -> Result<Self, StudyError> {
        let document = Document::open(path)?;
        let spec: StudySpec = document.read()?;
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let study = Self::resolve(name, spec, &document)?;
        study.check(inputs)?;
        Ok(study)
    }

    fn resolve(name: String, spec: StudySpec, document: &Arc<Document>) -> Result<Self, StudyError> {
        unique(document, "problem group", spec.problems.iter().map(|p| &p.label))?;
        unique(document, "contender", spec.contenders.iter().map(|c| &c.label))?;
        unique(document, "reading", spec.readings.iter().map(|r| &r.id))?;
        unique(document, "figure", spec.figures.iter().map(|f| &f.id))?;
        let task = match &spec.task {
            None => task::default(),
            Some(task) => look_up(document, "task", task, task::find, task::REGISTRY.iter().map(|e| e.name))?,
        };
        let sweeps = spec.sweeps.into_iter().map(|s| Sweep {
            key: s.key.into_inner(),
            of: s.of.into_inner(),
            values: s.values.into_inner(),
        });
        let readings = spec.readings.into_iter().map(|r| Reading {
            id: r.id.into_inner(),
            why: r.why,
            default: r.default.into_inner(),
            options: r.option.into_inner(),
        });
        Ok(Self {
            name,
            paper: spec.paper.into_inner(),
            question: spec.question,
            seed: spec.seed,
            task,
            task_settings: optional(document, spec.task_settings.as_ref(), "task_settings"),
            searched: spec.searched,
            fitted_to: spec.fitted_to.into_iter().map(Spanned::into_inner).collect(),
            groups: spec.problems.iter().map(|p| group(document, p)).collect::<Result<_, _>>()?,
            contenders: spec.contenders.iter().map(|c| contender(document, c)).collect::<Result<_, _>>()?,
            sweeps: sweeps.collect(),
            readings: readings.collect(),
            budget: spec.budget,
            timing: spec.timing,
            keeps: spec.keeps,
            quick: spec.quick,
            figures: spec.figures,
            document: document.clone(),
        })
    }

    /// Builds everything once under every single option, so that nothing can fail for its settings later.
    fn check(&self, inputs: &Inputs) -> Result<(), StudyError> {
        let folder = self.document.path().parent().and_then(Path::file_name).unwrap_or_default();
        if folder.to_string_lossy() != self.paper {
            let message = format!(
                "`paper` is `{}`, but the study lies in the folder of `{}`",
                self.paper,
                folder.display()
            );
            return Err(self.document.error(self.key_span("paper"), message).into());
        }
        (self.task.build)(&self.task_settings)?;
        self.check_sweeps()?;
        self.check_selections()?;
        for point in self.single_options()? {
            let mut kinds = BTreeSet::new();
            for group in &self.groups {
                kinds.insert(group.family(&point, inputs)?.world());
            }
            for contender in &self.contenders {
                for sweep in self.sweep_points() {
                    contender.pipeline(&point, &sweep)?;
                }
                for stage in &contender.stages {
                    if let Some(kind) = kinds.iter().find(|kind| !kind.serves(stage.entry.needs)) {
                        let message = format!(
                            "contender `{}` uses `{}`, which needs a {} world; the study's problems are of kind {}",
                            contender.label,
                            stage.entry.name,
                            stage.entry.needs.name(),
                            kind.name()
                        );
                        return Err(stage.settings.error(message).into());
                    }
                }
            }
        }
        Ok(())
    }

    fn check_sweeps(&self) -> Result<(), StudyError> {
        for sweep in &self.sweeps {
            let used: BTreeSet<&str> = self.stage_names();
            if !used.contains(sweep.of.as_str()) {
                let message = format!(
                    "sweep `{}` is over `{}`, which no contender uses; they use {}",
                    sweep.key,
                    sweep.of,
                    Vec::from_iter(used).join(", ")
                );
                return Err(self.document.error(self.key_span("sweep"), message).into());
            }
        }
        Ok(())
    }

    fn check_selections(&self) -> Result<(), StudyError> {
        let shown = self.figures.iter().flat_map(|figure| &figure.shows);
        for selection in shown.chain(&self.keeps) {
            let labels = || self.groups.iter().map(|g| g.label.as_str()).collect::<Vec<_>>().join(", ");
            if !self.groups.iter().any(|group| group.label == selection.problems) {
                let message =
                    format!("no problem group is called `{}`; they are {}", selection.problems, labels());
                return Err(self.document.error(self.text_span(&selection.problems), message).into());
            }
            let Some(wanted) = &selection.contender else { continue };
            if !self.contenders.iter().any(|contender| contender.label == *wanted) {
                let known: Vec<&str> = self.contenders.iter().map(|c| c.label.as_str()).collect();
                let message = format!("no contender is called `{wanted}`; they are {}", known.join(", "));
                return Err(self.document.error(self.text_span(wanted), message).into());
            }
        }
        Ok(())
    }

    fn stage_names(&self) -> BTreeSet<&'static str> {
        self.contenders.iter().flat_map(|c| &c.stages).map(|stage| stage.entry.name).collect()
    }

    /// The default point and, for every other option, the point that differs in it alone.
    ///
    /// # Errors
    /// A reading whose default is not among its options.
    pub fn single_options(&self) -> Result<Vec<Point>, StudyError> {
        let point = |other: BTreeMap<String, String>| {
            Point::new(&self.readings, &other)
                .map_err(|message| StudyError::from(self.document.error(self.key_span("reading"), message)))
        };
        let mut points = vec![point(BTreeMap::new())?];
        for reading in &self.readings {
            for option in reading.options.keys().filter(|option| **option != reading.default) {
                points.push(point([(reading.id.clone(), option.clone())].into())?);
            }
        }
        Ok(points)
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

    /// The study cut down to what `--quick` keeps.
    #[must_use]
    pub fn quick(mut self) -> Self {
        for group in &mut self.groups {
            group.replicates = group.replicates.min(self.quick.replicates);
        }
        for contender in &mut self.contenders {
            contender.repeats = contender.repeats.min(self.quick.repeats.unwrap_or(u32::MAX));
        }
        self
    }

    fn key_span(&self, key: &str) -> std::ops::Range<usize> {
        let at = self.document.text().find(key).unwrap_or(0);
        at..at + key.len()
    }

    fn text_span(&self, text: &str) -> std::ops::Range<usize> {
        let at = self.document.text().rfind(&format!("\"{text}\"")).unwrap_or(0);
        at..at + text.len()
    }
}

/// `label` in lower case with everything but letters and digits turned into dashes, `*` spelled out: part of a
/// trial's name that any shell takes as it is.
pub fn slug(label: &str) -> String {
    let spelled = label.to_lowercase().replace('*', "-star").replace('+', "-plus");
    let dashed: String = spelled.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).collect();
    dashed.split('-').filter(|part| !part.is_empty()).collect::<Vec<_>>().join("-")
}

fn unique<'a>(
    document: &Document,
    what: &str,
    labels: impl Iterator<Item = &'a Spanned<String>>,
) -> Result<(), SettingsError> {
    let mut seen = BTreeSet::new();
    for label in labels {
        let slug = slug(label.get_ref());
        if slug.is_empty() {
            let message = format!("{what} `{}` has no letter or digit in its name", label.get_ref());
            return Err(document.error(label.span(), message));
        }
        if !seen.insert(slug.clone()) {
            let message =
                format!("{what} `{}` is the second to be called `{slug}` in trial names", label.get_ref());
            return Err(document.error(label.span(), message));
        }
    }
    Ok(())
}

fn look_up<T>(
    document: &Document,
    what: &str,
    name: &Spanned<String>,
    find: impl Fn(&str) -> Option<T>,
    known: impl Iterator<Item = &'static str>,
) -> Result<T, SettingsError> {
    find(name.get_ref()).ok_or_else(|| {
        let known: Vec<&str> = known.collect();
        let message =
            format!("there is no {what} `{}`; the known ones are {}", name.get_ref(), known.join(", "));
        document.error(name.span(), message)
    })
}

fn optional(document: &Arc<Document>, table: Option<&Spanned<Table>>, whose: &str) -> Settings {
    match table {
        Some(table) => Settings::written(document, table),
        None => Settings::composed(format!("{}: {whose}", document.path().display()), Table::new()),
    }
}

fn group(document: &Arc<Document>, spec: &ProblemsSpec) -> Result<Group, SettingsError> {
    let known = family::REGISTRY.iter().map(|entry| entry.name);
    let replicates = spec.replicates.as_ref().map_or(1, |replicates| *replicates.get_ref());
    if let (0, Some(written)) = (replicates, &spec.replicates) {
        return Err(document.error(written.span(), "replicates is 0; at least 1 is accepted"));
    }
    Ok(Group {
        label: spec.label.get_ref().clone(),
        family: look_up(document, "problem family", &spec.family, family::find, known)?,
        replicates,
        is_numbered: replicates > 1,
        settings: Settings::written(document, &spec.settings),
    })
}

fn contender(document: &Arc<Document>, spec: &ContenderSpec) -> Result<Contender, SettingsError> {
    let label = spec.label.get_ref();
    let repeats = spec.repeats.as_ref().map_or(1, |repeats| *repeats.get_ref());
    if let (0, Some(written)) = (repeats, &spec.repeats) {
        return Err(document.error(written.span(), "repeats is 0; at least 1 is accepted"));
    }
    let mut stages = vec![stage(document, label, &spec.planner, spec.settings.as_ref(), true)?];
    for StageSpec { stage: name, settings } in &spec.then {
        stages.push(stage(document, label, name, settings.as_ref(), false)?);
    }
    Ok(Contender { label: label.clone(), repeats, is_numbered: repeats > 1, stages })
}

fn stage(
    document: &Arc<Document>,
    label: &str,
    name: &Spanned<String>,
    settings: Option<&Spanned<Table>>,
    first: bool,
) -> Result<StageUse, SettingsError> {
    let what = if first { "planner" } else { "stage" };
    let fits = |entry: &planner::Entry| matches!(entry.build, Build::Planner(_)) == first;
    let known: Vec<&str> = planner::REGISTRY.iter().filter(|e| fits(e)).map(|e| e.name).collect();
    let entry = planner::find(name.get_ref()).filter(|entry| fits(entry)).ok_or_else(|| {
        let message = format!(
            "contender `{label}` asks for {what} `{}`, which does not exist; the {what}s are {}",
            name.get_ref(),
            known.join(", ")
        );
        document.error(name.span(), message)
    })?;
    let settings = optional(document, settings, &format!("contender `{label}`, {what} `{}`", entry.name));
    Ok(StageUse { entry, settings })
}
