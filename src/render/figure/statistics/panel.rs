//! How a panel is drawn: its axes, its marks, what is printed.

use super::numbers::{Point, Series};
use super::{Along, CurveLine, Curves, MarkKind, Statistic, StatisticsPanel};
use crate::analysis::metric::Metric;
use crate::render::RenderError;
use crate::render::canvas::{Align, Stand, Type};
use crate::render::chart::labels::Labels;
use crate::render::chart::marks::{Band, Line, Note, Points};
use crate::render::chart::rows::{Bars, BoxStrip, Whiskers};
use crate::render::chart::rules::Rules;
use crate::render::chart::{Axis, Panel};
use crate::render::effect::less_than;
use crate::render::figure::{Scene, noun};
use crate::render::style::{
    BLACK, Dash, Fill, GREY, INK, SERIES, Stroke, TextSize, VERMILLION, WHITE, series_color, series_marker,
    series_stroke,
};
use std::collections::BTreeSet;

/// At most this many instances are drawn one by one, the first ones.
const DRAWN: usize = 60;

impl StatisticsPanel {
    /// The height of rows, where names stand beside them.
    pub(super) fn rows_pt(&self) -> f64 {
        let is_by_group = self.along == Along::Problems;
        let rows = if is_by_group { self.problems.len() } else { self.contenders.len() } as f64;
        let row_pt = if is_by_group { 6.0 + 5.0 * self.contenders.len() as f64 } else { 13.0 };
        (rows * row_pt).max(60.0)
    }

    /// Everything that its axis of numbers has to hold.
    pub(super) fn values(&self, all: &[Series]) -> Vec<f64> {
        let of = |series: &Series| {
            let dots = series.dots.iter().chain(&series.printed).map(|at| at[1]);
            // The outermost hundredths of a distribution would squeeze all the rest.
            let points = series.points.iter().filter(|_| self.statistic != Statistic::Distribution);
            let points = points.flat_map(|point| {
                // Single values beyond the whiskers are only drawn where there are dots.
                let quantiles = point.spread.quantiles.into_iter().flatten();
                let single = point.spread.values.iter().copied().filter(|_| self.has(MarkKind::Dots));
                [point.at[1], point.ends[1].low, point.ends[1].high]
                    .into_iter()
                    .chain(quantiles)
                    .chain(single)
                    .collect::<Vec<_>>()
            });
            points.chain(dots).collect::<Vec<f64>>()
        };
        let values = all.iter().flat_map(of).chain(self.rules.iter().copied());
        values.filter(|value| value.is_finite()).collect()
    }

    /// The axis of the number.
    fn number_axis(&self, all: &[Series], ratios: &[f64]) -> Result<Axis, RenderError> {
        let values = self.values(all);
        let against = self.spec.against.as_deref().unwrap_or_default();
        let title = self.metric.map_or_else(String::new, Metric::title);
        let log = |title: String, values: &[f64]| {
            let low = values.iter().copied().fold(f64::INFINITY, f64::min);
            Axis::log(title, low / 1.5, values.iter().copied().fold(0.0, f64::max) * 1.5)
        };
        let (title, least): (String, &[f64]) = match self.statistic {
            Statistic::Solved => ("groups solved (%)".to_owned(), &[0.0, 100.0]),
            Statistic::Difference => (format!("difference from “{against}” (points)"), &[-100.0, 100.0]),
            Statistic::Distance => ("distance from the printed row (points)".to_owned(), &[0.0]),
            Statistic::Reductions => {
                (self.metric.map_or_else(String::new, |metric| less_than(metric, against)), &[0.0])
            }
            Statistic::Savings => ("saving (%)".to_owned(), &[0.0, 100.0]),
            Statistic::Spreads => (title, &[0.0]),
            Statistic::Ratios => {
                let metric = self.metric.map_or_else(String::new, |metric| metric.label.to_lowercase());
                return log(format!("{metric}, ratio"), &[ratios, &[1.0]].concat());
            }
            Statistic::Singles => return log(title, &values),
            Statistic::Failures | Statistic::OverTime => (title, &[]),
            Statistic::Pairs => ("share of pairs (%)".to_owned(), &[0.0, 100.0]),
            Statistic::Distribution => (self.spec.axis.clone(), &[]),
        };
        Ok(Axis::over(title, values.iter().chain(least).copied()))
    }

