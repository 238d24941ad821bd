//! Robots from files: an arm, its tool, and the capsules that stand for its body.
//!
//! A robot file gives millimetres and degrees, as makers' sheets do (speeds also in radians a second); in
//! memory everything is metres and radians. The base is at the origin: where it stands is a scene's to say. A file may hold several bodies, so that a study can ask what
//! the choice of one is worth.

mod attached;
mod file;
#[cfg(test)]
pub(super) mod tests;
mod urdf;

pub use file::ROBOT_FILE;
pub use urdf::{URDF_BODY, capsule_around, links_at_zero, listed_pairs};

use super::{Arm, Chain, Joints, KinematicsError, serial::AXES};
use crate::geometry::{Capsule, Frame, Vec3};
use std::path::{Path, PathBuf};

/// A robot, checked.
#[derive(Debug, Clone)]
pub struct Robot {
    name: String,
    arm: Arm,
    /// Where the tool is fixed, in the last frame of the rows.
    flange: Frame,
    tool_length_m: f64,
    bodies: Vec<Body>,
    files: Vec<PathBuf>,
    /// What a reader should know of how the files were taken: what capsules of ours stand for, say.
    notes: Vec<String>,
}

/// Capsules that stand for an arm and its tool.
#[derive(Debug, Clone, PartialEq)]
pub struct Body {
    name: String,
    parts: Vec<Part>,
    self_pairs: Vec<[usize; 2]>,
}

/// One capsule of a body.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    name: String,
    link: usize,
    /// The stretch of the tool it spans, if it belongs to the tool.
    tool_share: Option<[f64; 2]>,
    self_only: bool,
    capsule: Capsule,
}

impl Robot {
    /// The robot in the file at `path`: TOML of our own, or URDF if the name ends so.
    ///
    /// # Errors
    /// [`KinematicsError::Read`] if there is no such file, else those of [`parse`](Self::parse); for URDF
    /// [`KinematicsError::File`], and [`KinematicsError::Axes`] unless six joints turn.
    pub fn load(path: &Path) -> Result<Self, KinematicsError> {
        if path.extension().is_some_and(|end| end == "urdf") {
            return urdf::robot(&base::robot::read_urdf(path)?, None);
        }
        let text = base::file::read_text(path)
            .map_err(|source| KinematicsError::Read { path: path.to_owned(), source })?;
        Self::parse(&text, path)
    }

    /// The robot in the URDF file at `path`, whose links may touch as the SRDF file at `srdf` says.
    ///
    /// # Errors
    /// As [`load`](Self::load), and what is wrong in the SRDF file, at its place.
    pub fn load_with_srdf(path: &Path, srdf: &Path) -> Result<Self, KinematicsError> {
        let read = base::robot::read_urdf(path)?;
        let mut robot = urdf::robot(&read, Some(&base::robot::read_srdf(srdf, &read)?))?;
        robot.files.push(srdf.to_owned());
        Ok(robot)
    }

    /// The robot that `text` describes; `path` is where it came from, for messages.
    ///
    /// # Errors
    /// [`KinematicsError::File`] with the line, what was found and what is accepted. Refused are text that is not TOML,
    /// unknown and missing keys, numbers that are not finite or of the wrong sign, and contradictions. Rows that the
    /// requested solver does not allow are refused too.
    pub fn parse(text: &str, path: &Path) -> Result<Self, KinematicsError> {
        file::parse(text, path)
    }

    /// The robot's name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The files that were read besides the robot's own.
    pub fn files(&self) -> &[PathBuf] {
        &self.files
    }

    /// What a reader of results should know of how the file was taken, a sentence each: solids that capsules stand for, and a
    /// solver that may miss configurations.
    pub fn notes(&self) -> Vec<String> {
        let solver = self.arm.solver();
        let incomplete = (!solver.is_complete).then(|| solver.to_string());
        self.notes.iter().cloned().chain(incomplete).collect()
    }

    /// The arm, with the tool.
    pub fn arm(&self) -> &Arm {
        &self.arm
    }

    /// How far the tool reaches from the flange, along its z.
    pub fn tool_length_m(&self) -> f64 {
        self.tool_length_m
    }

    /// The bodies, the default one first.
    pub fn bodies(&self) -> &[Body] {
        &self.bodies
    }

    /// The body called `name`.
    pub fn body(&self, name: &str) -> Option<&Body> {
        self.bodies.iter().find(|body| body.name == name)
    }

