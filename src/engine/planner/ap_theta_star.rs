//! Angle-propagation Theta\* between corners of cells.
//!
//! # Source
//! Daniel, Nash, Koenig & Felner, *Theta\*: Any-Angle Path Planning on Grids*, JAIR 39 (2010), section 6.

use super::corners::{self, TiesAlone};
use super::lattice::COLUMNS_DISTINCT;
use super::{Build, Entry};
use crate::search::{AngleRanges, BucketHeap};
use base::settings::Accepted;
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
    build: Build::Planner(corners::built::<AngleRanges<BucketHeap>>),
};