    /// The axis of what the number is along.
    fn along_axis(&self, scene: &Scene<'_>, all: &[Series], is_first: bool) -> Result<Axis, RenderError> {
        let places = || {
            let points = all.iter().flat_map(|series| &series.points);
            let points = points.flat_map(|point| [point.at[0], point.ends[0].low, point.ends[0].high]);
            points
                .chain(all.iter().flat_map(|series| &series.dots).map(|dot| dot[0]))
                .filter(|at| at.is_finite())
        };
        Ok(match &self.along {
            Along::Instances => Axis::linear(format!("share of {}", noun([scene.run.study])), 0.0, 1.0)?,
            Along::Time => Axis::linear("time (s)", 0.0, self.spec.until_s.unwrap_or(1.0))?,
            Along::Number(name) => {
                let about = study::column::find(name).map_or(name.as_str(), |column| column.about);
                Axis::over(if self.spec.axis.is_empty() { about } else { &self.spec.axis }, places())
            }
            Along::Metric(other) if self.statistic == Statistic::Reductions => {
                let against = self.spec.against.as_deref().unwrap_or_default();
                Axis::over(less_than(other, against), places().chain([0.0]))
            }
            Along::Metric(other) => {
                let low = places().fold(f64::INFINITY, f64::min).max(1.0);
                Axis::log(other.title(), low / 1.3, places().fold(low, f64::max) * 1.3)?
            }
            _ => {
                let names = self.names(scene, all);
                let shown =
                    names.iter().map(|name| if is_first || !self.is_sideways { name.as_str() } else { "" });
                let axis = Axis::names(&self.spec.axis, shown);
                if self.is_sideways { axis.reversed() } else { axis }
            }
        })
    }

    /// What stands above it: its title, of reductions how many instances they rest on, and who fails where failures show nowhere else.
    fn title(&self, all: &[Series]) -> String {
        let mut parts: Vec<String> =
            Some(self.spec.title.clone()).filter(|title| !title.is_empty()).into_iter().collect();
        if self.statistic == Statistic::Reductions {
            let n: BTreeSet<usize> =
                all.iter().flat_map(|series| &series.points).map(|point| point.n).collect();
            match (n.first(), n.last()) {
                (Some(least), Some(most)) if least == most => parts.push(format!("n = {least}")),
                (Some(least), Some(most)) => parts.push(format!("n = {least} to {most}")),
                _ => {}
            }
        }
        let failed = |series: &&Series| series.dots.iter().any(|dot| dot[1].is_infinite());
        parts.extend(all.iter().filter(failed).map(|series| {
            let failed = series.dots.iter().filter(|dot| dot[1].is_infinite()).count();
            format!("{} fails in {failed} of {}", series.label, series.dots.len())
        }));
        parts.join(", ")
    }

    /// What stands below it.
    pub(super) fn note(&self, all: &[Series]) -> String {
        self.spec.until_s.map_or_else(String::new, |until_s| note_over_time(until_s, all))
    }

