//! Questions that several kinds of figure put to a study and its stored run.

use super::Scene;
use crate::analysis::evidence::Run;
use crate::analysis::metric::{self, Metric};
use crate::analysis::selection::Selection;
use crate::analysis::shown::Savings;
use crate::render::RenderError;
use crate::render::chart::Panel;
use crate::render::chart::marks::Points;
use crate::render::style::{Marker, Rgb};
use base::settings::{Faults, Settings, SettingsError, did_you_mean, none_called};
use engine::planner::Trace;
use std::sync::Arc;
use study::key::{InstanceKey, Owner, SweepKey};
use study::paper::{Paper, printed_by};
use study::record::Row;
use study::{Study, labels_of};

/// Refuses problem groups and contenders that `study` does not have.
pub(super) fn known<'a>(
    settings: &Settings,
    study: &Study,
    problems: impl IntoIterator<Item = &'a String>,
    contenders: impl IntoIterator<Item = &'a String>,
) -> Result<(), SettingsError> {
    let mut faults = Faults::default();
    let mut check = |what: &str, paths: &[&str], label: &String, known: &[&str]| {
        if !known.contains(&label.as_str()) {
            let hint = did_you_mean(label, known.iter().copied());
            let message = format!("no {what} is called `{label}`{hint}; they are {}", known.join(", "));
            let labels = labels_of(&study.name);
            faults.add(settings.error_about(paths, label, message).about(&labels));
        }
    };
    let known: Vec<&str> = study.contenders.iter().map(|c| c.label.as_str()).collect();
    let paths =
        ["contenders", "certain", "panels.contender", "panels.contenders", "levels.contender", "against"];
    contenders.into_iter().for_each(|label| check("contender", &paths, label, &known));
    let known: Vec<&str> = study.groups.iter().map(|group| group.label.as_str()).collect();
    let paths = ["problems", "problem", "panels.problem", "levels.problems", "against"];
    problems.into_iter().for_each(|label| check("problem group", &paths, label, &known));
    faults.done()
}

/// Refuses a query that no problem of the group `problems` of `study` has, which the settings name as `word` at `path`.
pub(super) fn query(
    settings: &Settings,
    study: &Study,
    problems: &str,
    name: &str,
    (path, word): (&str, &str),
) -> Result<(), SettingsError> {
    let Some(missing) = study.lacks_query(&[problems], name) else { return Ok(()) };
    Err(settings.error_about(&[path], word, missing))
}

/// The metric called `name`.
pub(super) fn metric(settings: &Settings, name: &str) -> Result<&'static Metric, SettingsError> {
    let missing = || none_called("metric", name, metric::METRICS.iter().map(|metric| metric.name));
    metric::find(name).ok_or_else(|| settings.error_about(&["x", "y"], name, missing()))
}

/// The same, which trials of `study` must have.
pub(super) fn produced(
    settings: &Settings,
    study: &Study,
    name: &str,
) -> Result<&'static Metric, SettingsError> {
    let metric = metric(settings, name)?;
    if metric.is_produced(&study.columns()) {
        return Ok(metric);
    }
    let message = format!("study `{}` does not produce the metric `{name}`", study.name);
    Err(settings.error_about(&["x", "y"], name, message))
}

/// All trials of one contender on one problem group.
pub(super) fn trials<'s>(run: &Run<'s>, problems: &str, contender: &str) -> Selection<'s> {
    Selection::all(run.study, &[problems.to_owned()], &[contender.to_owned()])
}

/// A value of a trial as titles show it.
pub(super) fn number(row: &Row, column: &str, decimals: usize) -> String {
    row.value(column).map_or_else(|| "–".to_owned(), |value| format!("{value:.decimals$}"))
}

/// The points of a trace of coordinates, which begin each of its rows.
pub(super) fn points<const N: usize>(trace: &Trace) -> Vec<[f64; N]> {
    trace.values.chunks(trace.width).filter_map(|row| row.first_chunk().copied()).collect()
}

/// Marks the first of `points` as the start and the last as the goal, each as named.
pub(super) fn add_ends(panel: &mut Panel, points: &[[f64; 2]], radius_pt: f64, looks: [(Marker, Rgb); 2]) {
    let ends = [("start", points.first()), ("goal", points.last())];
    for ((label, at), (marker, color)) in ends.into_iter().zip(looks) {
        let at = at.into_iter().copied().collect();
        panel.add(Points::unlabelled(at, marker, radius_pt, color).labelled(label));
    }
}

/// The point of the sweeps that people write as `text`.
pub(super) fn sweep(settings: &Settings, study: &Study, text: &str) -> Result<SweepKey, SettingsError> {
    study.sweep_called(text).map_err(|message| settings.error_about(&["sweep"], text, message))
}

/// The printed number of the claim `id`, which the settings name at `key`.
pub(super) fn printed(settings: &Settings, paper: &Paper, key: &str, id: &str) -> Result<f64, SettingsError> {
    let number = paper.claim(id).and_then(|claim| claim.printed.as_ref()?.parse().ok());
    number.ok_or_else(|| {
        let error = settings.error_at(key, format!("there is no claim `{id}` with a printed number"));
        error.about("printed").about(&printed_by(id)).about(id)
    })
}

