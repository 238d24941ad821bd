//! Where a robot can be: worlds, the validity of a state and of a motion, and the count of every question.
//!
//! A [`World`] is what a planner plans in. It is built once by a prepared object and shared by all contenders.

mod arm;
pub mod cell;
mod lattice;
pub mod roadmap;

pub use arm::{ArmRules, ArmWorld, HopRule, Obstacle, TipLattice, Zone};
pub use lattice::LatticeWorld;
use roadmap::Roadmap;

/// The kinds of world there are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum WorldKind {
    /// A planar arm whose tip moves over a lattice, among obstacles.
    Arm,
    /// A lattice of square cells, some of them blocked.
    Lattice,
    /// Samples of a robot's configurations, joined by local paths.
    Roadmap,
}

impl WorldKind {
    /// Its name in messages and listings.
    pub fn name(self) -> &'static str {
        match self {
            Self::Arm => "arm",
            Self::Lattice => "lattice",
            Self::Roadmap => "roadmap",
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
    /// Samples of a robot's configurations, joined by local paths.
    Roadmap(Box<Roadmap>),
}

impl World {
    /// Which kind it is.
    pub fn kind(&self) -> WorldKind {
        match self {
            Self::Arm(_) => WorldKind::Arm,
            Self::Lattice(_) => WorldKind::Lattice,
            Self::Roadmap(_) => WorldKind::Roadmap,
        }
    }

    /// The lattice, if it is one.
    pub fn as_lattice(&self) -> Option<&LatticeWorld> {
        match self {
            Self::Lattice(lattice) => Some(lattice),
            Self::Arm(_) | Self::Roadmap(_) => None,
        }
    }

    /// The arm's workspace, if it is one.
    pub fn as_arm(&self) -> Option<&ArmWorld> {
        match self {
            Self::Arm(arm) => Some(arm),
            Self::Lattice(_) | Self::Roadmap(_) => None,
        }
    }

    /// The roadmap, if it is one.
    pub fn as_roadmap(&self) -> Option<&Roadmap> {
        match self {
            Self::Roadmap(roadmap) => Some(roadmap),
            Self::Arm(_) | Self::Lattice(_) => None,
        }
    }
}
