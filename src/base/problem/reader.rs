//! One problem of a set: its obstacles and its ends.

use super::{Ended, Problem};
use crate::ignored::is_ignored;
use crate::settings::{SettingsError, did_you_mean};
use crate::solid::{Form, Pose, Solid};
use crate::text::brief;
use crate::yaml::{Node, Yaml, unknown};
use std::cell::RefCell;
use std::collections::BTreeSet;

/// The kinds of obstacle of VAMP's form, each a list in its problem.
const KINDS: [&str; 3] = ["box", "cylinder", "sphere"];
/// What a goal in joints may be called.
const GOALS: [&str; 3] = ["goals", "goal_ik", "goal"];
/// Two rotations of one solid are the same if they take no axis further apart than this.
const SAME: f64 = 1e-2;
/// Words of keys that may change the robot, what stands around it, or the query: a key with one of them that is not read is refused.
pub(super) const MEANT: [&str; 51] = [
    "attach",
    "attached",
    "attachment",
    "base",
    "buffer",
    "capsule",
    "clearance",
    "cloud",
    "cone",
    "constraint",
    "cuboid",
    "deg",
    "degree",
    "ellipsoid",
    "feasible",
    "frame",
    "goal",
    "gripper",
    "infeasible",
    "inflate",
    "inflation",
    "invalid",
    "joint",
    "limit",
    "link",
    "lower",
    "margin",
    "mesh",
    "object",
    "obstacle",
    "octomap",
    "offset",
    "pad",
    "padding",
    "plane",
    "pointcloud",
    "points",
    "pose",
    "robot",
    "scale",
    "solvable",
    "start",
    "tolerance",
    "tool",
    "transform",
    "unit",
    "unsolvable",
    "upper",
    "valid",
    "voxel",
    "waypoint",
];

/// What was seen in a file and is not read.
#[derive(Default)]
pub(super) struct Seen {
    /// What the robot is called, if it is named.
    pub(super) robot: Option<String>,
    notes: BTreeSet<String>,
    ignored: BTreeSet<String>,
}

impl Seen {
    /// The problem, with what was seen of it.
    pub(super) fn noted(self, problem: Problem) -> Problem {
        let Self { robot, notes, ignored } = self;
        Problem { robot, notes: notes.into_iter().collect(), ignored, ..problem }
    }
}

/// The file, and what was seen in it.
#[derive(Clone, Copy)]
pub(super) struct Reader<'a> {
    pub(super) yaml: Yaml<'a>,
    /// The name of the robot's base link, if there is a robot.
    pub(super) base: Option<&'a str>,
    pub(super) seen: &'a RefCell<Seen>,
}

