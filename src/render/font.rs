//! The embedded font: widths and outlines of `DejaVu Sans`.
//!
//! Text is measured and outlined here, with the font's own kerning, so that it looks the same on a
//! machine without fonts. Lengths come in ems; outlines in font units, [`UNITS_PER_EM`] to the em, y down.

use std::fmt::Write as _;
use std::sync::OnceLock;
use ttf_parser::{Face, GlyphId, OutlineBuilder};

/// Font units in one em of `DejaVu Sans`.
pub const UNITS_PER_EM: f64 = 2048.0;
/// Height of a capital letter, in ems.
pub const CAP_EM: f64 = 0.729;
/// Distance from baseline to baseline, in ems.
pub const LINE_EM: f64 = 1.25;

/// Weight of the type.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Weight {
    /// Text.
    Regular,
    /// Titles and panel letters.
    Bold,
}

/// One glyph on its line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Placed {
    /// Index in the font.
    pub glyph: u16,
    /// Distance from the start of the line, font units.
    pub x: i32,
}

fn face(weight: Weight) -> &'static Face<'static> {
    static FACES: [OnceLock<Face<'static>>; 2] = [OnceLock::new(), OnceLock::new()];
    let data = match weight {
        Weight::Regular => dejavu::sans::regular(),
        Weight::Bold => dejavu::sans::bold(),
    };
    FACES[weight as usize].get_or_init(|| Face::parse(data, 0).expect("the embedded font is well formed"))
}

/// The first character of `text` that the font cannot draw.
pub(super) fn missing(text: &str, weight: Weight) -> Option<char> {
    text.chars().find(|&found| face(weight).glyph_index(found).is_none())
}

fn kerning(face: &Face<'_>, left: GlyphId, right: GlyphId) -> i32 {
    let Some(kern) = face.tables().kern else { return 0 };
    let subtables = kern.subtables.into_iter().filter(|table| table.horizontal && !table.has_state_machine);
    subtables.filter_map(|table| table.glyphs_kerning(left, right)).map(i32::from).sum()
}

/// Glyphs of one line of text and its width in font units; unknown characters become the font's box.
pub(super) fn line(text: &str, weight: Weight) -> (Vec<Placed>, i32) {
    let face = face(weight);
    let mut x = 0;
    let mut last = None;
    let mut placed = Vec::new();
    for character in text.chars() {
        let glyph = face.glyph_index(character).unwrap_or(GlyphId(0));
        x += last.map_or(0, |left| kerning(face, left, glyph));
        placed.push(Placed { glyph: glyph.0, x });
        x += i32::from(face.glyph_hor_advance(glyph).unwrap_or(0));
        last = Some(glyph);
    }
    (placed, x)
}

/// Width of one line of text at one point of size, kerning included.
pub fn width_em(text: &str, weight: Weight) -> f64 {
    f64::from(line(text, weight).1) / UNITS_PER_EM
}

/// How far the ink of `text` reaches above and below its baseline, in ems.
pub(super) fn reach_em(text: &str, weight: Weight) -> (f64, f64) {
    let face = face(weight);
    let boxes = text.chars().filter_map(|found| face.glyph_bounding_box(face.glyph_index(found)?));
    let (top, bottom) = boxes.fold((0, 0), |(top, bottom), ink| (ink.y_max.max(top), ink.y_min.min(bottom)));
    (f64::from(top) / UNITS_PER_EM, -f64::from(bottom) / UNITS_PER_EM)
}

/// Writes an outline relative to where the pen is, which takes fewer digits; glyphs are a sixth of what figures weigh.
#[derive(Default)]
struct PathWriter {
    path: String,
    pen: [f32; 2],
    start: [f32; 2],
    /// Where in the path a line back to the start begins; closing the outline draws it anyway.
    last_line: Option<usize>,
}

impl PathWriter {
    /// Adds a command and the points it goes through; the pen stays at the last.
    fn go<const N: usize>(&mut self, command: char, points: [[f32; 2]; N]) {
        let [x, y] = self.pen;
        self.last_line = None;
        self.path.push(command);
        self.numbers(points.iter().flat_map(|[to_x, to_y]| [to_x - x, to_y - y]));
        self.pen = points[N - 1];
    }

    fn straight(&mut self, command: char, by: f32) {
        self.path.push(command);
        self.numbers([by].into_iter());
    }

    /// Adds numbers; a sign parts them as well as a space does.
    fn numbers(&mut self, numbers: impl Iterator<Item = f32>) {
        for (place, number) in numbers.enumerate() {
            let space = if place == 0 || number < 0.0 { "" } else { " " };
            // Zero has no sign.
            write!(self.path, "{space}{}", number + 0.0).expect("a string takes everything");
        }
    }
}

impl OutlineBuilder for PathWriter {
    fn move_to(&mut self, x: f32, y: f32) {
        self.go('m', [[x, -y]]);
        self.start = self.pen;
    }
    fn line_to(&mut self, x: f32, y: f32) {
        let length = self.path.len();
        let [from_x, from_y] = self.pen;
        let y = -y;
        match (x == from_x, y == from_y) {
            (true, _) => self.straight('v', y - from_y),
            (_, true) => self.straight('h', x - from_x),
            _ => self.go('l', [[x, y]]),
        }
        self.pen = [x, y];
        self.last_line = (self.pen == self.start).then_some(length);
    }
    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        self.go('q', [[x1, -y1], [x, -y]]);
    }
    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.go('c', [[x1, -y1], [x2, -y2], [x, -y]]);
    }
    fn close(&mut self) {
        if let Some(length) = self.last_line.take() {
            self.path.truncate(length);
        }
        self.path.push('z');
        self.pen = self.start;
    }
}

