//! What can be wrong with an arm, a target or a robot file.

use crate::geometry::GeometryError;
use std::{io, path::PathBuf};
use thiserror::Error;

/// Why there is no arm, or no answer from one.
#[derive(Debug, Error)]
pub enum KinematicsError {
    /// A link length of the planar arm is not a finite number above 0.
    #[error("link {link} is {found} long; a link must be longer than 0")]
    Link {
        /// 1 or 2.
        link: usize,
        /// Its length.
        found: f64,
    },
    /// The planar arm cannot put its tip there.
    #[error(
        "target ({}, {}) is {distance} from the base; the arm reaches from {inner} to {outer}",
        target[0], target[1]
    )]
    OutOfReach {
        /// The target.
        target: [f64; 2],
        /// Its distance from the base.
        distance: f64,
        /// The least distance reached.
        inner: f64,
        /// The greatest distance reached.
        outer: f64,
    },
    /// A joint's number makes no chain.
    #[error("joint {joint}: {key} is {found}; accepted: {accepted}")]
    Joint {
        /// The joint, from 1.
        joint: usize,
        /// Which of its quantities, called as in robot files.
        key: &'static str,
        /// Its value, in the unit of the key.
        found: f64,
        /// What would be accepted.
        accepted: String,
    },
    /// No solver has this name.
    #[error("solver `{found}` does not exist; the solvers are {known}")]
    UnknownSolver {
        /// The requested name.
        found: String,
        /// All names.
        known: String,
    },
    /// A URDF file has another number of joints than six.
    #[error(
        "robot `{robot}` has {found} joints that move; 6 are accepted here, and any number in problems in joint space"
    )]
    Axes {
        /// Its name.
        robot: String,
        /// How many it has.
        found: usize,
    },
    /// A joint of a URDF file is none that a work cell's arm may have.
    #[error(
        "joint `{joint}` {why}; revolute and continuous joints with a velocity are accepted here, and all kinds in problems in joint space"
    )]
    Unfit {
        /// Its name.
        joint: String,
        /// What it is.
        why: &'static str,
    },
    /// A robot file holds what is not accepted.
    #[error(transparent)]
    File(#[from] base::settings::SettingsError),
    /// A robot file cannot be read.
    #[error("{}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// A tool or capsule cannot have this size.
    #[error(transparent)]
    Shape(#[from] GeometryError),
    /// A capsule spans a share of a tool that has no length.
    #[error("capsule `{capsule}` spans a share of the tool, whose length is 0; it must be greater than 0")]
    NoTool {
        /// The capsule's name.
        capsule: String,
    },
}

impl KinematicsError {
    /// A refusal of a joint, counted from 0, for a quantity in metres or radians, in the units of robot
    /// files.
    pub(super) fn joint(index: usize, key: &'static str, found_si: f64, accepted: &str) -> Self {
        let found = match key {
            _ if key.ends_with("_mm") => found_si * 1e3,
            _ if key.ends_with("_rad_s") => found_si,
            _ => found_si.to_degrees(),
        };
        // What was written in degrees or millimetres is shown without the rounding of the way back.
        let found = (found * 1e9).round() / 1e9;
        Self::Joint { joint: index + 1, key, found, accepted: accepted.to_owned() }
    }

    /// The same, with more on what is accepted.
    pub(super) fn with_accepted(self, more: &str) -> Self {
        match self {
            Self::Joint { joint, key, found, accepted } => {
                Self::Joint { joint, key, found, accepted: accepted + more }
            }
            other => other,
        }
    }
}
