//! Joint angles of a planar arm along the paths of its tip.

use super::{Entry, Kind, Scene, Shown, ask};
use crate::render::RenderError;
use crate::render::chart::marks::Line;
use crate::render::chart::{Axis, Panel, Sheet};
use crate::render::style::{Width, series_stroke};
use crate::study::record::Row;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "tip_path_joints",
    about: "joint angles of a planar arm along the paths of its tip: θ1 beside θ2, one row a problem",
    settings: Accepted::of::<TipPathJoints>(),
    example: r#"
panels = [
    { problem = "case 1", contenders = ["A* 8"] },
    { problem = "case 2", contenders = ["A* 8"] },
]
"#,
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

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct TipPathJoints {
    /// Draws, at each share of the way, how far each curve is from that of the panel's first contender, which is not
    /// drawn: curves that all but coincide can then be told apart.
    #[serde(default)]
    differences: bool,
    /// How many panels stand side by side: θ1 and θ2 of a problem follow each other.
    #[serde(default = "two")]
    #[schemars(range(min = 1, max = 12))]
    columns: usize,
    /// The panels, in their order.
    panels: Vec<PanelSetting>,
}

fn two() -> usize {
    2
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct PanelSetting {
    /// The problem group; its first draw is shown.
    problem: String,
    /// Whose paths, of the first seed.
    contenders: Vec<String>,
}

/// A curve with the contender it belongs to.
type Curves<'a> = Vec<(&'a String, Vec<[f64; 2]>)>;

impl Kind for TipPathJoints {
    fn shown(&self) -> Vec<Shown<'_>> {
        self.panels.iter().flat_map(|panel| Shown::first(&panel.problem, &panel.contenders)).collect()
    }

    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let mut sheet = Sheet::new(Width::Double, self.columns, PLOT_PT);
        let mut all = Vec::new();
        for panel in &self.panels {
            all.push([self.curves(scene, panel, 0)?, self.curves(scene, panel, 1)?]);
        }
        // One scale for each joint, so that cases can be compared.
        let ranges = [0, 1].map(|joint| {
            let points = all.iter().flat_map(move |both| &both[joint]).flat_map(|(_, points)| points);
            points.map(|point| point[1]).collect::<Vec<f64>>()
        });
        for (setting, both) in self.panels.iter().zip(all) {
            for (joint, curves) in both.into_iter().enumerate() {
                sheet.add(self.panel(scene, &setting.problem, joint, curves, &ranges[joint]));
            }
        }
        Ok(sheet)
    }
}

impl TipPathJoints {
    fn panel(
        &self,
        scene: &Scene<'_>,
        problem: &str,
        joint: usize,
        curves: Curves<'_>,
        range: &[f64],
    ) -> Panel {
        let ways = curves.iter().flat_map(|(_, points)| points).map(|point| point[0]);
        let way = if self.differences { "share of the way (%)" } else { "way along the path (cm)" };
        let angle = format!("{}θ{} (°)", if self.differences { "Δ" } else { "" }, joint + 1);
        let (x, y) = (Axis::over(way, ways), Axis::over(angle, range.iter().copied()));
        let mut panel = Panel::new(format!("{problem}, θ{}", joint + 1), x, y);
        for (label, points) in curves {
            let stroke = series_stroke(ask::place(scene, label));
            panel.add(Line::through(points, stroke).labelled(label.clone()));
        }
        panel
    }

    fn curves<'a>(
        &self,
        scene: &Scene<'_>,
        setting: &'a PanelSetting,
        joint: usize,
    ) -> Result<Curves<'a>, RenderError> {
        let mut curves = Vec::new();
        for label in &setting.contenders {
            let row = ask::trial(scene, &setting.problem, 0, None, label)?;
            // A failed trial has no path and no curve.
            curves.extend(curve(scene, row, joint).map(|points| (label, points)));
        }
        if self.differences && !curves.is_empty() {
            let (_, base) = curves.remove(0);
            for (_, points) in &mut curves {
                *points = away(points, &base);
            }
        }
        Ok(curves)
    }
}

/// How far `points` are from `base` at each share of the way, in percent.
fn away(points: &[[f64; 2]], base: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let length = |of: &[[f64; 2]]| of.last().map_or(1.0, |last| last[0]).max(f64::MIN_POSITIVE);
    let (own, other) = (length(points), length(base));
    let point = |[way, angle]: &[f64; 2]| [100.0 * way / own, angle - at(base, way / own * other)];
    points.iter().map(point).collect()
}

/// The angle of a curve at `way`, even between its stations.
fn at(curve: &[[f64; 2]], way: f64) -> f64 {
    let after = curve.partition_point(|point| point[0] < way).clamp(1, curve.len().max(2) - 1);
    let ([x, y], [to_x, to_y]) = (curve[after - 1], curve[after.min(curve.len() - 1)]);
    if to_x > x { y + (to_y - y) * (way - x) / (to_x - x) } else { y }
}

/// The way along the path and the joint's angle at every station.
fn curve(scene: &Scene<'_>, row: &Row, joint: usize) -> Option<Vec<[f64; 2]>> {
    let stations = scene.run.exhibit(&row.key, "stations")?;
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_is_nowhere_away_from_itself_however_it_is_sampled() {
        let base = [[0.0, 1.0], [2.0, 5.0], [10.0, -3.0]];
        // The same curve, twice as long and with a station more.
        let same = [[0.0, 1.0], [4.0, 5.0], [12.0, 1.0], [20.0, -3.0]];
        assert!(away(&same, &base).iter().all(|[_, gap]| gap.abs() < 1e-12));
        let higher = same.map(|[way, angle]| [way, angle + 2.0]);
        assert_eq!(away(&higher, &base).last(), Some(&[100.0, 2.0]));
    }
}