    /// The panel with everything on it; `ratios` are those of the whole figure, which its panels share a scale for.
    pub(super) fn drawn(
        &self,
        scene: &Scene<'_>,
        all: &[Series],
        ratios: &[f64],
        is_first: bool,
    ) -> Result<Panel, RenderError> {
        let number = self.number_axis(all, ratios)?;
        let along = self.along_axis(scene, all, is_first)?;
        let ends = [along.ends(), number.ends()];
        let [x, y] = self.turned([along, number]);
        let mut panel = Panel::new(self.title(all), x, y);
        self.add_equal(&mut panel, ends);
        for series in all.iter().rev().filter(|_| self.has(MarkKind::Dots)) {
            Self::add_dots(scene, &mut panel, series);
        }
        for (index, series) in all.iter().enumerate() {
            self.add_series(scene, &mut panel, series, index, (all.len(), ends[1]));
        }
        for level in &self.spec.levels {
            let mean = Self::level(scene, level)?;
            let line = self.line_at(mean, ends[0], Stroke::solid(GREY, 1.0).dashed(Dash::Dashed));
            panel.add(line.labelled(format!("{}: {mean:.0} %", level.label)));
        }
        self.add_printed(&mut panel, all, ends[0]);
        if matches!(self.along, Along::Metric(_)) {
            add_names(&mut panel, all);
        }
        Ok(panel)
    }

    /// Two things in the order of the page, horizontal first.
    fn turned<T>(&self, [along, number]: [T; 2]) -> [T; 2] {
        if self.is_sideways { [number, along] } else { [along, number] }
    }

    /// A line across the panel at one number.
    fn line_at(&self, number: f64, [low, high]: [f64; 2], stroke: Stroke) -> Line {
        Line::through([low, high].map(|along| self.turned([along, number])).to_vec(), stroke)
    }

    /// Where both sides of a comparison are equal.
    fn add_equal(&self, panel: &mut Panel, [along, _]: [[f64; 2]; 2]) {
        let against = self.spec.against.as_deref().unwrap_or_default();
        match self.statistic {
            Statistic::Ratios => {
                panel.add(
                    self.line_at(1.0, along, Stroke::solid(GREY, 0.8)).labelled(format!("as with {against}")),
                );
            }
            Statistic::Reductions | Statistic::Difference if self.along.is_names() => {
                panel.add(self.line_at(0.0, along, Stroke::solid(INK, 0.6)));
            }
            _ => {}
        }
    }

    /// Single values, pale and behind everything: the first series on top.
    fn add_dots(scene: &Scene<'_>, panel: &mut Panel, series: &Series) {
        let color = color(series.looks).mixed(WHITE, 0.55);
        let thin = Stroke::solid(color, 0.35);
        for (instance, curve) in series.curves.iter().take(DRAWN).enumerate() {
            // Equal rows are moved apart by up to a point and a half, so that they can be seen.
            let shift = ((instance as f64 * 0.618_033_988_749_895).fract() - 0.5) * 3.0;
            let moved = curve.iter().map(|[x, y]| [*x, (y + shift).clamp(0.0, 100.0)]).collect();
            let label = format!("one {} (first {DRAWN})", noun([scene.run.study]).trim_end_matches('s'));
            panel.add(Line::through(moved, thin).labelled(if instance == 0 { label } else { String::new() }));
        }
        if series.dots.len() > 1 {
            panel.add(Points::unlabelled(series.dots.clone(), series_marker(series.looks), 0.9, color));
        }
    }

