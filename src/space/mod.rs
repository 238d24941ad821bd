//! Where a robot can be: worlds, the validity of a state and of a motion, and the count of every question.
//!
//! A [`World`] is what a planner plans in. It is built once by a prepared object and shared by all contenders.

mod arm;
mod lattice;

pub use arm::{ArmRules, ArmWorld, HopRule, Obstacle, TipLattice, Zone};
pub use lattice::LatticeWorld;

/// The kinds of world there are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum WorldKind {
    /// A planar arm whose tip moves over a lattice, among obstacles.
    Arm,
    /// A lattice of square cells, some of them blocked.
    Lattice,
}

impl WorldKind {
    /// Its name in messages and listings.
    pub fn name(self) -> &'static str {
        match self {
            Self::Arm => "arm",
            Self::Lattice => "lattice",
        }
    }
}

/// Something to plan in.
#[derive(Debug)]
pub enum World {
    /// A planar arm whose tip moves over a lattice, among obstacles.
    Arm(ArmWorld),
    /// A lattice of square cells.
    Lattice(LatticeWorld),
}

impl World {
    /// Which kind it is.
    pub fn kind(&self) -> WorldKind {
        match self {
            Self::Arm(_) => WorldKind::Arm,
            Self::Lattice(_) => WorldKind::Lattice,
        }
    }

    /// The lattice, if it is one.
    pub fn as_lattice(&self) -> Option<&LatticeWorld> {
        match self {
            Self::Lattice(lattice) => Some(lattice),
            Self::Arm(_) => None,
        }
    }

    /// The arm's workspace, if it is one.
    pub fn as_arm(&self) -> Option<&ArmWorld> {
        match self {
            Self::Arm(arm) => Some(arm),
            Self::Lattice(_) => None,
        }
    }
}
