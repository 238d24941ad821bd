//! Marks in data coordinates: lines, bands, points, cells, shapes, rules, notes.

use super::legend::{Key, Swatch};
use super::{Mark, View};
use crate::render::canvas::{Align, Canvas, Rect, Stand, Type};
use crate::render::style::{Dash, Fill, Marker, Rgb, Stroke, TextSize};
use plotters::element::Polygon;
use plotters::series::LineSeries;
use std::collections::BTreeMap;

/// A chain of straight pieces, perhaps with a marker on each point.
#[derive(Clone, Debug)]
pub struct Line {
    /// Points in data units; a point without a finite place on the axes breaks the line.
    pub points: Vec<[f64; 2]>,
    /// How it is drawn.
    pub stroke: Stroke,
    /// Marker on each point.
    pub marker: Option<Marker>,
    /// The size of these markers.
    pub radius_pt: f64,
    /// Entry in the legend; none if empty.
    pub label: String,
}

impl Line {
    /// A line without markers and label.
    pub fn through(points: Vec<[f64; 2]>, stroke: Stroke) -> Self {
        Self { points, stroke, marker: None, radius_pt: 2.2, label: String::new() }
    }

    /// The same with an entry in the legend.
    #[must_use]
    pub fn labelled(self, label: impl Into<String>) -> Self {
        Self { label: label.into(), ..self }
    }

    /// The same with markers.
    #[must_use]
    pub fn marked(self, marker: Marker) -> Self {
        Self { marker: Some(marker), ..self }
    }
}

impl Mark for Line {
    fn draw(&self, canvas: &mut Canvas, view: &View) {
        let is_placed = |&point: &[f64; 2]| view.at(point).iter().all(|value| value.is_finite());
        for piece in self.points.split(|point| !is_placed(point)) {
            let points = piece.iter().map(|&point| point.into());
            view.plot(canvas, self.stroke.dash, LineSeries::new(points, self.stroke));
        }
    }

    fn draw_over(&self, canvas: &mut Canvas, view: &View) {
        let Some(marker) = self.marker else { return };
        Points {
            points: self.points.clone(),
            marker,
            radius_pt: self.radius_pt,
            is_hollow: false,
            color: self.stroke.color,
            label: String::new(),
        }
        .draw_over(canvas, view);
    }

    fn keys(&self, view: &View) -> Vec<Key> {
        let marker = self.marker.map(|marker| (marker, self.stroke.color));
        let keys = Key::labelled(&self.label, Swatch::Line(self.stroke, marker));
        keys.into_iter().filter(|_| view.shows(&self.points)).collect()
    }
}

/// A filled strip between two curves over the same abscissae.
#[derive(Clone, Debug)]
pub struct Band {
    /// `[x, low, high]` in data units, in order of x.
    pub edges: Vec<[f64; 3]>,
    /// Fill.
    pub fill: Fill,
    /// Entry in the legend; none if empty.
    pub label: String,
}

impl Mark for Band {
    fn draw(&self, canvas: &mut Canvas, view: &View) {
        let low = self.edges.iter().map(|&[x, low, _]| (x, low));
        let high = self.edges.iter().rev().map(|&[x, _, high]| (x, high));
        let outline: Vec<(f64, f64)> = low.chain(high).collect();
        view.plot(canvas, Dash::Solid, [Polygon::new(outline, self.fill)]);
    }

    fn keys(&self, _: &View) -> Vec<Key> {
        Key::labelled(&self.label, Swatch::Area(self.fill, None))
    }
}

/// Single data points; those outside the frame or not finite are left out.
#[derive(Clone, Debug)]
pub struct Points {
    /// Where they are, in data units.
    pub points: Vec<[f64; 2]>,
    /// Their shape.
    pub marker: Marker,
    /// Their size.
    pub radius_pt: f64,
    /// Whether they are outlines, so that those that lie on each other all show.
    pub is_hollow: bool,
    /// Their colour.
    pub color: Rgb,
    /// Entry in the legend; none if empty.
    pub label: String,
}

