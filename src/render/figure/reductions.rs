//! What each contender saves of each printed reduction: means with intervals, and as a table.

use super::{Entry, Kind, Scene, check_labels, printed_value};
use crate::analysis::effect::reduction_percent;
use crate::analysis::metric;
use crate::render::RenderError;
use crate::render::chart::marks::Line;
use crate::render::chart::rows::Interval;
use crate::render::chart::rules::Rules;
use crate::render::chart::{Axis, Panel, Sheet};
use crate::render::latex::{Cell, Column, Table};
use crate::render::style::{BLUE, INK, Marker, Stroke, VERMILLION, Width};
use base::settings::{Accepted, none_called};
use schemars::JsonSchema;
use serde::Deserialize;
use stats::bootstrap::Estimate;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "reductions",
    about: "what each contender saves of each printed reduction: means with bootstrap intervals, and as a table",
    settings: Accepted::of::<Reductions>(),
    example: r#"
columns = 2
against = "A*"
contenders = ["Bidirectional only", "Weight only", "Deletion only", "Without bidirectional", "Without weight", "Without deletion", "Improved A*"]
panels = [
    { claim = "t1.reduction.cost", title = "simple: path cost", metric = "path_cost_cells", problems = ["simple cells", "simple rectangles", "simple bars"] },
    { claim = "t2.reduction.cost", title = "complex: path cost", metric = "path_cost_cells", problems = ["complex cells", "complex rectangles", "complex bars"] },
    { claim = "t1.reduction.turn", title = "simple: turn sum", metric = "turn_exterior_deg", problems = ["simple cells", "simple rectangles", "simple bars"] },
    { claim = "t2.reduction.turn", title = "complex: turn sum", metric = "turn_exterior_deg", problems = ["complex cells", "complex rectangles", "complex bars"] },
    { claim = "t1.reduction.nodes", title = "simple: nodes opened", metric = "opened", problems = ["simple cells", "simple rectangles", "simple bars"] },
    { claim = "t2.reduction.nodes", title = "complex: nodes opened", metric = "opened", problems = ["complex cells", "complex rectangles", "complex bars"] },
    { claim = "t1.reduction.time", title = "simple: time", metric = "plan_time_us", problems = ["simple cells", "simple rectangles", "simple bars"] },
    { claim = "t2.reduction.time", title = "complex: time", metric = "plan_time_us", problems = ["complex cells", "complex rectangles", "complex bars"] },
]
"#,
    build: |settings, study, paper| {
        let read: Reductions = settings.read()?;
        let contenders = read.contenders.iter().chain([&read.against]);
        check_labels(settings, study, contenders, read.panels.iter().flat_map(|panel| &panel.problems))?;
        for (index, panel) in read.panels.iter().enumerate() {
            if paper.claim(&panel.claim).is_none() {
                let known = paper.claims.iter().map(|claim| claim.id.as_str());
                let message = none_called("claim", &panel.claim, known);
                return Err(settings.error_at(&format!("panels.{index}.claim"), message));
            }
            let columns = study.columns();
            if !metric::find(&panel.metric).is_some_and(|metric| columns.contains(metric.column)) {
                let message =
                    format!("study `{}` does not produce the metric `{}`", study.name, panel.metric);
                return Err(settings.error_at(&format!("panels.{index}.metric"), message));
            }
        }
        Ok(Box::new(read))
    },
};

/// Height of a row, in points.
const ROW_PT: f64 = 11.0;

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Reductions {
    /// The panels, in their order.
    panels: Vec<PanelSpec>,
    /// How many panels stand beside each other.
    #[schemars(range(min = 1, max = 12))]
    columns: usize,
    /// From the top.
    contenders: Vec<String>,
    /// What is reduced from.
    against: String,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct PanelSpec {
    /// The claim that prints the reduction.
    claim: String,
    /// What stands above it.
    title: String,
    /// The metric: a name that `replan list metrics` gives, or one that a reading gives a meaning.
    metric: String,
    /// The problem groups, by their labels.
    problems: Vec<String>,
}

impl Reductions {
    fn estimates(&self, scene: &Scene<'_>, panel: &PanelSpec) -> Vec<Option<Estimate>> {
        let metric = metric::find(&panel.metric).expect("the metric was found when the settings were read");
        let of = |contender: &String| {
            reduction_percent(scene.run, &panel.problems, [contender, &self.against], metric)
        };
        self.contenders.iter().map(of).collect()
    }

    fn panel(&self, scene: &Scene<'_>, index: usize) -> Panel {
        let spec = &self.panels[index];
        let estimates = self.estimates(scene, spec);
        let printed = printed_value(scene.evidence, &spec.claim);
        let ends = estimates.iter().flatten().flat_map(|e| [e.interval.low, e.interval.high]);
        let x = Axis::over("reduction (%)", ends.chain(printed).chain([0.0]));
        let is_first = index.is_multiple_of(self.columns);
        let names = self.contenders.iter().map(|name| if is_first { name.as_str() } else { "" });
        let mut panel = Panel::new(&spec.title, x, Axis::names("", names).reversed());
        let zero = vec![[0.0, -0.5], [0.0, self.contenders.len() as f64 - 0.5]];
        panel.add(Line::through(zero, Stroke::solid(INK, 0.6)));
        for (row, estimate) in estimates.iter().enumerate() {
            let Some(estimate) = estimate else { continue };
            let values = [estimate.interval.low, estimate.value, estimate.interval.high];
            let label = "mean and 95 % interval over maps".to_owned();
            panel.add(Interval { row: row as f64, values, marker: Marker::Circle, color: BLUE, label });
        }
        if let Some(printed) = printed {
            let marks = vec![(printed, format!("printed {printed}"))];
            panel.add(Rules { marks, stroke: Stroke::solid(VERMILLION, 1.0) });
        }
        panel
    }
}

impl Kind for Reductions {
    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let height = ROW_PT * self.contenders.len() as f64;
        let mut sheet = Sheet::new(Width::Double, self.columns, height).level();
        for index in 0..self.panels.len() {
            sheet.add(self.panel(scene, index));
        }
        Ok(sheet)
    }

    fn table(&self, scene: &Scene<'_>, label: &str, caption: &str) -> Result<Option<Table>, RenderError> {
        let columns: Vec<Column> =
            [Column::Left].into_iter().chain(self.panels.iter().map(|_| Column::Right)).collect();
        let mut table = Table::new(label, caption, &columns);
        let row = |first: &str, cells: Vec<String>| {
            [Cell::from(first)].into_iter().chain(cells.into_iter().map(Cell::from)).collect::<Vec<_>>()
        };
        table.head(row("Reduction in %", self.panels.iter().map(|panel| panel.title.clone()).collect()));
        let printed = self.panels.iter().map(|panel| printed_value(scene.evidence, &panel.claim));
        let dash = || "–".to_owned();
        table.row(row("printed", printed.map(|p| p.map_or_else(dash, |p| p.to_string())).collect()));
        let estimates: Vec<Vec<Option<Estimate>>> =
            self.panels.iter().map(|panel| self.estimates(scene, panel)).collect();
        for (index, contender) in self.contenders.iter().enumerate() {
            let shown =
                |e: &Estimate| format!("{:.1} [{:.1}, {:.1}]", e.value, e.interval.low, e.interval.high);
            let cells = estimates.iter().map(|panel| panel[index].as_ref().map_or_else(dash, shown));
            table.row(row(contender, cells.collect()));
        }
        table.note("Reduction of the mean against A*, with 95 % bootstrap intervals over maps.");
        Ok(Some(table))
    }
}
