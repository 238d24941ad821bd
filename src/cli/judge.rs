//! `replan judge`: verdicts from stored runs.

use super::places::Places;
use super::{Failure, How, Which, verdicts};
use crate::analysis::claims;
use crate::analysis::evidence::Evidence;
use crate::analysis::verdict::Verdicts;
use crate::study::ReadingChoice;
use crate::study::lock::Lock;
use crate::study::paper::Paper;
use clap::Args;

/// Judges a paper's claims again.
#[derive(Args)]
pub struct Judge {
    #[command(flatten)]
    which: Which,
    /// Judge under these readings, which must have been run: `corner_cutting=forbid_any,ties=lifo`
    #[arg(long, value_name = "READINGS")]
    readings: Option<String>,
}

impl Judge {
    /// Runs the command.
    pub fn run(self) -> Result<(), Failure> {
        let how = How { quick: false, seed: None, readings: self.readings, threads: None };
        let places = Places::find(&self.which, &how.variant())?;
        let paper = super::run::load(&places, &how)?;
        let point = how.point(&paper.readings())?;
        let _lock = if places.runs.is_dir() { Some(Lock::take(&places.runs)?) } else { None };
        verdicts::print(&judge(&paper, point, &places)?);
        Ok(())
    }
}

/// Judges `paper` under `point` by its stored run and writes the verdicts beside it.
pub fn judge(paper: &Paper, point: ReadingChoice, places: &Places) -> Result<Verdicts, Failure> {
    let evidence = Evidence::read(paper, point, &places.runs)?;
    let verdicts = claims::judge(&evidence)?;
    verdicts.write(&places.runs)?;
    Ok(verdicts)
}
