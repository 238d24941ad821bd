//! `replan run`: the trials, and nothing after them.

use super::consent::Consent;
use super::load::open;
use super::places::Places;
use super::progress::{Bar, doing};
use super::rounds::at_work;
use super::sharded::{Sharded, options};
use super::summary::summary;
use super::{Again, Failure, How, Which, command_line};
use crate::analysis::history::History;
use clap::Args;
use std::path::Path;
use study::Study;
use study::lock::Lock;
use study::manifest::MadeBy;
use study::paper::Paper;
use study::plan::Plan;
use study::session::{self, Options, Report};
use study::shard;

/// Runs the studies of a paper.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Run {
    #[command(flatten)]
    which: Which,
    #[command(flatten)]
    how: How,
    #[command(flatten)]
    again: Again,
    #[command(flatten)]
    consent: Consent,
    /// Time every stored study with `[timing]` once more, as a session of its own; run nothing else
    #[arg(long, conflicts_with_all = ["fresh", "shard"])]
    clock: bool,
    /// Explain why stored trials were or were not reused
    #[arg(long)]
    why: bool,
    /// Run only this shard of N and keep it below --out for `replan merge`
    #[arg(long, value_name = "K/N", value_parser = shard::parse, requires = "out")]
    shard: Option<(usize, usize)>,
}

const EXAMPLES: &str = "Examples:
  replan run zhang                    run what is stale, reuse the rest
  replan run zhang --quick --why      few instances; why trials were not reused
  replan run zhang --with ties=lifo --out target/lifo";

impl Run {
    /// Runs the command.
    pub fn run(self) -> Result<(), Failure> {
        MadeBy::here();
        if let (Some((number, of)), Some(folder)) = (self.shard, &self.which.out) {
            check_is_run(folder)?;
            let sharded = Sharded::load(&self.which.paper, &self.how)?;
            return sharded.run_shard((number, of), folder, (self.again, self.consent), self.why);
        }
        let (places, paper) = open(&self.which, &self.how)?;
        self.how.check_interpretations(&paper)?;
        self.consent.check(&paper.studies, &places)?;
        let lock = Lock::take(&places.runs)?;
        if self.clock {
            return between_notes(&paper, &lock, || read_clocks(&paper, &places, &self.how, &lock));
        }
        for report in run_studies(&paper, &places, &self.how, &lock, self.again)? {
            say!("{}", summary(&report, self.why));
        }
        say!("records are in {}", places.runs.display());
        Ok(())
    }
}

/// Refuses a folder that holds parts of an exploration or a confirmation.
pub fn check_is_run(parts: &Path) -> Result<(), Failure> {
    let folder = at_work(parts);
    if folder == parts {
        return Ok(());
    }
    let plan = Plan::path(&folder);
    Err(Failure::input(format!(
        "{}: the parts here are of another command than `run`; another folder is accepted",
        plan.display()
    )))
}

/// Runs the stale parts of every study of `paper`, and the studies or parts that `again` names.
pub fn run_studies(
    paper: &Paper,
    places: &Places,
    how: &How,
    lock: &Lock,
    again: Again,
) -> Result<Vec<Report>, Failure> {
    doing(&format!("{}: looking for what has changed since it was run", paper.id));
    let run = |study| run_study(study, places, how, lock, again);
    between_notes(paper, lock, || paper.studies.iter().map(run).collect())
}

/// Runs something of `paper`: what its claims mean is written down before their data can be seen, and the records afterwards.
fn between_notes<T>(
    paper: &Paper,
    lock: &Lock,
    run: impl FnOnce() -> Result<T, Failure>,
) -> Result<T, Failure> {
    History::note(paper, lock.folder(), &command_line())?;
    let done = run()?;
    History::note(paper, lock.folder(), &command_line())?;
    Ok(done)
}

/// Runs what is stale of one study.
fn run_study(
    study: &Study,
    places: &Places,
    how: &How,
    lock: &Lock,
    again: Again,
) -> Result<Report, Failure> {
    let points = how.interpretations(study)?;
    let bar = Bar::default();
    let options = options((&points, &bar), places, how, lock);
    Ok(session::run(study, &Options { again: again.into(), ..options })?)
}

/// Reads the clock of every timed study once more.
fn read_clocks(paper: &Paper, places: &Places, how: &How, lock: &Lock) -> Result<(), Failure> {
    for study in paper.studies.iter().filter(|study| study.timing.is_some()) {
        let points = how.interpretations(study)?;
        let bar = Bar::default();
        let number = session::read_clock(study, &options((&points, &bar), places, how, lock))?;
        say!("{}: session {number} of the clock", study.name);
    }
    Ok(())
}
