//! Colours, strokes and sizes that every figure shares.
//!
//! Lengths are points (1/72 inch). Series differ in colour, in grey and in dash or marker, so that a
//! figure survives a photocopy and any common colour blindness.

use super::RenderError;

/// An opaque sRGB colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Rgb(pub [u8; 3]);

/// Black ink.
pub const BLACK: Rgb = Rgb([0, 0, 0]);
/// Paper.
pub const WHITE: Rgb = Rgb([255, 255, 255]);
/// Okabe–Ito orange.
pub const ORANGE: Rgb = Rgb([230, 159, 0]);
/// Okabe–Ito sky blue.
pub const SKY: Rgb = Rgb([86, 180, 233]);
/// Okabe–Ito bluish green.
pub const GREEN: Rgb = Rgb([0, 158, 115]);
/// Okabe–Ito yellow; for fills only, it is too light for lines on white.
pub const YELLOW: Rgb = Rgb([240, 228, 66]);
/// Okabe–Ito blue.
pub const BLUE: Rgb = Rgb([0, 114, 178]);
/// Okabe–Ito vermillion.
pub const VERMILLION: Rgb = Rgb([213, 94, 0]);
/// Okabe–Ito reddish purple.
pub const PURPLE: Rgb = Rgb([204, 121, 167]);
/// Axes, ticks and their text.
pub const INK: Rgb = Rgb([38, 38, 38]);
/// What stands back: secondary text, obstacles, reference lines.
pub const GREY: Rgb = Rgb([120, 120, 120]);
/// Grid lines.
pub const GRID: Rgb = Rgb([224, 224, 224]);

/// Colours of series, in the order they are given out.
///
/// Neighbours (also last and first) differ in relative luminance by [`SERIES_MARGIN`].
///
/// # Source
/// Okabe & Ito, *Color Universal Design* (2008); yellow is left out.
pub const SERIES: [Rgb; 7] = [BLUE, ORANGE, GREEN, SKY, VERMILLION, BLACK, PURPLE];

/// Least difference of relative luminance between neighbours in [`SERIES`].
pub const SERIES_MARGIN: f64 = 0.12;

impl Rgb {
    /// Relative luminance in `[0, 1]`, the grey that a photocopy shows.
    ///
    /// # Source
    /// WCAG 2.1, "relative luminance".
    pub fn luminance(self) -> f64 {
        let [r, g, b] = self.0.map(|level| {
            let share = f64::from(level) / 255.0;
            if share <= 0.04045 { share / 12.92 } else { libm::pow((share + 0.055) / 1.055, 2.4) }
        });
        0.2126 * r + 0.7152 * g + 0.0722 * b
    }

    /// The colour `share` of the way from `self` (0) to `other` (1), mixed in sRGB.
    #[must_use]
    pub const fn mixed(self, other: Self, share: f64) -> Self {
        let [r, g, b] = self.0;
        let ends = other.0;
        Self([between(r, ends[0], share), between(g, ends[1], share), between(b, ends[2], share)])
    }

    /// The colour as `#rrggbb`.
    pub fn hex(self) -> String {
        let [r, g, b] = self.0;
        format!("#{r:02x}{g:02x}{b:02x}")
    }
}

/// The level `share` of the way from one to another.
const fn between(from: u8, to: u8, share: f64) -> u8 {
    (from as f64 * (1.0 - share) + to as f64 * share).round() as u8
}

/// How a line is broken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dash {
    /// Unbroken.
    Solid,
    /// Even dashes.
    Dashed,
    /// Dots.
    Dotted,
    /// Dash, dot.
    DashDot,
    /// Long dashes, short gaps.
    Long,
}

impl Dash {
    /// Lengths of ink and gap in turn, in line widths; empty for a solid line.
    pub fn pattern(self) -> &'static [f64] {
        match self {
            Self::Solid => &[],
            Self::Dashed => &[4.0, 2.5],
            Self::Dotted => &[1.0, 2.0],
            Self::DashDot => &[5.0, 2.0, 1.0, 2.0],
            Self::Long => &[9.0, 2.5],
        }
    }
}

/// Shape of a data point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Marker {
    /// Disc.
    Circle,
    /// Square on its side.
    Square,
    /// Triangle pointing up.
    Triangle,
    /// Square on its corner.
    Diamond,
    /// Triangle pointing down.
    Wedge,
    /// Upright cross of two strokes.
    Plus,
    /// Diagonal cross of two strokes.
    Cross,
}

const DASHES: [Dash; 5] = [Dash::Solid, Dash::Dashed, Dash::DashDot, Dash::Dotted, Dash::Long];
const MARKERS: [Marker; 7] = [
    Marker::Circle,
    Marker::Square,
    Marker::Triangle,
    Marker::Diamond,
    Marker::Wedge,
    Marker::Cross,
    Marker::Plus,
];

