//! Jump point search with preprocessing: JPS+, with intermediate pruning.
//!
//! It expands what [`jps`](super::jps) expands, in the same order, and looks distances up instead of scanning for them.
//! Every corner rule is supported. The table ([`JumpTable`]) takes 16 bytes for each cell; `preprocessing_bytes` counts them.
//! It belongs to the world and is made when it is first needed, so that all contenders share it. No clock reading
//! counts it: a study plans every query once before it times it. With `preparation = "each_query"` every query makes
//! the table anew: in a study that has both contenders, the difference of their clock readings is the cost of
//! preprocessing.
//!
//! # Source
//! Harabor & Grastien, *Improving jump point search*, ICAPS 2014, sections 5 and 6.

use super::jump_points::{COLUMNS, JumpPoints, built};
use super::{Build, Entry};
use base::settings::Accepted;
use world::space::WorldKind;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "jps_plus",
    about: "jump point search over a table of distances to jump points, made once for each map: least cost",
    revision: 1,
    needs: WorldKind::CentreLattice,
    columns: COLUMNS,
    settings: Accepted::shape::<JumpPoints>(),
    example: "preparation = \"kept\"",
    build: Build::Planner(|settings| built(settings, true)),
};
