//! Ratios of contenders' numbers to another's along a column of the problem, on a logarithmic axis: every case that both solve, and
//! the geometric mean of each value.

use super::super::{Kind, Scene, ask};
use crate::analysis::metric::Metric;
use crate::analysis::selection::Selection;
use crate::analysis::shown::{means_along, ratios_along};
use crate::render::RenderError;
use crate::render::chart::marks::{Line, Points};
use crate::render::chart::{Axis, Panel, Sheet};
use crate::render::style::{GREY, Marker, Stroke, WHITE, Width, series_stroke};
use base::settings::{Settings, SettingsError};
use schemars::JsonSchema;
use serde::Deserialize;
use study::{Study, column};

/// Height of a panel's plot, in points.
const PLOT_PT: f64 = 170.0;

/// Ratios of contenders' numbers to another's.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct Ratios {
    /// The problem groups, by their labels: one panel each.
    problems: Vec<String>,
    /// The metric: a name that `replan list metrics` gives, or one that an interpretation gives a meaning.
    metric: String,
    /// The contenders, by their labels.
    contenders: Vec<String>,
    /// The contender that they are held against, by its label.
    against: String,
    /// The column of the problem along which they are drawn.
    over: String,
}

impl Ratios {
    /// The figure.
    pub(super) fn built(self, settings: &Settings, study: &Study) -> Result<RatiosOver, SettingsError> {
        ask::known(settings, study, &self.problems, self.contenders.iter().chain([&self.against]))?;
        let metric = ask::metric(settings, &self.metric)?;
        let column = column::find(&self.over)
            .ok_or_else(|| settings.error_at("ratios.over", format!("there is no column `{}`", self.over)))?;
        Ok(RatiosOver { read: self, metric, about: column.about })
    }
}

/// The ratios of every case and the geometric mean of each value.
pub(super) struct RatiosOver {
    read: Ratios,
    metric: &'static Metric,
    about: &'static str,
}

impl Kind for RatiosOver {
    fn statistic(&self) -> Option<&'static str> {
        Some("One dot for each instance that both solve; {n}.")
    }

    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let note = "Each dot is one environment that both solve; lines join the geometric means.";
        let mut sheet = Sheet::new(Width::Double, self.read.problems.len(), PLOT_PT).noted(note);
        let of_group = |group: &String| -> Vec<Vec<[f64; 2]>> {
            self.read.contenders.iter().map(|contender| self.points(scene, group, contender)).collect()
        };
        let all: Vec<Vec<Vec<[f64; 2]>>> = self.read.problems.iter().map(of_group).collect();
        // Groups are compared, on one scale.
        let along = |axis: usize| all.iter().flatten().flatten().map(move |point| point[axis]);
        let (low, high) = (along(1).fold(1.0, f64::min), along(1).fold(1.0, f64::max));
        let over: Vec<f64> = along(0).collect();
        for (group, contenders) in self.read.problems.iter().zip(&all) {
            let label = format!("{} as a share of {}'s", self.metric.label.to_lowercase(), self.read.against);
            let y = Axis::log(label, low / 1.5, high * 1.5)?;
            let mut panel = Panel::new(group, Axis::over(self.about, over.iter().copied()), y);
            let strokes: Vec<Stroke> = (self.read.contenders.iter().enumerate())
                .map(|(index, contender)| series_stroke(ask::series(scene, contender, index)))
                .collect();
            // The first contender's dots are drawn last, on top: where all open as many nodes, they are the ones to see.
            for (points, stroke) in contenders.iter().zip(&strokes).rev() {
                let faint = stroke.color.mixed(WHITE, 0.55);
                panel.add(Points::unlabelled(points.clone(), Marker::Circle, 0.9, faint));
            }
            for ((points, contender), stroke) in contenders.iter().zip(&self.read.contenders).zip(strokes) {
                let logs: Vec<[f64; 2]> = points.iter().map(|[x, y]| [*x, libm::log(*y)]).collect();
                let means = means_along(&logs).into_iter().map(|[x, y]| [x, libm::exp(y)]);
                panel.add(Line::through(means.collect(), stroke).labelled(contender.clone()));
            }
            let ends = [
                over.iter().copied().fold(f64::INFINITY, f64::min),
                over.iter().copied().fold(0.0, f64::max),
            ];
            let equal = ends.map(|x| [x, 1.0]).to_vec();
            panel.add(Line::through(equal, Stroke::solid(GREY, 0.8)).labelled(self.read.against.clone()));
            sheet.add(panel);
        }
        Ok(sheet)
    }
}

impl RatiosOver {
    /// Of each case the column and the ratio.
    fn points(&self, scene: &Scene<'_>, group: &str, contender: &str) -> Vec<[f64; 2]> {
        let all = ask::trials(scene.run, group, contender);
        let against = Some(self.read.against.clone());
        let of = Selection { against, metric: Some(self.metric), ..all };
        ratios_along(&of, scene.evidence, &self.read.over)
    }
}
