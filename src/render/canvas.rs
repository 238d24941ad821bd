//! A page to draw on, in points: origin at the upper left corner, x right, y down.
//!
//! A canvas writes SVG elements in the order of the calls. Text becomes outlines at once and its box is
//! remembered, so that [`Canvas::finish`] can say which labels run into each other or off the page.

use super::RenderError;
pub mod pen;
mod room;
mod words;

use super::font::{self, CAP_EM, UNITS_PER_EM, Weight};
use super::style::{Fill, INK, Marker, Rgb, Stroke, TextSize, WHITE, Width};
use super::vector::{self, Figure, Provenance};
use room::{Quad, overlap, turned};
use std::collections::BTreeSet;
use std::fmt::Write as _;
use words::{ink, path_data, short, surface};

/// A rectangle on the page: upper left corner and extent, points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rect {
    /// Left edge.
    pub x: f64,
    /// Upper edge.
    pub y: f64,
    /// Width.
    pub w: f64,
    /// Height.
    pub h: f64,
}

impl Rect {
    /// Right edge.
    pub fn right(self) -> f64 {
        self.x + self.w
    }

    /// Lower edge.
    pub fn bottom(self) -> f64 {
        self.y + self.h
    }

    /// Whether `point` lies inside or on the edge.
    pub fn contains(self, [x, y]: [f64; 2]) -> bool {
        (self.x..=self.right()).contains(&x) && (self.y..=self.bottom()).contains(&y)
    }
}

/// Where a text lies relative to its anchor, along the line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Align {
    /// The text starts at the anchor.
    Start,
    /// The text is centred on the anchor.
    Middle,
    /// The text ends at the anchor.
    End,
}

/// Where a text lies relative to its anchor, across the line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stand {
    /// Capitals hang below the anchor.
    Below,
    /// Capitals are centred on the anchor.
    Centre,
    /// The anchor is on the baseline.
    Base,
}

/// How a text is set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Type {
    /// Size.
    pub size: TextSize,
    /// Weight.
    pub weight: Weight,
    /// Ink.
    pub color: Rgb,
    /// Along the line.
    pub align: Align,
    /// Across the line.
    pub stand: Stand,
    /// Turn about the anchor, clockwise on the page.
    pub turn_deg: f64,
    /// Whether a white rim parts the text from what lies below.
    pub rim: bool,
}

impl Type {
    /// Regular dark text of `size` that starts at its anchor, on the baseline.
    pub const fn regular(size: TextSize) -> Self {
        let weight = Weight::Regular;
        let align = Align::Start;
        let stand = Stand::Base;
        Self { size, weight, color: INK, align, stand, turn_deg: 0.0, rim: false }
    }

    /// The same with another alignment.
    #[must_use]
    pub const fn aligned(self, align: Align, stand: Stand) -> Self {
        Self { align, stand, ..self }
    }

    /// The same in bold.
    #[must_use]
    pub const fn bold(self) -> Self {
        Self { weight: Weight::Bold, ..self }
    }

    /// The same in another colour.
    #[must_use]
    pub const fn colored(self, color: Rgb) -> Self {
        Self { color, ..self }
    }

    /// Width of one line of `text`, points.
    pub fn width_pt(&self, text: &str) -> f64 {
        font::width_em(text, self.weight) * self.size.pt()
    }
}

/// A page under the pen.
#[derive(Debug)]
pub struct Canvas {
    width: Width,
    height_pt: f64,
    body: String,
    /// How the last element of the body begins, if more may join it, and where it ends.
    open: Option<(String, usize)>,
    clips: Vec<Rect>,
    glyphs: BTreeSet<(Weight, u16)>,
    texts: Vec<(String, Quad)>,
    refused: Option<RenderError>,
}

impl Canvas {
    /// An empty white page.
    pub fn new(width: Width, height_pt: f64) -> Self {
        Self {
            width,
            height_pt,
            body: String::new(),
            open: None,
            clips: Vec::new(),
            glyphs: BTreeSet::new(),
            texts: Vec::new(),
            refused: None,
        }
    }

