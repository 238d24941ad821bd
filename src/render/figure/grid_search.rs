//! Searches on one grid map: opened cells of each side, raw and tidied path, one panel a contender.

use super::{Entry, Kind, Scene, Shown};
use crate::render::RenderError;
use crate::render::chart::legend::{Key, cell_key};
use crate::render::chart::marks::{Cells, Line, Points};
use crate::render::chart::{Axis, Panel, Sheet, Trim};
use crate::render::style::{
    BLACK, BLUE, Dash, GREEN, Marker, ORANGE, Rgb, SKY, Stroke, VERMILLION, WHITE, Width,
};
use crate::study::record::Row;
use base::settings::Accepted;
use engine::planner::Exhibit;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "grid_search",
    about: "searches on one grid map: opened cells of each side, raw and tidied path, one panel a contender",
    settings: Accepted::of::<GridSearch>(),
    example: r#"
problem = "W1"
contenders = ["A*", "Improved A*"]
"#,
    build: |settings, study, _paper| {
        let read: GridSearch = settings.read()?;
        super::check_labels(settings, study, &read.contenders, [&read.problem])?;
        Ok(Box::new(read))
    },
};

/// Height of a panel's plot, in points.
const PLOT_PT: f64 = 215.0;

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct GridSearch {
    /// The problem group; its first draw is shown.
    problem: String,
    /// One panel each.
    contenders: Vec<String>,
}

pub(super) fn start_side() -> Rgb {
    SKY.mixed(WHITE, 0.6)
}

pub(super) fn goal_side() -> Rgb {
    ORANGE.mixed(WHITE, 0.2)
}

pub(super) fn blocked() -> Rgb {
    BLACK.mixed(WHITE, 0.25)
}

impl Kind for GridSearch {
    fn shown(&self) -> Vec<Shown<'_>> {
        Shown::first(&self.problem, &self.contenders)
    }

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
    let map = map(scene, row)?;
    let mut panel = map.panel(title(row))?;
    panel.add(cells(scene, row, &map));
    if let Some(raw) = scene.run.exhibit(&row.key, "raw_path") {
        let dashed = Stroke::solid(BLUE, 1.0).dashed(Dash::Dashed);
        panel.add(Line::through(centres(raw), dashed).labelled("path as searched"));
    }
    if let Some(path) = scene.run.exhibit(&row.key, "path") {
        panel.add(Line::through(centres(path), Stroke::solid(VERMILLION, 1.6)).labelled("returned path"));
        add_ends(&mut panel, &centres(path));
    }
    Ok(panel)
}

/// A map as it is stored: its size and its blocked cells.
pub(super) struct Map<'a> {
    pub(super) size: [usize; 2],
    pub(super) walls: &'a Exhibit,
}

/// The map that the trial `row` was run on.
pub(super) fn map<'a>(scene: &Scene<'a>, row: &Row) -> Result<Map<'a>, RenderError> {
    let stored = |name: &str| super::ask::exhibit(scene, &row.key.on, name);
    let (size, walls) = (stored("size_cells")?, stored("blocked")?);
    Ok(Map { size: [size.values[0] as usize, size.values[1] as usize], walls })
}

impl Map<'_> {
    /// An empty panel over the whole map.
    pub(super) fn panel(&self, title: String) -> Result<Panel, RenderError> {
        let [width, height] = self.size.map(|side| side as f64);
        window(title, [[0.0, width], [0.0, height]])
    }

    /// An empty panel over a square part of the map that holds `points` and some room around them.
    pub(super) fn panel_about(&self, title: String, points: &[[f64; 2]]) -> Result<Panel, RenderError> {
        let of = |axis: usize, pick: fn(f64, f64) -> f64, start: f64| {
            points.iter().map(|point| point[axis]).fold(start, pick)
        };
        let ends =
            [0, 1].map(|axis| [of(axis, f64::min, f64::INFINITY), of(axis, f64::max, f64::NEG_INFINITY)]);
        let least_side = self.size[0].min(self.size[1]) as f64;
        let side =
            ends.iter().map(|[low, high]| (high - low).ceil() + 3.0).fold(0.0, f64::max).min(least_side);
        let part = [0, 1].map(|axis| {
            let [low, high] = ends[axis];
            let from =
                (f64::midpoint(low, high) - side / 2.0).round().clamp(0.0, self.size[axis] as f64 - side);
            [from, from + side]
        });
        window(title, part)
    }
}

