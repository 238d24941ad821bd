//! Studies: from a spec to what happened.
//!
//! [`Study::load`] turns a spec into checked types; [`run`](session::run) turns these into records that
//! [`store`] keeps; [`manifest`] says what the records depend on. Families pose problems, prepared objects are
//! what many trials share, tasks say what is done with both. Nothing here judges a claim or draws a figure.

mod checked;
pub mod clock;
pub mod column;
pub mod endpoint_variants;
mod error;
pub mod family;
pub mod lock;
pub mod manifest;
pub mod paper;
pub mod prepared;
mod reading;
pub mod record;
pub mod rerun;
pub mod runner;
pub mod session;
pub mod spec;
pub mod store;
pub mod task;
pub mod verification;

pub use checked::{Contender, Families, Group, StageUse, Study, Sweep, slug};
pub use error::StudyError;
pub use reading::{Reading, ReadingChoice};

use std::path::PathBuf;

/// Where input files named by specs are looked for, in order.
#[derive(Debug, Clone, Default)]
pub struct Inputs {
    /// Folders that relative paths start from.
    pub roots: Vec<PathBuf>,
}

impl Inputs {
    /// The first existing file called `name` below the roots.
    ///
    /// # Errors
    /// A message that lists every place looked at.
    pub fn locate(&self, name: &str) -> Result<PathBuf, String> {
        let tried: Vec<PathBuf> = self.roots.iter().map(|root| root.join(name)).collect();
        if let Some(file) = tried.iter().find(|path| path.is_file()) {
            return Ok(file.clone());
        }
        if let Some(folder) = tried.iter().find(|path| path.is_dir()) {
            return Err(format!(
                "input file `{name}` is a folder ({}); a file is accepted",
                folder.display()
            ));
        }
        let places: Vec<String> = tried.iter().map(|path| path.display().to_string()).collect();
        Err(format!("input file `{name}` does not exist; looked for {}", places.join(", ")))
    }
}
