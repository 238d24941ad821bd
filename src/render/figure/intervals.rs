//! Estimates with intervals by row: shares of solved queries, their differences from one problem group, or reductions.

use super::{Entry, Kind, Scene, ask};
use crate::analysis::metric::Metric;
use crate::analysis::selection::Selection;
use crate::analysis::shown::{mean_difference, mean_solved, of_all};
use crate::analysis::statistic::{Estimate, INTERVALS, OverallStatistic};
use crate::render::RenderError;
use crate::render::chart::marks::Line;
use crate::render::chart::rows::Interval as Bar;
use crate::render::chart::rules::Rules;
use crate::render::chart::{Axis, Panel, Sheet};
use crate::render::effect::less_than;
use crate::render::latex::{Cell, Column, Table};
use crate::render::style::{INK, Stroke, VERMILLION, Width, series_color, series_marker};
use base::settings::{Accepted, Settings, SettingsError};
use schemars::JsonSchema;
use serde::Deserialize;
use stats::interval::Interval;
use study::Study;
use study::key::SweepKey;
use study::paper::Paper;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "intervals",
    about: "shares solved, their differences from one group, or reductions, by problem group or contender, with intervals",
    statistic: "Means over instances with 95 % bootstrap intervals; {n}.",
    settings: Accepted::shape::<Read>(),
    example: r#"
