//! Input files that a family's settings name, each fault of one at its own place.

use crate::Inputs;
use base::settings::{Settings, SettingsError};
use engine::kinematics::{KinematicsError, Robot};
use std::path::{Path, PathBuf};

/// Where the file is that the settings call `name` at `key`, and what `read` makes of it.
///
/// # Errors
/// There is no such file, told at the key; those of `read`.
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

/// The robot in `file`, which the settings name at `robot`.
///
/// # Errors
/// What is wrong in the file, at its place there; what has no place there, at the key.
pub(super) fn load_robot(settings: &Settings, file: &Path) -> Result<Robot, SettingsError> {
    Robot::load(file).map_err(|error| match error {
        KinematicsError::File(fault) => fault,
        other => settings.error_at("robot", other.to_string()),
    })
}
