//! The lower half of replan: what a trial runs on, and what is counted afterwards.
//!
//! It is a package of its own so that it alone need be optimised; `replan` is built on it and shows its modules as
//! its own. The modules below are floors as in `lib.rs`, lowest first, below all of the floors there.

pub mod hash;
pub mod palette;
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

pub mod stats;

pub mod audit;
