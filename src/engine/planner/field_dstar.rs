//! Field D\* between corners of cells, as one search from start to goal.

use super::corners::{self, TiesAlone};
use super::lattice::COLUMNS_DISTINCT;
use super::{Build, Entry};
use crate::search::{BucketHeap, Interpolated};
use base::settings::Accepted;
use world::space::WorldKind;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "field_dstar",
    about: "Field D*: costs are interpolated along edges of cells, over which its path leads anywhere; searched once",
    revision: 1,
    needs: WorldKind::CornerLattice,
    columns: COLUMNS_DISTINCT,
    settings: Accepted::shape::<TiesAlone>(),
    example: r#"
ties = "larger_g"
"#,
    build: Build::Planner(corners::built::<Interpolated<BucketHeap>>),
};
