//! The arm's configuration and the room of its rods there, so that a short further way need not be checked.

use world::geometry::{Capsule, Convex, Frame};
use world::kinematics::{AXES, Joints};
use world::space::polyhedra::{Apart, CarriedArm};

/// Beyond what rounding can do to a rod's place, in centimetres.
const SLACK_CM: f64 = 1e-6;

/// A configuration.
#[derive(Debug, Clone)]
pub(super) struct Place {
    pub(super) q: Joints,
    /// The links' frames at `q`.
    pub(super) frames: [Frame; AXES + 1],
    pub(super) rods: Vec<Capsule>,
    /// Least distance of the rods' surfaces from everything else.
    pub(super) clearance_cm: f64,
}

impl Place {
    /// `q`, of whose surroundings nothing is known.
    pub(super) fn new(arm: &CarriedArm, q: &Joints) -> Self {
        let frames = arm.arm().chain().frames(q);
        Self { q: *q, frames, rods: arm.rods_in(&frames), clearance_cm: f64::NEG_INFINITY }
    }

    /// `q`, with what is left of the room `before`.
    pub(super) fn after(before: &Self, arm: &CarriedArm, q: &Joints) -> Self {
        let mut place = Self::new(arm, q);
        place.clearance_cm = before.clearance_cm - place.moved_cm(before, arm);
        place
    }

    /// Measures the room by the exact distance, up to `reach`.
    pub(super) fn measure(&mut self, arm: &CarriedArm, bodies: &[Convex], reach: f64, apart: &Apart) {
        self.clearance_cm = arm.clearance_of(&self.rods, bodies, reach, false, apart);
    }

    /// No point of a rod is farther than this from where it is at either end, while the joints turn evenly from `before`.
    ///
    /// A point of the arm leaves the straight line between its ends by at most an eighth of its greatest second derivative, which
    /// is the square of all turns together times the arm's length. Points of a rod lie between its ends.
    pub(super) fn moved_cm(&self, before: &Self, arm: &CarriedArm) -> f64 {
        let ends = self.rods.iter().zip(&before.rods).flat_map(|(now, then)| {
            [(now.segment.a, then.segment.a), (now.segment.b, then.segment.b)].map(|(a, b)| (a - b).norm())
        });
        let turned: f64 = (0..AXES).map(|i| (self.q[i] - before.q[i]).abs()).sum();
        ends.fold(0.0, f64::max) + arm.length_cm() * turned * turned / 8.0 + SLACK_CM
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use base::seed;
    use rand::RngExt as _;
    use std::path::Path;
    use world::kinematics::Robot;
    use world::space::Support;

    #[test]
    fn no_rod_moves_farther_on_its_way_than_its_bound() {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/robots/aubo_i10.toml");
        let support = Support::on_floor(Frame::IDENTITY);
        let arm = CarriedArm::new(&Robot::load(&file).unwrap(), "mesh", &support).unwrap();
        let seed = 79;
        let mut tightest = f64::INFINITY;
        let mut stream = seed::stream(seed);
        for way in 0..2_000 {
            let reach = [0.01, 0.1, 0.5][way % 3];
            let mut random =
                |reach: f64| -> Joints { std::array::from_fn(|_| stream.random_range(-reach..reach)) };
            let from = random(3.0);
            let mut turn = random(reach);
            if way % 10 == 9 {
                // All the way round: the ends say nothing of what lies between.
                turn[0] = std::f64::consts::TAU;
            }
            let at = |share: f64| Place::new(&arm, &std::array::from_fn(|i| from[i] + share * turn[i]));
            let (start, end) = (at(0.0), at(1.0));
            let bound = end.moved_cm(&start, &arm);
            for share in [0.1, 0.3, 0.5, 0.7, 0.9, 1.0] {
                let between = at(share);
                for (rod, then) in between.rods.iter().zip(&start.rods) {
                    let moved = (rod.segment.at(0.4) - then.segment.at(0.4)).norm();
                    assert!(moved <= bound, "seed {seed} way {way} at {share}: {moved}, not {bound}");
                    let ends = (rod.segment.b - then.segment.b).norm();
                    assert!(ends <= bound, "seed {seed} way {way} at {share}: {ends}, not {bound}");
                    tightest = tightest.min(bound / ends.max(1e-3));
                }
            }
        }
        assert!(tightest < 1.01, "the bound is never near: {tightest}");
    }
}
