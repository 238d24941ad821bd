//! Closed-form inverse kinematics, one solver a file, all in [`SOLVERS`].
//!
//! A solver belongs to a family of geometries, never to a robot by name: it reads the chain's rows, and
//! refuses a chain that its closed form does not fit.

mod form;
mod offset_wrist;
mod reach;
mod spherical_wrist;
#[cfg(test)]
mod tests;

use super::{
    KinematicsError,
    serial::{AXES, Chain, Joints},
};
use crate::geometry::Frame;
use crate::geometry::lanes::{PoseRows, Row};
use std::{fmt::Debug, sync::Arc};

/// Which of the up to eight ways an arm takes to a pose: three signs.
///
/// Two configurations on different branches are joined only through a singularity, so a motion along which
/// the branch may not change can be refused by its ends alone.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Branch(u8);

impl Branch {
    /// All eight, in the order in which ties are broken.
    pub const ALL: [Self; 8] = [Self(0), Self(1), Self(2), Self(3), Self(4), Self(5), Self(6), Self(7)];

    /// The branch with these signs; each `true` is the sign called positive below.
    pub fn new(shoulder: bool, elbow: bool, wrist: bool) -> Self {
        Self(u8::from(!shoulder) << 2 | u8::from(!elbow) << 1 | u8::from(!wrist))
    }

    /// Whether the wrist is in front of axis 1, seen along the arm.
    pub fn shoulder(self) -> bool {
        self.0 & 4 == 0
    }

    /// Whether the forearm is bent from the upper arm by an angle with a positive sine.
    pub fn elbow(self) -> bool {
        self.0 & 2 == 0
    }

    /// Whether the fifth angle, offset included, has a positive sine.
    pub fn wrist(self) -> bool {
        self.0 & 1 == 0
    }
}

/// The configurations that put an arm in one pose, at most one a branch, in the order of [`Branch::ALL`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Solutions {
    found: [Option<Joints>; 8],
}

impl Solutions {
    /// None yet.
    pub(super) fn none() -> Self {
        Self { found: [None; 8] }
    }

    pub(super) fn insert(&mut self, branch: Branch, q: Joints) {
        self.found[usize::from(branch.0)] = Some(q);
    }

    /// The configuration on `branch`.
    pub fn on(&self, branch: Branch) -> Option<&Joints> {
        self.found[usize::from(branch.0)].as_ref()
    }

    /// Every branch that has a configuration, with it.
    pub fn iter(&self) -> impl Iterator<Item = (Branch, &Joints)> {
        Branch::ALL.iter().filter_map(|&branch| self.on(branch).map(|q| (branch, q)))
    }
}

/// What four flanges came to.
#[derive(Debug, Clone, Copy)]
pub struct LaneSolutions {
    /// The joint angles, modulo whole turns, joint by joint; they mean nothing where a lane is not solved.
    pub q: [Row; AXES],
    /// The lanes that are solved, one bit a lane.
    pub solved: u64,
    /// The lanes whose flange is out of reach; a lane that is neither is for [`Solver::solve`] to settle.
    pub unreachable: u64,
}

/// Inverse kinematics of one chain.
///
/// Angles are found modulo whole turns and without regard to limits. Where a pose leaves an angle free, it
/// keeps that of `reference`; each solver says which angle that is.
pub trait Solver: Debug + Send + Sync {
    /// The branch that a configuration is on; a sign that is zero counts as positive.
    fn branch_of(&self, q: &Joints) -> Branch;

    /// The bend of the elbow and the turn of the wrist: the angles whose signs name the branch. On the branch of the other
    /// sign the angle is the opposite one, so the two are apart by at least the sum of their sizes (or what is left of
    /// a turn).
    fn folds_rad(&self, q: &Joints) -> [f64; 2];

    /// The configuration on one branch that puts the flange at `flange`, given in the base.
    fn solve(&self, flange: &Frame, branch: Branch, reference: &Joints) -> Option<Joints>;

    /// [`solve`](Self::solve) for four flanges at once, `None` if the solver has no lanes.
    ///
    /// Only what is away from singular poses and from the edge of reach is sure; angles are then right to 1e-11.
    fn solve_lanes(&self, _flanges: &PoseRows, _branch: Branch) -> Option<LaneSolutions> {
        None
    }

    /// The configurations on all branches.
    fn solve_all(&self, flange: &Frame, reference: &Joints) -> Solutions;
}

/// A solver by name.
pub struct Family {
    /// The name that robot files use.
    pub name: &'static str,
    build: fn(&Chain) -> Result<Arc<dyn Solver>, KinematicsError>,
}

/// Every solver.
pub const SOLVERS: &[Family] = &[offset_wrist::FAMILY, spherical_wrist::FAMILY];

/// The solver called `name`, for `chain`.
///
/// # Errors
/// [`KinematicsError::UnknownSolver`], or [`KinematicsError::Joint`] for the first number of the chain that
/// the solver's closed form does not allow.
pub fn solver(name: &str, chain: &Chain) -> Result<Arc<dyn Solver>, KinematicsError> {
    let Some(family) = SOLVERS.iter().find(|family| family.name == name) else {
        let known = SOLVERS.iter().map(|family| family.name).collect::<Vec<_>>().join(", ");
        return Err(KinematicsError::UnknownSolver { found: name.to_owned(), known });
    };
    (family.build)(chain)
}
