//! Which lengths `a + b√2` of 8-connected walks print as given digits.
//!
//! A walk of `a` straight and `b` diagonal moves on a lattice of step `s` has length `s (a + b√2)`. Whether
//! that prints as some digits is decided in integers, so no float can tip it. Walks may revisit cells and meet
//! no obstacle: what is excluded here is excluded on every map.

use crate::printed::{Digits, Printed};
use crate::turns::Cell;
use std::cmp::Ordering;

/// Counts of straight and diagonal moves; as a length, `straight + diagonal √2` steps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Octile {
    /// Moves along a row or a column.
    pub straight: u32,
    /// Moves to a diagonal neighbour.
    pub diagonal: u32,
}

impl Octile {
    /// The length in steps.
    pub fn length(self) -> f64 {
        f64::from(self.straight) + f64::from(self.diagonal) * std::f64::consts::SQRT_2
    }

    /// How this length compares with another, exactly.
    pub fn compare(self, other: Self) -> Ordering {
        let difference = |a: u32, b: u32| i128::from(a) - i128::from(b);
        sign(difference(self.straight, other.straight), difference(self.diagonal, other.diagonal))
    }
}

/// Lattice step as a fraction of the unit that the paper prints.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Step {
    /// Printed units …
    pub numerator: u32,
    /// … per this many steps; not zero.
    pub denominator: u32,
}

impl Step {
    /// One printed unit per step.
    pub const ONE: Self = Self { numerator: 1, denominator: 1 };

    /// The step in printed units.
    pub fn value(self) -> f64 {
        f64::from(self.numerator) / f64::from(self.denominator)
    }
}

/// The length of an unobstructed 8-connected walk over `displacement` cells.
pub fn octile_distance(displacement: Cell) -> Octile {
    let [dx, dy] = displacement.map(i32::unsigned_abs);
    Octile { straight: dx.abs_diff(dy), diagonal: dx.min(dy) }
}

/// Whether an 8-connected walk with exactly these moves covers `displacement`.
///
/// Diagonal moves choose their signs along x and y independently, so each axis decides for itself: some
/// `horizontal` of the straight moves must leave both axes enough moves, of the right parity. That bounds
/// `horizontal` from both sides and says whether it is even, alike for both axes only if the sum of all is.
pub fn joins(moves: Octile, displacement: Cell) -> bool {
    let [dx, dy] = displacement.map(|d| i64::from(d.unsigned_abs()));
    let [straight, diagonal] = [moves.straight, moves.diagonal].map(i64::from);
    let least = (dx - diagonal).max(0);
    let most = straight.min(straight + diagonal - dy);
    let first = least + (least + dx + diagonal) % 2;
    (straight + dx + dy) % 2 == 0 && first <= most
}

/// Every pair of move counts whose length at `step` prints as `printed`, by rising count of diagonal moves.
///
/// With a displacement (in cells), only the pairs that [join](joins) its ends are kept; this carries the lower
/// bound of `max(|dx|, |dy|)` moves and the parity of `dx + dy`. A negative print has none.
pub fn lengths_printing(
    printed: Printed,
    digits: Digits,
    step: Step,
    displacement: Option<Cell>,
) -> Vec<Octile> {
    let reach = printed.interval(digits);
    let in_steps = |length: f64| (length / step.value()).max(0.0);
    let most_diagonal = (in_steps(reach.high) / std::f64::consts::SQRT_2) as u32 + 1;
    // Floats propose; they are off by much less.
    let slack = 1e-6 + 1e-9 * in_steps(reach.high);
    let candidates = (0..=most_diagonal).flat_map(|diagonal| {
        let left = |length: f64| in_steps(length) - f64::from(diagonal) * std::f64::consts::SQRT_2;
        let first = (left(reach.low) - slack).ceil().max(0.0) as u32;
        let end = (left(reach.high) + slack).floor().max(-1.0) + 1.0;
        (first..end as u32).map(move |straight| Octile { straight, diagonal })
    });
    candidates
        .filter(|&moves| prints_as(moves, step, printed, digits))
        .filter(|&moves| displacement.is_none_or(|displacement| joins(moves, displacement)))
        .collect()
}

/// The longest attainable length below the printed value and the shortest not below it, at step one, for
/// walks over `displacement`: how far an unattainable print misses.
pub fn nearest_lengths(printed: Printed, displacement: Cell) -> (Option<Octile>, Option<Octile>) {
    let (mut below, mut above): (Option<Octile>, Option<Octile>) = (None, None);
    let most = printed.value().max(0.0) as u32 + 4 + octile_distance(displacement).length() as u32;
    for diagonal in 0..=most {
        for straight in 0..=most - diagonal {
            let moves = Octile { straight, diagonal };
            if !joins(moves, displacement) {
                continue;
            }
            if against_half_units(moves, Step::ONE, printed, 2 * printed.units()).is_lt() {
                below = below.filter(|best| best.compare(moves).is_ge()).or(Some(moves));
            } else {
                above = above.filter(|best| best.compare(moves).is_le()).or(Some(moves));
            }
        }
    }
    (below, above)
}

fn prints_as(moves: Octile, step: Step, printed: Printed, digits: Digits) -> bool {
    printed.half_units(digits).holds(|end| against_half_units(moves, step, printed, end))
}

/// How the length compares with `end` half units of the last printed place, exactly.
fn against_half_units(moves: Octile, step: Step, printed: Printed, end: i64) -> Ordering {
    let scale = 2 * i128::from(printed.scale()) * i128::from(step.numerator);
    let end = i128::from(end) * i128::from(step.denominator);
    sign(scale * i128::from(moves.straight) - end, scale * i128::from(moves.diagonal))
}

/// The sign of `a + b√2`, as its comparison with zero.
fn sign(a: i128, b: i128) -> Ordering {
    let squares = (a * a).cmp(&(2 * b * b));
    match (a.cmp(&0), b.cmp(&0)) {
        (Ordering::Less, Ordering::Greater) => squares.reverse(),
        (Ordering::Greater, Ordering::Less) => squares,
        (Ordering::Equal, sign_b) => sign_b,
        (sign_a, _) => sign_a,
    }
}

#[cfg(test)]
mod tests;
