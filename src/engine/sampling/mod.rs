//! Sampling-based planning: trees over configurations, the samples they grow to, and what shortens their paths.
//!
//! Configurations are as far apart as the root of the sum of squares of their coordinates' changes: radians of joints that turn, metres
//! of those that slide, millimetres in the plane. A joint that turns without end goes the shorter way round. Nothing here reads a
//! clock; a run is decided by its settings and its seed.

mod draw;
mod index;
mod motions;
mod simplify;
#[cfg(test)]
mod tests;
mod tree;

pub use draw::{Draw, DrawSetting};
pub use index::Index;
pub use motions::Motions;
pub use simplify::{BSpline, Operation, simplify};
pub use tree::Tree;
