//! Tip paths among polyhedra: one row a contender, one panel a view.

use super::polyhedra_scene::{View, add_obstacles, panel, points, stored};
use super::{Entry, Kind, Scene, Shown};
use crate::render::RenderError;
use crate::render::chart::{Key, Sheet, Swatch};
use crate::render::scene3::{Paint, Scene as Solids};
use crate::render::style::{BLUE, Dash, GREEN, PURPLE, Stroke, VERMILLION, Width};
use crate::study::record::Row;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "polyhedra_paths",
    about: "tip paths among solid, depth-sorted polyhedra, one row a contender, one panel a view",
    settings: Accepted::of::<PolyhedraPaths>(),
    example: r#"
problem = "E1"
contenders = ["A*", "Improved A*"]
views = ["corner"]
"#,
    build: |settings, study, _paper| {
        let read: PolyhedraPaths = settings.read()?;
        super::check_labels(settings, study, &read.contenders, [&read.problem])?;
        for (key, count) in [("contenders", read.contenders.len()), ("views", read.views.len())] {
            if count == 0 {
                return Err(settings.error_at(key, format!("{key} is empty; at least one is accepted")));
            }
        }
        Ok(Box::new(read))
    },
};

/// Height of a panel's plot, in points.
const PLOT_PT: f64 = 205.0;

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct PolyhedraPaths {
    /// The problem group; its first draw is shown.
    problem: String,
    /// The query, where a draw has several.
    #[serde(default)]
    query: String,
    /// One row each.
    contenders: Vec<String>,
    /// One panel each.
    views: Vec<View>,
}

impl Kind for PolyhedraPaths {
    fn shown(&self) -> Vec<Shown<'_>> {
        Shown::first(&self.problem, &self.contenders)
    }

    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        // One view each: contenders stand side by side.
        let columns = if self.views.len() == 1 { self.contenders.len() } else { self.views.len() };
        let mut sheet = Sheet::new(Width::Double, columns, PLOT_PT);
        for contender in &self.contenders {
            let row = self.row(scene, contender)?;
            for view in &self.views {
                let mut solids = Solids::default();
                add_obstacles(&mut solids, scene.run, &row.key.on, true)?;
                let keys = paths(&mut solids, scene, row)?;
                sheet.add(panel(self.title(row, *view), solids, *view, keys)?);
            }
        }
        Ok(sheet)
    }
}

impl PolyhedraPaths {
    fn row<'a>(&self, scene: &'a Scene<'_>, contender: &str) -> Result<&'a Row, RenderError> {
        let rows = scene.run.rows(&self.problem, contender);
        let is_asked = |row: &&Row| self.query.is_empty() || row.query() == self.query;
        rows.into_iter().find(is_asked).ok_or_else(|| RenderError::NotStored {
            what: format!("a trial of `{contender}` on `{}` {}", self.problem, self.query),
        })
    }

    fn title(&self, row: &Row, view: View) -> String {
        let length = row.value("path_length_cm").map_or_else(|| "–".to_owned(), |cm| format!("{cm:.1} cm"));
        let nodes = row.value("opened").map_or_else(|| "–".to_owned(), |nodes| format!("{nodes:.0}"));
        let seen = if self.views.len() > 1 { format!(", {}", view.name()) } else { String::new() };
        format!("{}: {length}, {nodes} nodes{seen}", row.key.contender)
    }
}

/// Adds the path as searched and as returned, with their ends.
fn paths(solids: &mut Solids, scene: &Scene<'_>, row: &Row) -> Result<Vec<Key>, RenderError> {
    let mut keys = Vec::new();
    let mut line = |solids: &mut Solids, name: &str, label: &str, stroke: Stroke| {
        if let Some(found) = scene.run.exhibit(&row.key, name) {
            solids.polyline(points(found), stroke);
            keys.push(Key { swatch: Swatch::Line(stroke, None), label: label.to_owned() });
        }
    };
    line(solids, "raw_path", "path as searched", Stroke::solid(BLUE, 0.8).dashed(Dash::Dashed));
    line(solids, "path", "returned path", Stroke::solid(VERMILLION, 1.5));
    let path = points(stored(scene.run, &row.key, "path")?);
    for (at, color, label) in [(path.first(), GREEN, "start"), (path.last(), PURPLE, "goal")] {
        if let Some(at) = at {
            solids.capsule(*at, *at, 1.6, Paint::solid(color));
            keys.push(crate::render::chart::legend::cell_key(label, color));
        }
    }
    Ok(keys)
}
