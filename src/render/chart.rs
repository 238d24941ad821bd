//! Sheets of panels: a figure kind adds marks to panels and gets axes, letters and a legend.
//!
//! A [`Sheet`] lays its panels out row by row in equal columns, aligns their plots, letters them (a), (b)… when there are
//! several. It sets one legend below all of them, where it cannot cover data. A [`Mark`] draws itself through a [`View`], which
//! maps data to the page.
//!
//! Panels are charts of the crate plotters, drawn on the canvas by a [`Pen`]. An [`Axis`] is one of its coordinates, its mesh is
//! the grid with ticks and labels, and [`View::plot`] draws its series and elements.

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

use super::canvas::pen::{Pen, units};
use super::canvas::{Canvas, Rect};
use super::style::Dash;
use plotters::coord::cartesian::Cartesian2d;
use plotters::element::{Drawable, PointCollection};
use plotters::prelude::DrawingArea;

/// Why plotters cannot fail on a canvas.
const TAKES_ALL: &str = "a canvas takes whatever plotters draws";

/// Backend units from the page's corner to where plotters cuts coordinates off, far outside any clip.
const FAR_UNITS: i32 = 1 << 24;

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

    /// Whether a chain of data points may pass through the frame: the box around some piece of it meets the frame.
    pub fn shows(&self, points: &[[f64; 2]]) -> bool {
        let placed = self.all(points);
        let ends = [placed[..1.min(placed.len())].repeat(2), placed].concat();
        ends.windows(2).any(|ends| {
            let meets = |axis: usize, from: f64, to: f64| {
                let [a, b] = [ends[0][axis], ends[1][axis]];
                a.is_finite() && b.is_finite() && a.min(b) <= to && a.max(b) >= from
            };
            meets(0, self.frame.x, self.frame.right()) && meets(1, self.frame.y, self.frame.bottom())
        })
    }

    /// Draws elements of a series of plotters, given in data units, with lines broken by `dash`.
    ///
    /// They may leave the frame: plotters would move their points to the edge of its drawing area, so that
    /// area reaches far beyond the page, and the panel clips what leaves the frame.
    ///
    /// # Panics
    /// Only if an element fails by itself; those of plotters do not.
    pub fn plot<'c, E>(&self, canvas: &'c mut Canvas, dash: Dash, series: impl IntoIterator<Item = E>)
    where
        E: Drawable<Pen<'c>>,
        for<'e> &'e E: PointCollection<'e, (f64, f64)>,
    {
        let frame = self.frame;
        let across = units(frame.x)..units(frame.right());
        let up = units(frame.bottom())..units(frame.y);
        let area = DrawingArea::from(Pen::new(canvas, dash))
            .shrink((-FAR_UNITS, -FAR_UNITS), (2 * FAR_UNITS, 2 * FAR_UNITS))
            .apply_coord_spec(Cartesian2d::<Axis, Axis>::new(self.x.clone(), self.y.clone(), (across, up)));
        for element in series {
            area.draw(&element).expect(TAKES_ALL);
        }
    }
}

/// Something that draws itself in a panel.
pub trait Mark {
    /// Draws the mark. The panel has set a clip to its frame.
    fn draw(&self, canvas: &mut Canvas, view: &View);

    /// Draws what may reach over the edge of the frame: labels, markers on the edge.
    fn draw_over(&self, _canvas: &mut Canvas, _view: &View) {}

    /// What it adds to the legend of a panel that shows `view`; equal entries appear once.
    fn keys(&self, _view: &View) -> Vec<Key> {
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
