//! Kinds of figure: one a file, all in [`REGISTRY`].
//!
//! A kind turns stored records and traces into a [`Sheet`]; it runs no trial and draws no statistics of its own.

mod arm_plane;
mod ask;
pub mod claims_by_choices;
mod grid_search;
mod motion_curves;
mod neighbourhoods;
mod plane_search;
mod polyhedra;
mod statistics;
mod work_cell;

use super::RenderError;
use super::chart::{Panel, Sheet};
use super::latex::Table;
use crate::analysis::evidence::{Evidence, Run};
use crate::analysis::tabulated::{Trials, trials};
use crate::analysis::verdict::Verdicts;
use base::settings::{Accepted, Faults, Settings, SettingsError, did_you_mean};
use serde::Serialize;
use std::collections::BTreeSet;
use std::sync::Arc;
use study::Study;
use study::key::InstanceKey;
use study::paper::Paper;
use study::record::Row;
use study::spec::{FigureSpec, TrialsSpec};
use toml::Table as Toml;

/// What a figure is drawn from.
pub struct Scene<'a> {
    /// The paper's stored runs.
    pub evidence: &'a Evidence<'a>,
    /// The run of the study that the figure belongs to.
    pub run: &'a Run<'a>,
    /// The paper's verdicts.
    pub verdicts: &'a Verdicts,
}

/// A kind of figure with its settings.
pub trait Kind {
    /// The figure, without its caption.
    ///
    /// # Errors
    /// [`RenderError::NotStored`] if the run lacks what it shows; axes that cannot be drawn.
    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError>;

    /// The trials whose traces it draws: a spec must keep them.
    fn shown(&self) -> Vec<Shown<'_>> {
        Vec::new()
    }

    /// What stands in captions instead of its entry's `statistic`, if its settings ask for something else.
    fn statistic(&self) -> Option<&'static str> {
        None
    }

    /// Its curves as numbers, if they run along a sweep and are worth looking up; `caption` says what they show.
    fn curves(&self, _scene: &Scene<'_>, _caption: &str) -> Option<Curves> {
        None
    }

    /// The numbers behind the figure as a table under its own name, where they are worth one.
    ///
    /// # Errors
    /// As [`draw`](Self::draw).
    fn table(&self, _scene: &Scene<'_>, _label: &str, _caption: &str) -> Result<Option<Table>, RenderError> {
        Ok(None)
    }
}

/// A kind that draws worlds: panels for each item of the list that also says which trials a spec must keep.
pub trait World {
    /// The trials whose traces it draws, in the order of their panels.
    fn shown(&self) -> Vec<Shown<'_>>;

    /// The panels of `shown`, the item of number `place`.
    ///
    /// # Errors
    /// As [`Kind::draw`].
    fn panels(&self, scene: &Scene<'_>, shown: &Shown<'_>, place: usize) -> Result<Vec<Panel>, RenderError>;

    /// An empty sheet with room for `count` panels.
    fn sheet(&self, scene: &Scene<'_>, count: usize) -> Sheet;

    /// As [`Kind::table`].
    ///
    /// # Errors
    /// As [`Kind::draw`].
    fn table(&self, _scene: &Scene<'_>, _label: &str, _caption: &str) -> Result<Option<Table>, RenderError> {
        Ok(None)
    }
}

impl<W: World> Kind for W {
    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let mut panels = Vec::new();
        for (place, shown) in World::shown(self).iter().enumerate() {
            panels.extend(self.panels(scene, shown, place)?);
        }
        Ok(self.sheet(scene, panels.len()).with(panels))
    }

    fn shown(&self) -> Vec<Shown<'_>> {
        World::shown(self)
    }

    fn table(&self, scene: &Scene<'_>, label: &str, caption: &str) -> Result<Option<Table>, RenderError> {
        World::table(self, scene, label, caption)
    }
}

/// Curves along a sweep as numbers, for those who look values up.
#[derive(Serialize)]
pub struct Curves {
    /// What they show.
    pub title: String,
    /// What stands along the axis.
    pub axis: String,
    /// What the numbers are, with their unit.
    pub value: String,
    /// The values of the sweep.
    pub at: Vec<f64>,
    /// The curves.
    pub lines: Vec<CurveLine>,
}

