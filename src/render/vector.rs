//! The two files of a figure: SVG as drawn, and PNG rasterised from that very SVG at 220 dpi.
//!
//! Print takes the SVG; screens need no more pixels, and pictures are committed.
//! Both carry the command that made them and the hash of the spec behind them. The PNG is indexed when
//! 256 colours describe it to within `palette::TOLERANCE` levels, else plain 8-bit RGB.

use super::RenderError;
use super::font::Weight;
use super::style::HAIR_PT;
use crate::render::palette;
use base::text::shown;
use resvg::tiny_skia::{Color, Pixmap, Transform};
use resvg::usvg;

/// Pixels in an inch of PNG.
pub const DPI: f64 = 220.0;

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

/// `text` with XML's five special characters made harmless, ends of lines as spaces, and characters that act named.
pub(super) fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for character in shown(text).chars() {
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
    let width_pt = width_mm / 25.4 * 72.0;
    let height_mm = height_pt / 72.0 * 25.4;
    let title = escaped(&from.title);
    let command = escaped(&from.command);
    let hash = escaped(&from.spec_hash);
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
    encoded(pixels.data(), width_px, height_px, from)
}

fn encoded(rgba: &[u8], width_px: u32, height_px: u32, from: &Provenance) -> Result<Vec<u8>, RenderError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width_px, height_px);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::High);
    let per_metre = (DPI / 0.0254).round() as u32;
    let xppu = per_metre;
    let yppu = per_metre;
    encoder.set_pixel_dims(Some(png::PixelDimensions { xppu, yppu, unit: png::Unit::Meter }));
    for (key, text) in [("Title", &from.title), ("Software", &from.command), ("Spec-Hash", &from.spec_hash)] {
        encoder.add_itxt_chunk(key.to_owned(), text.clone())?;
    }
    let data = if let Some(indexed) = palette::indexed(rgba) {
        encoder.set_color(png::ColorType::Indexed);
        encoder.set_filter(png::Filter::NoFilter);
        encoder.set_palette(indexed.palette);
        indexed.pixels
    } else {
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_filter(png::Filter::Adaptive);
        palette::opaque(rgba)
    };
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&data)?;
    writer.finish()?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_of_too_many_colours_is_written_as_it_is() {
        let level = |step: u32| (step % 16 * 17) as u8;
        let all: Vec<[u8; 3]> = (0..4096).map(|n| [level(n), level(n / 16), level(n / 256)]).collect();
        let rgba: Vec<u8> = all.iter().flat_map(|[red, green, blue]| [*red, *green, *blue, 255]).collect();
        let bytes = encoded(
            &rgba,
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
