//! A chain with its inverse: poses of the tool in the world, joints within limits.

use super::{
    KinematicsError,
    angle::wrapped,
    ik::{self, Branch, Choice, LaneSolutions, Solutions, Solver},
    serial::{Chain, Joints},
};
use crate::geometry::Frame;
use crate::geometry::lanes::{self, Frames, PoseRows, dispatch};
use std::sync::Arc;

/// An arm that knows the way to a pose of its tool.
#[derive(Debug, Clone)]
pub struct Arm {
    chain: Chain,
    choice: Arc<Choice>,
    pub(super) solver: Arc<dyn Solver>,
    base_inverse: Frame,
    tool_inverse: Frame,
}

/// Why a branch has no configuration for a pose.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Missed {
    /// The pose is out of reach on this branch, or a solver that is not complete did not find it.
    Unreachable,
    /// A joint would be outside its limits.
    Limits,
}

impl Arm {
    /// The arm with this chain and the solver of this name, or the most special one that fits.
    ///
    /// # Errors
    /// Those of [`ik::solver`] and [`ik::fitting`].
    pub fn new(chain: Chain, solver: Option<&str>) -> Result<Self, KinematicsError> {
        let choice = match solver {
            Some(name) => ik::solver(name, &chain)?,
            None => ik::fitting(&chain)?,
        };
        Ok(Self::assemble(chain, Arc::new(choice)))
    }

    fn assemble(chain: Chain, choice: Arc<Choice>) -> Self {
        let (base_inverse, tool_inverse) = (chain.base().inverse(), chain.tool().inverse());
        let solver = Arc::clone(&choice.solver);
        Self { chain, choice, solver, base_inverse, tool_inverse }
    }

    /// Which solver it is, and whether it finds every configuration.
    pub fn solver(&self) -> &Choice {
        &self.choice
    }

    /// The same arm with another tool.
    #[must_use]
    pub fn with_tool(&self, tool: Frame) -> Self {
        Self::assemble(self.chain.with_tool(tool), Arc::clone(&self.choice))
    }

    /// The same arm with its base at `base`.
    #[must_use]
    pub fn placed(&self, base: &Frame) -> Self {
        Self::assemble(self.chain.placed(base), Arc::clone(&self.choice))
    }

    /// The chain: forward kinematics, Jacobian, limits and speeds.
    pub fn chain(&self) -> &Chain {
        &self.chain
    }

    /// The branch that a configuration is on.
    #[inline]
    pub fn branch_of(&self, q: &Joints) -> Branch {
        self.solver.branch_of(q)
    }

    /// The least distances, in the space of joint angles, from `reference` to a configuration that has the elbow of `q` the
    /// other way round, and to one that has its wrist so.
    #[inline]
    pub fn flips_rad(&self, q: &Joints, reference: &Joints) -> [f64; 2] {
        let own = self.solver.folds_rad(q);
        let other = self.solver.folds_rad(reference);
        [0, 1].map(|i: usize| wrapped(own[i] + other[i]).abs())
    }

    /// The lesser of [`flips_rad`](Self::flips_rad). What is nearer to `reference` than this is nearer than they are.
    #[inline]
    pub fn nearest_flip_rad(&self, q: &Joints, reference: &Joints) -> f64 {
        let [elbow_rad, wrist_rad] = self.flips_rad(q, reference);
        elbow_rad.min(wrist_rad)
    }

    /// The configuration of the tool's pose at `q` that has the wrist the other way round, without regard to limits: see
    /// [`Solver::other_wrist`].
    pub fn other_wrist(&self, q: &Joints) -> Option<Joints> {
        self.solver.other_wrist(q)
    }

    /// The angle between the two links of the arm: 0 where the elbow is stretched, half a turn where it is folded.
    #[inline]
    pub fn elbow_fold_rad(&self, q: &Joints) -> f64 {
        self.solver.folds_rad(q)[0]
    }

    /// Every configuration within limits that puts the tool at `target`, as far as the [solver](Self::solver) is
    /// complete. Of configurations that differ by whole turns, each joint takes the angle nearest to its reference, the
    /// lower one of two.
    ///
    /// Where `target` leaves a joint free (see the solver), it keeps its reference.
    pub fn inverse(&self, target: &Frame, reference: &Joints) -> Solutions {
        let all = self.solver.solve_all(&self.flange(target), reference);
        let mut allowed = Solutions::none();
        for (branch, q) in all.iter() {
            if let Some(q) = self.allowed_copy(q, reference) {
                allowed.insert(branch, q);
            }
        }
        allowed
    }

    /// Of [`inverse`](Self::inverse), the configuration with the least sum of squared joint changes from
    /// `reference`; the first branch in the order of [`Branch::ALL`] if several have it.
    pub fn inverse_nearest(&self, target: &Frame, reference: &Joints) -> Option<(Branch, Joints)> {
        let mut best: Option<(f64, Branch, Joints)> = None;
        for (branch, q) in self.inverse(target, reference).iter() {
            let change: f64 = q.iter().zip(reference).map(|(a, b)| (a - b) * (a - b)).sum();
            if best.is_none_or(|(least, ..)| change < least) {
                best = Some((change, branch, *q));
            }
        }
        best.map(|(_, branch, q)| (branch, q))
    }

    /// Of [`inverse`](Self::inverse), the configuration on one branch, at a fraction of the cost: what
    /// following a line from a known configuration needs.
    #[inline]
    pub fn inverse_on(&self, target: &Frame, branch: Branch, reference: &Joints) -> Option<Joints> {
        let q = self.solver.solve(&self.flange(target), branch, reference)?;
        self.allowed_copy(&q, reference)
    }

    /// As [`inverse_on`](Self::inverse_on), with the reason if there is none.
    ///
    /// # Errors
    /// [`Missed`].
    #[inline]
    pub fn follow(&self, target: &Frame, branch: Branch, reference: &Joints) -> Result<Joints, Missed> {
        let q = self.solver.solve(&self.flange(target), branch, reference).ok_or(Missed::Unreachable)?;
        self.allowed_copy(&q, reference).ok_or(Missed::Limits)
    }

    /// What the solver finds on one branch for four poses of the tool at once, without regard to limits; `None` if it has
    /// no lanes.
    pub fn solve_lanes(&self, targets: &PoseRows, branch: Branch) -> Option<LaneSolutions> {
        let level = lanes::level();
        let flanges = dispatch!(level, simd => {
            let tools = Frames::from_rows(simd, targets);
            tools.within(simd, &self.base_inverse).then(simd, &self.tool_inverse).to_rows()
        });
        self.solver.solve_lanes(&flanges, branch)
    }

    #[inline]
    pub(super) fn flange(&self, target: &Frame) -> Frame {
        self.base_inverse * *target * self.tool_inverse
    }

    #[inline]
    fn allowed_copy(&self, q: &Joints, reference: &Joints) -> Option<Joints> {
        let mut copy = *q;
        for (i, joint) in self.chain.joints().iter().enumerate() {
            copy[i] = joint.nearest_allowed_copy(q[i], reference[i])?;
        }
        Some(copy)
    }
}
