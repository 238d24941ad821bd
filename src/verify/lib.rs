//! The verifier: judges the paths that planners return, with code that no planner calls.
//!
//! It recomputes costs, checks every step of a path, and refuses paths that are too good as surely as paths that
//! collide.

pub mod arm;
pub mod cell;
pub mod joints;
pub mod lattice;
pub mod plane;
pub mod polyhedra;
pub mod rods;
