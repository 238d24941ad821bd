//! A work cell from two sides: its robot at several poses, or the ways of its tool.

use super::{Entry, Scene, Shown, World, ask, noun};
use crate::render::RenderError;
use crate::render::chart::axis::bounds;
use crate::render::chart::legend::cell_key;
use crate::render::chart::{Panel, Sheet, axis};
use crate::render::latex::{Cell, Column, Table};
use crate::render::scene3::{Camera, Paint, Scene as Solids, panel};
use crate::render::style::{Dash, GREY, Rgb, Stroke, WHITE, Width, YELLOW, series_color};
use base::settings::{Accepted, Faults, Settings, SettingsError};
use engine::planner::Trace;

use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::sync::Arc;
use study::Study;
use study::key::InstanceKey;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "work_cell",
    about: "a work cell from two sides: its robot at several poses, or the ways of its tool by contenders on one query",
    statistic: "Single trials.",
    settings: Accepted::shape::<WorkCell>(),
    example: r#"
problems = "cell"
poses = [["4/start", "H"], ["1/start", "P1"], ["3/start", "P2"]]
at_once = 3
"#,
    build: |settings, study, _paper| {
        let read: WorkCell = settings.read()?;
        if read.poses.is_empty() == read.contenders.is_empty() {
            return Err(settings
                .error("either poses or contenders are accepted")
                .about("poses")
                .about("contenders"));
        }
        read.check_queries(settings, study)?;
        Ok(Box::new(read))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct WorkCell {
    /// The problem group, by its label.
    problems: String,
    /// Ends of queries, as `name/start` or `name/goal`, each with what it is called.
    #[serde(default)]
    poses: Vec<[String; 2]>,
    /// What the scene's boxes are called, in their order, beside the first poses; an empty name is not written.
    #[serde(default)]
    boxes: Vec<String>,
    /// How many poses are shown in one picture.
    #[serde(default = "one")]
    #[schemars(range(min = 1, max = 1000))]
    at_once: usize,
    /// Contenders whose ways on `query` are shown, on the kept instance whose saving is nearest to the median.
    #[serde(default)]
    contenders: Vec<String>,
    /// The query of the ways, by its name.
    #[serde(default)]
    query: String,
}

fn one() -> usize {
    1
}

/// From where cells are seen.
const VIEWS: [(&str, Camera); 2] = [
    ("from the front right", Camera::parallel(-42.0, 24.0)),
    ("from above left", Camera::parallel(35.0, 48.0)),
];

/// How far the floor reaches beyond what stands on it, millimetres.
const MARGIN_MM: f64 = 100.0;

/// The colour of obstacles.
const OBSTACLE: Rgb = YELLOW.mixed(GREY, 0.35).mixed(WHITE, 0.35);

/// The cell of an instance: floor and obstacles.
fn furnished(scene: &Scene<'_>, instance: &Arc<InstanceKey>) -> Result<Solids, RenderError> {
    let mut solids = Solids::default();
    let boxes = ask::trace(scene, instance, "boxes")?;
    let rounds = ask::trace(scene, instance, "rounds")?;
    if let Some(height) = floor_height(scene, instance) {
        let sheet = floor(scene, instance, [boxes, rounds], height);
        solids.sheet(sheet, Paint { outlined: true, ..Paint::solid(GREY.mixed(WHITE, 0.82)) });
    }
    for corners in boxes.values.chunks(boxes.width) {
        let corners = corners.chunks(3).map(|p| [p[0], p[1], p[2]]).collect();
        solids.cuboid(corners, Paint::solid(OBSTACLE));
    }
    add_capsules(&mut solids, rounds, Paint::solid(OBSTACLE));
    Ok(solids)
}

/// How high the floor is: at 0 unless the instance says otherwise; `None` if it says that there is none.
fn floor_height(scene: &Scene<'_>, instance: &Arc<InstanceKey>) -> Option<f64> {
    ask::trace(scene, instance, "floor").map_or(Some(0.0), |trace| trace.values.first().copied())
}

/// The floor below everything that stands in the cell, the robot at its queries' ends among it.
fn floor(scene: &Scene<'_>, instance: &Arc<InstanceKey>, stills: [&Trace; 2], height: f64) -> Vec<[f64; 3]> {
    let bodies = scene.run.traces(instance).filter(|trace| trace.name.starts_with("body "));
    let rows = stills.into_iter().chain(bodies).flat_map(|trace| trace.values.chunks(trace.width));
    let [low, high] = bounds(rows.flat_map(|row| {
        // A capsule's seventh number is its radius; a box has corners alone.
        let reach = if row.len() == 7 { row[6] } else { 0.0 };
        row.chunks_exact(3).flat_map(move |p| [-reach, reach].map(|by| [p[0] + by, p[1] + by]))
    }));
    let ([x0, y0], [x1, y1]) = (low.map(|x| x - MARGIN_MM), high.map(|x| x + MARGIN_MM));
    vec![[x0, y0, height], [x1, y0, height], [x1, y1, height], [x0, y1, height]]
}

/// The parts of `body` that are elsewhere than in `first`, by more than they are thick.
fn moved(body: &Trace, first: &Trace) -> Trace {
    let parts = body.values.chunks(body.width).zip(first.values.chunks(first.width));
    let apart_mm = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt();
    let stands = |(part, other): &(&[f64], &[f64])| {
        let ends = [apart_mm(&part[..3], &other[..3]), apart_mm(&part[3..6], &other[3..6])];
        ends.iter().all(|apart_mm| *apart_mm <= 2.0 * part[6])
    };
    let values = parts.filter(|pair| !stands(pair)).flat_map(|(part, _)| part.to_vec()).collect();
    Trace { values, ..body.clone() }
}

/// Adds capsules given by their ends and radius.
fn add_capsules(solids: &mut Solids, capsules: &Trace, paint: Paint) {
    for c in capsules.values.chunks(capsules.width) {
        solids.capsule([c[0], c[1], c[2]], [c[3], c[4], c[5]], c[6], paint);
    }
}

/// Of each query: its name, the mm between its straight line and what is nearest, and what that is; no number if it is blocked.
fn straight_lines<'a>(
    scene: &Scene<'a>,
    instance: &Arc<InstanceKey>,
) -> Vec<(&'a str, Option<f64>, &'a str)> {
    let line = |trace: &'a Trace| {
        let (query, near) = trace.name.strip_prefix("line ")?.split_once('/')?;
        Some((query, (trace.values[0] > 0.0).then_some(trace.values[1]), near))
    };
    scene.run.traces(instance).filter_map(line).collect()
}

