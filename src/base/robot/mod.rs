//! Robots as URDF files give them: one chain of joints that turn or slide, and the solids on its links.
//!
//! Lengths are metres and angles radians. Link 0 is the base, link `i` is moved by joint `i`; its frame is that of the joint. Links
//! that fixed joints join are one link. Which links may touch each other, an SRDF file says.

mod elements;
mod srdf;
mod stl;
#[cfg(test)]
mod tests;
mod tree;
mod urdf;
mod walk;

pub use srdf::{MayTouch, parse_srdf, read_srdf};
pub use urdf::{parse_urdf, read_urdf};

use crate::solid::{FAR_M, Pose, Solid};
use crate::units::FASTEST_RAD_S;
use std::f64::consts::TAU;
use std::path::PathBuf;

/// A chain of joints.
#[derive(Debug, Clone, PartialEq)]
pub struct Robot {
    /// Its name.
    pub name: String,
    /// The name of the link that no joint leads to.
    pub base: String,
    /// The joints that move, base first.
    pub joints: Vec<Joint>,
    /// The solids that stand for its links, each with the number of the link that it is fixed to.
    pub solids: Vec<(usize, Solid)>,
    /// The name that the file gives the link of each solid.
    pub owners: Vec<String>,
    /// The tip, in the frame of the last joint: the link that the most fixed joints lead to, the first in the file if several do.
    pub tip: Pose,
    /// The files that were read besides the robot's own: meshes.
    pub files: Vec<PathBuf>,
    /// What of the file is not used, a sentence each.
    pub notes: Vec<String>,
}

/// How a joint moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// It turns between limits.
    Turns,
    /// It turns without end: angles that whole turns part are one.
    TurnsOn,
    /// It slides between limits.
    Slides,
}

/// A joint that moves.
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// Its name.
    pub name: String,
    /// How it moves.
    pub kind: Kind,
    /// Its frame at 0, in the frame of the joint before.
    pub before: Pose,
    /// The axis that it turns about or slides along, of length 1, in its own frame.
    pub axis: [f64; 3],
    /// The least and the greatest value, radians or metres; of one that turns on, those of one turn.
    pub limits: [f64; 2],
    /// The greatest speed, radians or metres a second, if the file says one above 0.
    pub speed: Option<f64>,
}

impl Joint {
    /// Whether it may be at `value`.
    pub fn allows(&self, value: f64) -> bool {
        let [lower, upper] = self.limits;
        if self.kind == Kind::TurnsOn { value.is_finite() } else { (lower..=upper).contains(&value) }
    }

    /// Why it may not be at `value`, if it may not.
    pub fn refusal(&self, value: f64) -> Option<String> {
        let Self { name, kind, limits: [lower, upper], .. } = self;
        let unit = if *kind == Kind::Slides { "m" } else { "rad" };
        (!self.allows(value))
            .then(|| format!("joint `{name}` is at {value} {unit}, outside {lower} to {upper}"))
    }

    /// Whether no joint is as fast: its speed seems to be in degrees or millimetres a second.
    pub fn is_too_fast(&self) -> bool {
        // No robot is as large as one that slides crosses in a second.
        let most = if self.kind == Kind::Slides { FAR_M } else { FASTEST_RAD_S };
        self.speed.is_some_and(|speed| speed > most)
    }

    /// How far it moves from one value to another, with a sign; one that turns on goes the shorter way round.
    pub fn change(&self, from: f64, to: f64) -> f64 {
        let change = to - from;
        if self.kind == Kind::TurnsOn { libm::remainder(change, TAU) } else { change }
    }
}
