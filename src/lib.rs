//! replan reproduces path-planning papers: a declarative study goes in, a verdict on every claim comes out.
//!
//! The modules below are floors, lowest first; blank lines part the floors. A module names only modules on lower floors,
//! and `tests/it/floors.rs` holds that. Below them stand packages of their own, so that the compiler keeps them apart:
//! `base` (data that everyone may read), `engine` (what plans), `verify` (what judges paths, on `base` alone), `stats`
//! and `audit`. They are optimised in every build; this package is in none but a release, as most of it runs once.

pub mod study;

pub mod analysis;

pub mod crosscheck;

pub mod render;

pub mod page;

pub mod cli;
