//! Joint angles of a planar arm along the paths of its tip.

use super::{Entry, Kind, Scene, ask};
use crate::render::RenderError;
use crate::render::chart::marks::Line;
use crate::render::chart::{Axis, Panel, Sheet};
use crate::render::style::{Width, series_stroke};
use crate::study::record::Row;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "tip_path_joints",
    about: "joint angles of a planar arm along the paths of its tip: θ1 above θ2, one column a problem",
    build: |settings, study, _paper| {
        let read: TipPathJoints = settings.read()?;
        for panel in &read.panels {
            ask::known(settings, study, std::slice::from_ref(&panel.problem), &panel.contenders)?;
        }
        Ok(Box::new(read))
    },
};

/// Height of a panel's plot, in points.
const PLOT_PT: f64 = 105.0;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct TipPathJoints {
    panels: Vec<PanelSetting>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PanelSetting {
    /// The problem group; its first draw is shown.
    problem: String,
    /// Whose paths, of the first seed.
    contenders: Vec<String>,
}

impl Kind for TipPathJoints {
    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let mut sheet = Sheet::new(Width::Double, self.panels.len(), PLOT_PT);
        for joint in 0..2 {
            for panel in &self.panels {
                sheet.add(panel_of(scene, panel, joint)?);
            }
        }
        Ok(sheet)
    }
}

fn panel_of(scene: &Scene<'_>, setting: &PanelSetting, joint: usize) -> Result<Panel, RenderError> {
    let mut curves = Vec::new();
    for label in &setting.contenders {
        let row = ask::trial(scene, &setting.problem, 0, None, label)?;
        // A failed trial has no path and no curve.
        curves.extend(curve(scene, row, joint).map(|points| (label, points)));
    }
    let values = |axis: usize| curves.iter().flat_map(move |(_, points)| points.iter().map(move |p| p[axis]));
    let label = format!("θ{} (°)", joint + 1);
    let (x, y) = (Axis::over("way along the path (cm)", values(0)), Axis::over(label, values(1)));
    let mut panel = Panel::new(format!("{}, θ{}", setting.problem, joint + 1), x, y);
    for (index, (label, points)) in curves.into_iter().enumerate() {
        panel.add(Line::through(points, series_stroke(index)).labelled(label.clone()));
    }
    Ok(panel)
}

/// The way along the path and the joint's angle at every station.
fn curve(scene: &Scene<'_>, row: &Row, joint: usize) -> Option<Vec<[f64; 2]>> {
    let stations = scene.run.exhibit(&row.trial, "stations")?;
    let stations: Vec<&[f64]> = stations.values.chunks(stations.width).collect();
    let mut way = 0.0;
    let mut before = [stations[0][4], stations[0][5]];
    let point = |station: &&[f64]| {
        let tip = [station[4], station[5]];
        way += libm::hypot(tip[0] - before[0], tip[1] - before[1]);
        before = tip;
        [way, station[joint]]
    };
    Some(stations.iter().map(point).collect())
}
