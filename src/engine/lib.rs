//! The planners, and the search kernel below them.
//!
//! The modules below are floors, lowest first; blank lines separate the floors. A module names only modules on lower
//! floors. This package is optimised in every build: trials spend their time in it.

pub use world::{geometry, kinematics, space};

pub mod search;
pub mod shorten;

pub mod sampling;

pub mod planner;
