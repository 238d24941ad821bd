//! The verifier: judges what planners return, with code that no planner calls.
//!
//! It recomputes costs, checks every step of a path, and refuses what is too good as surely as what collides.

pub mod arm;
pub mod cell;
pub mod joints;
pub mod lattice;
pub mod plane;
pub mod polyhedra;
pub mod rods;
