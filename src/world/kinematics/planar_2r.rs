//! Closed-form kinematics of the planar two-link arm.
//!
//! The arm lies in the plane: base at the origin, `q1` measured from +x, `q2` from link 1, both
//! counter-clockwise. Lengths are in any one unit, angles radians. Every function here is pure: the arm
//! holds its link lengths and no pose, so one arm can serve all trials at once.
//!
//! The 2R arm has two inverse branches. They are kept apart here ([`Branches`]) because the reproduced
//! papers count them as two goals; an [`ElbowRule`] picks one only for a caller that names it.

use super::{KinematicsError, angle::nearest_copy};
use crate::geometry::Vec2;
use schemars::JsonSchema;
use serde::Deserialize;

/// A planar arm of two links.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Planar2r {
    l1: f64,
    l2: f64,
}

/// Both ways to reach a target, each as `[q1, q2]`; they coincide at the rims of the reachable ring.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Branches {
    /// With `q2` in `[-π, 0]`.
    pub negative: [f64; 2],
    /// With `q2` in `[0, π]`.
    pub positive: [f64; 2],
}

/// What a paper may mean by "elbow up".
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ElbowRule {
    /// The branch with `q2 <= 0`: the elbow is to the left of the line from base to tip.
    #[serde(rename = "negative_theta2")]
    NegativeQ2,
    /// The branch whose elbow has the greater y; the one with `q2 <= 0` if both are equally high. It changes
    /// branch, and so jumps, where a path crosses the line above the base.
    #[serde(rename = "higher")]
    HigherElbow,
}

impl Planar2r {
    /// The arm with links `l1` (at the base) and `l2`.
    ///
    /// # Errors
    /// [`KinematicsError::Link`] if a length is not a finite number above 0.
    pub fn new(l1: f64, l2: f64) -> Result<Self, KinematicsError> {
        for (link, found) in [(1, l1), (2, l2)] {
            if !(found.is_finite() && found > 0.0) {
                return Err(KinematicsError::Link { link, found });
            }
        }
        Ok(Self { l1, l2 })
    }

    /// The link lengths, the one at the base first.
    pub fn links(&self) -> [f64; 2] {
        [self.l1, self.l2]
    }

    /// The least and the greatest distance from the base that the tip reaches.
    pub fn reach(&self) -> [f64; 2] {
        [(self.l1 - self.l2).abs(), self.l1 + self.l2]
    }

    /// Where the elbow is at `[q1, q2]`.
    pub fn elbow(&self, [q1, _]: [f64; 2]) -> Vec2 {
        let (s, c) = libm::sincos(q1);
        Vec2::new(self.l1 * c, self.l1 * s)
    }

    /// Where the tip is at `[q1, q2]`.
    pub fn forward(&self, [q1, q2]: [f64; 2]) -> Vec2 {
        let (s, c) = libm::sincos(q1 + q2);
        self.elbow([q1, q2]) + Vec2::new(self.l2 * c, self.l2 * s)
    }

    /// Joint angles that put the tip at `target`.
    ///
    /// Both branches are returned; at the rims they coincide. `q2` is in `[-π, π]`; `q1` is not wrapped. With
    /// equal links and the target at the base, `q1` is free and 0 is not promised.
    ///
    /// # Errors
    /// [`KinematicsError::OutOfReach`] if `|target|` is outside [`reach`](Self::reach), compared as squares,
    /// so that lattice points on a rim are reached. No tolerance is applied: a target computed by
    /// [`forward`](Self::forward) at full stretch may be refused.
    ///
    /// # Source
    /// Law of cosines, as in Lynch & Park, *Modern Robotics* (2017), ch. 6, planar 2R chain.
    pub fn inverse(&self, target: &Vec2) -> Result<Branches, KinematicsError> {
        let [inner, outer] = self.reach();
        let distance2 = target.norm_squared();
        let (to_outer, to_inner) = (outer * outer - distance2, distance2 - inner * inner);
        if !(to_outer >= 0.0 && to_inner >= 0.0) {
            let distance = target.norm();
            return Err(KinematicsError::OutOfReach { target: (*target).into(), distance, inner, outer });
        }
        let area = 2.0 * self.l1 * self.l2;
        let cos_q2 = (distance2 - self.l1 * self.l1 - self.l2 * self.l2) / area;
        let sin_q2 = (to_outer * to_inner).sqrt() / area;
        let q2 = libm::atan2(sin_q2, cos_q2);
        let to_target = libm::atan2(target.y, target.x);
        let opening = libm::atan2(self.l2 * sin_q2, self.l1 + self.l2 * cos_q2);
        Ok(Branches { negative: [to_target + opening, -q2], positive: [to_target - opening, q2] })
    }

    /// The branch that `rule` names.
    pub fn pick(&self, branches: &Branches, rule: ElbowRule) -> [f64; 2] {
        let is_higher = || self.elbow(branches.positive).y > self.elbow(branches.negative).y;
        match rule {
            ElbowRule::HigherElbow if is_higher() => branches.positive,
            ElbowRule::NegativeQ2 | ElbowRule::HigherElbow => branches.negative,
        }
    }
}

