//! From a spec to checked types: what is wrong is said with file, line, column, what was found and what is accepted.

use super::super::contender::StageUse;
use super::super::error::StudyError;
use super::super::family::Family;
use super::super::group::Families;
use super::super::inputs::Inputs;
use super::super::name::{self, slug};
use super::super::spec::{ContenderSpec, ProblemsSpec, ReadingSpec, StageSpec, StudySpec, SweepSpec};
use super::super::{family, task};
use super::{Contender, Group, Reading, ReadingChoice, Settings, Study, Sweep, SweepPoint, each};
use base::settings::{Document, Faults, SettingsError, Spanned, did_you_mean, none_called};
use engine::planner::{self, Build};
use engine::space::roadmap::Extent;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;
use toml::Table;

impl Study {
    /// Reads and checks the study in `path`.
    ///
    /// # Errors
    /// Every name that does not exist, every settings table that its entry does not understand, every label
    /// that is used twice: all of them at once, each with file, line, column, what was found and what is accepted.
    pub fn load(path: &Path, inputs: &Inputs) -> Result<Self, StudyError> {
        let document = Document::open(path)?;
        let mut spec: StudySpec = document.read()?;
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let mut faults = Faults::default();
        spec.problems = each::expanded(spec.problems, &document, inputs, &mut faults);
        let study = Self::resolve(name, spec, &document, &mut faults);
        study.check(inputs, &mut faults)?;
        faults.done()?;
        Ok(study)
    }

    /// The study as far as its names exist; what does not goes to `faults`.
    fn resolve(name: String, spec: StudySpec, document: &Arc<Document>, faults: &mut Faults) -> Self {
        unique(document, "problem group", spec.problems.iter().map(|p| &p.label), faults);
        unique(document, "contender", spec.contenders.iter().map(|c| &c.label), faults);
        unique(document, "reading", spec.readings.iter().map(|r| &r.id), faults);
        unique(document, "figure", spec.figures.iter().map(|f| &f.id), faults);
        check_selections(&spec, document, faults);
        let named = spec
            .task
            .as_ref()
            .map(|task| look_up(document, "task", task, task::find, task::REGISTRY.iter().map(|e| e.name)));
        Self {
            name,
            paper: spec.paper.into_inner(),
            question: spec.question,
            seed: spec.seed,
            task: named.and_then(|named| faults.keep(named)).unwrap_or_else(task::default),
            task_settings: optional(
                document,
                spec.task_settings.as_ref(),
                spec.task.as_ref().map_or(0..0, Spanned::span),
                "task_settings",
            ),
            searched: spec.searched,
            fitted_to: spec.fitted_to.into_iter().map(Spanned::into_inner).collect(),
            groups: spec.problems.iter().filter_map(|p| faults.keep(group(document, p))).collect(),
            contenders: spec.contenders.iter().filter_map(|c| faults.keep(contender(document, c))).collect(),
            sweeps: spec.sweeps.into_iter().map(sweep).collect(),
            readings: spec.readings.into_iter().map(reading).collect(),
            explore: spec.explore,
            budget: spec.budget,
            timing: spec.timing,
            keeps: spec.keeps,
            quick: spec.quick,
            figures: spec.figures,
            document: document.clone(),
        }
    }

    /// Builds everything once under every single option, so that nothing can fail for its settings later.
    fn check(&self, inputs: &Inputs, faults: &mut Faults) -> Result<(), StudyError> {
        let path = self.document.path();
        let absolute = fs::canonicalize(path).map_err(StudyError::io(path, "opening the study"))?;
        let folder = absolute.parent().and_then(Path::file_name).unwrap_or_default().to_string_lossy();
        if folder != self.paper {
            let message =
                format!("`paper` is `{}`, but the study lies in the folder of `{folder}`", self.paper);
            faults.add(self.document.error_at("paper", message));
        }
        faults.keep((self.task.build)(&self.task_settings));
        faults.keep((self.task.build)(&self.quick_task_settings()));
        if faults.is_empty() {
            self.check_sweeps(faults);
        }
        if !self.check_defaults(faults) {
            return Ok(());
        }
        match self.single_options() {
            Ok(points) => {
                let mut known = Families::default();
                let mut check = |point| self.check_point(point, inputs, &mut known, faults);
                points.iter().try_for_each(&mut check)?;
                if faults.is_empty() {
                    self.check_ends(&points[0], inputs, &mut known, faults)
                } else {
                    Ok(())
                }
            }
            Err(error) => keep(faults, Err(error)).map(|_: Option<()>| ()),
        }
    }

