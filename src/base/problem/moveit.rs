//! One problem as `MoveIt` stores it: a scene (`moveit_msgs/PlanningScene`) and a request (`moveit_msgs/MotionPlanRequest`), in YAML.
//!
//! Of a scene the collision objects are read: `primitives` (box, cylinder by height and radius, sphere) at `primitive_poses`, in the frame of
//! the object's `pose` if it has one; quaternions are x, y, z, w. Of a request the start and each goal in joints are read. What is neither
//! read nor in the table of ignored keys is refused unless it is empty.
//!
//! Source: the message definitions of `moveit_msgs`; sets as `MotionBenchMaker` ships them.

use super::reader::{Reader, Seen};
use super::{Ended, Expected, Problem, check_robot};
use crate::ignored::is_ignored;
use crate::settings::{Document, SettingsError};
use crate::solid::{Form, Pose, Solid, Source};
use crate::text::brief;
use crate::yaml::{Node, Yaml};
use std::cell::RefCell;

/// How far from its position a goal may be in a joint.
const TOLERANCES: [&str; 2] = ["tolerance_above", "tolerance_below"];
/// A tolerance up to this means the position itself: `MoveIt`'s own is 1e-4.
const EXACT: f64 = 1e-3;

/// A joint's name, its number, and where that stands.
type Named<'a> = (&'a str, f64, &'a Node);

/// The problem of a scene and a request. Starts and goals are in the order of the robot's joints.
///
/// # Errors
/// The first fault at its place: another robot, joints that are missing, obstacles or constraints that are not read.
pub fn parse_moveit(
    scene: &Document,
    request: &Document,
    expected: &Expected<'_>,
) -> Result<Problem, SettingsError> {
    let seen: RefCell<Seen> = RefCell::default();
    let root = Yaml::parse(scene)?;
    let reader = Reader { yaml: Yaml(Source(scene)), base: Some(expected.base), seen: &seen };
    check_robot(reader, &root, "robot_model_name", expected.robot)?;
    let (obstacles, state) = reader.scene(&root)?;
    let other = Yaml::parse(request)?;
    let reader = Reader { yaml: Yaml(Source(request)), ..reader };
    let (start, goals) = reader.request(&other, expected)?;
    let differs = |(name, value, _): &Named<'_>| {
        let same = expected.joints.iter().zip(&start.joints).find(|(joint, _)| *joint == name);
        same.is_some_and(|(_, start)| start != value)
    };
    if state.iter().any(differs) {
        reader.note(
            "the start is that of the request; the `robot_state` of the scene is another one".to_owned(),
        );
    }
    Ok(seen.into_inner().noted(Problem::new(obstacles, start, goals)))
}

