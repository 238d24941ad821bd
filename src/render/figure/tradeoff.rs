//! One metric against another, a point a contender: means over the same problems with intervals both ways, or every trial
//! with the medians.

use super::{Entry, Kind, Scene, ask, noun};
use crate::analysis::metric::Metric;
use crate::analysis::selection::Selection;
use crate::analysis::shown::{means_of_whole_instances, median_point, of_all};
use crate::analysis::statistic::{Estimate, Interval, OverallStatistic};
use crate::render::RenderError;
use crate::render::chart::labels::Labels;
use crate::render::chart::marks::{Line, Points};
use crate::render::chart::{Axis, Panel, Sheet};
use crate::render::effect::less_than;
use crate::render::style::{BLACK, Marker, SERIES, Stroke, WHITE, Width, series_color, series_marker};
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeSet;
use study::record::Row;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "tradeoff",
    about: "one metric against another, a point a contender: means with intervals both ways, or all trials and their medians",
    statistic: "Means over instances that every contender solves; {n}.",
    settings: Accepted::shape::<Tradeoff>(),
    example: r#"
x = "opened"
y = "path_cost_cells"
contenders = ["A*", "Improved A*"]
panels = [{ title = "simple", problems = ["simple cells", "simple rectangles", "simple bars"] }]
"#,
    build: |settings, study, _paper| {
        let read: Tradeoff = settings.read()?;
        let problems = read.panels.iter().flat_map(|panel| &panel.problems);
        let contenders: Vec<String> = read.contenders.iter().chain(&read.against).cloned().collect();
        ask::known(settings, study, problems, &contenders)?;
        let metrics = [ask::produced(settings, study, &read.x)?, ask::produced(settings, study, &read.y)?];
        Ok(Box::new(Ready { read, metrics }))
    },
};

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
    /// How much less, in per cent, both metrics are than with this contender, paired over the problems that both solve, in place of means.
    /// Intervals of means hold what differs from problem to problem, which is no matter between contenders.
    against: Option<String>,
    /// Every trial as a point and medians, failures infinite, on a logarithmic axis, in place of means.
    #[serde(default)]
    trials: bool,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct PanelSpec {
    /// What stands above it.
    title: String,
    /// The problem groups, by their labels.
    problems: Vec<String>,
}

struct Ready {
    read: Tradeoff,
    metrics: [&'static Metric; 2],
}

impl Ready {
    /// Means over the instances that every contender solved.
    fn means(&self, scene: &Scene<'_>, spec: &PanelSpec) -> Panel {
        let [(x, instances), (y, _)] = self.metrics.map(|metric| {
            let all = Selection::all(scene.run.study, &spec.problems, &self.read.contenders);
            let whole = Selection { metric: Some(metric), whole_instances: true, ..all };
            means_of_whole_instances(&whole, scene.evidence)
        });
        let points: Vec<_> = x.into_iter().zip(y).map(|(x, y)| x.zip(y)).collect();
        let ends = |axis: usize| {
            let of = move |(a, b): &(Estimate, Estimate)| [a.interval, b.interval][axis];
            points.iter().flatten().map(of).flat_map(|interval| [interval.low, interval.high])
        };
        let title = format!("{}, {instances} {}", spec.title, noun([scene.run.study]));
        let [x, y] = [0, 1].map(|axis| Axis::over(self.metrics[axis].title(), ends(axis)));
        let mut panel = Panel::new(title, x, y);
        for (contender, point) in self.read.contenders.iter().zip(&points) {
            let Some((a, b)) = point else { continue };
            let index = ask::place(scene, contender);
            let point = marked(vec![[a.value, b.value]], 3.0, index, 0.0);
            panel.add(Line::through(
                cross([a.value, b.value], [a.interval, b.interval]),
                Stroke::solid(point.color, 0.9),
            ));
            panel.add(point.labelled(contender));
        }
        panel
    }

    /// How much less one metric is with a contender than with another, in per cent.
    fn reduction(
        &self,
        scene: &Scene<'_>,
        spec: &PanelSpec,
        [label, base]: [&String; 2],
        axis: usize,
    ) -> Option<Estimate> {
        let metric = self.metrics[axis];
        let all = Selection::all(scene.run.study, &spec.problems, std::slice::from_ref(label));
        let of = Selection { metric: Some(metric), against: Some(base.clone()), ..all };
        let names = [scene.run.study.name.as_str(), label, base, metric.name];
        of_all(OverallStatistic::ReductionPercent, &of, scene.evidence, &names)
    }

    /// How much less each contender takes than `base`, which stands at zero.
    fn reductions(&self, scene: &Scene<'_>, spec: &PanelSpec, base: &String) -> Panel {
        let others = self.read.contenders.iter().filter(|label| *label != base);
        let both = |label: &String| {
            let [x, y] = [0, 1].map(|axis| self.reduction(scene, spec, [label, base], axis));
            Some((label.clone(), x?, y?))
        };
        let points: Vec<(String, Estimate, Estimate)> = others.filter_map(both).collect();
        let ends = |axis: usize| {
            let of = move |(_, a, b): &(String, Estimate, Estimate)| ask::bar([a, b][axis]);
            points.iter().map(of).flat_map(|interval| [interval.low, interval.high]).chain([0.0])
        };
        let [x, y] = [0, 1].map(|axis| Axis::over(less_than(self.metrics[axis], base), ends(axis)));
        let units: BTreeSet<usize> = points.iter().map(|(_, a, _)| a.units).collect();
        let units: Vec<String> = units.iter().map(usize::to_string).collect();
        let mut panel = Panel::new(format!("{}, {} maps", spec.title, units.join(" or ")), x, y);
        let mut names = vec![([0.0, 0.0], base.clone())];
        let mut bars = Vec::new();
        panel.add(marked(vec![[0.0, 0.0]], 3.0, ask::place(scene, base), 0.0));
        for (label, a, b) in &points {
            let point = marked(vec![[a.value, b.value]], 3.0, ask::place(scene, label), 0.0);
            let line = cross([a.value, b.value], [a, b].map(ask::bar));
            bars.extend([[line[0], line[1]], [line[3], line[4]]]);
            panel.add(Line::through(line, Stroke::solid(point.color, 0.9)));
            panel.add(Points { marker: Marker::Circle, ..point });
            names.push(([a.value, b.value], label.clone()));
        }
        panel.add(Labels { points: names, bars });
        panel
    }

