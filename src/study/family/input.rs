//! Input files that a family's settings name, each fault of one at its own place.

use super::overlay::overlaid;
use crate::Inputs;
use crate::spec::{ROBOT_WITH, SCENE_WITH};
use base::settings::{Document, Settings, SettingsError};
use engine::kinematics::{KinematicsError, Robot};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use toml::Table;

/// Why an SRDF file is refused that nothing looks at.
pub(super) const UNUSED_SRDF: &str =
    "srdf says which links may touch, and self_collision is false; true is accepted";

/// The path of the file that the settings call `name` at `key`, and what `read` makes of it.
///
/// # Errors
/// There is no such file, reported at the key; those of `read`.
pub(super) fn input<T>(
    settings: &Settings,
    inputs: &Inputs,
    key: &str,
    name: &str,
    read: impl FnOnce(&Path) -> Result<T, SettingsError>,
) -> Result<(PathBuf, T), SettingsError> {
    let file = inputs.locate(name).map_err(|message| settings.error_at(key, message))?;
    let value = read(&file)?;
    Ok((file, value))
}

/// The robot in `file`, which the settings name at `robot`, with what they have under `robot_with` laid over the file, and with
/// what the SRDF file that they name at `srdf` says; read once.
///
/// # Errors
/// What is wrong in the file, at its place there; what has no place there or is laid over it, at the key.
pub(super) fn load_robot(
    (settings, inputs): (&Settings, &Inputs),
    file: &Path,
    with: Option<&Table>,
    srdf: Option<&Path>,
) -> Result<Robot, SettingsError> {
    let srdf_name = srdf.map_or_else(String::new, |srdf| srdf.display().to_string());
    inputs.once(format!("{}\n{srdf_name}", named(file, with)), || read_robot(settings, file, with, srdf))
}

/// A file and what is laid over it.
fn named(file: &Path, with: Option<&Table>) -> String {
    format!("{}\n{}", file.display(), with.map_or_else(String::new, Table::to_string))
}

fn read_robot(
    settings: &Settings,
    file: &Path,
    with: Option<&Table>,
    srdf: Option<&Path>,
) -> Result<Robot, SettingsError> {
    let loaded = match (with, srdf) {
        (None, None) => Robot::load(file),
        (None, Some(srdf)) if file.extension().is_some_and(|end| end == "urdf") => {
            Robot::load_with_srdf(file, srdf)
        }
        (_, Some(_)) => {
            let message = "srdf is given, and the robot is no URDF file as it is; such a file without robot_with is accepted";
            return Err(settings.error_at("srdf", message));
        }
        (Some(with), None) => Robot::parse(overlaid(settings, ROBOT_WITH, with, file)?.text(), file),
    };
    loaded.map_err(|error| match error {
        KinematicsError::File(fault) if with.is_some() => settings.error_at(ROBOT_WITH, fault.message()),
        KinematicsError::File(fault) => fault,
        other => settings.error_at("robot", other.to_string()),
    })
}

/// What `read` makes of the scene in `file`, with what the settings have under `scene_with` laid over it; read once.
///
/// # Errors
/// As [`load_robot`].
pub(super) fn load_scene<S: Clone + Send + Sync + 'static>(
    (settings, inputs): (&Settings, &Inputs),
    file: &Path,
    with: Option<&Table>,
    read: impl FnOnce(&Arc<Document>) -> Result<S, SettingsError>,
) -> Result<S, SettingsError> {
    inputs.once(named(file, with), || {
        let Some(with) = with else { return read(&Document::open(file)?) };
        let document = overlaid(settings, SCENE_WITH, with, file)?;
        read(&document).map_err(|fault| settings.error_at(SCENE_WITH, fault.message()))
    })
}