/// A curve: a number a value of the sweep, none where there is none.
#[derive(Serialize)]
pub struct CurveLine {
    /// What it is of.
    pub label: String,
    /// The number of the contender, which gives a curve and what is printed beside it one colour.
    pub of: usize,
    /// Its numbers.
    pub values: Vec<Option<f64>>,
    /// The ends of the band around it, if it has one.
    pub band: Option<[Vec<f64>; 2]>,
    /// Whether it is what the paper prints.
    pub is_printed: bool,
}

/// Trials on one instance whose traces a figure draws.
pub struct Shown<'a> {
    /// The problem group.
    pub problems: &'a String,
    /// The contenders; none if preprocessing alone is drawn.
    pub contenders: &'a [String],
    /// The instance.
    pub instance: u32,
}

impl<'a> Shown<'a> {
    /// The first instance of `problems`, by `contenders`.
    fn first(problems: &'a String, contenders: &'a [String]) -> Self {
        Self { problems, contenders, instance: 0 }
    }

    /// The first trial of each contender.
    fn trials<'s>(&self, scene: &Scene<'s>) -> Result<Vec<&'s Row>, RenderError> {
        let trial = |label: &String| ask::trial(scene, self.problems, self.instance, None, label);
        self.contenders.iter().map(trial).collect()
    }

    /// What names the instance.
    fn instance<'s>(&self, scene: &Scene<'s>) -> Result<&'s Arc<InstanceKey>, RenderError> {
        ask::instance(scene, self.problems, self.instance)
    }

    /// The contenders of whom `study` keeps no such trial; `None` stands for all.
    fn lacks(&self, study: &Study) -> Vec<Option<&'a String>> {
        let is_kept =
            |kept: &&TrialsSpec| kept.problems == *self.problems && kept.has_instance(self.instance);
        let by: Vec<_> = study.kept().filter(is_kept).map(|kept| kept.contender.as_ref()).collect();
        let is_lacking = |label: &&String| !by.contains(&None) && !by.contains(&Some(label));
        match self.contenders {
            [] if by.is_empty() => vec![None],
            all => all.iter().filter(is_lacking).map(Some).collect(),
        }
    }
}

/// The problem groups of `study`, each with its instance, whose traces figures draw.
pub fn drawn(study: &Study, paper: &Paper) -> BTreeSet<(String, u32)> {
    let kinds = study.figures.iter().filter_map(|figure| build(figure, study, paper).ok());
    let shown = |kind: Box<dyn Kind>| -> Vec<(String, u32)> {
        kind.shown().iter().map(|shown| (shown.problems.clone(), shown.instance)).collect()
    };
    kinds.flat_map(shown).collect()
}

/// A registered kind of figure.
pub struct Entry {
    /// The name that specs use; also its file's name.
    pub name: &'static str,
    /// One line for `replan list`.
    pub about: &'static str,
    /// What it shows of how many, and what it leaves out, for captions; `{n}` stands for the number of instances and trials,
    /// `{interpretations}` for that of interpretations.
    pub statistic: &'static str,
    /// The shape of its settings, which documents them.
    pub settings: Accepted,
    /// Settings that it can be built from, as TOML: for `replan list`, and for a test that builds it from them.
    pub example: &'static str,
    /// How to build it from its settings.
    pub build: fn(&Settings, &Study, &Paper) -> Result<Box<dyn Kind>, SettingsError>,
}

/// The text below a figure: its caption, with the number of instances and trials, or of interpretations, that its kind
/// shows.
pub fn caption(spec: &FigureSpec, run: &Run<'_>, paper: &Paper, verdicts: &Verdicts) -> String {
    let Some(entry) = find(spec.kind.get_ref()) else { return spec.caption.clone() };
    let own = build(spec, run.study, paper).ok().and_then(|kind| kind.statistic());
    let settings = spec.settings.as_ref().map(base::settings::Spanned::get_ref);
    let Trials { instances, solved, all } = trials(run, settings);
    let noun = noun([run.study]);
    let n = format!("n = {instances} {noun}, {solved}/{all} trials solved");
    let interpretations = verdicts.explored.as_ref().map_or(0, |explored| explored.interpretations);
    let statistic = own.unwrap_or(entry.statistic);
    let statistic = statistic
        .replace("instances", noun)
        .replace("{n}", &n)
        .replace("{interpretations}", &format!("n = {interpretations} interpretations"));
    format!("{} {statistic}", spec.caption)
}

