//! `replan render`: figures, tables and the report's chapter from the stored run and verdicts.

use super::places::Places;
use super::progress::{safe_point, stop_flag};
use super::{Failure, How, Which};
use crate::analysis::evidence::Evidence;
use crate::analysis::verdict::Verdicts;
use crate::render::output::{self, Output};
use crate::render::report;
use crate::study::ReadingChoice;
use crate::study::lock::Lock;
use crate::study::paper::Paper;
use clap::Args;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

/// Draws a paper's figures and tables again.
#[derive(Args)]
pub struct Render {
    #[command(flatten)]
    which: Which,
    /// Write nothing; say whether what is there is what would be written
    #[arg(long)]
    check: bool,
    /// Only the figure or table with this name (fig5, table2, numbers)
    #[arg(long, value_name = "ID")]
    only: Option<String>,
}

impl Render {
    /// Runs the command.
    pub fn run(self) -> Result<(), Failure> {
        let places = Places::find(&self.which, "")?;
        let how = How { quick: false, seed: None, readings: None, threads: None };
        let paper = super::run::load(&places, &how)?;
        let stop = stop_flag();
        if self.check {
            let drawn = draw(&paper, &places, self.only.as_deref(), stop)?;
            return check(&paper, &places, &drawn);
        }
        check_report(&paper, &places)?;
        let _lock = if places.runs.is_dir() { Some(Lock::take(&places.runs)?) } else { None };
        let drawn = draw(&paper, &places, self.only.as_deref(), stop)?;
        put(&paper, &places, &drawn, stop)?;
        say!("{} files are in {}", drawn.outputs.len(), places.plots.display());
        Ok(())
    }
}

/// What should be on disk.
struct Drawn {
    outputs: Vec<Output>,
    /// The paper's chapter, unless only one figure was asked for.
    chapter: Option<String>,
}

/// Draws everything and writes it.
pub fn write(paper: &Paper, places: &Places, stop: &AtomicBool) -> Result<(), Failure> {
    put(paper, places, &draw(paper, places, None, stop)?, stop)
}

/// Refuses a report that the paper's chapter could not be put into, before anything is written.
pub fn check_report(paper: &Paper, places: &Places) -> Result<(), Failure> {
    report::besides(&places.report, &paper.id)?;
    Ok(())
}

fn draw(paper: &Paper, places: &Places, only: Option<&str>, stop: &AtomicBool) -> Result<Drawn, Failure> {
    let verdicts = Verdicts::read(&places.runs)?;
    let point = ReadingChoice::new(&paper.readings(), &verdicts.reading).map_err(|message| {
        Failure::input(format!("the stored verdicts are of other readings ({message}); judge again"))
    })?;
    let evidence = Evidence::read(paper, point, &places.runs)?;
    let outputs = output::outputs(&evidence, &verdicts, only, stop)?;
    let chapter = || output::chapter(&places.report, &evidence, &verdicts, &places.plots, &outputs);
    let chapter = only.is_none().then(chapter);
    Ok(Drawn { outputs, chapter })
}

fn put(paper: &Paper, places: &Places, drawn: &Drawn, stop: &AtomicBool) -> Result<(), Failure> {
    safe_point(stop, "records and verdicts are kept, no figure was replaced")?;
    output::write(&places.plots, &drawn.outputs)?;
    if let Some(chapter) = &drawn.chapter {
        report::put_chapter(&places.report, &places.report_lock(), &paper.id, chapter)?;
    }
    Ok(())
}

fn check(paper: &Paper, places: &Places, drawn: &Drawn) -> Result<(), Failure> {
    let mut stale = output::stale(&places.plots, &drawn.outputs);
    let mut left = Vec::new();
    if let Some(chapter) = &drawn.chapter {
        let before = report::read(&places.report)?;
        if report::with_chapter(&places.report, &before, &paper.id, chapter)? != before {
            stale.push(places.report.clone());
        }
        left = output::left_over(&places.plots, &drawn.outputs, &places.report, &paper.id)?;
    }
    let listed = |paths: &[PathBuf]| {
        paths.iter().map(|path| path.display().to_string()).collect::<Vec<String>>().join(", ")
    };
    let said = [("not current", &stale), ("left over from before; remove", &left)];
    let said = said.into_iter().filter(|(_, paths)| !paths.is_empty());
    let said: Vec<String> = said.map(|(what, paths)| format!("{what}: {}", listed(paths))).collect();
    if said.is_empty() {
        say!("{} files are current", drawn.outputs.len() + usize::from(drawn.chapter.is_some()));
        return Ok(());
    }
    Err(Failure::stale(said.join("; ")))
}
