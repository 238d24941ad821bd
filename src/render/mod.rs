//! Figures and LaTeX for readers. Nothing here computes a result.
//!
//! A figure is drawn on a [`canvas`] in points (1/72 inch, y down), with text turned into outlines of an embedded font.
//! It leaves as SVG and PNG ([`vector`]). [`chart`] builds sheets of panels from marks, [`scene3`] draws solids,
//! [`style`] holds colours, strokes and sizes, and [`latex`] writes tables and macros.

pub mod agreement;
pub mod canvas;
pub mod chart;
pub mod comparison;
mod disclaimers;
pub mod effect;
pub mod figure;
pub mod font;
pub mod headline;
pub mod latex;
pub mod output;
mod palette;
pub mod prose;
pub mod report;
pub mod results;
pub mod scene3;
pub mod style;
pub mod tables;
pub mod vector;

pub use disclaimers::{marks, state};

/// Why a figure or a table could not be made.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    /// A figure's settings are wrong.
    #[error(transparent)]
    Settings(#[from] base::settings::SettingsError),
    /// A figure that cannot be drawn.
    #[error("figure `{figure}`: {source}")]
    Figure {
        /// Its study and id.
        figure: String,
        /// Why.
        source: Box<RenderError>,
    },
    /// Drawing was interrupted.
    #[error(
        "interrupted while drawing; records and verdicts are kept, and `replan render` goes on from there"
    )]
    Interrupted,
    /// What should be drawn is not there.
    #[error("the stored run and the paper have nothing like {what}")]
    NotStored {
        /// What is missing.
        what: String,
    },
    /// A text size below what a printed page can carry.
    #[error("text of {found_pt} pt is too small to print; at least {least_pt} pt is accepted")]
    TextTooSmall {
        /// The size that was requested.
        found_pt: f64,
        /// The least size that is accepted.
        least_pt: f64,
    },
    /// A character that the embedded font cannot draw.
    #[error("the embedded font DejaVu Sans has no glyph for `{found}`, used in `{text}`")]
    MissingGlyph {
        /// The character.
        found: char,
        /// The text that holds it.
        text: String,
    },
    /// An axis that cannot be drawn.
    #[error("axis `{axis}` runs from {from} to {to}; {accepted}")]
    Axis {
        /// Label of the axis.
        axis: String,
        /// Lower end as given.
        from: f64,
        /// Upper end as given.
        to: f64,
        /// What would have been accepted.
        accepted: &'static str,
    },
    /// A figure whose labels overlap or leave the page.
    #[error("figure `{figure}` is not fit to print: {flaws}; labels must stay apart and on the page")]
    Flawed {
        /// Its id.
        figure: String,
        /// What is wrong, in words.
        flaws: String,
    },
    /// A sheet whose panels do not fit on it.
    #[error(
        "panel {panel} is left {width_pt:.0} × {height_pt:.0} pt for its plot; at least 30 × 30 pt is needed"
    )]
    NoRoom {
        /// Index of the panel on its sheet.
        panel: usize,
        /// Width that remains for the plot.
        width_pt: f64,
        /// Height that remains for the plot.
        height_pt: f64,
    },
    /// An SVG that could not be read back.
    #[error("the drawn SVG cannot be read back: {0}")]
    Svg(#[from] resvg::usvg::Error),
    /// A picture that could not be encoded.
    #[error("the picture cannot be written as PNG: {0}")]
    Png(#[from] png::EncodingError),
    /// A picture of a size that cannot be held.
    #[error("a picture of {width_px} × {height_px} px cannot be drawn")]
    Size {
        /// Width in pixels.
        width_px: u32,
        /// Height in pixels.
        height_px: u32,
    },
    /// A table row with the wrong number of cells.
    #[error("row {row} of table `{table}` fills {found} columns; {expected} are declared")]
    RowWidth {
        /// Label of the table.
        table: String,
        /// Index of the row among all rows, from 0.
        row: usize,
        /// Columns filled by the row.
        found: usize,
        /// Columns declared.
        expected: usize,
    },
    /// Two numbers that would get the same macro.
    #[error(
        "`{first}` and `{second}` would both be written as the macro \\{name}; give them names that differ in letters or digits"
    )]
    DuplicateMacro {
        /// Name of the macro.
        name: String,
        /// The key that took it first.
        first: String,
        /// The key that came later.
        second: String,
    },
    /// A key without a letter or a digit.
    #[error("`{0}` gives no macro name; a key needs at least one letter or digit of ASCII")]
    EmptyMacro(String),
}

#[cfg(test)]
mod tests;