    /// Whether each reading's default is one of its options.
    fn check_defaults(&self, faults: &mut Faults) -> bool {
        let mut is_right = true;
        for (index, reading) in self.readings.iter().enumerate() {
            let (id, default) = (&reading.id, &reading.default);
            if !reading.options.contains_key(default) {
                let known: Vec<&str> = reading.options.keys().map(String::as_str).collect();
                let hint = did_you_mean(default, known.iter().copied());
                let message =
                    format!("reading `{id}` has no option `{default}`{hint}; it has {}", known.join(", "));
                faults.add(self.document.error_at(&format!("reading.{index}.default"), message));
                is_right = false;
            }
        }
        is_right
    }

    /// Refuses problems whose start or goal is in collision under the default reading.
    ///
    /// Under other readings, and in groups that vary another group of their family, an end may be in collision: the
    /// trials are then rows that say so.
    fn check_ends(
        &self,
        default: &ReadingChoice,
        inputs: &Inputs,
        known: &mut Families,
        faults: &mut Faults,
    ) -> Result<(), StudyError> {
        let mut posed = BTreeMap::new();
        for group in &self.groups {
            let ends = known.of(group, default, inputs)?.check_ends();
            let of_family = posed.entry(group.family.name).or_insert(ends.clone());
            if ends.is_ok() {
                *of_family = ends;
            }
        }
        for ends in posed.into_values() {
            faults.keep(ends);
        }
        Ok(())
    }

    fn check_point(
        &self,
        point: &ReadingChoice,
        inputs: &Inputs,
        known: &mut Families,
        faults: &mut Faults,
    ) -> Result<(), StudyError> {
        let mut families: Vec<(&Group, Arc<dyn Family>)> = Vec::new();
        for group in &self.groups {
            families.extend(keep(faults, known.of(group, point, inputs))?.map(|family| (group, family)));
        }
        let kinds: BTreeSet<_> = families.iter().map(|(_, family)| family.world()).collect();
        for contender in &self.contenders {
            for sweep in self.sweep_points() {
                if let Some(pipeline) = faults.keep(contender.pipeline(point, &sweep)) {
                    faults.keep(check_extent(contender, &sweep, pipeline.planner.asks(), &families));
                }
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
                    faults.add(self.document.error(stage.named.clone(), message));
                }
            }
        }
        Ok(())
    }

    fn check_sweeps(&self, faults: &mut Faults) {
        let mut keys = BTreeSet::new();
        for (index, sweep) in self.sweeps.iter().enumerate() {
            let wrong = if sweep.key_values().is_none() {
                Some("has a value that is neither a number nor a word nor a truth value")
            } else {
                (!keys.insert(&sweep.key)).then_some("is the second over this setting; one is accepted")
            };
            if let Some(wrong) = wrong {
                let message = format!("sweep `{}` {wrong}", sweep.key);
                faults.add(self.document.error_at(&format!("sweep.{index}.key"), message));
                continue;
            }
            let used: BTreeSet<&str> = self.stage_names();
            if !used.contains(sweep.of.as_str()) {
                let hint = did_you_mean(&sweep.of, used.iter().copied());
                let message = format!(
                    "sweep `{}` is over `{}`, which no contender uses{hint}; they use {}",
                    sweep.key,
                    sweep.of,
                    Vec::from_iter(used).join(", ")
                );
                faults.add(self.document.error_at(&format!("sweep.{index}.of"), message));
            }
        }
    }

    fn stage_names(&self) -> BTreeSet<&'static str> {
        self.contenders.iter().flat_map(|c| &c.stages).map(|stage| stage.entry.name).collect()
    }
}

/// The value, if there is one; what is wrong with the study's text goes to `faults`, any other error is passed on.
fn keep<T>(faults: &mut Faults, result: Result<T, StudyError>) -> Result<Option<T>, StudyError> {
    match result {
        Ok(value) => Ok(Some(value)),
        Err(StudyError::Settings(fault)) => {
            faults.add(fault);
            Ok(None)
        }
        Err(other) => Err(other),
    }
}

