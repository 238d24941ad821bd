//! replan reproduces path-planning papers: a declarative study goes in, a verdict on every claim comes out.
//!
//! The modules below are floors, lowest first; blank lines part the floors. A module names only modules on
//! lower floors, and `tests/it/floors.rs` holds that.

pub mod seed;

pub mod geometry;

pub mod kinematics;