    /// One series by every mark of the panel.
    fn add_series(
        &self,
        scene: &Scene<'_>,
        panel: &mut Panel,
        series: &Series,
        index: usize,
        (count, ends): (usize, [f64; 2]),
    ) {
        let color = color(series.looks);
        let is_named = matches!(self.along, Along::Metric(_));
        let label = if is_named { String::new() } else { series.label.clone() };
        let points: Vec<[f64; 2]> = series.points.iter().map(|point| self.turned(point.at)).collect();
        if self.has(MarkKind::Band) {
            let edge = |point: &Point| {
                [point.at[0], point.ends[1].low.max(ends[0]), point.ends[1].high.min(ends[1])]
            };
            let edges = series.points.iter().map(edge).collect();
            panel.add(Band { edges, fill: Fill::sheer(color, 0.2), label: String::new() });
        }
        let marker = series_marker(series.looks + series.looks / SERIES.len());
        if self.has(MarkKind::Line) && !points.is_empty() {
            let own = series_stroke(series.looks);
            // A mean over curves of single instances stands out.
            let stroke =
                Stroke { width_pt: if series.curves.is_empty() { own.width_pt } else { 1.8 }, ..own };
            let line = Line::through(points.clone(), stroke).labelled(&label);
            panel.add(if self.has(MarkKind::Point) { line.marked(marker) } else { line });
            if let (Statistic::Distribution, Some(point)) = (self.statistic, series.points.first()) {
                panel.add(how_many([ends[0], 1.0], index, point.n));
            }
        } else if self.has(MarkKind::Point) {
            for (place, (at, point)) in points.iter().zip(&series.points).enumerate() {
                let label = if place == 0 { label.clone() } else { String::new() };
                let is_hollow = self.statistic == Statistic::Failures;
                panel.add(Whiskers {
                    at: *at,
                    ends: self.turned(point.ends),
                    marker,
                    is_hollow,
                    color,
                    label,
                });
            }
        }
        if self.has(MarkKind::Band) && !series.printed.is_empty() && !series.one_more.is_empty() {
            let label =
                format!("{}: one more {}, 95 %", series.label, noun([scene.run.study]).trim_end_matches('s'));
            panel.add(Band { edges: series.one_more.clone(), fill: Fill::sheer(color, 0.1), label });
        }
        if self.has(MarkKind::Box) {
            for (place, point) in series.points.iter().enumerate() {
                let Some(quantiles) = point.spread.quantiles else { continue };
                panel.add(BoxStrip {
                    at: point.at[0],
                    width: 0.5 / count as f64,
                    quantiles,
                    values: if self.has(MarkKind::Dots) { point.spread.values.clone() } else { Vec::new() },
                    color,
                    label: if place == 0 { label.clone() } else { String::new() },
                });
            }
        }
        if self.has(MarkKind::Bar) {
            let half = 0.4 / count as f64;
            let bars = points.iter().map(|[at, height]| [at - half, at + half, *height]).collect();
            panel.add(Bars { bars, fill: Fill::solid(color), label });
            let set = Type::regular(TextSize::TICK).aligned(Align::Middle, Stand::Base);
            for at in points {
                panel.add(Note { at, shift_pt: [0.0, -3.0], text: format!("{:.1}", at[1]), set });
            }
        }
    }

    /// What the paper prints, in its own colour or in that of a contender.
    fn add_printed(&self, panel: &mut Panel, all: &[Series], along: [f64; 2]) {
        if self.is_sideways {
            let own = all.first().into_iter().flat_map(|series| &series.printed).map(|printed| printed[1]);
            let marks =
                self.rules.iter().copied().chain(own).map(|printed| (printed, format!("printed {printed}")));
            panel.add(Rules { marks: marks.collect(), stroke: Stroke::solid(VERMILLION, 1.0) });
            return;
        }
        for rule in &self.rules {
            let dashed = Stroke::solid(GREY, 0.9).dashed(Dash::Dashed);
            panel.add(self.line_at(*rule, along, dashed).labelled("printed"));
        }
        // The first contender's lie on top, so that equal points of others stand out around them.
        for (place, series) in all.iter().enumerate().rev().filter(|(_, series)| !series.printed.is_empty()) {
            let size_pt = 2.4 + 1.4 * place as f64;
            let printed = Points::unlabelled(
                series.printed.clone(),
                series_marker(series.looks),
                size_pt,
                color(series.looks),
            );
            panel.add(printed.labelled(format!("{}: printed", series.label)));
        }
    }

