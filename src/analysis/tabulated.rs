//! Statistics of the records that tables show: over the trials of a row, and savings of one trial against another.

use super::context::Context;
use super::evidence::{Evidence, Run};
use super::metric::{self, Metric};
use super::selection::{Selection, cases};
use super::selection_spec::SelectionSpec;
use super::statistic;
use base::settings::{Settings, SettingsError};
use engine::space::WorldKind;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeSet;
use study::paper::results::{BlockSpec, CellSpec, ResultsSpec, Show};
use study::paper::{Claim, Paper};
use study::record::{PreprocessingRow, Row, Status};
use study::{Interpretation, Study, name, recorded_mark};

/// A table of results: its head and, block by block, its rows; a dash where there is nothing.
pub struct Grid {
    /// The heads of its columns; that of the labels is empty.
    pub head: Vec<String>,
    /// The blocks with their headings; a row begins with its label.
    pub blocks: Vec<(String, Vec<Vec<String>>)>,
}

/// The cells of `table`.
///
/// # Errors
/// What is not stored: a run of its study, a metric.
pub fn grid(evidence: &Evidence<'_>, table: &ResultsSpec) -> Result<Grid, String> {
    let study = table.study.get_ref();
    let run = evidence.run(study).ok_or_else(|| format!("a run of `{study}`"))?;
    let metric = |cell: &CellSpec| {
        metric::find(cell.metric.get_ref()).ok_or_else(|| format!("the metric `{}`", cell.metric.get_ref()))
    };
    let metrics = table.cells.iter().map(metric).collect::<Result<Vec<&Metric>, _>>()?;
    let titles =
        table.cells.iter().zip(&metrics).map(|(cell, m)| cell.label.clone().unwrap_or_else(|| m.title()));
    let head = std::iter::once(String::new()).chain(titles).collect();
    let row = |block: &BlockSpec, label: &String| {
        let cells = table.cells.iter().zip(&metrics).map(|(cell, metric)| {
            let group = if cell.beside { block.beside.as_ref() } else { Some(&block.problems) };
            cell_of(run, group.map_or("", |group| group.get_ref()), label, cell, metric)
        });
        std::iter::once(label.clone()).chain(cells).collect::<Vec<String>>()
    };
    let block = |block: &BlockSpec| {
        let rows = table.rows.iter().map(|label| row(block, label));
        (block.title.clone(), rows.collect())
    };
    Ok(Grid { head, blocks: table.blocks.iter().map(block).collect() })
}

/// The caption of `table`, and which of its rows were recorded.
pub fn table_caption(evidence: &Evidence<'_>, table: &ResultsSpec) -> String {
    let study = evidence.run(table.study.get_ref()).map(|run| run.study);
    let recorded = study.into_iter().flat_map(Study::clock_bound);
    let mark = recorded_mark(recorded.filter(|label| table.rows.iter().any(|row| row == label)));
    std::iter::once(table.caption.clone()).chain(mark).collect::<Vec<_>>().join(" ")
}

/// The median of `metric` over what the problem group prepared, if the contender searches it: a planner from outside takes any
/// world, and is given none of what was prepared.
fn preprocessing(run: &Run<'_>, group: &str, label: &str, metric: &Metric) -> Option<f64> {
    let contender = run.study.contenders.iter().find(|one| one.label == label)?;
    let searches = contender.stages.iter().any(|stage| stage.entry.needs != WorldKind::Any);
    let count = |row: &PreprocessingRow| Some(row.values.get(metric.column)?.as_f64() * metric.scale);
    let counts: Vec<f64> = run.preprocessing(group).filter_map(count).collect();
    statistic::median(&counts).filter(|_| searches && !contender.is_recorded())
}

