//! One contender's saving over another along a column of the problem: every draw, and the mean of each value.

use super::{Entry, Kind, Scene};
use crate::analysis::metric::{self, Metric};
use crate::render::RenderError;
use crate::render::chart::marks::{Line, Points};
use crate::render::chart::{Axis, Panel, Sheet};
use crate::render::style::{GREY, Marker, Stroke, VERMILLION, WHITE, Width};
use crate::study::column;
use base::settings::{Accepted, none_called};
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "saving_over",
    about: "one contender's saving over another along a column of the problem, one panel a problem group",
    settings: Accepted::of::<Settings>(),
    example: r#"
problems = ["disjoint", "overlapping"]
metric = "opened"
contender = "Improved A*"
against = "A*"
over = "obstacles"
"#,
    build: |settings, study, _paper| {
        let read: Settings = settings.read()?;
        super::check_labels(settings, study, [&read.contender, &read.against], &read.problems)?;
        let metric = metric::find(&read.metric).ok_or_else(|| {
            settings.error_at(
                "metric",
                none_called("metric", &read.metric, metric::METRICS.iter().map(|m| m.name)),
            )
        })?;
        let column = column::find(&read.over)
            .ok_or_else(|| settings.error_at("over", format!("there is no column `{}`", read.over)))?;
        Ok(Box::new(SavingOver { settings: read, metric, about: column.about }))
    },
};

/// Height of a panel's plot, in points.
const PLOT_PT: f64 = 170.0;

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// One panel each.
    problems: Vec<String>,
    /// The metric: a name that `replan list metrics` gives, or one that a reading gives a meaning.
    metric: String,
    /// The contender, by its label.
    contender: String,
    /// The contender that it is held against, by its label.
    against: String,
    /// The column along which it is drawn.
    over: String,
}

struct SavingOver {
    settings: Settings,
    metric: &'static Metric,
    about: &'static str,
}

impl Kind for SavingOver {
    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let note = "Each dot is one environment; the line joins the means.";
        let mut sheet = Sheet::new(Width::Double, self.settings.problems.len(), PLOT_PT).noted(note);
        for group in &self.settings.problems {
            let points = self.points(scene, group);
            let label = format!("saving in {} (%)", self.metric.label.to_lowercase());
            let y = Axis::over(label, points.iter().map(|point| point[1]));
            let x = Axis::over(self.about, points.iter().map(|point| point[0]));
            let mut panel = Panel::new(format!("{group}: {}", self.settings.contender), x, y);
            let means = means(&points);
            panel.add(Points {
                points,
                marker: Marker::Circle,
                radius_pt: 1.1,
                color: GREY.mixed(WHITE, 0.35),
                label: "one environment".to_owned(),
            });
            panel.add(Line::through(means, Stroke::solid(VERMILLION, 1.5)).labelled("mean"));
            sheet.add(panel);
        }
        Ok(sheet)
    }
}

impl SavingOver {
    fn points(&self, scene: &Scene<'_>, group: &str) -> Vec<[f64; 2]> {
        let run = scene.run;
        let pairs = run.pairs(group, &self.settings.against, &self.settings.contender);
        let point = |pair: &crate::analysis::evidence::Pair<'_>| {
            let base = run.value(pair.base, self.metric).filter(|base| *base > 0.0)?;
            let other = run.value(pair.other, self.metric)?;
            Some([pair.base.value(&self.settings.over)?, 100.0 * (1.0 - other / base)])
        };
        pairs.iter().filter_map(point).collect()
    }
}

/// The mean of each value of x.
fn means(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut sums: BTreeMap<u64, (f64, f64, f64)> = BTreeMap::new();
    for [x, y] in points {
        let sum = sums.entry(x.to_bits()).or_insert((*x, 0.0, 0.0));
        (sum.1, sum.2) = (sum.1 + y, sum.2 + 1.0);
    }
    sums.into_values().map(|(x, sum, count)| [x, sum / count]).collect()
}
