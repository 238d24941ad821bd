//! Shares of solved queries by problem group and contender at one point of the sweeps, with intervals over draws.

use super::{Entry, Kind, Scene, ask};
use crate::analysis::draws::solved_percents;
use crate::analysis::stats::bootstrap::{Plan, percentile};
use crate::render::RenderError;
use crate::render::chart::marks::Line;
use crate::render::chart::rows::Interval;
use crate::render::chart::{Axis, Panel, Sheet};
use crate::render::style::{Dash, GREY, Stroke, Width, series_color, series_marker};
use crate::seed;
use crate::study::Study;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "share_bars",
    about: "shares of solved queries by problem group and contender at one point of the sweeps, with intervals over draws",
    build: |settings, study, paper| {
        let read: Read = settings.read()?;
        ask::known(settings, study, &read.problems, &[])?;
        let printed = read.printed.iter().map(|id| ask::printed(settings, paper, id));
        let printed = printed.collect::<Result<_, _>>()?;
        Ok(Box::new(ShareBars { contenders: labels(study), printed, read }))
    },
};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Read {
    problems: Vec<String>,
    sweep: String,
    /// Claims whose printed shares are drawn as lines.
    #[serde(default)]
    printed: Vec<String>,
}

struct ShareBars {
    read: Read,
    contenders: Vec<String>,
    printed: Vec<f64>,
}

fn labels(study: &Study) -> Vec<String> {
    study.contenders.iter().map(|contender| contender.label.clone()).collect()
}

impl ShareBars {
    /// The rows from the top down: of a single problem group one a contender, else one a problem group.
    fn names(&self) -> &[String] {
        if self.read.problems.len() == 1 { &self.contenders } else { &self.read.problems }
    }
}

impl Kind for ShareBars {
    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let names = self.names();
        let is_single = self.read.problems.len() == 1;
        let rows = names.len() as f64;
        let y = Axis::names("", names.iter().rev().cloned());
        let mut panel = Panel::new("", Axis::linear("groups solved (%)", -3.0, 103.0)?, y);
        for value in &self.printed {
            let line = Line::through(
                vec![[*value, -0.5], [*value, rows - 0.5]],
                Stroke::solid(GREY, 0.9).dashed(Dash::Dashed),
            );
            panel.add(line.labelled("printed"));
        }
        let step = if is_single { 0.0 } else { 0.7 / self.contenders.len() as f64 };
        for (i, problems) in self.read.problems.iter().enumerate() {
            for (j, contender) in self.contenders.iter().enumerate() {
                let draws = solved_percents(scene.run, problems, contender, &self.read.sweep);
                let seed = seed::derive(0, &["share_bars", problems, contender]);
                let mean = |units: &[&f64]| {
                    (!units.is_empty()).then(|| units.iter().copied().sum::<f64>() / units.len() as f64)
                };
                let plan = Plan { resamples: 2000, level: 0.95, seed };
                let Some(found) = percentile(&draws, mean, plan) else { continue };
                let from_top = if is_single { j as f64 } else { i as f64 - 0.35 + step * (j as f64 + 0.5) };
                let index = if is_single { 0 } else { j };
                panel.add(Interval {
                    row: rows - 1.0 - from_top,
                    values: [found.interval.low, found.value, found.interval.high],
                    marker: series_marker(index),
                    color: series_color(index),
                    label: if is_single { String::new() } else { contender.clone() },
                });
            }
        }
        let per_row = if is_single { 15.0 } else { 6.0 + 5.0 * self.contenders.len() as f64 };
        let mut sheet = Sheet::new(Width::Double, 1, (rows * per_row).max(60.0));
        sheet.add(panel);
        Ok(sheet)
    }
}
