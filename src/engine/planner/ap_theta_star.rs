//! Angle-propagation Theta\* between corners of cells.
//!
//! # Source
//! Daniel, Nash, Koenig & Felner, *Theta\*: Any-Angle Path Planning on Grids*, JAIR 39 (2010), section 6.

use super::corners;
use super::lattice::COLUMNS_DISTINCT;
use super::{Build, Entry, Planner};
use crate::search::{AngleRanges, BucketHeap, Ties};
use base::settings::{Accepted, Settings, SettingsError};
use schemars::JsonSchema;
use serde::Deserialize;
use world::space::WorldKind;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "ap_theta_star",
    about: "angle-propagation Theta*: ranges of angles, handed on as vertices are expanded, stand for lines of sight",
    revision: 1,
    needs: WorldKind::CornerLattice,
    columns: COLUMNS_DISTINCT,
    settings: Accepted::shape::<TiesAlone>(),
    example: r#"
ties = "smaller_g"
"#,
    build: Build::Planner(build),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct TiesAlone {
    /// The order among equal f.
    ties: Ties,
}

fn build(settings: &Settings) -> Result<Box<dyn Planner>, SettingsError> {
    let TiesAlone { ties } = settings.read()?;
    Ok(corners::planner(move || AngleRanges::new(BucketHeap::new(ties))))
}
