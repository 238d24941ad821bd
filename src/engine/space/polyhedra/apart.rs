//! What is remembered of how rods and obstacles lie apart, so that the next configuration need not be measured anew.

use crate::geometry::{Convex, Face, Nearest, Segment, Vec3};
use std::cell::Cell;

/// Beyond what rounding can do to a distance in a scene, in centimetres.
pub(super) const SLACK_CM: f64 = 1e-6;

/// For each rod and obstacle the direction in which they were last seen apart. It changes no answer, only how soon it is
/// found: whatever the direction, two convex bodies are as far apart as their extents along it.
#[derive(Debug)]
pub struct Apart {
    bodies: usize,
    /// From the obstacle to the rod, of length 1; zero where none is known.
    directions: Vec<Cell<Vec3>>,
}

impl Apart {
    /// Nothing known yet of `rods` among `bodies`.
    pub(super) fn new(rods: usize, bodies: usize) -> Self {
        Self { bodies, directions: vec![Cell::new(Vec3::zeros()); rods * bodies] }
    }

    /// A distance that a rod's axis and a body are apart at least; 0 or less says nothing.
    pub(super) fn at_least(&self, [rod, body]: [usize; 2], axis: &Segment, convex: &Convex) -> f64 {
        let direction = self.directions[rod * self.bodies + body].get();
        let near = direction.dot(&axis.a).min(direction.dot(&axis.b));
        let far =
            convex.vertices().iter().map(|corner| direction.dot(corner)).fold(f64::NEG_INFINITY, f64::max);
        near - far - SLACK_CM
    }

    /// Whether the plane of some face shows that they are farther apart than `within`; its normal is remembered.
    pub(super) fn is_beyond_a_face(
        &self,
        [rod, body]: [usize; 2],
        axis: &Segment,
        convex: &Convex,
        within: f64,
    ) -> bool {
        let height = |face: &Face| face.plane.height(&axis.a).min(face.plane.height(&axis.b));
        let beyond = convex.faces().iter().find(|face| height(face) > within + SLACK_CM);
        if let Some(face) = beyond {
            self.directions[rod * self.bodies + body].set(face.plane.normal);
        }
        beyond.is_some()
    }

    /// Remembers in which direction they lie apart.
    pub(super) fn learn(&self, [rod, body]: [usize; 2], nearest: &Nearest) {
        if nearest.distance > SLACK_CM {
            let direction = (nearest.on_a - nearest.on_b) / nearest.distance;
            self.directions[rod * self.bodies + body].set(direction);
        }
    }
}
