//! The progress of planners over time: the median cost of the best path so far, over all queries of all instances.

use super::{CurveLine, Curves, Entry, Kind, Scene, Shown, ask};
use crate::analysis::metric::Metric;
use crate::analysis::shown::{CostHistory, best_over_time};
use crate::analysis::statistic::Estimate;
use crate::render::RenderError;
use crate::render::chart::marks::{Band, Line};
use crate::render::chart::{Axis, Panel, Sheet};
use crate::render::style::{Fill, Width, series_color, series_stroke};
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use study::record::Row;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "cost_over_time",
    about: "cost of the best path found so far by planners from outside, over time: medians with intervals, failures infinite",
    statistic: "Medians over queries with 95 % bootstrap intervals over instances. No path costs infinitely much; {n}.",
    settings: Accepted::shape::<Read>(),
    example: r#"
problems = "cell"
contenders = ["RRT*", "BIT*"]
metric = "path_length_mm"
until_s = 1.0
"#,
    build: |settings, study, _paper| {
        let read: Read = settings.read()?;
        ask::known(settings, study, [&read.problems], &read.contenders)?;
        let metric = ask::produced(settings, study, &read.metric)?;
        let group = study.groups.iter().find(|group| group.label == read.problems);
        Ok(Box::new(CostOverTime { instances: group.map_or(0, |group| group.instances), read, metric }))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Read {
    /// The problem group, by its label.
    problems: String,
    /// The planners from outside, by their labels.
    contenders: Vec<String>,
    /// The metric that is the cost of the path returned, in the unit of incumbents.
    metric: String,
    /// The last moment, in seconds.
    #[schemars(range(min = 0.01, max = 3600.0))]
    until_s: f64,
}

struct CostOverTime {
    read: Read,
    metric: &'static Metric,
    instances: u32,
}

/// How many moments a curve has.
const MOMENTS: u32 = 50;
/// Nanoseconds in a second.
const NS_PER_S: f64 = 1e9;

impl CostOverTime {
    fn moments(&self) -> Vec<f64> {
        (1..=MOMENTS).map(|k| self.read.until_s * f64::from(k) / f64::from(MOMENTS)).collect()
    }

    /// When a trial found what: its incumbents, and the path that it returned.
    fn found(&self, scene: &Scene<'_>, row: &Row) -> CostHistory {
        let kept = scene.run.trace(&row.key, "incumbents").filter(|kept| kept.width == 2);
        let mut found: CostHistory = kept.map(ask::points).unwrap_or_default();
        let returned = row.value("solve_wall_ns").zip(scene.run.value(row, self.metric));
        found.extend(returned.filter(|_| row.is_solved()).map(|(ns, cost)| [ns / NS_PER_S, cost]));
        found
    }

    /// What each query of each instance found.
    fn instances(&self, scene: &Scene<'_>, contender: &str) -> Vec<Vec<CostHistory>> {
        let rows = scene.run.rows(&self.read.problems, contender);
        let of_instance = |rows: &[&Row]| rows.iter().map(|row| self.found(scene, row)).collect();
        rows.chunk_by(|a, b| a.key.on == b.key.on).map(of_instance).collect()
    }

    fn all(&self, scene: &Scene<'_>) -> Vec<(&String, Vec<Option<Estimate>>)> {
        let moments = self.moments();
        let of = |contender| {
            let names = [scene.run.study.name.as_str(), "cost over time", contender];
            best_over_time(&self.instances(scene, contender), &moments, &names)
        };
        self.read.contenders.iter().map(|contender| (contender, of(contender))).collect()
    }
}

/// What stands below the figure: what an open interval looks like, and who has no curve.
fn note(until_s: f64, all: &[(&String, Vec<Option<Estimate>>)]) -> String {
    let has_none = |medians: &[Option<Estimate>]| medians.iter().all(Option::is_none);
    let without: Vec<&str> =
        all.iter().filter(|(_, medians)| has_none(medians)).map(|(label, _)| label.as_str()).collect();
    let open = "An interval that has no upper end goes to the top.";
    match without.as_slice() {
        [] => open.to_owned(),
        _ => format!("{open} No path for half of the queries within {until_s} s: {}.", without.join(", ")),
    }
}

impl Kind for CostOverTime {
    fn shown(&self) -> Vec<Shown<'_>> {
        let of = |contender| {
            let problems = self.read.problems.as_str();
            (0..self.instances).map(move |instance| Shown { problems, contender: Some(contender), instance })
        };
        self.read.contenders.iter().flat_map(|contender| of(contender.as_str())).collect()
    }

    fn curves(&self, scene: &Scene<'_>, caption: &str) -> Option<Curves> {
        let line = |(of, (contender, medians)): (usize, (&String, Vec<Option<Estimate>>))| CurveLine {
            label: contender.clone(),
            of,
            values: medians.iter().map(|median| median.as_ref().map(|median| median.value)).collect(),
            band: None,
            is_printed: false,
        };
        Some(Curves {
            title: caption.to_owned(),
            axis: "time (s)".to_owned(),
            value: self.metric.title(),
            at: self.moments(),
            lines: self.all(scene).into_iter().enumerate().map(line).collect(),
        })
    }

    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let moments = self.moments();
        let all = self.all(scene);
        let found = || all.iter().flat_map(|(_, medians)| medians).flatten();
        let ends = found().flat_map(|median| [median.interval.low, median.interval.high]);
        let ends: Vec<f64> = ends.filter(|end| end.is_finite()).collect();
        let top = ends.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let x = Axis::linear("time (s)", 0.0, self.read.until_s)?;
        let mut panel = Panel::new("", x, Axis::over(self.metric.title(), ends));
        for (place, (contender, medians)) in all.iter().enumerate() {
            let index = ask::series(scene, contender, place);
            let both = || moments.iter().zip(medians).filter_map(|(x, median)| Some((*x, (*median)?)));
            let edges = both().map(|(x, m)| [x, m.interval.low.min(top), m.interval.high.min(top)]).collect();
            panel.add(Band { edges, fill: Fill::sheer(series_color(index), 0.2), label: String::new() });
            let points: Vec<[f64; 2]> = both().map(|(x, m)| [x, m.value]).collect();
            panel.add(Line::through(points, series_stroke(index)).labelled((*contender).clone()));
        }
        Sheet::new(Width::Double, 1, 190.0).noted(note(self.read.until_s, &all)).with([Ok(panel)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn who_finds_no_path_for_half_of_the_queries_is_named_below_the_figure() {
        let (fast, slow) = ("BIT*".to_owned(), "RRT*".to_owned());
        let instances: Vec<_> = [0.1, 0.2, 0.3].map(|at| vec![vec![[at, 10.0]]]).into();
        let by = |moment: f64| best_over_time(&instances, &[moment], &["a test"]);
        let all = [(&fast, by(0.5)), (&slow, by(0.05))];
        let title = note(0.5, &all);
        assert!(title.ends_with("No path for half of the queries within 0.5 s: RRT*."), "{title}");
        assert!(!note(0.5, &all[..1]).contains("No path"), "everyone has a curve");
    }
}
