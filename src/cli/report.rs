//! `replan report`: a paper's report as one HTML page.

use super::places::{Places, home, papers};
use super::progress::doing;
use super::{Failure, How, Which};
use crate::analysis::across::Stored;
use crate::analysis::evidence::Evidence;
use crate::analysis::history::History;
use crate::analysis::tally::Counts;
use crate::page::{self, IndexLine};
use crate::render::output::Output;
use crate::render::prose::prose;
use crate::render::state;
use clap::Args;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use study::Interpretation;
use study::clock::timed;
use study::paper::Paper;
use study::store::write_whole;

/// Writes reports as pages of HTML that need nothing else: claim, finding, trial, replay.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Report {
    /// A paper's name, a folder that holds a paper.toml, or a stored run; every paper of the project if absent
    paper: Option<String>,
    /// Read the run below this folder instead of the committed places
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Write the pages into this folder instead of target/replan/report/
    #[arg(long, value_name = "DIR")]
    to: Option<PathBuf>,
    /// Open the page when it is written
    #[arg(long)]
    open: bool,
}

const EXAMPLES: &str = "Examples:
  replan report zhang --open
  replan report --to pages            every paper, with an index";

impl Report {
    /// Runs the command.
    pub fn run(self) -> Result<(), Failure> {
        let folder = match &self.to {
            Some(folder) => folder.clone(),
            None => home(None)?.join("target/replan/report"),
        };
        let papers = match &self.paper {
            Some(paper) => vec![paper.clone()],
            None => papers(),
        };
        let mut listed = Vec::new();
        let mut failed = None;
        for paper in &papers {
            let which = Which { paper: paper.clone(), out: self.out.clone() };
            let has_index = self.paper.is_none() || folder.join("index.html").is_file();
            match write(&Places::stored(&which)?, &folder, has_index) {
                (line, Ok(())) => listed.extend(line),
                (line, Err(failure)) => {
                    listed.extend(line);
                    failed = Some(failed.unwrap_or(failure));
                }
            }
        }
        let shown = match (&self.paper, &listed[..]) {
            (Some(_), [line]) => folder.join(format!("{}.html", line.id)),
            _ => folder.join("index.html"),
        };
        if self.paper.is_none() {
            write_whole(&shown, page::index(&listed).as_bytes())?;
        }
        say!("{}", shown.display());
        failed.map_or(Ok(()), Err)?;
        if self.open { open(&shown) } else { Ok(()) }
    }
}

/// Writes the page of the paper at `places` into `folder`; gives its line of the index. What cannot be shown stands in the
/// page's first line, and is a failure all the same.
pub(super) fn write(
    places: &Places,
    folder: &Path,
    has_index: bool,
) -> (Option<IndexLine>, Result<(), Failure>) {
    let how = How { quick: false, seed: None, with: None, threads: None };
    let paper = match super::load::load(places, &how) {
        Ok(paper) => paper,
        Err(failure) => return (None, Err(failure)),
    };
    let file = folder.join(format!("{}.html", paper.id));
    let line = |finding: String, state: String, counts: Option<Counts>| {
        Some(IndexLine { id: paper.id.clone(), title: paper.source.title.clone(), finding, state, counts })
    };
    let (spent_ns, made) = timed(|| made(&paper, places, folder, has_index));
    match made {
        Ok(Made { finding, state, counts, sizes }) => {
            say!("{}: {sizes} in {:.1} s", paper.id, spent_ns as f64 / 1e9);
            (line(finding, state, Some(counts)), Ok(()))
        }
        Err(failure) => {
            let why = page::unread(&paper.id, &paper.source.title, &failure.message);
            match write_whole(&file, why.as_bytes()) {
                Ok(()) => {
                    let state = format!("Nothing is shown: {}", failure.message);
                    (line(String::new(), state, None), Err(failure))
                }
                Err(error) => (None, Err(error.into())),
            }
        }
    }
}

/// The summary of a page that was written.
struct Made {
    /// The finding; empty if the run is not the study's own.
    finding: String,
    /// What its first line says; empty if the run is the study's own.
    state: String,
    /// How many sentences and rows have each verdict.
    counts: Counts,
    /// How large it is, and what lies beside it.
    sizes: String,
}

fn made(paper: &Paper, places: &Places, folder: &Path, has_index: bool) -> Result<Made, Failure> {
    let verdicts = History::verdicts(&places.runs)?;
    let point = Interpretation::new(&paper.choices, &verdicts.interpretation).map_err(|message| {
        Failure::input(format!("the stored verdicts are of other interpretations ({message}); judge again"))
    })?;
    doing(&format!("{}: writing its page", paper.id));
    let evidence = Evidence::read(paper, point, &places.runs)?;
    let figures = figures(paper, &places.plots);
    let rest = format!("{}-replays.zip", paper.id);
    let stored = Stored::read(paper, &places.runs, evidence.polylines())?;
    let made = page::page(&evidence, &verdicts, &stored, &figures, &places.inputs, &rest, has_index);
    evidence.traces_read()?;
    let made = made?;
    write_whole(&folder.join(format!("{}.html", paper.id)), made.html.as_bytes())?;
    let size = made.html.len() as f64 / 1e6;
    let beside = made.rest.as_ref().map(|rest| rest.len() as f64 / 1e6);
    if let Some(bytes) = &made.rest {
        write_whole(&folder.join(&rest), bytes)?;
    }
    let beside = beside.map_or_else(String::new, |size| format!(", and {size:.2} MB of replays in {rest}"));
    let state = state(&evidence, &verdicts);
    let finding = paper.report.finding.as_ref().filter(|_| state.is_empty());
    let finding = finding.map_or_else(String::new, |finding| prose(finding, &verdicts));
    let sizes = format!("{size:.2} MB{beside}");
    Ok(Made { finding, state: state.join(" "), counts: verdicts.counts(), sizes })
}

/// The figures of `paper` as they were drawn into `folder`; what is not there is not shown, and the page says so in its place.
fn figures(paper: &Paper, folder: &Path) -> Vec<Output> {
    let read = |id: &str| {
        let read = fs::read(folder.join(format!("{id}.svg")));
        read.ok().map(|bytes| Output { name: id.to_owned(), bytes })
    };
    paper.figure_ids().filter_map(read).collect()
}

/// Opens `file` with what the desktop opens pages with.
fn open(file: &Path) -> Result<(), Failure> {
    let programs = ["xdg-open", "open", "explorer"];
    let started = programs.iter().find_map(|program| {
        let mut command = Command::new(program);
        command.arg(file).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).spawn().ok()
    });
    started.map(drop).ok_or_else(|| {
        Failure::tool(format!(
            "none of {} is here to open it; open {} yourself",
            programs.join(", "),
            file.display()
        ))
    })
}
