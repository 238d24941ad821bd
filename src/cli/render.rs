//! `replan render`: figures, tables and the report's chapter from the stored run and verdicts.

use super::places::Places;
use super::{Failure, How, Which};
use crate::analysis::evidence::Evidence;
use crate::analysis::verdict::Verdicts;
use crate::render::output::{self, Output};
use crate::study::Point;
use crate::study::paper::Paper;
use crate::study::store::write_whole;
use clap::Args;

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
        let drawn = draw(&paper, &places, self.only.as_deref())?;
        if self.check {
            return check(&places, &drawn);
        }
        put(&places, &drawn)?;
        say!("{} files are in {}", drawn.outputs.len(), places.plots.display());
        Ok(())
    }
}

/// What should be on disk.
struct Drawn {
    outputs: Vec<Output>,
    report: Option<String>,
}

/// Draws everything and writes it.
pub fn write(paper: &Paper, places: &Places) -> Result<(), Failure> {
    put(places, &draw(paper, places, None)?)
}

fn draw(paper: &Paper, places: &Places, only: Option<&str>) -> Result<Drawn, Failure> {
    let verdicts = Verdicts::read(&places.runs)?;
    let point = Point::new(&paper.readings(), &verdicts.reading).map_err(|message| {
        Failure::input(format!("the stored verdicts are of other readings ({message}); judge again"))
    })?;
    let evidence = Evidence::read(paper, point, &places.runs)?;
    let outputs = output::outputs(&evidence, &verdicts, only)?;
    let chapter = || output::report_with_chapter(&places.report, &evidence, &verdicts, &places.plots);
    let report = only.is_none().then(chapter);
    Ok(Drawn { outputs, report })
}

fn put(places: &Places, drawn: &Drawn) -> Result<(), Failure> {
    output::write(&places.plots, &drawn.outputs)?;
    if let Some(report) = &drawn.report {
        write_whole(&places.report, report.as_bytes())?;
    }
    Ok(())
}

fn check(places: &Places, drawn: &Drawn) -> Result<(), Failure> {
    let mut stale = output::stale(&places.plots, &drawn.outputs);
    if let Some(report) = &drawn.report
        && std::fs::read_to_string(&places.report).ok().as_ref() != Some(report)
    {
        stale.push(places.report.clone());
    }
    if stale.is_empty() {
        say!("{} files are current", drawn.outputs.len() + usize::from(drawn.report.is_some()));
        return Ok(());
    }
    let listed: Vec<String> = stale.iter().map(|path| path.display().to_string()).collect();
    Err(Failure::stale(format!("not current: {}", listed.join(", "))))
}