    /// The whole page.
    pub fn page(&self) -> Rect {
        Rect { x: 0.0, y: 0.0, w: self.width.pt(), h: self.height_pt }
    }

    fn push(&mut self, element: std::fmt::Arguments<'_>) {
        self.body.write_fmt(element).expect("a string takes everything");
    }

    /// Draws a line through `points`; nothing for fewer than two.
    pub fn polyline(&mut self, points: &[[f64; 2]], stroke: &Stroke) {
        if points.len() > 1 {
            let paint = format!(" fill=\"none\"{}", ink(stroke));
            self.path(&paint, &path_data(points, 2), stroke.opacity >= 1.0);
        }
    }

    /// Writes a path. It joins the path before it if that is painted alike and both say that it may.
    fn path(&mut self, paint: &str, data: &str, joins: bool) {
        self.join(format!("<path{paint} d=\""), data, "\"/>\n", joins);
    }

    /// Writes `data` between `head` and `tail`, or within those of what was written last if that began alike and both may join.
    fn join(&mut self, head: String, data: &str, tail: &str, joins: bool) {
        if joins && self.open.as_ref().is_some_and(|(open, end)| *open == head && *end == self.body.len()) {
            self.body.truncate(self.body.len() - tail.len());
        } else {
            self.body.push_str(&head);
        }
        self.body.push_str(data);
        self.body.push_str(tail);
        self.open = joins.then_some((head, self.body.len()));
    }

    /// Fills the convex face of a solid and closes the seam to its neighbours with a hair of its own colour. All faces that
    /// are drawn after one another must turn the same way.
    pub fn face(&mut self, corners: &[[f64; 2]], color: Rgb) {
        let color = color.hex();
        let paint = format!(" fill=\"{color}\" stroke=\"{color}\"");
        self.path(&paint, &(path_data(corners, 1) + "z"), true);
    }

    /// Fills the closed outline through `points` and, if given, strokes it.
    pub fn polygon(&mut self, points: &[[f64; 2]], fill: Option<Fill>, stroke: Option<&Stroke>) {
        self.outlines(&[points], fill, stroke);
    }

    /// Fills several closed outlines as one shape (no seam where they touch; a hole where they nest).
    pub fn outlines(&mut self, outlines: &[&[[f64; 2]]], fill: Option<Fill>, stroke: Option<&Stroke>) {
        let path: String = outlines.iter().map(|points| path_data(points, 2) + "z").collect();
        let paint = surface(fill);
        let rim = stroke.map(ink).unwrap_or_default();
        let rule = if outlines.len() > 1 { " fill-rule=\"evenodd\"" } else { "" };
        self.push(format_args!("<path{paint}{rim}{rule} d=\"{path}\"/>\n"));
    }

    /// Fills closed outlines as one shape with unsmoothed edges, for rasters whose cells must not part.
    pub fn raster(&mut self, outlines: &[Rect], fill: Fill) {
        let mut path = String::new();
        for rect in outlines {
            let x = short(rect.x);
            let y = short(rect.y);
            let right = short(rect.right());
            let bottom = short(rect.bottom());
            write!(path, "M{x} {y}H{right}V{bottom}H{x}Z").expect("a string takes everything");
        }
        let paint = surface(Some(fill));
        self.push(format_args!("<path{paint} shape-rendering=\"crispEdges\" d=\"{path}\"/>\n"));
    }

    /// Fills a rectangle and, if given, strokes its edge.
    pub fn rect(&mut self, rect: Rect, fill: Option<Fill>, stroke: Option<&Stroke>) {
        let (x, y, w, h) = (short(rect.x), short(rect.y), short(rect.w), short(rect.h));
        let paint = surface(fill);
        let rim = stroke.map(ink).unwrap_or_default();
        self.push(format_args!("<rect{paint}{rim} x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\"/>\n"));
    }

