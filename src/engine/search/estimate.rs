//! Estimates f of a node and the cost g of the way to it.

use super::cost::{Cost, Octile, quantised};
use base::grid::Grid2;
use std::f64::consts::SQRT_2;

/// The key by which open nodes are ordered.
pub trait Estimate<C> {
    /// The heuristic of `node`; called once for each node that a search opens.
    fn h(&self, node: u32) -> f64;

    /// The key of a node with heuristic `h` when the way to it costs `g`.
    fn key(&self, g: C, h: f64) -> u64;

    /// The key of a finished path of this cost, comparable with [`key`](Self::key).
    fn finished(&self, cost: C) -> u64;
}

/// `combine(g, h(node))`, rounded to 1e-9.
///
/// `h` is the heuristic and `combine` what makes f of both: [`sum`], [`weighted`], [`falling`] or any other.
#[derive(Clone, Copy, Debug)]
pub struct Combined<H, F> {
    /// The heuristic.
    pub h: H,
    /// How g and h combine into f.
    pub combine: F,
}

impl<C: Cost, H: Fn(u32) -> f64, F: Fn(f64, f64) -> f64> Estimate<C> for Combined<H, F> {
    fn h(&self, node: u32) -> f64 {
        (self.h)(node)
    }

    fn key(&self, g: C, h: f64) -> u64 {
        quantised((self.combine)(g.value(), h))
    }

    fn finished(&self, cost: C) -> u64 {
        quantised(cost.value())
    }
}

/// f = g + h.
pub fn sum(g: f64, h: f64) -> f64 {
    g + h
}

/// f = g + weight · h.
pub fn weighted(weight: f64) -> impl Fn(f64, f64) -> f64 {
    move |g, h| g + weight * h
}

/// f = g + ((R + h) / R) · h with R = `reference`: the weight falls from 2 at distance R to 1 at the target.
///
/// h must be the distance r that weighs it. With R = 0 the weight is 1.
///
/// # Source
/// Zhang & Zhang, *Path Planning for Mobile Robots Based on Improved A-star Algorithm*, eq. 2.
pub fn falling(reference: f64) -> impl Fn(f64, f64) -> f64 {
    move |g, h| if reference > 0.0 { g + (reference + h) / reference * h } else { g + h }
}

/// The Euclidean distance in cells from a cell's centre to the centre of `target`.
pub fn euclidean_to(grid: &Grid2, target: u32) -> impl Fn(u32) -> f64 {
    let distance = cells_apart(grid.width(), target);
    move |cell| {
        let [dx, dy] = distance(cell).map(f64::from);
        (dx * dx + dy * dy).sqrt()
    }
}

/// The Euclidean distance in cells between two cells, each by column and row.
pub(super) fn distance(one: [i32; 2], other: [i32; 2]) -> f64 {
    let [dx, dy] = [0, 1].map(|axis: usize| f64::from(one[axis].abs_diff(other[axis])));
    (dx * dx + dy * dy).sqrt()
}

/// The octile distance in cells to `target`: the length of a shortest 8-connected path without obstacles.
pub fn octile_to(grid: &Grid2, target: u32) -> impl Fn(u32) -> f64 {
    let distance = cells_apart(grid.width(), target);
    move |cell| {
        let [dx, dy] = distance(cell);
        f64::from(dx.abs_diff(dy)) + f64::from(dx.min(dy)) * SQRT_2
    }
}

fn cells_apart(width: u32, target: u32) -> impl Fn(u32) -> [u32; 2] {
    let [x, y] = [target % width, target / width];
    move |cell| [(cell % width).abs_diff(x), (cell / width).abs_diff(y)]
}

/// g + h in integers with straight moves of 985 and diagonal ones of 1393, h the octile distance to a target or 0.
///
/// 1393 / 985 is a convergent of √2: it orders a + b√2 exactly while numbers of diagonal moves differ by less than
/// 985. The estimate is consistent in these units, as [`Buckets`](super::Buckets) require.
#[derive(Clone, Copy, Debug)]
pub struct ScaledOctile {
    width: u32,
    target: Option<[u32; 2]>,
}

impl ScaledOctile {
    /// A straight move.
    pub const STRAIGHT: u32 = 985;
    /// A diagonal move.
    pub const DIAGONAL: u32 = 1393;

    /// The estimate towards `target`, a cell of a grid with `width` columns, or h = 0 (Dijkstra's order) without.
    pub fn new(width: u32, target: Option<u32>) -> Self {
        Self { width, target: target.map(|cell| [cell % width, cell / width]) }
    }

    /// `cost` in these units.
    pub fn scaled(cost: Octile) -> u32 {
        Self::STRAIGHT * cost.straight + Self::DIAGONAL * cost.diagonal
    }

    /// The octile distance over `[dx, dy]` in these units.
    #[inline]
    pub fn distance([dx, dy]: [u32; 2]) -> u32 {
        Self::STRAIGHT * dx.max(dy) + (Self::DIAGONAL - Self::STRAIGHT) * dx.min(dy)
    }
}

impl Estimate<Octile> for ScaledOctile {
    fn h(&self, node: u32) -> f64 {
        let distance = self.target.map_or(0, |[x, y]| {
            Self::distance([(node % self.width).abs_diff(x), (node / self.width).abs_diff(y)])
        });
        f64::from(distance)
    }

    fn key(&self, g: Octile, h: f64) -> u64 {
        // h is a u32.
        self.finished(g) + h as u64
    }

    fn finished(&self, cost: Octile) -> u64 {
        u64::from(Self::STRAIGHT) * u64::from(cost.straight)
            + u64::from(Self::DIAGONAL) * u64::from(cost.diagonal)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_falling_weight_is_two_at_the_reference_and_one_at_the_target() {
        let f = falling(10.0);
        assert_eq!([f(3.0, 10.0), f(3.0, 5.0), f(3.0, 0.0)], [23.0, 10.5, 3.0]);
        assert_eq!(falling(0.0)(1.0, 2.0), 3.0);
    }

    #[test]
    fn scaled_costs_order_pairs_exactly_below_985_diagonals() {
        let estimate = ScaledOctile::new(1, None);
        let cost = |straight, diagonal| Octile { straight, diagonal };
        let mut closest = f64::INFINITY;
        for d in 1..985 {
            // The two whole numbers next to d√2 are the only ones that a wrong order could confuse.
            let below = (f64::from(d) * SQRT_2).floor() as u32;
            assert!(estimate.finished(cost(below, 0)) < estimate.finished(cost(0, d)), "{d}");
            assert!(estimate.finished(cost(below + 1, 0)) > estimate.finished(cost(0, d)), "{d}");
            closest = closest.min((f64::from(d) * SQRT_2 - f64::from(below)).min(1.0));
        }
        assert!(closest < 2e-3, "no close call among the pairs: {closest}");
        assert_eq!(estimate.finished(cost(1393, 0)), estimate.finished(cost(0, 985)), "the first confusion");
    }

    #[test]
    fn heuristics_measure_from_centre_to_centre() {
        let grid = Grid2::new(9, 7).unwrap();
        let (from, to) = (grid.cell(1, 1).unwrap(), grid.cell(5, 4).unwrap());
        assert_eq!(euclidean_to(&grid, to)(from), 5.0);
        assert_eq!(octile_to(&grid, to)(from), 1.0 + 3.0 * SQRT_2);
        let estimate = ScaledOctile::new(9, Some(to));
        let key = estimate.key(Octile::DIAGONAL, estimate.h(from));
        assert_eq!(key, u64::from(1393 + 985 + 3 * 1393_u32));
    }
}
