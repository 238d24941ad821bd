//! `replan run`: the trials, and nothing after them.

use super::file_schema::of_any_names;
use super::places::Places;
use super::progress::{Bar, stop_flag};
use super::{Failure, How, Which, command_line};
use crate::analysis::claims;
use crate::study::lock::Lock;
use crate::study::manifest::MadeBy;
use crate::study::paper::Paper;
use crate::study::session::{self, Options, Report, UnexpectedStatus};
use base::settings::Faults;
use clap::Args;

/// Runs the studies of a paper.
#[derive(Args)]
pub struct Run {
    #[command(flatten)]
    which: Which,
    #[command(flatten)]
    how: How,
    /// Run every trial again, also those that are stored and unchanged
    #[arg(long)]
    fresh: bool,
    /// Say why stored trials were or were not reused
    #[arg(long)]
    why: bool,
}

impl Run {
    /// Runs the command.
    pub fn run(self) -> Result<(), Failure> {
        MadeBy::here();
        let places = Places::find(&self.which, &self.how.variant())?;
        let paper = load(&places, &self.how)?;
        self.how.check_points(&paper)?;
        let lock = Lock::take(&places.runs)?;
        for report in run_studies(&paper, &places, &self.how, &lock, self.fresh)? {
            say!("{}", summary(&report, self.why));
        }
        say!("records are in {}", places.runs.display());
        Ok(())
    }
}

/// The paper as far as it can be read, with every claim's checks, figure and table understood; everything that is wrong goes
/// to `faults`.
pub fn gather(places: &Places, faults: &mut Faults) -> Result<Option<Paper>, Failure> {
    let paper = Paper::gather(&places.folder, &places.inputs, &of_any_names, faults)?;
    if let Some(paper) = &paper {
        faults.keep(claims::validate(paper));
        faults.keep(crate::render::figure::validate(paper));
        faults.keep(crate::render::results::validate(paper));
    }
    Ok(paper)
}

/// The paper as the flags ask for it.
pub fn load(places: &Places, how: &How) -> Result<Paper, Failure> {
    let mut faults = Faults::default();
    let paper = gather(places, &mut faults)?;
    let Some(paper) = paper.filter(|_| faults.is_empty()) else { return Err(faults.error().into()) };
    let paper = how.apply(paper);
    how.check_readings(&paper)?;
    Ok(paper)
}

/// Runs what is stale of every study of `paper`; everything with `fresh`.
pub fn run_studies(
    paper: &Paper,
    places: &Places,
    how: &How,
    lock: &Lock,
    fresh: bool,
) -> Result<Vec<Report>, Failure> {
    let (stop, bar) = (stop_flag(), Bar::default());
    let mut reports = Vec::new();
    for study in &paper.studies {
        let points = how.points(study)?;
        let options = Options {
            lock,
            points: &points,
            inputs: &places.inputs,
            command: command_line(),
            claims: claims::claims_hash(paper),
            quick: how.quick,
            fresh,
            threads: how.threads.map(|threads| threads as usize),
            stop,
            progress: &bar,
        };
        reports.push(session::run(study, &options)?);
    }
    Ok(reports)
}

/// What a run did, in a few words.
pub fn summary(report: &Report, why: bool) -> String {
    let mut text = format!("{}: {} trials", report.manifest.study, report.trials);
    let parts = [
        (report.resumed, report.units, "units resumed"),
        (report.reused, report.units, "units reused"),
        (report.kept, report.trials, "trials reused"),
    ];
    let parts = parts.iter().filter(|(count, ..)| *count > 0);
    let said: Vec<String> = parts.map(|(count, all, what)| format!("{count} of {all} {what}")).collect();
    if !said.is_empty() {
        text += &format!(" ({})", said.join(", "));
    }
    for UnexpectedStatus { status, count, trial, reason } in &report.odd {
        text += &format!("\n  {count} {status}; the first is {}/{trial}: {reason}", report.manifest.study);
    }
    if !report.moved.is_empty() {
        let first = &report.moved[0];
        text += &format!(
            "\n  {} trials differ from what was stored although nothing they depend on has changed; the first is \
             {}/{first}",
            report.moved.len(),
            report.manifest.study
        );
    }
    if why {
        let reasons = if report.why.is_empty() && report.reused > 0 {
            vec!["nothing that the stored trials depend on has changed".to_owned()]
        } else if report.why.is_empty() {
            vec!["there were no stored trials, or --fresh was given".to_owned()]
        } else {
            report.why.clone()
        };
        for reason in reasons {
            text += &format!("\n  why: {reason}");
        }
    }
    text
}