    /// Fills a disc and, if given, strokes its edge. Discs that are painted alike, one after another, say so once.
    pub fn circle(&mut self, centre: [f64; 2], radius_pt: f64, fill: Option<Fill>, stroke: Option<&Stroke>) {
        let [x, y] = centre.map(short);
        let r = short(radius_pt);
        let paint = surface(fill);
        let rim = stroke.map(ink).unwrap_or_default();
        let disc = format!("<circle cx=\"{x}\" cy=\"{y}\" r=\"{r}\"/>\n");
        self.join(format!("<g{paint}{rim}>\n"), &disc, "</g>\n", true);
    }

    /// Draws a data point about `radius_pt` in radius, with a thin white rim that parts neighbours.
    pub fn marker(&mut self, at: [f64; 2], marker: Marker, radius_pt: f64, color: Rgb) {
        self.shaped(
            at,
            marker,
            radius_pt,
            Some(Fill::solid(color)),
            [&Stroke::solid(WHITE, 0.35), &Stroke::solid(color, 1.0)],
        );
    }

    /// Draws the outline of a data point about `radius_pt` in radius, which hides nothing below.
    pub fn outlined(&mut self, at: [f64; 2], marker: Marker, radius_pt: f64, color: Rgb) {
        self.shaped(at, marker, radius_pt, None, [&Stroke::solid(color, 1.1); 2]);
    }

    /// Draws a data point: an area with a rim, or strokes.
    fn shaped(
        &mut self,
        at: [f64; 2],
        marker: Marker,
        radius_pt: f64,
        fill: Option<Fill>,
        [rim, stroke]: [&Stroke; 2],
    ) {
        let outline: &[[f64; 2]] = match marker {
            Marker::Circle => return self.circle(at, radius_pt, fill, Some(rim)),
            Marker::Square => &[[-0.88, -0.88], [0.88, -0.88], [0.88, 0.88], [-0.88, 0.88]],
            Marker::Triangle => &[[0.0, -1.2], [1.1, 0.8], [-1.1, 0.8]],
            Marker::Wedge => &[[0.0, 1.2], [1.1, -0.8], [-1.1, -0.8]],
            Marker::Diamond => &[[0.0, -1.3], [1.1, 0.0], [0.0, 1.3], [-1.1, 0.0]],
            Marker::Plus => &[[-1.1, 0.0], [1.1, 0.0], [0.0, -1.1], [0.0, 1.1]],
            Marker::Cross => &[[-0.9, -0.9], [0.9, 0.9], [-0.9, 0.9], [0.9, -0.9]],
        };
        let place = |[x, y]: &[f64; 2]| [at[0] + radius_pt * x, at[1] + radius_pt * y];
        let placed: Vec<[f64; 2]> = outline.iter().map(place).collect();
        if matches!(marker, Marker::Plus | Marker::Cross) {
            placed.chunks_exact(2).for_each(|ends| self.polyline(ends, stroke));
        } else {
            self.polygon(&placed, fill, Some(rim));
        }
    }

    /// Lets [`Canvas::finish`] fail with `error`, unless it already fails with another.
    fn refuse(&mut self, error: RenderError) {
        self.refused.get_or_insert(error);
    }

    /// Draws one line of text.
    pub fn text(&mut self, at: [f64; 2], text: &str, set: &Type) {
        if let Some(found) = font::missing(text, set.weight) {
            self.refuse(RenderError::MissingGlyph { found, text: text.to_owned() });
        }
        let (placed, units) = font::line(text, set.weight);
        let scale = set.size.pt() / UNITS_PER_EM;
        let size = set.size.pt();
        let width = f64::from(units) * scale;
        let back = match set.align {
            Align::Start => 0.0,
            Align::Middle => width / 2.0,
            Align::End => width,
        };
        let drop = match set.stand {
            Stand::Below => CAP_EM * size,
            Stand::Centre => CAP_EM * size / 2.0,
            Stand::Base => 0.0,
        };
        let (top, depth) = font::reach_em(text, set.weight);
        let bounds = Rect { x: -back, y: drop - top * size, w: width, h: (top + depth) * size };
        self.texts.push((text.to_owned(), turned(bounds, at, set.turn_deg)));
        let turn =
            if set.turn_deg == 0.0 { String::new() } else { format!(" rotate({})", short(set.turn_deg)) };
        let place = format!(
            "translate({} {}){turn} translate({} {}) scale({scale:.6})",
            short(at[0]),
            short(at[1]),
            short(-back),
            short(drop)
        );
        let glyphs: Vec<_> = placed.iter().map(|glyph| (glyph.glyph, glyph.x)).collect();
        self.glyph_run(text, &place, &glyphs, set);
    }

