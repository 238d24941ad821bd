//! From a spec to checked types. A fault is reported with file, line, column, the value found and the values accepted.

use super::super::choice::Change;
use super::super::contender::{StageUse, SweepPoint, Swept};
use super::super::error::StudyError;
use super::super::inputs::Inputs;
use super::super::name::slug;
use super::super::spec::{BudgetSpec, ContenderSpec, ProblemsSpec, StageSpec, StudySpec, SweepSpec};
use super::super::{family, planner, task};
use super::check::check_selections;
use super::{Contender, Group, Settings, Shared, Study, Sweep, columns_of, each, labels_of};
use base::settings::{Document, Faults, Place, SettingsError, Spanned, did_you_mean, none_called};
use engine::planner::{Build, Entry};
use std::collections::BTreeSet;
use std::ops::Range;
use std::sync::Arc;
use toml::Table;

impl Study {
    /// The study in `document`, as far as it can be read, with what its paper says for all studies (`shared`). Every fault in its text
    /// goes to `faults`. Nothing is built yet.
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
            // Any text in it may be a name that it gives.
            for word in document.quoted() {
                faults.unread(word);
            }
            faults.unread(name);
            return Ok(None);
        };
        spec.problems = each::expanded(spec.problems, document, inputs, faults);
        let draws = std::mem::take(&mut spec.draws);
        let leaves_out = [std::mem::take(&mut spec.leaves_out), draws.clone()].concat();
        let mut study = Self::resolve(name, spec, document, shared, faults);
        study.inherit(&shared.choices, &leaves_out, faults);
        study.draws = draws.into_iter().map(Spanned::into_inner).collect();
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
            groups: read_all(&spec.problems, &shared.groups, document, Some(&name), faults),
            contenders: read_all(&spec.contenders, &shared.contenders, document, Some(&name), faults),
            explore: shared.explore.as_ref().and_then(|explore| explore.study(&name)),
            cut_to: None,
            name,
            sweeps: sweeps(spec.sweeps, document, faults),
            choices: Vec::new(),
            leaves_out: Vec::new(),
            draws: Vec::new(),
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

impl Shared {
    /// The groups and contenders in `document` that those of studies may be `like`; faults go to `faults`.
    pub fn models(
        problems: Vec<ProblemsSpec>,
        contenders: &[ContenderSpec],
        document: &Arc<Document>,
        faults: &mut Faults,
    ) -> (Vec<Group>, Vec<Contender>) {
        let problems: Vec<ProblemsSpec> =
            (0..).zip(problems).map(|(place, group)| ProblemsSpec { place, ..group }).collect();
        (read_all(&problems, &[], document, None, faults), read_all(contenders, &[], document, None, faults))
    }

    /// Refuses those that no study names; where one of `studies` could not be read it may be the one that does.
    pub fn check_models(&self, document: &Document, studies: &[Study], faults: &mut Faults) {
        if !faults.is_empty() {
            return;
        }
        let groups = self.groups.iter().map(|group| ("problems", group.place, &group.label));
        let contenders = self.contenders.iter().map(|one| ("contender", one.place, &one.label));
        let is_named = |label: &str| studies.iter().any(|study| study.document.contains_word(label));
        for (key, place, label) in groups.chain(contenders).filter(|(.., label)| !is_named(label)) {
            let message = format!("no study has an entry that is `like` `{label}`");
            faults.add(document.error_at(&format!("{key}.{place}.label"), message));
        }
    }
}

/// An entry of a spec that may be like another of its kind.
trait Alike: Sized {
    /// The type that it is read into.
    type Read: Clone;

