//! Neighbourhoods of planners that move over a lattice: the region, and what was drawn from it.

use super::{Entry, Scene, Shown, World, ask};
use crate::render::RenderError;
use crate::render::chart::marks::{Line, Points};
use crate::render::chart::{Axis, Panel, Sheet, Trim};
use crate::render::style::{BLUE, GREY, Marker, Stroke, VERMILLION, WHITE, Width};
use base::settings::Accepted;
use engine::planner::Trace;
use schemars::JsonSchema;
use serde::Deserialize;
use study::record::Row;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "neighbourhoods",
    about: "the neighbours of a lattice point, one panel a contender; those that were drawn, where some are",
    statistic: "One instance of each.",
    settings: Accepted::shape::<Neighbourhoods>(),
    example: r#"
problem = "case 1"
contenders = ["A* 8"]
"#,
    build: |settings, _study, _paper| Ok(Box::new(settings.read::<Neighbourhoods>()?)),
};

/// Height of a panel's plot, in points.
const PLOT_PT: f64 = 120.0;

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Neighbourhoods {
    /// The problem group whose first trials hold the neighbourhoods.
    problem: String,
    /// One panel each.
    contenders: Vec<String>,
    /// The distance from the node to the corners of a regular octagon, on the axes, that is drawn in each panel.
    octagon_radius: Option<f64>,
}

impl World for Neighbourhoods {
    fn shown(&self) -> Vec<Shown<'_>> {
        vec![Shown::first(&self.problem, &self.contenders)]
    }

    fn sheet(&self, _scene: &Scene<'_>, count: usize) -> Sheet {
        let width = if count == 1 { Width::Single } else { Width::Double };
        Sheet::new(width, count.min(4), PLOT_PT)
    }

    fn panels(&self, scene: &Scene<'_>, shown: &Shown<'_>, _place: usize) -> Result<Vec<Panel>, RenderError> {
        let panels = shown.trials(scene)?.into_iter().map(|row| {
            let drawn = scene.run.trace(&row.key, "drawn");
            let mut panel = panel(row, ask::trace(scene, &row.key, "region")?, drawn)?;
            if let Some(radius) = self.octagon_radius {
                panel.add(octagon(radius).labelled("octagon"));
            }
            Ok(panel)
        });
        panels.collect()
    }
}

/// A regular octagon with corners on the axes.
fn octagon(radius: f64) -> Line {
    let corner = |k: u32| {
        let (s, c) = libm::sincos(std::f64::consts::FRAC_PI_4 * f64::from(k));
        [radius * c, radius * s]
    };
    Line::through((0..=8).map(corner).collect(), Stroke::solid(VERMILLION, 0.8))
}

fn panel(row: &Row, region: &Trace, drawn: Option<&Trace>) -> Result<Panel, RenderError> {
    let reach = region.values.iter().copied().fold(1.0, f64::max) + 0.6;
    let axis = |label: &str| Axis::linear(label, -reach, reach).map(Axis::whole);
    let tried = ask::points(drawn.unwrap_or(region));
    let all = ask::points(region);
    let title = format!("{}: {} of {}", row.key.contender, tried.len(), all.len());
    let mut panel =
        Panel::new(title, axis("x (steps)")?, axis("y (steps)")?).trimmed(Trim::Grid).with_equal_scales();
    for &step in &tried {
        panel.add(Line::through(vec![[0.0, 0.0], step], Stroke::solid(BLUE.mixed(WHITE, 0.5), 0.6)));
    }
    let mut points = |points: Vec<[f64; 2]>, color, radius_pt, label: &str| {
        panel.add(Points::unlabelled(points, Marker::Circle, radius_pt, color).labelled(label));
    };
    if drawn.is_some() {
        let left = all.into_iter().filter(|step| !tried.contains(step)).collect();
        points(left, GREY.mixed(WHITE, 0.5), 1.7, "not drawn");
    }
    points(tried, BLUE, 2.4, "neighbour");
    points(vec![[0.0, 0.0]], VERMILLION, 3.0, "current node");
    Ok(panel)
}
