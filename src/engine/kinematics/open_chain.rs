//! Chains of any number of turning joints, by the frames of their joints: what a URDF file gives. Forward kinematics only.

use crate::geometry::{Frame, Vec3};
use base::robot::Robot;
use base::solid::Pose;
use nalgebra::Matrix3;

/// A chain of turning joints.
#[derive(Debug, Clone, PartialEq)]
pub struct OpenChain {
    joints: Vec<OpenJoint>,
    tip: Frame,
}

/// A joint and the link that it moves.
#[derive(Debug, Clone, PartialEq)]
pub struct OpenJoint {
    /// Its frame at the angle 0, in that of the joint before.
    pub before: Frame,
    /// The unit vector that it turns about, in its own frame.
    pub axis: Vec3,
    /// The least and the greatest angle.
    pub limits_rad: [f64; 2],
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
        let joint = |joint: &base::robot::Joint| OpenJoint {
            before: frame(&joint.before),
            axis: Vec3::from(joint.axis),
            limits_rad: joint.limits_rad,
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

    /// The base and the frame of each joint, turned, in the base.
    ///
    /// # Panics
    /// If there are more joints than angles.
    pub fn frames(&self, q: &[f64]) -> Vec<Frame> {
        let mut frames = Vec::with_capacity(self.joints.len() + 1);
        frames.push(Frame::IDENTITY);
        for (index, joint) in self.joints.iter().enumerate() {
            frames.push(frames[index] * joint.before * Frame::turned(&joint.axis, q[index]));
        }
        frames
    }

    /// The tip in the base.
    pub fn forward(&self, q: &[f64]) -> Frame {
        self.frames(q)[self.joints.len()] * self.tip
    }

    /// The first joint, from 0, that is outside its limits.
    pub fn outside(&self, q: &[f64]) -> Option<usize> {
        self.joints.iter().zip(q).position(|(joint, angle)| {
            let [lower, upper] = joint.limits_rad;
            !(lower..=upper).contains(angle)
        })
    }
}