    /// The same robot with its base at `base`; a file puts it at the origin.
    #[must_use]
    pub fn placed(self, base: &Frame) -> Self {
        Self { arm: self.arm.placed(base), ..self }
    }

    /// The same robot with a tool of another length, which its tool's capsules follow.
    ///
    /// # Errors
    /// [`KinematicsError::Shape`] if the length is not finite or negative, [`KinematicsError::NoTool`] if it
    /// is 0 and a capsule spans a share of it.
    pub fn with_tool_length(&self, tool_length_m: f64) -> Result<Self, KinematicsError> {
        let bodies = self.bodies.iter().map(|body| body.with_tool_length(tool_length_m));
        Ok(Self {
            bodies: bodies.collect::<Result<_, _>>()?,
            arm: self.arm.with_tool(self.flange * tool_frame(tool_length_m)),
            flange: self.flange,
            tool_length_m,
            name: self.name.clone(),
            files: self.files.clone(),
            notes: self.notes.clone(),
        })
    }
}

/// The end of a tool of this length.
fn tool_frame(tool_length_m: f64) -> Frame {
    Frame::at(Vec3::z() * tool_length_m)
}

impl Body {
    /// The body's name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The capsules, in the order of the file.
    pub fn parts(&self) -> &[Part] {
        &self.parts
    }

    /// Which parts, by index, may hit each other and must be checked; all other pairs are neighbours, or
    /// are kept apart by the joint limits.
    pub fn self_pairs(&self) -> &[[usize; 2]] {
        &self.self_pairs
    }

    /// Writes the capsules where `frames` (of [`Chain::frames`](super::Chain::frames)) put them into
    /// `placed`, in the order of [`parts`](Self::parts); what was in it is dropped.
    #[inline]
    pub fn place(&self, frames: &[Frame; AXES + 1], placed: &mut Vec<Capsule>) {
        placed.clear();
        placed.extend(self.parts.iter().map(|part| part.placed(frames)));
    }

    /// The capsules where `chain` puts them at `q`, in the order of [`parts`](Self::parts).
    ///
    /// For who asks from another package: [`place`](Self::place) is compiled there, and what asks seldom is not optimised.
    pub fn at(&self, chain: &Chain, q: &Joints) -> Vec<Capsule> {
        let mut placed = Vec::with_capacity(self.parts.len());
        self.place(&chain.frames(q), &mut placed);
        placed
    }

    /// The parts that a scene can touch, as a body of their own; which of them may hit each other is left out.
    #[must_use]
    pub fn exposed(&self) -> Self {
        let parts = self.parts.iter().filter(|part| !part.self_only).cloned().collect();
        Self { name: self.name.clone(), parts, self_pairs: Vec::new() }
    }

    fn with_tool_length(&self, tool_length_m: f64) -> Result<Self, KinematicsError> {
        let part = |part: &Part| match part.tool_share {
            Some(share) => Part::of_tool(&part.name, share, part.capsule.radius, tool_length_m),
            None => Ok(part.clone()),
        };
        let parts = self.parts.iter().map(part).collect::<Result<_, _>>()?;
        Ok(Self { parts, ..self.clone() })
    }
}

impl Part {
    /// A capsule along the tool, from and to a share of its length; its round end stops at the tip.
    fn of_tool(
        name: &str,
        [from, to]: [f64; 2],
        radius_m: f64,
        tool_length_m: f64,
    ) -> Result<Self, KinematicsError> {
        if tool_length_m <= 0.0 {
            return Err(KinematicsError::NoTool { capsule: name.to_owned() });
        }
        let end_m = (to * tool_length_m).min(tool_length_m - radius_m);
        let [start, end] = [end_m.min(from * tool_length_m), end_m].map(|along_m| Vec3::z() * along_m);
        let capsule = Capsule::new(start, end, radius_m)?;
        Ok(Self {
            name: name.to_owned(),
            link: AXES,
            tool_share: Some([from, to]),
            self_only: false,
            capsule,
        })
    }

    /// The part's name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The link it is fixed to; 0 is the base, which never moves.
    pub fn link(&self) -> usize {
        self.link
    }

    /// Whether only the robot's other parts can hit it: the scene stands clear of it, or holds it.
    pub fn is_self_only(&self) -> bool {
        self.self_only
    }

    /// Where it is in the frame of its link.
    pub fn capsule(&self) -> &Capsule {
        &self.capsule
    }

    /// Where it is in the world.
    #[inline]
    pub fn placed(&self, frames: &[Frame; AXES + 1]) -> Capsule {
        self.capsule.placed(&frames[self.link])
    }
}