/// Which straight lines are free, and how far from which obstacle.
fn heading(lines: &[(&str, Option<f64>, &str)]) -> String {
    let mut near: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    let mut blocked = Vec::new();
    for (query, mm, obstacle) in lines {
        match mm {
            Some(mm) => near.entry(obstacle).or_default().push(format!("{query} ({mm:.0} mm)")),
            None => blocked.push(*query),
        }
    }
    let mut heading = format!("{} of {} straight lines are free", lines.len() - blocked.len(), lines.len());
    for (obstacle, clear) in near {
        heading += &format!("; nearest to {obstacle}: {}", clear.join(", "));
    }
    if !blocked.is_empty() {
        heading += &format!("; blocked: {}", blocked.join(", "));
    }
    heading
}

/// A pose in words: joint angles, where flange and tip are, and where the tool points.
fn posed(pose: &Trace) -> [String; 4] {
    let axes = pose.width - 9;
    let numbers = |(from, to, decimals): (usize, usize, usize)| {
        let of = |value: &f64| axis::number(*value, decimals);
        pose.values[from..to].iter().map(of).collect::<Vec<_>>().join(", ")
    };
    [(0, axes, 0), (axes, axes + 3, 1), (axes + 3, axes + 6, 1), (axes + 6, axes + 9, 3)].map(numbers)
}

/// Length of the scale bar.
const BAR: (f64, &str) = (500.0, "mm");

