//! `replan render`: figures, tables and the report's chapter from the stored run and verdicts.

use super::places::Places;
use super::progress::{doing, safe_point, stop_flag};
use super::{Failure, How, Which, counted};
use crate::analysis::evidence::Evidence;
use crate::analysis::history::History;
use crate::render::output::{self, Outputs};
use crate::render::report::{self, Chapter};
use clap::Args;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;
use study::Interpretation;
use study::lock::Lock;
use study::paper::Paper;

/// Draws a paper's figures and tables again.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Render {
    #[command(flatten)]
    which: Which,
    /// Write nothing; compare the stored files with what would be written
    #[arg(long)]
    check: bool,
    /// Only the figure or table with this name (fig5, table2, numbers)
    #[arg(long, value_name = "ID")]
    only: Option<String>,
}

const EXAMPLES: &str = "Examples:
  replan render zhang --only ablation
  replan render zhang --check         are the stored figures those of the stored run?";

impl Render {
    /// Runs the command.
    pub fn run(self) -> Result<(), Failure> {
        let (places, paper) = super::load::open(&self.which, &How::plain(None))?;
        let stop = stop_flag();
        if self.check {
            return check(&paper, &places, self.only.as_deref(), stop);
        }
        check_report(&paper, &places)?;
        let _lock = if places.runs.is_dir() { Some(Lock::take(&places.runs)?) } else { None };
        let drawn = draw(&paper, &places, self.only.as_deref(), stop);
        let drawn =
            drawn.map_err(
                |failure| if self.only.is_some() { failure } else { unread(&paper, &places, failure) },
            )?;
        put(&paper, &places, &drawn, stop)?;
        say!("{} files are in {}", drawn.outputs.files.len(), places.plots.display());
        all_drawn(&drawn.outputs)
    }
}

/// What should be on disk.
struct Drawn {
    outputs: Outputs,
    /// The paper's chapter, unless only one figure was requested.
    chapter: Option<Chapter>,
}

/// Draws everything and writes it; gives what could not be drawn.
pub fn write(paper: &Paper, places: &Places, stop: &AtomicBool) -> Result<Outputs, Failure> {
    let drawn = draw(paper, places, None, stop)?;
    put(paper, places, &drawn, stop)?;
    Ok(drawn.outputs)
}

/// Refuses `outputs` with figures missing, each with its reason.
pub fn all_drawn(outputs: &Outputs) -> Result<(), Failure> {
    if outputs.undrawn.is_empty() {
        return Ok(());
    }
    let reasons: Vec<&str> = outputs.undrawn.iter().map(|undrawn| undrawn.why.as_str()).collect();
    Err(Failure::stale(format!(
        "{} could not be drawn: {}",
        counted(reasons.len(), ["figure", "figures"]),
        reasons.join("; ")
    )))
}

/// Refuses a report that the paper's chapter could not be put into, before anything is written.
pub fn check_report(paper: &Paper, places: &Places) -> Result<(), Failure> {
    report::besides(&places.report, &paper.id)?;
    Ok(())
}

fn draw(paper: &Paper, places: &Places, only: Option<&str>, stop: &AtomicBool) -> Result<Drawn, Failure> {
    let verdicts = History::verdicts(&places.runs)?;
    let point = Interpretation::new(&paper.choices, &verdicts.interpretation).map_err(|message| {
        Failure::touched(format!("the stored verdicts are of other interpretations ({message}); judge again"))
    })?;
    doing(&format!("{}: drawing its figures and tables", paper.id));
    let evidence = Evidence::read(paper, point, &places.runs)?;
    let outputs = output::outputs(&evidence, &verdicts, only, stop);
    evidence.traces_read()?;
    let mut outputs = outputs?;
    if only.is_some() {
        return Ok(Drawn { outputs, chapter: None });
    }
    let made = output::chapter(&places.report, &evidence, &verdicts, &places.plots, &outputs.undrawn)?;
    outputs.files.push(made.1);
    Ok(Drawn { outputs, chapter: Some(made.0) })
}

/// Says in the chapter of `paper` that its stored run cannot be shown, and why; gives that as the failure that it is.
fn unread(paper: &Paper, places: &Places, failure: Failure) -> Failure {
    if failure.code != 2 || !places.report.is_file() {
        return failure;
    }
    let chapter = report::unread(paper, &failure.message);
    let put = report::put_chapter(&places.report, &places.report_lock(), &paper.id, &chapter);
    put.err().map_or(failure, Failure::from)
}

fn put(paper: &Paper, places: &Places, drawn: &Drawn, stop: &AtomicBool) -> Result<(), Failure> {
    safe_point(stop, "records and verdicts are kept, no figure was replaced")?;
    output::write(&places.plots, &drawn.outputs)?;
    if let Some(chapter) = &drawn.chapter {
        report::put_chapter(&places.report, &places.report_lock(), &paper.id, chapter)?;
    }
    Ok(())
}

/// Draws again and refuses stored files that are not what comes out.
pub(super) fn check(
    paper: &Paper,
    places: &Places,
    only: Option<&str>,
    stop: &AtomicBool,
) -> Result<(), Failure> {
    let drawn = draw(paper, places, only, stop);
    drawn.and_then(|drawn| compare(paper, places, &drawn)).map_err(Failure::in_check)
}

fn compare(paper: &Paper, places: &Places, drawn: &Drawn) -> Result<(), Failure> {
    all_drawn(&drawn.outputs)?;
    let files = &drawn.outputs.files;
    let mut stale = output::stale(&places.plots, files);
    let mut left = Vec::new();
    if let Some(chapter) = &drawn.chapter {
        let before = report::read(&places.report)?;
        if report::with_chapter(&places.report, &before, &paper.id, chapter)? != before {
            stale.push(places.report.clone());
        }
        left = output::left_over(&places.plots, files, &places.report, &paper.id)?;
    }
    let listed = |paths: &[PathBuf]| {
        paths.iter().map(|path| path.display().to_string()).collect::<Vec<String>>().join(", ")
    };
    let faults = [("not current", &stale), ("left over from before; remove", &left)];
    let faults = faults.into_iter().filter(|(_, paths)| !paths.is_empty());
    let faults: Vec<String> = faults.map(|(what, paths)| format!("{what}: {}", listed(paths))).collect();
    if faults.is_empty() {
        say!("{} files are current", files.len() + usize::from(drawn.chapter.is_some()));
        return Ok(());
    }
    Err(Failure::stale(faults.join("; ")))
}
