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
        /// Which of its quantities, with its unit.
        key: &'static str,
        /// Its value.
        found: f64,
        /// What would be accepted.
        accepted: String,
    },
    /// No solver has this name.
    #[error("solver `{found}` does not exist; the solvers are {known}")]
    UnknownSolver {
        /// The name asked for.
        found: String,
        /// All names.
        known: String,
    },
    /// A robot file cannot be read.
    #[error("{}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// A robot file says something that cannot be.
    #[error("{}:{line}:{column}: {message}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// Line, from 1.
        line: usize,
        /// Column in characters, from 1.
        column: usize,
        /// What was found and what would be accepted.
        message: String,
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