/// Colour of series `index`; [`SERIES`] over and over.
pub fn series_color(index: usize) -> Rgb {
    SERIES[index % SERIES.len()]
}

/// Marker of series `index`.
pub fn series_marker(index: usize) -> Marker {
    MARKERS[index % MARKERS.len()]
}

/// Line of series `index`: with [`series_color`] no two of the first 35 are equal.
pub fn series_stroke(index: usize) -> Stroke {
    Stroke { dash: DASHES[index % DASHES.len()], ..Stroke::solid(series_color(index), 1.1) }
}

/// Width of the line that closes seams between faces; the page's default, so that it costs no bytes.
pub const HAIR_PT: f64 = 0.25;

/// How a line is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    /// Ink.
    pub color: Rgb,
    /// Width in points.
    pub width_pt: f64,
    /// How it is broken.
    pub dash: Dash,
    /// 1 covers what lies below.
    pub opacity: f64,
}

impl Stroke {
    /// An unbroken opaque line.
    pub const fn solid(color: Rgb, width_pt: f64) -> Self {
        Self { color, width_pt, dash: Dash::Solid, opacity: 1.0 }
    }

    /// The same line, broken.
    #[must_use]
    pub const fn dashed(self, dash: Dash) -> Self {
        Self { dash, ..self }
    }
}

/// How a surface is filled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fill {
    /// Ink.
    pub color: Rgb,
    /// 1 covers what lies below.
    pub opacity: f64,
}

impl Fill {
    /// A fill that covers what lies below.
    pub const fn solid(color: Rgb) -> Self {
        Self { color, opacity: 1.0 }
    }

    /// A fill that lets what lies below show through.
    pub const fn sheer(color: Rgb, opacity: f64) -> Self {
        Self { color, opacity }
    }
}

/// Width of a figure on the page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Width {
    /// One column of a two-column page, 85 mm.
    Single,
    /// Both columns, 174 mm.
    Double,
}

impl Width {
    /// The width in millimetres.
    pub fn mm(self) -> f64 {
        match self {
            Self::Single => 85.0,
            Self::Double => 174.0,
        }
    }

    /// The width in points.
    pub fn pt(self) -> f64 {
        self.mm() / 25.4 * 72.0
    }
}

/// A text size that can be read in print.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct TextSize(f64);

impl TextSize {
    /// Ticks, notes and labels inside a plot.
    pub const TICK: Self = Self(7.0);
    /// Axis labels, legend, panel titles.
    pub const LABEL: Self = Self(8.0);
    /// Title of a sheet.
    pub const TITLE: Self = Self(9.0);

    /// A size of `pt` points.
    ///
    /// # Errors
    /// [`RenderError::TextTooSmall`] below 7 pt or if `pt` is not a number.
    pub fn new(pt: f64) -> Result<Self, RenderError> {
        let least_pt = 7.0;
        if pt >= least_pt { Ok(Self(pt)) } else { Err(RenderError::TextTooSmall { found_pt: pt, least_pt }) }
    }

    /// The size in points.
    pub fn pt(self) -> f64 {
        self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_in_the_palette_differ_in_grey() {
        for (index, color) in SERIES.iter().enumerate() {
            let next = SERIES[(index + 1) % SERIES.len()];
            let gap = (color.luminance() - next.luminance()).abs();
            assert!(gap >= SERIES_MARGIN, "{color:?} and {next:?} differ by {gap}");
        }
    }

    #[test]
    fn luminance_of_black_white_and_pure_green_is_as_wcag_prints() {
        assert_eq!(BLACK.luminance(), 0.0);
        assert!((WHITE.luminance() - 1.0).abs() < 1e-12);
        assert!((Rgb([0, 255, 0]).luminance() - 0.7152).abs() < 1e-12);
    }

    #[test]
    fn the_first_thirty_five_series_all_differ() {
        let all: Vec<Stroke> = (0..35).map(series_stroke).collect();
        for (index, one) in all.iter().enumerate() {
            assert!(!all[..index].contains(one), "series {index} repeats {one:?}");
        }
    }

    #[test]
    fn text_below_seven_points_is_refused_with_the_least_size() {
        assert_eq!(TextSize::new(7.0).unwrap().pt(), 7.0);
        for bad in [6.99, 0.0, f64::NAN] {
            let message = TextSize::new(bad).unwrap_err().to_string();
            assert!(message.contains("at least 7 pt"), "{message}");
        }
    }

    #[test]
    fn a_single_column_is_85_mm() {
        assert!((Width::Single.pt() - 240.944_88).abs() < 1e-4);
    }
}