    /// What it is called in messages, and the key that it must have unless it is like another.
    const CALLED: [&'static str; 2];

    /// Its own label, the label of the entry that it is like, and whether it has the key.
    fn names(&self) -> (&Spanned<String>, Option<&Spanned<String>>, bool);

    /// The label of what was read.
    fn label(read: &Self::Read) -> &str;

    /// The entry at `place`, read by itself.
    ///
    /// # Errors
    /// A name that does not exist.
    fn read(&self, document: &Arc<Document>, place: usize) -> Result<Self::Read, SettingsError>;

    /// The entry at `place`, which is like `base`.
    ///
    /// # Errors
    /// A key that does not go with `like`, a name that does not exist.
    fn read_like(
        &self,
        base: &Self::Read,
        document: &Arc<Document>,
        place: usize,
    ) -> Result<Self::Read, SettingsError>;
}

/// Every entry that can be read; the others go to `faults` under their labels, and with them columns of the `study`, if it is one
/// that has them. An entry may be like one before it or one that is `shared`.
fn read_all<S: Alike>(
    specs: &[S],
    shared: &[S::Read],
    document: &Arc<Document>,
    study: Option<&str>,
    faults: &mut Faults,
) -> Vec<S::Read> {
    let mut all: Vec<S::Read> = Vec::new();
    for (place, spec) in specs.iter().enumerate() {
        match read_one(specs, place, [&all, shared], document) {
            Ok(entry) => all.push(entry),
            Err(fault) => {
                faults.add(fault);
                faults.unread(spec.names().0.get_ref());
                if let Some(study) = study {
                    faults.unread(columns_of(study));
                }
            }
        }
    }
    all
}

fn read_one<S: Alike>(
    specs: &[S],
    place: usize,
    known: [&[S::Read]; 2],
    document: &Arc<Document>,
) -> Result<S::Read, SettingsError> {
    let spec = &specs[place];
    let [what, key] = S::CALLED;
    let (label, like, has_key) = spec.names();
    let known = || known.into_iter().flatten();
    match like {
        None if has_key => spec.read(document, place),
        Some(like) if !has_key => {
            if let Some(base) = known().find(|base| S::label(base) == like.get_ref()) {
                return spec.read_like(base, document, place);
            }
            let what = format!("{what} above or in paper.toml");
            let labels: BTreeSet<&str> = known().map(S::label).collect();
            let message = none_called(&what, like.get_ref(), labels);
            let error = document.error(like.span(), message).about("like");
            // One above or a shared one may have faults of its own, which are reported.
            let is_below = specs[place..].iter().any(|spec| spec.names().0 == like);
            Err(if is_below { error } else { error.about(like.get_ref()) })
        }
        _ => {
            let found = if has_key { "both" } else { "neither" };
            let message = format!(
                "{what} `{}` has {found} of `{key}` and `like`; one of them is accepted",
                label.get_ref()
            );
            Err(document.error(label.span(), message).about(key))
        }
    }
}

/// Refuses labels that the names of trials cannot distinguish.
fn check_labels(spec: &StudySpec, document: &Document, study: &str, faults: &mut Faults) {
    let mut labels = spec.problems.iter().map(|p| &p.label).chain(spec.contenders.iter().map(|c| &c.label));
    let is_nameless = labels.any(|label| slug(label.get_ref()).is_empty());
    if is_nameless {
        faults.unread(labels_of(study));
        faults.unread(columns_of(study));
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
        let found = match (&spec.stage, &spec.problems) {
            (Some(_), Some(_)) => Some("both `stage` and `problems`"),
            (None, None) => Some("neither `stage` nor `problems`"),
            (None, Some(problems)) if problems.get_ref().is_empty() => Some("no label among its `problems`"),
            _ => None,
        };
        if let Some(found) = found {
            let message = format!(
                "sweep `{}` has {found}; `stage`, a planner or stage, or `problems`, labels of groups, is accepted",
                spec.key.get_ref()
            );
            faults.add(document.error(spec.key.span(), message));
        }
        let whose = match spec.stage.filter(|_| found.is_none()) {
            Some(stage) => Swept::Stage(stage.into_inner()),
            None => Swept::Problems(
                spec.problems.filter(|_| found.is_none()).map(Spanned::into_inner).unwrap_or_default(),
            ),
        };
        Sweep {
            key: spec.key.into_inner(),
            whose,
            number,
            values: spec.values.into_inner(),
            nested: spec.nested,
            place,
        }
    };
    specs.into_iter().enumerate().map(&mut sweep).collect()
}

impl Alike for ProblemsSpec {
    type Read = Group;

