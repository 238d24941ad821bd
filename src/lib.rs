//! replan reproduces path-planning papers: a declarative study goes in, a verdict on every claim comes out.
//!
//! The modules below are floors, lowest first; blank lines part the floors. A module names only modules on lower floors,
//! and `tests/it/floors.rs` holds that. Below them stand packages of their own, so that the compiler keeps them apart:
//! `base` (data that everyone may read), `engine` (what plans), `verify` (what judges paths, on `base` alone), `stats`,
//! `proofs` (arithmetic on printed numbers), and on these `study` (from a spec to what happened). What runs often is optimised in every build; `study` and
//! this package are in none but a release, as most of them runs once.

pub mod analysis;

pub mod render;

pub mod page;

pub mod cli;
