//! A planar arm among obstacles: what each tip position is, paths of the tip, the arm at stations along them; or both its
//! postures at one point.

use super::{Entry, Scene, Shown, World, ask};
use crate::render::RenderError;
use crate::render::canvas::{Align, Stand, Type};
use crate::render::chart::axis::bounds;
use crate::render::chart::legend::cell_key;
use crate::render::chart::marks::{Cells, Line, Note, Points, Shape};
use crate::render::chart::{Axis, Panel, Sheet, Trim};
use crate::render::style::{
    BLACK, BLUE, Fill, GREEN, GREY, INK, Marker, ORANGE, Rgb, SKY, Stroke, TextSize, VERMILLION, WHITE,
    Width, YELLOW, series_marker, series_stroke,
};
use base::settings::Accepted;
use engine::geometry::planar::{Segment2, distance_segment_segment};
use engine::planner::Trace;
use schemars::JsonSchema;
use serde::Deserialize;
use study::record::Row;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "arm_plane",
    about: "a planar arm among obstacles: zones, paths of the tip, the arm at stations along them; or both postures at the goal",
    statistic: "Single trials.",
    settings: Accepted::shape::<ArmPlane>(),
    example: r#"
stations = 7
panels = [
    { problem = "case 1", contenders = ["A* 8"] },
    { problem = "case 2", contenders = ["A* 8"] },
]
"#,
    build: |settings, _study, _paper| Ok(Box::new(settings.read::<ArmPlane>()?)),
};

/// Height of a panel's plot, in points.
const PLOT_PT: f64 = 150.0;

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct ArmPlane {
    /// The part of the plane that is shown, x from and to, then y; all of it if absent.
    window_cm: Option<[f64; 4]>,
    /// Whether paths are drawn; without, the arm stands at the stations alone.
    #[serde(default = "yes")]
    paths: bool,
    /// At how many points of the first path the arm is drawn.
    #[serde(default)]
    #[schemars(range(max = 1000))]
    stations: usize,
    /// Whether a marker stands on each node of the paths.
    #[serde(default)]
    nodes: bool,
    /// Whether both postures at the goal of each problem are shown instead, without obstacles.
    #[serde(default)]
    postures: bool,
    /// The panels, in their order.
    panels: Vec<PanelSetting>,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct PanelSetting {
    /// The problem group; its first instance is shown.
    problem: String,
    /// What stands above it; the problem group if absent.
    title: Option<String>,
    /// Whether its points are coloured by kind.
    #[serde(default)]
    zones: bool,
    /// Whose paths, of the first seed.
    #[serde(default)]
    contenders: Vec<String>,
}

fn yes() -> bool {
    true
}

impl World for ArmPlane {
    fn shown(&self) -> Vec<Shown<'_>> {
        self.panels.iter().map(|panel| Shown::first(&panel.problem, &panel.contenders)).collect()
    }

    fn sheet(&self, _scene: &Scene<'_>, count: usize) -> Sheet {
        Sheet::new(Width::Double, count.min(2), PLOT_PT)
    }

    fn panels(&self, scene: &Scene<'_>, shown: &Shown<'_>, place: usize) -> Result<Vec<Panel>, RenderError> {
        if !self.postures {
            return Ok(vec![self.panel(scene, shown, place)?]);
        }
        let both = ask::trace(scene, shown.instance(scene)?, "branches")?;
        let stations: Vec<&[f64]> = both.values.chunks(both.width).collect();
        let postures = [("elbow down", stations[1]), ("elbow up", stations[0])];
        postures.into_iter().map(|(name, station)| posture(name, station, &stations)).collect()
    }
}

impl ArmPlane {
    fn panel(&self, scene: &Scene<'_>, shown: &Shown<'_>, place: usize) -> Result<Panel, RenderError> {
        let (setting, map, rows) = (&self.panels[place], shown.instance(scene)?, shown.trials(scene)?);
        let lattice = &ask::trace(scene, map, "lattice")?.values;
        let low = [lattice[0], lattice[1]];
        let step = lattice[2];
        let size = [lattice[3], lattice[4]];
        let ends = |axis: usize| match self.window_cm {
            Some(window) => [window[2 * axis], window[2 * axis + 1]],
            None => [low[axis] - step, low[axis] + step * size[axis]],
        };
        let axis = |label: &str, axis: usize| Axis::linear(label, ends(axis)[0], ends(axis)[1]);
        let title = match &setting.title {
            Some(title) => title.clone(),
            None if self.paths => title(&setting.problem, &rows),
            None => setting.problem.clone(),
        };
        let mut panel = Panel::new(title, axis("x (cm)", 0)?, axis("y (cm)", 1)?)
            .trimmed(Trim::Frame)
            .with_equal_scales();
        if setting.zones {
            let zones = ask::trace(scene, map, "zones")?;
            panel.add(zone_cells(zones, [low[0] - step / 2.0, low[1] - step / 2.0], step, size[0] as usize));
        }
        for index in 1.. {
            let Some(outline) = scene.run.trace(map, &format!("obstacle_{index}")) else { break };
            panel.add(obstacle(outline, !setting.zones));
        }
        for (index, row) in rows.iter().enumerate() {
            self.add_path(scene, row, index, &mut panel);
        }
        Ok(panel)
    }

