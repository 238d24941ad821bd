//! A metric by query and contender over the draws on which all compared contenders solve the query.

use super::{Entry, Kind, Scene, ask};
use crate::analysis::metric::Metric;
use crate::analysis::stats::summary::quantile_type7;
use crate::render::RenderError;
use crate::render::chart::rows::BoxStrip;
use crate::render::chart::{Axis, Panel, Sheet};
use crate::render::style::{Width, series_color};
use crate::study::record::Status;
use serde::Deserialize;
use std::collections::BTreeMap;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "paired_boxes",
    about: "a metric by query and contender, boxes over the draws on which all compared contenders solve the query",
    build: |settings, study, _paper| {
        let read: Read = settings.read()?;
        ask::known(settings, study, std::slice::from_ref(&read.problems), &read.contenders)?;
        let metric = crate::analysis::metric::find(&read.metric)
            .ok_or_else(|| settings.error(format!("there is no metric `{}`", read.metric)))?;
        Ok(Box::new(PairedBoxes { read, metric }))
    },
};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Read {
    problems: String,
    metric: String,
    contenders: Vec<String>,
    axis: String,
}

struct PairedBoxes {
    read: Read,
    metric: &'static Metric,
}

/// With more contenders than this there is no room for single values beside their boxes.
const MOST_STRIPS: usize = 3;

/// By query: of each contender the values on the draws that all of them solve.
type ByQuery = Vec<(String, Vec<Vec<f64>>)>;

impl PairedBoxes {
    fn values(&self, scene: &Scene<'_>) -> ByQuery {
        let mut order: Vec<String> = Vec::new();
        let mut found: BTreeMap<(String, u32), Vec<f64>> = BTreeMap::new();
        for contender in &self.read.contenders {
            for row in scene.run.rows(&self.read.problems, contender) {
                let name = ask::query(row).to_owned();
                if !order.contains(&name) {
                    order.push(name.clone());
                }
                if let (Status::Solved, Some(value)) = (row.status, scene.run.value(row, self.metric)) {
                    found.entry((name, row.replicate)).or_default().push(value);
                }
            }
        }
        let contenders = self.read.contenders.len();
        let of_query = |name: String| {
            let all =
                found.iter().filter(|((query, _), values)| *query == name && values.len() == contenders);
            let rows: Vec<&Vec<f64>> = all.map(|(_, values)| values).collect();
            let columns = (0..contenders).map(|c| rows.iter().map(|row| row[c]).collect()).collect();
            (name, columns)
        };
        order.into_iter().map(of_query).collect()
    }
}

impl Kind for PairedBoxes {
    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let values = self.values(scene);
        let names = values
            .iter()
            .map(|(name, columns)| format!("{name} (n = {})", columns.first().map_or(0, Vec::len)));
        let top =
            values.iter().flat_map(|(_, columns)| columns.iter().flatten()).copied().fold(0.0, f64::max);
        let y = Axis::linear(self.metric.title(), 0.0, if top > 0.0 { top * 1.04 } else { 1.0 })?;
        let mut panel = Panel::new("", Axis::names(&self.read.axis, names), y);
        let step = 0.8 / self.read.contenders.len() as f64;
        for (place, (_, columns)) in values.iter().enumerate() {
            for (index, column) in columns.iter().enumerate().filter(|(_, column)| !column.is_empty()) {
                let quantile = |share| quantile_type7(column, share).unwrap_or(f64::NAN);
                panel.add(BoxStrip {
                    at: place as f64 - 0.4 + step * (index as f64 + 0.5),
                    width: step * 0.62,
                    quantiles: [0.05, 0.25, 0.5, 0.75, 0.95].map(quantile),
                    values: if self.read.contenders.len() > MOST_STRIPS {
                        Vec::new()
                    } else {
                        column.clone()
                    },
                    color: series_color(index),
                    label: if place == 0 { self.read.contenders[index].clone() } else { String::new() },
                });
            }
        }
        let mut sheet = Sheet::new(Width::Double, 1, 200.0);
        sheet.add(panel);
        Ok(sheet)
    }
}
