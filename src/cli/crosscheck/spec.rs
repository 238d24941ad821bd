//! `crosscheck.toml` in a paper's folder: which robots, scenes and stored paths are judged.
//!
//! Python reads the file by itself. It is read here too, so that `replan check` finds what is wrong with it without Python, and
//! so that replan knows the robots and scenes about which it must answer.

use super::subject::{OpenArm, PlanarArm, SceneFormat, SerialArm, Subject};
use base::robot::{Kind, MayTouch, read_srdf, read_urdf};
use base::settings::{Accepted, Document, Faults, SettingsError, Spanned, none_called};
use engine::kinematics::robot::{Body, URDF_BODY};
use engine::kinematics::{AXES, KinematicsError, Robot};
use engine::space::World;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;
use study::family::Family;
use study::paper::Paper;
use study::{Inputs, Interpretation, Study, labels_of, slug};

/// The file's name.
pub const SPEC: &str = "crosscheck.toml";
/// What `crosscheck.toml` may hold.
pub const FILE: Accepted = Accepted::shape::<SpecFile>();

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[expect(dead_code, reason = "Python draws by the sizes, and draws the picture")]
struct SpecFile {
    /// The root of every seed.
    seed: u64,
    /// How much is drawn and compared.
    sizes: Sizes,
    /// What the picture shows.
    picture: PictureEntry,
    /// Robots whose kinematics are judged.
    #[serde(default, rename = "robot")]
    robots: Vec<Spanned<RobotEntry>>,
    /// Scenes whose distances are judged.
    #[serde(default, rename = "scene")]
    scenes: Vec<Spanned<SceneEntry>>,
    /// Stored paths of robots in scenes that are judged.
    #[serde(default, rename = "stored")]
    stored: Vec<Spanned<StoredEntry>>,
    /// Planar arms whose stored paths are judged.
    #[serde(default, rename = "workspace")]
    workspaces: Vec<Spanned<WorkspaceEntry>>,
    /// Sets of problems: a sample of each is judged with its paths.
    #[serde(default, rename = "set")]
    sets: Vec<Spanned<SetEntry>>,
}

/// How many configurations of each kind are looked at.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[expect(dead_code, reason = "Python draws by them")]
struct Sizes {
    /// Drawn evenly.
    #[schemars(range(max = 1_000_000))]
    random: u32,
    /// Of these, how many are also requested with their frames.
    #[schemars(range(max = 1_000_000))]
    random_frames: u32,
    /// Of these, how many are also requested with their distances.
    #[schemars(range(max = 1_000_000))]
    random_distances: u32,
    /// Within a millimetre of contact.
    #[schemars(range(max = 1_000_000))]
    near_contact: u32,
    /// Singular.
    #[schemars(range(max = 1_000_000))]
    singular: u32,
    /// In which solids go through each other.
    #[schemars(range(max = 1_000_000))]
    piercing: u32,
    /// Straight joint paths drawn where no paths are stored.
    #[schemars(range(max = 1_000_000))]
    drawn_paths: u32,
}

