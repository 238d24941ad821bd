//! From a spec to checked types: what is wrong is said with file, line, column, what was found and what is accepted.

use super::super::spec::{ContenderSpec, ProblemsSpec, ReadingSpec, StageSpec, StudySpec, SweepSpec};
use super::super::{family, task};
use super::{
    Build, Contender, Families, Family, Group, Inputs, Reading, ReadingChoice, Settings, StageUse, Study,
    StudyError, Sweep, SweepPoint, slug,
};
use base::settings::{Document, SettingsError};
use engine::planner;
use engine::space::roadmap::Extent;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;
use std::sync::Arc;
use toml::{Spanned, Table};

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
        Ok(Self {
            name,
            paper: spec.paper.into_inner(),
            question: spec.question,
            seed: spec.seed,
            task,
            task_settings: optional(
                document,
                spec.task_settings.as_ref(),
                spec.task.as_ref().map_or(0, |task| task.span().start),
                "task_settings",
            ),
            searched: spec.searched,
            fitted_to: spec.fitted_to.into_iter().map(Spanned::into_inner).collect(),
            groups: spec.problems.iter().map(|p| group(document, p)).collect::<Result<_, _>>()?,
            contenders: spec.contenders.iter().map(|c| contender(document, c)).collect::<Result<_, _>>()?,
            sweeps: spec.sweeps.into_iter().map(sweep).collect(),
            readings: spec.readings.into_iter().map(reading).collect(),
            explore: spec.explore,
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
        let path = self.document.path();
        let absolute = fs::canonicalize(path).map_err(StudyError::io(path, "opening the study"))?;
        let folder = absolute.parent().and_then(Path::file_name).unwrap_or_default().to_string_lossy();
        if folder != self.paper {
            let message =
                format!("`paper` is `{}`, but the study lies in the folder of `{folder}`", self.paper);
            return Err(self.document.error(self.key_span("paper"), message).into());
        }
        if [Some(self.budget), self.quick.budget].iter().flatten().any(|budget| budget.expansions == 0) {
            let message = "expansions is 0; a budget of at least 1 is accepted";
            return Err(self.document.error(self.key_span("expansions"), message).into());
        }
        (self.task.build)(&self.task_settings)?;
        (self.task.build)(&self.quick_task_settings())?;
        self.check_sweeps()?;
        self.check_selections()?;
        let mut families = Families::default();
        let points = self.single_options()?;
        points.iter().try_for_each(|point| self.check_point(point, inputs, &mut families))?;
        self.check_ends(&points[0], inputs, &mut families)
    }

    /// Refuses problems whose start or goal is in collision under the default reading.
    ///
    /// Under other readings, and in groups that vary another group of their family, an end may be in collision: the
    /// trials are then rows that say so.
    fn check_ends(
        &self,
        default: &ReadingChoice,
        inputs: &Inputs,
        families: &mut Families,
    ) -> Result<(), StudyError> {
        let mut posed = BTreeMap::new();
        for group in &self.groups {
            let ends = families.of(group, default, inputs)?.check_ends();
            let of_family = posed.entry(group.family.name).or_insert(ends.clone());
            if ends.is_ok() {
                *of_family = ends;
            }
        }
        Ok(posed.into_values().collect::<Result<(), _>>()?)
    }

    fn check_point(
        &self,
        point: &ReadingChoice,
        inputs: &Inputs,
        families: &mut Families,
    ) -> Result<(), StudyError> {
        let of = |group| families.of(group, point, inputs);
        let families: Vec<Arc<dyn Family>> = self.groups.iter().map(of).collect::<Result<_, _>>()?;
        let kinds: BTreeSet<_> = families.iter().map(|family| family.world()).collect();
        for contender in &self.contenders {
            for sweep in self.sweep_points() {
                let planner = contender.pipeline(point, &sweep)?.planner;
                self.check_extent(contender, &sweep, planner.asks(), &families)?;
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
        Ok(())
    }

    /// A planner that asks for more of a roadmap than there is would make nothing but invalid rows.
    fn check_extent(
        &self,
        contender: &Contender,
        sweep: &SweepPoint,
        asked: Option<Extent>,
        families: &[Arc<dyn Family>],
    ) -> Result<(), StudyError> {
        for (group, family) in self.groups.iter().zip(families) {
            let lack = asked.zip(family.extent()).and_then(|(asked, built)| built.lacks(&asked));
            let Some(lack) = lack else { continue };
            let swept = if sweep.name.is_empty() { String::new() } else { format!(" at {}", sweep.name) };
            let message =
                format!("contender `{}`{swept} on problems `{}`: {lack}", contender.label, group.label);
            return Err(contender.stages[0].settings.error(message).into());
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

    /// Where `key` is first set, or its first table; comments may have the word as well.
    pub(super) fn key_span(&self, key: &str) -> std::ops::Range<usize> {
        let text = self.document.text();
        let begins_line =
            |at: &usize| text[..*at].rsplit('\n').next().is_some_and(|line| line.trim().is_empty());
        let is_set = |at: &usize| text[*at + key.len()..].trim_start().starts_with('=');
        let places = || text.match_indices(key).map(|(at, _)| at).filter(is_set);
        let table = || text.find(&format!("[{key}"));
        let at = places().find(begins_line).or_else(|| places().next()).or_else(table).unwrap_or(0);
        at..at + key.len()
    }

    fn text_span(&self, text: &str) -> std::ops::Range<usize> {
        let at = self.document.text().rfind(&format!("\"{text}\"")).unwrap_or(0);
        at..at + text.len()
    }
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

/// The settings in `table`; without it, empty ones of what is named at byte `at`.
fn optional(document: &Arc<Document>, table: Option<&Spanned<Table>>, at: usize, whose: &str) -> Settings {
    let Some(table) = table else {
        let line = document.text()[..at].matches('\n').count() + 1;
        return Settings::composed(format!("{}:{line}: {whose}", document.path().display()), Table::new());
    };
    Settings::written(document, table)
}

fn sweep(spec: SweepSpec) -> Sweep {
    Sweep { key: spec.key.into_inner(), of: spec.of.into_inner(), values: spec.values.into_inner() }
}

fn reading(spec: ReadingSpec) -> Reading {
    Reading {
        id: spec.id.into_inner(),
        why: spec.why,
        default: spec.default.into_inner(),
        options: spec
            .option
            .into_inner()
            .into_iter()
            .map(|(name, option)| (name, Arc::new(option)))
            .collect(),
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
        draw: spec.draw.clone(),
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
    Ok(Contender {
        label: label.clone(),
        repeats,
        is_numbered: repeats > 1,
        stages,
        departs: spec.departs.clone(),
    })
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
    let whose = format!("contender `{label}`, {what} `{}`", entry.name);
    let settings = optional(document, settings, name.span().start, &whose);
    Ok(StageUse { entry, settings })
}
