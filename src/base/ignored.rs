//! What files of others may say that is passed over, and why; everything else that is not read is refused or told by name.
//!
//! `docs/FILES.md` shows this table.

/// A key that is passed over.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Ignored {
    /// The format.
    pub format: &'static str,
    /// The key, or the elements on the way to it and an attribute after `@`.
    pub key: &'static str,
    /// Why.
    pub why: &'static str,
}

const fn row(format: &'static str, key: &'static str, why: &'static str) -> Ignored {
    Ignored { format, key, why }
}

const SEEN: &str = "it is only seen";
const WEIGHED: &str = "no forces are planned with";
const CONTROLLER: &str = "a controller holds it, a planner holds `limit`";
const BESIDE: &str = "it is about simulation or control, not about geometry";
const NAME: &str = "names of solids are those of their links";

/// Every key that is passed over.
pub const IGNORED: &[Ignored] = &[
    row("problem", "collision_buffer_ik", "goals are given in joints; inverse kinematics is not asked for"),
    row("problem", "goal_pose", "goals are given in joints; inverse kinematics is not asked for"),
    row("problem", "world_frame", "everything is placed from the robot's base"),
    row("problem", "index", "problems are counted by their place in the set"),
    row("problem", "note", "a note is for people"),
    row("problem", "problem", "it is the set's name again"),
    row("problem", "orientation_quat_xyzw", "where `orientation_euler_xyz` says the same, which is checked"),
    row("ROS map", "resolution", "cells are cells; it must be a length all the same"),
    row("ROS map", "origin", "cells are counted from the lower left pixel; a yaw is refused"),
    row("URDF", "robot/@version", "there is one version"),
    row("URDF", "robot/material", SEEN),
    row("URDF", "robot/gazebo", BESIDE),
    row("URDF", "robot/transmission", BESIDE),
    row("URDF", "robot/ros2_control", BESIDE),
    row("URDF", "robot/sensor", BESIDE),
    row("URDF", "robot/mujoco", BESIDE),
    row("URDF", "link/visual", SEEN),
    row("URDF", "link/inertial", WEIGHED),
    row("URDF", "link/contact", BESIDE),
    row("URDF", "link/@type", "it means nothing in the format"),
    row("URDF", "collision/@name", NAME),
    row("URDF", "collision/@group", NAME),
    row("URDF", "collision/material", SEEN),
    row("URDF", "joint/dynamics", WEIGHED),
    row("URDF", "joint/safety_controller", CONTROLLER),
    row("URDF", "joint/calibration", CONTROLLER),
    row("URDF", "limit/@effort", WEIGHED),
    row("URDF", "limit/@lower", "of `continuous` joints, which have none"),
    row("URDF", "limit/@upper", "of `continuous` joints, which have none"),
    row("SRDF", "robot/group", "the chain is the whole of the URDF file's"),
    row("SRDF", "robot/group_state", "starts and goals are those of the problem"),
    row("SRDF", "robot/end_effector", "the chain is the whole of the URDF file's"),
    row("SRDF", "robot/virtual_joint", "everything is placed from the robot's base"),
    row("SRDF", "robot/passive_joint", "a joint that moves is refused or planned for by the URDF file"),
    row("SRDF", "robot/joint_property", CONTROLLER),
    row("SRDF", "robot/link_sphere_approximation", "the solids are those of the URDF file"),
    row("SRDF", "disable_collisions/@reason", "a pair that may touch may touch for any reason"),
    row("scenario", "bucket", "queries are named by their line; a bucket must be a number all the same"),
];

/// Whether `key` of a file of the format is passed over.
pub(crate) fn is_ignored(format: &str, key: &str) -> bool {
    IGNORED.iter().any(|row| row.format == format && row.key == key)
}
