//! The joints along a straight way of the tool: inverse kinematics in lanes, verdicts in order.

use crate::geometry::lanes::{LANES, Row, SLACK, dispatch, level};
use crate::kinematics::angle::nearest_copy;
use crate::kinematics::ik::{Branch, LaneSolutions};
use crate::kinematics::{AXES, Joint, Joints};
use crate::space::cell::limits::PARTS;
use crate::space::cell::lines::{EdgeEnd, Pace, SAME_RAD, largest_change};
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

/// [`Joint::nearest_allowed_copy`] of an angle known to less than [`SLACK`]; `None` if it cannot be told.
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

/// The configuration reached so far.
struct Reached {
    q: Joints,
    /// Whether it is the scalar code's to the last bit.
    is_exact: bool,
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
        states.clear();
        states.push(from.q);
        let mut last = Reached { q: from.q, is_exact: true };
        for first in (1..=steps).step_by(LANES) {
            let shares: Row = std::array::from_fn(|lane| pace.share(first + lane as u32).min(1.0));
            let poses = dispatch!(level(), simd => way.at_lanes(simd, shares));
            let found = self.cell.robot.arm().solve_lanes(&poses, from.branch)?;
            for step in first..=steps.min(first + LANES as u32 - 1) {
                let sure = self.sure_step(&found, (step - first) as usize, &pace, step, &last.q);
                let keeps = |q: &Joints| self.surely_keeps(way, from.branch, &pace, step, [&last.q, q]);
                let sure = sure.filter(|taken| taken.as_ref().map_or(true, keeps));
                let taken = sure.map(|taken| taken.map(|q| Reached { q, is_exact: false }));
                match taken.unwrap_or_else(|| self.exact_step(way, from.branch, &pace, step, &last)) {
                    Ok(reached) => last = reached,
                    Err(reason) => return Some(Err(reason)),
                }
                states.push(last.q);
            }
        }
        self.arrives_surely(&last.q, &to.q)
    }

    /// One step by the scalar code, from where the scalar code would be.
    #[cold]
    fn exact_step(
        &self,
        way: &Way,
        branch: Branch,
        pace: &Pace,
        step: u32,
        last: &Reached,
    ) -> Result<Reached, Rejection> {
        // A sure configuration is regular and away from limits: as its own reference it comes back with all its bits.
        let exact = if last.is_exact {
            last.q
        } else {
            let before = self.cell.robot.arm().follow(&way.at(pace.share(step - 1)), branch, &last.q);
            before.expect("the lanes were sure of this configuration")
        };
        self.step(way, branch, pace, step, &exact).map(|q| Reached { q, is_exact: true })
    }

    /// One step by the lanes; `None` in doubt.
    #[inline]
    fn sure_step(
        &self,
        found: &LaneSolutions,
        lane: usize,
        pace: &Pace,
        step: u32,
        last: &Joints,
    ) -> Option<Result<Joints, Rejection>> {
        if found.unreachable >> lane & 1 == 1 {
            return Some(Err(Rejection::Unreachable));
        }
        if found.solved >> lane & 1 == 0 {
            return None;
        }
        let (rules, arm) = (&self.rules, self.cell.robot.arm());
        let mut q = [0.0; AXES];
        for (i, joint) in arm.chain().joints().iter().enumerate() {
            match allowed_copy(joint, found.q[i][lane], last[i])? {
                Ok(copy) => q[i] = copy,
                Err(reason) => return Some(Err(reason)),
            }
        }
        let change2: f64 = q.iter().zip(last).map(|(a, b)| (a - b) * (a - b)).sum();
        let flip_rad = arm.nearest_flip_rad(&q, last);
        if exceeds(change2, flip_rad * flip_rad)? {
            // Another branch may be nearer; all of them are asked one by one.
            return None;
        }
        let change = largest_change(&q, last);
        if exceeds(change, rules.jump_rad)? {
            let reason = if exceeds(change, 0.9 * TAU)? { Rejection::Limits } else { Rejection::Jump };
            return Some(Err(reason));
        }
        if self.is_too_fast(pace, step, last, &q)? {
            return Some(Err(Rejection::Speed));
        }
        Some(Ok(q))
    }

    /// Whether [`keeps_limits_between`](Lines::keeps_limits_between) surely holds; where it does not, the scalar code says why.
    #[inline]
    fn surely_keeps(
        &self,
        way: &Way,
        branch: Branch,
        pace: &Pace,
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
        // A joint that could go on only by a turn back is none of which a copy surely is the nearest.
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
    fn is_too_fast(&self, pace: &Pace, step: u32, last: &Joints, q: &Joints) -> Option<bool> {
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
            let gap = end[i] - wanted[i];
            let turns = if i == 3 || i == 5 { (gap / TAU).round() * TAU } else { 0.0 };
            let gap = match self.rules.end {
                EdgeEnd::Own => gap,
                EdgeEnd::WholeTurns => gap - turns,
                EdgeEnd::PoseOnly => 0.0,
            };
            if exceeds(gap.abs(), SAME_RAD)? {
                return Some(Err(Rejection::End));
            }
        }
        Some(Ok(()))
    }
}
