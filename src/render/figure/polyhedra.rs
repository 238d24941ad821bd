//! Scenes of solid, depth-sorted polyhedra: tip paths, or the whole arm along its path with the last posture solid; one row
//! a contender, one panel a view.

use super::{Entry, Scene, Shown, World, ask};
use crate::render::RenderError;
use crate::render::chart::axis::bounds;
use crate::render::chart::legend::cell_key;
use crate::render::chart::{Key, Panel, Sheet};
use crate::render::scene3::{Camera, Paint, Scene as Solids, Vec3, box_corners, panel};
use crate::render::style::{
    BLACK, BLUE, Dash, GREEN, ORANGE, PURPLE, Rgb, SKY, Stroke, VERMILLION, WHITE, Width,
};
use ask::points;
use base::settings::{Accepted, Faults};
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::sync::Arc;
use study::key::{InstanceKey, SweepKey};
use study::record::{Row, Status};

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "polyhedra",
    about: "tip paths, or the whole arm along its path, among solid polyhedra; one row a contender, one panel a view",
    statistic: "Single trials.",
    settings: Accepted::shape::<Read>(),
    example: r#"
problem = "E1"
contenders = ["A*", "Improved A*"]
views = ["corner"]
"#,
    build: |settings, study, _paper| {
        let read: Read = settings.read()?;
        let mut faults = Faults::default();
        if let Some(query) = &read.query {
            faults.keep(ask::query(settings, study, &read.problem, query, ("query", query)));
        }
        let sweep = read.sweep.as_ref().and_then(|text| faults.keep(ask::sweep(settings, study, text)));
        Ok(Box::new(faults.or(Some(Polyhedra { read, sweep }))?))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Read {
    /// The problem group; its first instance is shown, or the first that only the first contender solves.
    problem: String,
    /// The query, where an instance has several.
    query: Option<String>,
    /// Whether the whole arm is drawn along its path; else the path of its tip alone.
    #[serde(default)]
    arm: bool,
    /// Whether the instance is the first that only the first contender solves, if there is one whose arm is stored.
    #[serde(default)]
    first_alone: bool,
    /// By how many centimetres boxes are grown to show the space that the tip keeps out of; not shown if absent.
    #[schemars(range(min = 0.0))]
    grown_cm: Option<f64>,
    /// One row each.
    #[schemars(length(min = 1))]
    contenders: Vec<String>,
    /// One panel each.
    #[schemars(length(min = 1))]
    views: Vec<View>,
    /// The sweeps' values of the trial that is shown, as `setting=value,…`; the first trial if absent.
    sweep: Option<String>,
}

struct Polyhedra {
    read: Read,
    /// The point of the sweeps that is shown; the first trial if absent.
    sweep: Option<SweepKey>,
}

/// From where a scene is seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
enum View {
    /// From the front, a little from above: x to the right.
    Front,
    /// From the side: y to the left, towards the front.
    Side,
    /// From a corner, above.
    Corner,
}

impl View {
    /// Its name in a panel's title, and its camera.
    fn camera(self) -> (&'static str, Camera) {
        match self {
            Self::Front => ("front", Camera::parallel(-80.0, 14.0)),
            Self::Side => ("side", Camera::parallel(-10.0, 14.0)),
            Self::Corner => ("corner", Camera::parallel(-52.0, 24.0)),
        }
    }
}

impl World for Polyhedra {
    fn shown(&self) -> Vec<Shown<'_>> {
        vec![Shown::first(&self.read.problem, &self.read.contenders)]
    }

    fn sheet(&self, _scene: &Scene<'_>, count: usize) -> Sheet {
        let (height, note) = if self.read.arm { (220.0, "Rod radii are assumed.") } else { (205.0, "") };
        // One view each: contenders stand side by side.
        let columns = if self.read.views.len() == 1 { count } else { self.read.views.len() };
        Sheet::new(Width::Double, columns, height).noted("What is hidden of a path is dashed.").noted(note)
    }

    fn panels(&self, scene: &Scene<'_>, shown: &Shown<'_>, _place: usize) -> Result<Vec<Panel>, RenderError> {
        let Read { views, arm: is_arm, .. } = &self.read;
        let mut panels = Vec::new();
        for contender in shown.contenders {
            let row = self.row(scene, contender)?;
            for (name, camera) in views.iter().map(|view| view.camera()) {
                let mut solids = Solids::default();
                let around = add_obstacles(&mut solids, scene, &row.key.on, !is_arm)?;
                let mut keys =
                    if *is_arm { arm(&mut solids, scene, row)? } else { paths(&mut solids, scene, row)? };
                keys.extend(around);
                keys.extend(self.grown(&mut solids, scene, &row.key.on)?);
                let seen = if views.len() > 1 { format!(", {name}") } else { String::new() };
                let title = format!("{}: {}{seen}", row.key.contender, self.outcome_text(row));
                panels.push(panel(title, solids, camera, (20.0, "cm"), keys));
            }
        }
        Ok(panels)
    }
}

