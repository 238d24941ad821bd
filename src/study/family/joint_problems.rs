//! A set of problems for a robot of any number of axes, one an instance, in joint space and without a roadmap.
//!
//! A problem whose file is wrong, that its set calls invalid, or at whose start or goal the robot cannot be is a row with status
//! `invalid_problem`: sets hold such problems, and papers count them.

use super::input::input;
use super::joint_queries::{contact, picture, queries, renamed, robot_notes, support, under};
use super::{Entry, Family, Query};
use crate::preprocessing::Preprocessing;
use crate::preprocessing::nested_roadmap;
use crate::{Inputs, StudyError};
use base::ignored::ignored_note;
use base::problem::{Expected, Problem, ProblemSet};
use base::robot::{Robot, read_urdf};
use base::settings::{Accepted, Faults, Settings, SettingsError};
use base::solid::{Form, Pose, Solid};
use base::units::setting_in_radians;
use engine::planner::{Counts, Invalid, Value};
use engine::space::roadmap::{Counted, Local, Near};
use engine::space::{JointSpace, SelfContact, Support, SupportEntry, WorldKind};
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "joint_problems",
    about: "a set of problems (MotionBenchMaker's archive, or a problem file) for a robot (URDF), one an instance, for planners that sample",
    instances: "problems",
    revision: 2,
    is_drawn: true,
    preprocessing: nested_roadmap::ENTRY.name,
    columns: COLUMNS,
    settings: Accepted::shape::<JointProblems>(),
    example: r#"
robot = "data/robots/panda.urdf"
problems = "data/scenes/shelf_panda.json"
set = "shelf"
support = { under = "floor", base_mm = [0, 0, 0], yaw_deg = 0 }
self_contact = "neighbours"
step_deg = 3
"#,
    build: |settings, inputs| Ok::<Box<dyn Family>, StudyError>(build(settings, inputs)?),
};

