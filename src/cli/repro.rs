//! `replan repro`: from the spec to the verdicts.

use super::load::load;
use super::places::Places;
use super::progress::{safe_point, stop_flag};
use super::run::{run_studies, summary};
use super::{Again, Failure, How, Which, trial, verdicts};
use super::{judge, render};
use crate::study::lock::Lock;
use crate::study::manifest::MadeBy;
use clap::Args;

/// Reproduces a paper.
#[derive(Args)]
pub struct Repro {
    #[command(flatten)]
    which: Which,
    #[command(flatten)]
    how: How,
    #[command(flatten)]
    again: Again,
    /// Run one trial alone, print it, and say whether it equals the stored row
    #[arg(long, value_name = "STUDY/TRIAL")]
    trial: Option<String>,
}

impl Repro {
    /// Runs the command.
    pub fn run(self) -> Result<(), Failure> {
        MadeBy::here();
        let places = Places::find(&self.which, &self.how.variant())?;
        let paper = load(&places, &self.how)?;
        if let Some(name) = &self.trial {
            return trial::run(&paper, &places, &self.how, name);
        }
        render::check_report(&paper, &places)?;
        self.how.check_points(&paper)?;
        let (lock, stop) = (Lock::take(&places.runs)?, stop_flag());
        for report in run_studies(&paper, &places, &self.how, &lock, self.again)? {
            say!("{}", summary(&report, false));
        }
        safe_point(stop, "the records are kept")?;
        let point = self.how.point(&paper.readings())?;
        let judged = judge::judge(&paper, point, &places)?;
        verdicts::print(&judged);
        let drawn = render::write(&paper, &places, stop)?;
        say!(
            "records and verdicts are in {}, figures and tables in {}, the report in {}",
            places.runs.display(),
            places.plots.display(),
            places.report.display()
        );
        render::all_drawn(&drawn)
    }
}
