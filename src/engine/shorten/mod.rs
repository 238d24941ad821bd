//! Stages that tidy a path, and measures of one.
//!
//! A path is a list of points of any one dimension, handed over as slices. The caller decides which points a straight
//! line may join: nothing here knows of obstacles.

mod inflection;
mod measure;
mod selection;
mod smoothing;
mod spline;
mod stepwise;
mod straighten;
#[cfg(test)]
mod tests;

pub use inflection::{bends, inflection_deletion};
pub use measure::{TurnAngle, path_length, turn_sum_deg};
pub use selection::least_selection;
pub use smoothing::smoothing;
pub use spline::cubic_spline;
pub use stepwise::{Resume, stepwise_straightening};
pub use straighten::{LastNode, straightening};
