//! The data that every part of replan may read: seeds, hashes, settings as written, grids, and robots and planning
//! problems from files of others.
//!
//! The modules below are floors, lowest first; blank lines separate the floors. A module names only modules on lower
//! floors. Nothing here plans and nothing here judges, so that the verifier can stand on it alone.

pub mod hash;
pub mod ignored;
pub mod seed;
pub mod slug;
pub mod text;
pub mod units;

pub mod file;

pub mod settings;

pub mod solid;

pub mod yaml;

pub mod grid;
pub mod problem;
pub mod robot;
