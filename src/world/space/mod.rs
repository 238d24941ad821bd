//! Where a robot can be: worlds, the validity of a state and of a motion, and the count of every question.
//!
//! A [`World`] is what a planner plans in. It is built once by a preprocessed object and shared by all contenders.

mod arm;
pub mod cell;
mod joints;
mod lattice;
pub mod polyhedra;
pub mod roadmap;
mod support;

pub use arm::{ArmRules, ArmWorld, HopRule, Obstacle, TipLattice, Zone};
pub use joints::{JointSpace, MotionMemory, SelfContact};
pub use lattice::{JumpLines, JumpTable, Jumps, LatticeWorld, Pruning};
pub use polyhedra::PolyhedraWorld;
use roadmap::Roadmap;
pub use support::{Support, SupportEntry};

/// The kinds of world there are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum WorldKind {
    /// Any: what planners from outside need.
    Any,
    /// A planar arm whose tip moves over a lattice, among obstacles.
    Arm,
    /// A point and the arm that carries it, among convex polyhedra.
    ArmAmongPolyhedra,
    /// A lattice of square cells, whose vertices are their centres: all that a search by jump points can plan in.
    CentreLattice,
    /// A lattice whose vertices are the corners of square cells.
    CornerLattice,
    /// A lattice of square cells, some of them blocked.
    Lattice,
    /// A point among convex polyhedra.
    Polyhedra,
    /// Samples of a robot's configurations, joined by local paths.
    Roadmap,
}

impl WorldKind {
    /// Its name in messages and listings.
    pub fn name(self) -> &'static str {
        match self {
            Self::Any => "any",
            Self::Arm => "arm",
            Self::ArmAmongPolyhedra => "arm among polyhedra",
            Self::CentreLattice => "lattice of centres",
            Self::CornerLattice => "lattice of corners",
            Self::Lattice => "lattice",
            Self::Polyhedra => "polyhedra",
            Self::Roadmap => "roadmap",
        }
    }

    /// Whether what needs a world of the kind `needed` can plan in one of this kind.
    pub fn serves(self, needed: Self) -> bool {
        let serves_too = [
            (Self::ArmAmongPolyhedra, Self::Polyhedra),
            (Self::CentreLattice, Self::Lattice),
            (Self::CornerLattice, Self::Lattice),
            (Self::Lattice, Self::CentreLattice),
        ];
        needed == Self::Any || self == needed || serves_too.contains(&(self, needed))
    }
}

/// Something to plan in.
#[derive(Debug)]
pub enum World {
    /// A planar arm whose tip moves over a lattice, among obstacles.
    Arm(ArmWorld),
    /// A lattice of square cells.
    Lattice(LatticeWorld),
    /// Convex polyhedra, with or without an arm.
    Polyhedra(Box<PolyhedraWorld>),
    /// Samples of a robot's configurations, joined by local paths.
    Roadmap(Box<Roadmap>),
}

impl World {
    /// Which kind it is.
    pub fn kind(&self) -> WorldKind {
        match self {
            Self::Arm(_) => WorldKind::Arm,
            Self::Lattice(lattice) if lattice.cornered().is_some() => WorldKind::CornerLattice,
            Self::Lattice(_) => WorldKind::Lattice,
            Self::Polyhedra(world) if world.arm().is_some() => WorldKind::ArmAmongPolyhedra,
            Self::Polyhedra(_) => WorldKind::Polyhedra,
            Self::Roadmap(_) => WorldKind::Roadmap,
        }
    }

    /// The lattice, if it is one.
    pub fn as_lattice(&self) -> Option<&LatticeWorld> {
        if let Self::Lattice(lattice) = self { Some(lattice) } else { None }
    }

    /// The arm's workspace, if it is one.
    pub fn as_arm(&self) -> Option<&ArmWorld> {
        if let Self::Arm(arm) = self { Some(arm) } else { None }
    }

    /// The polyhedra, if it is such a world.
    pub fn as_polyhedra(&self) -> Option<&PolyhedraWorld> {
        if let Self::Polyhedra(polyhedra) = self { Some(polyhedra) } else { None }
    }

    /// The roadmap, if it is one.
    pub fn as_roadmap(&self) -> Option<&Roadmap> {
        if let Self::Roadmap(roadmap) = self { Some(roadmap) } else { None }
    }
}
