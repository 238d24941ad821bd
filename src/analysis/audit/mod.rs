//! Arithmetic on what a paper prints: what its digits can mean and what no input could have given.
//!
//! Nothing here reads a record. Every bound states its premises and takes the printed digits' slack in the
//! paper's favour, so that "impossible" is a proof under those premises. Decisions about lattice lengths are
//! made in integers; angles come from `libm`. Cells are `[x, y]` and stand for their centres, one unit apart.

pub mod bounds;
pub mod clock;
pub mod fvalues;
pub mod lattice;
pub mod percent;
pub mod printed;
pub mod sight;
pub mod turns;

/// A lattice cell `[x, y]`.
pub type Cell = [i32; 2];

/// Why an audit could not be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum AuditError {
    /// A text is no printed decimal number.
    #[error("`{text}` is not a printed number; one looks like 14.65, -0.5 or 270, with 15 digits at most")]
    NotANumber {
        /// The text found.
        text: String,
    },
    /// A reduction was asked of a cell that may print zero or a negative value.
    #[error(
        "a reduction from {before} to {after} has no meaning: the first must be positive and the second \
         not negative, whatever their digits stand for"
    )]
    NoReduction {
        /// Printed value before.
        before: String,
        /// Printed value after.
        after: String,
    },
}

/// The cell itself and its neighbours within the grid of `size` = `[columns, rows]`, by rows.
pub fn neighbourhood(cell: Cell, size: [i32; 2]) -> Vec<Cell> {
    (-1..=1)
        .flat_map(|dy| (-1..=1).map(move |dx| [cell[0] + dx, cell[1] + dy]))
        .filter(|near| (0..2).all(|axis| (0..size[axis]).contains(&near[axis])))
        .collect()
}

/// Distance between two cell centres.
fn distance(a: Cell, b: Cell) -> f64 {
    let (dx, dy) = (f64::from(a[0] - b[0]), f64::from(a[1] - b[1]));
    (dx * dx + dy * dy).sqrt()
}
