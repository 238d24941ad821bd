//! What planners plan in: geometry, kinematics, and the spaces made of them.
//!
//! The modules below are floors, lowest first; blank lines part the floors. A module names only modules on lower
//! floors. This package is optimised in every build: planners ask it whether states and motions are free.

pub mod geometry;

pub mod kinematics;

pub mod space;
