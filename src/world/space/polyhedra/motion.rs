//! What an arm does along a joint path: travel, range and jitter of joints, tip and posture.

use super::CarriedArm;
use crate::geometry::Vec3;
use crate::kinematics::AXES;

/// How many equal spans of time a joint path is looked at in, so that paths of other step lengths compare.
const SPANS: usize = 200;

/// What the joints, the tip and its posture do along a path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Motion {
    /// Turns of all joints, added up.
    pub joint_travel_rad: f64,
    /// The range from the least to the greatest angle of each joint, added up.
    pub joint_range_rad: f64,
    /// Second differences of the tip's place, added up.
    pub tip_jitter_cm: f64,
    /// Those of its posture.
    pub posture_jitter_rad: f64,
    /// Those of the joints.
    pub joint_jitter_rad: f64,
}

/// What is done along `path`, configurations following each other at equal times.
pub fn motion(arm: &CarriedArm, path: &[Vec<f64>]) -> Motion {
    let travel: f64 =
        path.windows(2).map(|pair| (0..AXES).map(|i| (pair[1][i] - pair[0][i]).abs()).sum::<f64>()).sum();
    let range = |i: usize| {
        let angles = path.iter().map(|q| q[i]);
        angles.clone().fold(f64::NEG_INFINITY, f64::max) - angles.fold(f64::INFINITY, f64::min)
    };
    let even = resampled(path);
    let tips: Vec<Vec3> = even.iter().map(|q| arm.tip(q)).collect();
    let turns: Vec<Vec3> = even.windows(2).map(|pair| turn(arm, &pair[0], &pair[1])).collect();
    let second = |a: f64, b: f64, c: f64| a - 2.0 * b + c;
    let tip: f64 = tips.windows(3).map(|t| (t[0] - t[1] * 2.0 + t[2]).norm()).sum();
    let posture: f64 = turns.windows(2).map(|t| (t[1] - t[0]).norm()).sum();
    let joint: f64 = even
        .windows(3)
        .map(|q| (0..AXES).map(|i| second(q[0][i], q[1][i], q[2][i]).abs()).sum::<f64>())
        .sum();
    Motion {
        joint_travel_rad: travel,
        joint_range_rad: (0..AXES).map(range).sum(),
        tip_jitter_cm: tip,
        posture_jitter_rad: posture,
        joint_jitter_rad: joint,
    }
}

/// The path at the ends of equal spans of time.
fn resampled(path: &[Vec<f64>]) -> Vec<[f64; AXES]> {
    let last = path.len() - 1;
    let at = |k: usize| {
        let place = k as f64 * last as f64 / SPANS as f64;
        let index = (place as usize).min(last.saturating_sub(1));
        let (from, to) = (&path[index], &path[(index + 1).min(last)]);
        std::array::from_fn(|i| from[i] + (to[i] - from[i]) * (place - index as f64))
    };
    (0..=SPANS).map(at).collect()
}

/// The rotation vector from the tip's posture at `a` to that at `b`.
fn turn(arm: &CarriedArm, a: &[f64; AXES], b: &[f64; AXES]) -> Vec3 {
    let [from, to] = [a, b].map(|q| arm.arm().chain().forward(q).rotation);
    let between = to * from.transpose();
    let axis = Vec3::new(
        between[(2, 1)] - between[(1, 2)],
        between[(0, 2)] - between[(2, 0)],
        between[(1, 0)] - between[(0, 1)],
    );
    let sine = axis.norm() / 2.0;
    let angle = libm::atan2(sine, (between.trace() - 1.0) / 2.0);
    if sine > 1e-12 { axis * (angle / (2.0 * sine)) } else { Vec3::zeros() }
}
