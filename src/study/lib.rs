//! Studies: from a spec to records.
//!
//! [`Paper::load`](paper::Paper::load) turns a spec into checked types; [`run`](session::run) turns these into records
//! that [`store`] keeps; [`manifest`] says what the records depend on. Families pose problems, preprocessed objects are
//! shared by many trials, and tasks decide what is done with both. Nothing here judges a claim or draws a figure.
//!
//! The modules below stand in the order in which they may know each other, lowest first; no circle is allowed.

pub mod clock;
pub mod column;
mod error;
mod inputs;
pub mod key;
pub mod name;
pub mod parquet;
pub mod spec;

mod choice;
pub mod explore;
pub mod record;

pub mod planner;

pub mod contender;
pub mod preprocessing;

pub mod family;
mod group;
pub mod verification;

pub mod unit;

pub mod files;
pub mod task;

mod checked;
mod defaults;
pub mod lock;
pub mod paper;
pub mod store;

pub mod runner;
pub mod shard;

pub mod manifest;

pub mod elsewhere;

pub mod plan;
pub mod reuse;

pub mod session;

pub mod merge;

pub mod rerun;

pub use checked::{Shared, Study, columns_of, elsewhere_mark, labels_of, recorded_mark, sweeps_of};
pub use choice::{Choice, Interpretation};
pub use contender::{Contender, StageUse, Sweep};
pub use error::StudyError;
pub use group::{Families, Group};
pub use inputs::Inputs;
pub use name::slug;