/// What the picture shows.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[expect(dead_code, reason = "Python draws the picture")]
struct PictureEntry {
    /// The case, by its label.
    case: String,
    /// The keyframe, by its name.
    key: String,
    /// How far the camera is turned about the vertical.
    azimuth_deg: f64,
    /// How far the camera looks above the horizon; negative looks down.
    elevation_deg: f64,
    /// How near the camera is; at 1 everything but endless planes is well in the picture.
    zoom: f64,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct RobotEntry {
    /// Its name in tables.
    label: String,
    /// Its file, from the repository's root.
    file: String,
    /// The body of the robot's file that is judged; `urdf` of a URDF file.
    body: String,
    /// The SRDF file that says which links of a URDF robot may touch each other.
    srdf: Option<String>,
    /// What is straight between the stops of a stored path.
    #[expect(dead_code, reason = "Python follows the paths")]
    straight: Straight,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
enum Straight {
    /// The tool moves straight.
    Tool,
    /// The joint angles move straight.
    Joints,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct SceneEntry {
    /// Its name in tables.
    label: String,
    /// Its file, from the repository's root.
    file: String,
    /// How the scene file is written.
    format: SceneFormat,
}

/// Paths of one robot in one scene.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct StoredEntry {
    /// The robot, by its label.
    robot: String,
    /// The scene, by its label.
    scene: String,
    /// The stored paths that are judged.
    paths: StoredPaths,
}

/// A planar arm and its obstacles as a study poses them, and that study's paths.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct WorkspaceEntry {
    /// Its name in tables.
    label: String,
    /// The stored paths that are judged.
    paths: StoredPaths,
}

/// A set of problems that a study poses to one robot.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SetEntry {
    /// Its name in tables.
    pub label: String,
    /// The trials that are judged: each is run again for its path, and must come out as it is stored.
    pub paths: StoredPaths,
    /// How many of those that are solved are drawn.
    #[schemars(range(min = 1, max = 1000))]
    pub sample: u32,
}

/// Which paths of a study are judged.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[expect(dead_code, reason = "Python reads the paths")]
pub struct StoredPaths {
    /// The study.
    pub study: String,
    /// The label of its problem group.
    pub problems: String,
    /// The trace that holds configurations, one a point.
    pub trace: String,
    /// Which of a point's numbers is the first joint's angle, from 0.
    first_joint: usize,
    /// The unit of the angles.
    unit: AngleUnit,
    /// What the study says the paths are free of, all the way.
    free_of: Freedom,
}

/// A unit of angles.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
enum AngleUnit {
    /// Degrees.
    Deg,
    /// Radians.
    Rad,
}

/// What a path counts as free of.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
enum Freedom {
    /// Nothing is promised.
    Nothing,
    /// What stands around the robot; it may hit itself.
    Scene,
    /// All contact.
    Contact,
}

/// A robot that was read.
enum Loaded {
    /// By rows, or of six joints that turn.
    Serial(Box<Robot>),
    /// By a URDF file with other joints, and which of its links may touch.
    Open(Box<base::robot::Robot>, MayTouch),
}

/// A cross-check as its paper poses it.
pub struct Spec {
    file: SpecFile,
    document: Arc<Document>,
}

/// A case by name: a robot in a scene, or a planar arm, that answers with our code.
pub type Case = (String, Box<dyn Subject>);

impl Spec {
    /// Reads the spec in a paper's `folder`; `None` if there is none.
    ///
    /// # Errors
    /// The line and column of what is not understood.
    pub fn open(folder: &Path) -> Result<Option<Self>, SettingsError> {
        let path = folder.join(SPEC);
        if !path.is_file() {
            return Ok(None);
        }
        let document = Document::open(&path)?;
        let file: SpecFile = document.read()?;
        Ok(Some(Self { file, document }))
    }

    /// The cases, with files looked for in `inputs` and studies in the paper's `folder`.
    ///
    /// # Errors
    /// Files and names that do not exist, at their place.
    pub fn cases(&self, folder: &Path, inputs: &Inputs) -> Result<Vec<Case>, SettingsError> {
        let mut faults = Faults::default();
        let mut cases = Vec::new();
        faults.keep(self.check_stored());
        for (index, robot) in self.file.robots.iter().enumerate() {
            let robot = robot.get_ref();
            let Some(loaded) = faults.keep(self.robot(index, inputs)) else { continue };
            for (place, scene) in self.file.scenes.iter().enumerate() {
                let scene = scene.get_ref();
                let name = slug(&format!("{} in {}", robot.label, scene.label));
                let file = self.located(&format!("scene.{place}.file"), &scene.file, inputs);
                let arm = file.and_then(|file| match &loaded {
                    Loaded::Serial(serial) => {
                        let arm = SerialArm::new(serial, &robot.body, scene.format, &file)?;
                        Ok(Box::new(arm) as Box<dyn Subject>)
                    }
                    Loaded::Open(open, may_touch) => {
                        let arm = OpenArm::new(open, may_touch, scene.format, &file);
                        let arm = arm.map_err(|error| self.unfit(index, "file", error))?;
                        Ok(Box::new(arm) as Box<dyn Subject>)
                    }
                });
                cases.extend(faults.keep(arm).map(|arm| (name, arm)));
            }
        }
        for index in 0..self.file.workspaces.len() {
            cases.extend(faults.keep(self.workspace(index, folder, inputs)));
        }
        faults.or(Some(cases))
    }

