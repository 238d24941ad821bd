//! Which value of a sweep gives the printed shares, for several studies: what the printed numbers identify, and what not.

use super::{Entry, Kind, Scene, ask};
use crate::analysis::draws::solved_percents;
use crate::analysis::evidence::Run;
use crate::analysis::stats::bootstrap::{Plan, percentile};
use crate::render::RenderError;
use crate::render::chart::marks::{Band, Line};
use crate::render::chart::{Axis, Panel, Sheet};
use crate::render::style::{Dash, Fill, GREY, Stroke, Width, series_color, series_marker, series_stroke};
use crate::seed;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "identification",
    about: "shares of solved queries against a swept value, one curve a study, printed shares as lines",
    build: |settings, study, paper| {
        let read: Read = settings.read()?;
        ask::known(settings, study, &[], std::slice::from_ref(&read.contender))?;
        if let Some(missing) = read.studies.iter().find(|name| paper.study(name).is_none()) {
            return Err(settings.error(format!("there is no study `{missing}`")));
        }
        if read.printed.len() != read.others.len() {
            let message = format!(
                "printed has {} claims and others {} points; as many of either are accepted",
                read.printed.len(),
                read.others.len()
            );
            return Err(settings.error(message));
        }
        let printed = read.printed.iter().map(|id| ask::printed(settings, paper, id));
        let printed = printed.collect::<Result<_, _>>()?;
        Ok(Box::new(Identification { read, printed }))
    },
};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Read {
    contender: String,
    /// The sweep along the axis.
    sweep: String,
    axis: String,
    /// What the other sweeps are at: one panel each.
    others: Vec<String>,
    /// The claim printed for each panel.
    printed: Vec<String>,
    studies: Vec<String>,
}

struct Identification {
    read: Read,
    printed: Vec<f64>,
}

/// A point of a curve: the swept value, and the mean share with its interval.
type Point = [f64; 4];

impl Identification {
    fn curve(&self, run: &Run<'_>, other: &str) -> Vec<Point> {
        let prefix = format!("{}=", self.read.sweep);
        let Some(group) = run.study.groups.first() else { return Vec::new() };
        let mut points = Vec::new();
        for point in run.study.sweep_points() {
            let parts: Vec<&str> = point.name.split(',').collect();
            let value = parts.iter().find_map(|part| part.strip_prefix(&prefix)?.parse::<f64>().ok());
            let Some(value) = value.filter(|_| parts.contains(&other)) else { continue };
            let draws = solved_percents(run, &group.label, &self.read.contender, &point.name);
            let seed = seed::derive(0, &["identification", &run.study.name, &point.name]);
            let mean = |units: &[&f64]| {
                (!units.is_empty()).then(|| units.iter().copied().sum::<f64>() / units.len() as f64)
            };
            if let Some(found) = percentile(&draws, mean, Plan { resamples: 1000, level: 0.95, seed }) {
                points.push([value, found.value, found.interval.low, found.interval.high]);
            }
        }
        points
    }
}

impl Kind for Identification {
    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let mut sheet = Sheet::new(Width::Double, self.read.others.len(), 170.0);
        for (other, printed) in self.read.others.iter().zip(&self.printed) {
            let runs: Vec<&Run<'_>> =
                self.read.studies.iter().filter_map(|name| scene.evidence.run(name)).collect();
            let curves: Vec<Vec<Point>> = runs.iter().map(|run| self.curve(run, other)).collect();
            let x = Axis::over(&self.read.axis, curves.iter().flatten().map(|point| point[0]));
            let [low, high] = x.ends();
            let mut panel =
                Panel::new(other.replace('=', " = "), x, Axis::linear("groups solved (%)", -3.0, 103.0)?);
            let dashed = Stroke::solid(GREY, 0.9).dashed(Dash::Dashed);
            panel.add(Line::through(vec![[low, *printed], [high, *printed]], dashed).labelled("printed"));
            for (index, (run, curve)) in runs.iter().zip(&curves).enumerate() {
                let edges = curve.iter().map(|[x, _, low, high]| [*x, *low, *high]).collect();
                let fill = Fill::sheer(series_color(index), 0.18);
                panel.add(Band { edges, fill, label: String::new() });
                let line = Line::through(curve.iter().map(|p| [p[0], p[1]]).collect(), series_stroke(index));
                let label = run.study.groups.first().map_or("", |group| &group.label);
                panel.add(line.marked(series_marker(index)).labelled(label));
            }
            sheet.add(panel);
        }
        Ok(sheet)
    }
}
