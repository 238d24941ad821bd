//! Jump point search, online: runs are scanned in blocks, intermediate jump points are pruned (B + P).
//!
//! Counters and ties are defined with [`JumpSearch`](crate::search::JumpSearch). Every corner rule is supported. The planner
//! needs bits of rows and columns ([`JumpLines`]), about one byte for each cell; `preprocessing_bytes` counts them. They are
//! made in one pass over the map and shared by all queries. With `preparation = "each_query"` every query makes them
//! anew: in a study that has both contenders, the difference of their clock readings is the cost of preparation.
//!
//! # Source
//! Harabor & Grastien, *Online graph pruning for pathfinding on grid maps*, AAAI 2011; *Improving jump point search*,
//! ICAPS 2014, sections 4 and 5.

use super::jump_points::{COLUMNS, JumpPoints, built};
use super::{Build, Entry};
use base::settings::Accepted;
use world::space::WorldKind;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "jps",
    about: "jump point search, online, with block-based scanning and intermediate pruning: least cost",
    revision: 1,
    needs: WorldKind::CentreLattice,
    columns: COLUMNS,
    settings: Accepted::shape::<JumpPoints>(),
    example: "preparation = \"kept\"",
    build: Build::Planner(|settings| built(settings, false)),
};
