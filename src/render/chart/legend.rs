//! The legend: a flow of swatches and labels below the panels.

use crate::render::canvas::{Align, Canvas, Rect, Stand, Type};
use crate::render::style::{Fill, Marker, Rgb, Stroke, TextSize, WHITE};

/// What stands before a label in the legend.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Swatch {
    /// A line, perhaps with a marker on it.
    Line(Stroke, Option<(Marker, Rgb)>),
    /// A marker alone.
    Point(Marker, Rgb),
    /// A filled box, perhaps with an edge.
    Area(Fill, Option<Stroke>),
}

/// One entry of the legend.
#[derive(Clone, Debug, PartialEq)]
pub struct Key {
    /// What it looks like.
    pub swatch: Swatch,
    /// What it means.
    pub label: String,
}

impl Key {
    /// A line.
    pub fn line(label: &str, stroke: Stroke) -> Self {
        Self { swatch: Swatch::Line(stroke, None), label: label.to_owned() }
    }

    /// An entry with this label, if there is one.
    pub(super) fn labelled(label: &str, swatch: Swatch) -> Vec<Self> {
        if label.is_empty() { Vec::new() } else { vec![Self { swatch, label: label.to_owned() }] }
    }
}

const SWATCH_PT: f64 = 20.0;
const GAP_PT: f64 = 4.0;
const APART_PT: f64 = 12.0;
/// Height of one line of the legend.
const LINE_PT: f64 = 11.0;

fn entry_width(key: &Key) -> f64 {
    SWATCH_PT + GAP_PT + Type::regular(TextSize::LABEL).width_pt(&key.label)
}

/// Entries per line on a page `width_pt` wide: as few lines as fit with half a gap at either edge, evenly filled.
fn lines(keys: &[Key], width_pt: f64) -> Vec<&[Key]> {
    let fits = |row: &[Key]| {
        let entries: f64 = row.iter().map(entry_width).sum();
        entries + APART_PT * row.len().saturating_sub(1) as f64 <= width_pt - APART_PT
    };
    let counts = 1..=keys.len();
    let count = counts.clone().find(|count| keys.chunks(keys.len().div_ceil(*count)).all(fits));
    let per_line = keys.len().div_ceil(count.unwrap_or(keys.len()).max(1)).max(1);
    keys.chunks(per_line).collect()
}

/// Height of the legend of `keys` on a page `width_pt` wide; 0 without keys.
pub(super) fn height_pt(keys: &[Key], width_pt: f64) -> f64 {
    if keys.is_empty() { 0.0 } else { lines(keys, width_pt).len() as f64 * LINE_PT + 3.0 }
}

/// Draws the legend of `keys` centred in `room`, columns aligned if it takes several lines.
pub(super) fn draw(canvas: &mut Canvas, keys: &[Key], room: Rect) {
    let lines = lines(keys, room.w);
    let columns = lines.first().map_or(0, |line| line.len());
    let mut widths = vec![0.0_f64; columns];
    for line in &lines {
        for (width, key) in widths.iter_mut().zip(*line) {
            *width = width.max(entry_width(key));
        }
    }
    let total: f64 = widths.iter().sum::<f64>() + APART_PT * columns.saturating_sub(1) as f64;
    let aligned = total <= room.w;
    for (row, line) in lines.iter().enumerate() {
        let own: f64 = line.iter().map(entry_width).sum::<f64>() + APART_PT * (line.len() - 1) as f64;
        let mut x = room.x + (room.w - if aligned { total } else { own }) / 2.0;
        let y = room.y + 3.0 + LINE_PT * (row as f64 + 0.5);
        for (column, key) in line.iter().enumerate() {
            swatch(canvas, &key.swatch, [x, y]);
            let set = Type::regular(TextSize::LABEL).aligned(Align::Start, Stand::Centre);
            canvas.text([x + SWATCH_PT + GAP_PT, y], &key.label, &set);
            x += APART_PT + if aligned { widths[column] } else { entry_width(key) };
        }
    }
}

fn swatch(canvas: &mut Canvas, swatch: &Swatch, [x, y]: [f64; 2]) {
    let ends = [[x, y], [x + SWATCH_PT, y]];
    let middle = [x + SWATCH_PT / 2.0, y];
    let area = Rect { x: x + 3.0, y: y - 3.5, w: SWATCH_PT - 6.0, h: 7.0 };
    match swatch {
        Swatch::Line(stroke, marker) => {
            canvas.polyline(&ends, stroke);
            if let Some((marker, color)) = marker {
                canvas.marker(middle, *marker, 2.4, *color);
            }
        }
        Swatch::Point(marker, color) => canvas.marker(middle, *marker, 2.4, *color),
        Swatch::Area(fill, stroke) => canvas.rect(area, Some(*fill), stroke.as_ref()),
    }
}

/// A filled box in the colour of a raster cell, with an edge if it is nearly white.
pub fn cell_key(label: impl Into<String>, color: Rgb) -> Key {
    let pale = color.luminance() > 0.8 * WHITE.luminance();
    let edge = pale.then(|| Stroke::solid(crate::render::style::GREY, 0.5));
    Key { swatch: Swatch::Area(Fill::solid(color), edge), label: label.into() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::style::{BLUE, Width};

    fn keys(count: usize) -> Vec<Key> {
        let entry = |index| cell_key(format!("contender number {index}"), BLUE);
        (0..count).map(entry).collect()
    }

    #[test]
    fn every_entry_stays_on_the_page() {
        for count in 1..12 {
            let keys = keys(count);
            let width = Width::Single.pt() - 8.0;
            let broken = lines(&keys, width);
            assert_eq!(broken.iter().map(|line| line.len()).sum::<usize>(), count);
            for line in &broken {
                let taken: f64 =
                    line.iter().map(entry_width).sum::<f64>() + APART_PT * (line.len() - 1) as f64;
                assert!(taken <= width, "{count} entries: a line of {taken} pt");
            }
            assert_eq!(height_pt(&keys, width), 3.0 + LINE_PT * broken.len() as f64);
        }
        assert!(lines(&keys(11), Width::Single.pt()).len() > 1, "the sample must break a line");
    }
}
