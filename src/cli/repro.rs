//! `replan repro`: from the spec to the verdicts.

use super::places::Places;
use super::run::{load, run_studies, summary};
use super::{Failure, How, Which, trial, verdicts};
use super::{judge, render};
use clap::Args;

/// Reproduces a paper.
#[derive(Args)]
pub struct Repro {
    #[command(flatten)]
    which: Which,
    #[command(flatten)]
    how: How,
    /// Run one trial alone, print it, and say whether it equals the stored row
    #[arg(long, value_name = "STUDY/TRIAL")]
    trial: Option<String>,
}

impl Repro {
    /// Runs the command.
    pub fn run(self) -> Result<(), Failure> {
        let places = Places::find(&self.which, &self.how.variant())?;
        let paper = load(&places, &self.how)?;
        if let Some(name) = &self.trial {
            return trial::run(&paper, &places, &self.how, name);
        }
        for report in run_studies(&paper, &places, &self.how, true)? {
            say!("{}", summary(&report, false));
        }
        let point = self.how.point(&paper.readings())?;
        let judged = judge::judge(&paper, point, &places)?;
        render::write(&paper, &places)?;
        verdicts::print(&judged);
        say!(
            "records and verdicts are in {}, figures and tables in {}, the report in {}",
            places.runs.display(),
            places.plots.display(),
            places.report.display()
        );
        Ok(())
    }
}
