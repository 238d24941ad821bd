//! One problem as `MoveIt` stores it: a scene (`moveit_msgs/PlanningScene`) and a request (`moveit_msgs/MotionPlanRequest`), in YAML.
//!
//! Of a scene the collision objects are read: `primitives` (box, cylinder by height and radius, sphere) at `primitive_poses`, in the frame of
//! the object's `pose` if it has one; quaternions are x, y, z, w. Of a request the start and each goal in joints are read. What could move or
//! hold something and is not read is refused unless it is empty.
//!
//! Source: the message definitions of `moveit_msgs`; sets as `MotionBenchMaker` ships them.

use super::reader::Reader;
use super::{Ended, Expected, Problem, check_robot};
use crate::ignored::is_ignored;
use crate::settings::{Document, SettingsError};
use crate::solid::{Form, Pose, Solid, Source};
use crate::yaml::{Node, Yaml};
use std::cell::RefCell;

/// The problem of a scene and a request. Starts and goals are in the order of the robot's joints.
///
/// # Errors
/// The first fault at its place: another robot, joints that are missing, obstacles or constraints that are not read.
pub fn parse_moveit(
    scene: &Document,
    request: &Document,
    expected: &Expected<'_>,
) -> Result<Problem, SettingsError> {
    let notes = RefCell::default();
    let root = Yaml::parse(scene)?;
    let reader = Reader { yaml: Yaml(Source(scene)), notes: &notes };
    check_robot(reader, &root, "robot_model_name", expected.robot)?;
    let obstacles = reader.scene(&root)?;
    let root = Yaml::parse(request)?;
    let reader = Reader { yaml: Yaml(Source(request)), notes: &notes };
    let (start, goals) = reader.request(&root, expected)?;
    Ok(Problem { obstacles, start, goals, is_valid: true, notes: notes.into_inner().into_iter().collect() })
}