problems = ["cell"]
sweep = "samples=800"
panels = [{ printed = ["t2.original.800"] }]
"#,
    build: |settings, study, paper| Ok(Box::new(Intervals::new(settings, study, paper)?)),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Read {
    /// The problem groups of shares, by their labels: of several each is a row, of one each contender is.
    #[serde(default)]
    problems: Vec<String>,
    /// The contenders; all of the study if absent.
    #[serde(default)]
    contenders: Vec<String>,
    /// Those among them that do the same whatever was drawn: they have no interval.
    #[serde(default)]
    certain: Vec<String>,
    /// The point of the sweeps that is shown, as `setting=value,…`; empty without sweeps.
    #[serde(default)]
    sweep: String,
    /// The panels, in their order.
    panels: Vec<PanelSpec>,
    /// How many panels stand beside each other; all of them if absent.
    #[schemars(range(min = 1, max = 12))]
    columns: Option<usize>,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct PanelSpec {
    /// What stands above it.
    #[serde(default)]
    title: String,
    /// The metric whose reductions are shown; shares of solved queries if absent.
    metric: Option<String>,
    /// The problem groups of a reduction, taken together.
    #[serde(default)]
    problems: Vec<String>,
    /// The contender that is reduced from; of shares the problem group that they are shown as differences from.
    against: Option<String>,
    /// Claims whose printed numbers are marked.
    #[serde(default)]
    printed: Vec<String>,
}

struct Intervals {
    read: Read,
    contenders: Vec<String>,
    sweep: SweepKey,
    panels: Vec<What>,
}

/// What a panel shows, looked up.
struct What {
    metric: Option<&'static Metric>,
    printed: Vec<f64>,
}

impl Intervals {
    fn new(settings: &Settings, study: &Study, paper: &Paper) -> Result<Self, SettingsError> {
        let read: Read = settings.read()?;
        let mut panels = Vec::new();
        for (index, panel) in read.panels.iter().enumerate() {
            let metric =
                panel.metric.as_ref().map(|name| ask::produced(settings, study, name)).transpose()?;
            let (group, contender) =
                if metric.is_some() { (&None, &panel.against) } else { (&panel.against, &None) };
            ask::known(settings, study, panel.problems.iter().chain(group), contender)?;
            let printed =
                ask::all_printed(settings, paper, &format!("panels.{index}.printed"), &panel.printed)?;
            panels.push(What { metric, printed });
        }
        ask::known(settings, study, &read.problems, read.contenders.iter().chain(&read.certain))?;
        let sweep = ask::sweep(settings, study, &read.sweep)?;
        let all = study.contenders.iter().map(|contender| contender.label.clone());
        let contenders = if read.contenders.is_empty() { all.collect() } else { read.contenders.clone() };
        Ok(Self { read, contenders, sweep, panels })
    }

    /// Whether each problem group is a row; else each contender is.
    fn is_by_group(&self) -> bool {
        self.read.problems.len() > 1
    }

    /// The rows from the top down, each group with how many of its queries could be posed if not all.
    fn names(&self, scene: &Scene<'_>) -> Vec<String> {
        if !self.is_by_group() {
            return self.contenders.clone();
        }
        let named = |problems: &String| match scene.run.posed_queries(problems) {
            [posed, all] if posed < all => format!("{problems} ({posed} of {all} groups posed)"),
            _ => problems.clone(),
        };
        self.read.problems.iter().map(named).collect()
    }

    /// What panel `index` shows of `contender`, in one row.
    fn estimate(&self, scene: &Scene<'_>, index: usize, row: usize, contender: &str) -> Option<Estimate> {
        let spec = &self.read.panels[index];
        let what = &self.panels[index];
        let contenders = [contender.to_owned()];
        let study = scene.run.study;
        if what.metric.is_some() {
            let of = Selection::all(study, &spec.problems, &contenders);
            let of = Selection { metric: what.metric, against: spec.against.clone(), ..of };
            let names = [study.name.as_str(), &spec.title, contender];
            return of_all(OverallStatistic::ReductionPercent, &of, scene.evidence, &names);
        }
        let group = &self.read.problems[if self.is_by_group() { row } else { 0 }];
        let of = |group: &str| ask::trials_at(scene.run, group, contender, &self.sweep);
        let names = [study.name.as_str(), group, contender];
        match &spec.against {
            Some(base) => mean_difference([&of(base), &of(group)], scene.evidence, &names),
            None => mean_solved(&of(group), scene.evidence, &names),
        }
    }

    /// What stands in each row: the place across the rows, the contender, what was found.
    fn found(&self, scene: &Scene<'_>, index: usize) -> Vec<(f64, &String, Option<Estimate>)> {
        let step = 0.7 / self.contenders.len() as f64;
        let rows = if self.is_by_group() { self.read.problems.len() } else { 1 };
        let mut found = Vec::new();
        for row in 0..rows {
            for (place, contender) in self.contenders.iter().enumerate() {
                let within = row as f64 - 0.35 + step * (place as f64 + 0.5);
                let at = if self.is_by_group() { within } else { place as f64 };
                found.push((at, contender, self.estimate(scene, index, row, contender)));
            }
        }
        found
    }

    fn axis(&self, index: usize, found: &[(f64, &String, Option<Estimate>)]) -> Result<Axis, RenderError> {
        let spec = &self.read.panels[index];
        let what = &self.panels[index];
        if let Some(metric) = what.metric {
            let ends = found
                .iter()
                .filter_map(|(_, _, e)| e.as_ref())
                .map(ask::bar)
                .flat_map(|bar| [bar.low, bar.high]);
            let title = less_than(metric, spec.against.as_deref().unwrap_or("the other"));
            return Ok(Axis::over(title, ends.chain(what.printed.iter().copied()).chain([0.0])));
        }
        match &spec.against {
            Some(against) => Axis::linear(format!("difference from “{against}” (points)"), -103.0, 103.0),
            None => Axis::linear("groups solved (%)", -3.0, 103.0),
        }
    }

    fn panel(&self, scene: &Scene<'_>, index: usize, names: &[String]) -> Result<Panel, RenderError> {
        let spec = &self.read.panels[index];
        let what = &self.panels[index];
        let found = self.found(scene, index);
        let is_first = index.is_multiple_of(self.columns());
        let shown = names.iter().map(|name| if is_first { name.as_str() } else { "" });
        let title = titled(&spec.title, what, &found);
        let mut panel = Panel::new(title, self.axis(index, &found)?, Axis::names("", shown).reversed());
        if spec.against.is_some() {
            let zero = vec![[0.0, -0.5], [0.0, names.len() as f64 - 0.5]];
            panel.add(Line::through(zero, Stroke::solid(INK, 0.6)));
        }
        for (at, contender, estimate) in &found {
            let Some(estimate) = estimate else { continue };
            let place = self.contenders.iter().position(|label| label == *contender).unwrap_or(0);
            let index = if self.is_by_group() { ask::series(scene, contender, place) } else { 0 };
            let bar = match what.metric {
                Some(_) => ask::bar(estimate),
                None if self.read.certain.contains(*contender) => {
                    Interval::new(estimate.value, estimate.value)
                }
                None => estimate.interval,
            };
            panel.add(Bar {
                row: *at,
                values: [bar.low, estimate.value, bar.high],
                marker: series_marker(index),
                color: series_color(index),
                label: if self.is_by_group() { (*contender).clone() } else { String::new() },
            });
        }
        let marks = what.printed.iter().map(|printed| (*printed, format!("printed {printed}"))).collect();
        panel.add(Rules { marks, stroke: Stroke::solid(VERMILLION, 1.0) });
        Ok(panel)
    }

    fn columns(&self) -> usize {
        self.read.columns.unwrap_or(self.read.panels.len())
    }
}

/// The title of a panel; of reductions with the number of instances that they rest on, the least and the greatest of its rows.
fn titled(title: &str, what: &What, found: &[(f64, &String, Option<Estimate>)]) -> String {
    let units = || found.iter().filter_map(|(_, _, estimate)| Some(estimate.as_ref()?.units));
    match (what.metric, units().min(), units().max()) {
        (Some(_), Some(least), Some(most)) if least == most => format!("{title}, n = {least}"),
        (Some(_), Some(least), Some(most)) => format!("{title}, n = {least} to {most}"),
        _ => title.to_owned(),
    }
}

impl Kind for Intervals {
    fn statistic(&self) -> Option<&'static str> {
        self.panels
            .iter()
            .any(|panel| panel.metric.is_some())
            .then_some("Mean reductions where both solve, with 95 % bootstrap intervals; {n}.")
    }

    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let names = self.names(scene);
        let row_pt = if self.is_by_group() { 6.0 + 5.0 * self.contenders.len() as f64 } else { 13.0 };
        let height = (names.len() as f64 * row_pt).max(60.0);
        let panels = (0..self.panels.len()).map(|index| self.panel(scene, index, &names));
        Sheet::new(Width::Double, self.columns(), height).level().with(panels)
    }

    fn table(&self, scene: &Scene<'_>, label: &str, caption: &str) -> Result<Option<Table>, RenderError> {
        let Some(against) = self.read.panels[0].against.as_ref().filter(|_| self.panels[0].metric.is_some())
        else {
            return Ok(None);
        };
        let specs = &self.read.panels;
        let columns: Vec<Column> =
            [Column::Left].into_iter().chain(specs.iter().map(|_| Column::Right)).collect();
        let mut table = Table::new(label, caption, &columns);
        let row = |first: &str, cells: Vec<String>| {
            [first.to_owned()].into_iter().chain(cells).map(Cell::from).collect::<Vec<_>>()
        };
        table.head(row("Reduction in %", specs.iter().map(|panel| panel.title.clone()).collect()));
        let dash = || "–".to_owned();
        let printed = self.panels.iter().map(|what| what.printed.first().map_or_else(dash, f64::to_string));
        table.row(row("printed", printed.collect()));
        let found: Vec<_> = (0..specs.len()).map(|index| self.found(scene, index)).collect();
        for (place, contender) in self.contenders.iter().enumerate() {
            let shown =
                |e: &Estimate| format!("{:.1} [{:.1}, {:.1}]", e.value, e.interval.low, e.interval.high);
            let cells = found.iter().map(|panel| panel[place].2.as_ref().map_or_else(dash, shown));
            table.row(row(contender, cells.collect()));
        }
        let what = OverallStatistic::ReductionPercent.name();
        table.note(format!("The {what} against {against}, with 95 % intervals over instances: {INTERVALS}."));
        Ok(Some(table))
    }
}
