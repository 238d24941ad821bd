//! From a spec to checked types. A fault is reported with file, line, column, the value found and the values accepted.

use super::super::choice::Change;
use super::super::contender::{StageUse, SweepPoint, Swept};
use super::super::error::StudyError;
use super::super::inputs::Inputs;
use super::super::name::slug;
use super::super::spec::{BudgetSpec, ContenderSpec, ProblemsSpec, StudySpec, SweepSpec};
use super::super::{family, planner, task};
use super::check::check_selections;
use super::{Contender, Group, Settings, Shared, Study, Sweep, columns_of, each, labels_of, sweeps_of};
use base::settings::{Document, Faults, Place, SettingsError, Spanned, did_you_mean, none_called, schema_of};
use engine::planner::{Build, Entry};
use serde_json::Value;
use std::collections::BTreeSet;
use std::ops::Range;
use std::sync::Arc;
use toml::Table;

impl Study {
    /// The study in `document`, of a paper that says what is `shared`, as far as it can be read, if at all; everything that is wrong
    /// goes to `faults`.
    ///
    /// # Errors
    /// What the system refuses.
    pub(crate) fn gather(
        document: &Arc<Document>,
        shared: &Shared,
        inputs: &Inputs,
        faults: &mut Faults,
    ) -> Result<Option<Self>, StudyError> {
        let name = document.path().file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let Some(mut spec) = faults.keep(document.read::<StudySpec>()) else {
            // Any word of it may be a name that it gives, but for those that all studies have.
            let keys = keys_in(&schema_of::<StudySpec>());
            for word in document.words().into_iter().filter(|word| !keys.contains(*word)) {
                faults.unread(word);
            }
            faults.unread(name);
            return Ok(None);
        };
        spec.problems = each::expanded(spec.problems, document, inputs, faults);
        let leaves_out = std::mem::take(&mut spec.leaves_out);
        let mut study = Self::resolve(name, spec, document, shared, faults);
        study.inherit(&shared.choices, &leaves_out, faults);
        study.check(inputs, faults)?;
        Ok(Some(study))
    }

    /// The study as far as its names exist; what does not goes to `faults`.
    fn resolve(
        name: String,
        spec: StudySpec,
        document: &Arc<Document>,
        shared: &Shared,
        faults: &mut Faults,
    ) -> Self {
        check_labels(&spec, document, &name, faults);
        check_selections(&spec, document, &name, faults);
        let budget = spec.budget.or(shared.budget).unwrap_or_else(|| {
            let message = "missing key `budget` (Limits on each trial); a table is accepted, here or in paper.toml for all studies";
            faults.add(document.error_at("", message).about("budget"));
            BudgetSpec { expansions: 1 }
        });
        let known = task::REGISTRY.iter().map(|entry| entry.name);
        let named = spec.task.as_ref().map(|task| look_up(document, "task", task, task::find, known));
        Self {
            paper: spec.paper.into_inner(),
            question: spec.question,
            seed: spec.seed,
            second_seed: spec.second_seed.or(shared.second_seed),
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
            explore: shared.explore.as_ref().and_then(|explore| explore.study(&name)),
            name,
            sweeps: sweeps(spec.sweeps, document, faults),
            choices: Vec::new(),
            leaves_out: Vec::new(),
            budget,
            timing: spec.timing,
            keeps: spec.keeps,
            quick: spec.quick,
            figures: spec.figures,
            of_paper: Vec::new(),
            document: document.clone(),
        }
    }
}

/// Every key that `schema` knows in some table.
fn keys_in(schema: &Value) -> BTreeSet<String> {
    let own = schema.get("properties").and_then(Value::as_object).into_iter().flatten();
    let own = own.map(|(key, _)| key.clone());
    let parts: Vec<&Value> = match schema {
        Value::Object(parts) => parts.values().collect(),
        Value::Array(parts) => parts.iter().collect(),
        _ => Vec::new(),
    };
    own.chain(parts.into_iter().flat_map(keys_in)).collect()
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

/// Refuses labels that the names of trials cannot distinguish.
fn check_labels(spec: &StudySpec, document: &Document, study: &str, faults: &mut Faults) {
    let mut labels = spec.problems.iter().map(|p| &p.label).chain(spec.contenders.iter().map(|c| &c.label));
    let is_nameless = labels.any(|label| slug(label.get_ref()).is_empty());
    if is_nameless || document.is_part("problems") || document.is_part("contender") {
        faults.unread(labels_of(study));
        faults.unread(columns_of(study));
    }
    if document.is_part("sweep") {
        faults.unread(sweeps_of(study));
    }
    unique(document, "problem group", spec.problems.iter().map(|p| &p.label), faults);
    unique(document, "contender", spec.contenders.iter().map(|c| &c.label), faults);
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

fn sweeps(specs: Vec<SweepSpec>, document: &Arc<Document>, faults: &mut Faults) -> Vec<Sweep> {
    let mut sweep = |(number, spec): (usize, SweepSpec)| {
        let place = Place::of_table(document, &["sweep", &number.to_string()]);
        let found = match (&spec.of, &spec.problems) {
            (Some(_), Some(_)) => Some("both `of` and `problems`"),
            (None, None) => Some("neither `of` nor `problems`"),
            (None, Some(problems)) if problems.get_ref().is_empty() => Some("no label among its `problems`"),
            _ => None,
        };
        if let Some(found) = found {
            let message = format!(
                "sweep `{}` has {found}; `of`, a planner or stage, or `problems`, labels of groups, is accepted",
                spec.key.get_ref()
            );
            faults.add(document.error(spec.key.span(), message));
        }
        let of = match spec.of.filter(|_| found.is_none()) {
            Some(of) => Swept::Entry(of.into_inner()),
            None => Swept::Problems(
                spec.problems.filter(|_| found.is_none()).map(Spanned::into_inner).unwrap_or_default(),
            ),
        };
        Sweep {
            key: spec.key.into_inner(),
            of,
            number,
            values: spec.values.into_inner(),
            nested: spec.nested,
            place,
        }
    };
    specs.into_iter().enumerate().map(&mut sweep).collect()
}

fn group(document: &Arc<Document>, spec: &ProblemsSpec) -> Result<Group, SettingsError> {
    let known = family::REGISTRY.iter().map(|entry| entry.name);
    let instances = spec.instances.unwrap_or(1);
    let family = look_up(document, "problem family", &spec.family, family::find, known)?;
    let written = Settings::written(document, &spec.settings);
    let settings = match &spec.file {
        Some(file) => written.overlaid(&each::filled(written.table(), file), &format!("file {file}")),
        None => written,
    };
    let place = || Place::of_table(document, &["problems", &spec.place.to_string()]);
    let stage = Some(&spec.stage).filter(|stage| !stage.is_empty());
    Ok(Group {
        stage: stage.map(|stage| Change::by_problems(spec.label.get_ref(), stage.clone(), place())),
        label: spec.label.get_ref().clone(),
        place: spec.place,
        family,
        instances,
        shared_instances: spec.shared_instances.clone(),
        is_numbered: instances > 1,
        settings: settings.completed(family.settings),
        points: vec![SweepPoint::default()],
        queries: Vec::new(),
        is_drawn: family.is_drawn,
        noun: family.instances,
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
    let fits = |entry: &Entry| matches!(entry.build, Build::Planner(_)) == first;
    let known: Vec<&str> = planner::all().filter(|e| fits(e)).map(|e| e.name).collect();
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
