//! Shares of solved queries or metrics along a sweep, one curve a contender, printed rows on top; or one contender's in several
//! studies, or ratios to one contender along a column of the problem.

mod across;
mod ratios;

use super::{CurveLine, Curves, Entry, Kind, Scene, ask, noun};
use crate::analysis::metric::Metric;
use crate::analysis::shown;
use crate::render::RenderError;
use crate::render::chart::marks::{Band, Line, Points};
use crate::render::chart::{Axis, Panel, Sheet};
use crate::render::style::{
    Dash, Fill, GREY, Stroke, VERMILLION, WHITE, Width, series_color, series_marker, series_stroke,
};
use base::settings::{Accepted, Settings, SettingsError};
use schemars::JsonSchema;
use serde::Deserialize;
use study::key::SweepKey;
use study::paper::Paper;
use study::record::Status;
use study::{Study, sweeps_of};

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "sweep_curves",
    about: "along a sweep: shares of solved queries with simultaneous bands or instance by instance, printed rows on top; or metrics, \
            several studies, ratios along a column",
    statistic: "Shares count unsolved queries; {n}.",
    settings: Accepted::shape::<Read>(),
    example: r#"
problems = "cell"
sweep = "samples"
axis = "samples N"
rows = [
    { contender = "Original A*", printed = "t2.original." },
    { contender = "Improved A*", printed = "t2.improved." },
]
"#,
    build: |settings, study, paper| {
        let mut read: Read = settings.read()?;
        Ok(match (read.across.take(), read.ratios.take()) {
            (None, None) => Box::new(SweepCurves::new(read, settings, study, paper)?),
            (Some(across), None) => {
                read.lacks(
                    settings,
                    "across",
                    &["problems", "rows", "single_instances", "metrics", "printed_ratio", "levels"],
                )?;
                read.has(settings, &["sweep", "axis"])?;
                Box::new(across.built((read.sweep, read.axis), settings, study, paper)?)
            }
            (None, Some(ratios)) => {
                let others = [
                    "problems",
                    "sweep",
                    "axis",
                    "rows",
                    "single_instances",
                    "metrics",
                    "printed_ratio",
                    "levels",
                ];
                read.lacks(settings, "ratios", &others)?;
                Box::new(ratios.built(settings, study)?)
            }
            (Some(_), Some(_)) => {
                return Err(settings.error_at("ratios", "across or ratios is accepted, not both"));
            }
        })
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Read {
    /// The problem group of the rows, by its label.
    #[serde(default)]
    problems: String,
    /// The setting that the study sweeps.
    #[serde(default)]
    sweep: String,
    /// What stands along the axis.
    #[serde(default)]
    axis: String,
    /// The contenders that are shown.
    #[serde(default)]
    rows: Vec<ReadRow>,
    /// Shares that do not hang on the sweep, of contenders in other studies, as dashed lines.
    #[serde(default)]
    levels: Vec<Level>,
    /// In place of rows: one contender's shares, one curve a study.
    across: Option<across::Across>,
    /// In place of a sweep and rows: contenders' ratios to another one along a column of the problem, instance by instance.
    ratios: Option<ratios::Ratios>,
    /// Draws every instance's own curve beside their mean, one panel a contender.
    #[serde(default)]
    single_instances: bool,
    /// Metrics on a logarithmic scale, one panel each, in place of shares of solved queries.
    #[serde(default)]
    metrics: Vec<String>,
    /// A printed ratio of the other rows to the first one, drawn as a line; the metric's panel then shows such ratios.
    printed_ratio: Option<PrintedRatio>,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct PrintedRatio {
    /// Its metric.
    metric: String,
    /// The ratio.
    ratio: f64,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct ReadRow {
    /// The contender, by its label.
    contender: String,
    /// What the claims of the printed cells are called before the sweep's value, if a row is printed.
    printed: Option<String>,
}

/// A share of solved queries as a line across the panel.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Level {
    /// The study.
    study: String,
    /// Its problem group, by its label.
    problems: String,
    /// Its contender, by its label.
    contender: String,
    /// What the line is called.
    label: String,
}

impl Read {
    /// Whether a key is not written, or says nothing.
    fn is_left_out(&self, key: &str) -> bool {
        match key {
            "problems" => self.problems.is_empty(),
            "sweep" => self.sweep.is_empty(),
            "axis" => self.axis.is_empty(),
            "single_instances" => !self.single_instances,
            "metrics" => self.metrics.is_empty(),
            "levels" => self.levels.is_empty(),
            "printed_ratio" => self.printed_ratio.is_none(),
            _ => self.rows.is_empty(),
        }
    }

    /// Refuses settings without one of these keys.
    fn has(&self, settings: &Settings, keys: &[&str]) -> Result<(), SettingsError> {
        match keys.iter().find(|key| self.is_left_out(key)) {
            Some(key) => Err(settings.error(format!("`{key}` is missing")).about(key)),
            None => Ok(()),
        }
    }

    /// Refuses settings with one of these keys, which `beside` does not look at.
    fn lacks(&self, settings: &Settings, beside: &str, keys: &[&str]) -> Result<(), SettingsError> {
        match keys.iter().find(|key| !self.is_left_out(key)) {
            Some(key) => Err(settings.error_at(key, format!("`{beside}` takes no `{key}` beside it"))),
            None => Ok(()),
        }
    }
}

struct SweepCurves {
    read: Read,
    /// The sweep's values as numbers and as records have them.
    points: Vec<(f64, SweepKey)>,
    metrics: Vec<&'static Metric>,
    rows: Vec<RowOf>,
}

/// One contender's curve and its printed row.
struct RowOf {
    contender: String,
    printed: Vec<[f64; 2]>,
}

/// At most this many instances are drawn one by one, the first ones.
const DRAWN: usize = 60;

impl SweepCurves {
    fn new(read: Read, settings: &Settings, study: &Study, paper: &Paper) -> Result<Self, SettingsError> {
        read.has(settings, &["problems", "sweep", "axis", "rows"])?;
        ask::known(settings, study, [&read.problems], read.rows.iter().map(|row| &row.contender))?;
        let metrics =
            read.metrics.iter().map(|name| ask::metric(settings, name)).collect::<Result<_, _>>()?;
        let points = study.pooled_points_of(|label| *label == *read.problems);
        if points.iter().any(|point| point.values().len() > 1) {
            let message =
                format!("study `{}` sweeps more than `{}`, and one sweep is drawn", study.name, read.sweep);
            return Err(settings.error_at("sweep", message));
        }
        let value = |key: &SweepKey| key.value(&read.sweep)?.as_f64();
        let points: Vec<(f64, SweepKey)> =
            points.into_iter().filter_map(|key| Some((value(&key)?, key))).collect();
        if points.is_empty() {
            let message = format!("study `{}` does not sweep numbers of `{}`", study.name, read.sweep);
            return Err(settings.error_at("sweep", message).about(&sweeps_of(&study.name)));
        }
        for (index, level) in read.levels.iter().enumerate() {
            let other = paper.study(&level.study).ok_or_else(|| {
                let message = format!("there is no study `{}`", level.study);
                settings.error_at(&format!("levels.{index}.study"), message)
            })?;
            ask::known(settings, other, [&level.problems], [&level.contender])?;
        }
        let mut rows = Vec::new();
        for (index, row) in read.rows.iter().enumerate() {
            let key = format!("rows.{index}.printed");
            let cells = row.printed.iter().flat_map(|prefix| {
                let key = &key;
                points.iter().map(move |(x, _)| {
                    ask::printed(settings, paper, key, &format!("{prefix}{x}")).map(|printed| [*x, printed])
                })
            });
            rows.push(RowOf { printed: cells.collect::<Result<_, _>>()?, contender: row.contender.clone() });
        }
        Ok(Self { read, points, metrics, rows })
    }

    /// Each instance's row of shares.
    fn curves(&self, scene: &Scene<'_>, contender: &str) -> shown::Curves {
        let at = |(_, at): &(f64, SweepKey)| ask::trials_at(scene.run, &self.read.problems, contender, at);
        shown::Curves::solved(&self.points.iter().map(at).collect::<Vec<_>>(), scene.evidence)
    }

    /// A curve through these numbers, one a point of the sweep.
    fn over<T>(&self, values: impl IntoIterator<Item = T>) -> impl Iterator<Item = (f64, T)> {
        self.points.iter().map(|(x, _)| *x).zip(values)
    }

    fn panel(&self, title: &str) -> Result<Panel, RenderError> {
        let (low, high) = (self.points[0].0, self.points[self.points.len() - 1].0);
        let margin = 0.03 * (high - low);
        let x = Axis::linear(&self.read.axis, low - margin, high + margin)?;
        Ok(Panel::new(title, x, Axis::linear("groups solved (%)", -3.0, 103.0)?))
    }

    fn add_band(
        &self,
        scene: &Scene<'_>,
        panel: &mut Panel,
        row: &RowOf,
        place: usize,
    ) -> Result<(), RenderError> {
        let index = ask::series(scene, &row.contender, place);
        let curves = self.curves(scene, &row.contender);
        let Some(found) = curves.band(&["success_bands", &row.contender]) else {
            let what = format!("two instances of `{}` on `{}`", row.contender, self.read.problems);
            return Err(RenderError::NotStored { what });
        };
        let edges = self.over(&found.band).map(|(x, [low, high])| [x, *low, *high]).collect();
        let count = curves.instances.len();
        let unit = noun([scene.run.study]);
        let label = format!("{}: mean of {count} {unit}, 95 % band", row.contender);
        panel.add(Band { edges, fill: Fill::sheer(series_color(index), 0.25), label: String::new() });
        let points = self.over(&found.mean).map(|(x, y)| [x, *y]).collect();
        panel.add(Line::through(points, series_stroke(index)).labelled(label));
        if let Some(range) = curves.one_more().filter(|_| !row.printed.is_empty()) {
            let edges = self.over(range).map(|(x, range)| [x, range.low, range.high]).collect();
            let label = format!("{}: one more {}, 95 %", row.contender, unit.trim_end_matches('s'));
            panel.add(Band { edges, fill: Fill::sheer(series_color(index), 0.1), label });
        }
        Ok(())
    }

    /// The printed row; the first contender's lie on top, so that equal points of others stand out around them.
    fn add_printed(&self, scene: &Scene<'_>, panel: &mut Panel, place: usize) {
        let row = &self.rows[place];
        let index = ask::series(scene, &row.contender, place);
        let size = 2.4 + 1.4 * place as f64;
        let printed =
            Points::unlabelled(row.printed.clone(), series_marker(index), size, series_color(index));
        panel.add(printed.labelled(format!("{}: printed", row.contender)));
    }

    /// The mean share of another study's contender, as a line across.
    fn add_level(&self, scene: &Scene<'_>, panel: &mut Panel, level: &Level) -> Result<(), RenderError> {
        let missing =
            || RenderError::NotStored { what: format!("`{}` of `{}`", level.contender, level.study) };
        let run = scene.evidence.run(&level.study).ok_or_else(missing)?;
        let trials = ask::trials(run, &level.problems, &level.contender);
        let curves = shown::Curves::solved(&[trials], scene.evidence);
        let mean = *curves.means().first().filter(|mean| mean.is_finite()).ok_or_else(missing)?;
        let ends = self.points.first().into_iter().chain(self.points.last()).map(|(x, _)| [*x, mean]);
        let line = Line::through(ends.collect(), Stroke::solid(GREY, 1.0).dashed(Dash::Dashed));
        panel.add(line.labelled(format!("{}: {mean:.0} %", level.label)));
        Ok(())
    }

    fn single_instances(&self, scene: &Scene<'_>, place: usize) -> Result<Panel, RenderError> {
        let row = &self.rows[place];
        let color = series_color(ask::series(scene, &row.contender, place));
        let curves = self.curves(scene, &row.contender);
        let mut panel = self.panel(&row.contender)?;
        let thin = Stroke::solid(color.mixed(WHITE, 0.6), 0.35);
        for (instance, curve) in curves.instances.iter().take(DRAWN).enumerate() {
            // Equal rows are moved apart by up to a point and a half, so that they can be seen.
            let shift = ((instance as f64 * 0.618_033_988_749_895).fract() - 0.5) * 3.0;
            let line = Line::through(
                self.over(curve).map(|(x, y)| [x, (y + shift).clamp(0.0, 100.0)]).collect(),
                thin,
            );
            let label = format!("one {} (first {DRAWN})", noun([scene.run.study]).trim_end_matches('s'));
            panel.add(line.labelled(if instance == 0 { label } else { String::new() }));
        }
        let means = self.over(curves.means()).map(|(x, y)| [x, y]).collect();
        panel.add(
            Line::through(means, Stroke::solid(GREY, 1.8))
                .labelled(format!("mean of all {}", noun([scene.run.study]))),
        );
        let printed = Points::unlabelled(row.printed.clone(), series_marker(0), 2.8, VERMILLION);
        panel.add(printed.labelled("printed"));
        Ok(panel)
    }

    /// Whether a trial that is shown spent its budget.
    fn has_spent(&self, scene: &Scene<'_>) -> bool {
        let trials = |row: &RowOf| scene.run.rows(&self.read.problems, &row.contender);
        self.rows.iter().flat_map(trials).any(|trial| trial.status == Status::BudgetSpent)
    }

    /// One metric of every trial, whether it was solved or spent its budget.
    fn metric(&self, scene: &Scene<'_>, metric: &Metric) -> Result<Panel, RenderError> {
        let curve = |row: &RowOf| -> Vec<[f64; 2]> {
            let trials = scene.run.rows(&self.read.problems, &row.contender);
            let point = |trial: &&study::record::Row| {
                Some([trial.key.sweep.value(&self.read.sweep)?.as_f64()?, scene.run.value(trial, metric)?])
            };
            trials.iter().filter_map(point).collect()
        };
        let mut curves: Vec<_> = self.rows.iter().map(curve).collect();
        let mut title = metric.title();
        let own = self.read.printed_ratio.as_ref().filter(|printed| printed.metric == metric.name);
        let printed = own.map(|PrintedRatio { ratio, .. }| {
            let first = std::mem::take(&mut curves[0]);
            for curve in &mut curves {
                *curve = ratios(curve, &first);
            }
            title = format!("{}, ratio", metric.label.to_lowercase());
            let line = first.iter().map(|[x, _]| [*x, *ratio]).collect::<Vec<_>>();
            (line, format!("printed: {ratio}"))
        });
        let all = || curves.iter().chain(printed.iter().map(|(line, _)| line)).flatten();
        let low = all().map(|point| point[1]).fold(f64::INFINITY, f64::min);
        let high = all().map(|point| point[1]).fold(0.0, f64::max);
        if !(low > 0.0 && high.is_finite()) {
            return Err(RenderError::NotStored { what: format!("values of `{}`", metric.name) });
        }
        let x = Axis::over(self.read.axis.clone(), all().map(|point| point[0]));
        let mut panel = Panel::new(&metric.label, x, Axis::log(title, low / 1.5, high * 1.5)?);
        let drawn =
            curves.into_iter().zip(&self.rows).enumerate().filter(|(_, (curve, _))| !curve.is_empty());
        for (index, (curve, row)) in drawn {
            let line = Line::through(curve, series_stroke(index)).marked(series_marker(index));
            panel.add(line.labelled(row.contender.clone()));
        }
        if let Some((line, label)) = printed {
            let stroke = Stroke::solid(GREY, 1.0).dashed(Dash::Dashed);
            panel.add(Line::through(line, stroke).labelled(label));
        }
        Ok(panel)
    }
}

/// The ratios of `curve` to `first` where both have a point.
fn ratios(curve: &[[f64; 2]], first: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let over = |[x, y]: &[f64; 2]| {
        let [_, base] = first.iter().find(|[at, base]| at == x && *base > 0.0)?;
        Some([*x, y / base])
    };
    curve.iter().filter_map(over).collect()
}

impl Kind for SweepCurves {
    fn statistic(&self) -> Option<&'static str> {
        (!self.metrics.is_empty()).then_some("Single trials; {n}.")
    }

    fn curves(&self, scene: &Scene<'_>, caption: &str) -> Option<Curves> {
        if self.read.single_instances || !self.metrics.is_empty() {
            return None;
        }
        let line = |(of, row): (usize, &RowOf)| {
            let curves = self.curves(scene, &row.contender);
            let found = curves.band(&["success_bands", &row.contender])?;
            let band = [0, 1].map(|end| found.band.iter().map(|ends| ends[end]).collect());
            let count = curves.instances.len();
            let unit = noun([scene.run.study]);
            let label = format!("{}: mean of {count} {unit}", row.contender);
            let values = found.mean.into_iter().map(Some).collect();
            Some(CurveLine { label, of, values, band: Some(band), is_printed: false })
        };
        let printed = |(of, row): (usize, &RowOf)| {
            let at = |x: f64| row.printed.iter().find(|point| point[0] == x).map(|point| point[1]);
            let values = self.points.iter().map(|(x, _)| at(*x)).collect();
            CurveLine {
                label: format!("{}: printed", row.contender),
                of,
                values,
                band: None,
                is_printed: true,
            }
        };
        let found = self.rows.iter().enumerate().filter_map(line);
        let printed = self.rows.iter().enumerate().filter(|(_, row)| !row.printed.is_empty()).map(printed);
        Some(Curves {
            title: caption.to_owned(),
            axis: self.read.axis.clone(),
            value: "solved (%)".to_owned(),
            at: self.points.iter().map(|(x, _)| *x).collect(),
            lines: found.chain(printed).collect(),
        })
    }

    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        if !self.metrics.is_empty() {
            let note =
                if self.has_spent(scene) { "A trial that spent its budget shows what it spent." } else { "" };
            let sheet = Sheet::new(Width::Double, self.metrics.len(), 165.0).noted(note);
            return sheet.with(self.metrics.iter().map(|metric| self.metric(scene, metric)));
        }
        if self.read.single_instances {
            let panels = (0..self.rows.len()).map(|place| self.single_instances(scene, place));
            return Sheet::new(Width::Double, self.rows.len(), 170.0).with(panels);
        }
        let mut panel = self.panel("")?;
        for (place, row) in self.rows.iter().enumerate() {
            self.add_band(scene, &mut panel, row, place)?;
        }
        for level in &self.read.levels {
            self.add_level(scene, &mut panel, level)?;
        }
        for place in (0..self.rows.len()).rev().filter(|place| !self.rows[*place].printed.is_empty()) {
            self.add_printed(scene, &mut panel, place);
        }
        Sheet::new(Width::Double, 1, 210.0).with([Ok(panel)])
    }
}
