//! A robot of any number of axes among solids, from a start to the goals of a problem file, on roadmaps in joint space.

pub(super) mod picture;

use super::ends::{Ends, SpaceLimits, is_within};
use super::input::{UNUSED_SRDF, input};
use super::{ArmPlacement, Entry, Family, Query};
use crate::preprocessing::Preprocessing;
use crate::preprocessing::nested_roadmap::{self, Neighbours};
use crate::verification::roadmap::JOINT_COLUMNS;
use crate::{Inputs, StudyError};
use base::ignored::ignored_note;
use base::problem::{Ended, Expected, Problem, ProblemFile};
use base::robot::{Robot, read_srdf, read_urdf};
use base::seed::{self, Stream};
use base::settings::{Accepted, Document, Faults, Settings, SettingsError};
use base::solid::{Form, Pose, Solid};
use base::units::setting_in_radians;
use engine::geometry::Frame;
use engine::kinematics::FARTHEST_MM;
use engine::planner::Invalid;
use engine::space::roadmap::{Counted, Extent, Local, Near, Sample};
use engine::space::{JointSpace, SelfContact, Support, SupportEntry, WorldKind};
use rand::RngExt as _;
use schemars::JsonSchema;
use serde::Deserialize;
use std::num::NonZeroU32;
use std::path::PathBuf;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "joint_queries",
    about: "a robot of any number of axes (URDF) among solids (robometrics or MotionBenchMaker), on roadmaps in joint space",
    instances: "roadmaps",
    revision: 3,
    is_drawn: true,
    preprocessing: nested_roadmap::ENTRY.name,
    columns: JOINT_COLUMNS,
    settings: Accepted::shape::<JointQueries>(),
    example: r#"
robot = "data/robots/panda.urdf"
problem = "data/scenes/shelf_panda.json"
support = { under = "floor", base_mm = [0, 0, 0], yaw_deg = 0 }
index = 0
self_collision = true
samples = 300
radius_mm = 600
step_deg = 3
"#,
    build: |settings, inputs| Ok::<Box<dyn Family>, StudyError>(Box::new(Posed::new(settings, inputs)?)),
};

/// Draws per wanted sample after which the space counts as full.
const DRAWS_PER_SAMPLE: u32 = 1000;

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct JointQueries {
    /// The robot, a URDF file.
    robot: String,
    /// What the problems call the robot, where its URDF file has another name for the same one.
    #[schemars(length(min = 1))]
    robot_name: Option<String>,
    /// The problem file, JSON or YAML in the form of robometrics or of `MotionBenchMaker` as VAMP ships it.
    problem: String,
    /// What is under the robot: the problem file places everything from the robot's base and says nothing of a floor.
    support: SupportEntry,
    /// The problem set in it; the only one if absent.
    set: Option<String>,
    /// The problem's number in the set, from 0.
    #[serde(default)]
    index: usize,
    /// Whether the robot must not touch itself; links that a joint joins may, or those that `srdf` says.
    self_collision: bool,
    /// The file that says which links may touch each other, an SRDF file.
    srdf: Option<String>,
    /// How many samples the roadmap is built from, drawn evenly within the joints' limits.
    #[schemars(range(min = 1, max = 100_000))]
    samples: u32,
    /// Samples are tried as neighbours if their tips are at most this far apart. One of this, `radius_deg` and `nearest` is given.
    #[schemars(range(min = 0.001, max = FARTHEST_MM))]
    radius_mm: Option<f64>,
    /// How far two samples may be apart in joint space, by the root of the sum of squares over the joints; a metre of a joint that
    /// slides counts as a radian.
    #[schemars(range(min = 0.001, max = 36_000))]
    radius_deg: Option<f64>,
    /// How many samples, the nearest in joint space, are tried as a sample's neighbours.
    #[schemars(range(min = 1))]
    nearest: Option<u32>,
    /// How far a joint may move between two configurations that are checked; a metre of a joint that slides counts as a radian.
    #[schemars(range(min = 0.1, max = 180.0))]
    step_deg: f64,
    /// How many queries are drawn with each instance, between free configurations, in place of the problem file's.
    #[schemars(range(max = 10_000))]
    queries: Option<NonZeroU32>,
    /// Where the tip is at a start that is drawn, as in `{ x = [0, 500], z = [300, 900] }`; anywhere if absent.
    start_mm: Option<SpaceLimits>,
    /// Where the tip is at a goal that is drawn; anywhere if absent.
    goal_mm: Option<SpaceLimits>,
}