impl Points {
    /// Points without a label.
    pub fn unlabelled(points: Vec<[f64; 2]>, marker: Marker, radius_pt: f64, color: Rgb) -> Self {
        Self { points, marker, radius_pt, is_hollow: false, color, label: String::new() }
    }

    /// The same with an entry in the legend.
    #[must_use]
    pub fn labelled(self, label: impl Into<String>) -> Self {
        Self { label: label.into(), ..self }
    }
}

impl Points {
    fn paint(&self, canvas: &mut Canvas, view: &View) {
        let slack = 0.01;
        let frame = view.frame;
        let frame = Rect {
            x: frame.x - slack,
            y: frame.y - slack,
            w: frame.w + 2.0 * slack,
            h: frame.h + 2.0 * slack,
        };
        for at in view.all(&self.points) {
            if frame.contains(at) {
                if self.is_hollow {
                    canvas.outlined(at, self.marker, self.radius_pt, self.color);
                } else {
                    canvas.marker(at, self.marker, self.radius_pt, self.color);
                }
            }
        }
    }
}

impl Mark for Points {
    fn draw(&self, _: &mut Canvas, _: &View) {}

    fn draw_over(&self, canvas: &mut Canvas, view: &View) {
        self.paint(canvas, view);
    }

    fn keys(&self, view: &View) -> Vec<Key> {
        let is_shown = |_: &Key| self.points.iter().any(|point| view.shows(&[*point]));
        Key::labelled(&self.label, Swatch::Point(self.marker, self.color))
            .into_iter()
            .filter(is_shown)
            .collect()
    }
}

/// Points of the background: what is added later covers them, and the frame cuts them.
#[derive(Clone, Debug)]
pub struct Behind(pub Points);

impl Mark for Behind {
    fn draw(&self, canvas: &mut Canvas, view: &View) {
        self.0.paint(canvas, view);
    }

    fn keys(&self, view: &View) -> Vec<Key> {
        self.0.keys(view)
    }
}

/// A closed outline in data units: an obstacle, a region, a bar.
#[derive(Clone, Debug)]
pub struct Shape {
    /// Corners in order.
    pub corners: Vec<[f64; 2]>,
    /// Fill, if any.
    pub fill: Option<Fill>,
    /// Edge, if any.
    pub stroke: Option<Stroke>,
    /// Entry in the legend; none if empty.
    pub label: String,
}

impl Mark for Shape {
    fn draw(&self, canvas: &mut Canvas, view: &View) {
        canvas.polygon(&view.all(&self.corners), self.fill, self.stroke.as_ref());
    }

    fn keys(&self, _: &View) -> Vec<Key> {
        let swatch = match (self.fill, self.stroke) {
            (Some(fill), stroke) => Swatch::Area(fill, stroke),
            (None, Some(stroke)) => Swatch::Line(stroke, None),
            (None, None) => return Vec::new(),
        };
        Key::labelled(&self.label, swatch)
    }
}

/// Coloured cells of a lattice; equal neighbours become one shape, so that no seam shows.
#[derive(Clone, Debug)]
pub struct Cells {
    /// Lower left corner of the lattice, data units.
    pub corner: [f64; 2],
    /// Width and height of one cell, data units.
    pub cell: [f64; 2],
    /// Cells in a row.
    pub columns: usize,
    /// Colour of each cell, rows from the bottom up, each from left to right; none leaves the paper.
    pub colors: Vec<Option<Rgb>>,
    /// Lines between cells, if any.
    pub lines: Option<Stroke>,
    /// Entries for the legend.
    pub keys: Vec<Key>,
}

