//! `crosscheck.toml` in a paper's folder: which robots, scenes and stored paths are judged.

use super::CrosscheckError;
use super::case::{Case, Given};
use super::model::Still;
use super::path::Path as JointPath;
use super::sample::Sizes;
use super::subject::SerialArm;
use crate::kinematics::{AXES, Robot};
use crate::seed;
use crate::settings::{Document, SettingsError};
use crate::space::cell::Scene;
use crate::study::manifest::Manifest;
use crate::study::store::read_records;
use crate::study::{Inputs, slug};
use rayon::prelude::*;
use serde::Deserialize;
use std::path::Path;
use std::sync::Arc;
use toml::Spanned;

/// The file's name.
pub const SPEC: &str = "crosscheck.toml";

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct SpecFile {
    seed: u64,
    sizes: Sizes,
    picture: PictureEntry,
    #[serde(default, rename = "robot")]
    robots: Vec<Spanned<RobotEntry>>,
    #[serde(default, rename = "scene")]
    scenes: Vec<Spanned<SceneEntry>>,
    #[serde(default, rename = "stored")]
    stored: Vec<Spanned<StoredEntry>>,
}

/// What the picture shows.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct PictureEntry {
    case: Spanned<String>,
    key: String,
    azimuth_deg: f64,
    elevation_deg: f64,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct RobotEntry {
    label: String,
    file: String,
    body: String,
    /// What is straight between the stops of a stored path.
    straight: Straight,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Straight {
    Tool,
    Joints,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct SceneEntry {
    label: String,
    file: String,
    format: SceneFormat,
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(rename_all = "snake_case")]
enum SceneFormat {
    /// A robot's cell, in millimetres.
    Cell,
}

/// Paths that a study kept.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct StoredEntry {
    robot: String,
    scene: String,
    study: String,
    exhibit: String,
    /// Which of the exhibit's columns is the first joint's angle, from 0.
    first_joint: usize,
    unit: AngleUnit,
    /// Whether the study says that the paths are free.
    free: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
enum AngleUnit {
    Deg,
    Rad,
}

/// A cross-check as its paper poses it.
pub struct Spec {
    file: SpecFile,
    document: Arc<Document>,
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
}

impl Spec {
    /// Reads the spec in a paper's `folder`; `None` if there is none.
    ///
    /// # Errors
    /// The line and column of what is not understood.
    pub fn load(folder: &Path) -> Result<Option<Self>, CrosscheckError> {
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
        let PictureEntry { case, key, azimuth_deg, elevation_deg } = &self.file.picture;
        Picture {
            case: case.get_ref().clone(),
            key: key.clone(),
            camera_deg: [*azimuth_deg, *elevation_deg],
        }
    }

    /// Every robot in every scene; `runs` is where the paper's records are.
    ///
    /// # Errors
    /// Files and names that do not exist, stored runs that cannot be read, and a picture of no case.
    pub fn cases(&self, inputs: &Inputs, runs: &Path) -> Result<Vec<Case>, CrosscheckError> {
        self.check_names()?;
        let pairs: Vec<_> =
            self.file.robots.iter().flat_map(|r| self.file.scenes.iter().map(move |s| (r, s))).collect();
        let cases: Vec<Case> = pairs
            .par_iter()
            .map(|(robot, scene)| self.case(robot, scene, inputs, runs))
            .collect::<Result<_, _>>()?;
        let picture = &self.file.picture.case;
        if !cases.iter().any(|case| case.name() == picture.get_ref()) {
            let known: Vec<&str> = cases.iter().map(Case::name).collect();
            let message = format!("there is no case `{}`; the cases are {}", picture.get_ref(), known.join(", "));
            return Err(self.document.error(picture.span(), message).into());
        }
        Ok(cases)
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

    fn case(
        &self,
        robot: &Spanned<RobotEntry>,
        scene: &Spanned<SceneEntry>,
        inputs: &Inputs,
        runs: &Path,
    ) -> Result<Case, CrosscheckError> {
        let (r, s) = (robot.get_ref(), scene.get_ref());
        let at_robot = |message: String| self.document.error(robot.span(), message);
        let at_scene = |message: String| self.document.error(scene.span(), message);
        let file = inputs.locate(&r.file).map_err(at_robot)?;
        let loaded = Robot::load(&file).map_err(|error| at_robot(error.to_string()))?;
        let stills = s.format.stills(&inputs.locate(&s.file).map_err(at_scene)?)?;
        let name = slug(&format!("{} in {}", r.label, s.label));
        let tool_is_straight = r.straight == Straight::Tool;
        let subject =
            SerialArm::new(name.clone(), loaded, &r.body, stills, tool_is_straight).map_err(at_robot)?;
        let given = self.given(r, s, runs)?;
        let seed = seed::derive(self.file.seed, &["crosscheck", &name]);
        Case::new(name, Box::new(subject), &self.file.sizes, seed, given)
            .map_err(|message| at_scene(message).into())
    }

    /// The stored paths of one robot in one scene.
    fn given(&self, robot: &RobotEntry, scene: &SceneEntry, runs: &Path) -> Result<Given, CrosscheckError> {
        let mut given = Given { paths: Vec::new(), must_be_free: true };
        let fits = |entry: &&StoredEntry| entry.robot == robot.label && entry.scene == scene.label;
        for entry in self.file.stored.iter().map(Spanned::get_ref).filter(fits) {
            given.paths.extend(entry.paths(runs)?);
            given.must_be_free &= entry.free;
        }
        Ok(given)
    }
}

impl SceneFormat {
    fn stills(self, path: &Path) -> Result<Vec<Still>, SettingsError> {
        match self {
            Self::Cell => {
                let scene = Scene::load(path)?;
                let still = |o: &crate::space::cell::Obstacle| Still { name: o.name.clone(), solid: o.solid.clone() };
                Ok(scene.obstacles().iter().map(still).collect())
            }
        }
    }
}

impl StoredEntry {
    fn paths(&self, runs: &Path) -> Result<Vec<JointPath>, CrosscheckError> {
        let manifest = Manifest::read(runs, &self.study)?;
        let records = read_records(runs, &self.study, &manifest.files)?;
        let kept = records.batch.kept.iter().filter(|kept| kept.exhibit.name == self.exhibit);
        let angle = |value: f64| if self.unit == AngleUnit::Deg { value.to_radians() } else { value };
        let path = |kept: &crate::study::record::Kept| {
            let rows = kept.exhibit.values.chunks_exact(kept.exhibit.width);
            let stop = |row: &[f64]| {
                row.iter().skip(self.first_joint).take(AXES).map(|value| angle(*value)).collect()
            };
            JointPath { name: kept.of.clone(), stops_rad: rows.map(stop).collect() }
        };
        Ok(kept.map(path).filter(|path| path.stops_rad.len() > 1).collect())
    }
}
