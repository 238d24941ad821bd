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
pub fn opaque(rgba: &[u8]) -> Vec<[u8; 3]> {
    rgba.as_chunks::<4>().0.iter().map(|[red, green, blue, _]| [*red, *green, *blue]).collect()
}

/// The picture with at most 256 colours, each pixel with the one that stands for its own.
///
/// The commonest colours are kept as they are; the rest go to the first kept one near enough. The
/// tolerance grows until 256 suffice; none if they do not within [`TOLERANCE`].
pub fn indexed(colors: &[[u8; 3]]) -> Option<Indexed> {
    let mut counts: BTreeMap<[u8; 3], usize> = BTreeMap::new();
    for run in runs(colors) {
        *counts.entry(run[0]).or_default() += run.len();
    }
    let mut common: Vec<([u8; 3], usize)> = counts.into_iter().collect();
    common.sort_by_key(|&(color, count)| (std::cmp::Reverse(count), color));
    let (kept, index) = (0..=TOLERANCE).step_by(2).find_map(|tolerance| within(&common, tolerance))?;
    let pixels = runs(colors).flat_map(|run| std::iter::repeat_n(index[&run[0]], run.len())).collect();
    Some(Indexed { palette: kept.concat(), pixels })
}

/// Runs of equal colours; a figure is mostly paper, so maps are asked once a run and not once a pixel.
fn runs(colors: &[[u8; 3]]) -> impl Iterator<Item = &[[u8; 3]]> {
    colors.chunk_by(|a, b| a == b)
}

type Kept = (Vec<[u8; 3]>, BTreeMap<[u8; 3], u8>);

fn within(common: &[([u8; 3], usize)], tolerance: u8) -> Option<Kept> {
    let (mut kept, mut index): Kept = (Vec::new(), BTreeMap::new());
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
        let Indexed { palette, pixels } = indexed(&colors).unwrap();
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
        assert_eq!(indexed(&rows.collect::<Vec<_>>()), None);
    }

    #[test]
    fn opacity_is_left_out() {
        assert_eq!(opaque(&[1, 2, 3, 255, 4, 5, 6, 0]), [[1, 2, 3], [4, 5, 6]]);
    }
}