impl WorkCell {
    /// Refuses poses and ways of queries that are not there.
    fn check_queries(&self, settings: &Settings, study: &Study) -> Result<(), SettingsError> {
        let mut faults = Faults::default();
        for (index, [pose, _]) in self.poses.iter().enumerate() {
            let end = pose.rsplit_once('/').filter(|(_, end)| ["start", "goal"].contains(end));
            let known = if let Some((query, _)) = end {
                ask::query(settings, study, &self.problems, query, ("poses", pose))
            } else {
                let message =
                    format!("`{pose}` is no end of a query; one is accepted, as in `1/start` or `1/goal`");
                Err(settings.error_at(&format!("poses.{index}.0"), message))
            };
            faults.keep(known);
        }
        if !self.contenders.is_empty() {
            faults.keep(ask::query(settings, study, &self.problems, &self.query, ("query", &self.query)));
        }
        faults.done()
    }

    /// The robot at its poses.
    fn poses(&self, scene: &Scene<'_>, instance: &Arc<InstanceKey>) -> Result<Vec<Panel>, RenderError> {
        let mut panels = Vec::new();
        let named: Vec<(usize, &[String; 2])> = self.poses.iter().enumerate().collect();
        for (row, shown) in named.chunks(self.at_once.max(1)).enumerate() {
            for (title, camera) in VIEWS {
                let mut solids = furnished(scene, instance)?;
                if row == 0 {
                    self.name_boxes(&mut solids, ask::trace(scene, instance, "boxes")?)?;
                }
                let mut keys = vec![cell_key("obstacles", OBSTACLE)];
                for (place, (index, [pose, name])) in shown.iter().enumerate() {
                    let color = series_color(*index).mixed(WHITE, 0.35);
                    let body = ask::trace(scene, instance, &format!("body {pose}"))?;
                    // What hardly moves from pose to pose is drawn once.
                    let first = ask::trace(scene, instance, &format!("body {}", shown[0].1[0]))?;
                    let parts = if place == 0 { body.clone() } else { moved(body, first) };
                    add_capsules(&mut solids, &parts, Paint { outlined: false, ..Paint::solid(color) });
                    if let Some(tip) = body.values.chunks(body.width).next_back() {
                        solids.tag([tip[3], tip[4], tip[5]], name);
                    }
                    keys.push(cell_key(format!("robot at {name}"), color));
                }
                panels.push(panel(title, solids, camera, BAR, keys));
            }
        }
        Ok(panels)
    }

    /// Writes the names of boxes across their middles.
    fn name_boxes(&self, solids: &mut Solids, boxes: &Trace) -> Result<(), RenderError> {
        let all = boxes.values.chunks(boxes.width);
        if self.boxes.len() > all.len() {
            let what =
                format!("a box for each of the {} names in `boxes`: it has {}", self.boxes.len(), all.len());
            return Err(RenderError::NotStored { what });
        }
        for (name, corners) in self.boxes.iter().zip(all).filter(|(name, _)| !name.is_empty()) {
            let count = corners.len() as f64 / 3.0;
            let middle = |axis: usize| corners.chunks(3).map(|corner| corner[axis]).sum::<f64>() / count;
            solids.write([0, 1, 2].map(middle), name);
        }
        Ok(())
    }

    /// The instance whose ways are shown.
    fn shared_instance(&self, scene: &Scene<'_>) -> Result<u32, RenderError> {
        let shared =
            |trace| ask::shared_instance(scene, &self.problems, &self.query, &self.contenders, trace);
        shared("trajectory").or_else(|_| shared("way_mm"))
    }

    /// What stands above all panels.
    fn title(&self, scene: &Scene<'_>) -> Option<String> {
        if !self.contenders.is_empty() {
            return self.rank(scene, self.shared_instance(scene).ok()?);
        }
        let lines = straight_lines(scene, ask::instance(scene, &self.problems, 0).ok()?);
        (!lines.is_empty()).then(|| heading(&lines))
    }