impl Reader<'_> {
    /// Refuses every key that is neither read nor in the table of ignored keys, unless nothing stands under it.
    fn moveit_rest(self, of: &Node, read: &[&str]) -> Result<(), SettingsError> {
        for (key, node) in self.yaml.table(of)? {
            if read.contains(&key.as_str()) || node.is_empty() {
                continue;
            }
            let is_idle = match key.as_str() {
                "velocity" | "effort" => self.yaml.numbers(node, key)?.iter().all(|number| *number == 0.0),
                _ => true,
            };
            if is_idle && is_ignored("MoveIt", key) {
                self.ignore(key);
            } else {
                let message =
                    format!("`{key}` is not read; an empty one and {} are accepted", read.join(", "));
                return Err(self.fault(node, message));
            }
        }
        Ok(())
    }

    /// The solids, and the numbers of joints in the state of the robot.
    fn scene(self, root: &Node) -> Result<(Vec<Solid>, Vec<Named<'_>>), SettingsError> {
        self.moveit_rest(root, &["robot_model_name", "world", "robot_state", "fixed_frame_transforms"])?;
        let state = self.yaml.find(root, "robot_state")?;
        let joints = state.map_or(Ok(Vec::new()), |state| self.state(state))?;
        let mut still = vec!["", self.base.unwrap_or_default()];
        if let Some(frames) = self.yaml.find(root, "fixed_frame_transforms")? {
            for frame in self.yaml.list(frames)? {
                self.moveit_rest(frame, &["child_frame_id", "transform"])?;
                self.refuse_moved(self.yaml.get(frame, "transform")?)?;
                self.refuse_frame(frame, &still)?;
                still.extend(
                    self.yaml.find(frame, "child_frame_id")?.map(|name| self.yaml.word(name)).transpose()?,
                );
            }
        }
        let world = self.yaml.get(root, "world")?;
        self.moveit_rest(world, &["collision_objects"])?;
        let mut solids = Vec::new();
        for object in self.yaml.list(self.yaml.get(world, "collision_objects")?)? {
            self.refuse_frame(object, &still)?;
            self.object(object, &mut solids)?;
        }
        Ok((solids, joints))
    }

    /// Refuses what stands in a frame that is not the robot's base, by its own name or that of one that moves nothing.
    fn refuse_frame(self, of: &Node, still: &[&str]) -> Result<(), SettingsError> {
        let header = self.yaml.find(of, "header")?;
        let frame = header.map_or(Ok(None), |header| self.yaml.find(header, "frame_id"))?;
        let Some(frame) = frame else { return Ok(()) };
        let name = self.yaml.word(frame)?;
        if still.contains(&name) {
            return Ok(());
        }
        let accepted = still[1..].join("`, `");
        let message =
            format!("the frame is `{}`; that of the robot's base is accepted: `{accepted}`", brief(name));
        Err(self.fault(frame, message))
    }

    /// The numbers of the joints of a state. One in which the base is moved would be another problem.
    fn state(self, state: &Node) -> Result<Vec<Named<'_>>, SettingsError> {
        self.moveit_rest(state, &["joint_state", "multi_dof_joint_state"])?;
        if let Some(base) = self.yaml.find(state, "multi_dof_joint_state")? {
            self.moveit_rest(base, &["joint_names", "transforms"])?;
            let transforms = self.yaml.find(base, "transforms")?;
            let transforms = transforms.map_or(Ok(&[][..]), |transforms| self.yaml.list(transforms))?;
            transforms.iter().try_for_each(|transform| self.refuse_moved(transform))?;
        }
        let joints = self.yaml.find(state, "joint_state")?.filter(|joints| !joints.is_empty());
        let Some(joints) = joints else { return Ok(Vec::new()) };
        self.moveit_rest(joints, &["name", "position"])?;
        let (names_at, values_at) = (self.yaml.get(joints, "name")?, self.yaml.get(joints, "position")?);
        let names = self.yaml.list(names_at)?.iter().map(|name| self.yaml.word(name));
        let names: Vec<&str> = names.collect::<Result<_, _>>()?;
        let values = self.yaml.numbers(values_at, "position")?;
        if names.len() != values.len() {
            let message =
                format!("{} numbers for {} joints; one each is accepted", values.len(), names.len());
            return Err(self.fault(values_at, message));
        }
        let values = values.into_iter().zip(self.yaml.list(values_at)?);
        Ok(names.into_iter().zip(values).map(|(name, (value, at))| (name, value, at)).collect())
    }

    /// A frame that is another than the robot's base would move all.
    fn refuse_moved(self, transform: &Node) -> Result<(), SettingsError> {
        self.moveit_rest(transform, &["translation", "rotation"])?;
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
            let found = poses.len();
            let accepted = forms.len().max(1);
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
        let named = self.state(start)?;
        let others = named.iter().map(|(name, ..)| *name).filter(|name| !expected.joints.contains(name));
        let others = others.collect::<Vec<_>>().join("`, `");
        if !others.is_empty() {
            self.note(format!("joints of the start that do not move in `{}`: `{others}`", expected.robot));
        }
        let start = self.in_order(self.yaml.get(start, "joint_state")?, "start", &named, expected)?;
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
            self.moveit_rest(joint, &[&["joint_name", "position"], &TOLERANCES[..]].concat())?;
            for key in TOLERANCES {
                let Some(node) = self.yaml.find(joint, key)? else { continue };
                let tolerance = self.yaml.number(node, key)?;
                if !(0.0..=EXACT).contains(&tolerance) {
                    let message = format!(
                        "{key} is {tolerance}; 0 to {EXACT} is accepted: a goal is one configuration"
                    );
                    return Err(self.fault(node, message));
                }
                self.ignore(key);
            }
            let name = self.yaml.word(self.yaml.get(joint, "joint_name")?)?;
            let position = self.yaml.get(joint, "position")?;
            named.push((name, self.yaml.number(position, "position")?, position));
        }
        self.in_order(goal, "goal", &named, expected)
    }

    /// The numbers of the robot's joints; those of other joints, which do not move here, are left out.
    fn in_order(
        self,
        at: &Node,
        what: &str,
        named: &[Named<'_>],
        expected: &Expected<'_>,
    ) -> Result<Ended, SettingsError> {
        for (index, (name, ..)) in named.iter().enumerate() {
            if named[..index].iter().any(|(other, ..)| other == name) {
                let name = brief(name);
                return Err(
                    self.fault(at, format!("the {what} gives joint `{name}` twice; once is accepted"))
                );
            }
        }
        let value = |joint: &&str| {
            let missing = || {
                let robot = expected.robot;
                self.fault(
                    at,
                    format!("the {what} has no joint `{joint}` of `{robot}`; all joints are accepted"),
                )
            };
            let (_, value, at) = named.iter().find(|(name, ..)| name == joint).ok_or_else(missing)?;
            let key = format!("joint `{joint}` of the {what}");
            self.yaml.0.radians(&at.at, &key, [*value]).map(|[value]| value)
        };
        let joints = expected.joints.iter().map(value).collect::<Result<_, _>>()?;
        Ok(Ended { joints, at: at.at.clone() })
    }
}
