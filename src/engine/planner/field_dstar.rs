//! Field D\* between corners of cells, as one search from start to goal.

use super::corners;
use super::lattice::COLUMNS_DISTINCT;
use super::{Build, Entry, Planner};
use crate::search::{BucketHeap, FieldRules, Interpolated, Ties};
use base::settings::{Accepted, Settings, SettingsError};
use schemars::JsonSchema;
use serde::Deserialize;
use world::space::WorldKind;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "field_dstar",
    about: "Field D*: costs are interpolated along edges of cells, over which its path leads anywhere; searched once",
    revision: 1,
    needs: WorldKind::CornerLattice,
    columns: COLUMNS_DISTINCT,
    settings: Accepted::shape::<FieldSettings>(),
    example: r#"
ties = "larger_g"
interpolates = "opened"
extraction = "looks_ahead"
"#,
    build: Build::Planner(build),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct FieldSettings {
    /// The order among equal f.
    ties: Ties,
    /// Between which corners costs are interpolated; `opened` if absent.
    interpolates: Option<Interpolates>,
    /// How a step of the path is chosen; `looks_ahead` if absent.
    extraction: Option<Extraction>,
}

#[derive(Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
enum Interpolates {
    /// All corners that have a cost by then.
    Opened,
    /// Corners that were expanded, whose costs no longer change.
    Expanded,
}

#[derive(Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
enum Extraction {
    /// By the best step that follows it.
    LooksAhead,
    /// By the interpolated cost where it ends.
    Interpolated,
}

fn build(settings: &Settings) -> Result<Box<dyn Planner>, SettingsError> {
    let FieldSettings { ties, interpolates, extraction } = settings.read()?;
    let rules = FieldRules {
        only_expanded: matches!(interpolates, Some(Interpolates::Expanded)),
        looks_ahead: !matches!(extraction, Some(Extraction::Interpolated)),
    };
    Ok(corners::planner(move || Interpolated::new(BucketHeap::new(ties), rules)))
}
