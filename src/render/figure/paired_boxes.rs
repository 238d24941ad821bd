//! A metric by query and contender over the instances on which all compared contenders solve the query, and what the last of
//! them saves against the first.

use super::{Entry, Kind, Scene, ask};
use crate::analysis::metric::Metric;
use crate::analysis::selection::Selection;
use crate::analysis::shown::{Spread, savings_by_query, spreads_by_query};
use crate::render::RenderError;
use crate::render::chart::marks::Line;
use crate::render::chart::rows::BoxStrip;
use crate::render::chart::{Axis, Panel, Sheet};
use crate::render::latex::{Cell, Column, Table};
use crate::render::style::{Dash, GREY, Stroke, Width, series_color};
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use study::key::SweepKey;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "paired_boxes",
    about: "a metric by query and contender, boxes over the instances on which all compared contenders solve the query, and savings",
    statistic: "Median, quartiles, 5–95 %, where all solve; {n}.",
    settings: Accepted::shape::<Read>(),
    example: r#"
problems = "cell"
metric = "path_length_mm"
contenders = ["Original A*", "Improved A*"]
axis = "group of Table 1"
savings = ["length.least", "length.greatest"]
"#,
    build: |settings, study, paper| {
        let read: Read = settings.read()?;
        ask::known(settings, study, [&read.problems], &read.contenders)?;
        let metric = ask::metric(settings, &read.metric)?;
        let printed = ask::all_printed(settings, paper, "savings", read.savings.iter().flatten())?;
        let sweep = ask::sweep(settings, study, &read.sweep)?;
        if read.savings.is_some() && !read.queries.is_empty() {
            return Err(settings.error_at("queries", "savings are over all queries; one of both is accepted"));
        }
        for query in &read.queries {
            ask::query(settings, study, &read.problems, query, (&["queries"], query))?;
        }
        Ok(Box::new(PairedBoxes { read, metric, sweep, printed }))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Read {
    /// The problem group, by its label.
    problems: String,
    /// The metric: a name that `replan list metrics` gives, or one that an interpretation gives a meaning.
    metric: String,
    /// The contenders, by their labels.
    contenders: Vec<String>,
    /// The queries, by their names; all if empty.
    #[serde(default)]
    queries: Vec<String>,
    /// What stands along the axis.
    axis: String,
    /// The point of the sweeps, in a study that has any.
    #[serde(default)]
    sweep: String,
    /// Adds a panel, and a table, of what the last contender saves against the first; claims whose printed savings are drawn
    /// as lines.
    savings: Option<Vec<String>>,
}

struct PairedBoxes {
    read: Read,
    metric: &'static Metric,
    sweep: SweepKey,
    /// Printed savings.
    printed: Vec<f64>,
}

/// With more contenders than this there is no room for single values beside their boxes.
const MOST_STRIPS: usize = 3;

/// By query: of each contender the values on the instances that all of them solve.
type ByQuery = Vec<(String, Vec<Spread>)>;

/// By query and over all: what the last contender saves.
type Savings = Vec<(String, Spread)>;

impl PairedBoxes {
    /// The question to the instances: every contender's metric on them, held against the first one's.
    fn selection<'s>(&self, scene: &Scene<'s>) -> Selection<'s> {
        let groups = std::slice::from_ref(&self.read.problems);
        Selection {
            metric: Some(self.metric),
            sweep: Some(vec![self.sweep.clone()]),
            against: self.read.contenders.first().cloned(),
            whole_instances: true,
            ..Selection::all(scene.run.study, groups, &self.read.contenders)
        }
    }

    /// What is shown of each query that is requested.
    fn values(&self, scene: &Scene<'_>) -> ByQuery {
        let mut values = spreads_by_query(&self.selection(scene), scene.evidence);
        values.retain(|(name, _)| self.read.queries.is_empty() || self.read.queries.contains(name));
        values
    }

    /// One box a query and contender.
    fn boxes(&self, scene: &Scene<'_>, values: &ByQuery) -> Result<Panel, RenderError> {
        let names = values.iter().map(|(name, columns)| match columns.first() {
            Some(column) => name_with_count(name, column),
            None => name.clone(),
        });
        let columns = || values.iter().flat_map(|(_, columns)| columns);
        let top = columns().flat_map(|column| &column.values).copied().fold(0.0, f64::max);
        // Single values beyond the whiskers are only drawn where there are strips of them.
        let whiskers = columns().filter_map(|column| Some(column.quantiles?[4]));
        let top = if self.has_strips() { top } else { whiskers.fold(0.0, f64::max) };
        let y = Axis::linear(self.metric.title(), 0.0, if top > 0.0 { top * 1.04 } else { 1.0 })?;
        // One panel needs no title.
        let title = if self.read.savings.is_some() { "of each contender" } else { "" };
        let mut panel = Panel::new(title, Axis::names(&self.read.axis, names), y);
        let step = 0.8 / self.read.contenders.len() as f64;
        for (place, (_, columns)) in values.iter().enumerate() {
            for (index, column) in columns.iter().enumerate() {
                let Some(quantiles) = column.quantiles else { continue };
                let contender = &self.read.contenders[index];
                panel.add(BoxStrip {
                    at: place as f64 - 0.4 + step * (index as f64 + 0.5),
                    width: step * 0.62,
                    quantiles,
                    values: if self.has_strips() { column.values.clone() } else { Vec::new() },
                    color: series_color(ask::series(scene, contender, index)),
                    label: if place == 0 { contender.clone() } else { String::new() },
                });
            }
        }
        Ok(panel)
    }

    fn has_strips(&self) -> bool {
        self.read.contenders.len() <= MOST_STRIPS
    }

    fn savings_panel(&self, scene: &Scene<'_>, savings: &Savings) -> Result<Panel, RenderError> {
        let low = savings.iter().flat_map(|(_, saving)| &saving.values).copied().fold(0.0, f64::min);
        let names = savings.iter().map(|(name, saving)| name_with_count(name, saving));
        let y = Axis::linear("saving (%)", low - 5.0, 103.0)?;
        let contenders = (self.read.contenders.first(), self.read.contenders.last());
        let title = match contenders {
            (Some(base), Some(other)) => format!("what {other} saves of what {base} takes"),
            _ => String::new(),
        };
        let mut panel = Panel::new(&title, Axis::names(&self.read.axis, names), y);
        let dashed = Stroke::solid(GREY, 0.9).dashed(Dash::Dashed);
        let right = savings.len() as f64 - 0.5;
        for printed in &self.printed {
            let line = Line::through(vec![[-0.5, *printed], [right, *printed]], dashed);
            panel.add(line.labelled("printed ends"));
        }
        let last = self.read.contenders.len() - 1;
        let color = series_color(ask::series(scene, &self.read.contenders[last], last));
        for (place, (_, saving)) in savings.iter().enumerate() {
            let Some(quantiles) = saving.quantiles else { continue };
            panel.add(BoxStrip {
                at: place as f64,
                width: 0.5,
                quantiles,
                values: saving.values.clone(),
                color,
                label: String::new(),
            });
        }
        Ok(panel)
    }
}

