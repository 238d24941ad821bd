//! `replan repro`: from the spec to the verdicts.

use super::consent::Consent;
use super::counted;
use super::load::open;
use super::places::Places;
use super::progress::{safe_point, stop_flag};
use super::run::run_studies;
use super::stamp::Stamp;
use super::summary::summary;
use super::verdicts::COLUMNS;
use super::{Again, Failure, How, Which, findings, trial, verdicts};
use super::{judge, render};
use crate::analysis::verdict::Verdicts;
use crate::render::output::{CROSSCHECK, Outputs};
use crate::render::prose::wrapped;
use clap::Args;
use std::sync::atomic::AtomicBool;
use study::lock::Lock;
use study::manifest::MadeBy;
use study::paper::Paper;

/// Reproduces a paper.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Repro {
    #[command(flatten)]
    which: Which,
    #[command(flatten)]
    how: How,
    #[command(flatten)]
    again: Again,
    #[command(flatten)]
    consent: Consent,
    /// Run one trial, print it, and compare it with its stored row
    #[arg(long, value_name = "STUDY/TRIAL")]
    trial: Option<String>,
    /// List every study and every claim, not the headline claims alone
    #[arg(long)]
    all: bool,
}

const EXAMPLES: &str = "Examples:
  replan repro zhang
  replan repro zhang --quick          few instances, below target/replan/
  replan repro zhang --trial witness/w1/a-star  one trial beside its stored row";

impl Repro {
    /// Runs the command.
    pub fn run(self) -> Result<(), Failure> {
        MadeBy::here();
        let (places, paper) = open(&self.which, &self.how)?;
        self.consent.check(&paper.studies, &places)?;
        if let Some(name) = &self.trial {
            return trial::run(&paper, &places, &self.how, name);
        }
        render::check_report(&paper, &places)?;
        self.how.check_interpretations(&paper)?;
        let lock = Lock::take(&places.runs)?;
        let stop = stop_flag();
        let reports = run_studies(&paper, &places, &self.how, &lock, self.again)?;
        let (stored, run): (Vec<_>, Vec<_>) =
            reports.iter().partition(|report| !self.all && report.is_stored());
        for report in run {
            say!("{}", summary(report, false));
        }
        if !stored.is_empty() {
            say!(
                "{}: nothing to run, the stored trials are current",
                counted(stored.len(), ["study", "studies"])
            );
        }
        safe_point(stop, "the records are kept")?;
        let point = self.how.interpretation(&paper.choices)?;
        let judged = judge::judge_changes(&paper, &point, &places, self.again)?;
        if self.all {
            verdicts::print(Some(&paper), &judged, &self.which);
        } else {
            findings::print(&paper, &judged, &self.which);
        }
        let outputs = draw(&paper, &places, &judged, self.again, stop)?;
        // What is not stored in its usual place is not what `show` reads.
        if !self.all && !self.how.quick && self.how.with.is_none() && self.how.seed.is_none() {
            let [show, report] = ["show", "report"].map(|name| self.which.command(name));
            let hint = format!("why: {show} NAME; all: {show}; page: {report} --open");
            say!("{}", wrapped("", &hint, 2, COLUMNS));
        }
        let written = [&places.runs, &places.plots, &places.report].map(|path| path.display().to_string());
        say!("{}", wrapped("", &format!("written: {}", written.join(", ")), 2, COLUMNS));
        render::all_drawn(&outputs)?;
        judge::must_hold(&judged)
    }
}

/// Draws what is not drawn yet of what was `judged`.
fn draw(
    paper: &Paper,
    places: &Places,
    judged: &Verdicts,
    again: Again,
    stop: &AtomicBool,
) -> Result<Outputs, Failure> {
    // The chapter leads to the cross-check where there is one.
    let crosscheck = places.plots.join(CROSSCHECK).is_file().to_string();
    let stamp = Stamp::new("drawn", paper, places, &[judged.text(), crosscheck])?;
    if !again.fresh && stamp.is_current() {
        say!("nothing to draw: figures, tables and the report are as they were drawn from this");
        return Ok(Outputs::default());
    }
    let outputs = render::write(paper, places, stop)?;
    if outputs.undrawn.is_empty() {
        let files = outputs.files.iter().map(|output| places.plots.join(&output.name));
        stamp.keep(files.chain([places.report.clone()]));
    }
    Ok(outputs)
}