/// `to`, with whole turns added to each angle so that it is as near as possible to `from`: what the joints
/// of an arm without stops would do between two stations.
pub fn continued(from: [f64; 2], to: [f64; 2]) -> [f64; 2] {
    [nearest_copy(to[0], from[0]), nearest_copy(to[1], from[1])]
}

#[cfg(test)]
mod tests {
    use super::*;
    use base::seed;
    use rand::RngExt as _;
    use std::f64::consts::PI;

    fn arm() -> Planar2r {
        Planar2r::new(30.0, 20.0).unwrap()
    }

    #[test]
    fn both_branches_put_the_tip_on_the_target_and_mirror_each_other() {
        let seed = 701;
        let mut stream = seed::stream(seed);
        for index in 0..100_000 {
            let arm = Planar2r::new(stream.random_range(0.1..3.0), stream.random_range(0.1..3.0)).unwrap();
            let q = [stream.random_range(-PI..PI), stream.random_range(-3.1..3.1)];
            let target = arm.forward(q);
            let both = arm.inverse(&target).unwrap();
            for found in [both.negative, both.positive] {
                let miss = (arm.forward(found) - target).norm();
                assert!(miss < 1e-12, "seed {seed} case {index}: off by {miss} at {found:?}");
            }
            let own = if q[1] < 0.0 { both.negative } else { both.positive };
            let again = continued(q, own);
            let error = (again[0] - q[0]).abs().max((again[1] - q[1]).abs());
            assert!(error < 1e-9 / libm::sin(q[1]).abs(), "seed {seed} case {index}: {again:?}, not {q:?}");
            assert_eq!(both.negative[1], -both.positive[1], "seed {seed} case {index}");
        }
    }

    #[test]
    fn the_rims_are_reached_and_the_branches_meet_there() {
        for (target, q2) in [([30.0, 40.0], 0.0), ([0.0, 50.0], 0.0), ([6.0, 8.0], PI), ([-10.0, 0.0], PI)] {
            let target = Vec2::from(target);
            let both = arm().inverse(&target).unwrap();
            assert_eq!((both.negative[1], both.positive[1]), (-q2, q2), "{target:?}");
            assert!((arm().forward(both.negative) - target).norm() < 1e-13, "{target:?}: {both:?}");
            assert!((arm().forward(both.positive) - target).norm() < 1e-13, "{target:?}: {both:?}");
        }
        for out in [[30.0, 40.000_000_1], [5.999_999_9, 8.0], [0.0, 0.0], [f64::NAN, 1.0]] {
            let refused = arm().inverse(&Vec2::from(out));
            assert!(matches!(refused, Err(KinematicsError::OutOfReach { .. })), "{out:?}: {refused:?}");
        }
        let message = arm().inverse(&Vec2::new(0.0, 51.0)).unwrap_err().to_string();
        assert_eq!(message, "target (0, 51) is 51 from the base; the arm reaches from 10 to 50");
    }

    #[test]
    fn equal_links_reach_their_own_base() {
        let arm = Planar2r::new(1.0, 1.0).unwrap();
        let both = arm.inverse(&Vec2::zeros()).unwrap();
        assert_eq!(both.positive[1], PI);
        assert!(arm.forward(both.positive).norm() < 1e-15, "{both:?}");
    }

    #[test]
    fn the_elbow_rules_agree_right_of_the_base_and_part_left_of_it() {
        let pick = |x: f64, y: f64, rule| {
            let target = Vec2::new(x, y);
            arm().pick(&arm().inverse(&target).unwrap(), rule)
        };
        for x in 1..40 {
            let x = f64::from(x);
            let y = 25.0;
            assert!(pick(x, y, ElbowRule::NegativeQ2)[1] < 0.0);
            assert_eq!(pick(x, y, ElbowRule::HigherElbow), pick(x, y, ElbowRule::NegativeQ2), "{x}");
            assert!(pick(-x, y, ElbowRule::NegativeQ2)[1] < 0.0);
            assert!(pick(-x, y, ElbowRule::HigherElbow)[1] > 0.0, "{x}");
        }
    }

    #[test]
    fn along_a_path_one_branch_is_continuous_and_the_higher_elbow_jumps_above_the_base() {
        let largest_jump = |rule| {
            let station = |step: i32| {
                let target = Vec2::new(f64::from(step) * 0.1, 30.0);
                arm().pick(&arm().inverse(&target).unwrap(), rule)
            };
            (-300..300)
                .map(|step| {
                    let (from, to) = (station(step), station(step + 1));
                    let to = continued(from, to);
                    (to[0] - from[0]).abs().max((to[1] - from[1]).abs())
                })
                .fold(0.0, f64::max)
        };
        assert!(largest_jump(ElbowRule::NegativeQ2) < 0.02);
        assert!(largest_jump(ElbowRule::HigherElbow) > 1.0);
    }

    #[test]
    fn a_link_must_have_a_length() {
        for (l1, l2, link) in [(0.0, 1.0, 1), (1.0, -2.0, 2), (1.0, f64::NAN, 2), (f64::INFINITY, 1.0, 1)] {
            let refused = Planar2r::new(l1, l2).unwrap_err().to_string();
            assert!(refused.starts_with(&format!("link {link} is ")), "{refused}");
        }
    }
}
