//! `crosscheck.toml` in a paper's folder: which robots, scenes and stored paths are judged.

mod check;

use super::CrosscheckError;
use super::case::{Case, Given};
use super::model::{Freedom, Still};
use super::planar::PlanarArm;
use super::sample::Sizes;
use super::stored::StoredPaths;
use super::subject::{Check, SerialArm, Subject};
use base::seed;
use base::settings::{Accepted, Document, SettingsError, Spanned};
use engine::geometry::{Convex, Solid};
use engine::kinematics::{AXES, Robot};
use engine::space::Support;
use engine::space::cell::{Cell, Obstacle, Scene};
use engine::space::polyhedra::{CarriedArm, read_scene};
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Deserialize;
use std::path::Path;
use std::sync::Arc;
use study::{Inputs, slug};

/// The file's name.
pub const SPEC: &str = "crosscheck.toml";
/// What `crosscheck.toml` may hold.
pub const FILE: Accepted = Accepted::shape::<SpecFile>();

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
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
}

/// What the picture shows.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct PictureEntry {
    /// The case, by its label.
    case: Spanned<String>,
    /// The keyframe, by its name.
    key: Spanned<String>,
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
    /// The body of the robot's file that is judged.
    body: String,
    /// What is straight between the stops of a stored path.
    straight: Straight,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
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

#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
enum SceneFormat {
    /// A robot's cell, in millimetres.
    Cell,
    /// Convex solids, in centimetres.
    Polyhedra,
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

/// A cross-check as its paper poses it.
pub struct Spec {
    file: SpecFile,
    document: Arc<Document>,
}

/// What the cases are made from.
#[derive(Debug, Clone, Copy)]
pub struct Sources<'a> {
    /// The paper's folder.
    pub folder: &'a Path,
    /// Where input files are looked for.
    pub inputs: &'a Inputs,
    /// Where the paper's records are.
    pub runs: &'a Path,
}

/// What one case is made of.
enum Posed<'a> {
    Scene(&'a Spanned<RobotEntry>, &'a Spanned<SceneEntry>),
    Workspace(&'a Spanned<WorkspaceEntry>),
}

/// What a picture shows.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// The case.
    pub case: String,
    /// The keyframe.
    pub key: String,
    /// Where the camera stands: turned about the vertical, and above the horizon (negative looks down).
    pub camera_deg: [f64; 2],
    /// How much larger things are than if everything just fits.
    pub zoom: f64,
}

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

    /// What the picture shows.
    pub fn picture(&self) -> Picture {
        let PictureEntry { case, key, azimuth_deg, elevation_deg, zoom } = &self.file.picture;
        Picture {
            case: case.get_ref().clone(),
            key: key.get_ref().clone(),
            camera_deg: [*azimuth_deg, *elevation_deg],
            zoom: *zoom,
        }
    }

    /// How many cases there are.
    pub fn count(&self) -> usize {
        self.posed().len()
    }

    fn posed(&self) -> Vec<Posed<'_>> {
        let scenes = |robot| self.file.scenes.iter().map(move |scene| Posed::Scene(robot, scene));
        let mut posed: Vec<Posed<'_>> = self.file.robots.iter().flat_map(scenes).collect();
        posed.extend(self.file.workspaces.iter().map(Posed::Workspace));
        posed
    }

    /// Every robot in every scene, and every workspace; `step` is called after each.
    ///
    /// # Errors
    /// Files and names that do not exist, stored runs that cannot be read, and a picture of no case.
    pub fn cases(
        &self,
        sources: Sources<'_>,
        step: &(dyn Fn() + Sync),
    ) -> Result<Vec<Case>, CrosscheckError> {
        self.check_names()?;
        let cases = self.posed().into_par_iter().map(|posed| {
            let case = match posed {
                Posed::Scene(robot, scene) => self.scene_case(robot, scene, sources),
                Posed::Workspace(entry) => self.workspace_case(entry, sources),
            };
            step();
            case
        });
        let cases: Vec<Case> = cases.collect::<Result<_, _>>()?;
        self.check_labels(&cases)?;
        Ok(cases)
    }

    /// That the picture shows a case and that cases can be told apart.
    fn check_labels(&self, cases: &[Case]) -> Result<(), SettingsError> {
        let known: Vec<&str> = cases.iter().map(Case::name).collect();
        let PictureEntry { case, key, .. } = &self.file.picture;
        let Some(shown) = cases.iter().find(|known| known.name() == case.get_ref()) else {
            let message =
                format!("there is no case `{}`; the cases are {}", case.get_ref(), known.join(", "));
            return Err(self.document.error(case.span(), message));
        };
        if !shown.keys().contains(&key.get_ref().as_str()) {
            let asked = key.get_ref();
            let keys = shown.keys().join(", ");
            let message = format!("case `{}` has no keyframe `{asked}`; it has {keys}", case.get_ref());
            return Err(self.document.error(key.span(), message));
        }
        if let Some(twice) = known.iter().enumerate().find(|(at, name)| known[..*at].contains(name)) {
            let message =
                format!("two cases are called `{}`; accepted: labels that tell them apart", twice.1);
            return Err(self.document.error_at("case", message));
        }
        Ok(())
    }

    fn check_names(&self) -> Result<(), SettingsError> {
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

    fn scene_case(
        &self,
        robot: &Spanned<RobotEntry>,
        scene: &Spanned<SceneEntry>,
        sources: Sources<'_>,
    ) -> Result<Case, CrosscheckError> {
        let (r, s) = (robot.get_ref(), scene.get_ref());
        let at_robot = |message: String| self.document.error(robot.span(), message);
        let at_scene = |message: String| self.document.error(scene.span(), message);
        let file = sources.inputs.locate(&r.file).map_err(at_robot)?;
        let loaded = Robot::load(&file).map_err(|error| at_robot(error.to_string()))?;
        let path = sources.inputs.locate(&s.file).map_err(at_scene)?;
        let Standing { robot: loaded, stills, check } = s.format.read(&path, &loaded, &r.body)?;
        let name = slug(&format!("{} in {}", r.label, s.label));
        let tool_is_straight = r.straight == Straight::Tool;
        let subject =
            SerialArm::new(name.clone(), loaded, &r.body, stills, tool_is_straight).map_err(at_robot)?;
        let subject = subject.checked_by(check);
        let fits = |entry: &&StoredEntry| entry.robot == r.label && entry.scene == s.label;
        let stored = self.file.stored.iter().map(Spanned::get_ref).filter(fits).map(|entry| &entry.paths);
        let given = given(stored, &sources, AXES)?;
        self.case(name, Box::new(subject), given).map_err(|message| at_scene(message).into())
    }

    fn workspace_case(
        &self,
        entry: &Spanned<WorkspaceEntry>,
        sources: Sources<'_>,
    ) -> Result<Case, CrosscheckError> {
        let at = |message: String| self.document.error(entry.span(), message);
        let WorkspaceEntry { label, paths } = entry.get_ref();
        let index =
            self.file.workspaces.iter().position(|known| known.span() == entry.span()).unwrap_or_default();
        let misnamed = |key: &str, message: String| {
            self.document.error_at(&format!("workspace.{index}.paths.{key}"), message)
        };
        let world = paths.world(sources.folder, sources.inputs, &misnamed)?;
        let arm = world.as_arm().ok_or_else(|| {
            at(format!(
                "the world of `{label}` is a {}; accepted: a planar arm's workspace",
                world.kind().name()
            ))
        })?;
        let name = slug(label);
        let subject = PlanarArm::new(name.clone(), arm).map_err(|error| at(error.to_string()))?;
        let joints = subject.model().rows.len();
        let given = given([paths].into_iter(), &sources, joints)?;
        self.case(name, Box::new(subject), given).map_err(|message| at(message).into())
    }

    fn case(&self, name: String, subject: Box<dyn Subject>, given: Given) -> Result<Case, String> {
        let seed = seed::derive(self.file.seed, &["crosscheck", &name]);
        Case::new(name, subject, &self.file.sizes, seed, given)
    }
}

