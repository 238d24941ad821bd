//! Joint angles and poses: the planar two-link arm, serial six-axis arms, chains of any number of joints, and robot files.
//!
//! Everything here is pure: an arm holds its geometry and no pose, so one arm serves all trials at once.
//! Angles are radians, lengths metres unless a module says otherwise. What is in the way of a robot, and
//! how it gets from one pose to another, is left to the floors above.

pub mod angle;
mod arm;
mod error;
pub mod ik;
pub mod open_chain;
pub mod planar_2r;
pub mod robot;
mod rough;
pub mod serial;
#[cfg(test)]
mod tests;

pub use arm::{Arm, Missed};
pub use error::KinematicsError;
pub use robot::Robot;
pub use rough::RoughChain;
pub use serial::{AXES, Chain, Joint, Joints};

/// How far what a robot or scene file says may be from the origin, or from one axis to the next: 100 m, ten times the longest arms
/// that are sold. A greater number is a slip of the unit.
pub const FARTHEST_MM: f64 = 1e5;
/// The same in centimetres.
pub const FARTHEST_CM: f64 = FARTHEST_MM / 10.0;
