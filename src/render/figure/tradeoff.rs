//! One metric against another, a point a contender: means over the same problems with intervals both ways.

use super::{Entry, Kind, Scene, check_labels};
use crate::analysis::effect::{mean, solved_by_all};
use crate::analysis::metric::{self, Metric};
use crate::render::RenderError;
use crate::render::chart::marks::{Line, Points};
use crate::render::chart::{Axis, Panel, Sheet};
use crate::render::style::{GREY, INK, SERIES, Stroke, Width, series_color, series_marker};
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "tradeoff",
    about: "one metric against another, a point a contender, with intervals both ways; one panel a list of problems",
    settings: Accepted::of::<Tradeoff>(),
    example: r#"
x = "opened"
y = "path_cost_cells"
contenders = ["A*", "Improved A*", "Bidirectional only", "Weight only", "Without bidirectional", "Without weight", "Without deletion", "Deletion only"]
panels = [
    { title = "simple", problems = ["simple cells", "simple rectangles", "simple bars"] },
    { title = "complex", problems = ["complex cells", "complex rectangles", "complex bars"] },
]
"#,
    build: |settings, study, _paper| {
        let read: Tradeoff = settings.read()?;
        check_labels(
            settings,
            study,
            &read.contenders,
            read.panels.iter().flat_map(|panel| &panel.problems),
        )?;
        for (key, name) in [("x", &read.x), ("y", &read.y)] {
            if !metric::find(name).is_some_and(|metric| study.columns().contains(metric.column)) {
                let message = format!("study `{}` does not produce the metric `{name}`", study.name);
                return Err(settings.error_at(key, message));
            }
        }
        Ok(Box::new(read))
    },
};

/// Height of a panel's plot, in points.
const PLOT_PT: f64 = 150.0;

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Tradeoff {
    /// The metric along the horizontal axis.
    x: String,
    /// The metric along the vertical axis.
    y: String,
    /// The contenders, by their labels.
    contenders: Vec<String>,
    /// The panels, in their order.
    panels: Vec<PanelSpec>,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct PanelSpec {
    /// What stands above it.
    title: String,
    /// The problem groups, by their labels.
    problems: Vec<String>,
}

impl Tradeoff {
    fn panel(&self, scene: &Scene<'_>, spec: &PanelSpec, [x, y]: [&Metric; 2]) -> Panel {
        let solved = solved_by_all(scene.run, &spec.problems, &self.contenders);
        let both = |contender: &String| {
            let of = |metric| mean(scene.run, &solved[contender], contender, metric);
            of(x).zip(of(y))
        };
        let points: Vec<_> = self.contenders.iter().map(both).collect();
        let maps = solved.values().next().map_or(0, Vec::len);
        let found = || points.iter().flatten();
        let across = found().flat_map(|(a, _)| [a.interval.low, a.interval.high]);
        let up = found().flat_map(|(_, b)| [b.interval.low, b.interval.high]);
        let title = format!("{}, {maps} maps", spec.title);
        let mut panel = Panel::new(&title, Axis::over(x.title(), across), Axis::over(y.title(), up));
        for (index, (contender, point)) in self.contenders.iter().zip(&points).enumerate() {
            let Some((a, b)) = point else { continue };
            let color = if index < SERIES.len() { series_color(index) } else { GREY.mixed(INK, 0.3) };
            let stroke = Stroke::solid(color, 0.9);
            let cross = vec![
                [a.interval.low, b.value],
                [a.interval.high, b.value],
                [f64::NAN, f64::NAN],
                [a.value, b.interval.low],
                [a.value, b.interval.high],
            ];
            panel.add(Line::through(cross, stroke));
            // One marker on for each round of the colours, so that no two are alike.
            let marker = series_marker(index + index / SERIES.len());
            let points = vec![[a.value, b.value]];
            panel.add(Points { points, marker, radius_pt: 3.0, color, label: contender.clone() });
        }
        panel
    }
}

impl Kind for Tradeoff {
    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let metrics = [&self.x, &self.y]
            .map(|name| metric::find(name).expect("the metric was found when the settings were read"));
        let mut sheet = Sheet::new(Width::Double, self.panels.len(), PLOT_PT);
        for panel in &self.panels {
            sheet.add(self.panel(scene, panel, metrics));
        }
        Ok(sheet.noted("Means over the maps that every contender solved, with 95 % bootstrap intervals of each mean over maps."))
    }
}
