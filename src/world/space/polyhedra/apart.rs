//! What is remembered of how rods and obstacles lie apart, so that the next configuration need not be measured anew.

use crate::geometry::{Convex, Face, Nearest, Segment, Vec3, nearest_by_edge};
use std::cell::Cell;

/// Beyond what rounding can do to a distance in a scene, in centimetres.
pub(super) const SLACK_CM: f64 = 1e-6;

/// For each rod and obstacle the direction in which they were last seen apart. It changes no answer, only how soon it is
/// found: whatever the direction, two convex bodies are as far apart as their extents along it.
#[derive(Debug)]
pub struct Apart {
    bodies: usize,
    pairs: Vec<Cell<Pair>>,
    /// The rod and the obstacle that were nearest to each other.
    closest: Cell<Option<[usize; 2]>>,
}

/// What is remembered of a rod and an obstacle.
#[derive(Debug, Clone, Copy, Default)]
struct Pair {
    /// From the obstacle to the rod, of length 1; zero where none is known.
    direction: Vec3,
    /// How far the obstacle reaches along it.
    far: f64,
    /// The obstacle's edge that was nearest.
    edge: Option<usize>,
}

impl Pair {
    fn along(direction: Vec3, convex: &Convex, edge: Option<usize>) -> Self {
        let heights = convex.vertices().iter().map(|corner| direction.dot(corner));
        Self { direction, far: heights.fold(f64::NEG_INFINITY, f64::max), edge }
    }
}

impl Apart {
    /// Nothing known yet of `rods` among `bodies`.
    pub(super) fn new(rods: usize, bodies: usize) -> Self {
        Self { bodies, pairs: vec![Cell::default(); rods * bodies], closest: Cell::new(None) }
    }

    /// The rod and the obstacle that were last nearest to each other.
    pub(super) fn closest(&self) -> Option<[usize; 2]> {
        self.closest.get()
    }

    /// Remembers who is nearest to whom.
    pub(super) fn set_closest(&self, pair: [usize; 2]) {
        self.closest.set(Some(pair));
    }

    /// The nearest points of rod `rod`'s axis and body `body`; none if they are farther apart than `within` for sure.
    pub(super) fn nearest(
        &self,
        [rod, body]: [usize; 2],
        axis: &Segment,
        convex: &Convex,
        within: f64,
    ) -> Option<Nearest> {
        let pair = &self.pairs[rod * self.bodies + body];
        let Pair { direction, far, edge } = pair.get();
        if direction.dot(&axis.a).min(direction.dot(&axis.b)) - far > within + SLACK_CM {
            return None;
        }
        let height = |face: &Face| face.plane.height(&axis.a).min(face.plane.height(&axis.b));
        let beyond = |face: &&Face| height(face) > within + SLACK_CM;
        if direction == Vec3::zeros()
            && let Some(face) = convex.faces().iter().find(beyond)
        {
            pair.set(Pair::along(face.plane.normal, convex, edge));
            return None;
        }
        let (found, nearest) = nearest_by_edge(axis, convex, edge);
        if found.distance > SLACK_CM {
            let direction = (found.on_a - found.on_b) / found.distance;
            pair.set(Pair::along(direction, convex, nearest.or(edge)));
        }
        Some(found)
    }
}
