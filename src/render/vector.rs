//! The two files of a figure: SVG as drawn, and PNG rasterised from that very SVG at 220 dpi.
//!
//! Print takes the SVG; screens need no more pixels, and pictures are committed.
//! Both carry the command that made them and the hash of the spec behind them. The PNG is indexed when
//! 256 colours describe it to within [`PALETTE_TOLERANCE`] levels, else plain 8-bit RGB.

use super::RenderError;
use super::font::Weight;
use super::style::HAIR_PT;
use resvg::tiny_skia::{Color, Pixmap, Transform};
use resvg::usvg;
use std::collections::BTreeMap;

/// Pixels in an inch of PNG.
pub const DPI: f64 = 220.0;

/// Largest change of a colour level that an indexed PNG may make.
pub const PALETTE_TOLERANCE: u8 = 20;

/// What a figure says about its own making.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Provenance {
    /// The command that draws the figure again.
    pub command: String,
    /// Hash of the spec behind it.
    pub spec_hash: String,
    /// What the figure shows, in a sentence.
    pub title: String,
}

/// A figure as files.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Figure {
    /// Scalable, text as outlines.
    pub svg: String,
    /// Rasterised at [`DPI`].
    pub png: Vec<u8>,
    /// Labels that overlap or leave the page, in words; empty for a figure fit to print.
    pub flaws: Vec<String>,
}

/// `text` with XML's five special characters and control characters made harmless.
pub(super) fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '&' => safe.push_str("&amp;"),
            '"' => safe.push_str("&quot;"),
            '\'' => safe.push_str("&apos;"),
            control if control.is_control() => safe.push(' '),
            other => safe.push(other),
        }
    }
    safe
}

pub(super) fn glyph_id(weight: Weight, glyph: u16) -> String {
    match weight {
        Weight::Regular => format!("r{glyph}"),
        Weight::Bold => format!("b{glyph}"),
    }
}

/// The SVG document around `body`; its user unit is the point.
pub(super) fn document(width_mm: f64, height_pt: f64, defs: &str, body: &str, from: &Provenance) -> String {
    let (width_pt, height_mm) = (width_mm / 25.4 * 72.0, height_pt / 72.0 * 25.4);
    let (title, command, hash) = (escaped(&from.title), escaped(&from.command), escaped(&from.spec_hash));
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" \
         width=\"{width_mm}mm\" height=\"{height_mm:.3}mm\" viewBox=\"0 0 {width_pt:.3} {height_pt:.3}\">\n\
         <title>{title}</title>\n\
         <desc>made by `{command}` from the spec with hash {hash}</desc>\n\
         <metadata><replan xmlns=\"urn:replan\" command=\"{command}\" spec-hash=\"{hash}\"/></metadata>\n\
         <defs>\n{defs}</defs>\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n\
         <g stroke-linejoin=\"round\" stroke-width=\"{HAIR_PT}\">\n{body}</g>\n</svg>\n"
    )
}

/// The SVG as PNG at [`DPI`].
pub(super) fn png(svg: &str, from: &Provenance) -> Result<Vec<u8>, RenderError> {
    let tree = usvg::Tree::from_str(svg, &usvg::Options { dpi: 72.0, ..usvg::Options::default() })?;
    let scale = (DPI / 72.0) as f32;
    let (width_px, height_px) =
        ((tree.size().width() * scale).round() as u32, (tree.size().height() * scale).round() as u32);
    let mut pixels = Pixmap::new(width_px, height_px).ok_or(RenderError::Size { width_px, height_px })?;
    pixels.fill(Color::WHITE);
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixels.as_mut());
    let colors: Vec<[u8; 3]> =
        pixels.pixels().iter().map(|pixel| [pixel.red(), pixel.green(), pixel.blue()]).collect();
    encoded(&colors, width_px, height_px, from)
}

