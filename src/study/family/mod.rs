//! Problem families: one a file, all in [`REGISTRY`].
//!
//! A family poses problems: it draws what is to be prepared from a seed, and names the queries that are asked of
//! it. Its settings come from the study, with the reading's options laid on top.

mod arm_workspace;
mod cell_queries;
mod conditioned;
mod grid_map;
mod movingai;
mod plane_queries;
mod polyhedra_scene;
mod random_bars;
mod random_cells;
mod random_polyhedra;
mod random_rectangles;

use super::prepared::Prepared;
use super::{Inputs, StudyError};
use base::settings::{Settings, SettingsError};
use engine::planner::{Counts, Invalid};
use engine::space::roadmap::Extent;
use engine::space::{World, WorldKind};
use std::path::PathBuf;

/// One question asked of a prepared object.
#[derive(Debug, Clone, PartialEq)]
pub struct Query {
    /// Its name within the draw; empty where a draw has one query only.
    pub name: String,
    /// The start configuration.
    pub start: Vec<f64>,
    /// The goal configuration.
    pub goal: Vec<f64>,
}

/// A family with its settings.
pub trait Family: Send + Sync {
    /// The kind of world its problems are posed in.
    fn world(&self) -> WorldKind;

    /// The prepared object that belongs to `seed`.
    ///
    /// # Errors
    /// [`Invalid`] if this draw cannot be posed; its trials are then rows with that status.
    fn prepare(&self, seed: u64) -> Result<Prepared, Invalid>;

    /// The world of [`prepare`](Self::prepare) alone, for those who draw many and keep few.
    ///
    /// # Errors
    /// As [`prepare`](Self::prepare).
    fn draw(&self, seed: u64) -> Result<World, Invalid> {
        self.prepare(seed).map(|prepared| prepared.world)
    }

    /// The queries asked of every draw.
    fn queries(&self) -> &[Query];

    /// The queries asked of the draw that belongs to `seed`: those of every draw, unless the family draws them too.
    fn queries_for(&self, seed: u64) -> Vec<Query> {
        let _ = seed;
        self.queries().to_vec()
    }

    /// That every start and goal written in its settings or files can be stood at.
    ///
    /// # Errors
    /// The first that cannot, at its place.
    fn check_ends(&self) -> Result<(), SettingsError> {
        Ok(())
    }

    /// How large its roadmaps are, if it poses problems on roadmaps.
    fn extent(&self) -> Option<Extent> {
        None
    }

    /// What the problem itself says about its query number `query`, for every trial's row: an optimum printed with
    /// it, say.
    fn known(&self, _query: usize) -> Counts {
        Counts::new()
    }

    /// The files that were read for it.
    fn inputs(&self) -> &[PathBuf] {
        &[]
    }
}

/// A registered family.
#[derive(Debug)]
pub struct Entry {
    /// The name that specs use; also its file's name.
    pub name: &'static str,
    /// One line for `replan list`.
    pub about: &'static str,
    /// Raised whenever a change moves what it draws.
    pub revision: u32,
    /// The kind of prepared object it builds.
    pub prepared: &'static str,
    /// The columns that every trial on its problems has.
    pub columns: &'static [&'static str],
    /// How to build it from its settings.
    pub build: fn(&Settings, &Inputs) -> Result<Box<dyn Family>, StudyError>,
}

/// Every family, in the order of their names.
pub static REGISTRY: &[&Entry] = &[
    &arm_workspace::ENTRY,
    &cell_queries::ENTRY,
    &conditioned::ENTRY,
    &grid_map::ENTRY,
    &movingai::ENTRY,
    &plane_queries::ENTRY,
    &polyhedra_scene::ENTRY,
    &random_bars::ENTRY,
    &random_cells::ENTRY,
    &random_polyhedra::ENTRY,
    &random_rectangles::ENTRY,
];

/// The entry called `name`.
pub fn find(name: &str) -> Option<&'static Entry> {
    REGISTRY.iter().copied().find(|entry| entry.name == name)
}
