//! What is wrong with a cross-check, as far as that is known before anything is run or asked.

use super::{RobotEntry, SceneFormat, Spec, armed};
use crate::crosscheck::stored::StoredPaths;
use base::settings::{Faults, SettingsError, none_called};
use engine::kinematics::{KinematicsError, Robot, robot::Body};
use engine::space::cell::Scene;
use study::paper::Paper;
use study::{Inputs, labels_of};

impl Spec {
    /// Files, bodies, studies and problem groups that do not exist go to `faults`, with all other names that are wrong.
    pub fn check(&self, paper: &Paper, inputs: &Inputs, faults: &mut Faults) {
        faults.keep(self.check_names());
        for (index, robot) in self.file.robots.iter().enumerate() {
            faults.keep(self.check_robot(index, robot.get_ref(), inputs));
        }
        for (index, scene) in self.file.scenes.iter().enumerate() {
            let scene = scene.get_ref();
            let place = format!("scene.{index}.file");
            let file = inputs.locate(&scene.file).map_err(|message| self.document.error_at(&place, message));
            if let Some(file) = faults.keep(file) {
                let read = match scene.format {
                    SceneFormat::Cell => Scene::load(&file).map(|_| ()),
                    SceneFormat::Polyhedra => armed(&file).map(|_| ()),
                };
                faults.keep(read);
            }
        }
        for (index, stored) in self.file.stored.iter().enumerate() {
            self.check_paths(&stored.get_ref().paths, &format!("stored.{index}.paths"), paper, faults);
        }
        for (index, workspace) in self.file.workspaces.iter().enumerate() {
            self.check_paths(&workspace.get_ref().paths, &format!("workspace.{index}.paths"), paper, faults);
        }
    }

    /// A robot that can be read, which has the body.
    fn check_robot(&self, index: usize, robot: &RobotEntry, inputs: &Inputs) -> Result<(), SettingsError> {
        let wrong =
            |key: &str, message: String| self.document.error_at(&format!("robot.{index}.{key}"), message);
        let file = inputs.locate(&robot.file).map_err(|message| wrong("file", message))?;
        let loaded = Robot::load(&file).map_err(|error| match error {
            KinematicsError::File(faults) => faults,
            other => wrong("file", other.to_string()),
        })?;
        let known: Vec<&str> = loaded.bodies().iter().map(Body::name).collect();
        if known.contains(&robot.body.as_str()) {
            return Ok(());
        }
        Err(wrong("body", none_called("body", &robot.body, known)))
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
            faults.add(
                self.document
                    .error_at(&format!("{place}.problems"), message)
                    .about(label)
                    .about(&labels_of(name)),
            );
        }
    }
}