/// What `cell` shows of the trials of the contender called `label` in a problem group; a dash if there is nothing.
fn cell_of(run: &Run<'_>, group: &str, label: &str, cell: &CellSpec, metric: &Metric) -> String {
    let number = |value: f64| {
        if value.is_finite() { format!("{value:.*}", cell.decimals) } else { "∞".to_owned() }
    };
    let rows = run.rows(group, label);
    let measured = |run: &Run<'_>| {
        let measured: Vec<_> =
            rows.iter().map(|row| (metric.is_given_by(row), run.value(row, metric))).collect();
        with_failures(&measured, metric.is_clock())
    };
    let values = measured(run);
    let quantile = |share: f64| statistic::quantile(&values, share);
    let finite: Vec<f64> = values.iter().copied().filter(|value| value.is_finite()).collect();
    let ended = |status: Status| {
        let count = rows.iter().filter(|row| row.status == status).count();
        (!rows.is_empty()).then(|| number(100.0 * count as f64 / rows.len() as f64))
    };
    let found = match cell.show {
        Show::Median => quantile(0.5).map(number),
        Show::Quartiles if values.len() < 2 => quantile(0.5).map(number),
        Show::Quartiles => [0.5, 0.25, 0.75]
            .map(quantile)
            .into_iter()
            .collect::<Option<Vec<f64>>>()
            .map(|q| format!("{} [{}, {}]", number(q[0]), number(q[1]), number(q[2]))),
        Show::Sessions => (1..=run.sessions())
            .map(|session| statistic::median(&measured(&run.in_session(session as u32))).map(number))
            .collect::<Option<Vec<String>>>()
            .map(|medians| medians.join(" · ")),
        Show::Percent => statistic::mean(&finite).map(|share| number(100.0 * share)),
        Show::Ratio => cell.against.as_ref().and_then(|base| {
            let pairs = run.pairs(group, base.get_ref(), label).into_iter();
            let values =
                pairs.filter_map(|pair| run.value(pair.base, metric).zip(run.value(pair.other, metric)));
            statistic::ratio(&values.collect::<Vec<_>>()).map(|ratio| number(100.0 * ratio))
        }),
        Show::Solved => ended(Status::Solved),
        Show::Refused => ended(Status::Rejected),
        Show::NoPath => ended(Status::NoPath),
        Show::Spent => ended(Status::BudgetSpent),
        Show::Failed => {
            let failed: Vec<f64> =
                rows.iter().filter(|row| !row.is_solved()).filter_map(|row| run.value(row, metric)).collect();
            statistic::median(&failed).map(number)
        }
        Show::Value => rows.iter().find_map(|row| run.value(row, metric)).map(number),
        Show::Preprocessing => preprocessing(run, group, label, metric).map(number),
    };
    found.unwrap_or_else(|| "–".to_owned())
}

/// The values of trials, each solved or not and measured or not; a failure is infinite. What the clock did not read has
/// not failed, nor has what was counted in no trial that was solved.
fn with_failures(trials: &[(bool, Option<f64>)], is_clock: bool) -> Vec<f64> {
    let solved = || trials.iter().filter(|(is_solved, _)| *is_solved);
    let is_counted = solved().next().is_none() || solved().any(|(_, value)| value.is_some());
    let value = |(is_solved, value): &(bool, Option<f64>)| match (is_solved, value) {
        (true, value) => *value,
        (false, None) if is_clock || !is_counted => None,
        (false, _) => Some(f64::INFINITY),
    };
    trials.iter().filter_map(value).collect()
}

/// How many instances a figure is about, and of how many trials how many were solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Trials {
    /// Independent instances.
    pub instances: usize,
    /// Trials that were solved.
    pub solved: usize,
    /// Trials.
    pub all: usize,
}

/// The trials of the problem groups, contenders and points of sweeps that `settings` name, of all where they name none.
pub fn trials(run: &Run<'_>, settings: Option<&toml::Table>) -> Trials {
    let named = settings.into_iter().flat_map(toml::Table::values).flat_map(texts_in).collect();
    let groups: Vec<&str> = run.study.groups.iter().map(|group| group.label.as_str()).collect();
    let contenders: Vec<&str> = run.study.contenders.iter().map(|one| one.label.as_str()).collect();
    let points: Vec<String> = run.study.sweep_points().iter().map(|point| name::sweep(&point.key)).collect();
    let points = among(points.iter().map(String::as_str).collect(), &named);
    let groups = among(groups, &named);
    let contenders = among(contenders, &named);
    let rows = groups.iter().flat_map(|group| contenders.iter().flat_map(|one| run.rows(group, one)));
    let is_shown =
        |row: &&Row| row.key.sweep.values().is_empty() || points.contains(&&*name::sweep(&row.key.sweep));
    let rows: Vec<&Row> = rows.filter(is_shown).collect();
    let instances: BTreeSet<_> = rows.iter().map(|row| (&row.key.on.group, row.instance())).collect();
    let solved = rows.iter().filter(|row| row.is_solved()).count();
    Trials { instances: instances.len(), solved, all: rows.len() }
}

