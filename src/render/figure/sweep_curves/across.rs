//! The value of a sweep that gives the printed shares, for several studies: how far the printed numbers identify it.

use super::super::{Kind, Scene, ask};
use crate::analysis::evidence::Run;
use crate::analysis::shown::{Curves, mean_solved};
use crate::render::RenderError;
use crate::render::chart::marks::{Band, Line};
use crate::render::chart::{Axis, Panel, Sheet};
use crate::render::style::{Dash, Fill, GREY, Stroke, Width, series_color, series_marker, series_stroke};
use base::settings::{Settings, SettingsError, none_called};
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeSet;
use study::contender::SweepPoint;
use study::key::{SweepValue, Text};
use study::paper::Paper;
use study::{Study, name, sweeps_of};

/// One contender's shares in several studies.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct Across {
    /// The contender, by its label.
    contender: String,
    /// A value of another sweep, as `setting=value`: one panel each.
    others: Vec<String>,
    /// The claim printed for each panel.
    printed: Vec<String>,
    /// A printed row whose distance from the mean curve is shown in a last panel.
    row: Option<PrintedRowSpec>,
    /// The studies that are compared, by name.
    studies: Vec<String>,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct PrintedRowSpec {
    /// The sweep along the row.
    sweep: String,
    /// What the claims of its cells are called before the sweep's value.
    printed: String,
}

impl Across {
    /// The figure along `sweep`, with `axis` written below it.
    pub(super) fn built(
        self,
        (sweep, axis): (String, String),
        settings: &Settings,
        study: &Study,
        paper: &Paper,
    ) -> Result<Identification, SettingsError> {
        ask::known(settings, study, [], [&self.contender])?;
        if let Some(missing) = self.studies.iter().find(|name| paper.study(name).is_none()) {
            let known = paper.studies.iter().map(|study| study.name.as_str());
            let message = none_called("study", missing, known);
            return Err(settings.error_about("across", &["studies"], missing, message));
        }
        if self.printed.len() != self.others.len() {
            let message = format!(
                "printed has {} claims and others {} points; as many of either are accepted",
                self.printed.len(),
                self.others.len()
            );
            let error = settings.error_at("across.printed", message);
            return Err(error.about("printed").about("others"));
        }
        let printed = ask::all_printed(settings, paper, "across.printed", &self.printed)?;
        let others = others(settings, study, &self.others)?;
        let row = self.row.as_ref().map(|row| row.cells(settings, study, paper)).transpose()?;
        Ok(Identification { read: self, sweep, axis, others, printed, row: row.unwrap_or_default() })
    }
}

impl PrintedRowSpec {
    /// The row's cells: the value of its sweep and the printed share.
    fn cells(
        &self,
        settings: &Settings,
        study: &Study,
        paper: &Paper,
    ) -> Result<Vec<(SweepValue, f64)>, SettingsError> {
        let sweep = study.sweeps.iter().find(|sweep| sweep.key == self.sweep).ok_or_else(|| {
            let message = format!("study `{}` does not sweep `{}`", study.name, self.sweep);
            settings.error_at("across.row.sweep", message)
        })?;
        let cell = |value: SweepValue| {
            let claim = format!("{}{value}", self.printed);
            Ok((value, ask::printed(settings, paper, "across.row.printed", &claim)?))
        };
        sweep.key_values().into_iter().flatten().map(cell).collect()
    }
}

/// What the printed shares identify.
pub(super) struct Identification {
    read: Across,
    /// The sweep along the axis.
    sweep: String,
    /// What stands along the axis.
    axis: String,
    /// What the other sweeps are at, one a panel.
    others: Vec<SweepSetting>,
    printed: Vec<f64>,
    /// The row's cells: the value of its sweep and the printed share.
    row: Vec<(SweepValue, f64)>,
}

/// A sweep's setting and one of its values.
type SweepSetting = (Text, SweepValue);

/// The sweeps and values that people write as `setting=value`.
fn others(
    settings: &Settings,
    study: &Study,
    written: &[String],
) -> Result<Vec<SweepSetting>, SettingsError> {
    let points = study.sweep_points();
    let known: BTreeSet<&SweepSetting> = points.iter().flat_map(|point| point.key.values()).collect();
    let find = |(index, text): (usize, &String)| {
        let found = known.iter().find(|other| name::sweep_value(other) == *text);
        found.map(|other| (*other).clone()).ok_or_else(|| {
            let known: Vec<String> = known.iter().map(|other| name::sweep_value(other)).collect();
            let message =
                format!("study `{}` has no sweep `{text}`; it has {}", study.name, known.join(", "));
            settings.error_at(&format!("across.others.{index}"), message).about(&sweeps_of(&study.name))
        })
    };
    written.iter().enumerate().map(find).collect()
}

/// A point of a curve: the swept value, and the mean share with its interval.
type Point = [f64; 4];