    const CALLED: [&'static str; 2] = ["problem group", "family"];

    fn names(&self) -> (&Spanned<String>, Option<&Spanned<String>>, bool) {
        (&self.label, self.like.as_ref(), self.family.is_some())
    }

    fn label(group: &Group) -> &str {
        &group.label
    }

    fn read(&self, document: &Arc<Document>, _: usize) -> Result<Group, SettingsError> {
        self.refuse_files(document)?;
        let known = family::REGISTRY.iter().map(|entry| entry.name);
        let named = self.family.as_ref().expect("a group that is like no other names its family");
        let family = look_up(document, "problem family", named, family::find, known)?;
        let instances = self.instances.unwrap_or(1);
        let whose = format!("problem group `{}`", self.label.get_ref());
        let written = optional(document, self.settings.as_ref(), self.label.span(), &whose);
        let settings = match &self.file {
            Some(file) => written.overlaid(&each::filled(written.table(), file), &format!("file {file}")),
            None => written,
        };
        Ok(Group {
            stage: self.stage(document),
            label: self.label.get_ref().clone(),
            place: self.place,
            family,
            instances,
            shared_instances: self.shared_instances.clone(),
            is_numbered: instances > 1,
            settings: settings.completed(family.settings),
            points: vec![SweepPoint::default()],
            queries: Vec::new(),
            is_drawn: family.is_drawn,
            noun: family.instances,
        })
    }

    fn read_like(&self, base: &Group, document: &Arc<Document>, _: usize) -> Result<Group, SettingsError> {
        self.refuse_files(document)?;
        let instances = self.instances.unwrap_or(base.instances);
        Ok(Group {
            stage: self.stage(document).or_else(|| base.stage.clone()),
            label: self.label.get_ref().clone(),
            place: self.place,
            instances,
            shared_instances: self.shared_instances.clone().or_else(|| base.shared_instances.clone()),
            is_numbered: instances > 1,
            settings: over(
                &base.settings,
                self.settings.as_ref(),
                &base.label,
                document,
                ("problems", self.place),
            ),
            ..base.clone()
        })
    }
}

impl ProblemsSpec {
    /// What it says of planners and stages on its problems.
    fn stage(&self, document: &Arc<Document>) -> Option<Change> {
        let place = Place::of_table(document, &["problems", &self.place.to_string()]);
        let stage = Some(&self.stage).filter(|stage| !stage.is_empty());
        stage.map(|stage| Change::by_problems(self.label.get_ref(), stage.clone(), place))
    }

    /// Refuses `each`: by now every file has a group of its own.
    fn refuse_files(&self, document: &Document) -> Result<(), SettingsError> {
        let message = "`each` is accepted in a study, in groups that are `like` no other";
        self.each.as_ref().map_or(Ok(()), |each| Err(document.error(each.span(), message)))
    }
}

/// The settings of the entry called `base` with those of one that is like it, which stands at `place`, laid over them.
fn over(
    base: &Settings,
    own: Option<&Spanned<Table>>,
    label: &str,
    document: &Arc<Document>,
    (key, number): (&str, usize),
) -> Settings {
    let place = Place::of_table(document, &[key, &number.to_string(), "settings"]);
    own.map_or_else(|| base.clone(), |own| base.like(own.get_ref(), label, place))
}

impl Alike for ContenderSpec {
    type Read = Contender;

    const CALLED: [&'static str; 2] = ["contender", "planner"];

    fn names(&self) -> (&Spanned<String>, Option<&Spanned<String>>, bool) {
        (&self.label, self.like.as_ref(), self.planner.is_some())
    }

    fn label(contender: &Contender) -> &str {
        &contender.label
    }

    fn read(&self, document: &Arc<Document>, place: usize) -> Result<Contender, SettingsError> {
        let label = self.label.get_ref();
        let repeats = self.repeats.unwrap_or(1);
        let mut faults = Faults::default();
        let named = self.planner.as_ref().expect("a contender that is like no other names its planner");
        let planner = faults.keep(stage(document, label, named, self.settings.as_ref(), true));
        let then = self.then(document, &mut faults);
        faults.done()?;
        Ok(Contender {
            label: label.clone(),
            place,
            repeats,
            is_numbered: repeats > 1,
            stages: planner.into_iter().chain(then.into_iter().flatten()).collect(),
            departs: self.departs.clone(),
        })
    }

    fn read_like(
        &self,
        base: &Contender,
        document: &Arc<Document>,
        place: usize,
    ) -> Result<Contender, SettingsError> {
        let mut faults = Faults::default();
        let then = self.then(document, &mut faults);
        faults.done()?;
        let mut stages = base.stages.clone();
        let planner = &mut stages[0];
        planner.settings =
            over(&planner.settings, self.settings.as_ref(), &base.label, document, ("contender", place));
        if let Some(then) = then {
            stages.truncate(1);
            stages.extend(then);
        }
        for stage in &mut stages[..] {
            stage.named = self.label.span();
        }
        let repeats = self.repeats.unwrap_or(base.repeats);
        let departs = base.departs.clone().into_iter().chain(self.departs.clone()).collect();
        let label = self.label.get_ref().clone();
        Ok(Contender { label, place, repeats, is_numbered: repeats > 1, stages, departs })
    }
}

impl ContenderSpec {
    /// The stages that tidy its plan, if it says which.
    fn then(&self, document: &Arc<Document>, faults: &mut Faults) -> Option<Vec<StageUse>> {
        let label = self.label.get_ref();
        let read = |then: &StageSpec| stage(document, label, &then.stage, then.settings.as_ref(), false);
        self.then.as_ref().map(|then| faults.keep_each(then.iter().map(read)))
    }
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
