//! Searches on one grid map: opened cells of each side, raw and tidied path, one panel a contender.

use super::{Entry, Kind, Scene};
use crate::planner::Exhibit;
use crate::render::RenderError;
use crate::render::chart::legend::cell_key;
use crate::render::chart::marks::{Cells, Line, Points};
use crate::render::chart::{Axis, Panel, Sheet, Trim};
use crate::render::style::{
    BLACK, BLUE, Dash, GREEN, Marker, ORANGE, Rgb, SKY, Stroke, VERMILLION, WHITE, Width,
};
use crate::study::record::Row;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "grid_search",
    about: "searches on one grid map: opened cells of each side, raw and tidied path, one panel a contender",
    build: |settings, study, _paper| {
        let read: GridSearch = settings.read()?;
        let known: Vec<&str> = study.contenders.iter().map(|c| c.label.as_str()).collect();
        for label in &read.contenders {
            if !known.contains(&label.as_str()) {
                let message = format!("no contender is called `{label}`; they are {}", known.join(", "));
                return Err(settings.error(message));
            }
        }
        if !study.groups.iter().any(|group| group.label == read.problem) {
            let groups: Vec<&str> = study.groups.iter().map(|group| group.label.as_str()).collect();
            let message =
                format!("no problem group is called `{}`; they are {}", read.problem, groups.join(", "));
            return Err(settings.error(message));
        }
        Ok(Box::new(read))
    },
};

/// Height of a panel's plot, in points.
const PLOT_PT: f64 = 215.0;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct GridSearch {
    /// The problem group; its first draw is shown.
    problem: String,
    /// One panel each.
    contenders: Vec<String>,
}

fn start_side() -> Rgb {
    SKY.mixed(WHITE, 0.45)
}

fn goal_side() -> Rgb {
    ORANGE.mixed(WHITE, 0.45)
}

fn blocked() -> Rgb {
    BLACK.mixed(WHITE, 0.25)
}

impl Kind for GridSearch {
    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let mut sheet = Sheet::new(Width::Double, self.contenders.len(), PLOT_PT);
        for contender in &self.contenders {
            let rows = scene.run.rows(&self.problem, contender);
            let row = rows.first().ok_or_else(|| RenderError::NotStored {
                what: format!("a trial of `{contender}` on `{}`", self.problem),
            })?;
            sheet.add(panel(scene, row)?);
        }
        Ok(sheet)
    }
}

fn panel(scene: &Scene<'_>, row: &Row) -> Result<Panel, RenderError> {
    let stored = |of: &str, name: &str| {
        scene
            .run
            .exhibit(of, name)
            .ok_or_else(|| RenderError::NotStored { what: format!("the exhibit `{name}` of `{of}`") })
    };
    let map = scene.run.prepared_of(row).map_or("", |prepared| &prepared.prepared);
    let size = stored(map, "size_cells")?;
    let (width, height) = (size.values[0], size.values[1]);
    let axis = |label: &str, side: f64| Axis::linear(label, 0.0, side);
    let mut panel = Panel::new(title(row), axis("x (cells)", width)?, axis("y (cells)", height)?)
        .trimmed(Trim::Frame)
        .with_equal_scales();
    panel.add(cells(scene, row, stored(map, "blocked")?, [width as usize, height as usize]));
    if let Some(raw) = scene.run.exhibit(&row.trial, "raw_path") {
        let dashed = Stroke::solid(BLUE, 1.0).dashed(Dash::Dashed);
        panel.add(Line::through(centres(raw), dashed).labelled("path as searched"));
    }
    if let Some(path) = scene.run.exhibit(&row.trial, "path") {
        panel.add(Line::through(centres(path), Stroke::solid(VERMILLION, 1.6)).labelled("returned path"));
        let points = centres(path);
        let ends = [("start", Marker::Circle, points.first()), ("goal", Marker::Diamond, points.last())];
        for (label, marker, at) in ends {
            let points = at.into_iter().copied().collect();
            panel.add(Points { points, marker, radius_pt: 3.2, color: GREEN, label: label.to_owned() });
        }
    }
    Ok(panel)
}

fn title(row: &Row) -> String {
    let number = |column: &str, decimals: usize| {
        row.value(column).map_or_else(|| "–".to_owned(), |value| format!("{value:.decimals$}"))
    };
    format!(
        "{}: cost {}, turns {}°, opened {}",
        row.contender,
        number("path_cost_cells", 2),
        number("turn_exterior_deg", 2),
        number("opened", 0)
    )
}

/// A cell (x, y) is drawn as the unit square from (x, y) to (x + 1, y + 1), as the paper places its points.
fn centres(path: &Exhibit) -> Vec<[f64; 2]> {
    path.values.chunks(path.width).map(|point| [point[0] + 0.5, point[1] + 0.5]).collect()
}

fn cells(scene: &Scene<'_>, row: &Row, walls: &Exhibit, [columns, rows]: [usize; 2]) -> Cells {
    let mut colors = vec![None; columns * rows];
    let mut paint = |exhibit: Option<&Exhibit>, color: Rgb| {
        for point in exhibit.into_iter().flat_map(|e| e.values.chunks(e.width)) {
            colors[point[1] as usize * columns + point[0] as usize] = Some(color);
        }
    };
    paint(scene.run.exhibit(&row.trial, "opened_goal_side"), goal_side());
    paint(scene.run.exhibit(&row.trial, "opened_start_side"), start_side());
    paint(Some(walls), blocked());
    Cells {
        corner: [0.0, 0.0],
        cell: [1.0, 1.0],
        columns,
        colors,
        lines: Some(Stroke::solid(BLACK.mixed(WHITE, 0.85), 0.25)),
        keys: vec![
            cell_key("blocked", blocked()),
            cell_key("opened by the start's side", start_side()),
            cell_key("opened by the goal's side", goal_side()),
        ],
    }
}