    /// Every trial, and the medians of each contender, failures at infinity.
    fn trials(&self, scene: &Scene<'_>, spec: &PanelSpec) -> Result<Panel, RenderError> {
        let both = |row: &Row| {
            let value =
                |metric| if row.is_solved() { scene.run.value(row, metric) } else { Some(f64::INFINITY) };
            Some([value(self.metrics[0])?, value(self.metrics[1])?])
        };
        let of = |label: &String| -> Vec<[f64; 2]> {
            let rows = spec.problems.iter().flat_map(|problem| scene.run.rows(problem, label));
            rows.filter_map(both).collect()
        };
        let series: Vec<(&String, Vec<[f64; 2]>)> =
            self.read.contenders.iter().map(|label| (label, of(label))).collect();
        let shown = |axis: usize| {
            let values = series.iter().flat_map(|(_, points)| points).map(move |point| point[axis]);
            values.filter(|value| value.is_finite())
        };
        let low = shown(0).fold(f64::INFINITY, f64::min).max(1.0);
        let x = Axis::log(self.metrics[0].title(), low / 1.3, shown(0).fold(low, f64::max) * 1.3)?;
        let y = Axis::over(self.metrics[1].title(), shown(1));
        let mut panel = Panel::new(title(&spec.title, &series), x, y);
        for (label, all) in series.iter().filter(|(_, all)| all.len() > 1) {
            panel.add(marked(all.clone(), 0.9, ask::place(scene, label), 0.45));
        }
        let is_named = series.len() > SERIES.len();
        let mut names = Vec::new();
        for (label, all) in &series {
            let at = median_point(all);
            let point = marked(at.into_iter().collect(), 3.6, ask::place(scene, label), 0.0);
            // Medians lie on each other; names stand beside them where there are many.
            let point = Points { is_hollow: is_named, ..point };
            names.extend(at.filter(|_| is_named).map(|at| (at, (*label).clone())));
            panel.add(if is_named { point } else { point.labelled(*label) });
        }
        panel.add(Labels { points: names, bars: Vec::new() });
        Ok(panel)
    }
}

impl Kind for Ready {
    fn statistic(&self) -> Option<&'static str> {
        if self.read.trials {
            return Some("Failures are infinite and not drawn; {n}.");
        }
        self.read.against.as_ref().map(|_| "Mean reductions over pairs; {n}.")
    }

    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let panels = &self.read.panels;
        let sheet = |pt| Sheet::new(Width::Double, self.read.panels.len(), pt);
        if self.read.trials {
            return sheet(190.0).with(panels.iter().map(|panel| self.trials(scene, panel)));
        }
        if let Some(base) = &self.read.against {
            let note = format!(
                "Means over maps that both solve, against {base}. Bars: 95 % bootstrap intervals over pairs; none where no map differs."
            );
            return sheet(190.0)
                .noted(&note)
                .with(panels.iter().map(|panel| Ok(self.reductions(scene, panel, base))));
        }
        let note = "Means over the maps that every contender solved, with 95 % bootstrap intervals of each mean over maps.";
        sheet(150.0).noted(note).with(panels.iter().map(|panel| Ok(self.means(scene, panel))))
    }
}

/// Both intervals of a point, as a line with a gap.
fn cross([x, y]: [f64; 2], [along_x, along_y]: [Interval; 2]) -> Vec<[f64; 2]> {
    vec![[along_x.low, y], [along_x.high, y], [f64::NAN, f64::NAN], [x, along_y.low], [x, along_y.high]]
}

/// The title with who fails: failures are at infinity and show nowhere else.
fn title(title: &str, series: &[(&String, Vec<[f64; 2]>)]) -> String {
    let failed = |all: &[[f64; 2]]| all.iter().filter(|point| point[1].is_infinite()).count();
    let failing = series.iter().filter(|(_, all)| failed(all) > 0);
    let failing: Vec<String> =
        failing.map(|(label, all)| format!("{label} fails in {} of {}", failed(all), all.len())).collect();
    if failing.is_empty() { title.to_owned() } else { format!("{title}; {}", failing.join(", ")) }
}

/// Points of the contender at place `index`: colours come round after seven, darker, and the marker moves on by one.
fn marked(points: Vec<[f64; 2]>, radius_pt: f64, index: usize, pale: f64) -> Points {
    let round = index / SERIES.len();
    let color = series_color(index).mixed(BLACK, if round == 0 { 0.0 } else { 0.4 });
    Points::unlabelled(points, series_marker(index + round), radius_pt, color.mixed(WHITE, pale))
}
