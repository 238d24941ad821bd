//! Lazy Theta\* on 8-connected grids: paths bend at vertices, which are centres of cells or their corners, and may go in any direction.
//!
//! # Source
//! Nash, Koenig & Tovey, *Lazy Theta\*: Any-Angle Path Planning and Path Length Analysis in 3D*, AAAI 2010.

use super::any_angle::{AnyAngleSettings, COLUMNS, built};
use super::{Build, Entry};
use crate::search::When;
use base::settings::Accepted;
use world::space::WorldKind;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "lazy_theta_star",
    about: "Lazy Theta*: any-angle A*, a line of sight looked at for each node taken from OPEN",
    revision: 2,
    needs: WorldKind::Lattice,
    columns: COLUMNS,
    settings: Accepted::shape::<AnyAngleSettings>(),
    example: r#"
line_of_sight = "exact_interior"
ties = "fifo"
"#,
    build: Build::Planner(|settings| built(settings, When::Taken)),
};
