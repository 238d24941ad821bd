//! Searches on grid maps: opened cells of each side at the end or at moments before, raw and tidied path, refused lines of
//! sight.

use super::{Entry, Scene, Shown, World, ask};
use crate::render::RenderError;
use crate::render::chart::axis::bounds;
use crate::render::chart::legend::{Key, cell_key};
use crate::render::chart::marks::{Cells, Line, Points};
use crate::render::chart::{Axis, Panel, Sheet, Trim};
use crate::render::style::{
    BLACK, BLUE, Dash, GREEN, GREY, Marker, ORANGE, PURPLE, Rgb, SKY, Stroke, VERMILLION, WHITE, Width,
};
use base::settings::Accepted;
use engine::planner::Trace;
use engine::shorten::bends;
use schemars::JsonSchema;
use serde::Deserialize;
use study::paper::Claim;
use study::record::Row;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "grid_search",
    about: "searches on grid maps: opened cells of each side, then or by moments, paths, bends; one panel a trial or moment",
    statistic: "Single trials.",
    settings: Accepted::shape::<GridSearch>(),
    example: r#"
problems = ["W1"]
contenders = ["A*", "Improved A*"]
"#,
    build: |settings, _study, paper| {
        let read: GridSearch = settings.read()?;
        let mut printed = Vec::new();
        for (index, row) in read.printed.iter().enumerate() {
            ask::all_printed(settings, paper, &format!("printed.{index}"), row)?;
            let cells = row.iter().filter_map(|id| paper.claim(id)).map(cell);
            printed.push(cells.collect::<Vec<_>>().join(", "));
        }
        Ok(Box::new(Ready { read, printed }))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct GridSearch {
    /// Problem groups; the first instance of each is shown.
    problems: Vec<String>,
    /// The contenders, by their labels.
    contenders: Vec<String>,
    /// Shares of all opened cells: one panel each, about what was opened by then, instead of one at the end.
    #[serde(default)]
    #[schemars(inner(range(min = 0, max = 1)))]
    moments: Vec<f64>,
    /// Claims of each contender, in their order, whose printed numbers stand beside ours.
    #[serde(default)]
    printed: Vec<Vec<String>>,
    /// Shows, in place of opened cells, how the path was tidied: bends before and after, refused lines of sight.
    #[serde(default)]
    tidying: bool,
}

struct Ready {
    read: GridSearch,
    /// What the paper prints of each contender.
    printed: Vec<String>,
}

/// What a claim prints, with its unit.
fn cell(claim: &Claim) -> String {
    let printed = claim.printed.as_deref().unwrap_or_default();
    match claim.unit.as_deref() {
        Some("°") => format!("{printed}°"),
        Some(unit) => format!("{printed} {unit}"),
        None => printed.to_owned(),
    }
}

/// Cells opened from the start's side, from the goal's, from both, and blocked ones.
const START_SIDE: Rgb = SKY.mixed(WHITE, 0.6);
const GOAL_SIDE: Rgb = ORANGE.mixed(WHITE, 0.2);
const BOTH_SIDES: Rgb = PURPLE.mixed(BLACK, 0.15);
const BLOCKED: Rgb = BLACK.mixed(WHITE, 0.25);

impl World for Ready {
    fn shown(&self) -> Vec<Shown<'_>> {
        self.read.problems.iter().map(|problem| Shown::first(problem, &self.read.contenders)).collect()
    }

    fn sheet(&self, _scene: &Scene<'_>, count: usize) -> Sheet {
        Sheet::new(Width::Double, count, if self.read.moments.is_empty() { 215.0 } else { 150.0 })
    }

    fn panels(&self, scene: &Scene<'_>, shown: &Shown<'_>, _place: usize) -> Result<Vec<Panel>, RenderError> {
        let mut panels = Vec::new();
        for (place, row) in shown.trials(scene)?.into_iter().enumerate() {
            let map = Map::new(scene, row)?;
            let printed = self.printed.get(place).map(String::as_str);
            match (&self.read.moments[..], self.read.tidying) {
                ([], true) => panels.push(map.tidied(shown.problems)),
                ([], false) => panels.push(map.searched(printed)),
                (moments, _) => panels.extend(moments.iter().map(|share| map.moment(*share))),
            }
        }
        panels.into_iter().collect()
    }
}

/// A trial on a map as it is stored: the map's size and its blocked cells.
struct Map<'a> {
    scene: &'a Scene<'a>,
    row: &'a Row,
    /// The vertices along each axis.
    size: [usize; 2],
    walls: &'a Trace,
    /// Whether vertices are corners of cells, and not their middles.
    is_on_corners: bool,
}

impl<'a> Map<'a> {
    fn new(scene: &'a Scene<'a>, row: &'a Row) -> Result<Self, RenderError> {
        let stored = |name: &str| ask::trace(scene, &row.key.on, name);
        let size = stored("size_cells")?;
        let walls = stored("blocked")?;
        let size = [size.values[0] as usize, size.values[1] as usize];
        // Among vertices that are corners, the middle of a cell lies between four of them.
        let is_on_corners = walls.values.iter().any(|value| value.fract() != 0.0);
        Ok(Self { scene, row, size, walls, is_on_corners })
    }

