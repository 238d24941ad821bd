//! A particle's searches on one roadmap in the plane: the first searches of each contender, one panel each.

use super::{Entry, Scene, Shown, World, ask};
use crate::render::RenderError;
use crate::render::chart::marks::{Behind, Line, Note, Points, Shape};
use crate::render::chart::{Axis, Panel, Sheet, Trim};
use crate::render::style::{
    BLACK, BLUE, Dash, Fill, GREEN, GREY, Marker, ORANGE, SKY, Stroke, VERMILLION, WHITE, Width,
};
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use std::sync::Arc;
use study::key::InstanceKey;
use study::record::Row;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "plane_search",
    about: "a particle's searches on one roadmap in the plane: nodes closed so far, shots at the goal, paths",
    statistic: "Single trials.",
    settings: Accepted::shape::<PlaneSearch>(),
    example: r#"
problems = "plane"
instance = 13
radius_mm = 220
panels = [{ contender = "Original A*", title = "", bare = true }]
"#,
    build: |settings, _study, _paper| Ok(Box::new(settings.read::<PlaneSearch>()?)),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct PlaneSearch {
    /// The problem group, by its label.
    problems: String,
    /// Which instance of the group.
    instance: u32,
    /// The radius of a neighbourhood.
    radius_mm: f64,
    /// The panels, in their order.
    panels: Vec<SearchPanel>,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct SearchPanel {
    /// The contender, by its label.
    contender: String,
    /// What stands above it.
    title: String,
    /// How many searches are shown; all and the path if absent.
    searches: Option<usize>,
    /// Whether each search shoots at the goal first.
    #[serde(default)]
    shoots: bool,
    /// Whether the path before it was straightened is shown, and how many nodes of the straightened one.
    #[serde(default)]
    straightened: Option<usize>,
    /// Whether there is nothing to see but the map.
    #[serde(default)]
    bare: bool,
}

impl World for PlaneSearch {
    fn shown(&self) -> Vec<Shown<'_>> {
        let contenders = self.panels.iter().map(|panel| std::slice::from_ref(&panel.contender));
        let (problems, instance) = (&self.problems, self.instance);
        contenders.map(|contenders| Shown { problems, contenders, instance }).collect()
    }

    fn sheet(&self, _scene: &Scene<'_>, count: usize) -> Sheet {
        Sheet::new(Width::Double, count.min(2), 200.0)
    }

    fn panels(&self, scene: &Scene<'_>, shown: &Shown<'_>, place: usize) -> Result<Vec<Panel>, RenderError> {
        let setting = &self.panels[place];
        let map = shown.instance(scene)?;
        let panel = |row: &Row| {
            let mut panel = plane(scene, map, &setting.title)?;
            let path = ask::points(ask::trace(scene, &row.key, "path")?);
            let search = Search { scene, row, path: &path, setting, radius_mm: self.radius_mm };
            // Obstacles are drawn over samples and ways: no mark of what is free covers a wall.
            if !setting.bare {
                search.add_ways(&mut panel)?;
            }
            add_obstacles(&mut panel, scene, map)?;
            if !setting.bare {
                match setting.straightened {
                    Some(kept) => search.add_straightened(&mut panel, kept)?,
                    None => search.add_searches(&mut panel)?,
                }
            }
            ask::add_ends(&mut panel, &path, 3.4, [(Marker::Square, GREEN), (Marker::Square, ORANGE)]);
            Ok(panel)
        };
        shown.trials(scene)?.into_iter().map(panel).collect()
    }
}

/// The plane with the samples of its roadmap.
fn plane(scene: &Scene<'_>, map: &Arc<InstanceKey>, title: &str) -> Result<Panel, RenderError> {
    let size = ask::trace(scene, map, "size_mm")?;
    let x = Axis::linear("x (mm)", 0.0, size.values[0])?;
    let mut panel = Panel::new(title, x, Axis::linear("y (mm)", 0.0, size.values[1])?)
        .trimmed(Trim::Frame)
        .with_equal_scales();
    let samples = ask::points(ask::trace(scene, map, "samples")?);
    let samples = Points::unlabelled(samples, Marker::Circle, 1.2, GREY.mixed(WHITE, 0.35));
    panel.add(Behind(samples.labelled("sample")));
    Ok(panel)
}

fn add_obstacles(panel: &mut Panel, scene: &Scene<'_>, map: &Arc<InstanceKey>) -> Result<(), RenderError> {
    let numbered: Vec<[f64; 3]> = ask::points(ask::trace(scene, map, "obstacles")?);
    for obstacle in numbered.chunk_by(|a, b| a[0] == b[0]) {
        let fill = Some(Fill::solid(BLUE.mixed(WHITE, 0.45)));
        let corners = obstacle.iter().map(|c| [c[1], c[2]]).collect();
        panel.add(Shape { corners, fill, stroke: None, label: "obstacle".to_owned() });
    }
    Ok(())
}