/// The name of a query with how many instances its numbers are from.
fn name_with_count(name: &str, numbers: &Spread) -> String {
    format!("{name} (n = {})", numbers.values.len())
}

impl Kind for PairedBoxes {
    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let values = self.values(scene);
        let mut sheet = Sheet::new(Width::Double, 1, 190.0);
        sheet.add(self.boxes(scene, &values)?);
        if self.read.savings.is_some() {
            sheet.add(self.savings_panel(scene, &savings_by_query(&self.selection(scene), scene.evidence))?);
        }
        Ok(sheet)
    }

    fn table(&self, scene: &Scene<'_>, label: &str, caption: &str) -> Result<Option<Table>, RenderError> {
        if self.read.savings.is_none() {
            return Ok(None);
        }
        let values = self.values(scene);
        let mut kinds = vec![Column::Left];
        kinds.extend([Column::Right; 6]);
        let mut table = Table::new(label, caption, &kinds);
        let (first, last) = (&self.read.contenders[0], &self.read.contenders[self.read.contenders.len() - 1]);
        let heads = ["query", "n", first, last, "mean saving (%)", "5 % to 95 %", "least to greatest"];
        table.head(heads.map(Cell::from).to_vec());
        for (place, (name, saved)) in
            savings_by_query(&self.selection(scene), scene.evidence).iter().enumerate()
        {
            let number = |value: Option<f64>| value.map_or("–".to_owned(), |value| format!("{value:.1}"));
            let middle = |column: usize| {
                let of_query = values.get(place).and_then(|(_, columns)| columns.get(column));
                number(of_query.and_then(Spread::median))
            };
            let range = |ends: Option<[f64; 2]>| {
                format!("{} to {}", number(ends.map(|e| e[0])), number(ends.map(|e| e[1])))
            };
            let row = [
                name.clone(),
                saved.values.len().to_string(),
                middle(0),
                middle(self.read.contenders.len() - 1),
                number(saved.mean),
                range(saved.quantiles.map(|q| [q[0], q[4]])),
                range(saved.ends()),
            ];
            table.row(row.map(Cell::from).to_vec());
        }
        table.note(format!("{}: medians over instances; savings instance by instance.", self.metric.title()));
        Ok(Some(table))
    }
}
