//! Whether both links stay clear while the joints move evenly from one posture to another.
//!
//! An interval of the motion is proved clear if, in its middle, each link is farther from every obstacle than any
//! of its points can travel to either end; otherwise it is halved. What cannot be proved within [`RESOLUTION_CM`]
//! is touching.

use super::Obstacle;
use crate::geometry::Vec2;
use crate::geometry::planar::{Segment2, Touch};
use crate::kinematics::planar_2r::{Planar2r, continued};

/// Clearance below this counts as touching.
pub(super) const RESOLUTION_CM: f64 = 1e-6;

/// An arm among obstacles.
pub(super) struct Sweep<'a> {
    pub(super) arm: &'a Planar2r,
    pub(super) obstacles: &'a [Obstacle],
    pub(super) touch: Touch,
}

impl Sweep<'_> {
    /// The least distance of either link from an obstacle; infinite without obstacles.
    pub(super) fn clearance(&self, posture: [f64; 2]) -> f64 {
        let [one, two] = self.distances(&self.links(posture));
        one.min(two)
    }

    /// Whether the motion from `from` to `to` is clear; `clearances_cm` are those of its ends.
    pub(super) fn is_free(&self, from: [f64; 2], to: [f64; 2], clearances_cm: [f64; 2]) -> bool {
        let to = continued(from, to);
        let [d1, d2] = [to[0] - from[0], to[1] - from[1]];
        let [l1, l2] = self.arm.links();
        // No point of a link travels farther than this on the whole way.
        let travel_cm = [l1 * d1.abs(), l1 * d1.abs() + l2 * (d1 + d2).abs()];
        // From either end half of the way is within reach.
        if clearances_cm.iter().all(|clearance| *clearance > travel_cm[1] / 2.0 + RESOLUTION_CM) {
            return true;
        }
        self.is_part_free(from, [d1, d2], travel_cm, [0.0, 1.0])
    }

    fn is_part_free(&self, from: [f64; 2], by: [f64; 2], travel_cm: [f64; 2], [low, high]: [f64; 2]) -> bool {
        let middle = low.midpoint(high);
        let half = (high - low) / 2.0;
        let links = self.links([from[0] + middle * by[0], from[1] + middle * by[1]]);
        let distances = self.distances(&links);
        if (0..2).all(|link| distances[link] > half * travel_cm[link] + RESOLUTION_CM) {
            return true;
        }
        if distances.contains(&0.0) && links.iter().any(|link| self.meets(link)) {
            return false;
        }
        if half * travel_cm[1] < RESOLUTION_CM {
            return self.touch == Touch::Free;
        }
        [[low, middle], [middle, high]].into_iter().all(|part| self.is_part_free(from, by, travel_cm, part))
    }

    /// Whether `link` is in contact with any obstacle.
    pub(super) fn meets(&self, link: &Segment2) -> bool {
        self.obstacles.iter().any(|obstacle| obstacle.meets(link, self.touch))
    }

    pub(super) fn links(&self, posture: [f64; 2]) -> [Segment2; 2] {
        let elbow = self.arm.elbow(posture);
        let tip = self.arm.forward(posture);
        [Segment2::new(Vec2::zeros(), elbow), Segment2::new(elbow, tip)]
    }

    pub(super) fn distances(&self, links: &[Segment2; 2]) -> [f64; 2] {
        let distance =
            |link: &Segment2| self.obstacles.iter().map(|o| o.distance(link)).fold(f64::INFINITY, f64::min);
        [distance(&links[0]), distance(&links[1])]
    }
}
