//! Checks of a study whose names were looked up: everything is built once, under every single option.

use super::super::contender::{Pipelines, Swept};
use super::super::error::StudyError;
use super::super::family::Family;
use super::super::group::Families;
use super::super::inputs::Inputs;
use super::super::name;
use super::super::spec::StudySpec;
use super::sizes::SWEPT;
use super::{Contender, Group, Interpretation, Study, Sweep, SweepPoint, labels_of, sweeps_of};
use base::settings::{Document, Faults, Settings, SettingsError, did_you_mean, none_called};
use engine::space::WorldKind;
use engine::space::roadmap::Extent;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::mem::discriminant;
use std::path::Path;
use std::sync::Arc;
use toml::Table;

impl Study {
    /// Refuses what its text alone shows to be wrong. What no record could name is left out.
    pub(super) fn check(&mut self, inputs: &Inputs, faults: &mut Faults) -> Result<(), StudyError> {
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
        self.check_what_groups_lay(faults);
        self.check_what_defaults_hide(inputs, faults);
        Ok(())
    }

    /// Builds everything once under every single option, so that nothing can fail for its settings later, and says of its groups
    /// what only built families know.
    ///
    /// # Errors
    /// What the system refuses.
    pub(crate) fn build(&mut self, inputs: &Inputs, faults: &mut Faults) -> Result<(), StudyError> {
        let mut known = Families::default();
        let mut pipelines = Pipelines::default();
        let Some(points) = keep(faults, self.trial_interpretations())? else { return Ok(()) };
        for point in &points {
            self.check_point(point, inputs, (&mut known, &mut pipelines), faults)?;
        }
        let families = self.check_ends(&points[0], inputs, &mut known, faults)?;
        self.check_sizes(&families, faults);
        check_query_names(&families, faults);
        let built: Vec<(String, Arc<dyn Family>)> =
            families.iter().map(|(group, family)| (group.label.clone(), family.clone())).collect();
        for group in &mut self.groups {
            for (_, family) in built.iter().filter(|(label, _)| *label == group.label) {
                group.is_drawn |= family.draws_ends();
                group.noun = family.instances().unwrap_or(group.noun);
                for query in family.queries() {
                    if !group.queries.contains(&query.name) {
                        group.queries.push(query.name.clone());
                    }
                }
            }
        }
        Ok(())
    }

    /// Refuses defaults that lay something else over what contenders or problems say: they would never run as they are written.
    fn check_what_defaults_hide(&self, inputs: &Inputs, faults: &mut Faults) {
        for choice in &self.choices {
            let default = &choice.options[&choice.default];
            let uses =
                self.contenders.iter().flat_map(|own| own.stages.iter().map(move |stage| (own, stage)));
            let stages = uses.flat_map(|(own, stage)| {
                let entry = stage.entry.name;
                let of_one = default.contender.get(&own.label).and_then(|all| all.get(entry));
                let laid = default.stage.get(entry).into_iter().chain(of_one);
                laid.map(move |over| {
                    let wrong = |settings: &Settings| stage.built(settings).err();
                    (format!("contender `{}` says", own.label), hidden(&stage.settings, over, wrong))
                })
            });
            let posed = self.groups.iter().filter(|group| group.accepts(&default.problem));
            let problems = posed.map(|group| {
                let wrong = |settings: &Settings| group.built(settings, inputs).err();
                (format!("problems `{}` say", group.label), hidden(&group.settings, &default.problem, wrong))
            });
            for (whose, hidden) in stages.chain(problems) {
                for key in faults.keep(hidden).unwrap_or_default() {
                    let message = format!(
                        "the default of choice `{}` changes the `{key}` that {whose} in study `{}`; the same there, or \
                         `leaves_out = [\"{}\"]` in the study, is accepted",
                        choice.id, self.name, choice.id
                    );
                    faults.add(choice.error(&["default"], message));
                }
            }
        }
    }

