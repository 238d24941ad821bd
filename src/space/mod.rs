//! Where a robot can be: worlds, the validity of a state and of a motion, and the count of every question.
//!
//! A [`World`] is what a planner plans in. It is built once by a prepared object and shared by all contenders.

mod lattice;
pub mod polyhedra;

pub use lattice::LatticeWorld;
pub use polyhedra::PolyhedraWorld;

/// The kinds of world there are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum WorldKind {
    /// A point and the arm that carries it, among convex polyhedra.
    ArmAmongPolyhedra,
    /// A lattice of square cells, some of them blocked.
    Lattice,
    /// A point among convex polyhedra.
    Polyhedra,
}

impl WorldKind {
    /// Its name in messages and listings.
    pub fn name(self) -> &'static str {
        match self {
            Self::ArmAmongPolyhedra => "arm among polyhedra",
            Self::Lattice => "lattice",
            Self::Polyhedra => "polyhedra",
        }
    }

    /// Whether what needs a world of the kind `needed` can plan in one of this kind.
    pub fn serves(self, needed: Self) -> bool {
        self == needed || (self, needed) == (Self::ArmAmongPolyhedra, Self::Polyhedra)
    }
}

/// Something to plan in.
#[derive(Debug)]
pub enum World {
    /// A lattice of square cells.
    Lattice(LatticeWorld),
    /// Convex polyhedra, with or without an arm.
    Polyhedra(PolyhedraWorld),
}

impl World {
    /// Which kind it is.
    pub fn kind(&self) -> WorldKind {
        match self {
            Self::Lattice(_) => WorldKind::Lattice,
            Self::Polyhedra(world) if world.arm().is_some() => WorldKind::ArmAmongPolyhedra,
            Self::Polyhedra(_) => WorldKind::Polyhedra,
        }
    }

    /// The lattice, if it is one.
    pub fn as_lattice(&self) -> Option<&LatticeWorld> {
        match self {
            Self::Lattice(lattice) => Some(lattice),
            Self::Polyhedra(_) => None,
        }
    }

    /// The polyhedra, if it is such a world.
    pub fn as_polyhedra(&self) -> Option<&PolyhedraWorld> {
        match self {
            Self::Polyhedra(polyhedra) => Some(polyhedra),
            Self::Lattice(_) => None,
        }
    }
}
