//! Files of planning problems as benchmarks share them: solids around a robot, a start, and goals, all in metres and radians.
//!
//! Two forms are read, in YAML or JSON.
//!
//! Robometrics: problem sets by name, each a list of problems with `obstacles`, `start` and `goal_ik`. Obstacles are `cuboid` with
//! `dims` and `pose`, `cylinder` with `radius`, `height` and `pose`, `sphere` with `radius` and `position` or `pose`. A pose is
//! x, y, z and the quaternion w, x, y, z.
//!
//! VAMP's `MotionBenchMaker` problems: the sets stand under `problems`, beside the name of the `robot` and those of its `joints`.
//! A problem has `box` (`position`, `orientation_euler_xyz` about fixed axes, `half_extents`), `cylinder` and `sphere` lists,
//! `start`, `goals` and whether it is `valid`.
//!
//! `robot` and `joints` may stand beside the sets or in a problem. A key that is neither read nor in the table of ignored keys is refused if
//! it is nearly one that is read or its words are those of geometry, units, limits or the query. Others are noted.
//!
//! `MoveIt`'s scenes and requests are read in pairs ([`parse_moveit`]), a whole set at once by [`ProblemSet`].
//!
//! Source: `resources/problem_tar_to_pkl_json.py` of `KavrakiLab/vamp`, which writes the second form and skips what is not valid.

mod moveit;
mod reader;
mod set;

pub use moveit::parse_moveit;
pub use set::ProblemSet;

use crate::settings::{Document, SettingsError};
use crate::solid::{Solid, Source};
use crate::text::brief;
use crate::yaml::{Node, Yaml};
use reader::Reader;
use std::cell::RefCell;
use std::collections::BTreeSet;
use std::ops::Range;
use std::sync::Arc;

/// One problem.
#[derive(Debug, Clone, PartialEq)]
pub struct Problem {
    /// What stands around the robot.
    pub obstacles: Vec<Solid>,
    /// The start, a number a joint.
    pub start: Ended,
    /// The goals, at least one.
    pub goals: Vec<Ended>,
    /// What it or its file calls the robot.
    pub robot: Option<String>,
    /// Whether the set calls it valid; what says nothing of it is.
    pub is_valid: bool,
    /// What a reader of results should know of how it was taken, a sentence each.
    pub notes: Vec<String>,
    /// The keys of its file that are ignored.
    pub ignored: BTreeSet<String>,
}

impl Problem {
    /// One with nothing to note.
    fn new(obstacles: Vec<Solid>, start: Ended, goals: Vec<Ended>) -> Self {
        Self {
            obstacles,
            start,
            goals,
            robot: None,
            is_valid: true,
            notes: Vec::new(),
            ignored: BTreeSet::new(),
        }
    }
}

/// An end of a problem, and where it stands in the file.
#[derive(Debug, Clone, PartialEq)]
pub struct Ended {
    /// Radians, or metres for a joint that slides.
    pub joints: Vec<f64>,
    /// Its bytes in the file.
    pub at: Range<usize>,
}

/// Whom a problem is for.
#[derive(Debug, Clone)]
pub struct Expected<'a> {
    /// The robot's name.
    pub robot: &'a str,
    /// The name of its base link.
    pub base: &'a str,
    /// The names of its joints, base first.
    pub joints: Vec<&'a str>,
}

/// A problem file, parsed once.
#[derive(Debug)]
pub struct ProblemFile {
    document: Arc<Document>,
    root: Node,
}

impl ProblemFile {
    /// The file that `document` is.
    ///
    /// # Errors
    /// A syntax error; half a problem of `MoveIt`.
    pub fn parse(document: Arc<Document>) -> Result<Self, SettingsError> {
        let root = Yaml::parse(&document)?;
        let seen = RefCell::default();
        refuse_moveit(Reader { yaml: Yaml(Source(&document)), base: None, seen: &seen }, &root)?;
        Ok(Self { document, root })
    }

    /// How many problems the set called `set` has, or the only one.
    ///
    /// # Errors
    /// There is no such set, or there are several and none is named.
    pub fn count(&self, set: Option<&str>) -> Result<usize, SettingsError> {
        let seen = RefCell::default();
        let reader = Reader { yaml: Yaml(Source(&self.document)), base: None, seen: &seen };
        Ok(reader.yaml.list(self.chosen(reader, set)?)?.len())
    }

    fn chosen(&self, reader: Reader<'_>, set: Option<&str>) -> Result<&Node, SettingsError> {
        let under = reader.yaml.find(&self.root, "problems")?;
        let sets = under.unwrap_or(&self.root);
        if let Some(name) = set {
            return reader.yaml.get(sets, name);
        }
        let all = reader.yaml.table(sets)?.iter();
        let named: Vec<_> = all.filter(|(_, node)| under.is_some() || node.may_be_set()).collect();
        match named[..] {
            [(_, only)] => Ok(only),
            [] => Err(reader.fault(sets, "the file has no set of problems; a list of tables is accepted")),
            _ => {
                let known: Vec<&str> = named.iter().map(|(name, _)| name.as_str()).collect();
                let message =
                    format!("the file holds the sets `{}`; the name of one is accepted", known.join("`, `"));
                Err(reader.fault(sets, message))
            }
        }
    }