/// A planner that asks for more of a roadmap than there is would make nothing but invalid rows.
fn check_extent(
    contender: &Contender,
    sweep: &SweepPoint,
    asked: Option<Extent>,
    families: &[(&Group, Arc<dyn Family>)],
) -> Result<(), SettingsError> {
    for (group, family) in families {
        let lack = asked.zip(family.extent()).and_then(|(asked, built)| built.lacks(&asked));
        let Some(lack) = lack else { continue };
        let at = name::sweep(&sweep.key);
        let swept = if at.is_empty() { at } else { format!(" at {at}") };
        let message = format!("contender `{}`{swept} on problems `{}`: {lack}", contender.label, group.label);
        return Err(contender.stages[0].settings.error(message));
    }
    Ok(())
}

/// Trials that figures show or that are kept are of problem groups and contenders that there are.
fn check_selections(spec: &StudySpec, document: &Document, faults: &mut Faults) {
    let groups: Vec<&str> = spec.problems.iter().map(|group| group.label.get_ref().as_str()).collect();
    let contenders: Vec<&str> = spec.contenders.iter().map(|c| c.label.get_ref().as_str()).collect();
    let mut check = |what: &str, known: &[&str], name: &str, place: String| {
        if !known.contains(&name) {
            let hint = did_you_mean(name, known.iter().copied());
            let message = format!("no {what} is called `{name}`{hint}; they are {}", known.join(", "));
            faults.add(document.error_at(&place, message));
        }
    };
    let shown = spec.figures.iter().enumerate().flat_map(|(figure, spec)| {
        spec.shows
            .iter()
            .enumerate()
            .map(move |(index, trials)| (format!("figure.{figure}.shows.{index}"), trials))
    });
    let kept = spec.keeps.iter().enumerate().map(|(index, trials)| (format!("keep.{index}"), trials));
    for (place, trials) in shown.chain(kept) {
        check("problem group", &groups, &trials.problems, format!("{place}.problems"));
        if let Some(contender) = &trials.contender {
            check("contender", &contenders, contender, format!("{place}.contender"));
        }
    }
}

fn unique<'a>(
    document: &Document,
    what: &str,
    labels: impl Iterator<Item = &'a Spanned<String>>,
    faults: &mut Faults,
) {
    let mut seen = BTreeSet::new();
    for label in labels {
        let slug = slug(label.get_ref());
        if slug.is_empty() {
            let message = format!("{what} `{}` has no letter or digit in its name", label.get_ref());
            faults.add(document.error(label.span(), message));
        } else if !seen.insert(slug.clone()) {
            let message =
                format!("{what} `{}` is the second to be called `{slug}` in trial names", label.get_ref());
            faults.add(document.error(label.span(), message));
        }
    }
}

fn look_up<T>(
    document: &Document,
    what: &str,
    name: &Spanned<String>,
    find: impl Fn(&str) -> Option<T>,
    known: impl Iterator<Item = &'static str>,
) -> Result<T, SettingsError> {
    find(name.get_ref()).ok_or_else(|| document.error(name.span(), none_called(what, name.get_ref(), known)))
}

/// The settings in `table`; without it, empty ones of what is named `at`.
fn optional(
    document: &Arc<Document>,
    table: Option<&Spanned<Table>>,
    at: Range<usize>,
    whose: &str,
) -> Settings {
    table.map_or_else(|| Settings::absent(document, at, whose), |table| Settings::written(document, table))
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
    let replicates = spec.replicates.unwrap_or(1);
    let family = look_up(document, "problem family", &spec.family, family::find, known)?;
    let written = Settings::written(document, &spec.settings);
    let settings = match &spec.file {
        Some(file) => written.overlaid(&each::filled(written.table(), file), &format!("file {file}")),
        None => written,
    };
    Ok(Group {
        label: spec.label.get_ref().clone(),
        family,
        replicates,
        draw: spec.draw.clone(),
        is_numbered: replicates > 1,
        settings: settings.completed(family.settings),
    })
}

fn contender(document: &Arc<Document>, spec: &ContenderSpec) -> Result<Contender, SettingsError> {
    let label = spec.label.get_ref();
    let repeats = spec.repeats.unwrap_or(1);
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
            "contender `{label}` asks for {what} `{}`, which does not exist{}; the {what}s are {}",
            name.get_ref(),
            did_you_mean(name.get_ref(), known.iter().copied()),
            known.join(", ")
        );
        document.error(name.span(), message)
    })?;
    let whose = format!("contender `{label}`, {what} `{}`", entry.name);
    let settings = optional(document, settings, name.span(), &whose).completed(entry.settings);
    Ok(StageUse { entry, named: name.span(), settings })
}