    /// Refuses problems whose start or goal is in collision under the defaults.
    ///
    /// Under other interpretations, and in groups that vary another group of their family, an end may be in collision: the
    /// trials are then rows that say so. The families of the groups are given back.
    fn check_ends(
        &self,
        default: &Interpretation,
        inputs: &Inputs,
        known: &mut Families,
        faults: &mut Faults,
    ) -> Result<Vec<(&Group, Arc<dyn Family>)>, StudyError> {
        let mut families = Vec::new();
        let mut posed = BTreeMap::new();
        for (group, at) in self.posed() {
            let Some(family) = keep(faults, known.family((group, at), default, inputs))? else { continue };
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
        point: &Interpretation,
        inputs: &Inputs,
        (known, pipelines): (&mut Families, &mut Pipelines),
        faults: &mut Faults,
    ) -> Result<(), StudyError> {
        let mut families: Vec<(&Group, Arc<dyn Family>)> = Vec::new();
        for (group, at) in self.posed() {
            let family = keep(faults, known.family((group, at), point, inputs))?;
            families.extend(family.map(|family| (group, family)));
        }
        let kinds: BTreeSet<_> = families.iter().map(|(_, family)| family.world()).collect();
        for contender in &self.contenders {
            self.check_needs(contender, &kinds, faults);
        }
        let (own, shared): (Vec<_>, Vec<_>) =
            families.into_iter().partition(|(group, _)| group.stage.is_some());
        self.check_contenders(point, &shared, pipelines, faults);
        for (group, family) in own {
            let seen = group.seen_by_contenders(point);
            self.check_contenders(&seen, &[(group, family)], pipelines, faults);
        }
        Ok(())
    }

    /// Refuses contenders that cannot run on the problems of these families under the interpretation `point`.
    fn check_contenders(
        &self,
        point: &Interpretation,
        families: &[(&Group, Arc<dyn Family>)],
        pipelines: &mut Pipelines,
        faults: &mut Faults,
    ) {
        let sweeps = self.contender_points();
        for contender in &self.contenders {
            for sweep in &sweeps {
                let built = pipelines.pipeline(contender, point, sweep);
                let Some(pipeline) = faults.keep(built) else { continue };
                faults.keep(check_extent(contender, sweep, pipeline.planner.asks(), families));
                if contender.repeats > 1 && !pipeline.planner.draws() {
                    let message = format!(
                        "`repeats` is {}, and contender `{}` draws nothing at random; 1 is accepted",
                        contender.repeats, contender.label
                    );
                    let place = format!("contender.{}.repeats", contender.place);
                    faults.add(self.document.error_at(&place, message));
                }
            }
        }
    }

    /// Refuses stages that need worlds of another kind than the problems are posed in.
    fn check_needs(&self, contender: &Contender, kinds: &BTreeSet<WorldKind>, faults: &mut Faults) {
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

    /// Refuses sweeps that no record could name or that change nothing, and leaves out the former.
    fn check_sweeps(&mut self, faults: &mut Faults) {
        let used = self.stage_names();
        let mut keys = BTreeSet::new();
        let mut kept = Vec::new();
        let mut points = 1_usize;
        // Settings of problems that some sweep would have filled.
        let mut unfilled = BTreeSet::new();
        for sweep in std::mem::take(&mut self.sweeps) {
            let is_again = !keys.insert(sweep.key.clone()) && !self.may_share_column(&kept, &sweep);
            if let Some(wrong) = unnamed(&sweep).or(is_again.then_some(IS_AGAIN)) {
                let message = format!("sweep `{}` {wrong}", sweep.key);
                faults.add(self.document.error_at(&format!("sweep.{}.key", sweep.number), message));
                faults.unread(sweeps_of(&self.name));
                unfilled.insert(sweep.key);
                continue;
            }
            points = points.saturating_mul(sweep.values.len());
            if points > SWEPT {
                let message = format!(
                    "the values of the sweeps have {points} combinations; at most {SWEPT} are accepted"
                );
                faults.add(self.document.error_at(&format!("sweep.{}.values", sweep.number), message));
                faults.unread(sweeps_of(&self.name));
                break;
            }
            match &sweep.whose {
                Swept::Stage(stage) if !used.contains(stage.as_str()) => {
                    let hint = did_you_mean(stage, used.iter().copied());
                    let message = format!(
                        "sweep `{}` is over `{stage}`, which no contender uses{hint}; they use {}",
                        sweep.key,
                        Vec::from_iter(used.clone()).join(", ")
                    );
                    faults.add(
                        self.document
                            .error_at(&format!("sweep.{}.stage", sweep.number), message)
                            .about(stage),
                    );
                }
                Swept::Stage(_) => {}
                Swept::Problems(patterns) => {
                    if !self.names_groups(&sweep, patterns, faults) {
                        faults.unread(sweeps_of(&self.name));
                        unfilled.insert(sweep.key.clone());
                    }
                    self.check_what_groups_say(&sweep, faults);
                }
            }
            self.check_what_sweep_hides(&sweep, faults);
            kept.push(sweep);
        }
        self.sweeps = kept;
        for group in &mut self.groups {
            group.points = SweepPoint::all(self.sweeps.iter().filter(|sweep| sweep.is_over(&group.label)));
            let accepts = |key: &&String| group.family.settings.has(key);
            let lacks = |key: &String| !group.settings.table().contains_key(key);
            if unfilled.iter().filter(accepts).any(lacks) {
                // The missing setting follows from the fault of the sweep, which is reported already.
                group.points.clear();
            }
        }
    }

    /// Refuses settings that a group lays over a planner or stage that no contender uses, or that a sweep or the default of a choice
    /// would hide.
    fn check_what_groups_lay(&self, faults: &mut Faults) {
        let used = self.stage_names();
        let laid = self.groups.iter().filter_map(|group| Some((group, group.stage.as_ref()?)));
        for (group, (entry, over)) in
            laid.flat_map(|(group, laid)| laid.stage().iter().map(move |one| (group, one)))
        {
            let mut refuse = |key: &str, message: String| {
                let place = format!("problems.{}.stage.{entry}{key}", group.place);
                faults.add(self.document.error_at(&place, message).about(entry));
            };
            if !used.contains(entry.as_str()) {
                let hint = did_you_mean(entry, used.iter().copied());
                let used = Vec::from_iter(used.clone()).join(", ");
                refuse("", format!("no contender uses `{entry}`{hint}; they use {used}"));
            }
            let sweeps = self.sweeps.iter().filter(|sweep| sweep.entry() == Some(entry));
            let swept = sweeps.map(|sweep| (sweep.key.as_str(), format!("sweep `{}`", sweep.key)));
            let defaults = self.choices.iter().flat_map(|choice| {
                let default = &choice.options[&choice.default];
                let tables = std::iter::once(&default.stage).chain(default.contender.values());
                let keys = tables.filter_map(|all| all.get(entry)).flat_map(Table::keys);
                keys.map(move |key| (key.as_str(), format!("the default of choice `{}`", choice.id)))
            });
            for (key, by) in swept.chain(defaults).filter(|(key, _)| over.contains_key(*key)) {
                refuse(
                    &format!(".{key}"),
                    format!(
                        "{by} would hide this `{key}` of problems `{}`; one of both is accepted",
                        group.label
                    ),
                );
            }
        }
    }

    /// Whether the values of `sweep` can stand in one column with those of the sweeps before it over the same setting.
    fn may_share_column(&self, before: &[Sweep], sweep: &Sweep) -> bool {
        let kind = |sweep: &Sweep| sweep.key_values()?.first().map(discriminant);
        let goes_with = |other: &Sweep| {
            let is_shared = |group: &Group| sweep.is_over(&group.label) && other.is_over(&group.label);
            [sweep, other].iter().all(|one| one.entry().is_none())
                && kind(sweep) == kind(other)
                && !self.groups.iter().any(is_shared)
        };
        before.iter().filter(|other| other.key == sweep.key).all(goes_with)
    }

    /// Whether each label of a sweep over problems is that of a group; others go to `faults`. An empty list of labels
    /// was reported when the sweep was read.
    fn names_groups(&self, sweep: &Sweep, patterns: &[String], faults: &mut Faults) -> bool {
        let mut all = !patterns.is_empty();
        for (place, pattern) in patterns.iter().enumerate() {
            let alone = Sweep { whose: Swept::Problems(vec![pattern.clone()]), ..sweep.clone() };
            if !self.groups.iter().any(|group| alone.is_over(&group.label)) {
                let known = self.groups.iter().map(|group| group.label.as_str());
                let message = none_called("problem group", pattern, known);
                let fault =
                    self.document.error_at(&format!("sweep.{}.problems.{place}", sweep.number), message);
                faults.add(fault.about(pattern).about(&labels_of(&self.name)));
                all = false;
            }
        }
        all
    }

    /// Refuses a sweep over a setting that a group says itself: it would hide that.
    fn check_what_groups_say(&self, sweep: &Sweep, faults: &mut Faults) {
        let value = Table::from_iter([(sweep.key.clone(), toml::Value::Array(Vec::new()))]);
        for group in self.groups.iter().filter(|group| sweep.is_over(&group.label)) {
            if !group.settings.hidden_by(&value).is_empty() {
                let message = format!(
                    "sweep `{}` would hide that problems `{}` say {}; a group that leaves it out is accepted",
                    sweep.key,
                    group.label,
                    group.settings.table()[&sweep.key]
                );
                faults.add(self.document.error_at(&format!("sweep.{}.key", sweep.number), message));
            }
        }
    }

    /// Refuses a sweep over a setting that contenders differ in: it would make them one.
    fn check_what_sweep_hides(&self, sweep: &Sweep, faults: &mut Faults) {
        let stages = self.contenders.iter().flat_map(|own| own.stages.iter().map(move |stage| (own, stage)));
        let values: Vec<_> = stages
            .filter(|(_, stage)| sweep.entry() == Some(stage.entry.name))
            .filter_map(|(own, stage)| Some((own, stage.settings.table().get(&sweep.key)?)))
            .collect();
        let Some((first, value)) = values.first() else { return };
        if let Some((other, another)) = values.iter().find(|(_, other)| other != value) {
            let message = format!(
                "sweep `{}` would hide that contender `{}` says {value} and contender `{}` {another}; a setting that \
                 contenders agree on is accepted",
                sweep.key, first.label, other.label
            );
            faults.add(self.document.error_at(&format!("sweep.{}.key", sweep.number), message));
        }
    }

    fn stage_names(&self) -> BTreeSet<&'static str> {
        self.contenders.iter().flat_map(|c| &c.stages).map(|stage| stage.entry.name).collect()
    }
}

/// What is wrong with a second sweep over a setting.
const IS_AGAIN: &str = "is the second over this setting; one is accepted, or one for each of several problem groups, with values of \
                        one kind";

/// Why records could not name the values of `sweep`, if they could not.
fn unnamed(sweep: &Sweep) -> Option<&'static str> {
    let Some(values) = sweep.key_values() else {
        return Some("has a value that is neither a number nor a word nor a truth value");
    };
    let is_again = |place: usize| values[..place].contains(&values[place]);
    if values.is_empty() {
        return Some("has no value; one or more is accepted");
    }
    (1..values.len()).any(is_again).then_some("has a value twice; each once is accepted")
}