struct Posed {
    read: JointQueries,
    near: Near,
    space: JointSpace,
    /// How high the floor is, if there is one.
    floor_m: Option<f64>,
    queries: Vec<Query>,
    /// Whether the set calls the problem valid.
    is_valid: bool,
    /// How queries are drawn, if they are.
    drawn: Option<Ends>,
    ends: Result<(), SettingsError>,
    notes: Vec<String>,
    inputs: Vec<PathBuf>,
}

impl Posed {
    fn new(settings: &Settings, inputs: &Inputs) -> Result<Self, SettingsError> {
        let read: JointQueries = settings.read()?;
        let JointQueries { radius_mm, radius_deg, nearest, .. } = read;
        let near = Neighbours { radius_mm, radius_deg, nearest }.rule(settings, 1.0)?;
        settings.accept_without("step_deg", setting_in_radians("step_deg", read.step_deg, 0.0))?;
        let mut faults = Faults::default();
        let robot = faults.keep(input(settings, inputs, "robot", &read.robot, read_urdf));
        let expected = robot.as_ref().map(|(_, robot)| Expected {
            robot: read.robot_name.as_ref().unwrap_or(&robot.name),
            base: &robot.base,
            joints: robot.joints.iter().map(|joint| joint.name.as_str()).collect(),
        });
        let problem = faults.keep(input(settings, inputs, "problem", &read.problem, |file| {
            let document = Document::open(file)?;
            let all = ProblemFile::parse(document.clone())?;
            Ok((all.problem(read.set.as_deref(), read.index, expected.as_ref())?, document))
        }));
        let rule = (read.self_collision, read.srdf.as_deref());
        let contact =
            robot.as_ref().and_then(|(_, robot)| faults.keep(contact(settings, inputs, robot, rule)));
        let read_all = robot.zip(problem).zip(contact);
        let (((robot_file, robot), (problem_file, (problem, document))), (srdf_file, contact)) =
            faults.or(read_all)?;
        let files = [robot_file, problem_file].into_iter().chain(srdf_file);
        let inputs = files.chain(robot.files.iter().cloned()).collect();
        let notes = read.notes(&robot, &problem, &contact);
        let drawn = Ends::of_tips(settings, read.queries, [&read.start_mm, &read.goal_mm])?;
        let queries = drawn.as_ref().map_or_else(|| queries(&problem), |drawn| drawn.queries().to_vec());
        let support = support(settings, &read.support)?;
        let obstacles = under(&support).into_iter().chain(problem.obstacles.iter().cloned()).collect();
        let space = JointSpace::new(robot, obstacles, &contact, read.step_deg.to_radians());
        let ends =
            std::iter::once(("start", &problem.start)).chain(problem.goals.iter().map(|goal| ("goal", goal)));
        let mut unposed = Faults::default();
        // What the set itself calls invalid may well stand in an obstacle.
        for (what, end) in ends.filter(|_| problem.is_valid && drawn.is_none()) {
            unposed.keep(posed(&space, &document, what, end));
        }
        let floor_m = support.floor_m();
        let is_valid = problem.is_valid;
        let ends = unposed.done();
        Ok(Self { read, near, space, floor_m, queries, is_valid, drawn, ends, notes, inputs })
    }
}

