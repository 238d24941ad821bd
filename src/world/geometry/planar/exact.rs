//! Signs of polynomials in the given coordinates, exact.
//!
//! Each sign is first tried in floating point against a bound on its rounding. Only if that cannot decide
//! is it computed without error, as an expansion: a sum of floats that do not overlap. Exactness ends where
//! products leave the exponent range, far beyond any workspace.
//!
//! # Source
//! Shewchuk, *Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates* (1997):
//! two-sum, two-product (with Dekker's split), grow-expansion and scale-expansion.

use crate::geometry::Vec2;
use std::cmp::Ordering;

/// The rounding of any polynomial here is below this times the same polynomial of absolute values; at most
/// 20 operations, each with a relative error of half an epsilon, lie on any way through them.
const ROUNDING: f64 = 32.0 * f64::EPSILON;

/// An exact number: the sum of its parts, smallest first.
#[derive(Debug, Clone)]
struct Exact(Vec<f64>);

fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let virtual_b = sum - a;
    (sum, (a - (sum - virtual_b)) + (b - virtual_b))
}

fn split(a: f64) -> (f64, f64) {
    let c = 134_217_729.0 * a;
    let high = c - (c - a);
    (high, a - high)
}

fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    let (a_high, a_low) = split(a);
    let (b_high, b_low) = split(b);
    (product, a_low * b_low - (((product - a_high * b_high) - a_low * b_high) - a_high * b_low))
}

impl Exact {
    fn difference(a: f64, b: f64) -> Self {
        let (sum, rest) = two_sum(a, -b);
        Self(vec![rest, sum])
    }

    fn grown(mut self, b: f64) -> Self {
        let mut carry = b;
        for part in &mut self.0 {
            (carry, *part) = two_sum(carry, *part);
        }
        self.0.push(carry);
        self.0.retain(|&part| part != 0.0);
        self
    }

    fn plus(&self, other: &Self) -> Self {
        other.0.iter().fold(self.clone(), |sum, &part| sum.grown(part))
    }

    fn minus(&self, other: &Self) -> Self {
        other.0.iter().fold(self.clone(), |sum, &part| sum.grown(-part))
    }

    fn times(&self, other: &Self) -> Self {
        let mut product = Self(Vec::new());
        for &a in &self.0 {
            for &b in &other.0 {
                let (high, low) = two_product(a, b);
                product = product.grown(low).grown(high);
            }
        }
        product
    }

    /// The parts do not overlap, so the last one that is not 0 has the sign of the sum.
    fn sign(&self) -> Ordering {
        self.0.iter().rev().find(|&&part| part != 0.0).map_or(Ordering::Equal, |part| part.total_cmp(&0.0))
    }
}

/// The sign of `value` if rounding cannot have changed it, else of what `exact` computes.
fn decided(value: f64, magnitude: f64, exact: impl FnOnce() -> Exact) -> Ordering {
    if value.abs() > ROUNDING * magnitude { value.total_cmp(&0.0) } else { exact().sign() }
}

fn exact_difference(a: &Vec2, b: &Vec2) -> [Exact; 2] {
    [Exact::difference(a.x, b.x), Exact::difference(a.y, b.y)]
}

fn exact_cross([ux, uy]: &[Exact; 2], [vx, vy]: &[Exact; 2]) -> Exact {
    ux.times(vy).minus(&uy.times(vx))
}

fn exact_dot([ux, uy]: &[Exact; 2], [vx, vy]: &[Exact; 2]) -> Exact {
    ux.times(vx).plus(&uy.times(vy))
}

/// Greater if `c` is to the left of the line from `a` to `b`, less if to the right, equal if on it.
pub(super) fn turn(a: &Vec2, b: &Vec2, c: &Vec2) -> Ordering {
    let (u, v) = (b - a, c - a);
    let (left, right) = (u.x * v.y, u.y * v.x);
    decided(left - right, left.abs() + right.abs(), || {
        exact_cross(&exact_difference(b, a), &exact_difference(c, a))
    })
}

/// Greater if the foot of `c` on the line from `a` to `b` is on the side of `b`, seen from `a`.
pub(super) fn side_of_foot(a: &Vec2, b: &Vec2, c: &Vec2) -> Ordering {
    let (u, v) = (b - a, c - a);
    let (x, y) = (u.x * v.x, u.y * v.y);
    decided(x + y, x.abs() + y.abs(), || exact_dot(&exact_difference(b, a), &exact_difference(c, a)))
}

/// How the distance between two points compares with `radius`, which is not negative.
pub(super) fn compare_distance_to_point(a: &Vec2, b: &Vec2, radius: f64) -> Ordering {
    let u = a - b;
    let distance2 = u.norm_squared();
    let radius2 = radius * radius;
    decided(distance2 - radius2, distance2 + radius2, || {
        let u = exact_difference(a, b);
        let radius = Exact(vec![radius]);
        exact_dot(&u, &u).minus(&radius.times(&radius))
    })
}

/// How the distance of `c` from the line through `a` and `b`, which differ, compares with `radius`.
pub(super) fn compare_distance_to_line(c: &Vec2, a: &Vec2, b: &Vec2, radius: f64) -> Ordering {
    let (u, v) = (b - a, c - a);
    let cross = u.x * v.y - u.y * v.x;
    let magnitude = (u.x * v.y).abs() + (u.y * v.x).abs();
    let reach2 = radius * radius * u.norm_squared();
    decided(cross * cross - reach2, magnitude * magnitude + reach2, || {
        let (u, v) = (exact_difference(b, a), exact_difference(c, a));
        let cross = exact_cross(&u, &v);
        let radius = Exact(vec![radius]);
        cross.times(&cross).minus(&radius.times(&radius).times(&exact_dot(&u, &u)))
    })
}