    fn glyph_run(&mut self, text: &str, place: &str, glyphs: &[(u16, i32)], set: &Type) {
        let rim = if set.rim {
            let width = (2.0 / (set.size.pt() / UNITS_PER_EM)).round();
            format!(
                " stroke=\"#ffffff\" stroke-width=\"{width}\" stroke-linejoin=\"round\" paint-order=\"stroke\""
            )
        } else {
            String::new()
        };
        let label = vector::escaped(text);
        let fill = set.color.hex();
        let mut uses = String::new();
        for &(glyph, x) in glyphs {
            if !font::outline(glyph, set.weight).is_empty() {
                self.glyphs.insert((set.weight, glyph));
                let id = vector::glyph_id(set.weight, glyph);
                write!(uses, "<use xlink:href=\"#{id}\" x=\"{x}\"/>").expect("a string takes everything");
            }
        }
        self.push(format_args!(
            "<g aria-label=\"{label}\" transform=\"{place}\" fill=\"{fill}\"{rim}>{uses}</g>\n"
        ));
    }

    /// Draws what `draw` draws, cut off at the edges of `window`.
    pub fn clipped(&mut self, window: Rect, draw: impl FnOnce(&mut Self)) {
        let index = self.clips.iter().position(|known| *known == window).unwrap_or_else(|| {
            self.clips.push(window);
            self.clips.len() - 1
        });
        self.push(format_args!("<g clip-path=\"url(#clip{index})\">\n"));
        draw(self);
        self.body.push_str("</g>\n");
    }

    /// Pairs of texts that overlap and texts that leave the page, in words.
    fn flaws(&self) -> Vec<String> {
        let page = self.page();
        let mut flaws = Vec::new();
        for (index, (text, quad)) in self.texts.iter().enumerate() {
            if !quad.iter().all(|&corner| page.contains(corner)) {
                flaws.push(format!("`{text}` leaves the page"));
            }
            for (other, taken) in &self.texts[..index] {
                if overlap(quad, taken) {
                    flaws.push(format!("`{text}` overlaps `{other}`"));
                }
            }
        }
        flaws
    }

    /// The finished figure.
    ///
    /// # Errors
    /// [`RenderError::MissingGlyph`] if a text holds a character that the font lacks;
    /// [`RenderError::TextTooSmall`] if plotters would set one too small; the errors of rasterising ([`RenderError::Svg`], [`RenderError::Size`], [`RenderError::Png`]).
    pub fn finish(self, provenance: &Provenance) -> Result<Figure, RenderError> {
        let flaws = self.flaws();
        if let Some(error) = self.refused {
            return Err(error);
        }
        let mut defs = String::new();
        for (index, clip) in self.clips.iter().enumerate() {
            let (x, y, w, h) = (short(clip.x), short(clip.y), short(clip.w), short(clip.h));
            writeln!(
                defs,
                "<clipPath id=\"clip{index}\"><rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\"/></clipPath>"
            )
            .expect("a string takes everything");
        }
        for &(weight, glyph) in &self.glyphs {
            let id = vector::glyph_id(weight, glyph);
            let path = font::outline(glyph, weight);
            writeln!(defs, "<path id=\"{id}\" d=\"{path}\"/>").expect("a string takes everything");
        }
        let svg = vector::document(self.width.mm(), self.height_pt, &defs, &self.body, provenance);
        let png = vector::png(&svg, provenance)?;
        Ok(Figure { svg, png, flaws })
    }
}

#[cfg(test)]
mod tests;