    fn add_path(&self, scene: &Scene<'_>, row: &Row, index: usize, panel: &mut Panel) {
        let Some(stations) = scene.run.trace(&row.key, "stations") else { return };
        let stations: Vec<&[f64]> = stations.values.chunks(stations.width).collect();
        if index == 0 {
            for station in spread(&stations, self.stations) {
                let joints = vec![[0.0, 0.0], [station[2], station[3]], [station[4], station[5]]];
                panel.add(Line::through(joints.clone(), Stroke::solid(GREY, 1.4)).labelled("arm"));
                panel.add(Points::unlabelled(joints[..2].to_vec(), Marker::Circle, 1.6, INK));
            }
        }
        if !self.paths {
            return;
        }
        let path: Vec<[f64; 2]> = stations.iter().map(|station| [station[4], station[5]]).collect();
        ask::add_ends(panel, &path, 3.0, [(Marker::Circle, GREEN), (Marker::Diamond, GREEN)]);
        let place = ask::place(scene, &row.key.contender);
        let line = Line::through(path.clone(), series_stroke(place)).labelled(row.key.contender.to_string());
        panel.add(if self.nodes { beneath(line, index).marked(series_marker(place)) } else { line });
        // Where no hop was judged it is unknown whether the arm hits, and none is drawn.
        let Some(hits) = row.value("unsafe_hops").filter(|_| self.stations > 0) else { return };
        for [lower, upper] in nearest_arms(scene, row, &stations).into_iter().take(hits as usize) {
            let arm = [lower.a, lower.b, upper.b].map(|joint| [joint.x, joint.y]).to_vec();
            panel.add(Line::through(arm, Stroke::solid(VERMILLION, 1.4)).labelled("arm where it hits"));
        }
    }
}

/// The arm, its joints turning evenly, where it comes nearest to an obstacle on each hop; the nearest first.
fn nearest_arms(scene: &Scene<'_>, row: &Row, stations: &[&[f64]]) -> Vec<[Segment2; 2]> {
    let outline = |index: usize| scene.run.trace(&row.key.on, &format!("obstacle_{index}"));
    let outlines: Vec<Vec<[f64; 2]>> = (1..).map_while(outline).map(ask::points).collect();
    let sides = outlines.iter().flat_map(|corners| {
        let next = corners.iter().cycle().skip(1);
        corners.iter().zip(next).map(|(from, to)| Segment2::new((*from).into(), (*to).into()))
    });
    let sides: Vec<Segment2> = sides.collect();
    let clearance = |links: &[Segment2; 2]| {
        let pairs = links.iter().flat_map(|link| sides.iter().map(move |side| (link, side)));
        pairs.map(|(link, side)| distance_segment_segment(link, side)).fold(f64::INFINITY, f64::min)
    };
    let nearest = |hop: &[&[f64]]| {
        let arms = (0..=MOMENTS).map(|moment| links(hop[0], hop[1], moment));
        arms.map(|links| (clearance(&links), links)).min_by(|a, b| a.0.total_cmp(&b.0))
    };
    let mut arms: Vec<(f64, [Segment2; 2])> = stations.windows(2).filter_map(nearest).collect();
    arms.sort_by(|a, b| a.0.total_cmp(&b.0));
    arms.into_iter().map(|(_, links)| links).collect()
}

/// At how many moments of a hop the arm is set beside obstacles.
const MOMENTS: usize = 32;

/// Both links at a moment between two stations, its joints turning evenly.
fn links(from: &[f64], to: &[f64], moment: usize) -> [Segment2; 2] {
    let share = moment as f64 / MOMENTS as f64;
    let [q1, q2] = [0, 1].map(|joint: usize| (from[joint] + share * (to[joint] - from[joint])).to_radians());
    let (l1, l2) = (libm::hypot(from[2], from[3]), libm::hypot(from[4] - from[2], from[5] - from[3]));
    let elbow = [l1 * libm::cos(q1), l1 * libm::sin(q1)];
    let tip = [elbow[0] + l2 * libm::cos(q1 + q2), elbow[1] + l2 * libm::sin(q1 + q2)];
    [[[0.0, 0.0], elbow], [elbow, tip]].map(|[a, b]| Segment2::new(a.into(), b.into()))
}