impl Identification {
    fn curve(&self, scene: &Scene<'_>, run: &Run<'_>, other: &SweepSetting) -> Vec<Point> {
        let Some(group) = run.study.groups.first() else { return Vec::new() };
        let mut points = Vec::new();
        for point in run.study.sweep_points() {
            let value = point.key.value(&self.sweep).and_then(SweepValue::as_f64);
            let value = value.filter(|_| point.key.value(&other.0) == Some(&other.1));
            let Some(value) = value else { continue };
            let of = ask::trials_at(run, &group.label, &self.read.contender, &point.key);
            let names = [run.study.name.as_str(), &name::sweep(&point.key)];
            if let Some(found) = mean_solved(&of, scene.evidence, &names) {
                points.push([value, found.value, found.interval.low, found.interval.high]);
            }
        }
        points
    }
}

impl Identification {
    /// How far the mean curve along the row is from the printed one, at each value of the sweep along the axis.
    fn distances(&self, scene: &Scene<'_>, run: &Run<'_>) -> Vec<Point> {
        let Some(group) = run.study.groups.first() else { return Vec::new() };
        let Some(sweep) = run.study.sweeps.iter().find(|sweep| sweep.key == self.sweep) else {
            return Vec::new();
        };
        let printed: Vec<f64> = self.row.iter().map(|(_, printed)| *printed).collect();
        let mut points = Vec::new();
        let along = self.read.row.as_ref().map_or("", |row| &row.sweep);
        let sweep_points = run.study.sweep_points();
        for value in sweep.key_values().into_iter().flatten() {
            let cell = |(cell, _): &(SweepValue, f64)| {
                let is_own = |point: &&SweepPoint| {
                    point.key.value(&self.sweep) == Some(&value) && point.key.value(along) == Some(cell)
                };
                let point = sweep_points.iter().find(is_own)?;
                Some(ask::trials_at(run, &group.label, &self.read.contender, &point.key))
            };
            let Some(cells) = self.row.iter().map(cell).collect::<Option<Vec<_>>>() else { continue };
            let at = format!("{}={value}", self.sweep);
            let names = ["row", &run.study.name, &at];
            let found = Curves::solved(&cells, scene.evidence).distance(&printed, &names);
            if let (Some(at), Some(found)) = (value.as_f64(), found) {
                points.push([at, found.value, found.interval.low, found.interval.high]);
            }
        }
        points
    }

    fn add_curves(panel: &mut Panel, runs: &[&Run<'_>], curves: &[Vec<Point>]) {
        for (index, (run, curve)) in runs.iter().zip(curves).enumerate() {
            let edges = curve.iter().map(|[x, _, low, high]| [*x, *low, *high]).collect();
            let fill = Fill::sheer(series_color(index), 0.18);
            panel.add(Band { edges, fill, label: String::new() });
            let line = Line::through(curve.iter().map(|p| [p[0], p[1]]).collect(), series_stroke(index));
            let label = run.study.groups.first().map_or("", |group| &group.label);
            panel.add(line.marked(series_marker(index)).labelled(label));
        }
    }
}

impl Kind for Identification {
    fn statistic(&self) -> Option<&'static str> {
        Some("Means over instances with 95 % bootstrap intervals; unsolved queries count; {n}.")
    }

    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let panels = self.others.len() + usize::from(!self.row.is_empty());
        let mut sheet = Sheet::new(Width::Double, panels, 150.0);
        let runs: Vec<&Run<'_>> =
            self.read.studies.iter().filter_map(|name| scene.evidence.run(name)).collect();
        for (other, printed) in self.others.iter().zip(&self.printed) {
            let curves: Vec<Vec<Point>> = runs.iter().map(|run| self.curve(scene, run, other)).collect();
            let x = Axis::over(&self.axis, curves.iter().flatten().map(|point| point[0]));
            let [low, high] = x.ends();
            let mut panel = Panel::new(
                format!("{} = {}", other.0, other.1),
                x,
                Axis::linear("groups solved (%)", -3.0, 103.0)?,
            );
            let dashed = Stroke::solid(GREY, 0.9).dashed(Dash::Dashed);
            panel.add(Line::through(vec![[low, *printed], [high, *printed]], dashed).labelled("printed"));
            Self::add_curves(&mut panel, &runs, &curves);
            sheet.add(panel);
        }
        if !self.row.is_empty() {
            let curves: Vec<Vec<Point>> = runs.iter().map(|run| self.distances(scene, run)).collect();
            let x = Axis::over(&self.axis, curves.iter().flatten().map(|point| point[0]));
            let top = curves.iter().flatten().map(|point| point[3]).fold(1.0, f64::max);
            let y = Axis::linear("distance from the printed row (points)", 0.0, top * 1.05)?;
            let mut panel = Panel::new(format!("all {} cells", self.row.len()), x, y);
            Self::add_curves(&mut panel, &runs, &curves);
            sheet.add(panel);
        }
        Ok(sheet)
    }
}
