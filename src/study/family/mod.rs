//! Problem families: one a file, all in [`REGISTRY`].
//!
//! A family poses problems: it draws what is to be prepared from a seed, and names its queries. Its settings come from the study,
//! with the interpretation's options laid on top.

mod arm_workspace;
pub(super) mod cell_queries;
mod conditioned;
mod drawn_scene;
mod ends;
mod entry;
mod grid_map;
mod input;
mod joint_problems;
mod joint_queries;
mod movingai;
mod overlay;
pub(super) mod plane_queries;
mod polyhedra_scene;
mod random_bars;
mod random_cells;
mod random_maps;
mod random_polyhedra;
mod random_rectangles;
mod recorded;

pub use entry::{ArmPlacement, Entry, Family, Query};
pub(super) use overlay::lay;

/// Every family, in the order of their names.
pub static REGISTRY: &[&Entry] = &[
    &arm_workspace::ENTRY,
    &cell_queries::ENTRY,
    &conditioned::ENTRY,
    &grid_map::ENTRY,
    &joint_problems::ENTRY,
    &joint_queries::ENTRY,
    &movingai::ENTRY,
    &plane_queries::ENTRY,
    &polyhedra_scene::ENTRY,
    &random_bars::ENTRY,
    &random_cells::ENTRY,
    &random_polyhedra::ENTRY,
    &random_rectangles::ENTRY,
    &recorded::ENTRY,
];

/// The entry called `name`.
pub fn find(name: &str) -> Option<&'static Entry> {
    REGISTRY.iter().copied().find(|entry| entry.name == name)
}