    fn located(&self, place: &str, file: &str, inputs: &Inputs) -> Result<std::path::PathBuf, SettingsError> {
        inputs.locate(file).map_err(|message| self.document.error_at(place, message))
    }

    /// What is wrong with the robot of this number: a fault of its file at its place, any other at a key of this one.
    fn unfit(&self, index: usize, key: &str, error: KinematicsError) -> SettingsError {
        match error {
            KinematicsError::File(faults) => faults,
            other => self.document.error_at(&format!("robot.{index}.{key}"), other.to_string()),
        }
    }

    /// The robot of this number, which can be read and has the body.
    fn robot(&self, index: usize, inputs: &Inputs) -> Result<Loaded, SettingsError> {
        let robot = self.file.robots[index].get_ref();
        let wrong =
            |key: &str, message: String| self.document.error_at(&format!("robot.{index}.{key}"), message);
        let file = self.located(&format!("robot.{index}.file"), &robot.file, inputs)?;
        let ending = file.extension().and_then(|ending| ending.to_str());
        let loaded = match (ending, &robot.srdf) {
            (Some("toml"), None) => Robot::load(&file).map(|robot| Loaded::Serial(Box::new(robot))),
            (Some("urdf"), Some(srdf)) => {
                let srdf = self.located(&format!("robot.{index}.srdf"), srdf, inputs)?;
                let open = read_urdf(&file)?;
                if open.joints.len() == AXES && open.joints.iter().all(|joint| joint.kind != Kind::Slides) {
                    Robot::load_with_srdf(&file, &srdf).map(|robot| Loaded::Serial(Box::new(robot)))
                } else {
                    let may_touch = read_srdf(&srdf, &open)?;
                    Ok(Loaded::Open(Box::new(open), may_touch))
                }
            }
            _ => {
                let message = format!(
                    "`{}` with this `srdf` is not judged; accepted: a file of rows (.toml) without `srdf`, or a URDF file with it",
                    robot.file
                );
                return Err(wrong("file", message));
            }
        };
        let loaded = loaded.map_err(|error| self.unfit(index, "file", error))?;
        let known: Vec<&str> = match &loaded {
            Loaded::Serial(robot) => robot.bodies().iter().map(Body::name).collect(),
            Loaded::Open(..) => vec![URDF_BODY],
        };
        if known.contains(&robot.body.as_str()) {
            return Ok(loaded);
        }
        Err(wrong("body", none_called("body", &robot.body, known)))
    }

    /// The planar arm of the workspace of this number, as its study poses it under its default interpretation.
    fn workspace(&self, index: usize, folder: &Path, inputs: &Inputs) -> Result<Case, SettingsError> {
        let WorkspaceEntry { label, paths } = self.file.workspaces[index].get_ref();
        let place = format!("workspace.{index}.paths");
        let wrong = |message| self.document.error_at(&format!("{place}.problems"), message);
        let (.., family) = self.posed(paths, &place, folder, inputs)?;
        let world: World = family.prepare(0).map_err(|invalid| wrong(invalid.0))?.world;
        let Some(arm) = world.as_arm() else {
            let kind = world.kind().name();
            return Err(wrong(format!(
                "the world of `{label}` is a {kind}; accepted: a planar arm's workspace"
            )));
        };
        Ok((slug(label), Box::new(PlanarArm::new(arm))))
    }

