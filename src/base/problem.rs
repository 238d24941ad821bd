//! Files of planning problems as benchmarks share them: solids around a robot, a start, and goals, all in metres and radians.
//!
//! Two forms are read, in YAML or JSON. Robometrics: problem sets by name, each a list of problems with `obstacles` (`cuboid` with
//! `dims` and `pose`, `cylinder` with `radius`, `height` and `pose`, `sphere` with `radius` and `position` or `pose`), `start` and
//! `goal_ik`; a pose is x, y, z and the quaternion w, x, y, z. VAMP's `MotionBenchMaker` problems: the sets stand under `problems`, a
//! problem has `box` (`position`, `orientation_euler_xyz` about fixed axes, `half_extents`), `cylinder` and `sphere` lists, `start` and
//! `goals`. What is passed over: goal poses, since inverse kinematics is not asked for here, and names of frames.

use crate::settings::{Document, SettingsError};
use crate::solid::{Form, Pose, Solid, Source};
use crate::yaml::{Node, Yaml};
use std::ops::Range;
use std::path::Path;

/// One problem.
#[derive(Debug, Clone, PartialEq)]
pub struct Problem {
    /// What stands around the robot.
    pub obstacles: Vec<Solid>,
    /// The start, an angle a joint.
    pub start: Ended,
    /// The goals, at least one.
    pub goals: Vec<Ended>,
}

/// An end of a problem, and where it stands in the file.
#[derive(Debug, Clone, PartialEq)]
pub struct Ended {
    /// The angles.
    pub angles_rad: Vec<f64>,
    /// Its bytes in the file.
    pub at: Range<usize>,
}

/// The problem number `index`, from 0, of the set called `set` in the file at `path`; of the only set, if none is named.
///
/// # Errors
/// The first fault at its place: no such set or problem, a value that is missing or of the wrong kind, a quaternion whose length is
/// not 1, lengths that are not metres.
pub fn read_problem(path: &Path, set: Option<&str>, index: usize) -> Result<Problem, SettingsError> {
    parse_problem(Document::open(path)?.as_ref(), set, index)
}

/// The same from a document.
///
/// # Errors
/// As [`read_problem`].
pub fn parse_problem(document: &Document, set: Option<&str>, index: usize) -> Result<Problem, SettingsError> {
    let root = Yaml::parse(document)?;
    let reader = Reader(Yaml(Source(document)));
    let sets = reader.0.find(&root, "problems")?.unwrap_or(&root);
    let chosen = match (set, reader.0.table(sets)?) {
        (Some(name), _) => reader.0.get(sets, name)?,
        (None, [(_, only)]) => only,
        (None, several) => {
            let known: Vec<&str> = several.iter().map(|(name, _)| name.as_str()).collect();
            let message =
                format!("the file holds the sets `{}`; the name of one is accepted", known.join("`, `"));
            return Err(reader.fault(sets, message));
        }
    };
    let problems = reader.0.list(chosen)?;
    let Some(problem) = problems.get(index) else {
        let message = format!("problem {index} is asked for; the set has {}, counted from 0", problems.len());
        return Err(reader.fault(chosen, message));
    };
    reader.problem(problem)
}

/// The kinds of obstacle of VAMP's form, each a list in its problem.
const KINDS: [&str; 3] = ["box", "cylinder", "sphere"];

#[derive(Clone, Copy)]
struct Reader<'a>(Yaml<'a>);