/// Outline of a glyph as SVG path data; empty for a space.
pub(super) fn outline(glyph: u16, weight: Weight) -> String {
    let mut writer = PathWriter::default();
    let _blank_if_none = face(weight).outline_glyph(GlyphId(glyph), &mut writer);
    writer.path
}

/// `text` broken at spaces, but at no thin ones, into lines of at most `most_em`; a longer word keeps a line of its own.
pub fn wrapped(text: &str, weight: Weight, most_em: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split(' ').filter(|word| !word.is_empty()) {
        if let Some(last) = lines.last_mut() {
            let longer = format!("{last} {word}");
            if width_em(&longer, weight) <= most_em {
                *last = longer;
                continue;
            }
        }
        lines.push(word.to_owned());
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_font_has_every_sign_that_figures_use() {
        let signs = "θρδπαβφμΔΣ°√−×·±≤≥≠→∞½₀₁₂₃₄₅₆₇₈₉⁰¹²³⁴⁵⁶⁷⁸⁹⁻…–—′″‖∈\u{2009}";
        for weight in [Weight::Regular, Weight::Bold] {
            assert_eq!(missing(signs, weight), None);
        }
        assert_eq!(missing("a\u{4e00}", Weight::Regular), Some('\u{4e00}'));
    }

    #[test]
    fn outlines_are_relative_and_close_without_a_line() {
        let dash = line("-", Weight::Regular).0[0].glyph;
        // DejaVu Sans draws it from (100, 643) to (639, 479).
        assert_eq!(outline(dash, Weight::Regular), "m100-643h539v164h-539z");
    }

    #[test]
    fn widths_are_the_fonts_advances_less_its_kerning() {
        // Advances printed in DejaVu Sans' hmtx table: zero 1303, A 1401, V 1401.
        assert_eq!(line("0", Weight::Regular).1, 1303);
        let apart = line("A", Weight::Regular).1 + line("V", Weight::Regular).1;
        assert_eq!(apart, 2802);
        assert!(line("AV", Weight::Regular).1 < apart, "A and V are kerned");
    }

    #[test]
    fn wrapping_keeps_every_word_and_the_width() {
        let text = "path length of the improved search against the original one";
        let lines = wrapped(text, Weight::Regular, 14.0);
        assert_eq!(lines.join(" "), text);
        assert!(lines.len() > 2, "{lines:?}");
        assert!(lines.iter().all(|line| width_em(line, Weight::Regular) <= 14.0), "{lines:?}");
        assert_eq!(
            wrapped("after 72\u{2009}% of it", Weight::Regular, 3.0),
            ["after", "72\u{2009}%", "of it"]
        );
    }
}