/// The line, with its nodes, of the path of number `index`: the first is broad, so that it shows where a later one lies on it.
fn beneath(line: Line, index: usize) -> Line {
    if index > 0 {
        return line;
    }
    Line { stroke: Stroke::solid(line.stroke.color, 2.6), radius_pt: 3.4, ..line }
}

/// `count` of the stations, the ends among them.
fn spread<'a>(stations: &[&'a [f64]], count: usize) -> Vec<&'a [f64]> {
    match (stations, count) {
        ([], _) | (_, 0) => Vec::new(),
        (_, 1) => vec![stations[stations.len() / 2]],
        _ => (0..count).map(|k| stations[k * (stations.len() - 1) / (count - 1)]).collect(),
    }
}

fn title(problem: &str, rows: &[&Row]) -> String {
    match rows {
        [row] => {
            let length =
                row.value("path_length_cm").map_or_else(|| "no path".to_owned(), |l| format!("{l:.4} cm"));
            let hits = match row.value("unsafe_hops") {
                Some(hops) if hops > 0.0 => {
                    format!(", {hops:.0} of its hops hit, {} cm deep", ask::number(row, "deepest_cm", 3))
                }
                _ => String::new(),
            };
            format!("{problem}, {}: {length}{hits}", row.key.contender)
        }
        _ => problem.to_owned(),
    }
}

/// What a point of the plane is, by its code, and its colour.
const ZONES: [(&str, Rgb); 5] = [
    ("free", SKY.mixed(WHITE, 0.65)),
    ("out of reach", GREY.mixed(WHITE, 0.55)),
    ("inner radius", YELLOW.mixed(WHITE, 0.35)),
    ("in an obstacle", BLACK.mixed(WHITE, 0.35)),
    ("a link would hit", ORANGE.mixed(WHITE, 0.35)),
];

fn zone_cells(zones: &Trace, corner: [f64; 2], step: f64, columns: usize) -> Cells {
    Cells {
        corner,
        cell: [step, step],
        columns,
        colors: zones.values.iter().map(|code| Some(ZONES[*code as usize].1)).collect(),
        lines: None,
        keys: ZONES.map(|(name, color)| cell_key(name, color)).to_vec(),
    }
}

/// An obstacle; its outline alone where zones show what lies in it.
fn obstacle(outline: &Trace, is_filled: bool) -> Shape {
    Shape {
        corners: ask::points(outline),
        fill: is_filled.then(|| Fill::sheer(BLUE.mixed(BLACK, 0.3), 0.45)),
        stroke: Some(Stroke::solid(INK, 0.7)),
        // Where zones show what lies in it, they name it.
        label: if is_filled { "obstacle".to_owned() } else { String::new() },
    }
}

/// Room beside and above the arm for the names of its joints, which must reach neither the frame nor the ticks.
const MARGINS_CM: [f64; 2] = [22.0, 12.0];

/// A station is θ1, θ2 in degrees, elbow and tip in centimetres.
fn posture(name: &str, station: &[f64], all: &[&[f64]]) -> Result<Panel, RenderError> {
    let [low, high] = bounds(all.iter().flat_map(|s| [[0.0; 2], [s[2], s[3]], [s[4], s[5]]]));
    let title = format!("{name}: θ1 = {:.2}°, θ2 = {:.2}°", station[0], station[1]).replace('-', "−");
    let axis = |label: &str, axis: usize| {
        Axis::linear(label, low[axis] - MARGINS_CM[axis], high[axis] + MARGINS_CM[axis])
    };
    let (x, y) = (axis("x (cm)", 0)?, axis("y (cm)", 1)?);
    let mut panel = Panel::new(title, x, y).trimmed(Trim::Grid).with_equal_scales();
    let elbow = [station[2], station[3]];
    let tip = [station[4], station[5]];
    panel.add(Line::through(vec![[0.0, 0.0], elbow], Stroke::solid(BLUE, 2.6)).labelled("link 1"));
    panel.add(Line::through(vec![elbow, tip], Stroke::solid(VERMILLION, 2.6)).labelled("link 2"));
    // The elbow's name stands on the side to which the arm bends, where no link is.
    let bends_right = elbow[0] > tip[0].midpoint(0.0);
    for (text, at, color, to_right) in
        [("base", [0.0, 0.0], INK, true), ("elbow", elbow, INK, bends_right), ("tip", tip, GREEN, true)]
    {
        panel.add(Points::unlabelled(vec![at], Marker::Circle, 3.0, color));
        let (align, shift) = if to_right { (Align::Start, 6.0) } else { (Align::End, -6.0) };
        let set = Type::regular(TextSize::TICK).aligned(align, Stand::Centre);
        panel.add(Note { at, shift_pt: [shift, 0.0], text: text.to_owned(), set });
    }
    Ok(panel)
}
