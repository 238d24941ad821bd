//! The canvas as a backend of the crate plotters, which draws the panels of charts.
//!
//! One backend unit is a hundredth of a point, as fine as the canvas writes, so nothing is coarser for going
//! through plotters' whole numbers. What plotters' styles cannot say, the pen does: how lines are broken.

use super::{Align, Canvas, Rect, Stand, Type};
use crate::render::RenderError;
use crate::render::font::{LINE_EM, Weight};
use crate::render::style::{Dash, Fill, Rgb, Stroke, TextSize};
use plotters::style::{FontDesc, FontFamily, RGBAColor, ShapeStyle, TextStyle};
use plotters_backend::text_anchor::{HPos, VPos};
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind, FontStyle,
    FontTransform,
};
use std::convert::Infallible;

/// Backend units in a point.
pub const UNITS_PER_PT: f64 = 100.0;

/// `length_pt` in backend units, rounded; lengths beyond the range of whole numbers go to its ends.
pub fn units(length_pt: f64) -> i32 {
    (length_pt * UNITS_PER_PT).round() as i32
}

/// A canvas for plotters to draw on, with one dash for all lines.
#[derive(Debug)]
pub struct Pen<'a> {
    canvas: &'a mut Canvas,
    dash: Dash,
}

type Drawn = Result<(), DrawingErrorKind<Infallible>>;

impl<'a> Pen<'a> {
    /// A pen on `canvas` whose lines are broken by `dash`.
    pub fn new(canvas: &'a mut Canvas, dash: Dash) -> Self {
        Self { canvas, dash }
    }

    fn stroke(&self, style: &impl BackendStyle) -> Stroke {
        let width_pt = f64::from(style.stroke_width()) / UNITS_PER_PT;
        Stroke { color: rgb(style.color()), width_pt, dash: self.dash, opacity: style.color().alpha }
    }

    /// Fill and edge of a shape that is either filled or outlined.
    fn looks(&self, style: &impl BackendStyle, filled: bool) -> (Option<Fill>, Option<Stroke>) {
        if filled { (Some(surface(style)), None) } else { (None, Some(self.stroke(style))) }
    }
}

fn rgb(color: BackendColor) -> Rgb {
    let (r, g, b) = color.rgb;
    Rgb([r, g, b])
}

fn surface(style: &impl BackendStyle) -> Fill {
    Fill::sheer(rgb(style.color()), style.color().alpha)
}

fn place((x, y): BackendCoord) -> [f64; 2] {
    [f64::from(x) / UNITS_PER_PT, f64::from(y) / UNITS_PER_PT]
}

fn boxed(from: BackendCoord, to: BackendCoord) -> Rect {
    let [x, y] = place(from);
    let [right, bottom] = place(to);
    Rect { x, y, w: right - x, h: bottom - y }
}

fn typed(style: &impl BackendTextStyle) -> Result<Type, RenderError> {
    let weight = match style.style() {
        FontStyle::Bold => Weight::Bold,
        FontStyle::Normal | FontStyle::Oblique | FontStyle::Italic => Weight::Regular,
    };
    let align = match style.anchor().h_pos {
        HPos::Left => Align::Start,
        HPos::Center => Align::Middle,
        HPos::Right => Align::End,
    };
    let stand = match style.anchor().v_pos {
        VPos::Top => Stand::Below,
        VPos::Center => Stand::Centre,
        VPos::Bottom => Stand::Base,
    };
    let turn_deg = match style.transform() {
        FontTransform::None => 0.0,
        FontTransform::Rotate90 => 90.0,
        FontTransform::Rotate180 => 180.0,
        FontTransform::Rotate270 => -90.0,
    };
    let size = TextSize::new(style.size() / UNITS_PER_PT)?;
    Ok(Type { size, weight, color: rgb(style.color()), align, stand, turn_deg, rim: false })
}

