//! replan reproduces path-planning papers: a declarative study goes in, a verdict on every claim comes out.
//!
//! The modules below are floors, lowest first; blank lines part the floors. A module names only modules on
//! lower floors, and `tests/it/floors.rs` holds that. The lowest floors are in `engine.rs`, a package of its own:
//! its code is optimised in every build, this package's in none but a release, because most of it runs once.

pub use replan_engine::{
    audit, endpoints, geometry, grid, hash, kinematics, palette, planner, search, seed, settings, shorten,
    space, stats, verify,
};

pub mod study;

pub mod analysis;

pub mod crosscheck;

pub mod render;

pub mod cli;