/// The stored paths of a robot with this many joints.
fn given<'a>(
    stored: impl Iterator<Item = &'a StoredPaths>,
    sources: &Sources<'_>,
    joints: usize,
) -> Result<Given, CrosscheckError> {
    let mut given = Given { paths: Vec::new(), free_of: Freedom::Contact };
    for paths in stored {
        given.paths.extend(paths.read(sources.folder, sources.inputs, sources.runs, joints)?);
        given.free_of = given.free_of.min(paths.free_of);
    }
    Ok(given)
}

/// One of a scene's convex solids, which are in centimetres and have no names but the block under the arm.
fn convex_still(index: usize, body: &Convex, is_pedestal: bool) -> Still {
    const M: f64 = 1e-2;
    let vertices = body.vertices().iter().map(|vertex| vertex * M).collect();
    let solid = Convex::from_vertices(vertices).expect("a solid stays one in another unit");
    let name = if is_pedestal { "pedestal".to_owned() } else { format!("obstacle {}", index + 1) };
    Still { name, solid: Solid::Convex(solid) }
}

/// A robot where a scene puts it, and what stands around it.
struct Standing {
    robot: Robot,
    stills: Vec<Still>,
    check: Option<Check>,
}

impl SceneFormat {
    /// What stands in the scene at `path` with `robot` in it, and how planners check the robot's body called `body` there.
    fn read(self, path: &Path, robot: &Robot, body: &str) -> Result<Standing, SettingsError> {
        match self {
            Self::Cell => {
                let scene = Scene::load(path)?;
                let still = |o: &Obstacle| Still { name: o.name.clone(), solid: o.solid.clone() };
                let stills = scene.obstacles().iter().map(still).collect();
                // Cells know a robot's first body only.
                let is_first = robot.bodies().first().is_some_and(|first| first.name() == body);
                let placed = robot.clone().placed(scene.base());
                let check = is_first.then(|| Check::Cell(Box::new(Cell::new(robot.clone(), scene, true))));
                Ok(Standing { robot: placed, stills, check })
            }
            Self::Polyhedra => {
                let (bodies, support) = armed(path)?;
                // The block stands last.
                let is_pedestal = |index| support.pedestal().is_some() && index + 1 == bodies.len();
                let named = |(index, body)| convex_still(index, body, is_pedestal(index));
                let solids = bodies.iter().enumerate().map(named);
                let floor = support.solids().unwrap_or_default().into_iter().filter_map(|(name, solid)| {
                    matches!(solid, Solid::HalfSpace(_)).then(|| Still { name: name.to_owned(), solid })
                });
                let stills = solids.chain(floor).collect();
                let arm = CarriedArm::new(robot, body, &support).ok();
                let check = arm.map(|arm| Check::Rods(Box::new(arm), bodies));
                Ok(Standing { robot: robot.clone().placed(support.base()), stills, check })
            }
        }
    }
}

/// The bodies of the scene of polyhedra at `path` with an arm in it, and where the arm stands.
pub(super) fn armed(path: &Path) -> Result<(Vec<Convex>, Support), SettingsError> {
    let document = Document::open(path)?;
    read_scene(path)?.with_arm().map_err(|message| document.error(0..0, message))
}
