//! `replan merge`: the parts of a run that was cut into shards, put together.

use super::Failure;
use super::sharded::Sharded;
use crate::study::lock::Lock;
use crate::study::manifest::MadeBy;
use crate::study::merge::Parts;
use crate::study::plan::Plan;
use clap::Args;
use std::path::PathBuf;

/// Puts parts together.
#[derive(Args)]
pub struct Merge {
    /// The folder that the shards were run into
    parts: PathBuf,
    /// Write below this folder, as `replan run --out` would
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
}

impl Merge {
    /// Runs the command.
    pub fn run(self) -> Result<(), Failure> {
        MadeBy::here();
        let plan = Plan::read(&self.parts)?;
        let sharded = Sharded::of_plan(&plan, self.out.clone())?;
        let studies = sharded.studies()?;
        let parts = Parts::checked(&plan, &self.parts, &studies)?;
        let runs = &sharded.places.runs;
        let lock = Lock::take(runs)?;
        for ((place, study), (built, manifest)) in sharded.paper.studies.iter().enumerate().zip(&studies) {
            let trials = parts.merge((place, study), built, manifest.clone(), lock.folder())?;
            say!("{}: {trials} trials of {} parts", study.name, plan.shards);
        }
        say!("records are in {}", runs.display());
        if sharded.paper.studies.iter().any(|study| study.timing.is_some()) {
            let command = plan.unsharded(&self.out);
            say!("no clock was read; one machine reads it: replan {}", command.join(" "));
        }
        Ok(())
    }
}