/// Which parts of the robot must not touch, if it is checked, and the file that says so.
pub(super) fn contact(
    settings: &Settings,
    inputs: &Inputs,
    robot: &Robot,
    (is_checked, srdf): (bool, Option<&str>),
) -> Result<(Option<PathBuf>, SelfContact), SettingsError> {
    let Some(srdf) = srdf else {
        return Ok((None, if is_checked { SelfContact::Apart } else { SelfContact::Unchecked }));
    };
    if !is_checked {
        return Err(settings.error_at("srdf", UNUSED_SRDF));
    }
    let (file, may_touch) = input(settings, inputs, "srdf", srdf, |file| read_srdf(file, robot))?;
    Ok((Some(file), SelfContact::Except(may_touch)))
}

/// What a reader of results should know of how a robot's files were taken.
pub(super) fn robot_notes(
    file: &str,
    robot: &Robot,
    contact: &SelfContact,
    srdf: Option<&str>,
) -> Vec<String> {
    let mut notes: Vec<String> = robot.notes.iter().map(|note| format!("{file}: {note}")).collect();
    let meshes = robot.solids.iter().filter(|(_, solid)| matches!(solid.form, Form::Hull(_))).count();
    if meshes > 0 {
        notes.push(format!("{file}: the convex hulls of their STL vertices stand for {meshes} meshes"));
    }
    if let (SelfContact::Except(may_touch), Some(srdf)) = (contact, srdf) {
        notes.extend(may_touch.notes.iter().map(|note| format!("{srdf}: {note}")));
    }
    notes
}

/// What became of a `robot_name` of the study where the problems call their robot `found`.
pub(super) fn renamed(robot: &Robot, found: Option<&str>) -> String {
    match found {
        None => "it names no robot, so `robot_name` is not used".to_owned(),
        Some(found) => {
            format!("its robot `{found}` is taken as `{}` of the URDF file, as `robot_name` says", robot.name)
        }
    }
}

impl JointQueries {
    /// What a reader of results should know of how the files were taken.
    fn notes(&self, robot: &Robot, problem: &Problem, contact: &SelfContact) -> Vec<String> {
        let mut notes = robot_notes(&self.robot, robot, contact, self.srdf.as_deref());
        let of_problem = problem.notes.iter().cloned().chain(ignored_note(&problem.ignored));
        notes.extend(of_problem.map(|note| format!("{}: {note}", self.problem)));
        if self.robot_name.is_some() {
            notes.push(format!("{}: {}", self.problem, renamed(robot, problem.robot.as_deref())));
        }
        if !problem.is_valid {
            let index = self.index;
            notes.push(format!(
                "{}: the set calls problem {index} invalid; it is counted as such",
                self.problem
            ));
        }
        notes
    }
}

/// The support, checked: the problem's origin is the base.
pub(super) fn support(settings: &Settings, entry: &SupportEntry) -> Result<Support, SettingsError> {
    let support =
        entry.support().map_err(|(key, message)| settings.error_at(&format!("support.{key}"), message))?;
    if *support.base() == Frame::IDENTITY {
        return Ok(support);
    }
    let message = "the problem file places everything from the robot's base; base_mm = [0, 0, 0] and yaw_deg = 0 are accepted";
    Err(settings.error_at("support", message))
}

/// The floor, first, and the pedestal as obstacles; the floor is a slab that no robot reaches an end of.
pub(super) fn under(support: &Support) -> Vec<Solid> {
    const FAR_M: f64 = 100.0;
    let solid = |name: &str, origin_m: [f64; 3], half_m: [f64; 3]| Solid {
        name: name.to_owned(),
        pose: Pose { origin_m, ..Pose::IDENTITY },
        form: Form::Box(half_m),
    };
    let floor = support.floor_m().map(|height| solid("floor", [0.0, 0.0, height - FAR_M], [FAR_M; 3]));
    let block = support
        .pedestal()
        .map(|block| solid("pedestal", block.frame().origin.into(), (*block.half()).into()));
    floor.into_iter().chain(block).collect()
}

