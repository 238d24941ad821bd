//! Metrics along a sweep: one panel a metric, one line a contender.

use super::{Entry, Kind, Scene};
use crate::analysis::metric::{self, Metric};
use crate::render::RenderError;
use crate::render::chart::marks::Line;
use crate::render::chart::{Axis, Panel, Sheet};
use crate::render::style::{Width, series_marker, series_stroke};
use base::settings::{Accepted, none_called};
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "sweep_curves",
    about: "metrics along a sweep, one panel a metric, one line a contender, on a logarithmic scale",
    settings: Accepted::of::<Settings>(),
    example: r#"
problem = "C1"
contenders = ["Jia's A*, 728 neighbours"]
metrics = ["opened", "expansions"]
along = "delta_deg"
label = "Jia's step δ (°)"
"#,
    build: |settings, study, _paper| {
        let read: Settings = settings.read()?;
        super::check_labels(settings, study, &read.contenders, [&read.problem])?;
        let found = |name: &String| {
            metric::find(name).ok_or_else(|| {
                settings.error_about(
                    "",
                    &["metric", "length"],
                    name,
                    none_called("metric", name, metric::METRICS.iter().map(|m| m.name)),
                )
            })
        };
        let metrics = read.metrics.iter().map(found).collect::<Result<_, _>>()?;
        if !study.sweeps.iter().any(|sweep| sweep.key == read.along) {
            return Err(settings.error_at("along", format!("the study has no sweep over `{}`", read.along)));
        }
        Ok(Box::new(SweepCurves { settings: read, metrics }))
    },
};

/// Height of a panel's plot, in points.
const PLOT_PT: f64 = 165.0;

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The problem group.
    problem: String,
    /// One line each.
    contenders: Vec<String>,
    /// One panel each.
    metrics: Vec<String>,
    /// The setting that is swept.
    along: String,
    /// Its name on the axis.
    label: String,
}

struct SweepCurves {
    settings: Settings,
    metrics: Vec<&'static Metric>,
}

impl Kind for SweepCurves {
    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let note = "A trial that spent its budget shows what it spent.";
        let mut sheet = Sheet::new(Width::Double, self.metrics.len(), PLOT_PT).noted(note);
        for metric in &self.metrics {
            let curves: Vec<Vec<[f64; 2]>> =
                self.settings.contenders.iter().map(|label| self.curve(scene, label, metric)).collect();
            let all = || curves.iter().flatten();
            let (low, high) = all()
                .fold((f64::INFINITY, 0.0_f64), |(low, high), point| (low.min(point[1]), high.max(point[1])));
            if !(low > 0.0 && high.is_finite()) {
                return Err(RenderError::NotStored { what: format!("values of `{}`", metric.name) });
            }
            let x = Axis::over(self.settings.label.clone(), all().map(|point| point[0]));
            let y = Axis::log(metric.title(), low / 1.5, high * 1.5)?;
            let mut panel = Panel::new(metric.label, x, y);
            for (index, (curve, label)) in curves.into_iter().zip(&self.settings.contenders).enumerate() {
                let line = Line::through(curve, series_stroke(index)).marked(series_marker(index));
                panel.add(line.labelled(label.clone()));
            }
            sheet.add(panel);
        }
        Ok(sheet)
    }
}

impl SweepCurves {
    /// (value of the sweep, metric), in the sweep's order.
    fn curve(&self, scene: &Scene<'_>, contender: &str, metric: &Metric) -> Vec<[f64; 2]> {
        let rows = scene.run.rows(&self.settings.problem, contender);
        let points = rows.iter().filter_map(|row| {
            let along = row.key.sweep.value(&self.settings.along)?.as_f64()?;
            Some([along, scene.run.value(row, metric)?])
        });
        points.collect()
    }
}