/// The columns of every trial: those of all joint spaces, and how many problems of the set are valid.
const COLUMNS: &[&str] = &[
    "path_length_mm",
    "local_paths",
    "joint_travel_deg",
    "joint_length_rad",
    "valid_problems",
    "set_problems",
];

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct JointProblems {
    /// The robot, a URDF file.
    robot: String,
    /// What the problems call the robot, where its URDF file has another name for the same one.
    #[schemars(length(min = 1))]
    robot_name: Option<String>,
    /// The set: an archive (`.tar`) of `MoveIt` scenes and requests, or a problem file in YAML or JSON.
    problems: String,
    /// The problem set in it: of an archive, the folders whose names begin so, all if absent; of a file, the only one if absent.
    set: Option<String>,
    /// What is under the robot: the problems place everything from the robot's base and say nothing of a floor.
    support: SupportEntry,
    /// Which links of the robot may touch each other.
    self_contact: SelfContactSetting,
    /// The file that says it, an SRDF file; read under `srdf` alone.
    srdf: Option<String>,
    /// How far a joint may move between two configurations that are checked; a metre of a joint that slides counts as a radian.
    #[schemars(range(min = 0.1, max = 180.0))]
    step_deg: f64,
    /// What stands for cylinders of the problems; prisms if absent.
    cylinders: Option<CylinderSetting>,
    /// How the names of those folders of an archive begin in which boxes stand for cylinders; none if absent. Read only with
    /// `capsules`.
    #[schemars(length(min = 1))]
    boxes_in: Option<String>,
    /// How far the robot must be from every obstacle, besides not touching it; nothing if absent.
    #[schemars(range(min = 0.0, max = 1000.0))]
    clearance_mm: Option<f64>,
    /// How to fetch files that are not in the repository, and how to check them.
    archive: Option<Archive>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
enum SelfContactSetting {
    /// All may.
    All,
    /// Those that a joint joins.
    Neighbours,
    /// Those that the SRDF file says.
    Srdf,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
enum CylinderSetting {
    /// Prisms of 24 sides around them.
    Prisms,
    /// The same with a ball about the middle of each end.
    Capsules,
}

/// Files that a command brings: while they are missing, stored trials stay readable and no new ones run.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Archive {
    /// The command.
    install: String,
    /// The file that says what they hold: a line each, SHA-256 and name, as `sha256sum` writes them.
    sums: String,
}

struct Set {
    robot: Robot,
    /// What the problems call it, if that is another name.
    robot_name: Option<String>,
    problems: ProblemSet,
    /// The name of its file.
    problem_file: String,
    contact: SelfContact,
    support: Support,
    step_rad: f64,
    clearance_m: f64,
    cylinders: CylinderSetting,
    boxes_in: Option<String>,
    queries: [Query; 1],
    notes: Vec<String>,
    inputs: Vec<PathBuf>,
    /// How many problems are valid, once it was counted.
    valid: OnceLock<u64>,
}

/// A set whose files are not there.
struct Absent {
    lacks: String,
    queries: [Query; 1],
    inputs: [PathBuf; 1],
}

/// The one query of a problem: its name is empty, its ends are the instance's.
fn unposed() -> [Query; 1] {
    [Query { name: String::new(), start: Vec::new(), goal: Vec::new() }]
}

/// The query of a problem, without a name: where it has several goals, the first is planned for.
fn query(problem: &Problem) -> Vec<Query> {
    let first = queries(problem).into_iter().next();
    first.map(|query| Query { name: String::new(), ..query }).into_iter().collect()
}

fn build(settings: &Settings, inputs: &Inputs) -> Result<Box<dyn Family>, SettingsError> {
    let read: JointProblems = settings.read()?;
    settings.accept_without("step_deg", setting_in_radians("step_deg", read.step_deg, 0.0))?;
    let support = support(settings, &read.support)?;
    let sums = match &read.archive {
        None => None,
        Some(archive) => match read.pinned(settings, inputs, archive)? {
            Pinned::Lacks(lacks, inputs) => {
                return Ok(Box::new(Absent { lacks, queries: unposed(), inputs }));
            }
            Pinned::As(sums) => Some(sums),
        },
    };
    let mut faults = Faults::default();
    let robot = faults.keep(input(settings, inputs, "robot", &read.robot, read_urdf));
    let open = |path: &Path| ProblemSet::open(path, read.set.as_deref());
    let problems = faults.keep(input(settings, inputs, "problems", &read.problems, open));
    let srdf = read.srdf.as_deref().filter(|_| read.self_contact == SelfContactSetting::Srdf);
    if srdf.is_none() && read.self_contact == SelfContactSetting::Srdf {
        return Err(
            settings.error_at("self_contact", "an SRDF file decides, and none is given; `srdf` is accepted")
        );
    }
    let rule = (read.self_contact != SelfContactSetting::All, srdf);
    let contact = robot.as_ref().and_then(|(_, robot)| faults.keep(contact(settings, inputs, robot, rule)));
    let ((robot_file, robot), (problem_file, problems), (srdf_file, contact)) =
        faults.or(robot.zip(problems).zip(contact).map(|((a, b), c)| (a, b, c)))?;
    let files = [robot_file, problem_file].into_iter().chain(srdf_file);
    // What the sums pin is known by them, whether it is there or not.
    let inputs = sums.map_or_else(|| files.chain(robot.files.iter().cloned()).collect(), |sums| vec![sums]);
    let notes = robot_notes(&read.robot, &robot, &contact, srdf);
    Ok(Box::new(Set {
        robot,
        robot_name: read.robot_name,
        problems,
        problem_file: read.problems,
        contact,
        support,
        step_rad: read.step_deg.to_radians(),
        // Absent it is no unknown: the problem needs no clearance.
        clearance_m: read.clearance_mm.unwrap_or(0.0) * 1e-3,
        cylinders: read.cylinders.unwrap_or(CylinderSetting::Prisms),
        boxes_in: read.boxes_in,
        queries: unposed(),
        notes,
        inputs,
        valid: OnceLock::new(),
    }))
}

/// What became of files that sums pin.
enum Pinned {
    /// One is missing: which and what helps, then the file of sums.
    Lacks(String, [PathBuf; 1]),
    /// All are as the file of sums says.
    As(PathBuf),
}

impl JointProblems {
    /// Holds the files against their sums.
    fn pinned(
        &self,
        settings: &Settings,
        inputs: &Inputs,
        archive: &Archive,
    ) -> Result<Pinned, SettingsError> {
        let unreadable = |path: &Path, error: std::io::Error| SettingsError::Unreadable {
            path: path.to_owned(),
            reason: error.to_string(),
        };
        let (sums, text) = input(settings, inputs, "archive.sums", &archive.sums, |path| {
            base::file::read_text(path).map_err(|error| unreadable(path, error))
        })?;
        let named =
            [("robot", Some(&self.robot)), ("problems", Some(&self.problems)), ("srdf", self.srdf.as_ref())];
        for (key, name) in named.into_iter().filter_map(|(key, name)| Some((key, name?))) {
            let line = text.lines().find_map(|line| line.split_once("  ").filter(|(_, file)| file == name));
            let Some((sum, _)) = line else {
                let message =
                    format!("`{}` has no sum for `{name}`; a file with one is accepted", archive.sums);
                return Err(settings.error_at(key, message));
            };
            let Ok(path) = inputs.locate(name) else {
                let lacks = format!("there is no file `{name}`; to install: {}", archive.install);
                return Ok(Pinned::Lacks(lacks, [sums]));
            };
            let bytes = base::file::read(&path).map_err(|error| unreadable(&path, error))?;
            if base::hash::sha256(&bytes) != *sum {
                let message =
                    format!("`{name}` is not what its sum says; to install it again: {}", archive.install);
                return Err(settings.error_at(key, message));
            }
        }
        Ok(Pinned::As(sums))
    }
}

/// What stands for a solid where cylinders are capsules, or boxes.
fn closed(solid: Solid, as_boxes: bool) -> Vec<Solid> {
    let Form::Cylinder(radius_m, length_m) = solid.form else { return vec![solid] };
    if as_boxes {
        return vec![Solid { form: Form::Box([radius_m, radius_m, 0.5 * length_m]), ..solid }];
    }
    let ball = |end: f64| {
        let origin_m = solid.pose.point([0.0, 0.0, 0.5 * end * length_m]);
        Solid {
            name: solid.name.clone(),
            pose: Pose { origin_m, ..solid.pose },
            form: Form::Sphere(radius_m),
        }
    };
    let [bottom, top] = [-1.0, 1.0].map(ball);
    vec![solid, bottom, top]
}

impl Set {
    fn problem(&self, seed: u64) -> Result<Problem, Invalid> {
        let expected = Expected {
            robot: self.robot_name.as_ref().unwrap_or(&self.robot.name),
            base: &self.robot.base,
            joints: self.robot.joints.iter().map(|joint| joint.name.as_str()).collect(),
        };
        let index = usize::try_from(seed).unwrap_or(usize::MAX);
        let problem = self.problems.problem(index, &expected).map_err(|error| Invalid(error.to_string()))?;
        if self.cylinders == CylinderSetting::Prisms {
            return Ok(problem);
        }
        let folder = self.problems.folder(index).unwrap_or_default();
        let as_boxes = self.boxes_in.as_ref().is_some_and(|begin| folder.starts_with(begin));
        let obstacles = problem.obstacles.into_iter().flat_map(|solid| closed(solid, as_boxes)).collect();
        Ok(Problem { obstacles, ..problem })
    }

    /// The robot among the obstacles of a problem.
    fn space(&self, problem: &Problem) -> JointSpace {
        let obstacles = under(&self.support).into_iter().chain(problem.obstacles.iter().cloned()).collect();
        let robot = self.robot.clone();
        JointSpace::with_clearance(robot, obstacles, &self.contact, self.step_rad, self.clearance_m)
    }

    /// Why the robot cannot be at the start or goal that is planned for, at its place.
    fn refusal(&self, index: usize, problem: &Problem) -> Option<String> {
        let space = self.space(problem);
        let ends = [("start", Some(&problem.start)), ("goal", problem.goals.first())];
        ends.into_iter().find_map(|(what, end)| {
            let end = end?;
            let message = format!("the {what} cannot be posed: {}", space.refusal(&end.joints)?);
            Some(self.problems.fault(index, end.at.clone(), message).to_string())
        })
    }

    /// How many problems are valid: the robot can be at the start and at one goal at least.
    fn valid(&self) -> u64 {
        let is_valid = |problem: &Problem| {
            let space = self.space(problem);
            problem.is_valid
                && space.is_free(&problem.start.joints)
                && problem.goals.iter().any(|goal| space.is_free(&goal.joints))
        };
        let problems = (0..self.problems.count() as u64).filter_map(|index| self.problem(index).ok());
        *self.valid.get_or_init(|| problems.filter(is_valid).count() as u64)
    }
}

impl Family for Set {
    fn world(&self) -> WorldKind {
        WorldKind::Roadmap
    }

    fn numbers_instances(&self) -> bool {
        true
    }

    fn prepare(&self, seed: u64) -> Result<Preprocessing, Invalid> {
        let problem = self.problem(seed)?;
        if !problem.is_valid {
            return Err(Invalid("the problem set calls this problem invalid".to_owned()));
        }
        let space = self.space(&problem);
        let traces = picture::traces(&space, self.support.floor_m(), &query(&problem));
        let local = Local::Joints(Box::new(space));
        let near = Near::Places(0.0);
        let preprocessing = nested_roadmap::prepare(local, Vec::new(), 0, near, Counted::Accepted);
        Ok(Preprocessing { traces, ..preprocessing })
    }

    fn queries(&self) -> &[Query] {
        &self.queries
    }

    fn queries_for(&self, seed: u64) -> Vec<Query> {
        let posed = self.problem(seed).map(|problem| query(&problem));
        posed.ok().filter(|queries| !queries.is_empty()).unwrap_or_else(|| self.queries.to_vec())
    }

    fn draws_ends(&self) -> bool {
        true
    }

    fn known(&self, _query: usize) -> Counts {
        let total = self.problems.count() as u64;
        Counts::from([("valid_problems", Value::Count(self.valid())), ("set_problems", Value::Count(total))])
    }

    fn cells(&self) -> u64 {
        let obstacles = self
            .problem(0)
            .map_or(0, |problem| under(&self.support).into_iter().chain(problem.obstacles).count());
        (self.robot.solids.len() + obstacles) as u64
    }

    fn notes(&self) -> Vec<String> {
        let mut notes = BTreeSet::new();
        let mut ignored = BTreeSet::new();
        let mut refused = Vec::new();
        let count = self.problems.count();
        let mut called_invalid = 0;
        let mut named = None;
        let mut is_read = true;
        for index in 0..count {
            match self.problem(index as u64) {
                Ok(problem) => {
                    called_invalid += u64::from(!problem.is_valid);
                    refused.extend(self.refusal(index, &problem).filter(|_| problem.is_valid));
                    named = named.or(problem.robot);
                    notes.extend(problem.notes);
                    ignored.extend(problem.ignored);
                }
                Err(Invalid(message)) => {
                    is_read = false;
                    refused.push(message);
                }
            }
        }
        let refused = refused.first().map(|first| {
            let first = first.lines().next().unwrap_or_default();
            format!(
                "refused problems, which count as invalid: {} of {count}; the first: {first}",
                refused.len()
            )
        });
        let called_invalid = (called_invalid > 0)
            .then(|| format!("problems that the set calls invalid: {called_invalid} of {count}"));
        // Refused problems may call the robot anything.
        let is_known = self.robot_name.is_some() && (named.is_some() || is_read);
        let renamed = is_known.then(|| renamed(&self.robot, named.as_deref()));
        let of_problems = notes
            .into_iter()
            .chain(ignored_note(&ignored))
            .chain(renamed)
            .chain(called_invalid)
            .chain(refused);
        let of_problems = of_problems.map(|note| format!("{}: {note}", self.problem_file));
        self.notes.iter().cloned().chain(of_problems).collect()
    }

    fn inputs(&self) -> &[PathBuf] {
        &self.inputs
    }
}

impl Family for Absent {
    fn world(&self) -> WorldKind {
        WorldKind::Roadmap
    }

    fn lacks(&self) -> Option<String> {
        Some(self.lacks.clone())
    }

    fn numbers_instances(&self) -> bool {
        true
    }

    fn prepare(&self, _seed: u64) -> Result<Preprocessing, Invalid> {
        Err(Invalid(self.lacks.clone()))
    }

    fn queries(&self) -> &[Query] {
        &self.queries
    }

    fn draws_ends(&self) -> bool {
        true
    }

    fn cells(&self) -> u64 {
        0
    }

    fn notes(&self) -> Vec<String> {
        vec![self.lacks.clone()]
    }

    fn inputs(&self) -> &[PathBuf] {
        &self.inputs
    }
}

#[cfg(test)]
mod tests;
