//! What a roadmap stands on: configurations, their places, and local paths between them.

use super::plane::{PlaneMap, RASTER_MM};
use crate::kinematics::{AXES, Joint, Joints};
use crate::space::cell::{Lines, Path, Pose, Rejection, Scratch};
use crate::space::{JointSpace, MotionMemory};
use base::robot::Kind;
use std::f64::consts::PI;

/// The robot of a roadmap and the local paths it can take.
#[derive(Debug)]
pub enum Local {
    /// A six-axis arm; configurations are joint angles in radians.
    Arm(Box<Lines>),
    /// A robot of any number of joints; configurations are angles in radians and slides in metres.
    Joints(Box<JointSpace>),
    /// A particle in the plane; configurations are [x, y] in millimetres.
    Plane(PlaneMap),
}

/// Buffers that are reused from motion to motion.
#[derive(Debug, Default)]
pub struct MotionScratch {
    paths: Scratch,
    memory: MotionMemory,
}

impl MotionScratch {
    /// How many configurations were checked for contact.
    pub fn checked(&self) -> u64 {
        self.paths.checked()
    }
}

/// A configuration, ready for local paths.
#[derive(Debug, Clone)]
pub(super) enum Node {
    Arm(Pose),
    Joints(Vec<f64>),
    Plane([f64; 2]),
}

impl Node {
    /// The place of the node, whose configuration is `config`: what [`Local::place_mm`] says, without asking again.
    pub(super) fn place_mm(&self, local: &Local, config: &[f64]) -> [f64; 3] {
        match self {
            Self::Arm(pose) => (pose.tool.origin * 1e3).into(),
            Self::Joints(_) | Self::Plane(_) => local.place_mm(config),
        }
    }
}

/// The six joint angles in `config`, if it has six numbers.
pub fn joints(config: &[f64]) -> Option<Joints> {
    <[f64; AXES]>::try_from(config).ok()
}

impl Local {
    /// Why the robot cannot be in `config`; `None` if it can.
    pub fn refusal(&self, config: &[f64]) -> Option<String> {
        let width = self.width();
        let wrong = || format!("it has {} numbers; a configuration has {width}", config.len());
        if config.len() != width || config.iter().any(|x| !x.is_finite()) {
            return Some(if config.len() == width {
                "it has a number that is not finite".to_owned()
            } else {
                wrong()
            });
        }
        match self {
            Self::Arm(lines) => lines.cell().refusal(&joints(config).expect("the length was checked")),
            Self::Joints(space) => space.refusal(config),
            Self::Plane(map) => map.refusal([config[0], config[1]]),
        }
    }

    /// How many numbers make a configuration.
    pub fn width(&self) -> usize {
        match self {
            Self::Arm(_) => AXES,
            Self::Joints(space) => space.chain().joints().len(),
            Self::Plane(_) => 2,
        }
    }

    /// For each number of a configuration, whether it is an angle of a joint that turns without end.
    pub fn turn_on(&self) -> Vec<bool> {
        match self {
            Self::Arm(lines) => {
                lines.cell().robot().arm().chain().joints().iter().map(Joint::is_endless).collect()
            }
            Self::Plane(_) => vec![false; self.width()],
            Self::Joints(space) => {
                space.robot().joints.iter().map(|joint| joint.kind == Kind::TurnsOn).collect()
            }
        }
    }

    /// The place whose distances are a path's length: the tool's tip or the particle, millimetres.
    pub fn place_mm(&self, config: &[f64]) -> [f64; 3] {
        match self {
            Self::Arm(lines) => {
                let q = joints(config).expect("a configuration of an arm has six angles");
                (lines.cell().robot().arm().chain().forward(&q).origin * 1e3).into()
            }
            Self::Joints(space) => (space.chain().forward(config).origin * 1e3).into(),
            Self::Plane(_) => [config[0], config[1], 0.0],
        }
    }

    /// Whether the tool moves straight along local paths: their length is then the distance of their ends.
    pub fn is_straight(&self) -> bool {
        match self {
            Self::Arm(lines) => lines.rules().path == Path::Tool,
            Self::Joints(_) => false,
            Self::Plane(_) => true,
        }
    }

    /// The least and the greatest value of each number of a configuration; one turn for joints that turn without end.
    pub fn limits(&self) -> Vec<[f64; 2]> {
        let turn = |joint: &Joint| {
            if joint.is_endless() { [-PI, PI] } else { [joint.lower_rad, joint.upper_rad] }
        };
        match self {
            Self::Arm(lines) => lines.cell().robot().arm().chain().joints().iter().map(turn).collect(),
            Self::Joints(space) => space.robot().joints.iter().map(|joint| joint.limits).collect(),
            Self::Plane(map) => map.size_mm().map(|size| [0.0, size]).to_vec(),
        }
    }

    /// Whether the local path from a configuration where the robot can be to another can be executed; `finely`, as
    /// [`JointSpace::holds`] looks at the motions of a robot of any number of joints.
    pub fn goes(&self, ends: [&[f64]; 2], finely: bool, scratch: &mut MotionScratch) -> bool {
        match self {
            Self::Joints(space) => {
                let MotionScratch { paths, memory } = scratch;
                if finely {
                    space.holds(ends, memory, paths.count())
                } else {
                    space.goes(ends, 1.0, memory, paths.count())
                }
            }
            Self::Arm(_) | Self::Plane(_) => {
                let [from, to] = ends;
                self.refusal(to).is_none()
                    && self.join(&self.node(from), &self.node(to), &mut scratch.paths).is_ok()
            }
        }
    }

    /// A computed configuration as planners may use it: in the plane, the nearest point of the raster.
    pub fn settled(&self, config: Vec<f64>) -> Vec<f64> {
        match self {
            Self::Arm(_) | Self::Joints(_) => config,
            Self::Plane(_) => {
                config.into_iter().map(|value| (value / RASTER_MM).round() * RASTER_MM).collect()
            }
        }
    }

    pub(super) fn node(&self, config: &[f64]) -> Node {
        match self {
            Self::Arm(lines) => Node::Arm(lines.pose(&joints(config).expect("six angles"))),
            Self::Joints(_) => Node::Joints(config.to_vec()),
            Self::Plane(_) => Node::Plane([config[0], config[1]]),
        }
    }

    pub(super) fn join(&self, from: &Node, to: &Node, scratch: &mut Scratch) -> Result<(), Rejection> {
        match (self, from, to) {
            (Self::Arm(lines), Node::Arm(from), Node::Arm(to)) => lines.join(from, to, scratch),
            (Self::Joints(space), Node::Joints(from), Node::Joints(to)) => {
                let is_free = space.joins(from, to, scratch.count());
                if is_free { Ok(()) } else { Err(Rejection::Contact) }
            }
            (Self::Plane(map), Node::Plane(from), Node::Plane(to)) => {
                if map.sees(*from, *to) {
                    Ok(())
                } else {
                    Err(Rejection::Contact)
                }
            }
            _ => unreachable!("a roadmap's nodes are of its own kind"),
        }
    }
}
