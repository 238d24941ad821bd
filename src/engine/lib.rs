//! What plans: the search kernel and the planners over it.
//!
//! The modules below are floors, lowest first; blank lines part the floors. A module names only modules on lower
//! floors. This package is optimised in every build: it is what trials spend their time in.

pub use world::{geometry, kinematics, space};

pub mod search;
pub mod shorten;

pub mod sampling;

pub mod planner;
