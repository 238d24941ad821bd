//! What every part of replan may read: seeds, hashes, settings as they were written, and grids.
//!
//! The modules below are floors, lowest first; blank lines part the floors. A module names only modules on lower
//! floors. Nothing here plans and nothing here judges, so that the verifier can stand on it alone.

pub mod hash;
pub mod seed;
pub mod settings;
pub mod slug;

pub mod grid;