/// The printed numbers of the claims that the settings list under `key`.
pub(super) fn all_printed<'a>(
    settings: &Settings,
    paper: &Paper,
    key: &str,
    ids: impl IntoIterator<Item = &'a String>,
) -> Result<Vec<f64>, SettingsError> {
    let ids = ids.into_iter().enumerate();
    ids.map(|(index, id)| printed(settings, paper, &format!("{key}.{index}"), id)).collect()
}

/// Which series `contender` is drawn as: the paper's own for its label, or the one at its place.
pub(super) fn series(scene: &Scene<'_>, contender: &str, place: usize) -> usize {
    scene.evidence.paper.series.get(contender).copied().unwrap_or(place)
}

/// The place of the contender called `label` in its study, which gives it the same colour in every figure.
pub(super) fn place(scene: &Scene<'_>, label: &str) -> usize {
    let contenders = &scene.run.study.contenders;
    contenders.iter().position(|contender| contender.label == label).unwrap_or(contenders.len())
}

/// The trace `name` of a trial or a preprocessed object.
///
/// # Errors
/// [`RenderError::NotStored`] if it was not kept.
pub(super) fn trace<'s>(
    scene: &Scene<'s>,
    of: impl Into<Owner>,
    name: &str,
) -> Result<&'s Trace, RenderError> {
    let of = of.into();
    scene.run.trace(of.clone(), name).ok_or_else(|| RenderError::NotStored {
        what: format!("the trace `{name}` of `{}`", scene.run.owner(&of)),
    })
}

/// What names the instance of this number of the problem group `problems`.
///
/// # Errors
/// [`RenderError::NotStored`] if there is none.
pub(super) fn instance<'s>(
    scene: &Scene<'s>,
    problems: &str,
    number: u32,
) -> Result<&'s Arc<InstanceKey>, RenderError> {
    let found = scene.run.preprocessing(problems).find(|row| row.key.instance == number);
    let missing = || RenderError::NotStored { what: format!("instance {number} of `{problems}`") };
    found.map(|row| &row.key).ok_or_else(missing)
}

/// The first trial of `contender` on the instance `number` of `problems`, for the query called `of_query`.
///
/// # Errors
/// [`RenderError::NotStored`] if there is none.
pub(super) fn trial<'s>(
    scene: &Scene<'s>,
    problems: &str,
    number: u32,
    of_query: Option<&str>,
    contender: &str,
) -> Result<&'s Row, RenderError> {
    let rows = scene.run.rows(problems, contender).into_iter();
    let mut wanted =
        rows.filter(|row| row.instance() == number && of_query.is_none_or(|name| row.query() == name));
    wanted.next().ok_or_else(|| RenderError::NotStored {
        what: format!("a trial of `{contender}` on instance {number} of `{problems}`"),
    })
}

/// The first trial of `contender` on `problems` that `is_wanted`.
///
/// # Errors
/// [`RenderError::NotStored`] if there is none.
pub(super) fn wanted_trial<'s>(
    scene: &Scene<'s>,
    problems: &str,
    contender: &str,
    is_wanted: impl Fn(&Row) -> bool,
) -> Result<&'s Row, RenderError> {
    let mut rows = scene.run.rows(problems, contender).into_iter();
    let missing = || RenderError::NotStored { what: format!("a trial of `{contender}` on `{problems}`") };
    rows.find(|row| is_wanted(row)).ok_or_else(missing)
}

/// The instance whose saving is nearest to the median over all instances; the first if nothing is saved. The saving is
/// the last contender's of the first one's way. Every contender has a trial with the trace `name` for the query called
/// `of_query` there.
///
/// # Errors
/// [`RenderError::NotStored`] if there is none.
pub(super) fn shared_instance(
    scene: &Scene<'_>,
    problems: &str,
    of_query: &str,
    contenders: &[String],
    name: &str,
) -> Result<u32, RenderError> {
    let has_it = |number: u32, contender: &String| {
        trial(scene, problems, number, Some(of_query), contender)
            .is_ok_and(|row| scene.run.trace(&row.key, name).is_some())
    };
    let group = scene.run.study.groups.iter().find(|group| group.label == problems);
    let instances = 0..group.map_or(0, |group| group.instances);
    let kept: Vec<u32> = instances
        .filter(|instance| contenders.iter().all(|contender| has_it(*instance, contender)))
        .collect();
    let savings = savings(scene, problems, of_query, contenders);
    let off = |instance: &u32| savings.off_median(*instance);
    let found = kept.iter().copied().min_by(|a, b| off(a).total_cmp(&off(b)));
    found.ok_or_else(|| RenderError::NotStored {
        what: format!(
            "the trace `{name}` of {} for query {of_query} on one instance",
            contenders.join(" and ")
        ),
    })
}

/// By instance, what the last contender saves of the first one's way on a query, percent.
pub(super) fn savings(scene: &Scene<'_>, problems: &str, of_query: &str, contenders: &[String]) -> Savings {
    let [first, .., last] = contenders else { return Savings::default() };
    let all = trials(scene.run, problems, last);
    let metric = metric::find("path_length_mm");
    let query = Some(of_query.to_owned());
    Savings::new(
        &Selection { against: Some(first.clone()), metric, query: query.map(|query| vec![query]), ..all },
        scene.evidence,
    )
}
