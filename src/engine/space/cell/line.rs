//! Local paths: what joins two configurations without a search.
//!
//! The tool goes on a straight line, its orientation about one axis (slerp), both at even steps; the joints follow by
//! inverse kinematics. At each step the configuration of the smallest change is taken; it is sought on the branch in hand, and
//! on all only where another could be nearer. A path is refused for a change of branch, a pose out of reach or limits, a
//! jump of a joint, a joint too fast under the tool's time law, an end in another configuration than the one asked
//! for, or a contact. Jumps are judged at the steps; limits too and, where a joint is near one, at every quarter of a step.
//!
//! **What can slip through.** Every checked configuration is checked with each part thickened by 0.51 of the longest
//! way that an end of its axis goes to the next checked ones. A contact between two that are clear is
//! then possible only where an axis end travels 2 % further than its chord. Where a thickened part is near an obstacle the
//! step is halved, three times at most; what then slips is thinner than the way of a part in an eighth of a
//! step (2.5 mm of the tool at 20 mm).
//!
//! # Source
//! Fu et al., *Robotics and Autonomous Systems* 106 (2018), section 3.1.

use super::doubt::{Doubt, HALF_WAY, HALVINGS, axis_way_m};
use super::time_law::SpeedRule;
use super::way::Way;
use super::{Cell, Standing, lanes};
use crate::geometry::{Capsule, Frame};
use crate::kinematics::ik::Branch;
use crate::kinematics::{AXES, Joints, Missed};
use std::f64::consts::TAU;

/// How far a configuration at the end of an edge may be from the one asked for: radians.
pub(super) const SAME_RAD: f64 = 1e-6;

/// Why there is no local path.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Rejection {
    /// The ends are on different branches of the inverse kinematics.
    Branch,
    /// The orientation turns by more than is allowed on one edge.
    Turn,
    /// The wrist is out of reach on the way.
    Unreachable,
    /// A joint would leave its limits.
    Limits,
    /// A joint jumps within one step.
    Jump,
    /// A joint is faster than it can be under the tool's time law.
    Speed,
    /// The joints arrive in another configuration.
    End,
    /// The robot touches something.
    Contact,
}

impl Rejection {
    /// Every reason, in the order in which they are counted.
    pub const ALL: [Self; 8] = [
        Self::Branch,
        Self::Turn,
        Self::Unreachable,
        Self::Limits,
        Self::Jump,
        Self::Speed,
        Self::End,
        Self::Contact,
    ];
}

/// What the end of an edge must be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EdgeEnd {
    /// The configuration itself.
    Own,
    /// The configuration, joints 4 and 6 up to whole turns.
    WholeTurns,
    /// Any configuration with the tool in the same pose.
    PoseOnly,
}

/// What is straight.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Path {
    /// The tool's way.
    Tool,
    /// The way in the space of joint angles.
    Joints,
}

/// What a local path must keep to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineRules {
    /// What is straight.
    pub path: Path,
    /// The longest step of the tool's place.
    pub step_m: f64,
    /// The longest step of its orientation; of any joint on a path that is straight in joint space.
    pub step_rad: f64,
    /// The most that a joint may change in one step.
    pub jump_rad: f64,
    /// The most that the orientation may change on one edge.
    pub turn_rad: f64,
    /// The time law under which joint speeds are checked, if they are.
    pub speed: Option<SpeedRule>,
    /// What the end must be.
    pub end: EdgeEnd,
}

/// A configuration with what local paths ask of it.
#[derive(Debug, Clone, Copy)]
pub struct Pose {
    /// The joint angles.
    pub q: Joints,
    /// The tool in the world.
    pub tool: Frame,
    /// The branch it is on.
    pub branch: Branch,
}

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
}

/// How a tool path is divided into steps.
pub(super) struct Pace {
    /// How many steps it takes.
    pub(super) steps: f64,
    /// Its length under the time law: a turn counts as the way that takes as many steps.
    law_m: f64,
}

impl Pace {
    #[inline]
    pub(super) fn share(&self, step: u32) -> f64 {
        f64::from(step) / self.steps
    }

    /// How long the step of this number takes.
    #[inline]
    pub(super) fn duration_s(&self, law: &SpeedRule, step: u32) -> f64 {
        let (share, law_m) = (self.share(step), self.law_m);
        let before = (share - 1.0 / self.steps) * law_m;
        law.time_s(share * law_m, law_m) - law.time_s(before, law_m)
    }
}

/// The local path planner of a cell.
#[derive(Debug, Clone)]
pub struct Lines {
    pub(super) cell: Cell,
    pub(super) rules: LineRules,
}