    /// Its curves as numbers.
    pub(super) fn curves(&self, all: &[Series], caption: &str) -> Option<Curves> {
        let first = all.iter().find(|series| !series.points.is_empty())?;
        let at: Vec<f64> = match self.along {
            Along::Time => self.moments(),
            _ => first.points.iter().map(|point| point.at[0]).collect(),
        };
        let line = |(of, series): (usize, &Series)| {
            let find = |x: &f64| series.points.iter().find(|point| point.at[0] == *x);
            let found: Vec<Option<&Point>> = at.iter().map(find).collect();
            let whole: Option<Vec<&Point>> = found.iter().copied().collect();
            let end = |of: fn(&Point) -> f64| Some(whole.as_ref()?.iter().map(|point| of(point)).collect());
            let band = end(|point| point.ends[1].low)
                .zip(end(|point| point.ends[1].high))
                .filter(|_| self.along != Along::Time);
            let values = found.iter().map(|point| Some((*point)?.at[1])).collect();
            CurveLine {
                label: series.label.clone(),
                of,
                values,
                band: band.map(<[_; 2]>::from),
                is_printed: false,
            }
        };
        let printed = |(of, series): (usize, &Series)| {
            let number =
                |x: &f64| series.printed.iter().find(|printed| printed[0] == *x).map(|printed| printed[1]);
            let label = format!("{}: printed", series.label);
            CurveLine { label, of, values: at.iter().map(number).collect(), band: None, is_printed: true }
        };
        let rows = all.iter().enumerate().filter(|(_, series)| !series.printed.is_empty()).map(printed);
        Some(Curves {
            title: caption.to_owned(),
            axis: if self.along == Along::Time { "time (s)".to_owned() } else { self.spec.axis.clone() },
            value: self.metric.map_or_else(|| "solved (%)".to_owned(), Metric::title),
            lines: all.iter().enumerate().map(line).chain(rows).collect(),
            at,
        })
    }
}

/// What stands below a figure over time: what an open interval looks like, and who has no curve.
fn note_over_time(until_s: f64, all: &[Series]) -> String {
    let without = all.iter().filter(|series| series.points.is_empty());
    let without: Vec<&str> = without.map(|series| series.label.as_str()).collect();
    let open = "An interval that has no upper end goes to the top.";
    match without.as_slice() {
        [] => open.to_owned(),
        _ => format!("{open} No path for half of the queries within {until_s} s: {}.", without.join(", ")),
    }
}

/// The colour of a series: colours come round after seven, darker.
fn color(looks: usize) -> crate::render::style::Rgb {
    series_color(looks).mixed(BLACK, if looks < SERIES.len() { 0.0 } else { 0.4 })
}

/// Names beside points, which a legend of many entries would not tell apart.
fn add_names(panel: &mut Panel, all: &[Series]) {
    let points = || all.iter().flat_map(|series| series.points.iter().map(move |point| (series, point)));
    let bars = points().flat_map(|(_, Point { at: [x, y], ends: [across, up], .. })| {
        [[[across.low, *y], [across.high, *y]], [[*x, up.low], [*x, up.high]]]
    });
    let bars = bars.filter(|[from, to]| from != to).collect();
    panel.add(Labels {
        points: points().map(|(series, point)| (point.at, series.label.clone())).collect(),
        bars,
    });
}

/// How many instances stand behind a curve, in its ink: no cumulative curve comes near the upper left corner.
fn how_many(corner: [f64; 2], index: usize, instances: usize) -> Note {
    let set = Type::regular(TextSize::TICK).aligned(Align::Start, Stand::Centre);
    let set = Type { color: series_color(index), rim: true, ..set };
    let down_pt = (index as f64 + 1.0) * 1.25 * TextSize::TICK.pt();
    Note { at: corner, shift_pt: [3.0, down_pt], text: format!("n = {instances}"), set }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn who_finds_no_path_for_half_of_the_queries_is_named_below_the_figure() {
        let series = |label: &str, points| Series { label: label.to_owned(), points, ..Series::default() };
        let all = [series("BIT*", vec![Point::bare([0.1, 10.0])]), series("RRT*", Vec::new())];
        let note = note_over_time(0.5, &all);
        assert!(note.ends_with("No path for half of the queries within 0.5 s: RRT*."), "{note}");
        assert!(!note_over_time(0.5, &all[..1]).contains("No path"), "everyone has a curve");
    }
}