impl Polyhedra {
    /// Adds the edges of what the tip keeps out of, about every box but the one that the arm stands on; the legend's entry.
    fn grown(
        &self,
        solids: &mut Solids,
        scene: &Scene<'_>,
        of: &Arc<InstanceKey>,
    ) -> Result<Option<Key>, RenderError> {
        let Some(by) = self.read.grown_cm else { return Ok(None) };
        let pedestal = scene.run.trace(of, "pedestal").map(|found| found.values[0] as usize);
        let stroke = Stroke::solid(BLUE, 0.5).dashed(Dash::Dotted);
        for (body, (vertices, _)) in stored_bodies(scene, of)?.into_iter().enumerate() {
            let [low, high] = bounds(vertices);
            for edge in edges(low.map(|x| x - by), high.map(|x| x + by))
                .into_iter()
                .filter(|_| pedestal != Some(body))
            {
                solids.polyline(edge.to_vec(), stroke);
            }
        }
        Ok(Some(Key::line(&format!("grown by {by} cm, for the tip"), stroke)))
    }

    /// What became of the trial, for the panel's title.
    fn outcome_text(&self, row: &Row) -> String {
        if !self.read.arm {
            let length =
                row.value("path_length_cm").map_or_else(|| "–".to_owned(), |cm| format!("{cm:.1} cm"));
            return format!("{length}, {} nodes", ask::number(row, "opened", 0));
        }
        match (row.status, row.value("followed_share")) {
            (Status::Solved, _) => "goal reached".to_owned(),
            (_, Some(share)) => format!("stopped after {:.0}\u{2009}% of the path", 100.0 * share),
            (status, None) => status.to_string(),
        }
    }

    /// The first instance with a stored arm that only the first contender solves.
    fn chosen(&self, scene: &Scene<'_>) -> Option<u32> {
        let rows = |contender: &String| scene.run.rows(&self.read.problem, contender).into_iter();
        let (first, others) = self.read.contenders.split_first()?;
        let fails =
            |number: u32, other: &String| rows(other).any(|row| row.instance() == number && !row.is_solved());
        let is_chosen = |row: &&Row| {
            row.is_solved()
                && scene.run.trace(&row.key, "rods").is_some()
                && others.iter().all(|other| fails(row.instance(), other))
        };
        rows(first).find(is_chosen).map(Row::instance)
    }

    fn row<'a>(&self, scene: &'a Scene<'_>, contender: &str) -> Result<&'a Row, RenderError> {
        let chosen = if self.read.first_alone { self.chosen(scene) } else { None };
        let is_wanted = |row: &Row| {
            self.sweep.as_ref().is_none_or(|sweep| row.key.sweep == *sweep)
                && self.read.query.as_ref().is_none_or(|query| row.query() == query)
                && chosen.is_none_or(|number| row.instance() == number)
        };
        ask::wanted_trial(scene, &self.read.problem, contender, is_wanted)
    }
}

