//! Shares of solved queries along a sweep: the mean over draws with a simultaneous band, printed rows on top.

use super::{Entry, Kind, Scene, ask};
use crate::analysis::draws::solved_percents;
use crate::render::RenderError;
use crate::render::chart::marks::{Band, Line, Points};
use crate::render::chart::{Axis, Panel, Sheet};
use crate::render::style::{Fill, Stroke, Width, series_color, series_marker, series_stroke};
use crate::study::Study;
use crate::study::key::SweepKey;
use crate::study::paper::Paper;
use base::seed;
use base::settings::{Accepted, Settings, SettingsError};
use schemars::JsonSchema;
use serde::Deserialize;
use stats::bands::{Band as Curve, sup_t};
use stats::bootstrap::Resampling;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "success_bands",
    about: "shares of solved queries along a sweep: mean over draws with a simultaneous band, printed rows on top",
    settings: Accepted::of::<Read>(),
    example: r#"
problems = "cell"
sweep = "samples"
axis = "samples N"
rows = [
    { contender = "Original A*", printed = "t2.original." },
    { contender = "Improved A*", printed = "t2.improved." },
]
"#,
    build: |settings, study, paper| Ok(Box::new(Shown::new(settings, study, paper)?)),
};

/// What the settings of a figure of rows say, with the printed rows looked up.
pub(super) struct Shown {
    pub(super) problems: String,
    /// The sweep's values as numbers and as records have them.
    pub(super) points: Vec<(f64, SweepKey)>,
    pub(super) axis: String,
    pub(super) rows: Vec<RowOf>,
}

/// One contender's curve and its printed row.
pub(super) struct RowOf {
    pub(super) contender: String,
    pub(super) printed: Vec<[f64; 2]>,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct Read {
    /// The problem group, by its label.
    problems: String,
    /// The setting that the study sweeps.
    sweep: String,
    /// What stands along the axis.
    axis: String,
    /// The contenders that are shown, one a panel.
    rows: Vec<ReadRow>,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct ReadRow {
    /// The contender, by its label.
    contender: String,
    /// What the claims of the printed cells are called before the sweep's value, if a row is printed.
    printed: Option<String>,
}

impl Shown {
    pub(super) fn new(settings: &Settings, study: &Study, paper: &Paper) -> Result<Self, SettingsError> {
        let read: Read = settings.read()?;
        let contenders: Vec<String> = read.rows.iter().map(|row| row.contender.clone()).collect();
        ask::known(settings, study, std::slice::from_ref(&read.problems), &contenders)?;
        if study.sweeps.len() > 1 {
            let message =
                format!("study `{}` sweeps more than `{}`, and one sweep is drawn", study.name, read.sweep);
            return Err(settings.error_at("sweep", message));
        }
        let value = |key: &SweepKey| key.value(&read.sweep)?.as_f64();
        let points = study.sweep_points().into_iter().map(|point| point.key);
        let points: Vec<(f64, SweepKey)> = points.filter_map(|key| Some((value(&key)?, key))).collect();
        if points.is_empty() {
            let message = format!("study `{}` does not sweep numbers of `{}`", study.name, read.sweep);
            return Err(settings.error_at("sweep", message));
        }
        let mut rows = Vec::new();
        for (index, row) in read.rows.into_iter().enumerate() {
            let key = format!("rows.{index}.printed");
            let cells = row.printed.iter().flat_map(|prefix| {
                let key = &key;
                points.iter().map(move |(x, _)| {
                    ask::printed(settings, paper, key, &format!("{prefix}{x}")).map(|printed| [*x, printed])
                })
            });
            rows.push(RowOf { printed: cells.collect::<Result<_, _>>()?, contender: row.contender });
        }
        Ok(Self { problems: read.problems, points, axis: read.axis, rows })
    }

    /// Each draw's row of shares.
    pub(super) fn curves(&self, scene: &Scene<'_>, contender: &str) -> Vec<Vec<f64>> {
        let cells: Vec<Vec<f64>> = self
            .points
            .iter()
            .map(|(_, sweep)| solved_percents(scene.run, &self.problems, contender, sweep))
            .collect();
        let draws = cells.iter().map(Vec::len).min().unwrap_or(0);
        (0..draws).map(|draw| cells.iter().map(|cell| cell[draw]).collect()).collect()
    }

    pub(super) fn panel(&self, title: &str) -> Result<Panel, RenderError> {
        let (low, high) = (self.points[0].0, self.points[self.points.len() - 1].0);
        let margin = 0.03 * (high - low);
        let x = Axis::linear(&self.axis, low - margin, high + margin)?;
        Ok(Panel::new(title, x, Axis::linear("groups solved (%)", -3.0, 103.0)?))
    }
}

impl Kind for Shown {
    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let mut sheet = Sheet::new(Width::Double, 1, 210.0);
        let mut panel = self.panel("")?;
        for (place, row) in self.rows.iter().enumerate() {
            let index = ask::series(scene, &row.contender, place);
            let curves = self.curves(scene, &row.contender);
            let seed = seed::derive(0, &["success_bands", &row.contender]);
            let plan = Resampling { resamples: 2000, level: 0.95, seed };
            let Some(Curve { mean, band, .. }) = sup_t(&curves, plan) else {
                let what = format!("two draws of `{}` on `{}`", row.contender, self.problems);
                return Err(RenderError::NotStored { what });
            };
            let xs = || self.points.iter().map(|(x, _)| *x);
            let color = series_color(index);
            let edges = xs().zip(&band).map(|(x, b)| [x, b.low.max(0.0), b.high.min(100.0)]).collect();
            let label = format!("{}: mean of {} draws, 95 % band", row.contender, curves.len());
            panel.add(Band { edges, fill: Fill::sheer(color, 0.25), label: String::new() });
            let points = xs().zip(&mean).map(|(x, y)| [x, *y]).collect();
            panel.add(Line::through(points, series_stroke(index)).labelled(label));
            if row.printed.is_empty() {
                continue;
            }
            panel.add(Points {
                points: row.printed.clone(),
                marker: series_marker(index),
                radius_pt: 3.0,
                color: Stroke::solid(color, 1.0).color,
                label: format!("{}: printed", row.contender),
            });
        }
        sheet.add(panel);
        Ok(sheet)
    }
}
