//! Inverse kinematics, one solver a file, all in [`SOLVERS`]: closed forms, and a search for what none fits.
//!
//! A solver belongs to a family of geometries, never to a robot by name: it reads the chain's rows, and
//! refuses a chain that its closed form does not fit.

mod form;
mod numerical;
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
use std::{
    fmt::{self, Debug},
    sync::Arc,
};

/// Which of the up to eight ways an arm takes to a pose: three signs.
///
/// Two configurations on different branches are joined only through a singularity, so a motion along which
/// the branch may not change can be refused by its ends alone. What the signs mean stands below for the closed forms; the
/// search has one sign of its own.
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

    /// Whether the fifth angle, as the solver counts it, has a positive sine.
    pub fn wrist(self) -> bool {
        self.0 & 1 == 0
    }
}

/// How many configurations a pose has at most.
const SOLUTIONS: usize = 16;

/// The configurations that put an arm in one pose, in the order of [`Branch::ALL`]; at most one a branch from a closed form.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Solutions {
    /// What is beyond `count` is all zero.
    found: [(Branch, Joints); SOLUTIONS],
    count: usize,
}

impl Solutions {
    /// None yet.
    pub(super) fn none() -> Self {
        Self { found: [(Branch(0), [0.0; AXES]); SOLUTIONS], count: 0 }
    }

    /// Adds a configuration, behind those of its branch.
    ///
    /// # Panics
    /// If there are 16 already.
    pub(super) fn insert(&mut self, branch: Branch, q: Joints) {
        let at = self.found[..self.count].partition_point(|(known, _)| *known <= branch);
        self.found.copy_within(at..self.count, at + 1);
        self.found[at] = (branch, q);
        self.count += 1;
    }

    /// The first configuration on `branch`.
    pub fn on(&self, branch: Branch) -> Option<&Joints> {
        self.iter().find(|(found, _)| *found == branch).map(|(_, q)| q)
    }

    /// Every configuration with its branch.
    pub fn iter(&self) -> impl Iterator<Item = (Branch, &Joints)> {
        self.found[..self.count].iter().map(|(branch, q)| (*branch, q))
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

    /// The configuration of the same pose as `q` that has the wrist the other way round; `None` unless every further one has
    /// the elbow the other way round or joint 1 half a turn away.
    fn other_wrist(&self, _q: &Joints) -> Option<Joints> {
        None
    }

    /// A configuration on one branch that puts the flange at `flange`, given in the base.
    fn solve(&self, flange: &Frame, branch: Branch, reference: &Joints) -> Option<Joints>;

    /// [`solve`](Self::solve) for four flanges at once, `None` if the solver has no lanes.
    ///
    /// Only what is away from singular poses and from the edge of reach is sure; angles are then right to 1e-11.
    fn solve_lanes(&self, _flanges: &PoseRows, _branch: Branch) -> Option<LaneSolutions> {
        None
    }

    /// The configurations on all branches: all there are, if the family [is complete](Family::is_complete).
    fn solve_all(&self, flange: &Frame, reference: &Joints) -> Solutions;
}

/// A solver by name.
pub struct Family {
    /// The name that robot files use.
    pub name: &'static str,
    /// Whether its solvers find every configuration; if not, a pose that none is found for may have some.
    pub is_complete: bool,
    build: fn(&Chain) -> Result<Arc<dyn Solver>, KinematicsError>,
}

/// Every solver.
pub const SOLVERS: &[Family] = &[numerical::FAMILY, offset_wrist::FAMILY, spherical_wrist::FAMILY];

/// A solver that fits a chain.
#[derive(Debug, Clone)]
pub struct Choice {
    /// The solver's name.
    pub name: &'static str,
    /// Whether it finds every configuration.
    pub is_complete: bool,
    /// Why no closed form was taken: the first number that each does not allow. Empty if one was, or none was looked for.
    pub refused: Vec<String>,
    pub(super) solver: Arc<dyn Solver>,
}

impl Choice {
    fn new(family: &Family, solver: Arc<dyn Solver>, refused: Vec<String>) -> Self {
        Self { name: family.name, is_complete: family.is_complete, refused, solver }
    }
}

/// One sentence on the solver, for people.
impl fmt::Display for Choice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "inverse kinematics by `{}`", self.name)?;
        if !self.is_complete {
            f.write_str(", which may miss configurations")?;
        }
        for refused in &self.refused {
            write!(f, "; {refused}")?;
        }
        Ok(())
    }
}

/// The solver called `name`, for `chain`.
///
/// # Errors
/// [`KinematicsError::UnknownSolver`], or [`KinematicsError::Joint`] for the first number of the chain that
/// the solver's closed form does not allow, with the solver that would be taken.
pub fn solver(name: &str, chain: &Chain) -> Result<Choice, KinematicsError> {
    let Some(family) = SOLVERS.iter().find(|family| family.name == name) else {
        let known = SOLVERS.iter().map(|family| family.name).collect::<Vec<_>>().join(", ");
        return Err(KinematicsError::UnknownSolver { found: name.to_owned(), known });
    };
    match (family.build)(chain) {
        Ok(solver) => Ok(Choice::new(family, solver, Vec::new())),
        Err(refusal) => Err(match fitting(chain) {
            Ok(fitting) => refusal.with_accepted(&format!("; `{}` fits", fitting.name)),
            Err(_) => refusal,
        }),
    }
}

/// The most special solver that fits `chain`: a closed form if one does.
///
/// # Errors
/// [`KinematicsError::Joint`] if the chain has no length at all.
pub fn fitting(chain: &Chain) -> Result<Choice, KinematicsError> {
    let mut refused = Vec::new();
    for family in SOLVERS.iter().filter(|family| family.is_complete) {
        match (family.build)(chain) {
            Ok(solver) => return Ok(Choice::new(family, solver, Vec::new())),
            Err(refusal) => refused.push(refusal.to_string()),
        }
    }
    let solver = (numerical::FAMILY.build)(chain)?;
    Ok(Choice::new(&numerical::FAMILY, solver, refused))
}
