//! The spaces in which planners plan: geometry, kinematics, and worlds made of them.
//!
//! The modules below are floors, lowest first; blank lines separate the floors. A module names only modules on lower
//! floors. This package is optimised in every build: planners ask it whether states and motions are free.

pub mod geometry;

pub mod kinematics;

pub mod space;