impl Reader<'_> {
    pub(super) fn fault(self, at: &Node, message: impl Into<String>) -> SettingsError {
        self.yaml.0.fault(&at.at, message)
    }

    pub(super) fn note(self, message: String) {
        self.seen.borrow_mut().notes.insert(message);
    }

    pub(super) fn ignore(self, key: &str) {
        self.seen.borrow_mut().ignored.insert(key.to_owned());
    }

    /// Looks at a key that may be none of those that are read. One in the table of ignored keys is passed over. One that is nearly written
    /// like one that is read or that may change the problem is refused, and so is one with tables under it if that `may_be_solids`.
    /// Another is noted.
    pub(super) fn unread(
        self,
        key: &str,
        node: &Node,
        read: &[&str],
        may_be_solids: bool,
    ) -> Result<(), SettingsError> {
        if read.contains(&key) {
            return Ok(());
        }
        if is_ignored("problem", key) {
            self.ignore(key);
            return if key == "world_frame" { self.frame(node) } else { Ok(()) };
        }
        if may_be_solids && node.has_tables() {
            let message = format!("obstacles are `{}`; {} are accepted", brief(key), KINDS.join(", "));
            return Err(self.fault(node, message));
        }
        if !did_you_mean(key, read.iter().copied()).is_empty() || may_change_the_problem(key) {
            return Err(self.fault(node, unknown(key, read)));
        }
        self.note(format!("`{}` is not known and not used", brief(key)));
        Ok(())
    }

    /// Notes a frame of another name than the robot's base.
    fn frame(self, node: &Node) -> Result<(), SettingsError> {
        let frame = self.yaml.word(node)?;
        if let Some(base) = self.base.filter(|base| *base != frame) {
            let frame = brief(frame);
            self.note(format!(
                "poses in the frame `{frame}` are taken as relative to the robot's base `{base}`"
            ));
        }
        Ok(())
    }

    /// The problem; `order` says where the number of each joint stands.
    pub(super) fn problem(self, problem: &Node, order: Option<&[usize]>) -> Result<Problem, SettingsError> {
        let written = self.yaml.find(problem, "obstacles")?;
        let solids = if written.is_some() { &["obstacles"][..] } else { &KINDS };
        let read = [&GOALS[..], solids, &["start", "valid", "robot", "joints"]].concat();
        for (key, node) in self.yaml.table(problem)? {
            self.unread(key, node, &read, true)?;
        }
        let obstacles =
            written.map_or_else(|| self.vamp(problem), |obstacles| self.robometrics(obstacles))?;
        let start = self.ended(self.yaml.get(problem, "start")?, "start", order)?;
        let valid = self.yaml.find(problem, "valid")?;
        let is_valid = valid.map_or(Ok(true), |valid| self.yaml.truth(valid, "valid"))?;
        let goals = self.goals(problem, order)?;
        Ok(Problem { is_valid, ..Problem::new(obstacles, start, goals) })
    }

    fn goals(self, problem: &Node, order: Option<&[usize]>) -> Result<Vec<Ended>, SettingsError> {
        let given: Vec<&str> =
            GOALS.into_iter().filter(|key| problem.keys().any(|known| known == *key)).collect();
        let [key] = given[..] else {
            let known = problem.keys().collect::<Vec<_>>().join("`, `");
            let message = match given[..] {
                [first, second, ..] => {
                    format!("a problem has both `{first}` and `{second}`; one of them is accepted")
                }
                _ => format!("a problem needs a goal in joints: `goals` or `goal_ik`; found are `{known}`"),
            };
            return Err(self.fault(problem, message));
        };
        let goals = self.yaml.get(problem, key)?;
        let listed = self.yaml.list(goals)?;
        if listed.is_empty() {
            return Err(self.fault(problem, "the list of goals is empty; at least one is accepted"));
        }
        if listed.iter().all(Node::is_list) {
            return listed.iter().map(|goal| self.ended(goal, key, order)).collect();
        }
        Ok(vec![self.ended(goals, key, order)?])
    }

    fn ended(self, node: &Node, key: &str, order: Option<&[usize]>) -> Result<Ended, SettingsError> {
        let written = self.yaml.numbers(node, key)?;
        if let Some(accepted) = order.map(<[usize]>::len).filter(|count| *count != written.len()) {
            let found = written.len();
            let message =
                format!("{key} has {found} numbers; {accepted}, as the robot has joints, are accepted");
            return Err(self.fault(node, message));
        }
        for (number, at) in written.iter().zip(self.yaml.list(node)?) {
            self.yaml.0.radians(&at.at, key, [*number])?;
        }
        let ordered = order.map(|order| order.iter().map(|place| written[*place]).collect());
        Ok(Ended { joints: ordered.unwrap_or(written), at: node.at.clone() })
    }

    fn robometrics(self, obstacles: &Node) -> Result<Vec<Solid>, SettingsError> {
        let mut solids = Vec::new();
        for (kind, named) in self.yaml.table(obstacles)? {
            for (name, entry) in self.yaml.table(named)? {
                let (form, sizes) = match kind.as_str() {
                    "cuboid" => (self.cuboid(entry, "dims", 0.5)?, &["dims"][..]),
                    "cylinder" => self.cylinder(entry)?,
                    "sphere" => self.sphere(entry)?,
                    other => {
                        let message =
                            format!("an obstacle is a `{other}`; cuboid, cylinder and sphere are accepted");
                        return Err(self.fault(named, message));
                    }
                };
                solids.push(Solid { name: name.clone(), pose: self.placed(entry, sizes)?, form });
            }
        }
        Ok(solids)
    }

    fn vamp(self, problem: &Node) -> Result<Vec<Solid>, SettingsError> {
        let mut solids = Vec::new();
        for kind in KINDS {
            let Some(entries) = self.yaml.find(problem, kind)? else { continue };
            for (index, entry) in self.yaml.list(entries)?.iter().enumerate() {
                let (form, sizes) = match kind {
                    "box" => (self.cuboid(entry, "half_extents", 1.0)?, &["half_extents"][..]),
                    "cylinder" => self.cylinder(entry)?,
                    _ => self.sphere(entry)?,
                };
                let named = self.yaml.find(entry, "name")?;
                let name = named.map_or(Ok(format!("{kind} {}", index + 1)), |name| {
                    self.yaml.word(name).map(str::to_owned)
                })?;
                solids.push(Solid { name, pose: self.placed(entry, sizes)?, form });
            }
        }
        Ok(solids)
    }

    fn size(self, entry: &Node, key: &str) -> Result<f64, SettingsError> {
        let node = self.yaml.get(entry, key)?;
        Ok(self.yaml.0.sizes(&node.at, key, [self.yaml.number(node, key)?])?[0])
    }

    fn cuboid(self, entry: &Node, key: &str, half: f64) -> Result<Form, SettingsError> {
        let node = self.yaml.get(entry, key)?;
        let sides = self.yaml.0.sizes(&node.at, key, self.yaml.exactly::<3>(node, key)?)?;
        Ok(Form::Box(sides.map(|side| half * side)))
    }

    fn cylinder(self, entry: &Node) -> Result<(Form, &'static [&'static str]), SettingsError> {
        let has_length = entry.keys().any(|key| key == "length");
        let (length, read) =
            if has_length { ("length", &["radius", "length"]) } else { ("height", &["radius", "height"]) };
        Ok((Form::Cylinder(self.size(entry, "radius")?, self.size(entry, length)?), read))
    }

    fn sphere(self, entry: &Node) -> Result<(Form, &'static [&'static str]), SettingsError> {
        Ok((Form::Sphere(self.size(entry, "radius")?), &["radius"]))
    }

    /// The pose of an obstacle: `pose`, or `position` with an orientation or without one. Beside them and its `sizes` it has a name at
    /// most.
    fn placed(self, entry: &Node, sizes: &[&str]) -> Result<Pose, SettingsError> {
        const EULER: &str = "orientation_euler_xyz";
        const QUATERNION: &str = "orientation_quat_xyzw";
        let yaml = self.yaml;
        let source = self.yaml.0;
        if let Some(pose) = yaml.find(entry, "pose")? {
            yaml.only(entry, &[sizes, &["name", "pose"]].concat())?;
            return Ok(self.unit(source.pose(&pose.at, "pose", yaml.exactly::<7>(pose, "pose")?)?));
        }
        let position = yaml.get(entry, "position")?;
        yaml.only(entry, &[sizes, &["name", "position", EULER, QUATERNION]].concat())?;
        let origin = source.metres(&position.at, "position", yaml.exactly::<3>(position, "position")?)?;
        let turned = yaml.find(entry, EULER)?.map(|turned| yaml.exactly::<3>(turned, EULER)).transpose()?;
        let rpy = yaml.0.radians(&position.at, EULER, turned.unwrap_or_default())?;
        let by_angles = Pose::from_rpy(origin, rpy);
        let Some(quaternion) = yaml.find(entry, QUATERNION)? else { return Ok(by_angles) };
        let ([x, y, z, w], [a, b, c]) = (yaml.exactly::<4>(quaternion, QUATERNION)?, origin);
        let (pose, was_rounded) = source.pose(&quaternion.at, QUATERNION, [a, b, c, w, x, y, z])?;
        if turned.is_none() {
            return Ok(self.unit((pose, was_rounded)));
        }
        let [one, other] = [&pose, &by_angles].map(|pose| pose.rotation.concat());
        if one.iter().zip(other).all(|(a, b)| (a - b).abs() <= SAME) {
            self.ignore(QUATERNION);
            return Ok(by_angles);
        }
        let message =
            format!("{QUATERNION} (x, y, z, w) is another rotation than {EULER}; one rotation is accepted");
        Err(self.fault(quaternion, message))
    }

    /// The pose, which is noted if its quaternion was not of length 1.
    pub(super) fn unit(self, (pose, was_rounded): (Pose, bool)) -> Pose {
        if was_rounded {
            self.note("quaternions of few digits were made those of length 1".to_owned());
        }
        pose
    }
}

/// Whether a word of the key is about the robot, what stands around it, or the query.
fn may_change_the_problem(key: &str) -> bool {
    let lower = key.to_lowercase();
    lower.split(|c: char| !c.is_alphabetic()).any(|word| {
        let one = word.strip_suffix("es").filter(|one| MEANT.contains(one)).or(word.strip_suffix('s'));
        MEANT.contains(&word) || one.is_some_and(|one| MEANT.contains(&one))
    })
}