impl Lines {
    /// The local path planner of `cell` under `rules`.
    pub fn new(cell: Cell, rules: LineRules) -> Self {
        Self { cell, rules }
    }

    /// The cell.
    pub fn cell(&self) -> &Cell {
        &self.cell
    }

    /// The rules.
    pub fn rules(&self) -> &LineRules {
        &self.rules
    }

    /// `q` with what local paths ask of it.
    pub fn pose(&self, q: &Joints) -> Pose {
        let arm = self.cell.robot().arm();
        Pose { q: *q, tool: arm.chain().forward(q), branch: arm.branch_of(q) }
    }

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

    /// Whether the ends alone rule a path out: on a straight way the branch cannot change.
    #[inline]
    pub(super) fn parts_branches(&self, from: &Pose, to: &Pose) -> bool {
        self.rules.path == Path::Tool && self.rules.end != EdgeEnd::PoseOnly && from.branch != to.branch
    }

    /// [`join`](Self::join), one configuration at a time.
    pub(super) fn join_singly(&self, from: &Pose, to: &Pose, scratch: &mut Scratch) -> Result<(), Rejection> {
        let way = match self.rules.path {
            Path::Joints => {
                let steps = self.joint_steps(from, to);
                scratch.states.clear();
                let shares = (0..=steps as u32).map(|step| f64::from(step) / steps);
                scratch.states.extend(shares.map(|share| between(&from.q, &to.q, share)));
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
        pace: &Pace,
        step: u32,
        last: &Joints,
    ) -> Result<Joints, Rejection> {
        let (rules, arm) = (&self.rules, self.cell.robot().arm());
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

    pub(super) fn pace(&self, way: &Way) -> Pace {
        let (rules, length_m) = (&self.rules, way.along.norm());
        let steps = (length_m / rules.step_m).max(way.turn_rad / rules.step_rad).ceil().max(1.0);
        Pace { steps, law_m: length_m.max(way.turn_rad / rules.step_rad * rules.step_m) }
    }

    /// Whether another branch offers a smaller change than `q`, of `branch`, does from `last`.
    ///
    /// All branches are asked only where the elbow or the wrist the other way round could be as near.
    #[inline]
    fn leaves_branch(&self, q: &Joints, last: &Joints, branch: Branch, target: &Frame) -> bool {
        let arm = self.cell.robot().arm();
        let change: f64 = q.iter().zip(last).map(|(a, b)| (a - b) * (a - b)).sum();
        let flip_rad = arm.nearest_flip_rad(q, last);
        change >= flip_rad * flip_rad
            && arm.inverse_nearest(target, last).is_none_or(|(nearest, _)| nearest != branch)
    }

    fn arrives(&self, end: &Joints, wanted: &Joints) -> Result<(), Rejection> {
        let far = (0..AXES).any(|i| {
            let gap = end[i] - wanted[i];
            let turns = if i == 3 || i == 5 { (gap / TAU).round() * TAU } else { 0.0 };
            match self.rules.end {
                EdgeEnd::Own => gap.abs() > SAME_RAD,
                EdgeEnd::WholeTurns => (gap - turns).abs() > SAME_RAD,
                EdgeEnd::PoseOnly => false,
            }
        });
        if far { Err(Rejection::End) } else { Ok(()) }
    }

    /// How many steps a path takes that is straight in joint space.
    pub(super) fn joint_steps(&self, from: &Pose, to: &Pose) -> f64 {
        (largest_change(&from.q, &to.q) / self.rules.step_rad).ceil().max(1.0)
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
            Doubt { lines: self, way, branch, ends_q }.settle([ends[0], ends[1]], HALVINGS)?;
        }
        Ok(())
    }
}

pub(super) fn largest_change(a: &Joints, b: &Joints) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

pub(super) fn between(a: &Joints, b: &Joints, share: f64) -> Joints {
    std::array::from_fn(|i| a[i] + (b[i] - a[i]) * share)
}

/// 0 to `count - 1`, the middle first and the ends last.
pub(super) fn middle_outwards(count: usize) -> impl Iterator<Item = usize> {
    let middle = count / 2;
    (0..count).map(move |i| if i % 2 == 0 { middle + i / 2 } else { middle - i.div_ceil(2) })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_middle_comes_first_and_every_state_once() {
        for count in 1..20 {
            let mut order: Vec<usize> = middle_outwards(count).collect();
            assert_eq!(order[0], count / 2);
            order.sort_unstable();
            assert_eq!(order, (0..count).collect::<Vec<_>>(), "{count}");
        }
    }
}
