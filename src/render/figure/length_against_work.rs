//! Path length against work: every seed of every contender, one panel a problem.

use super::{Entry, Kind, Scene, ask};
use crate::analysis::metric::{self, Metric};
use crate::render::RenderError;
use crate::render::chart::marks::Points;
use crate::render::chart::{Axis, Panel, Sheet};
use crate::render::style::{BLACK, SERIES, WHITE, Width, series_color, series_marker};
use crate::study::record::{Row, Status};
use base::settings::{Accepted, none_called};
use schemars::JsonSchema;
use serde::Deserialize;
use stats::summary::median;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "length_against_work",
    about: "path length against work: every seed as a point, medians (failures infinite) as markers",
    settings: Accepted::of::<LengthAgainstWork>(),
    example: r#"
metric = "expansions"
length = "path_length_cm"
problems = ["case 1", "case 2"]
contenders = ["A* 8", "Modified 24", "Modified 48", "Modified 80", "CHS r=2", "CHS r=3", "CHS r=4", "CHS r=5", "CHS r=6", "Chaos 5/8", "Chaos 12/24", "Chaos 23/48", "Chaos 34/80", "Chaos 23/48 octagon"]
"#,
    build: |settings, study, _paper| {
        let read: LengthAgainstWork = settings.read()?;
        ask::known(settings, study, &read.problems, &read.contenders)?;
        let find = |name: &str| {
            metric::find(name).ok_or_else(|| {
                settings.error_about(
                    "",
                    &["metric", "length"],
                    name,
                    none_called("metric", name, metric::METRICS.iter().map(|m| m.name)),
                )
            })
        };
        let (work, length) = (find(&read.metric)?, find(&read.length)?);
        Ok(Box::new(Ready { read, work, length }))
    },
};

/// Height of a panel's plot, in points.
const PLOT_PT: f64 = 190.0;

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct LengthAgainstWork {
    /// The metric of work.
    metric: String,
    /// The metric of length.
    length: String,
    /// One panel each.
    problems: Vec<String>,
    /// Who is shown.
    contenders: Vec<String>,
}

struct Ready {
    read: LengthAgainstWork,
    work: &'static Metric,
    length: &'static Metric,
}

impl Kind for Ready {
    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let mut sheet = Sheet::new(Width::Double, self.read.problems.len(), PLOT_PT);
        for problem in &self.read.problems {
            sheet.add(self.panel(scene, problem)?);
        }
        Ok(sheet)
    }
}

impl Ready {
    fn panel(&self, scene: &Scene<'_>, problem: &str) -> Result<Panel, RenderError> {
        let both = |row: &&Row| {
            let solved = row.status == Status::Solved;
            let value = |metric| if solved { scene.run.value(row, metric) } else { Some(f64::INFINITY) };
            Some([value(self.work)?, value(self.length)?])
        };
        let series: Vec<(&String, Vec<[f64; 2]>)> = self
            .read
            .contenders
            .iter()
            .map(|label| (label, scene.run.rows(problem, label).iter().filter_map(both).collect()))
            .collect();
        let shown = |axis: usize| {
            let values = series.iter().flat_map(|(_, points)| points).map(move |point| point[axis]);
            values.filter(|value| value.is_finite()).collect::<Vec<f64>>()
        };
        let (works, lengths) = (shown(0), shown(1));
        let low = works.iter().copied().fold(f64::INFINITY, f64::min).max(1.0);
        let high = works.iter().copied().fold(low, f64::max);
        let x = Axis::log(self.work.title(), low / 1.3, high * 1.3)?;
        let mut panel = Panel::new(title(problem, &series), x, Axis::over(self.length.title(), lengths));
        for (label, all) in series.iter().filter(|(_, all)| all.len() > 1) {
            panel.add(points(all.clone(), 0.9, ask::place(scene, label), 0.45, String::new()));
        }
        for (label, all) in &series {
            let middle = [0, 1].map(|axis| median(&all.iter().map(|point| point[axis]).collect::<Vec<_>>()));
            let at = middle[0].zip(middle[1]).map(|(x, y)| [x, y]);
            panel.add(points(at.into_iter().collect(), 3.6, ask::place(scene, label), 0.0, (*label).clone()));
        }
        Ok(panel)
    }
}

/// The problem with who fails on it: failures are at infinity and show nowhere else.
fn title(problem: &str, series: &[(&String, Vec<[f64; 2]>)]) -> String {
    let failed = |all: &[[f64; 2]]| all.iter().filter(|point| point[1].is_infinite()).count();
    let said = series.iter().filter(|(_, all)| failed(all) > 0);
    let said: Vec<String> =
        said.map(|(label, all)| format!("{label} fails in {} of {}", failed(all), all.len())).collect();
    if said.is_empty() { problem.to_owned() } else { format!("{problem}; {}", said.join(", ")) }
}

/// Points of the contender at place `index`: colours come round after seven, darker, and the marker moves on by one.
fn points(points: Vec<[f64; 2]>, radius_pt: f64, index: usize, pale: f64, label: String) -> Points {
    let round = index / SERIES.len();
    let color = series_color(index).mixed(BLACK, if round == 0 { 0.0 } else { 0.4 });
    Points { points, marker: series_marker(index + round), radius_pt, color: color.mixed(WHITE, pale), label }
}