/// From the start to each goal; a single one needs no name.
pub(super) fn queries(problem: &Problem) -> Vec<Query> {
    let name =
        |index: usize| if problem.goals.len() == 1 { String::new() } else { format!("goal-{}", index + 1) };
    let query = |(index, goal): (usize, &Ended)| Query {
        name: name(index),
        start: problem.start.joints.clone(),
        goal: goal.joints.clone(),
    };
    problem.goals.iter().enumerate().map(query).collect()
}

/// That the robot can stand at `end`.
fn posed(space: &JointSpace, document: &Document, what: &str, end: &Ended) -> Result<(), SettingsError> {
    let refused = |refusal| document.error(end.at.clone(), format!("the {what} cannot be posed: {refusal}"));
    space.refusal(&end.joints).map_or(Ok(()), |refusal| Err(refused(refusal)))
}

impl Posed {
    fn draw_configuration(&self, stream: &mut Stream) -> Vec<f64> {
        let within = |[low, high]: [f64; 2]| low + (high - low) * stream.random::<f64>();
        self.space.chain().joints().iter().map(|joint| joint.joint.limits).map(within).collect()
    }

    fn queries_drawn(&self, seed: u64) -> Result<Vec<Query>, Invalid> {
        let Some(drawn) = &self.drawn else { return Ok(self.queries.clone()) };
        drawn.drawn(seed, |stream, limits| {
            let q = self.draw_configuration(stream);
            let tip_mm: [f64; 3] = (self.space.chain().forward(&q).origin * 1e3).into();
            (is_within(&tip_mm, limits) && self.space.is_free(&q)).then_some(q)
        })
    }
}

impl Family for Posed {
    fn world(&self) -> WorldKind {
        WorldKind::Roadmap
    }

    /// A roadmap of one sample serves planners that draw their own: only the seeds of instances differ.
    fn instances(&self) -> Option<&'static str> {
        (self.read.samples == 1).then_some("seeds")
    }

    fn prepare(&self, seed: u64) -> Result<Preprocessing, Invalid> {
        if !self.is_valid {
            return Err(Invalid("the problem set calls this problem invalid".to_owned()));
        }
        let queries = self.queries_drawn(seed)?;
        let mut stream = seed::stream(seed);
        let wanted = self.read.samples;
        let mut samples = Vec::new();
        let mut draws = 0;
        while samples.len() < wanted as usize {
            if draws / DRAWS_PER_SAMPLE >= wanted {
                let found = samples.len();
                return Err(Invalid(format!(
                    "{found} of {wanted} free configurations were found in {draws} draws"
                )));
            }
            let config = self.draw_configuration(&mut stream);
            if self.space.is_free(&config) {
                samples.push(Sample { config, drawn_after: draws });
            }
            draws += 1;
        }
        let local = Local::Joints(Box::new(self.space.clone()));
        let mut preprocessing = nested_roadmap::prepare(local, samples, draws, self.near, Counted::Accepted);
        preprocessing.traces = picture::traces(&self.space, self.floor_m, &queries);
        Ok(preprocessing)
    }

    fn queries(&self) -> &[Query] {
        &self.queries
    }

    fn queries_for(&self, seed: u64) -> Vec<Query> {
        self.queries_drawn(seed).unwrap_or_else(|_| self.queries.clone())
    }

    fn draws_ends(&self) -> bool {
        self.drawn.is_some()
    }

    fn check_ends(&self) -> Result<(), SettingsError> {
        self.ends.clone()
    }

    fn cells(&self) -> u64 {
        u64::from(self.read.samples)
    }

    fn extent(&self) -> Option<Extent> {
        Some(nested_roadmap::extent(self.read.samples, self.near, 1.0))
    }

    fn stance(&self, q_rad: &[f64]) -> Option<ArmPlacement> {
        picture::stance(&self.space, q_rad)
    }

    fn notes(&self) -> Vec<String> {
        self.notes.clone()
    }

    fn inputs(&self) -> &[PathBuf] {
        &self.inputs
    }
}
