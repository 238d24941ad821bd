//! Local paths: what joins two configurations without a search.
//!
//! The tool goes on a straight line, its orientation about one axis (slerp), both at even steps; the joints follow by
//! inverse kinematics. At each step the configuration of the smallest change is taken; it is sought on the branch in
//! hand, and on all only where another could be nearer. A path is refused for any of these: a change of branch, a pose
//! out of reach or limits, a jump of a joint, or a joint too fast under the tool's time law. A contact refuses it too,
//! and an end in another configuration than the one requested. Jumps are judged at the steps; limits and reach too and,
//! where a joint is near a limit or the elbow all but stretched or folded, at every quarter of a step.
//!
//! **What can slip through.** Every checked configuration is checked with each part thickened by 0.51 of the longest
//! way that an end of its axis goes to the next checked ones. A contact between two that are clear is then possible
//! only where an axis end travels 2 % further than its chord. Where a thickened part is near an obstacle the step is
//! halved, three times at most. What then slips is thinner than the way of a part in an eighth of a step (2.5 mm of the
//! tool at 20 mm). Reach, checked at quarters where the elbow is all but stretched, may be left between two of those,
//! as far as a quarter of a step bulges. That is a sixteenth of what a step does, some thousandths of a millimetre.
//!
//! # Source
//! Fu et al., *Robotics and Autonomous Systems* 106 (2018), section 3.1.

use super::doubt::{HALF_WAY, HALVINGS, UnsettledPath, axis_way_m};
use super::lines::{
    EdgeEnd, Lines, Path, Pose, Rejection, SAME_RAD, StepSchedule, between, largest_change, middle_outwards,
};
use super::way::Way;
use super::{Obstacle, Standing, lanes};
use crate::geometry::{Capsule, Frame};
use crate::kinematics::ik::Branch;
use crate::kinematics::{AXES, Joints, Missed};
use std::f64::consts::TAU;

/// Buffers that are reused from attempt to attempt.
#[derive(Debug, Default)]
pub struct Scratch {
    pub(super) states: Vec<Joints>,
    placed: Vec<Capsule>,
    ways: Vec<f64>,
    lanes: lanes::Memory,
    checked: u64,
}

impl Scratch {
    /// How many configurations were checked for contact.
    pub fn checked(&self) -> u64 {
        self.checked
    }

    /// The same, for those who check by themselves.
    pub fn count(&mut self) -> &mut u64 {
        &mut self.checked
    }
}

impl Lines {
    /// Whether the local path between two free configurations can be executed.
    ///
    /// Eight configurations are checked at once; what lies within the error band is checked again one at a time.
    ///
    /// # Errors
    /// The first reason against it.
    pub fn join(&self, from: &Pose, to: &Pose, scratch: &mut Scratch) -> Result<(), Rejection> {
        if self.parts_branches(from, to) {
            return Err(Rejection::Branch);
        }
        let settled = self.join_lanes(from, to, &mut scratch.lanes, &mut scratch.checked);
        settled.unwrap_or_else(|| self.join_singly(from, to, scratch))
    }

    /// [`join`](Self::join), one configuration at a time.
    pub(super) fn join_singly(&self, from: &Pose, to: &Pose, scratch: &mut Scratch) -> Result<(), Rejection> {
        let way = match self.rules.path {
            Path::Joints => {
                let steps = self.joint_steps(from, to);
                scratch.states.clear();
                let shares = (0..=steps as u32).map(|step| f64::from(step) / steps);
                let end = self.cell.robot().arm().chain().toward(&from.q, &to.q);
                scratch.states.extend(shares.map(|share| between(&from.q, &end, share)));
                None
            }
            Path::Tool => {
                if self.parts_branches(from, to) {
                    return Err(Rejection::Branch);
                }
                let way = Way::between(&from.tool, &to.tool);
                self.follow(from, &way, &mut scratch.states)?;
                let end = scratch.states.last().expect("a path has at least its ends");
                self.arrives(end, &to.q)?;
                Some(way)
            }
        };
        self.clear(way.as_ref(), from.branch, scratch)
    }

