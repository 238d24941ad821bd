//! Kinds of figure: one a file, all in [`REGISTRY`].
//!
//! A kind turns stored records and exhibits into a [`Sheet`]; it runs no trial and draws no statistics of its own.

mod arm_poses;
mod grid_search;
mod motion_curves;
mod polyhedra_paths;
mod polyhedra_scene;
mod saving_over;
mod sweep_curves;

use super::RenderError;
use super::chart::Sheet;
use crate::analysis::evidence::{Evidence, Run};
use crate::analysis::verdict::Verdicts;
use crate::settings::{Settings, SettingsError};
use crate::study::Study;
use crate::study::paper::Paper;
use crate::study::spec::FigureSpec;
use toml::Table;

/// What a figure is drawn from.
pub struct Scene<'a> {
    /// The paper's stored runs.
    pub evidence: &'a Evidence<'a>,
    /// The run of the study that the figure belongs to.
    pub run: &'a Run<'a>,
    /// The paper's verdicts.
    pub verdicts: &'a Verdicts,
}

/// A kind of figure with its settings.
pub trait Kind {
    /// The figure, without its caption.
    ///
    /// # Errors
    /// [`RenderError::NotStored`] if the run lacks what it shows; axes that cannot be drawn.
    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError>;
}

/// A registered kind of figure.
pub struct Entry {
    /// The name that specs use; also its file's name.
    pub name: &'static str,
    /// One line for `replan list`.
    pub about: &'static str,
    /// How to build it from its settings.
    pub build: fn(&Settings, &Study, &Paper) -> Result<Box<dyn Kind>, SettingsError>,
}

/// Every kind, in the order of their names.
pub static REGISTRY: &[&Entry] = &[
    &arm_poses::ENTRY,
    &grid_search::ENTRY,
    &motion_curves::ENTRY,
    &polyhedra_paths::ENTRY,
    &saving_over::ENTRY,
    &sweep_curves::ENTRY,
];

/// The entry called `name`.
pub fn find(name: &str) -> Option<&'static Entry> {
    REGISTRY.iter().copied().find(|entry| entry.name == name)
}

/// Refuses problem groups and contenders that `study` does not have.
fn known(
    settings: &Settings,
    study: &Study,
    groups: &[&str],
    contenders: &[String],
) -> Result<(), SettingsError> {
    for group in groups {
        if !study.groups.iter().any(|known| known.label == *group) {
            let known: Vec<&str> = study.groups.iter().map(|group| group.label.as_str()).collect();
            let message = format!("no problem group is called `{group}`; they are {}", known.join(", "));
            return Err(settings.error(message));
        }
    }
    for contender in contenders {
        if !study.contenders.iter().any(|known| known.label == *contender) {
            let known: Vec<&str> = study.contenders.iter().map(|c| c.label.as_str()).collect();
            let message = format!("no contender is called `{contender}`; they are {}", known.join(", "));
            return Err(settings.error(message));
        }
    }
    Ok(())
}

/// Builds every figure of every study, so that `replan check` finds what is wrong before anything runs.
///
/// # Errors
/// An unknown kind, settings that the kind does not understand, problems or contenders that the study lacks.
pub fn validate(paper: &Paper) -> Result<(), SettingsError> {
    for study in &paper.studies {
        for figure in &study.figures {
            build(figure, study, paper)?;
        }
    }
    Ok(())
}

/// The kind of `figure` with its settings.
///
/// # Errors
/// As [`validate`].
pub fn build(figure: &FigureSpec, study: &Study, paper: &Paper) -> Result<Box<dyn Kind>, SettingsError> {
    let entry = find(figure.kind.get_ref()).ok_or_else(|| {
        let known: Vec<&str> = REGISTRY.iter().map(|entry| entry.name).collect();
        let message = format!(
            "figure `{}` is of kind `{}`, which does not exist; the kinds are {}",
            figure.id.get_ref(),
            figure.kind.get_ref(),
            known.join(", ")
        );
        study.document.error(figure.kind.span(), message)
    })?;
    let settings = match &figure.settings {
        Some(settings) => Settings::written(&study.document, settings),
        None => Settings::composed(format!("figure `{}`", figure.id.get_ref()), Table::new()),
    };
    (entry.build)(&settings, study, paper)
}