impl Reader<'_> {
    /// Refuses every key that is neither read nor in the table of ignored keys, unless nothing stands under it.
    fn moveit_rest(self, of: &Node, read: &[&str]) -> Result<(), SettingsError> {
        for (key, node) in self.yaml.table(of)? {
            if !read.contains(&key.as_str()) && !is_ignored("MoveIt", key) && !node.is_empty() {
                let message =
                    format!("`{key}` is not read; an empty one and {} are accepted", read.join(", "));
                return Err(self.fault(node, message));
            }
        }
        Ok(())
    }

    fn scene(self, root: &Node) -> Result<Vec<Solid>, SettingsError> {
        self.moveit_rest(root, &["robot_model_name", "world", "robot_state", "fixed_frame_transforms"])?;
        if let Some(state) = self.yaml.find(root, "robot_state")? {
            self.state(state)?;
        }
        if let Some(frames) = self.yaml.find(root, "fixed_frame_transforms")? {
            for frame in self.yaml.list(frames)? {
                self.refuse_moved(self.yaml.get(frame, "transform")?)?;
            }
        }
        let world = self.yaml.get(root, "world")?;
        self.moveit_rest(world, &["collision_objects"])?;
        let mut solids = Vec::new();
        for object in self.yaml.list(self.yaml.get(world, "collision_objects")?)? {
            self.object(object, &mut solids)?;
        }
        Ok(solids)
    }

    /// A state in which the base is moved would be another problem.
    fn state(self, state: &Node) -> Result<(), SettingsError> {
        self.moveit_rest(state, &["joint_state", "multi_dof_joint_state"])?;
        let Some(base) = self.yaml.find(state, "multi_dof_joint_state")? else { return Ok(()) };
        self.moveit_rest(base, &["joint_names", "transforms"])?;
        let Some(transforms) = self.yaml.find(base, "transforms")? else { return Ok(()) };
        self.yaml.list(transforms)?.iter().try_for_each(|transform| self.refuse_moved(transform))
    }

    /// A frame that is another than the robot's base would move all.
    fn refuse_moved(self, transform: &Node) -> Result<(), SettingsError> {
        for (key, still) in [("translation", &[0.0; 3][..]), ("rotation", &[0.0, 0.0, 0.0, 1.0])] {
            let node = self.yaml.get(transform, key)?;
            if self.yaml.numbers(node, key)? != still {
                let message = format!(
                    "the {key} of a frame is not that of the robot's base; one that moves nothing is accepted"
                );
                return Err(self.fault(node, message));
            }
        }
        Ok(())
    }

    fn object(self, object: &Node, solids: &mut Vec<Solid>) -> Result<(), SettingsError> {
        self.moveit_rest(object, &["id", "pose", "primitives", "primitive_poses"])?;
        let name = self.yaml.word(self.yaml.get(object, "id")?)?;
        let base =
            self.yaml.find(object, "pose")?.map_or(Ok(Pose::IDENTITY), |pose| self.moveit_pose(pose))?;
        let forms = self.yaml.list(self.yaml.get(object, "primitives")?)?;
        let poses_at = self.yaml.get(object, "primitive_poses")?;
        let poses = self.yaml.list(poses_at)?;
        if forms.len() != poses.len() || forms.is_empty() {
            let (found, accepted) = (poses.len(), forms.len().max(1));
            let message =
                format!("`{name}` has {found} poses for {} primitives; {accepted} are accepted", forms.len());
            return Err(self.fault(poses_at, message));
        }
        for (form, pose) in forms.iter().zip(poses) {
            let pose = base.then(&self.moveit_pose(pose)?);
            solids.push(Solid { name: name.to_owned(), pose, form: self.primitive(form)? });
        }
        Ok(())
    }

    fn primitive(self, primitive: &Node) -> Result<Form, SettingsError> {
        self.moveit_rest(primitive, &["type", "dimensions"])?;
        let kind = self.yaml.get(primitive, "type")?;
        let sizes = self.yaml.get(primitive, "dimensions")?;
        let positive = |number: f64| self.yaml.0.sizes(&sizes.at, "dimensions", [number]).map(|[size]| size);
        match self.yaml.word(kind)? {
            "box" => {
                let sides = self.yaml.exactly::<3>(sizes, "dimensions")?;
                Ok(Form::Box(self.yaml.0.sizes(&sizes.at, "dimensions", sides)?.map(|side| 0.5 * side)))
            }
            "cylinder" => {
                let [height, radius] = self.yaml.exactly::<2>(sizes, "dimensions")?;
                Ok(Form::Cylinder(positive(radius)?, positive(height)?))
            }
            "sphere" => Ok(Form::Sphere(positive(self.yaml.exactly::<1>(sizes, "dimensions")?[0])?)),
            other => {
                let message = format!("a primitive is a `{other}`; box, cylinder and sphere are accepted");
                Err(self.fault(kind, message))
            }
        }
    }

    fn moveit_pose(self, pose: &Node) -> Result<Pose, SettingsError> {
        self.moveit_rest(pose, &["position", "orientation"])?;
        let position = self.yaml.get(pose, "position")?;
        let [a, b, c] = self.yaml.exactly::<3>(position, "position")?;
        let Some(turned) = self.yaml.find(pose, "orientation")? else {
            return Ok(Pose {
                origin_m: self.yaml.0.metres(&position.at, "position", [a, b, c])?,
                ..Pose::IDENTITY
            });
        };
        let [x, y, z, w] = self.yaml.exactly::<4>(turned, "orientation")?;
        Ok(self.unit(self.yaml.0.pose(&turned.at, "orientation", [a, b, c, w, x, y, z])?))
    }

    fn request(self, root: &Node, expected: &Expected<'_>) -> Result<(Ended, Vec<Ended>), SettingsError> {
        self.moveit_rest(root, &["start_state", "goal_constraints"])?;
        let start = self.yaml.get(root, "start_state")?;
        self.state(start)?;
        let state = self.yaml.get(start, "joint_state")?;
        let (names_at, values_at) = (self.yaml.get(state, "name")?, self.yaml.get(state, "position")?);
        let names = self.yaml.list(names_at)?.iter().map(|name| self.yaml.word(name));
        let names: Vec<&str> = names.collect::<Result<_, _>>()?;
        let values = self.yaml.numbers(values_at, "position")?;
        if names.len() != values.len() {
            let message =
                format!("{} numbers for {} joints; one each is accepted", values.len(), names.len());
            return Err(self.fault(values_at, message));
        }
        let named: Vec<(&str, f64)> = names.into_iter().zip(values).collect();
        let start = self.in_order(state, "start", &named, expected)?;
        let goals_at = self.yaml.get(root, "goal_constraints")?;
        let goals = self.yaml.list(goals_at)?.iter().map(|goal| self.goal(goal, expected));
        let goals: Vec<Ended> = goals.collect::<Result<_, _>>()?;
        if goals.is_empty() {
            return Err(self.fault(goals_at, "the list of goals is empty; at least one is accepted"));
        }
        Ok((start, goals))
    }

    fn goal(self, goal: &Node, expected: &Expected<'_>) -> Result<Ended, SettingsError> {
        self.moveit_rest(goal, &["joint_constraints"])?;
        let mut named = Vec::new();
        for joint in self.yaml.list(self.yaml.get(goal, "joint_constraints")?)? {
            let name = self.yaml.word(self.yaml.get(joint, "joint_name")?)?;
            let position = self.yaml.get(joint, "position")?;
            named.push((name, self.yaml.number(position, "position")?));
        }
        self.in_order(goal, "goal", &named, expected)
    }

    /// The numbers of the robot's joints; those of other joints, which do not move here, are left out.
    fn in_order(
        self,
        at: &Node,
        what: &str,
        named: &[(&str, f64)],
        expected: &Expected<'_>,
    ) -> Result<Ended, SettingsError> {
        let value = |joint: &&str| {
            let missing = || {
                let robot = expected.robot;
                self.fault(
                    at,
                    format!("the {what} has no joint `{joint}` of `{robot}`; all joints are accepted"),
                )
            };
            let found = named.iter().find(|(name, _)| name == joint).ok_or_else(missing)?;
            self.yaml.0.radians(&at.at, what, [found.1]).map(|[value]| value)
        };
        let joints = expected.joints.iter().map(value).collect::<Result<_, _>>()?;
        Ok(Ended { joints, at: at.at.clone() })
    }
}