/// One trial with what a panel shows of it.
struct Search<'a> {
    scene: &'a Scene<'a>,
    row: &'a Row,
    path: &'a [[f64; 2]],
    setting: &'a SearchPanel,
    radius_mm: f64,
}

impl Search<'_> {
    fn trace(&self, name: &str) -> Result<Vec<[f64; 2]>, RenderError> {
        ask::trace(self.scene, &self.row.key, name).map(ask::points)
    }

    /// Adds the way that is shown: the path, or how far the search has come.
    fn add_ways(&self, panel: &mut Panel) -> Result<(), RenderError> {
        if let Some(kept) = self.setting.straightened {
            let stroke = Stroke::solid(GREY, 1.0).dashed(if kept > 0 { Dash::Dashed } else { Dash::Solid });
            panel.add(Line::through(self.trace("raw_path")?, stroke).labelled("path as searched"));
            if kept > 0 {
                let shown = self.path[..kept.min(self.path.len())].to_vec();
                panel.add(Line::through(shown, Stroke::solid(BLACK, 1.5)).labelled("straightened"));
            }
            return Ok(());
        }
        let closed = self.trace("closed")?;
        let (points, width, label) = match self.setting.searches {
            None => (self.path.to_vec(), 1.5, "path"),
            Some(shown) => (closed[..(shown + 1).min(closed.len())].to_vec(), 1.2, "way so far"),
        };
        panel.add(Line::through(points, Stroke::solid(BLACK, width)).labelled(label));
        Ok(())
    }

    fn add_searches(&self, panel: &mut Panel) -> Result<(), RenderError> {
        let closed = self.trace("closed")?;
        let all = self.setting.searches.is_none();
        let shown = self.setting.searches.unwrap_or(closed.len()).min(closed.len());
        let Some(goal) = self.path.last() else { return Ok(()) };
        let dotted = Stroke::solid(BLACK, 0.8).dashed(Dash::Dotted);
        let missed = if all { shown.saturating_sub(1) } else { shown };
        for at in closed.iter().take(if self.setting.shoots { missed } else { 0 }) {
            panel.add(Line::through(vec![*at, *goal], dotted).labelled("local path to the goal, not free"));
        }
        if !all && let Some(at) = closed.get(shown.saturating_sub(1)) {
            panel.add(circle(*at, self.radius_mm));
        }
        let until = if all { closed.len() } else { (shown + 1).min(closed.len()) };
        let picked = closed[1..until].to_vec();
        for (number, at) in picked.iter().enumerate() {
            // On the right runs what is tried towards the goal.
            let note = if goal[0] > at[0] { Note::below_left } else { Note::beside };
            panel.add(note(*at, (number + 1).to_string()));
        }
        panel.add(Points::unlabelled(picked, Marker::Circle, 2.6, SKY).labelled("searched"));
        Ok(())
    }

    /// Adds the nodes of the path before straightening, and the first `kept` of the straightened one.
    fn add_straightened(&self, panel: &mut Panel, kept: usize) -> Result<(), RenderError> {
        let raw = self.trace("raw_path")?;
        let shown = self.path[..kept.min(self.path.len())].to_vec();
        let reached = shown.last().and_then(|last| raw.iter().position(|at| at == last)).unwrap_or(0);
        let inner = raw.iter().enumerate().skip(1).take(raw.len() - 2);
        let (gone, open): (Vec<_>, Vec<_>) = inner.partition(|(index, _)| *index < reached);
        let places =
            |nodes: Vec<(usize, &[f64; 2])>| nodes.into_iter().map(|(_, at)| *at).collect::<Vec<_>>();
        // A legend names no mark that is nowhere.
        let mut mark = |places: Vec<[f64; 2]>, marker, radius, colour, label: &str| {
            if !places.is_empty() {
                panel.add(Points::unlabelled(places, marker, radius, colour).labelled(label));
            }
        };
        mark(places(open), Marker::Circle, 2.4, SKY, "searched");
        mark(places(gone), Marker::Circle, 2.4, GREY.mixed(BLACK, 0.5), "abandoned");
        mark(shown, Marker::Diamond, 2.8, VERMILLION, "retained");
        Ok(())
    }
}

fn circle(middle: [f64; 2], radius: f64) -> Line {
    let point = |step: i32| {
        let (s, c) = libm::sincos(std::f64::consts::TAU * f64::from(step) / 72.0);
        [middle[0] + radius * c, middle[1] + radius * s]
    };
    let stroke = Stroke::solid(VERMILLION, 0.8).dashed(Dash::Dashed);
    Line::through((0..=72).map(point).collect(), stroke).labelled("neighbourhood of the current node")
}