    /// The least clearance at the steps of the local path between two configurations, as [`clearance_m`](super::Cell::clearance_m) has it; `None` if
    /// the joints cannot follow it or arrive in another configuration than the one requested.
    pub fn clearance_m(
        &self,
        from: &Pose,
        to: &Pose,
        scratch: &mut Scratch,
    ) -> Option<(f64, Option<&Obstacle>)> {
        if self.parts_branches(from, to) {
            return None;
        }
        match self.join_singly(from, to, scratch) {
            Ok(()) | Err(Rejection::Contact) => {}
            Err(_) => return None,
        }
        scratch.states.iter().map(|q| self.cell.clearance_m(q)).min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// The configurations at even steps from `from` along `way`, both ends included.
    fn follow(&self, from: &Pose, way: &Way, states: &mut Vec<Joints>) -> Result<(), Rejection> {
        let rules = &self.rules;
        if way.turn_rad > rules.turn_rad {
            return Err(Rejection::Turn);
        }
        let pace = self.pace(way);
        states.clear();
        states.push(from.q);
        let mut last = from.q;
        for step in 1..=pace.steps as u32 {
            last = self.step(way, from.branch, &pace, step, &last)?;
            states.push(last);
        }
        Ok(())
    }

    /// The configuration at the step of this number, on from the one before.
    pub(super) fn step(
        &self,
        way: &Way,
        branch: Branch,
        pace: &StepSchedule,
        step: u32,
        last: &Joints,
    ) -> Result<Joints, Rejection> {
        let rules = &self.rules;
        let arm = self.cell.robot().arm();
        let target = way.at(pace.share(step));
        let q = arm.follow(&target, branch, last).map_err(|missed| match missed {
            Missed::Unreachable => Rejection::Unreachable,
            Missed::Limits => Rejection::Limits,
        })?;
        if self.leaves_branch(&q, last, branch, &target) {
            return Err(Rejection::Branch);
        }
        let change = largest_change(&q, last);
        if change > rules.jump_rad {
            // Only a joint that ran into a limit goes back by a turn.
            return Err(if change > 0.9 * TAU { Rejection::Limits } else { Rejection::Jump });
        }
        if let Some(law) = &rules.speed {
            let duration_s = pace.duration_s(law, step);
            let joints = arm.chain().joints().iter().zip(q.iter().zip(last));
            if joints.into_iter().any(|(j, (a, b))| (a - b).abs() > j.speed_rad_s * duration_s) {
                return Err(Rejection::Speed);
            }
        }
        let within = |part: f64| way.at(pace.share(step) - (1.0 - part) / pace.steps);
        self.keeps_limits_between([last, &q], branch, within)?;
        Ok(q)
    }

    pub(super) fn pace(&self, way: &Way) -> StepSchedule {
        let rules = &self.rules;
        let length_m = way.along.norm();
        let steps = (length_m / rules.step_m).max(way.turn_rad / rules.step_rad).ceil().max(1.0);
        StepSchedule { steps, law_m: length_m.max(way.turn_rad / rules.step_rad * rules.step_m) }
    }

    /// Whether another branch offers a smaller change than `q`, of `branch`, does from `last`.
    ///
    /// All branches are tried only where the elbow or the wrist the other way round could be as near.
    #[inline]
    fn leaves_branch(&self, q: &Joints, last: &Joints, branch: Branch, target: &Frame) -> bool {
        let arm = self.cell.robot().arm();
        let change: f64 = q.iter().zip(last).map(|(a, b)| (a - b) * (a - b)).sum();
        let flip_rad = arm.nearest_flip_rad(q, last);
        change >= flip_rad * flip_rad
            && arm.inverse_nearest(target, last).is_none_or(|(nearest, _)| nearest != branch)
    }

    fn arrives(&self, end: &Joints, wanted: &Joints) -> Result<(), Rejection> {
        let far = (0..AXES).any(|i| self.end_gap_rad(end, wanted, i).abs() > SAME_RAD);
        if far { Err(Rejection::End) } else { Ok(()) }
    }

    /// How far joint `i` arrives from where it should be; whole turns do not count where the rules or the joint make nothing of them.
    pub(super) fn end_gap_rad(&self, end: &Joints, wanted: &Joints, i: usize) -> f64 {
        let gap = end[i] - wanted[i];
        let turns_free = match self.rules.end {
            EdgeEnd::PoseOnly => return 0.0,
            EdgeEnd::WholeTurns => i == 3 || i == 5,
            EdgeEnd::Own => false,
        };
        let is_same_after_turns = turns_free || self.cell.robot().arm().chain().joints()[i].is_endless();
        if is_same_after_turns { gap - (gap / TAU).round() * TAU } else { gap }
    }

    /// How many steps a path takes that is straight in joint space.
    pub(super) fn joint_steps(&self, from: &Pose, to: &Pose) -> f64 {
        let end = self.cell.robot().arm().chain().toward(&from.q, &to.q);
        (largest_change(&from.q, &end) / self.rules.step_rad).ceil().max(1.0)
    }

    /// Whether no configuration of `scratch` and none between them is in contact: from the middle outwards.
    fn clear(&self, way: Option<&Way>, branch: Branch, scratch: &mut Scratch) -> Result<(), Rejection> {
        let chain = self.cell.robot().arm().chain();
        let parts = self.cell.body().parts();
        let Scratch { states, placed, ways, checked, .. } = scratch;
        placed.clear();
        for q in states.iter() {
            let frames = chain.frames(q);
            placed.extend(parts.iter().map(|part| part.placed(&frames)));
        }
        let at = |state: usize| &placed[state * parts.len()..(state + 1) * parts.len()];
        ways.clear();
        for step in 1..states.len() {
            ways.extend(at(step - 1).iter().zip(at(step)).map(|(a, b)| axis_way_m(a, b)));
        }
        // The way of a part to the state `step` and on from it; there is none before the first and after the last.
        let way_m = |step: usize, part: usize| {
            let before = if step == 0 { 0.0 } else { ways[(step - 1) * parts.len() + part] };
            ways.get(step * parts.len() + part).map_or(before, |after| before.max(*after))
        };
        let mut near = Vec::new();
        for state in middle_outwards(states.len()) {
            let reach = |part| HALF_WAY * way_m(state, part);
            *checked += 1;
            match self.cell.standing(at(state), reach) {
                Standing::Contact => return Err(Rejection::Contact),
                Standing::Near => near.push(state),
                Standing::Clear => {}
            }
        }
        let share = |state: usize| state as f64 / (states.len() - 1) as f64;
        let doubtful = (1..states.len()).filter(|step| near.contains(step) || near.contains(&(step - 1)));
        for step in doubtful {
            let ends = [step - 1, step].map(|state| (share(state), states[state], at(state)));
            let ends_q = [states[0], states[states.len() - 1]];
            UnsettledPath { lines: self, way, branch, ends_q }.settle([ends[0], ends[1]], HALVINGS)?;
        }
        Ok(())
    }
}
