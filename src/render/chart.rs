//! Sheets of panels: a figure kind adds marks to panels and gets axes, letters and a legend.
//!
//! A [`Sheet`] lays its panels out row by row in equal columns, aligns their plots, letters them (a), (b)…
//! when there are several, and sets one legend below all of them, where it cannot cover data. A [`Mark`]
//! draws itself through a [`View`], which maps data to the page.
//!
//! What follows the axes (grids, ticks, lines, bands, boxes) stands at whole hundredths of a point, the finest that files
//! hold ([`View::rounded`]).

pub mod axis;
pub mod labels;
pub mod legend;
pub mod marks;
pub mod rows;
pub mod rules;
mod sheet;

pub use axis::Axis;
pub use legend::{Key, Swatch};
pub use sheet::Sheet;

use super::canvas::{Canvas, Rect};

/// `length_pt` in hundredths of a point, a whole number.
fn hundredths(length_pt: f64) -> f64 {
    (length_pt * 100.0).round()
}

/// How one panel maps data to the page.
#[derive(Clone, Debug)]
pub struct View {
    /// The plot on the page, without ticks and labels.
    pub frame: Rect,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis, upwards.
    pub y: Axis,
}

impl View {
    /// Where a data point lies on the page.
    pub fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (across, up) = (self.x.share(x), self.y.share(y));
        [self.frame.x + across * self.frame.w, self.frame.bottom() - up * self.frame.h]
    }

    /// Where a chain of data points lies on the page.
    pub fn all(&self, points: &[[f64; 2]]) -> Vec<[f64; 2]> {
        points.iter().map(|&point| self.at(point)).collect()
    }

    /// Where a data point lies on the page, to the hundredth of a point; it may lie far off the frame, which clips.
    pub fn rounded(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let Rect { x: left, y: top, .. } = self.frame;
        let across = [left, self.frame.right()].map(hundredths);
        [self.x.place(x, across), self.y.place(y, [self.frame.bottom(), top].map(hundredths))]
    }

    /// The rectangle between two data points, as [`rounded`](Self::rounded) places them.
    pub fn rounded_box(&self, corners: [[f64; 2]; 2]) -> Rect {
        let [[x0, y0], [x1, y1]] = corners.map(|corner| self.rounded(corner));
        Rect { x: x0.min(x1), y: y0.min(y1), w: (x1 - x0).abs(), h: (y1 - y0).abs() }
    }
}

/// Something that draws itself in a panel.
pub trait Mark {
    /// Draws the mark. The panel has set a clip to its frame.
    fn draw(&self, canvas: &mut Canvas, view: &View);

    /// Draws what may reach over the edge of the frame: labels, markers on the edge.
    fn draw_over(&self, _canvas: &mut Canvas, _view: &View) {}

    /// What it adds to the legend; equal entries appear once.
    fn keys(&self) -> Vec<Key> {
        Vec::new()
    }

    /// Room in points that its labels need above the frame.
    fn headroom_pt(&self, _view: &View) -> f64 {
        0.0
    }
}

/// What surrounds the plot of a panel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trim {
    /// A frame, ticks and labels; no grid.
    Frame,
    /// A frame, ticks, labels and a light grid.
    Grid,
    /// Nothing, for scenes and diagrams.
    Bare,
}

/// One plot of a sheet.
pub struct Panel {
    title: String,
    x: Axis,
    y: Axis,
    trim: Trim,
    equal: bool,
    marks: Vec<Box<dyn Mark>>,
}

impl Panel {
    /// An empty panel with a light grid.
    pub fn new(title: impl Into<String>, x: Axis, y: Axis) -> Self {
        Self { title: title.into(), x, y, trim: Trim::Grid, equal: false, marks: Vec::new() }
    }

    /// The same with other surroundings.
    #[must_use]
    pub fn trimmed(self, trim: Trim) -> Self {
        Self { trim, ..self }
    }

    /// The same with one scale for both axes; the plot shrinks to keep it.
    #[must_use]
    pub fn with_equal_scales(self) -> Self {
        Self { equal: true, ..self }
    }

    /// Puts `mark` on top of what is there.
    pub fn add(&mut self, mark: impl Mark + 'static) {
        self.marks.push(Box::new(mark));
    }
}

#[cfg(test)]
mod tests;