/// From the first posture to the last.
fn shade(share: f64) -> Rgb {
    ORANGE.mixed(WHITE, 0.6 * (1.0 - share))
}

/// The line of a rod's axis.
fn axis(share: f64) -> Stroke {
    Stroke::solid(shade(share), 2.4)
}

fn arm(solids: &mut Solids, scene: &Scene<'_>, row: &Row) -> Result<Vec<Key>, RenderError> {
    let rods = ask::trace(scene, &row.key, "rods")?;
    let last = rods.values.chunks(rods.width).map(|rod| rod[0]).fold(1.0, f64::max);
    for rod in rods.values.chunks(rods.width) {
        let (from, to) = ([rod[1], rod[2], rod[3]], [rod[4], rod[5], rod[6]]);
        // Solid rods of many postures cut each other into more facets than a picture can hold.
        if rod[0] < last {
            solids.polyline(vec![from, to], axis(rod[0] / last));
        } else {
            solids.capsule(from, to, rod[7], Paint::solid(shade(1.0)));
        }
    }
    let along = Key::line("axes of the rods on the way", axis(0.0));
    let mut keys = vec![along, cell_key("arm at the end", shade(1.0))];
    let trail = scene.run.trace(&row.key, "tip_trail").map(points).unwrap_or_default();
    // The whole way, where it is stored: a trail that stops short does not show the goal.
    let path = scene.run.trace(&row.key, "tip_path").map_or_else(|| trail.clone(), points);
    if way(&path) > way(&trail) + END_CM {
        let stroke = Stroke::solid(PURPLE, 1.3);
        solids.polyline(path.clone(), stroke);
        keys.push(Key::line("path to be followed", stroke));
    }
    keys.push(seen_through(solids, trail, "way of the tip", Stroke::solid(BLACK, 1.3)));
    if let Some(rod) = scene.run.trace(&row.key, "blocking_rod").map(|found| &found.values) {
        let stroke = Stroke::solid(VERMILLION, 2.4);
        solids.overlay(vec![[rod[0], rod[1], rod[2]], [rod[3], rod[4], rod[5]]], stroke);
        keys.push(Key::line("axis of the rod that would touch at the next node", stroke));
    }
    add_ends(solids, &path, END_CM);
    Ok(keys)
}

/// Adds a line, thin and dashed where it is hidden; its entry in the legend.
fn seen_through(solids: &mut Solids, points: Vec<Vec3>, label: &str, stroke: Stroke) -> Key {
    solids.overlay(points.clone(), Stroke::solid(stroke.color, 0.7).dashed(Dash::Dashed));
    solids.polyline(points, stroke);
    Key::line(label, stroke)
}

/// Radius of the balls at the ends of the arm's path.
const END_CM: f64 = 2.2;

/// Marks and names both ends of a path.
fn add_ends(solids: &mut Solids, path: &[Vec3], radius: f64) {
    for (at, color, label) in [(path.first(), GREEN, "start"), (path.last(), PURPLE, "goal")] {
        if let Some(at) = at {
            solids.capsule(*at, *at, radius, Paint::plain(color));
            solids.tag(*at, label);
        }
    }
}

/// Two paths whose lengths differ by less than this look the same.
const SEEN_CM: f64 = 0.3;

/// The length of a polyline.
fn way(points: &[Vec3]) -> f64 {
    let apart = |pair: &[Vec3]| (0..3).map(|i| (pair[1][i] - pair[0][i]).powi(2)).sum::<f64>().sqrt();
    points.windows(2).map(apart).sum()
}

/// Adds the path as searched and as returned, with their ends.
fn paths(solids: &mut Solids, scene: &Scene<'_>, row: &Row) -> Result<Vec<Key>, RenderError> {
    let mut keys = Vec::new();
    let path = points(ask::trace(scene, &row.key, "path")?);
    let raw = scene.run.trace(&row.key, "raw_path").map(points);
    // A path that was searched differs from the returned one only where straightening did something.
    if let Some(raw) = raw.filter(|raw| (way(raw) - way(&path)).abs() > SEEN_CM) {
        let stroke = Stroke::solid(BLUE, 0.8);
        solids.polyline(raw, stroke);
        keys.push(Key::line("path as searched", stroke));
    }
    keys.push(seen_through(solids, path.clone(), "returned path", Stroke::solid(VERMILLION, 1.5)));
    add_ends(solids, &path, 1.6);
    Ok(keys)
}

