//! The limits of a local path, the reasons for refusing one, and the planner that holds both.
//!
//! `line` follows and checks a path one configuration at a time, `lanes` eight at once.

use super::Cell;
use super::time_law::SpeedRule;
use crate::geometry::Frame;
use crate::kinematics::Joints;
use crate::kinematics::ik::Branch;
use schemars::JsonSchema;
use serde::Deserialize;

/// How far a configuration at the end of an edge may be from the one requested: radians.
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
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum EdgeEnd {
    /// The configuration itself.
    Own,
    /// The configuration, joints 4 and 6 up to whole turns.
    WholeTurns,
    /// Any configuration with the tool in the same pose.
    PoseOnly,
}

/// What is straight.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
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
    /// Longest step of the tool point, in metres.
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

/// How a tool path is divided into steps.
pub(super) struct StepSchedule {
    /// How many steps it takes.
    pub(super) steps: f64,
    /// Its length under the time law: a turn counts as the way that takes as many steps.
    pub(super) law_m: f64,
}

impl StepSchedule {
    #[inline]
    pub(super) fn share(&self, step: u32) -> f64 {
        f64::from(step) / self.steps
    }

    /// How long the step of this number takes.
    #[inline]
    pub(super) fn duration_s(&self, law: &SpeedRule, step: u32) -> f64 {
        let share = self.share(step);
        let law_m = self.law_m;
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

    /// Whether the ends alone rule a path out: on a straight way the branch cannot change.
    #[inline]
    pub(super) fn parts_branches(&self, from: &Pose, to: &Pose) -> bool {
        self.rules.path == Path::Tool && self.rules.end != EdgeEnd::PoseOnly && from.branch != to.branch
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
