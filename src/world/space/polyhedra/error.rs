//! What can be wrong with a scene of polyhedra or with a query in it.

use crate::geometry::{GeometryError, Vec3};
use base::grid::GridError;
use base::text::listed;

/// Why there is no such world.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PolyhedraError {
    /// An obstacle cannot be built, or not be grown.
    #[error("obstacle {index}: {source}")]
    Obstacle {
        /// Its number in the scene, from 1.
        index: usize,
        /// Why.
        source: GeometryError,
    },
    /// The domain has no extent.
    #[error(
        "the domain goes from {} to {}; every side must be a positive finite length",
        listed(min),
        listed(max)
    )]
    Domain {
        /// Its lower corner.
        min: [f64; 3],
        /// Its upper corner.
        max: [f64; 3],
    },
    /// The search step is no length that fits the domain.
    #[error("step is {step}; more than 0 and at most the domain's shortest side, {most}, is accepted")]
    Step {
        /// The step.
        step: f64,
        /// The shortest side.
        most: f64,
    },
    /// The growth is no length.
    #[error("the obstacles are to grow by {found}; 0 or more is accepted")]
    Growth {
        /// By how much.
        found: f64,
    },
    /// The lattice would have too many nodes.
    #[error(transparent)]
    Lattice(#[from] GridError),
}

/// Why a point cannot be a start or a goal.
pub(super) fn outside(what: &str, point: &Vec3, min: &Vec3, max: &Vec3) -> String {
    format!(
        "the {what} {} is outside the domain; it goes from {} to {}",
        listed(point),
        listed(min),
        listed(max)
    )
}