    fn trace(&self, name: &str) -> Option<&'a Trace> {
        self.scene.run.trace(&self.row.key, name)
    }

    /// The cells of a trace, in its order; none if it was not kept.
    fn listed(&self, name: &str) -> Vec<[f64; 2]> {
        self.trace(name).map(ask::points).unwrap_or_default()
    }

    /// Where vertices are drawn: a cell (x, y) is the unit square from (x, y) to (x + 1, y + 1), as the paper places its points.
    fn placed(&self, vertices: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
        let shift = if self.is_on_corners { 0.0 } else { 0.5 };
        vertices.into_iter().map(|[x, y]| [x + shift, y + shift]).collect()
    }

    /// The vertices of a stored path, where they are drawn.
    fn way(&self, path: &Trace) -> Vec<[f64; 2]> {
        self.placed(ask::points(path))
    }

    /// Where all that was opened is drawn.
    fn opened(&self) -> Vec<[f64; 2]> {
        let sides = ["opened_start_side", "opened_goal_side"].map(|name| self.listed(name));
        self.placed(sides.concat())
    }

    /// All that was opened and the paths; the title with what is printed.
    fn searched(&self, printed: Option<&str>) -> Result<Panel, RenderError> {
        let number = |column: &str, decimals| ask::number(self.row, column, decimals);
        // Four digits behind the point: 14.6569 was printed as 14.65, and 14.66 would look like another number.
        let title = format!(
            "{}: {}{} cells, {}°, {} nodes opened",
            self.row.key.contender,
            printed.map_or_else(String::new, |printed| format!("printed {printed}; ours ")),
            number("path_cost_cells", 4),
            number("turn_exterior_deg", 2),
            number("opened", 0)
        );
        let [width, height] = self.cells().map(|side| side as f64);
        let mut panel = window(title, [[0.0, width], [0.0, height]])?;
        let (start, goal) = (self.listed("opened_start_side"), self.listed("opened_goal_side"));
        self.paint_sides(
            &mut panel,
            start,
            goal,
            ["opened by the start's side", "opened by the goal's side"],
        );
        if let Some(path) = self.trace("path") {
            panel
                .add(Line::through(self.way(path), Stroke::solid(VERMILLION, 1.6)).labelled("returned path"));
            ask::add_ends(&mut panel, &self.way(path), 3.2, ENDS);
        }
        // On top: a path that was tidied by less than a cell would hide it.
        if let Some(raw) = self.trace("raw_path") {
            let dashed = Stroke::solid(BLUE, 1.0).dashed(Dash::Dashed);
            panel.add(Line::through(self.way(raw), dashed).labelled("path as searched"));
        }
        Ok(panel)
    }

    /// What was opened when `share` of all was, and at the end the path found.
    fn moment(&self, share: f64) -> Result<Panel, RenderError> {
        let sides = ["opened_start_side", "opened_goal_side"].map(|name| self.listed(name));
        let shown = sides.each_ref().map(|side| (side.len() as f64 * share).ceil() as usize);
        let all: usize = sides.iter().map(Vec::len).sum();
        let title = format!("{} of {all} nodes opened", shown.iter().sum::<usize>());
        let mut panel = self.panel_about(title, &self.opened())?;
        let [start, goal] = [0, 1].map(|side: usize| sides[side][..shown[side]].to_vec());
        self.paint_sides(&mut panel, start, goal, ["opened from the start", "opened from the goal"]);
        let path = self
            .trace("raw_path")
            .or_else(|| self.trace("path"))
            .map(|path| self.way(path))
            .unwrap_or_default();
        if share >= 1.0 {
            panel.add(Line::through(path.clone(), Stroke::solid(BLUE, 1.4)).labelled("path found"));
            let met: Vec<[f64; 2]> = self.trace("meeting").map(|path| self.way(path)).unwrap_or_default();
            if !met.is_empty() {
                panel
                    .add(Points::unlabelled(met, Marker::Square, 2.0, BLACK).labelled("where the sides met"));
            }
        }
        ask::add_ends(&mut panel, &path, 3.2, ENDS);
        Ok(panel)
    }

    /// Bends before and after, and the lines of sight that were refused.
    fn tidied(&self, problem: &str) -> Result<Panel, RenderError> {
        let stored = |name: &str| ask::trace(self.scene, &self.row.key, name);
        let raw = stored("raw_path")?;
        let path = stored("path")?;
        let refused = stored("refused_sight")?;
        let raw_points: Vec<&[f64]> = raw.values.chunks(raw.width).collect();
        let bent: Vec<[f64; 2]> = bends(&raw_points).into_iter().map(|i| self.way(raw)[i]).collect();
        let path = self.way(path);
        let title = format!("{problem}: {} bends before, {} after", bent.len() - 2, path.len() - 2);
        let mut panel = self.panel_about(title, &self.way(raw))?;
        self.paint(&mut panel, &[], vec![cell_key("blocked", BLOCKED)]);
        let lines = refused.values.chunks(refused.width).flat_map(|ends| {
            let [from, to] = [[ends[0], ends[1]], [ends[2], ends[3]]];
            self.placed(vec![from, to, [f64::NAN; 2]])
        });
        let dotted = Stroke::solid(GREY, 0.9).dashed(Dash::Dotted);
        panel.add(Line::through(lines.collect(), dotted).labelled("line of sight refused"));
        let dashed = Stroke::solid(BLUE, 1.0).dashed(Dash::Dashed);
        panel.add(Line::through(self.way(raw), dashed).labelled("path as searched"));
        panel.add(Points::unlabelled(bent, Marker::Circle, 1.8, BLUE).labelled("its bends"));
        let kept = Line::through(path.clone(), Stroke::solid(VERMILLION, 1.6)).marked(Marker::Square);
        panel.add(kept.labelled("after deletion"));
        ask::add_ends(&mut panel, &path, 3.2, ENDS);
        Ok(panel)
    }

    /// An empty panel over a square part of the map that holds `points` and some room around them.
    fn panel_about(&self, title: String, points: &[[f64; 2]]) -> Result<Panel, RenderError> {
        let [low, high] = bounds(points.iter().copied());
        let least_side = self.size[0].min(self.size[1]) as f64;
        let side = [0, 1].map(|axis| (high[axis] - low[axis]).ceil() + 3.0);
        let side = side.into_iter().fold(0.0, f64::max).min(least_side);
        let part = [0, 1].map(|axis| {
            let middle = f64::midpoint(low[axis], high[axis]);
            let from = (middle - side / 2.0).round().clamp(0.0, self.size[axis] as f64 - side);
            [from, from + side]
        });
        window(title, part)
    }

    /// How many cells lie along each axis.
    fn cells(&self) -> [usize; 2] {
        self.size.map(|side| if self.is_on_corners { side - 1 } else { side })
    }

    /// Adds the cells with what each side opened, and what both did.
    fn paint_sides(&self, panel: &mut Panel, start: Vec<[f64; 2]>, goal: Vec<[f64; 2]>, names: [&str; 2]) {
        let both: Vec<[f64; 2]> = start.iter().filter(|cell| goal.contains(cell)).copied().collect();
        let mut keys = vec![cell_key("blocked", BLOCKED)];
        let layers = [(start, START_SIDE), (goal, GOAL_SIDE), (both, BOTH_SIDES)];
        for ((cells, color), name) in layers.iter().zip([names[0], names[1], "opened by both"]) {
            keys.extend((!cells.is_empty()).then(|| cell_key(name, *color)));
        }
        self.paint(panel, &layers, keys);
    }

    /// Adds `layers` of vertices and, above them, the blocked cells in dark. A vertex at a corner is drawn as a square about it.
    fn paint(&self, panel: &mut Panel, layers: &[(Vec<[f64; 2]>, Rgb)], keys: Vec<Key>) {
        let lines = Some(Stroke::solid(BLACK.mixed(WHITE, 0.85), 0.25));
        let walls = (ask::points(self.walls), BLOCKED);
        let colored = |[columns, rows]: [usize; 2],
                       layers: &mut dyn Iterator<Item = &(Vec<[f64; 2]>, Rgb)>| {
            let mut colors = vec![None; columns * rows];
            for (cells, color) in layers {
                for [x, y] in cells {
                    colors[*y as usize * columns + *x as usize] = Some(*color);
                }
            }
            colors
        };
        let [columns, rows] = self.cells();
        if self.is_on_corners {
            let colors = colored(self.size, &mut layers.iter());
            let about = Cells {
                corner: [-0.5; 2],
                cell: [1.0; 2],
                columns: self.size[0],
                colors,
                lines: None,
                keys: Vec::new(),
            };
            panel.add(about);
            let colors = colored([columns, rows], &mut std::iter::once(&walls));
            panel.add(Cells { corner: [0.0; 2], cell: [1.0; 2], columns, colors, lines, keys });
        } else {
            let colors = colored(self.size, &mut layers.iter().chain(std::iter::once(&walls)));
            panel.add(Cells { corner: [0.0; 2], cell: [1.0; 2], columns, colors, lines, keys });
        }
    }
}

fn window(title: String, [x, y]: [[f64; 2]; 2]) -> Result<Panel, RenderError> {
    let axis = |label: &str, [low, high]: [f64; 2]| Axis::linear(label, low, high);
    let (x, y) = (axis("x (cells)", x)?, axis("y (cells)", y)?);
    Ok(Panel::new(title, x, y).trimmed(Trim::Frame).with_equal_scales())
}

/// How the ends of paths are marked.
const ENDS: [(Marker, Rgb); 2] = [(Marker::Circle, GREEN), (Marker::Diamond, GREEN)];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::style::SERIES_MARGIN;

    #[test]
    fn walls_both_sides_and_bare_paper_differ_in_grey() {
        let mut greys = [BLOCKED, START_SIDE, GOAL_SIDE, BOTH_SIDES, WHITE].map(Rgb::luminance);
        greys.sort_by(f64::total_cmp);
        assert!(greys.windows(2).all(|pair| pair[1] - pair[0] >= SERIES_MARGIN), "{greys:?}");
    }
}