fn encoded(
    colors: &[[u8; 3]],
    width_px: u32,
    height_px: u32,
    from: &Provenance,
) -> Result<Vec<u8>, RenderError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width_px, height_px);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::High);
    let per_metre = (DPI / 0.0254).round() as u32;
    let (xppu, yppu) = (per_metre, per_metre);
    encoder.set_pixel_dims(Some(png::PixelDimensions { xppu, yppu, unit: png::Unit::Meter }));
    for (key, text) in [("Title", &from.title), ("Software", &from.command), ("Spec-Hash", &from.spec_hash)] {
        encoder.add_itxt_chunk(key.to_owned(), text.clone())?;
    }
    let data = if let Some((palette, index)) = palette(colors) {
        encoder.set_color(png::ColorType::Indexed);
        encoder.set_filter(png::Filter::NoFilter);
        encoder.set_palette(palette.concat());
        runs(colors).flat_map(|run| std::iter::repeat_n(index[&run[0]], run.len())).collect()
    } else {
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_filter(png::Filter::Adaptive);
        colors.concat()
    };
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&data)?;
    writer.finish()?;
    Ok(bytes)
}

/// Runs of equal colours; a figure is mostly paper, so maps are asked once a run and not once a pixel.
fn runs(colors: &[[u8; 3]]) -> impl Iterator<Item = &[[u8; 3]]> {
    colors.chunk_by(|a, b| a == b)
}

type Palette = (Vec<[u8; 3]>, BTreeMap<[u8; 3], u8>);

/// At most 256 colours, and for each colour that occurs the one that stands for it.
///
/// The commonest colours are kept as they are; the rest go to the first kept one near enough. The
/// tolerance grows until 256 suffice.
fn palette(colors: &[[u8; 3]]) -> Option<Palette> {
    let mut counts: BTreeMap<[u8; 3], usize> = BTreeMap::new();
    for run in runs(colors) {
        *counts.entry(run[0]).or_default() += run.len();
    }
    let mut common: Vec<([u8; 3], usize)> = counts.into_iter().collect();
    common.sort_by_key(|&(color, count)| (std::cmp::Reverse(count), color));
    (0..=PALETTE_TOLERANCE).step_by(2).find_map(|tolerance| palette_within(&common, tolerance))
}

fn palette_within(common: &[([u8; 3], usize)], tolerance: u8) -> Option<Palette> {
    let (mut kept, mut index): Palette = (Vec::new(), BTreeMap::new());
    let near = |a: &[u8; 3], b: &[u8; 3]| a.iter().zip(b).all(|(a, b)| a.abs_diff(*b) <= tolerance);
    for (color, _) in common {
        let slot = if let Some(slot) = kept.iter().position(|known| near(known, color)) {
            slot
        } else {
            kept.push(*color);
            kept.len() - 1
        };
        index.insert(*color, u8::try_from(slot).ok()?);
    }
    Some((kept, index))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_palette_keeps_common_colours_and_moves_none_further_than_the_tolerance() {
        let ramp: Vec<[u8; 3]> = (0..=255_u8).flat_map(|red| [[red, 90, 10], [red, 90, 14]]).collect();
        let plain = vec![[213, 94, 0]; 1000];
        let colors = [plain, ramp].concat();
        let (kept, index) = palette(&colors).unwrap();
        assert!(kept.len() <= 256 && kept[0] == [213, 94, 0]);
        for color in &colors {
            let drawn = kept[usize::from(index[color])];
            assert!(color.iter().zip(drawn).all(|(a, b)| a.abs_diff(b) <= PALETTE_TOLERANCE), "{color:?}");
        }
    }

    #[test]
    fn a_picture_of_too_many_colours_gets_no_palette() {
        let level = |step: u32| (step % 16 * 17) as u8;
        let all: Vec<[u8; 3]> = (0..4096).map(|n| [level(n), level(n / 16), level(n / 256)]).collect();
        assert!(palette(&all).is_none());
        let bytes = encoded(
            &all,
            64,
            64,
            &Provenance { command: "x".into(), spec_hash: "0".into(), title: "t".into() },
        );
        let bytes = bytes.unwrap();
        let mut reader = png::Decoder::new(std::io::Cursor::new(&bytes)).read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut pixels).unwrap();
        assert_eq!(pixels, all.concat());
    }
}
