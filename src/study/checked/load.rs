//! From a spec to checked types: what is wrong is said with file, line, column, what was found and what is accepted.

use super::super::contender::StageUse;
use super::super::error::StudyError;
use super::super::family::Family;
use super::super::group::Families;
use super::super::inputs::Inputs;
use super::super::name::{self, slug};
use super::super::spec::{ContenderSpec, ProblemsSpec, ReadingSpec, StudySpec, SweepSpec};
use super::super::{family, task};
use super::sizes::SWEPT;
use super::{Contender, Group, Reading, ReadingChoice, Settings, Study, Sweep, SweepPoint, columns_of, each};
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
        let mut faults = Faults::default();
        let study = Self::gather(&Document::open(path)?, inputs, &mut faults)?;
        match study {
            Some(study) if faults.is_empty() => Ok(study),
            _ => Err(faults.error().into()),
        }
    }

    /// The study in `document` as far as it can be read, if at all; everything that is wrong goes to `faults`.
    ///
    /// # Errors
    /// What the system refuses.
    pub(in crate::study) fn gather(
        document: &Arc<Document>,
        inputs: &Inputs,
        faults: &mut Faults,
    ) -> Result<Option<Self>, StudyError> {
        let name = document.path().file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let Some(mut spec) = faults.keep(document.read::<StudySpec>()) else {
            faults.unread(name);
            return Ok(None);
        };
        spec.problems = each::expanded(spec.problems, document, inputs, faults);
        let mut study = Self::resolve(name, spec, document, faults);
        study.check(inputs, faults)?;
        Ok(Some(study))
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
            groups: read_all(&spec.problems, |_, p| (&p.label, group(document, p)), &name, faults),
            contenders: read_all(
                &spec.contenders,
                |at, c| (&c.label, contender(document, at, c)),
                &name,
                faults,
            ),
            name,
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

    /// Builds everything once under every single option, so that nothing can fail for its settings later. What cannot be
    /// built is left out.
    fn check(&mut self, inputs: &Inputs, faults: &mut Faults) -> Result<(), StudyError> {
        let path = self.document.path();
        let absolute = fs::canonicalize(path).map_err(StudyError::io(path, "opening the study"))?;
        let folder = absolute.parent().and_then(Path::file_name).unwrap_or_default().to_string_lossy();
        if folder != self.paper && !self.paper.is_empty() {
            let message =
                format!("`paper` is `{}`, but the study lies in the folder of `{folder}`", self.paper);
            faults.add(self.document.error_at("paper", message));
        }
        faults.keep((self.task.build)(&self.task_settings));
        faults.keep((self.task.build)(&self.quick_task_settings()));
        self.check_sweeps(faults);
        self.check_defaults(faults);
        let mut known = Families::default();
        if let Some(points) = keep(faults, self.single_options())? {
            for point in &points {
                self.check_point(point, inputs, &mut known, faults)?;
            }
            let families = self.check_ends(&points[0], inputs, &mut known, faults)?;
            self.check_sizes(&families, faults);
        }
        Ok(())
    }

    /// Refuses readings whose default is not one of their options; the first option stands in for it.
    fn check_defaults(&mut self, faults: &mut Faults) {
        for (index, reading) in self.readings.iter_mut().enumerate() {
            let (id, default) = (&reading.id, &reading.default);
            if reading.options.contains_key(default) {
                continue;
            }
            let known: Vec<&str> = reading.options.keys().map(String::as_str).collect();
            let hint = did_you_mean(default, known.iter().copied());
            let message =
                format!("reading `{id}` has no option `{default}`{hint}; it has {}", known.join(", "));
            faults.add(self.document.error_at(&format!("reading.{index}.default"), message));
            reading.default = reading.options.keys().next().cloned().unwrap_or_default();
        }
        self.readings.retain(|reading| !reading.options.is_empty());
    }

    /// Refuses problems whose start or goal is in collision under the default reading.
    ///
    /// Under other readings, and in groups that vary another group of their family, an end may be in collision: the
    /// trials are then rows that say so. The families of the groups are given back.
    fn check_ends(
        &self,
        default: &ReadingChoice,
        inputs: &Inputs,
        known: &mut Families,
        faults: &mut Faults,
    ) -> Result<Vec<(&Group, Arc<dyn Family>)>, StudyError> {
        let (mut families, mut posed) = (Vec::new(), BTreeMap::new());
        for group in &self.groups {
            let Some(family) = keep(faults, known.of(group, default, inputs))? else { continue };
            let ends = family.check_ends();
            let of_family = posed.entry(group.family.name).or_insert(ends.clone());
            if ends.is_ok() {
                *of_family = ends;
            }
            families.push((group, family));
        }
        for ends in posed.into_values() {
            faults.keep(ends);
        }
        Ok(families)
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
                let Some(pipeline) = faults.keep(contender.pipeline(point, &sweep)) else { continue };
                faults.keep(check_extent(contender, &sweep, pipeline.planner.asks(), &families));
                if contender.repeats > 1 && !pipeline.planner.draws() {
                    let message = format!(
                        "`repeats` is {}, and contender `{}` draws nothing at random; 1 is accepted",
                        contender.repeats, contender.label
                    );
                    let place = format!("contender.{}.repeats", contender.place);
                    faults.add(self.document.error_at(&place, message));
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

    /// Refuses sweeps that no record could name or that change nothing, and leaves out the former.
    fn check_sweeps(&mut self, faults: &mut Faults) {
        let used = self.stage_names();
        let (mut keys, mut kept, mut points) = (BTreeSet::new(), Vec::new(), 1_usize);
        for (index, sweep) in std::mem::take(&mut self.sweeps).into_iter().enumerate() {
            let wrong = match sweep.key_values() {
                None => Some("has a value that is neither a number nor a word nor a truth value"),
                Some(values) if values.is_empty() => Some("has no value; one or more is accepted"),
                _ => (!keys.insert(sweep.key.clone()))
                    .then_some("is the second over this setting; one is accepted"),
            };
            if let Some(wrong) = wrong {
                let message = format!("sweep `{}` {wrong}", sweep.key);
                faults.add(self.document.error_at(&format!("sweep.{index}.key"), message));
                faults.unread(format!("sweeps of {}", self.name));
                continue;
            }
            points = points.saturating_mul(sweep.values.len());
            if points > SWEPT {
                let message = format!(
                    "the values of the sweeps have {points} combinations; at most {SWEPT} are accepted"
                );
                faults.add(self.document.error_at(&format!("sweep.{index}.values"), message));
                faults.unread(format!("sweeps of {}", self.name));
                break;
            }
            if !used.contains(sweep.of.as_str()) {
                let hint = did_you_mean(&sweep.of, used.iter().copied());
                let message = format!(
                    "sweep `{}` is over `{}`, which no contender uses{hint}; they use {}",
                    sweep.key,
                    sweep.of,
                    Vec::from_iter(used.clone()).join(", ")
                );
                faults.add(self.document.error_at(&format!("sweep.{index}.of"), message).about(&sweep.of));
            }
            kept.push(sweep);
        }
        self.sweeps = kept;
    }

    fn stage_names(&self) -> BTreeSet<&'static str> {
        self.contenders.iter().flat_map(|c| &c.stages).map(|stage| stage.entry.name).collect()
    }
}

/// Every entry that can be read; the others go to `faults` under their labels, and with them columns of the study.
fn read_all<S, T>(
    specs: &[S],
    read: impl Fn(usize, &S) -> (&Spanned<String>, Result<T, SettingsError>),
    study: &str,
    faults: &mut Faults,
) -> Vec<T> {
    let mut all = Vec::new();
    for (label, entry) in specs.iter().enumerate().map(|(place, spec)| read(place, spec)) {
        match entry {
            Ok(entry) => all.push(entry),
            Err(fault) => {
                faults.add(fault);
                faults.unread(label.get_ref());
                faults.unread(columns_of(study));
            }
        }
    }
    all
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
            faults.add(document.error_at(&place, message).about(name));
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
        place: spec.place,
        family,
        replicates,
        draw: spec.draw.clone(),
        is_numbered: replicates > 1,
        settings: settings.completed(family.settings),
    })
}

fn contender(
    document: &Arc<Document>,
    place: usize,
    spec: &ContenderSpec,
) -> Result<Contender, SettingsError> {
    let label = spec.label.get_ref();
    let repeats = spec.repeats.unwrap_or(1);
    let mut faults = Faults::default();
    let planner = faults.keep(stage(document, label, &spec.planner, spec.settings.as_ref(), true));
    let then =
        spec.then.iter().map(|then| stage(document, label, &then.stage, then.settings.as_ref(), false));
    let stages = planner.into_iter().chain(then.filter_map(|stage| faults.keep(stage))).collect();
    faults.done()?;
    Ok(Contender {
        label: label.clone(),
        place,
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
