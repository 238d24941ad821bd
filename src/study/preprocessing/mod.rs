//! Preprocessed objects, which are costly to build and shared by many trials; one a file, all in [`REGISTRY`].

pub mod lattice;
pub mod nested_roadmap;
pub mod polyhedra;
pub mod workspace_map;

use engine::planner::{Counts, Trace};
use engine::space::World;

/// A preprocessed object.
#[derive(Debug)]
pub struct Preprocessing {
    /// What planners plan in.
    pub world: World,
    /// What was measured while building it.
    pub values: Counts,
    /// What figures need of it.
    pub traces: Vec<Trace>,
}

/// A registered kind of preprocessed object.
#[derive(Debug)]
pub struct Entry {
    /// Its name; also its file's name.
    pub name: &'static str,
    /// One line for `replan list`.
    pub about: &'static str,
    /// The columns of its rows.
    pub columns: &'static [&'static str],
}

/// Every kind, in the order of their names.
pub static REGISTRY: &[&Entry] =
    &[&lattice::ENTRY, &nested_roadmap::ENTRY, &polyhedra::ENTRY, &workspace_map::ENTRY];

/// The entry called `name`.
pub fn find(name: &str) -> Option<&'static Entry> {
    REGISTRY.iter().copied().find(|entry| entry.name == name)
}
