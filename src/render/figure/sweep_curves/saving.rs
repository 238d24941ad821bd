//! One contender's saving over another along a column of the problem: every instance, and the mean of each value.

use super::super::{Kind, Scene, ask};
use crate::analysis::metric::Metric;
use crate::analysis::selection::Selection;
use crate::analysis::shown::{means_along, savings_along};
use crate::render::RenderError;
use crate::render::chart::marks::{Line, Points};
use crate::render::chart::{Axis, Panel, Sheet};
use crate::render::style::{GREY, Marker, Stroke, VERMILLION, WHITE, Width};
use base::settings::{Settings, SettingsError};
use schemars::JsonSchema;
use serde::Deserialize;
use study::{Study, column};

/// Height of a panel's plot, in points.
const PLOT_PT: f64 = 170.0;

/// One contender's saving over another.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct Saving {
    /// The problem groups, by their labels: one panel each.
    problems: Vec<String>,
    /// The metric: a name that `replan list metrics` gives, or one that an interpretation gives a meaning.
    metric: String,
    /// The contender, by its label.
    contender: String,
    /// The contender that it is held against, by its label.
    against: String,
    /// The column of the problem along which it is drawn.
    over: String,
}

impl Saving {
    /// The figure.
    pub(super) fn built(self, settings: &Settings, study: &Study) -> Result<SavingOver, SettingsError> {
        ask::known(settings, study, &self.problems, [&self.contender, &self.against])?;
        let metric = ask::metric(settings, &self.metric)?;
        let column = column::find(&self.over)
            .ok_or_else(|| settings.error_at("saving.over", format!("there is no column `{}`", self.over)))?;
        Ok(SavingOver { read: self, metric, about: column.about })
    }
}

/// The saving of every instance and the mean of each value.
pub(super) struct SavingOver {
    read: Saving,
    metric: &'static Metric,
    about: &'static str,
}

impl Kind for SavingOver {
    fn statistic(&self) -> Option<&'static str> {
        Some("One dot for each instance that both solve; {n}.")
    }

    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let note = "Each dot is one environment; the line joins the means.";
        let mut sheet = Sheet::new(Width::Double, self.read.problems.len(), PLOT_PT).noted(note);
        let all: Vec<Vec<[f64; 2]>> =
            self.read.problems.iter().map(|group| self.points(scene, group)).collect();
        // Groups are compared, on one scale.
        let along = |axis: usize| all.iter().flatten().map(move |point| point[axis]).collect::<Vec<f64>>();
        let [over, saved] = [along(0), along(1)];
        for (group, points) in self.read.problems.iter().zip(all) {
            let label = format!("saving in {} (%)", self.metric.label.to_lowercase());
            let y = Axis::over(label, saved.iter().copied());
            let x = Axis::over(self.about, over.iter().copied());
            let mut panel = Panel::new(format!("{group}: {}", self.read.contender), x, y);
            let means = means_along(&points);
            let single = Points::unlabelled(points, Marker::Circle, 1.1, GREY.mixed(WHITE, 0.35));
            panel.add(single.labelled("one environment"));
            panel.add(Line::through(means, Stroke::solid(VERMILLION, 1.5)).labelled("mean"));
            sheet.add(panel);
        }
        Ok(sheet)
    }
}

impl SavingOver {
    /// Of each case the column and the saving in per cent.
    fn points(&self, scene: &Scene<'_>, group: &str) -> Vec<[f64; 2]> {
        let all = ask::trials(scene.run, group, &self.read.contender);
        let against = Some(self.read.against.clone());
        let of = Selection { against, metric: Some(self.metric), ..all };
        savings_along(&of, scene.evidence, &self.read.over)
    }
}
