//! The interface of problem families, and how an entry describes itself.

use crate::StudyError;
use crate::inputs::Inputs;
use crate::preprocessing::Preprocessing;
use base::settings::{Accepted, Settings, SettingsError};
use engine::planner::{Counts, Invalid};
use engine::space::roadmap::Extent;
use engine::space::{World, WorldKind};
use std::path::PathBuf;

/// One query of a preprocessed object.
#[derive(Debug, Clone, PartialEq)]
pub struct Query {
    /// Its name within the instance; empty where an instance has one query only.
    pub name: String,
    /// The start configuration; empty where it is drawn with an instance that is not known.
    pub start: Vec<f64>,
    /// The goal configuration; likewise.
    pub goal: Vec<f64>,
}

impl Query {
    /// Its start and its goal.
    pub fn ends(&self) -> [&[f64]; 2] {
        [&self.start, &self.goal]
    }
}

/// Where the parts of an arm are at one configuration, in millimetres.
#[derive(Debug, Clone, PartialEq)]
pub struct ArmPlacement {
    /// Both ends and the radius of each capsule, x, y, z, x, y, z, radius.
    pub capsules_mm: Vec<[f64; 7]>,
    /// The tip.
    pub tip_mm: [f64; 3],
    /// From the arm's surface to the nearest obstacle; `None` where the family has no distance.
    pub clearance_mm: Option<f64>,
}

/// A family with its settings.
pub trait Family: Send + Sync {
    /// The kind of world its problems are posed in.
    fn world(&self) -> WorldKind;

    /// The preprocessed object that belongs to `seed`.
    ///
    /// # Errors
    /// [`Invalid`] if this instance cannot be posed; its trials are then rows with that status.
    fn prepare(&self, seed: u64) -> Result<Preprocessing, Invalid>;

    /// The world of [`prepare`](Self::prepare) alone, for those who draw many and keep few.
    ///
    /// # Errors
    /// As [`prepare`](Self::prepare).
    fn draw(&self, seed: u64) -> Result<World, Invalid> {
        self.prepare(seed).map(|preprocessing| preprocessing.world)
    }

    /// The queries of every instance: their names and, where nothing of them is drawn, their ends.
    fn queries(&self) -> &[Query];

    /// The queries of the instance that belongs to `seed`, of the same names: those of every instance, unless the family draws
    /// their ends.
    fn queries_for(&self, seed: u64) -> Vec<Query> {
        let _ = seed;
        self.queries().to_vec()
    }

    /// The noun for its instances, in the plural, where the settings make them others than the registry says.
    fn instances(&self) -> Option<&'static str> {
        None
    }

    /// Whether it holds a problem for each instance: the seed of an instance is then its number.
    fn numbers_instances(&self) -> bool {
        false
    }

    /// What must be installed before its problems can be posed; `None` if nothing must.
    fn lacks(&self) -> Option<String> {
        None
    }

    /// Whether starts or goals are drawn with each instance.
    fn draws_ends(&self) -> bool {
        false
    }

    /// Checks that every start and goal written in its settings or files is free.
    ///
    /// # Errors
    /// Those that are not, each at its place.
    fn check_ends(&self) -> Result<(), SettingsError> {
        Ok(())
    }

    /// About how many cells, samples or the like an instance is made of.
    fn cells(&self) -> u64;

    /// How large its roadmaps are, if it poses problems on roadmaps.
    fn extent(&self) -> Option<Extent> {
        None
    }

    /// What the problem itself says about its query number `query`, for every trial's row: an optimum printed with
    /// it, say.
    fn known(&self, _query: usize) -> Counts {
        Counts::new()
    }

    /// Where its arm is with its joints at `q_rad`; `None` without an arm, or for another number of joints.
    fn stance(&self, q_rad: &[f64]) -> Option<ArmPlacement> {
        let _ = q_rad;
        None
    }

    /// What a reader of results should know of how its files were taken, a sentence each.
    fn notes(&self) -> Vec<String> {
        Vec::new()
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
    /// The noun for its instances, in the plural: readers count maps or roadmaps.
    pub instances: &'static str,
    /// Raised whenever a change moves what it draws.
    pub revision: u32,
    /// Whether its seed decides anything of what it poses: a single instance is then one of many, not the paper's own.
    pub is_drawn: bool,
    /// The kind of preprocessed object it builds.
    pub preprocessing: &'static str,
    /// The columns that every trial on its problems has.
    pub columns: &'static [&'static str],
    /// The shape of its settings, which documents them.
    pub settings: Accepted,
    /// Settings that it can be built from, as TOML: for `replan list`, and for a test that builds it from them.
    pub example: &'static str,
    /// How to build it from its settings.
    pub build: fn(&Settings, &Inputs) -> Result<Box<dyn Family>, StudyError>,
}
