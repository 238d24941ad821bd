//! Chains of any number of joints that turn or slide, by the frames of their joints: what a URDF file gives. Forward kinematics only.

use crate::geometry::{Frame, Vec3};
use base::robot::{Joint, Kind, Robot};
use base::solid::Pose;
use nalgebra::Matrix3;

/// A chain of joints.
#[derive(Debug, Clone, PartialEq)]
pub struct OpenChain {
    joints: Vec<OpenJoint>,
    tip: Frame,
}

/// A joint and the link that it moves.
#[derive(Debug, Clone, PartialEq)]
pub struct OpenJoint {
    /// Its frame at 0, in that of the joint before.
    pub before: Frame,
    /// The unit vector that it turns about or slides along, in its own frame.
    pub axis: Vec3,
    /// The joint as its file gives it.
    pub joint: Joint,
}

impl OpenJoint {
    /// Its frame at `value`, in that at 0.
    fn moved(&self, value: f64) -> Frame {
        match self.joint.kind {
            Kind::Turns | Kind::TurnsOn => Frame::turned(&self.axis, value),
            Kind::Slides => Frame::at(self.axis * value),
        }
    }
}

/// A pose as a frame.
pub fn frame(pose: &Pose) -> Frame {
    let [x, y, z] = pose.rotation;
    let rotation = Matrix3::new(x[0], x[1], x[2], y[0], y[1], y[2], z[0], z[1], z[2]);
    Frame { rotation, origin: Vec3::from(pose.origin_m) }
}

impl OpenChain {
    /// The chain of a robot.
    pub fn new(robot: &Robot) -> Self {
        let joint = |joint: &Joint| OpenJoint {
            before: frame(&joint.before),
            axis: Vec3::from(joint.axis),
            joint: joint.clone(),
        };
        Self { joints: robot.joints.iter().map(joint).collect(), tip: frame(&robot.tip) }
    }

    /// The joints, base first.
    pub fn joints(&self) -> &[OpenJoint] {
        &self.joints
    }

    /// The tip in the frame of the last joint.
    pub fn tip(&self) -> &Frame {
        &self.tip
    }

    /// The base and the frame of each joint, moved, in the base.
    ///
    /// # Panics
    /// If there are more joints than numbers.
    pub fn frames(&self, q: &[f64]) -> Vec<Frame> {
        let mut frames = Vec::with_capacity(self.joints.len() + 1);
        frames.push(Frame::IDENTITY);
        for (index, joint) in self.joints.iter().enumerate() {
            frames.push(frames[index] * joint.before * joint.moved(q[index]));
        }
        frames
    }

    /// The tip in the base.
    pub fn forward(&self, q: &[f64]) -> Frame {
        self.frames(q)[self.joints.len()] * self.tip
    }

    /// The first joint, from 0, that is outside its limits.
    pub fn outside(&self, q: &[f64]) -> Option<usize> {
        self.joints.iter().zip(q).position(|(joint, value)| !joint.joint.allows(*value))
    }

    /// How far each joint moves from one configuration to another, with a sign.
    pub fn change<'q>(&'q self, from: &'q [f64], to: &'q [f64]) -> impl Iterator<Item = f64> + Clone + 'q {
        self.joints.iter().zip(from).zip(to).map(|((joint, from), to)| joint.joint.change(*from, *to))
    }
}