/// The noun for the instances of studies, in the plural: that of their families if they agree.
pub(crate) fn noun<'a>(studies: impl IntoIterator<Item = &'a Study>) -> &'static str {
    let groups = studies.into_iter().flat_map(|study| &study.groups);
    let nouns: BTreeSet<&str> = groups.map(|group| group.noun).collect();
    match nouns.first() {
        Some(noun) if nouns.len() == 1 => noun,
        _ => "instances",
    }
}

/// Every kind, in the order of their names.
pub static REGISTRY: &[&Entry] = &[
    &arm_plane::ENTRY,
    &claims_by_choices::ENTRY,
    &grid_search::ENTRY,
    &motion_curves::ENTRY,
    &neighbourhoods::ENTRY,
    &plane_search::ENTRY,
    &polyhedra::ENTRY,
    &statistics::ENTRY,
    &work_cell::ENTRY,
];

/// The entry called `name`.
pub fn find(name: &str) -> Option<&'static Entry> {
    REGISTRY.iter().copied().find(|entry| entry.name == name)
}

/// Builds every figure of every study, so that `replan check` finds what is wrong before anything runs.
///
/// # Errors
/// An unknown kind, settings that the kind does not understand, problems or contenders that the study lacks.
pub fn validate(paper: &Paper) -> Result<(), SettingsError> {
    let mut faults = Faults::default();
    for study in &paper.studies {
        for figure in &study.figures {
            faults.keep(build(figure, study, paper));
        }
    }
    faults.done()
}

/// The kind of `figure` with its settings.
///
/// # Errors
/// As [`validate`].
pub fn build(figure: &FigureSpec, study: &Study, paper: &Paper) -> Result<Box<dyn Kind>, SettingsError> {
    let entry = find(figure.kind.get_ref()).ok_or_else(|| {
        let known: Vec<&str> = REGISTRY.iter().map(|entry| entry.name).collect();
        let message = format!(
            "figure `{}` is of kind `{}`, which does not exist{}; the kinds are {}",
            figure.id.get_ref(),
            figure.kind.get_ref(),
            did_you_mean(figure.kind.get_ref(), known.iter().copied()),
            known.join(", ")
        );
        study.document.error(figure.kind.span(), message)
    })?;
    let settings = match &figure.settings {
        Some(settings) => Settings::written(&study.document, settings),
        None => Settings::composed(String::new(), Toml::new()),
    };
    let kind = (entry.build)(&settings, study, paper).map_err(|error| {
        if figure.settings.is_some() {
            return error;
        }
        let message = format!("figure `{}` has no settings: {}", figure.id.get_ref(), error.message());
        study.document.error(figure.id.span(), message).about("settings")
    })?;
    let mut faults = Faults::default();
    for shown in kind.shown() {
        faults.keep(ask::known(&settings, study, [shown.problems], shown.contenders));
    }
    faults.done()?;
    check_kept(figure, study, kind.as_ref())?;
    Ok(kind)
}

/// Refuses a figure that draws what no trial of the study would keep.
fn check_kept(figure: &FigureSpec, study: &Study, kind: &dyn Kind) -> Result<(), SettingsError> {
    let mut faults = Faults::default();
    for shown in kind.shown() {
        let (id, problems, instances) = (figure.id.get_ref(), shown.problems, shown.instance + 1);
        for contender in shown.lacks(study) {
            let by = contender.map_or_else(String::new, |label| format!(", contender = \"{label}\""));
            let message = format!(
                "figure `{id}` draws what is kept of trials on `{problems}`, and none is kept; accepted is \
                 shows = [{{ problems = \"{problems}\"{by}, instances = {instances} }}]"
            );
            faults.add(study.document.error(figure.id.span(), message));
        }
    }
    faults.done()
}