impl Cells {
    /// Runs of equal cells, `[column, row, end column]`, by colour.
    fn runs(&self) -> BTreeMap<Rgb, Vec<[usize; 3]>> {
        let mut runs: BTreeMap<Rgb, Vec<[usize; 3]>> = BTreeMap::new();
        for (row, colors) in self.colors.chunks(self.columns).enumerate() {
            let mut column = 0;
            for run in colors.chunk_by(|a, b| a == b) {
                if let Some(color) = run[0] {
                    runs.entry(color).or_default().push([column, row, column + run.len()]);
                }
                column += run.len();
            }
        }
        runs
    }

    fn corner_at(&self, view: &View, column: usize, row: usize) -> [f64; 2] {
        let [x, y] = self.corner;
        view.at([x + column as f64 * self.cell[0], y + row as f64 * self.cell[1]])
    }
}

impl Mark for Cells {
    fn draw(&self, canvas: &mut Canvas, view: &View) {
        for (color, runs) in self.runs() {
            let boxed = |&[from, row, to]: &[usize; 3]| {
                let ([x0, y0], [x1, y1]) =
                    (self.corner_at(view, from, row), self.corner_at(view, to, row + 1));
                Rect { x: x0.min(x1), y: y0.min(y1), w: (x1 - x0).abs(), h: (y1 - y0).abs() }
            };
            canvas.raster(&runs.iter().map(boxed).collect::<Vec<_>>(), Fill::solid(color));
        }
        let Some(stroke) = &self.lines else { return };
        let rows = self.colors.len() / self.columns;
        for column in 0..=self.columns {
            canvas.polyline(&[self.corner_at(view, column, 0), self.corner_at(view, column, rows)], stroke);
        }
        for row in 0..=rows {
            canvas.polyline(&[self.corner_at(view, 0, row), self.corner_at(view, self.columns, row)], stroke);
        }
    }

    fn keys(&self, view: &View) -> Vec<Key> {
        let is_shown = |[from, row, to]: &[usize; 3]| {
            let [x0, y0] = self.corner_at(view, *from, *row);
            let [x1, y1] = self.corner_at(view, *to, row + 1);
            let frame = view.frame;
            x0.min(x1) < frame.right()
                && x0.max(x1) > frame.x
                && y0.min(y1) < frame.bottom()
                && y0.max(y1) > frame.y
        };
        let runs = self.runs();
        // A colour that no cell has is of another mark.
        let has = |color: &Rgb| runs.get(color).is_none_or(|runs| runs.iter().any(is_shown));
        let is_there = |key: &&Key| match key.swatch {
            Swatch::Area(fill, _) => has(&fill.color),
            Swatch::Line(..) | Swatch::Point(..) => true,
        };
        self.keys.iter().filter(is_there).cloned().collect()
    }
}

/// A text at a data point, moved off it by a few points on the page.
#[derive(Clone, Debug)]
pub struct Note {
    /// Anchor in data units.
    pub at: [f64; 2],
    /// Shift on the page, right and down.
    pub shift_pt: [f64; 2],
    /// What it says.
    pub text: String,
    /// How it is set.
    pub set: Type,
}

impl Note {
    /// A small text right of `at`, with a white rim.
    pub fn beside(at: [f64; 2], text: impl Into<String>) -> Self {
        let set = Type { rim: true, ..Type::regular(TextSize::TICK).aligned(Align::Start, Stand::Centre) };
        Self { at, shift_pt: [4.0, 0.0], text: text.into(), set }
    }

    /// The same left of `at` and below it, for what has something on its right.
    pub fn below_left(at: [f64; 2], text: impl Into<String>) -> Self {
        let beside = Self::beside(at, text);
        let set = beside.set.aligned(Align::End, Stand::Centre);
        Self { shift_pt: [-3.0, 4.5], set, ..beside }
    }
}

impl Mark for Note {
    fn draw(&self, _: &mut Canvas, _: &View) {}

    fn draw_over(&self, canvas: &mut Canvas, view: &View) {
        let [x, y] = view.at(self.at);
        canvas.text([x + self.shift_pt[0], y + self.shift_pt[1]], &self.text, &self.set);
    }
}

#[cfg(test)]
mod tests;