/// Every text in `value`.
pub fn texts_in(value: &toml::Value) -> Vec<&str> {
    match value {
        toml::Value::String(text) => vec![text],
        toml::Value::Array(elements) => elements.iter().flat_map(texts_in).collect(),
        toml::Value::Table(table) => table.values().flat_map(texts_in).collect(),
        _ => Vec::new(),
    }
}

/// Those of `labels` that are named; all if none is.
fn among<'a>(labels: Vec<&'a str>, named: &BTreeSet<&str>) -> Vec<&'a str> {
    let found: Vec<&str> = labels.iter().copied().filter(|label| named.contains(label)).collect();
    if found.is_empty() { labels } else { found }
}

/// Means over instances of the shares, in per cent, that `part` has of `whole`; an instance without a whole is left out.
pub fn mean_percent<T>(
    instances: &[T],
    part: impl Fn(&T) -> Option<f64>,
    whole: impl Fn(&T) -> Option<f64>,
) -> Option<f64> {
    let share = |instance: &T| Some(100.0 * part(instance)? / whole(instance).filter(|whole| *whole > 0.0)?);
    statistic::mean(&instances.iter().filter_map(share).collect::<Vec<f64>>())
}

/// What stands beside a printed number: the first trial of a selection.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Beside {
    /// The trials; with `against`, what is saved against it in per cent.
    select: SelectionSpec,
}

/// The selection whose first trial stands beside the printed number of `claim`.
///
/// # Errors
/// Those of [`Selection::new`]; it names no metric, or not one contender.
pub fn selected<'a>(
    paper: &'a Paper,
    (claim, point): (&'a Claim, &'a Interpretation),
    beside: &'a Settings,
) -> Result<Selection<'a>, SettingsError> {
    let context = Context { claim, settings: beside, paper, point };
    let selection = Selection::new(&context, &beside.read::<Beside>()?.select)?;
    selection.contender(&context)?;
    selection.metric(&context)?;
    Ok(selection)
}

/// The number of the first trial of `beside`, a table's own selection for the claim called `id`, or what it saves in per cent.
///
/// # Errors
/// What is not stored.
pub fn beside(evidence: &Evidence<'_>, id: &str, beside: &Settings) -> Result<Option<f64>, String> {
    let claim = evidence.paper.claim(id).ok_or_else(|| format!("the claim `{id}`"))?;
    let selection =
        selected(evidence.paper, (claim, &evidence.point), beside).map_err(SettingsError::message)?;
    let instances = selection.instances(evidence);
    let first = cases(&instances).next().ok_or_else(|| format!("trials of {}", selection.description()))?;
    Ok(if selection.against.is_some() { first.saving_percent() } else { first.value })
}

#[cfg(test)]
mod tests {
    use super::with_failures;

    #[test]
    fn a_failure_is_infinite_only_in_what_solved_trials_count() {
        let inf = f64::INFINITY;
        let solved = |value| (true, Some(value));
        let failed = (false, None);
        assert_eq!(with_failures(&[solved(2.0), failed], false), [2.0, inf]);
        assert_eq!(with_failures(&[solved(2.0), (false, Some(1.0))], false), [2.0, inf]);
        assert_eq!(with_failures(&[failed, failed], false), [inf, inf], "nothing is solved");
        assert_eq!(with_failures(&[(true, None), failed], false), [0.0; 0], "nobody counts it");
        assert_eq!(with_failures(&[solved(2.0), failed], true), [2.0], "the clock did not read it");
    }
}
