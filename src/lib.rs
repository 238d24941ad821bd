//! replan reproduces path-planning papers: a declarative study goes in, a verdict on every claim comes out.
//!
//! The modules below are floors, lowest first; blank lines part the floors. A module names only modules on
//! lower floors, and `tests/it/floors.rs` holds that.

pub mod seed;
pub mod settings;

pub mod geometry;

pub mod grid;
pub mod kinematics;

pub mod space;

pub mod search;
pub mod shorten;

pub mod endpoints;

pub mod planner;

pub mod verify;

pub mod study;

pub mod analysis;

pub mod crosscheck;

pub mod render;

pub mod cli;
