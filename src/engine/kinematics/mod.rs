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