    fn way(&self, scene: &Scene<'_>, number: u32, index: usize, view: usize) -> Result<Panel, RenderError> {
        let instance = ask::instance(scene, &self.problems, number)?;
        let contender = &self.contenders[index];
        let (seen, camera) = VIEWS[view];
        let mut solids = furnished(scene, instance)?;
        let body = ask::trace(scene, instance, &format!("body {}/start", self.query))?;
        let pale = Paint { outlined: false, ..Paint::solid(GREY.mixed(WHITE, 0.45)) };
        add_capsules(&mut solids, body, pale);
        let row = ask::trial(scene, &self.problems, number, Some(&self.query), contender)?;
        let stops =
            ask::trace(scene, &row.key, "trajectory").or_else(|_| ask::trace(scene, &row.key, "way_mm"))?;
        // The tip is the last of the numbers of each stop.
        let tips = stops.values.chunks(stops.width).filter_map(|stop| stop.last_chunk().copied());
        let points: Vec<[f64; 3]> = tips.collect();
        let color = series_color(ask::series(scene, contender, index));
        for (name, at) in [("start", points.first()), ("goal", points.last())] {
            if let Some(at) = at {
                solids.tag(*at, name);
            }
        }
        solids.overlay(points.clone(), Stroke::solid(color, 0.7).dashed(Dash::Dotted));
        solids.polyline(points, Stroke::solid(color, 1.8));
        let title = if view == 0 {
            let [length, legs] = ["path_length_mm", "local_paths"].map(|column| ask::number(row, column, 0));
            format!("{contender}: {length} mm, {legs} local paths")
        } else {
            format!("the same {seen}")
        };
        Ok(panel(title, solids, camera, BAR, Vec::new()))
    }

    /// What the picked instance's saving is among those of all instances, in words.
    fn rank(&self, scene: &Scene<'_>, instance: u32) -> Option<String> {
        let savings = ask::savings(scene, &self.problems, &self.query, &self.contenders);
        let (own, rank) = savings.rank(instance)?;
        Some(format!(
            "saving {own:.1} %: {} of {} {} save less, the median saves {:.1} %",
            rank.below,
            rank.instances(),
            noun([scene.run.study]),
            savings.median?
        ))
    }
}

impl World for WorkCell {
    fn shown(&self) -> Vec<Shown<'_>> {
        vec![Shown::first(&self.problems, &self.contenders)]
    }

    fn sheet(&self, scene: &Scene<'_>, _count: usize) -> Sheet {
        let columns = if self.contenders.is_empty() { VIEWS.len() } else { self.contenders.len() };
        Sheet::new(Width::Double, columns, 200.0).titled(self.title(scene).unwrap_or_default())
    }

    fn panels(&self, scene: &Scene<'_>, shown: &Shown<'_>, _place: usize) -> Result<Vec<Panel>, RenderError> {
        if shown.contenders.is_empty() {
            return self.poses(scene, shown.instance(scene)?);
        }
        let number = self.shared_instance(scene)?;
        let all =
            (0..VIEWS.len()).flat_map(|view| (0..shown.contenders.len()).map(move |index| (view, index)));
        all.map(|(view, index)| self.way(scene, number, index, view)).collect()
    }

    fn table(&self, scene: &Scene<'_>, label: &str, caption: &str) -> Result<Option<Table>, RenderError> {
        if self.poses.is_empty() {
            return Ok(None);
        }
        let instance = ask::instance(scene, &self.problems, 0)?;
        let kinds = [vec![Column::Left; 2], vec![Column::Right; 5]].concat();
        let mut table = Table::new(label, caption, &kinds);
        let heads =
            ["group", "", "joint angles (°)", "flange (mm)", "tip (mm)", "direction", "straight line"];
        table.head(heads.map(Cell::from).to_vec());
        let lines = straight_lines(scene, instance);
        for trace in scene.run.traces(instance) {
            let Some((group, end)) = trace.name.strip_prefix("pose ").and_then(|name| name.rsplit_once('/'))
            else {
                continue;
            };
            let group = if end == "start" { group } else { "" };
            let line = lines.iter().find(|line| line.0 == group).map_or_else(String::new, |(_, mm, near)| {
                mm.map_or_else(|| "blocked".to_owned(), |mm| format!("free, {mm:.1} mm from {near}"))
            });
            let row = [group.to_owned(), end.to_owned()].into_iter().chain(posed(trace)).chain([line]);
            table.row(row.map(Cell::from).collect());
        }
        Ok(Some(table))
    }
}