    /// The study of some paths, its default interpretation, and what their group poses under it.
    ///
    /// # Errors
    /// A study or a problem group that does not exist, or that cannot be built, at `place`.
    pub fn posed(
        &self,
        paths: &StoredPaths,
        place: &str,
        folder: &Path,
        inputs: &Inputs,
    ) -> Result<(Study, Interpretation, Box<dyn Family>), SettingsError> {
        let wrong = |key: &str, message: String| self.document.error_at(&format!("{place}.{key}"), message);
        let study = Study::load(&folder.join(format!("{}.toml", paths.study)), inputs)
            .map_err(|error| wrong("study", error.to_string()))?;
        let Some(group) = study.groups.iter().find(|group| group.label == paths.problems) else {
            let known = study.groups.iter().map(|group| group.label.as_str());
            return Err(wrong("problems", none_called("problem group", &paths.problems, known)));
        };
        let point = Interpretation::new(&study.choices, &BTreeMap::new());
        let point =
            point.expect("a loaded study's defaults are among its options").for_trials(&study.choices);
        let family = group.family(&group.points[0], &point, inputs);
        let family = family.map_err(|error| wrong("problems", error.to_string()))?;
        Ok((study, point, family))
    }

    /// The seed that samples are drawn by.
    pub fn seed(&self) -> u64 {
        self.file.seed
    }

    /// The sets, each with its place in the file.
    pub fn sets(&self) -> impl Iterator<Item = (String, &SetEntry)> {
        let sets = self.file.sets.iter().enumerate();
        sets.map(|(index, entry)| (format!("set.{index}"), entry.get_ref()))
    }

    /// A fault at a key of this file.
    pub fn fault(&self, place: &str, message: String) -> SettingsError {
        self.document.error_at(place, message)
    }

    /// Robots and scenes that stored paths name.
    fn check_stored(&self) -> Result<(), SettingsError> {
        for entry in &self.file.stored {
            let StoredEntry { robot, scene, .. } = entry.get_ref();
            let has_robot = self.file.robots.iter().any(|known| known.get_ref().label == *robot);
            let has_scene = self.file.scenes.iter().any(|known| known.get_ref().label == *scene);
            if !(has_robot && has_scene) {
                let message = format!("there is no robot `{robot}` with a scene `{scene}` in this file");
                return Err(self.document.error(entry.span(), message));
            }
        }
        Ok(())
    }

    /// Files, bodies, studies and problem groups that do not exist go to `faults`, with all other names that are wrong.
    pub fn check(&self, paper: &Paper, inputs: &Inputs, faults: &mut Faults) {
        let stored = self.file.stored.iter().enumerate();
        let stored = stored.map(|(index, entry)| (format!("stored.{index}.paths"), &entry.get_ref().paths));
        let workspaces = self.file.workspaces.iter().enumerate();
        let workspaces =
            workspaces.map(|(index, entry)| (format!("workspace.{index}.paths"), &entry.get_ref().paths));
        let sets = self.sets().map(|(place, entry)| (format!("{place}.paths"), &entry.paths));
        let mut names = Faults::default();
        for (place, paths) in stored.chain(workspaces).chain(sets) {
            self.check_paths(paths, &place, paper, &mut names);
        }
        if names.is_empty() {
            faults.keep(self.cases(&paper.folder, inputs).map(drop));
        }
        faults.keep(names.done());
    }

    fn check_paths(&self, paths: &StoredPaths, place: &str, paper: &Paper, faults: &mut Faults) {
        let name = paths.study.as_str();
        let label = paths.problems.as_str();
        let Some(study) = paper.study(name) else {
            let known = paper.studies.iter().map(|study| study.name.as_str());
            let fault = self.document.error_at(&format!("{place}.study"), none_called("study", name, known));
            return faults.add(fault.about(name));
        };
        if !study.groups.iter().any(|group| group.label == label) {
            let known = study.groups.iter().map(|group| group.label.as_str());
            let message = format!("study `{name}`: {}", none_called("problem group", label, known));
            let fault = self.document.error_at(&format!("{place}.problems"), message);
            faults.add(fault.about(label).about(&labels_of(name)));
        }
    }
}