/// Adds the obstacles of the preprocessed object `of`, what the arm stands on, and with `frame` the edges of the domain; the
/// legend's entries.
fn add_obstacles(
    solids: &mut Solids,
    scene: &Scene<'_>,
    of: &Arc<InstanceKey>,
    frame: bool,
) -> Result<Vec<Key>, RenderError> {
    let blue = SKY.mixed(WHITE, 0.25);
    let stone = BLACK.mixed(WHITE, 0.55);
    let grey = BLACK.mixed(WHITE, 0.88);
    let mut keys = vec![cell_key("obstacle", blue)];
    let pedestal = scene.run.trace(of, "pedestal").map(|found| found.values[0] as usize);
    keys.extend(pedestal.map(|_| cell_key("pedestal", stone)));
    for (body, (vertices, faces)) in stored_bodies(scene, of)?.into_iter().enumerate() {
        let color = if pedestal == Some(body) { stone } else { blue };
        solids.polyhedron(vertices, faces, Paint::sheer(color, 0.82));
    }
    if let Some(floor) = scene.run.trace(of, "floor") {
        solids.sheet(points(floor), Paint::sheer(grey, 0.9));
        keys.push(cell_key("floor", grey));
    }
    if frame {
        let corners = points(ask::trace(scene, of, "domain")?);
        for edge in edges(corners[0], corners[1]) {
            solids.polyline(edge.to_vec(), Stroke::solid(BLACK.mixed(WHITE, 0.7), 0.4));
        }
    }
    Ok(keys)
}

/// A body's vertices, and its faces by the numbers of theirs.
type Body = (Vec<Vec3>, Vec<Vec<usize>>);

/// The bodies of the preprocessed object `of`.
fn stored_bodies(scene: &Scene<'_>, of: &Arc<InstanceKey>) -> Result<Vec<Body>, RenderError> {
    let vertices = points(ask::trace(scene, of, "bodies_vertices")?);
    let listed = ask::trace(scene, of, "bodies_faces")?;
    let mut faces: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for pair in listed.values.chunks(listed.width) {
        faces.entry(pair[0] as usize).or_default().push(pair[1] as usize);
    }
    Ok(bodies(&vertices, faces.into_values().collect()))
}

/// Faces that share vertices, taken together with vertices numbered from 0.
fn bodies(vertices: &[Vec3], faces: Vec<Vec<usize>>) -> Vec<Body> {
    let mut solids: Vec<(usize, usize, Vec<Vec<usize>>)> = Vec::new();
    for face in faces {
        let (low, high) = (face.iter().min().copied(), face.iter().max().copied());
        let (low, high) = (low.unwrap_or(0), high.unwrap_or(0));
        match solids.last_mut().filter(|solid| low <= solid.1) {
            Some(solid) => {
                (solid.0, solid.1) = (solid.0.min(low), solid.1.max(high));
                solid.2.push(face);
            }
            None => solids.push((low, high, vec![face])),
        }
    }
    let own = |(low, high, faces): (usize, usize, Vec<Vec<usize>>)| {
        let faces = faces.into_iter().map(|face| face.into_iter().map(|v| v - low).collect()).collect();
        (vertices[low..=high].to_vec(), faces)
    };
    solids.into_iter().map(own).collect()
}

/// The twelve edges of a box.
fn edges(low: Vec3, high: Vec3) -> Vec<[Vec3; 2]> {
    let corners = box_corners(low, high);
    let pairs = (0..8).flat_map(|index| (0..3).map(move |axis| [index, index | 1 << axis]));
    pairs.filter(|[from, to]| from != to).map(|ends| ends.map(|index| corners[index])).collect()
}