    /// `message` about the bytes `at` of the file.
    pub(super) fn fault(&self, at: Range<usize>, message: String) -> SettingsError {
        self.document.error(at, message)
    }

    /// The problem number `index`, from 0, of the set called `set`; of the only set, if none is named. Starts and goals are in
    /// the order of the robot's joints; without a robot nothing is checked of them.
    ///
    /// # Errors
    /// The first fault at its place: no such set or problem, another robot or other joints, a value that is missing or of the wrong
    /// kind. A quaternion whose length is not 1, or lengths that are not metres, are faults too.
    pub fn problem(
        &self,
        set: Option<&str>,
        index: usize,
        expected: Option<&Expected<'_>>,
    ) -> Result<Problem, SettingsError> {
        let Self { document, root } = self;
        let seen = RefCell::default();
        let base = expected.map(|expected| expected.base);
        let reader = Reader { yaml: Yaml(Source(document)), base, seen: &seen };
        let is_beside = reader.yaml.find(root, "problems")?.is_some();
        for (key, node) in reader.yaml.table(root)? {
            if is_beside || !node.may_be_set() {
                reader.unread(key, node, &["problems", "robot", "joints"], false)?;
            }
        }
        let chosen = self.chosen(reader, set)?;
        let problems = reader.yaml.list(chosen)?;
        let Some(problem) = problems.get(index) else {
            let message =
                format!("problem {index} is requested; the set has {}, counted from 0", problems.len());
            return Err(reader.fault(chosen, message));
        };
        let mut order = expected.map(|expected| (0..expected.joints.len()).collect());
        // What a problem itself names comes after what its file names.
        for named in [root, problem] {
            let Some(expected) = expected else { break };
            check_robot(reader, named, "robot", expected.robot)?;
            order = named_order(reader, named, expected)?.or(order);
        }
        let problem = reader.problem(problem, order.as_deref())?;
        Ok(seen.into_inner().noted(problem))
    }
}

/// Scenes and requests of `MoveIt` hold half a problem each.
fn refuse_moveit(reader: Reader<'_>, root: &Node) -> Result<(), SettingsError> {
    let has = |key: &str| root.keys().any(|known| known == key);
    let world = reader.yaml.find(root, "world")?;
    let has_objects = world.is_some_and(|world| world.keys().any(|key| key == "collision_objects"));
    let found = match () {
        () if has_objects || has("world") && (has("robot_model_name") || has("robot_state")) => "scene",
        () if has("goal_constraints") || has("start_state") => "request",
        () => return Ok(()),
    };
    let message = format!(
        "this is a MoveIt {found}; problems in the form of VAMP's `problems.json` or of robometrics are accepted (an \
         archive of scenes and requests is read by the family `joint_problems`)"
    );
    Err(reader.fault(root, message))
}

/// Refuses problems for another robot. Names that differ in case, `_` and `-` alone are one.
fn check_robot(reader: Reader<'_>, root: &Node, key: &str, robot: &str) -> Result<(), SettingsError> {
    let Some(node) = reader.yaml.find(root, key)? else { return Ok(()) };
    let plain = |name: &str| name.replace(['_', '-'], "").to_lowercase();
    let found = reader.yaml.word(node)?;
    if plain(robot) == plain(found) {
        reader.seen.borrow_mut().robot = Some(found.to_owned());
        return Ok(());
    }
    let found = brief(found);
    let message = format!(
        "the problems are for the robot `{found}`; `{robot}` is accepted (a study says by `robot_name` what problems call its robot)"
    );
    Err(reader.fault(node, message))
}

/// For each joint of the robot, where its number stands in a start or goal, if the file names joints.
fn named_order(
    reader: Reader<'_>,
    root: &Node,
    Expected { robot, joints, .. }: &Expected<'_>,
) -> Result<Option<Vec<usize>>, SettingsError> {
    let Some(node) = reader.yaml.find(root, "joints")? else { return Ok(None) };
    let listed = reader.yaml.list(node)?;
    let names = listed.iter().map(|name| reader.yaml.word(name)).collect::<Result<Vec<_>, _>>()?;
    for (index, (name, at)) in names.iter().zip(listed).enumerate() {
        if !joints.contains(name) {
            let message = format!("`{robot}` has no joint `{name}` that moves; it has {}", joints.join(", "));
            return Err(reader.fault(at, message));
        }
        if names[..index].contains(name) {
            return Err(reader.fault(at, format!("joint `{name}` is given twice; once is accepted")));
        }
    }
    let place = |joint: &&str| {
        let missing = || {
            reader.fault(node, format!("joint `{joint}` of `{robot}` is missing; all joints are accepted"))
        };
        names.iter().position(|name| name == joint).ok_or_else(missing)
    };
    joints.iter().map(place).collect::<Result<_, _>>().map(Some)
}

#[cfg(test)]
mod tests;
