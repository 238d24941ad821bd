//! Keys that replan ignores in files of other programs, with the reason. Every other unknown key is refused or named.
//!
//! `docs/FILES.md` shows this table.

use std::collections::BTreeSet;

/// A key that is ignored.
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

const SEEN: &str = "it only changes the look";
const WEIGHED: &str = "replan plans without forces";
const CONTROLLER: &str = "it is for controllers; planners use `limit`";
const BESIDE: &str = "it is about simulation or control, not about geometry";
const NAME: &str = "solids have the names of their links";
const TIMED: &str = "paths have no times";
const FIXED: &str = "a `fixed` joint does not move";

/// Every ignored key.
pub const IGNORED: &[Ignored] = &[
    row("problem", "collision_buffer_ik", "goals are given in joints; inverse kinematics is not needed"),
    row("problem", "goal_pose", "goals are given in joints; inverse kinematics is not needed"),
    row("problem", "world_frame", "poses are relative to the robot's base; another name is noted"),
    row("problem", "index", "problems are numbered by their place in the set"),
    row("problem", "note", "a note is for people"),
    row("problem", "problem", "it repeats the set's name"),
    row("problem", "orientation_quat_xyzw", "where `orientation_euler_xyz` says the same, which is checked"),
    row("MoveIt", "name", "it is the name of a file"),
    row("MoveIt", "header", "its frame must be one that is the robot's base; its time is not used"),
    row("MoveIt", "allowed_collision_matrix", "an SRDF file says which links may touch"),
    row("MoveIt", "workspace_parameters", "the robot's joints limit where it can be"),
    row("MoveIt", "group_name", "the chain is the whole chain of the URDF file"),
    row("MoveIt", "planner_id", "contenders are named by the study"),
    row("MoveIt", "num_planning_attempts", "contenders are named by the study"),
    row("MoveIt", "allowed_planning_time", "the study has a budget"),
    row("MoveIt", "max_velocity_scaling_factor", TIMED),
    row("MoveIt", "max_acceleration_scaling_factor", TIMED),
    row("MoveIt", "velocity", "where it is 0"),
    row("MoveIt", "effort", "where it is 0"),
    row("MoveIt", "tolerance_above", "goals are reached exactly; more than 0.001 is refused"),
    row("MoveIt", "tolerance_below", "goals are reached exactly; more than 0.001 is refused"),
    row("MoveIt", "weight", "every constraint holds"),
    row("ROS map", "resolution", "lengths are counted in cells; it must still be a length"),
    row("ROS map", "origin", "cells are counted from the lower left pixel; a yaw is refused"),
    row("URDF", "robot/material", SEEN),
    row("URDF", "robot/gazebo", BESIDE),
    row("URDF", "robot/transmission", BESIDE),
    row("URDF", "robot/ros2_control", BESIDE),
    row("URDF", "robot/sensor", BESIDE),
    row("URDF", "robot/mujoco", BESIDE),
    row("URDF", "link/visual", SEEN),
    row("URDF", "link/inertial", WEIGHED),
    row("URDF", "link/contact", BESIDE),
    row("URDF", "link/self_collision_checking", "the solids are those of `collision`"),
    row("URDF", "link/@type", "the format gives it no meaning"),
    row("URDF", "collision/@name", NAME),
    row("URDF", "collision/@group", NAME),
    row("URDF", "collision/material", SEEN),
    row("URDF", "collision/verbose", NAME),
    row("URDF", "collision/contact_coefficients", WEIGHED),
    row("URDF", "joint/axis", FIXED),
    row("URDF", "joint/limit", FIXED),
    row("URDF", "joint/mimic", FIXED),
    row("URDF", "joint/dynamics", WEIGHED),
    row("URDF", "joint/safety_controller", CONTROLLER),
    row("URDF", "joint/calibration", CONTROLLER),
    row("URDF", "limit/@effort", WEIGHED),
    row("URDF", "limit/@acceleration", TIMED),
    row("URDF", "limit/@deceleration", TIMED),
    row("URDF", "limit/@jerk", TIMED),
    row("URDF", "limit/@lower", "`continuous` joints have no limit"),
    row("URDF", "limit/@upper", "`continuous` joints have no limit"),
    row("SRDF", "robot/group", "the chain is the whole chain of the URDF file"),
    row("SRDF", "robot/group_state", "starts and goals are those of the problem"),
    row("SRDF", "robot/end_effector", "the chain is the whole chain of the URDF file"),
    row("SRDF", "robot/virtual_joint", "poses are relative to the robot's base"),
    row("SRDF", "robot/passive_joint", "the URDF file decides which joints move"),
    row("SRDF", "robot/joint_property", CONTROLLER),
    row("SRDF", "robot/link_sphere_approximation", "the solids are those of the URDF file"),
    row("SRDF", "disable_collisions/@reason", "the reason does not matter"),
    row("scenario", "bucket", "queries are named by their line; it must still be a number"),
];

/// Whether `key` of a file of the format is ignored.
pub(crate) fn is_ignored(format: &str, key: &str) -> bool {
    IGNORED.iter().any(|row| row.format == format && row.key == key)
}

/// The keys of an element that are ignored, of attributes with `@`.
pub(crate) fn ignored_in(format: &str, element: &str) -> impl Iterator<Item = &'static str> {
    let rows = IGNORED.iter().filter(move |row| row.format == format);
    rows.filter_map(move |row| row.key.strip_prefix(element)?.strip_prefix('/'))
}

/// A sentence with the ignored keys that a file has, if it has any.
pub fn ignored_note(keys: &BTreeSet<String>) -> Option<String> {
    let keys = keys.iter().map(|key| format!("`{key}`")).collect::<Vec<_>>().join(", ");
    (!keys.is_empty()).then(|| format!("ignored keys: {keys}; docs/FILES.md has the reasons"))
}
