//! The joints along a straight way of the tool: inverse kinematics in lanes, verdicts in order.

use crate::geometry::lanes::{LANES, Row, SLACK, dispatch, level};
use crate::kinematics::angle::nearest_copy;
use crate::kinematics::ik::{Branch, LaneSolutions};
use crate::kinematics::{AXES, Joint, Joints};
use crate::space::cell::limits::PARTS;
use crate::space::cell::lines::{SAME_RAD, StepSchedule, largest_change};
use crate::space::cell::way::Way;
use crate::space::cell::{Lines, Pose, Rejection};
use std::f64::consts::{PI, TAU};

/// Whether `value` is above `bound`; `None` if it is too close to it to say, or not a number.
#[inline]
fn exceeds(value: f64, bound: f64) -> Option<bool> {
    if value > bound + SLACK {
        Some(true)
    } else if value < bound - SLACK {
        Some(false)
    } else {
        None
    }
}

/// [`Joint::nearest_allowed_copy`] of an angle known to less than [`SLACK`]; `None` if it is uncertain.
#[inline]
fn allowed_copy(joint: &Joint, angle_rad: f64, reference_rad: f64) -> Option<Result<f64, Rejection>> {
    let near = nearest_copy(angle_rad, reference_rad);
    if exceeds((near - reference_rad).abs(), PI)? {
        return None;
    }
    let is_inside = |angle: f64| angle > joint.lower_rad + SLACK && angle < joint.upper_rad - SLACK;
    if is_inside(near) {
        return Some(Ok(near));
    }
    let [low, high] = [-SLACK, SLACK].map(|d| joint.nearest_allowed_copy(near + d, reference_rad));
    match (low, high) {
        (None, None) => Some(Err(Rejection::Limits)),
        (Some(_), Some(_)) => {
            joint.nearest_allowed_copy(near, reference_rad).filter(|copy| is_inside(*copy)).map(Ok)
        }
        _ => None,
    }
}

impl Lines {
    /// Writes the configurations along `way` into `states`; steps in doubt are taken by the scalar code. `None` if the end
    /// is in doubt, or if the arm has no lanes.
    pub(super) fn follow_lanes(
        &self,
        from: &Pose,
        to: &Pose,
        way: &Way,
        states: &mut Vec<Joints>,
    ) -> Option<Result<(), Rejection>> {
        if way.turn_rad > self.rules.turn_rad {
            return Some(Err(Rejection::Turn));
        }
        let pace = self.pace(way);
        let steps = pace.steps as u32;
        states.resize(steps as usize + 1, from.q);
        states[0] = from.q;
        let mut is_exact = true;
        for first in (1..=steps).step_by(LANES) {
            let shares: Row = std::array::from_fn(|lane| pace.share(first + lane as u32).min(1.0));
            let poses = dispatch!(level(), simd => way.at_lanes(simd, shares));
            let found = self.cell.robot.arm().solve_lanes(&poses, from.branch)?;
            for step in first..=steps.min(first + LANES as u32 - 1) {
                // The angles are written where they stay: copied, they would be waited for.
                let (before, rest) = states.split_at_mut(step as usize);
                let last = &before[before.len() - 1];
                let next = &mut rest[0];
                match self.sure_step(&found, (step - first) as usize, &pace, step, last, next) {
                    Some(Err(reason)) => return Some(Err(reason)),
                    Some(Ok(())) if self.surely_keeps(way, from.branch, &pace, step, [last, next]) => {
                        is_exact = false;
                    }
                    _ => match self.exact_step(way, from.branch, &pace, step, (last, is_exact)) {
                        Ok(q) => (*next, is_exact) = (q, true),
                        Err(reason) => return Some(Err(reason)),
                    },
                }
            }
        }
        self.arrives_surely(&states[steps as usize], &to.q)
    }

    /// One step by the scalar code, from where the scalar code would be: at `last`, if that is its own to the last bit.
    #[cold]
    fn exact_step(
        &self,
        way: &Way,
        branch: Branch,
        pace: &StepSchedule,
        step: u32,
        (last, is_exact): (&Joints, bool),
    ) -> Result<Joints, Rejection> {
        // A sure configuration is regular and away from limits: as its own reference it comes back with all its bits.
        let exact = if is_exact {
            *last
        } else {
            let before = self.cell.robot.arm().follow(&way.at(pace.share(step - 1)), branch, last);
            before.expect("the lanes were sure of this configuration")
        };
        self.step(way, branch, pace, step, &exact)
    }