/// The keys of `settings` that `over` would hide; what is wrong with them as they are written, if that is why they differ.
fn hidden(
    settings: &Settings,
    over: &Table,
    wrong: impl Fn(&Settings) -> Option<SettingsError>,
) -> Result<Vec<String>, SettingsError> {
    let keys = settings.hidden_by(over);
    let mut beside = over.clone();
    beside.retain(|key, _| !keys.iter().any(|hidden| hidden == key));
    let as_written = settings.overlaid(&beside, "the default of a choice");
    if keys.is_empty() { Ok(keys) } else { wrong(&as_written).map_or(Ok(keys), Err) }
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

/// Refuses queries of one name: keys of records distinguish them by it.
fn check_query_names(families: &[(&Group, Arc<dyn Family>)], faults: &mut Faults) {
    for (group, family) in families {
        let names = family.queries().iter().map(|query| query.name.as_str());
        for (place, message) in name::repeated(names) {
            faults.add(group.settings.error_at(&format!("queries.{place}"), message));
        }
    }
}

/// A planner that asks for more of a roadmap than there is would make nothing but invalid rows.
fn check_extent(
    contender: &Contender,
    sweep: &SweepPoint,
    wanted: Option<Extent>,
    families: &[(&Group, Arc<dyn Family>)],
) -> Result<(), SettingsError> {
    for (group, family) in families {
        let lack = wanted.zip(family.extent()).and_then(|(wanted, built)| built.lacks(&wanted));
        let Some(lack) = lack else { continue };
        let at = name::sweep(&sweep.key);
        let swept = if at.is_empty() { at } else { format!(" at {at}") };
        let message = format!("contender `{}`{swept} on problems `{}`: {lack}", contender.label, group.label);
        return Err(contender.stages[0].settings.error(message));
    }
    Ok(())
}

/// Trials that figures show or that are kept are of problem groups and contenders that there are.
pub(super) fn check_selections(spec: &StudySpec, document: &Document, study: &str, faults: &mut Faults) {
    let groups: Vec<&str> = spec.problems.iter().map(|group| group.label.get_ref().as_str()).collect();
    let contenders: Vec<&str> = spec.contenders.iter().map(|c| c.label.get_ref().as_str()).collect();
    let mut check = |what: &str, known: &[&str], name: &str, place: String| {
        if !known.contains(&name) {
            let hint = did_you_mean(name, known.iter().copied());
            let message = format!("no {what} is called `{name}`{hint}; they are {}", known.join(", "));
            faults.add(document.error_at(&place, message).about(name).about(&labels_of(study)));
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