impl DrawingBackend for Pen<'_> {
    type ErrorType = Infallible;

    fn get_size(&self) -> (u32, u32) {
        let page = self.canvas.page();
        (units(page.w).unsigned_abs(), units(page.h).unsigned_abs())
    }

    fn ensure_prepared(&mut self) -> Drawn {
        Ok(())
    }

    fn present(&mut self) -> Drawn {
        Ok(())
    }

    fn draw_pixel(&mut self, (x, y): BackendCoord, color: BackendColor) -> Drawn {
        self.draw_rect((x, y), (x + 1, y + 1), &color, true)
    }

    fn draw_line<S: BackendStyle>(&mut self, from: BackendCoord, to: BackendCoord, style: &S) -> Drawn {
        self.draw_path([from, to], style)
    }

    fn draw_rect<S: BackendStyle>(
        &mut self,
        from: BackendCoord,
        to: BackendCoord,
        style: &S,
        filled: bool,
    ) -> Drawn {
        let (fill, stroke) = self.looks(style, filled);
        self.canvas.rect(boxed(from, to), fill, stroke.as_ref());
        Ok(())
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        path: I,
        style: &S,
    ) -> Drawn {
        let points: Vec<[f64; 2]> = path.into_iter().map(place).collect();
        self.canvas.polyline(&points, &self.stroke(style));
        Ok(())
    }

    fn draw_circle<S: BackendStyle>(
        &mut self,
        centre: BackendCoord,
        radius: u32,
        style: &S,
        filled: bool,
    ) -> Drawn {
        let (fill, stroke) = self.looks(style, filled);
        self.canvas.circle(place(centre), f64::from(radius) / UNITS_PER_PT, fill, stroke.as_ref());
        Ok(())
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        corners: I,
        style: &S,
    ) -> Drawn {
        let corners: Vec<[f64; 2]> = corners.into_iter().map(place).collect();
        self.canvas.polygon(&corners, Some(surface(style)), None);
        Ok(())
    }

    fn draw_text<S: BackendTextStyle>(&mut self, text: &str, style: &S, at: BackendCoord) -> Drawn {
        match typed(style) {
            Ok(set) if !text.is_empty() => self.canvas.text(place(at), text, &set),
            Ok(_) => {}
            Err(error) => self.canvas.refuse(error),
        }
        Ok(())
    }

    fn estimate_text_size<S: BackendTextStyle>(
        &self,
        text: &str,
        style: &S,
    ) -> Result<(u32, u32), DrawingErrorKind<Infallible>> {
        let height_pt = style.size() / UNITS_PER_PT * LINE_EM;
        let width_pt = typed(style).map_or(0.0, |set| set.width_pt(text));
        Ok((units(width_pt).unsigned_abs(), units(height_pt).unsigned_abs()))
    }
}

fn ink(Rgb([r, g, b]): Rgb, opacity: f64) -> RGBAColor {
    RGBAColor(r, g, b, opacity)
}

impl From<Stroke> for ShapeStyle {
    /// The line without its dash, which is the pen's.
    fn from(stroke: Stroke) -> Self {
        let stroke_width = units(stroke.width_pt).unsigned_abs();
        Self { color: ink(stroke.color, stroke.opacity), filled: false, stroke_width }
    }
}

impl From<Fill> for ShapeStyle {
    fn from(fill: Fill) -> Self {
        Self { color: ink(fill.color, fill.opacity), filled: true, stroke_width: 0 }
    }
}

/// Size, weight and ink of `set` for plotters, which aligns and turns text itself.
pub fn text_style(set: &Type) -> TextStyle<'static> {
    let style = match set.weight {
        Weight::Regular => FontStyle::Normal,
        Weight::Bold => FontStyle::Bold,
    };
    FontDesc::new(FontFamily::SansSerif, set.size.pt() * UNITS_PER_PT, style).color(&ink(set.color, 1.0))
}

#[cfg(test)]
mod tests;