    /// One step by the lanes, to `next`; `None` in doubt.
    #[inline]
    fn sure_step(
        &self,
        found: &LaneSolutions,
        lane: usize,
        pace: &StepSchedule,
        step: u32,
        last: &Joints,
        next: &mut Joints,
    ) -> Option<Result<(), Rejection>> {
        if found.unreachable >> lane & 1 == 1 {
            return Some(Err(Rejection::Unreachable));
        }
        if found.solved >> lane & 1 == 0 {
            return None;
        }
        for (i, joint) in self.cell.robot.arm().chain().joints().iter().enumerate() {
            match allowed_copy(joint, found.q[i][lane], last[i])? {
                Ok(copy) => next[i] = copy,
                Err(reason) => return Some(Err(reason)),
            }
        }
        if self.surely_leaves_branch(next, last)? {
            return Some(Err(Rejection::Branch));
        }
        let change = largest_change(next, last);
        if exceeds(change, self.rules.jump_rad)? {
            let reason = if exceeds(change, 0.9 * TAU)? { Rejection::Limits } else { Rejection::Jump };
            return Some(Err(reason));
        }
        if self.is_too_fast(pace, step, last, next)? {
            return Some(Err(Rejection::Speed));
        }
        Some(Ok(()))
    }

    /// Whether another branch offers a smaller change than `q` does from `last`; `None` in doubt.
    #[inline]
    fn surely_leaves_branch(&self, q: &Joints, last: &Joints) -> Option<bool> {
        let change2: f64 = q.iter().zip(last).map(|(a, b)| (a - b) * (a - b)).sum();
        let flips_rad = self.cell.robot.arm().flips_rad(q, last);
        let nearest_rad = flips_rad[0].min(flips_rad[1]);
        if exceeds(change2, nearest_rad * nearest_rad)? {
            self.surely_prefers_other_wrist(q, last, change2, flips_rad[0])
        } else {
            Some(false)
        }
    }

    /// The same where another branch may be nearer: known if that is the one with the wrist the other way round.
    fn surely_prefers_other_wrist(
        &self,
        q: &Joints,
        last: &Joints,
        change2: f64,
        elbow_rad: f64,
    ) -> Option<bool> {
        let arm = self.cell.robot.arm();
        let other = arm.other_wrist(q)?;
        let mut other2 = Some(0.0);
        for (i, joint) in arm.chain().joints().iter().enumerate() {
            let copy = allowed_copy(joint, other[i], last[i])?.ok();
            other2 = other2.zip(copy).map(|(sum, copy)| sum + (copy - last[i]) * (copy - last[i]));
        }
        let leaves = other2.map_or(Some(false), |other2| exceeds(change2, other2))?;
        // All further branches are at least so far from `last`; where one branch is nearer, a second one changes nothing.
        let further_rad = elbow_rad.min(PI - (q[0] - last[0]).abs());
        if leaves || !exceeds(change2, further_rad * further_rad)? { Some(leaves) } else { None }
    }

    /// Whether [`keeps_limits_between`](Lines::keeps_limits_between) surely holds; where it does not, the scalar code says why.
    #[inline]
    fn surely_keeps(
        &self,
        way: &Way,
        branch: Branch,
        pace: &StepSchedule,
        step: u32,
        [last, q]: [&Joints; 2],
    ) -> bool {
        let slack_rad = 3.0 * SLACK;
        if !self.nears_limit(last, q, slack_rad) && !self.nears_reach(last, q, slack_rad) {
            return true;
        }
        let share = |lane: usize| pace.share(step) - (1.0 - PARTS[lane % PARTS.len()]) / pace.steps;
        let shares: Row = std::array::from_fn(share);
        let poses = dispatch!(level(), simd => way.at_lanes(simd, shares));
        let arm = self.cell.robot().arm();
        let Some(found) = arm.solve_lanes(&poses, branch) else { return false };
        // A joint that could go on only by a turn back has no copy that is surely the nearest.
        let keeps = |lane: usize| {
            let mut joints = arm.chain().joints().iter().enumerate();
            joints.all(|(i, joint)| {
                let copy = allowed_copy(joint, found.q[i][lane], last[i]);
                copy.and_then(Result::ok).is_some_and(|copy| (copy - last[i]).abs() < PI - SLACK)
            })
        };
        (0..PARTS.len()).all(|lane| found.solved >> lane & 1 == 1 && keeps(lane))
    }

    /// Whether a joint is faster than it can be in this step; `None` in doubt.
    #[inline]
    fn is_too_fast(&self, pace: &StepSchedule, step: u32, last: &Joints, q: &Joints) -> Option<bool> {
        let Some(law) = &self.rules.speed else { return Some(false) };
        let duration_s = pace.duration_s(law, step);
        for (joint, (a, b)) in self.cell.robot.arm().chain().joints().iter().zip(q.iter().zip(last)) {
            if exceeds((a - b).abs(), joint.speed_rad_s * duration_s)? {
                return Some(true);
            }
        }
        Some(false)
    }

    fn arrives_surely(&self, end: &Joints, wanted: &Joints) -> Option<Result<(), Rejection>> {
        for i in 0..AXES {
            if exceeds(self.end_gap_rad(end, wanted, i).abs(), SAME_RAD)? {
                return Some(Err(Rejection::End));
            }
        }
        Some(Ok(()))
    }
}
