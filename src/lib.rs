//! replan reproduces path-planning papers: a declarative study goes in, a verdict on every claim comes out.
//!
//! The modules below are floors, lowest first; blank lines separate the floors. A module names only modules on lower
//! floors, and `tests/it/floors.rs` holds that. Below them stand separate packages. Everyone may read `base`, the data.
//! The package `engine` plans, and `verify` judges paths on `base` alone. Neither `stats` nor `proofs` (arithmetic on
//! printed numbers) needs these. On all of them stands `study`, which leads from a spec to records. Code that runs
//! often is optimised in every build. Most code of `study` and of this package runs once, so a release alone optimises
//! it.

pub mod analysis;

pub mod render;

pub mod page;

pub mod cli;
