//! Limits and reach between two steps of a local path. A joint that bends there may leave its range and come back, and a wrist
//! that passes the edge of its reach may be beyond it.

use super::lines::{Lines, Rejection};
use crate::geometry::Frame;
use crate::kinematics::ik::Branch;
use crate::kinematics::serial::Joint;
use crate::kinematics::{Joints, Missed};
use std::f64::consts::{PI, TAU};

/// The parts of a step at which limits and reach are checked where they are near; the verifier stops there too.
pub(super) const PARTS: [f64; 3] = [0.25, 0.5, 0.75];

/// How far the elbow is from being stretched or folded before the wrist cannot leave its reach between two steps.
///
/// Say a way of 40 mm (20 mm of the tool and 4° of a hand of 300 mm) begins and ends at the edge of a reach of 1.2 m. It
/// bulges over it by 0.17 mm, which is 2° of the elbow. One around the hole of 80 mm in the middle bulges by 2.5 mm,
/// which is 2° too.
const EDGE_RAD: f64 = 0.05;

/// How far a joint may bend out of what lies between its angles at two steps, 1°. A joint that turns back within a step passes no
/// limit by the turn it makes: it comes and goes. What it strays by is at most an eighth of its second difference, and one of 8°
/// is a jump where 5° are one. Without this, paths that had turned back 0.003° beyond ±360° were found and then refused.
const STRAY_RAD: f64 = PI / 180.0;

impl Lines {
    /// Whether a joint is nearer to a limit than it turns from `last` to `next` and [`STRAY_RAD`], or than that and `slack_rad`.
    #[inline]
    pub(super) fn nears_limit(&self, last: &Joints, next: &Joints, slack_rad: f64) -> bool {
        let joints = self.cell().robot().arm().chain().joints();
        let mut pairs = joints.iter().zip(last.iter().zip(next));
        pairs.any(|(joint, (a, b))| is_near_limit(joint, *a, *b, slack_rad))
    }

    /// Whether the elbow is all but stretched or folded before or after a step, by [`EDGE_RAD`] and `slack_rad`.
    #[inline]
    pub(super) fn nears_reach(&self, last: &Joints, next: &Joints, slack_rad: f64) -> bool {
        let arm = self.cell().robot().arm();
        let edge_rad = EDGE_RAD + slack_rad;
        let is_at_edge = |q: &&Joints| {
            let fold_rad = arm.elbow_fold_rad(q).abs();
            [0.0, PI, TAU].iter().any(|edge| (fold_rad - edge).abs() < edge_rad)
        };
        // A solver that is not complete does not know how its arm folds.
        arm.solver().is_complete && [last, next].iter().any(is_at_edge)
    }

    /// Whether joints keep to their limits, and the wrist to its reach, between two steps; `target` is where the tool is after a
    /// part of the step.
    ///
    /// A joint is checked only if it is nearer to a limit than it turns in the step and may stray beside.
    ///
    /// # Errors
    /// [`Rejection::Limits`], or [`Rejection::Unreachable`] if the wrist cannot be there.
    #[inline]
    pub(super) fn keeps_limits_between(
        &self,
        [last, next]: [&Joints; 2],
        branch: Branch,
        target: impl Fn(f64) -> Frame,
    ) -> Result<(), Rejection> {
        if !self.nears_limit(last, next, 0.0) && !self.nears_reach(last, next, 0.0) {
            return Ok(());
        }
        let arm = self.cell().robot().arm();
        for part in PARTS {
            let q = arm.follow(&target(part), branch, last).map_err(|missed| match missed {
                Missed::Unreachable => Rejection::Unreachable,
                Missed::Limits => Rejection::Limits,
            })?;
            // A joint that could go on only by a turn back has met its limit.
            if q.iter().zip(last).any(|(a, b)| (a - b).abs() > PI) {
                return Err(Rejection::Limits);
            }
        }
        Ok(())
    }
}

fn is_near_limit(joint: &Joint, a_rad: f64, b_rad: f64, slack_rad: f64) -> bool {
    let turn_rad = (a_rad - b_rad).abs() + STRAY_RAD + slack_rad;
    a_rad.max(b_rad) + turn_rad > joint.upper_rad || a_rad.min(b_rad) - turn_rad < joint.lower_rad
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_joint_is_near_a_limit_if_one_more_such_step_would_pass_it() {
        let joint = Joint {
            alpha_rad: 0.0,
            a_m: 0.0,
            d_m: 0.0,
            offset_rad: 0.0,
            lower_rad: -1.0,
            upper_rad: 2.0,
            speed_rad_s: 1.0,
        };
        for (a, b, near) in [
            (0.0, 0.5, false),
            (1.0, 1.4, false),
            (1.4, 1.8, true),
            (1.8, 1.4, true),
            (-0.7, -0.2, true),
            (1.99, 1.99, true),
        ] {
            assert_eq!(is_near_limit(&joint, a, b, 0.0), near, "{a} to {b}");
        }
    }
}