impl Reader<'_> {
    fn fault(self, at: &Node, message: impl Into<String>) -> SettingsError {
        self.0.0.fault(&at.at, message)
    }

    fn problem(self, problem: &Node) -> Result<Problem, SettingsError> {
        let obstacles = match self.0.find(problem, "obstacles")? {
            Some(obstacles) => self.robometrics(obstacles)?,
            None => self.vamp(problem)?,
        };
        let start = self.ended(self.0.get(problem, "start")?, "start")?;
        let given = ["goals", "goal_ik", "goal"];
        let found = given.iter().find(|key| problem.keys().any(|known| known == **key));
        let Some(key) = found else {
            let known = problem.keys().collect::<Vec<_>>().join("`, `");
            let message =
                format!("a problem needs a goal in joints: `goals` or `goal_ik`; found are `{known}`");
            return Err(self.fault(problem, message));
        };
        let goals = self.0.get(problem, key)?;
        let several = self.0.list(goals)?.iter().all(Node::is_list);
        let goals: Vec<Ended> = if several {
            self.0.list(goals)?.iter().map(|goal| self.ended(goal, key)).collect::<Result<_, _>>()?
        } else {
            vec![self.ended(goals, key)?]
        };
        match goals.iter().find(|goal| goal.angles_rad.len() != start.angles_rad.len()) {
            _ if goals.is_empty() => {
                Err(self.fault(problem, "the list of goals is empty; at least one is accepted"))
            }
            Some(goal) => {
                let (found, accepted) = (goal.angles_rad.len(), start.angles_rad.len());
                let message = format!("a goal has {found} angles; {accepted}, as the start, are accepted");
                Err(self.0.0.fault(&goal.at, message))
            }
            None => Ok(Problem { obstacles, start, goals }),
        }
    }

    fn ended(self, node: &Node, key: &str) -> Result<Ended, SettingsError> {
        let angles_rad = self.0.numbers(node, key)?;
        match angles_rad.iter().find(|angle| angle.abs() > 4.0 * std::f64::consts::PI) {
            None => Ok(Ended { angles_rad, at: node.at.clone() }),
            Some(angle) => Err(self
                .fault(node, format!("{key} has the angle {angle}; is it in degrees? radians are accepted"))),
        }
    }

    fn robometrics(self, obstacles: &Node) -> Result<Vec<Solid>, SettingsError> {
        let mut solids = Vec::new();
        for (kind, named) in self.0.table(obstacles)? {
            for (name, entry) in self.0.table(named)? {
                let (form, pose) = match kind.as_str() {
                    "cuboid" => (self.cuboid(entry, "dims", 0.5)?, self.placed(entry)?),
                    "cylinder" => (self.cylinder(entry)?, self.placed(entry)?),
                    "sphere" => (self.sphere(entry)?, self.placed(entry)?),
                    other => {
                        let message =
                            format!("an obstacle is a `{other}`; cuboid, cylinder and sphere are accepted");
                        return Err(self.fault(named, message));
                    }
                };
                solids.push(Solid { name: name.clone(), pose, form });
            }
        }
        Ok(solids)
    }

    fn vamp(self, problem: &Node) -> Result<Vec<Solid>, SettingsError> {
        for (kind, entries) in self.0.table(problem)? {
            // What is no list of tables says something else of the problem.
            if entries.has_tables() && !KINDS.contains(&kind.as_str()) {
                let message = format!("obstacles are `{kind}`; {} are accepted", KINDS.join(", "));
                return Err(self.fault(entries, message));
            }
        }
        let mut solids = Vec::new();
        for kind in KINDS {
            let Some(entries) = self.0.find(problem, kind)? else { continue };
            for (index, entry) in self.0.list(entries)?.iter().enumerate() {
                let form = match kind {
                    "box" => self.cuboid(entry, "half_extents", 1.0)?,
                    "cylinder" => self.cylinder(entry)?,
                    _ => self.sphere(entry)?,
                };
                let named = self.0.find(entry, "name")?;
                let name = named.map_or(Ok(format!("{kind} {}", index + 1)), |name| {
                    self.0.word(name).map(str::to_owned)
                })?;
                solids.push(Solid { name, pose: self.placed(entry)?, form });
            }
        }
        Ok(solids)
    }

    fn size(self, entry: &Node, key: &str) -> Result<f64, SettingsError> {
        let node = self.0.get(entry, key)?;
        Ok(self.0.0.sizes(&node.at, key, [self.0.number(node, key)?])?[0])
    }

    fn cuboid(self, entry: &Node, key: &str, half: f64) -> Result<Form, SettingsError> {
        let node = self.0.get(entry, key)?;
        let sides = self.0.0.sizes(&node.at, key, self.0.exactly::<3>(node, key)?)?;
        Ok(Form::Box(sides.map(|side| half * side)))
    }

    fn cylinder(self, entry: &Node) -> Result<Form, SettingsError> {
        let length = if entry.keys().any(|key| key == "length") { "length" } else { "height" };
        Ok(Form::Cylinder(self.size(entry, "radius")?, self.size(entry, length)?))
    }

    fn sphere(self, entry: &Node) -> Result<Form, SettingsError> {
        Ok(Form::Sphere(self.size(entry, "radius")?))
    }

    /// The pose of an obstacle: `pose`, or `position` with an orientation or without one.
    fn placed(self, entry: &Node) -> Result<Pose, SettingsError> {
        let source = self.0.0;
        if let Some(pose) = self.0.find(entry, "pose")? {
            return source.pose(&pose.at, "pose", self.0.exactly::<7>(pose, "pose")?);
        }
        let position = self.0.get(entry, "position")?;
        let origin = source.metres(&position.at, "position", self.0.exactly::<3>(position, "position")?)?;
        if let Some(turned) = self.0.find(entry, "orientation_quat_xyzw")? {
            let [x, y, z, w] = self.0.exactly::<4>(turned, "orientation_quat_xyzw")?;
            let [a, b, c] = origin;
            return source.pose(&turned.at, "orientation_quat_xyzw", [a, b, c, w, x, y, z]);
        }
        let turned = self.0.find(entry, "orientation_euler_xyz")?;
        let rpy =
            turned.map_or(Ok([0.0; 3]), |turned| self.0.exactly::<3>(turned, "orientation_euler_xyz"))?;
        Ok(Pose::from_rpy(origin, rpy))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_1_SQRT_2 as H;

    const ROBOMETRICS: &str = "shelf_panda:
- goal_ik:
  - - [0.1, 0.2]
  obstacles: {}
  start: [0, 0]
- collision_buffer_ik: 0
  goal_ik:
  - - 0.5
    - -0.25
  goal_pose: {frame: hand, position_xyz: [0, 0, 1], quaternion_wxyz: [1, 0, 0, 0]}
  obstacles:
    cuboid:
      plank:
        dims: [1.2, 1.0, 0.04]
        pose: [0.5, 0, 0.2, 0.7071067811865476, 0, 0, 0.7071067811865476]
    cylinder:
      can: {height: 0.14, radius: 0.02, pose: [0.1, 0.2, 0.3, 1, 0, 0, 0]}
    sphere:
      ball: {radius: 0.1, position: [0, 1, 0]}
  start: [0.0, 1.5]
  world_frame: base
";

    const VAMP: &str = r#"{"robot": "panda", "problems": {"shelf": [{"index": 1, "start": [0.0, 1.5], "goals": [[0.5, -0.25]],
      "box": [{"name": "plank", "position": [0.5, 0, 0.2], "orientation_euler_xyz": [0, 0, 1.5707963267948966],
               "half_extents": [0.6, 0.5, 0.02]}],
      "cylinder": [{"name": "can", "position": [0.1, 0.2, 0.3], "orientation_euler_xyz": [0, 0, 0], "radius": 0.02, "length": 0.14}],
      "sphere": [{"name": "ball", "position": [0, 1, 0], "radius": 0.1}]}]}}"#;

    fn read(text: &str, set: Option<&str>, index: usize) -> Result<Problem, String> {
        parse_problem(&Document::new(Path::new("p.json"), text.to_owned()), set, index)
            .map_err(|e| e.to_string())
    }

    #[test]
    fn both_forms_of_a_problem_read_the_same() {
        let text = ROBOMETRICS.replace("- - [0.1, 0.2]", "- [0.1, 0.2]");
        let (one, other) = (read(&text, None, 1).unwrap(), read(VAMP, Some("shelf"), 0).unwrap());
        assert_eq!(one.start.angles_rad, other.start.angles_rad);
        assert_eq!(one.goals[0].angles_rad, [0.5, -0.25]);
        assert_eq!(other.goals[0].angles_rad, [0.5, -0.25]);
        for (a, b) in one.obstacles.iter().zip(&other.obstacles) {
            assert_eq!((&a.name, &a.form), (&b.name, &b.form));
            let [at, by] = [&a.pose, &b.pose].map(|pose| pose.point([0.3, 0.2, 0.1]));
            assert!(at.iter().zip(by).all(|(x, y)| (x - y).abs() < 1e-15), "{}: {at:?} {by:?}", a.name);
        }
        assert_eq!(one.obstacles[0].form, Form::Box([0.6, 0.5, 0.02]));
        let turned = one.obstacles[0].pose.point([1.0, 0.0, 0.0]);
        assert!((turned[1] - 2.0 * H * H).abs() < 1e-12, "{turned:?}: x of the plank is y of the world");
    }

    #[test]
    fn obstacles_of_a_kind_that_is_not_known_are_not_passed_over() {
        let error = read(&VAMP.replacen("\"sphere\":", "\"capsule\":", 1), None, 0).unwrap_err();
        let said = "p.json:5:18: obstacles are `capsule`; box, cylinder, sphere are accepted";
        assert!(error.contains(said), "should say {said}\nsays {error}");
        let kept = VAMP.replacen("\"index\": 1", "\"valid\": true, \"tags\": [1, 2]", 1);
        assert_eq!(read(&kept, None, 0).unwrap().obstacles.len(), 3, "what is no obstacle is passed over");
    }

    #[test]
    fn a_quaternion_with_its_real_part_last_turns_as_one_with_its_real_part_first() {
        let last = format!("\"orientation_quat_xyzw\": [0, 0, {H}, {H}]");
        let text = VAMP.replacen("\"orientation_euler_xyz\": [0, 0, 1.5707963267948966]", &last, 1);
        assert_ne!(text, VAMP);
        let [one, other] = [VAMP, &text].map(|text| read(text, None, 0).unwrap().obstacles[0].pose);
        let [at, by] = [one, other].map(|pose| pose.point([0.3, 0.2, 0.1]));
        assert!(at.iter().zip(by).all(|(x, y)| (x - y).abs() < 1e-15), "{at:?} {by:?}");
        let short = read(&text.replacen(&last, "\"orientation_quat_xyzw\": [0, 0, 0.7, 0.8]", 1), None, 0)
            .unwrap_err();
        assert!(
            short.starts_with("p.json:2:") && short.contains("of length 1.0630; length 1 is accepted"),
            "{short}"
        );
    }

    /// A change of the file, and what must be said of it.
    const WRONG: &[(&str, &str, &str)] = &[
        (
            "0.7071067811865476]",
            "0.8]",
            "p.json:15:15: pose has the quaternion [0.7071067811865476, 0.0, 0.0, 0.8] of length 1.0677",
        ),
        (
            "dims: [1.2,",
            "dims: [1200,",
            "p.json:14:15: dims has the length 1200 m; is it in millimetres? lengths in metres",
        ),
        (
            "radius: 0.02",
            "radius: -0.02",
            "p.json:17:35: radius has the size -0.02; sizes above 0 are accepted",
        ),
        (
            "position: [0, 1, 0]",
            "position: [0, .nan, 0]",
            "p.json:19:41: position is `.nan`; a number is accepted",
        ),
        (
            "position: [0, 1, 0]",
            "position: [0, NaN, 0]",
            "p.json:19:41: position has the number NaN; finite numbers",
        ),
        (
            "start: [0.0, 1.5]",
            "start: [0.0, 90]",
            "p.json:20:10: start has the angle 90; is it in degrees? radians",
        ),
        (
            "start: [0.0, 1.5]",
            "start: [0.0]",
            "p.json:8:5: a goal has 2 angles; 1, as the start, are accepted",
        ),
        (
            "goal_ik:\n  - - 0.5\n    - -0.25",
            "goal_is: 0",
            "p.json:6:3: a problem needs a goal in joints: `goals` or `goal_ik`; found",
        ),
        (
            "    sphere:",
            "    mesh:",
            "p.json:19:7: an obstacle is a `mesh`; cuboid, cylinder and sphere are accepted",
        ),
        ("start: [0.0, 1.5]", "start: [0.0, 1.5", "this is neither YAML nor JSON"),
    ];

    #[test]
    fn what_is_wrong_with_a_problem_is_told_at_its_place() {
        for (from, to, said) in WRONG {
            let text = ROBOMETRICS.replace("- - [0.1, 0.2]", "- [0.1, 0.2]");
            assert!(text.contains(*from), "{from}");
            let error = read(&text.replace(*from, to), None, 1).unwrap_err();
            assert!(error.contains(said), "{to}: should say {said}\nsays {error}");
        }
        for (set, index, said) in [
            (Some("shelf"), 0, "p.json:1:1: there is no `shelf`; found are `shelf_panda`"),
            (None, 2, "p.json:2:3: problem 2 is asked for; the set has 2, counted from 0"),
        ] {
            let error = read(ROBOMETRICS, set, index).unwrap_err();
            assert!(error.contains(said), "should say {said}\nsays {error}");
        }
    }
}
