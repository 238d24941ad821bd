//! Robots as URDF files give them: one chain of turning joints, and the solids on its links.
//!
//! Lengths are metres and angles radians. Link 0 is the base, link `i` is moved by joint `i`; its frame is that of the joint. Links
//! that fixed joints join are one link.

mod stl;
#[cfg(test)]
mod tests;
mod urdf;

pub use urdf::{parse_urdf, read_urdf};

use crate::solid::{Pose, Solid};
use std::path::PathBuf;

/// A chain of turning joints.
#[derive(Debug, Clone, PartialEq)]
pub struct Robot {
    /// Its name.
    pub name: String,
    /// The joints that turn, base first.
    pub joints: Vec<Joint>,
    /// The solids that stand for its links, each with the number of the link that it is fixed to.
    pub solids: Vec<(usize, Solid)>,
    /// The tip, in the frame of the last joint: the link that the most fixed joints lead to, the first in the file if several do.
    pub tip: Pose,
    /// The files that were read besides the robot's own: meshes.
    pub files: Vec<PathBuf>,
}

/// A joint that turns.
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// Its name.
    pub name: String,
    /// Its frame at the angle 0, in the frame of the joint before.
    pub before: Pose,
    /// The axis that it turns about, of length 1, in its own frame.
    pub axis: [f64; 3],
    /// The least and the greatest angle.
    pub limits_rad: [f64; 2],
    /// The greatest speed.
    pub speed_rad_s: f64,
}
