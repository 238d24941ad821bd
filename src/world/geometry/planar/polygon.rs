//! Convex polygons.

use super::{Segment2, exact::turn};
use crate::geometry::{
    Vec2,
    error::{GeometryError, finite, finite_point, positive},
};
use std::{cmp::Ordering, f64::consts::TAU};

/// A convex polygon with an area.
#[derive(Debug, Clone, PartialEq)]
pub struct ConvexPolygon {
    vertices: Vec<Vec2>,
}

impl ConvexPolygon {
    /// The polygon with these corners, 3 to 64, counter-clockwise.
    ///
    /// # Errors
    /// [`GeometryError::Count`], [`GeometryError::NotFinite`], or [`GeometryError::NotCounterClockwise`] if a
    /// corner turns right or not at all, or the sides go round more than once.
    pub fn new(vertices: Vec<Vec2>) -> Result<Self, GeometryError> {
        let found = vertices.len();
        if !(3..=64).contains(&found) {
            return Err(GeometryError::Count { what: "vertices", found, least: 3, most: 64 });
        }
        for (i, vertex) in vertices.iter().enumerate() {
            finite_point(&format!("vertex {i}"), vertex.as_slice())?;
        }
        // A star polygon turns left at every corner too; only a convex one keeps all others to the left.
        for (at, from) in vertices.iter().enumerate() {
            let next = (at + 1) % found;
            let others = (0..found).filter(|&v| v != at && v != next);
            if let Some(vertex) =
                others.into_iter().find(|&v| turn(from, &vertices[next], &vertices[v]) != Ordering::Greater)
            {
                return Err(GeometryError::NotCounterClockwise { vertex });
            }
        }
        Ok(Self { vertices })
    }

    /// The regular polygon with `sides` corners on the circle of `radius` about `center`, the first of them
    /// `turn_rad` from +x.
    ///
    /// # Errors
    /// As [`new`](Self::new), and [`GeometryError::NotPositive`] for the radius.
    pub fn regular(center: Vec2, radius: f64, sides: usize, turn_rad: f64) -> Result<Self, GeometryError> {
        positive("the polygon's radius", radius)?;
        finite("the polygon's turn", turn_rad)?;
        let corner = |k: usize| {
            let (s, c) = libm::sincos(turn_rad + TAU * k as f64 / sides as f64);
            center + Vec2::new(c, s) * radius
        };
        Self::new((0..sides).map(corner).collect())
    }

    /// The axis-aligned rectangle from corner `min` to corner `max`, with exactly these coordinates.
    ///
    /// # Errors
    /// As [`new`](Self::new); a rectangle with swapped corners turns clockwise.
    pub fn rectangle(min: Vec2, max: Vec2) -> Result<Self, GeometryError> {
        Self::new(vec![min, Vec2::new(max.x, min.y), max, Vec2::new(min.x, max.y)])
    }

    /// The corners, counter-clockwise.
    pub fn vertices(&self) -> &[Vec2] {
        &self.vertices
    }

    /// The sides, counter-clockwise, the polygon to their left.
    pub fn sides(&self) -> impl Iterator<Item = Segment2> {
        let n = self.vertices.len();
        (0..n).map(move |i| Segment2::new(self.vertices[i], self.vertices[(i + 1) % n]))
    }
}
