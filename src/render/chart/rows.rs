//! Marks that summarise many values: points with intervals, boxes with strips of values, bars.

use super::legend::{Key, Swatch};
use super::{Mark, View};
use crate::analysis::statistic::Interval;
use crate::render::canvas::Canvas;
use crate::render::canvas::pen::units;
use crate::render::style::{Dash, Fill, INK, Marker, Rgb, Stroke, WHITE};
use plotters::element::{Circle, PathElement, Rectangle};
use plotters::style::ShapeStyle;

/// A point with its intervals.
#[derive(Clone, Debug)]
pub struct Whiskers {
    /// The point, in data units.
    pub at: [f64; 2],
    /// The interval along either axis: none is drawn without width; an end that is not finite runs off the frame.
    pub ends: [Interval; 2],
    /// Shape of the point.
    pub marker: Marker,
    /// Whether it is an outline, so that those that lie on each other all show.
    pub is_hollow: bool,
    /// Ink.
    pub color: Rgb,
    /// Entry in the legend; none if empty.
    pub label: String,
}

impl Mark for Whiskers {
    fn draw(&self, canvas: &mut Canvas, view: &View) {
        let frame = view.frame;
        let beyond = [[frame.x - 1.0, frame.right() + 1.0], [frame.bottom() + 1.0, frame.y - 1.0]];
        let stroke = Stroke::solid(self.color, 1.0);
        for (axis, Interval { low, high }) in
            self.ends.into_iter().enumerate().filter(|(_, ends)| ends.low < ends.high)
        {
            let end = |value: f64, open: f64| {
                let mut at = self.at;
                at[axis] = if value.is_finite() { value } else { at[axis] };
                let mut at = view.at(at);
                at[axis] = if value.is_finite() { at[axis] } else { open };
                at
            };
            let ends = [end(low, beyond[axis][0]), end(high, beyond[axis][1])];
            canvas.polyline(&ends, &stroke);
            for at in ends {
                let cap =
                    [-2.0, 2.0].map(|by| if axis == 0 { [at[0], at[1] + by] } else { [at[0] + by, at[1]] });
                canvas.polyline(&cap, &stroke);
            }
        }
    }

    fn draw_over(&self, canvas: &mut Canvas, view: &View) {
        let at = view.at(self.at);
        if view.frame.contains(at) && self.is_hollow {
            canvas.outlined(at, self.marker, 3.0, self.color);
        } else if view.frame.contains(at) {
            canvas.marker(at, self.marker, 2.5, self.color);
        }
    }

    fn keys(&self, _: &View) -> Vec<Key> {
        let swatch = Swatch::Line(Stroke::solid(self.color, 1.0), Some((self.marker, self.color)));
        Key::labelled(&self.label, swatch)
    }
}

/// Five quantiles as a box with whiskers, over a strip of the single values.
#[derive(Clone, Debug)]
pub struct BoxStrip {
    /// Position along the axis of names, data units.
    pub at: f64,
    /// Width of the box, data units.
    pub width: f64,
    /// Ends of the whiskers, quartiles and median, in rising order.
    pub quantiles: [f64; 5],
    /// Values to scatter behind the box; may be empty.
    pub values: Vec<f64>,
    /// Ink.
    pub color: Rgb,
    /// Entry in the legend; none if empty.
    pub label: String,
}

impl Mark for BoxStrip {
    fn draw(&self, canvas: &mut Canvas, view: &View) {
        let pale = Fill::sheer(self.color, 0.35);
        // Golden-ratio steps spread neighbours evenly without a random stream.
        let jitter = |index: usize| (index as f64 * 0.618_033_988_749_895).fract() - 0.5;
        let strip = self.values.iter().enumerate();
        let dots = strip.map(|(index, &value)| (self.at + jitter(index) * self.width * 1.5, value));
        view.plot(canvas, Dash::Solid, dots.map(|at| Circle::new(at, units(0.9), pale)));
        let ink = Stroke::solid(self.color.mixed(INK, 0.35), 0.9);
        let half = self.width / 2.0;
        let [bottom, lower, median, upper, top] = self.quantiles;
        let level = |reach: f64, value: f64| [(self.at - reach, value), (self.at + reach, value)];
        let stem = |from: f64, to: f64| [(self.at, from), (self.at, to)];
        let lines =
            [stem(bottom, lower), stem(upper, top), level(half / 2.0, bottom), level(half / 2.0, top)];
        view.plot(canvas, Dash::Solid, lines.map(|ends| PathElement::new(ends, ink)));
        let body = ShapeStyle::from(Fill::sheer(self.color.mixed(WHITE, 0.55), 0.85));
        let corners = [(self.at - half, lower), (self.at + half, upper)];
        view.plot(canvas, Dash::Solid, [body, ink.into()].map(|style| Rectangle::new(corners, style)));
        let thick = Stroke { width_pt: 1.8, ..ink };
        view.plot(canvas, Dash::Solid, [PathElement::new(level(half, median), thick)]);
    }

    fn keys(&self, _: &View) -> Vec<Key> {
        let edge = Some(Stroke::solid(self.color.mixed(INK, 0.35), 0.9));
        let swatch = Swatch::Area(Fill::solid(self.color.mixed(WHITE, 0.55)), edge);
        Key::labelled(&self.label, swatch)
    }
}

/// Upright bars that stand on zero: counts, or a histogram if they touch.
#[derive(Clone, Debug)]
pub struct Bars {
    /// `[left, right, height]` of each, data units.
    pub bars: Vec<[f64; 3]>,
    /// Fill.
    pub fill: Fill,
    /// Entry in the legend; none if empty.
    pub label: String,
}

impl Mark for Bars {
    fn draw(&self, canvas: &mut Canvas, view: &View) {
        let looks = [ShapeStyle::from(self.fill), Stroke::solid(WHITE, 0.4).into()];
        for &[left, right, height] in self.bars.iter().filter(|bar| bar[2] != 0.0) {
            let corners = [(left, 0.0), (right, height)];
            view.plot(canvas, Dash::Solid, looks.map(|style| Rectangle::new(corners, style)));
        }
    }

    fn keys(&self, _: &View) -> Vec<Key> {
        let swatch = Swatch::Area(self.fill, None);
        Key::labelled(&self.label, swatch)
    }
}
