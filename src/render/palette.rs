//! The colours of a picture: the few that can stand for all.

use std::collections::BTreeMap;

/// Largest change of a colour level that a palette may make.
pub const TOLERANCE: u8 = 20;

/// A picture in at most 256 colours.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Indexed {
    /// Red, green and blue of each colour kept, one after another.
    pub palette: Vec<u8>,
    /// For each pixel its place in the palette.
    pub pixels: Vec<u8>,
}

/// Red, green and blue of every pixel of `rgba`.
pub fn opaque(rgba: &[u8]) -> Vec<u8> {
    rgba.as_chunks::<4>().0.iter().flat_map(|[red, green, blue, _]| [*red, *green, *blue]).collect()
}

/// The picture in `rgba` with at most 256 colours, each pixel with the one that stands for its own.
///
/// The commonest colours are kept as they are; the rest go to the first kept one near enough. The
/// tolerance grows until 256 suffice; none if they do not within [`TOLERANCE`].
pub fn indexed(rgba: &[u8]) -> Option<Indexed> {
    let runs = runs(rgba);
    let mut counts = BTreeMap::<u32, usize>::new();
    for (color, pixels) in &runs {
        *counts.entry(*color).or_default() += pixels;
    }
    let mut common: Vec<(u32, usize)> = counts.into_iter().collect();
    common.sort_by_key(|&(color, count)| (std::cmp::Reverse(count), color));
    let (kept, index) = (0..=TOLERANCE).step_by(2).find_map(|tolerance| within(&common, tolerance))?;
    let mut pixels = Vec::with_capacity(rgba.len() / 4);
    for (color, count) in runs {
        pixels.resize(pixels.len() + count, index[&color]);
    }
    Some(Indexed { palette: kept.concat(), pixels })
}

/// Pixels that are compared at once; where they differ, the second number of them.
const BLOCKS: [usize; 2] = [64, 8];

/// Runs of equal colours, as one number each. A figure is mostly paper, and whether a block is of one colour is a question for
/// its bytes at once, which is quick however this is compiled.
fn runs(rgba: &[u8]) -> Vec<(u32, usize)> {
    let mut runs: Vec<(u32, usize)> = Vec::new();
    let mut add = |pixels: &[u8]| {
        let color = color(pixels);
        let count = pixels.len() / 4;
        match runs.last_mut() {
            Some((last, known)) if *last == color => *known += count,
            _ => runs.push((color, count)),
        }
    };
    for block in rgba.chunks(4 * BLOCKS[0]) {
        if is_uniform(block) {
            add(block);
            continue;
        }
        for part in block.chunks(4 * BLOCKS[1]) {
            if is_uniform(part) { add(part) } else { part.chunks(4).for_each(&mut add) }
        }
    }
    runs
}

/// Whether all pixels are equal: each is then equal to the one before.
fn is_uniform(pixels: &[u8]) -> bool {
    pixels[4..] == pixels[..pixels.len() - 4]
}

/// Red, green and blue of the first pixel as one number, red first.
fn color(pixels: &[u8]) -> u32 {
    u32::from_be_bytes([0, pixels[0], pixels[1], pixels[2]])
}

type Kept = (Vec<[u8; 3]>, BTreeMap<u32, u8>);

fn within(common: &[(u32, usize)], tolerance: u8) -> Option<Kept> {
    let (mut kept, mut index): Kept = (Vec::new(), BTreeMap::new());
    let near = |a: &[u8; 3], b: &[u8; 3]| a.iter().zip(b).all(|(a, b)| a.abs_diff(*b) <= tolerance);
    for (color, _) in common {
        let [_, levels @ ..] = color.to_be_bytes();
        let slot = if let Some(slot) = kept.iter().position(|known| near(known, &levels)) {
            slot
        } else if kept.len() > usize::from(u8::MAX) {
            return None;
        } else {
            kept.push(levels);
            kept.len() - 1
        };
        index.insert(*color, u8::try_from(slot).ok()?);
    }
    Some((kept, index))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rgba(colors: &[[u8; 3]]) -> Vec<u8> {
        colors.iter().flat_map(|[red, green, blue]| [*red, *green, *blue, 255]).collect()
    }

    #[test]
    fn runs_hold_every_pixel_in_order_and_neighbours_differ() {
        let shades = (0..1000_u32).map(|n| if n < 300 { 7 } else { (n / 3 % 5) as u8 });
        let colors: Vec<[u8; 3]> = shades.map(|shade| [shade, 0, 1]).collect();
        let found = runs(&rgba(&colors));
        let unrolled = found.iter().flat_map(|(color, count)| std::iter::repeat_n(*color, *count));
        assert!(unrolled.eq(colors.iter().map(|[r, g, b]| u32::from_be_bytes([0, *r, *g, *b]))));
        assert_eq!(found[0].1, 300, "blocks of one colour are one run");
        assert!(found.windows(2).all(|pair| pair[0].0 != pair[1].0));
    }

    #[test]
    fn a_palette_keeps_common_colours_and_moves_none_further_than_the_tolerance() {
        let ramp: Vec<[u8; 3]> = (0..=255_u8).flat_map(|red| [[red, 90, 10], [red, 90, 14]]).collect();
        let plain = vec![[213, 94, 0]; 1000];
        let colors = [plain, ramp].concat();
        let Indexed { palette, pixels } = indexed(&rgba(&colors)).unwrap();
        assert!(palette.len() <= 3 * 256 && palette[..3] == [213, 94, 0]);
        assert_eq!(pixels.len(), colors.len());
        for (color, slot) in colors.iter().zip(pixels) {
            let drawn = &palette[3 * usize::from(slot)..][..3];
            assert!(color.iter().zip(drawn).all(|(a, b)| a.abs_diff(*b) <= TOLERANCE), "{color:?}");
        }
    }

    #[test]
    fn a_picture_of_too_many_colours_gets_no_palette() {
        let level = |step: u8| step % 16 * 17;
        let rows = (0..16).flat_map(|red| (0..=255).map(move |n| [level(red), level(n), level(n / 16)]));
        assert_eq!(indexed(&rgba(&rows.collect::<Vec<_>>())), None);
    }

    #[test]
    fn opacity_is_left_out() {
        assert_eq!(opaque(&[1, 2, 3, 255, 4, 5, 6, 0]), [1, 2, 3, 4, 5, 6]);
    }
}