fn window(title: String, [x, y]: [[f64; 2]; 2]) -> Result<Panel, RenderError> {
    let axis = |label: &str, [low, high]: [f64; 2]| Axis::linear(label, low, high);
    let (x, y) = (axis("x (cells)", x)?, axis("y (cells)", y)?);
    Ok(Panel::new(title, x, y).trimmed(Trim::Frame).with_equal_scales())
}

/// Markers on the first and the last of `points`.
pub(super) fn add_ends(panel: &mut Panel, points: &[[f64; 2]]) {
    for (label, marker, at) in
        [("start", Marker::Circle, points.first()), ("goal", Marker::Diamond, points.last())]
    {
        let points = at.into_iter().copied().collect();
        panel.add(Points { points, marker, radius_pt: 3.2, color: GREEN, label: label.to_owned() });
    }
}

/// The cells of `map`, blocked ones dark, with what `painted` lists on top of nothing and below the walls.
pub(super) fn painted(map: &Map<'_>, layers: &[(Vec<[f64; 2]>, Rgb)], keys: Vec<Key>) -> Cells {
    let [columns, rows] = map.size;
    let mut colors = vec![None; columns * rows];
    let walls: Vec<[f64; 2]> = map.walls.values.chunks(2).map(|point| [point[0], point[1]]).collect();
    for (cells, color) in layers.iter().chain(&[(walls, blocked())]) {
        for [x, y] in cells {
            colors[*y as usize * columns + *x as usize] = Some(*color);
        }
    }
    let lines = Some(Stroke::solid(BLACK.mixed(WHITE, 0.85), 0.25));
    Cells { corner: [0.0, 0.0], cell: [1.0, 1.0], columns, colors, lines, keys }
}

/// The cells that an exhibit lists, in its order.
pub(super) fn listed(exhibit: Option<&Exhibit>) -> Vec<[f64; 2]> {
    exhibit.into_iter().flat_map(|e| e.values.chunks(e.width)).map(|point| [point[0], point[1]]).collect()
}

fn title(row: &Row) -> String {
    let number = |column: &str, decimals: usize| {
        row.value(column).map_or_else(|| "–".to_owned(), |value| format!("{value:.decimals$}"))
    };
    format!(
        "{}: cost {}, turns {}°, opened {}",
        row.key.contender,
        number("path_cost_cells", 2),
        number("turn_exterior_deg", 2),
        number("opened", 0)
    )
}

/// A cell (x, y) is drawn as the unit square from (x, y) to (x + 1, y + 1), as the paper places its points.
pub(super) fn centres(path: &Exhibit) -> Vec<[f64; 2]> {
    path.values.chunks(path.width).map(|point| [point[0] + 0.5, point[1] + 0.5]).collect()
}

fn cells(scene: &Scene<'_>, row: &Row, map: &Map<'_>) -> Cells {
    let side = |name: &str| listed(scene.run.exhibit(&row.key, name));
    let layers = [(side("opened_goal_side"), goal_side()), (side("opened_start_side"), start_side())];
    let keys = vec![
        cell_key("blocked", blocked()),
        cell_key("opened by the start's side", start_side()),
        cell_key("opened by the goal's side", goal_side()),
    ];
    painted(map, &layers, keys)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::style::SERIES_MARGIN;

    #[test]
    fn walls_both_sides_and_bare_paper_differ_in_grey() {
        let mut greys = [blocked(), start_side(), goal_side(), WHITE].map(Rgb::luminance);
        greys.sort_by(f64::total_cmp);
        assert!(greys.windows(2).all(|pair| pair[1] - pair[0] >= SERIES_MARGIN), "{greys:?}");
    }
}
