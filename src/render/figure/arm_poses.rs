//! The whole arm along its path: postures at even intervals, one row a contender, one panel a view.

use super::polyhedra_scene::{View, add_obstacles, panel, points, stored};
use super::{Entry, Kind, Scene};
use crate::render::RenderError;
use crate::render::chart::legend::cell_key;
use crate::render::chart::{Key, Sheet, Swatch};
use crate::render::scene3::{Paint, Scene as Solids};
use crate::render::style::{GREEN, ORANGE, PURPLE, Rgb, Stroke, VERMILLION, WHITE, Width};
use crate::study::record::{Row, Status};
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "arm_poses",
    about: "the whole arm along its path among polyhedra, one row a contender, one panel a view",
    build: |settings, study, _paper| {
        let read: ArmPoses = settings.read()?;
        super::check_labels(settings, study, &read.contenders, [&read.problem])?;
        Ok(Box::new(read))
    },
};

/// Height of a panel's plot, in points.
const PLOT_PT: f64 = 220.0;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ArmPoses {
    /// The problem group; its first draw is shown.
    problem: String,
    /// One row each.
    contenders: Vec<String>,
    /// One panel each.
    views: Vec<View>,
    /// The value of the sweep, where there is one.
    sweep: Option<String>,
}

/// From the first posture to the last.
fn shade(share: f64) -> Rgb {
    ORANGE.mixed(WHITE, 0.6 * (1.0 - share))
}

impl Kind for ArmPoses {
    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let columns = if self.views.len() == 1 { self.contenders.len() } else { self.views.len() };
        let mut sheet = Sheet::new(Width::Double, columns, PLOT_PT)
            .noted("Stand-in environment: the paper's obstacles are lost. Rod radii are assumed.");
        for contender in &self.contenders {
            let row = self.row(scene, contender)?;
            for view in &self.views {
                let mut solids = Solids::default();
                add_obstacles(&mut solids, scene.run, &scene.run.draw_of(row), false)?;
                let keys = arm(&mut solids, scene, row)?;
                let end = match row.status {
                    Status::Solved => "goal reached".to_owned(),
                    _ => row.value("followed_share").map_or_else(
                        || row.status.to_string(),
                        |share| format!("stopped after {:.0} % of the path", 100.0 * share),
                    ),
                };
                let seen = if self.views.len() > 1 { format!(", {}", view.name()) } else { String::new() };
                let title = format!("{}: {end}{seen}", row.contender);
                sheet.add(panel(title, solids, *view, keys)?);
            }
        }
        Ok(sheet)
    }
}

impl ArmPoses {
    fn row<'a>(&self, scene: &'a Scene<'_>, contender: &str) -> Result<&'a Row, RenderError> {
        let rows = scene.run.rows(&self.problem, contender);
        let is_asked = |row: &&Row| self.sweep.as_ref().is_none_or(|sweep| row.sweep == *sweep);
        rows.into_iter().find(is_asked).ok_or_else(|| RenderError::NotStored {
            what: format!("a trial of `{contender}` on `{}`", self.problem),
        })
    }
}

fn arm(solids: &mut Solids, scene: &Scene<'_>, row: &Row) -> Result<Vec<Key>, RenderError> {
    let rods = stored(scene.run, &row.trial, "rods")?;
    let last = rods.values.chunks(rods.width).map(|rod| rod[0]).fold(1.0, f64::max);
    for rod in rods.values.chunks(rods.width) {
        let paint = Paint::solid(shade(rod[0] / last));
        solids.capsule([rod[1], rod[2], rod[3]], [rod[4], rod[5], rod[6]], rod[7], paint);
    }
    let mut keys = vec![cell_key("arm at the start", shade(0.0)), cell_key("arm at the end", shade(1.0))];
    for (name, label, color) in
        [("tip_path", "path to be followed", PURPLE), ("tip_trail", "way of the tip", VERMILLION)]
    {
        if let Some(found) = scene.run.exhibit(&row.trial, name) {
            let stroke = Stroke::solid(color, 1.3);
            solids.polyline(points(found), stroke);
            keys.push(Key { swatch: Swatch::Line(stroke, None), label: label.to_owned() });
        }
    }
    let trail = points(stored(scene.run, &row.trial, "tip_trail")?);
    if let Some(start) = trail.first() {
        solids.capsule(*start, *start, 1.6, Paint::solid(GREEN));
        keys.push(cell_key("start", GREEN));
    }
    Ok(keys)
}
