//! `replan crosscheck`: robots, scenes and stored paths before an independent judge.
//!
//! Python reads the files by itself, poses the questions and has MuJoCo answer them; here the engine answers the same questions;
//! Python compares.

mod answers;
mod python;
mod set;
mod spec;
mod statistics;
mod subject;

use super::places::{Places, home, papers};
use super::progress::Bar;
use super::{Failure, Which, all};
use clap::Args;
use python::{Judge, MISSING};
use set::Sample;
use spec::Case;
pub use spec::{FILE, SPEC, Spec};
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use study::runner::Progress as _;

/// Has independent programs judge ours: MuJoCo kinematics, contacts and paths; numpy and scipy the statistics.
///
/// Makes its own Python environment below target/replan/ at the first run, which needs Python 3.11 or later and
/// the network once. Exit code 3: something differs, or an error made on purpose was not noticed. Exit code 4:
/// Python, the network or an archive of problems is missing; nothing else depends on them, and --check goes on without
/// the archive.
///
/// With --statistics every estimate, interval and outcome of verdicts.toml that rests on trials is computed again from
/// the Parquet files, by code of its own. A bootstrap interval agrees if both ends lie where Monte-Carlo error can put
/// them; an outcome that this error decides is listed as near.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Crosscheck {
    /// A paper's name or folder; every paper with a crosscheck.toml, or with --statistics every paper, if none is given
    paper: Option<String>,
    /// Compute the statistics of stored runs again, with numpy and scipy alone, and list what differs
    #[arg(long, conflicts_with = "answered")]
    statistics: bool,
    /// Write below this folder instead of the committed places; with --statistics read the runs below it
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// The Python that the environment is made with; python3 or python3.11 if none is given
    #[arg(long, value_name = "PROGRAM")]
    python: Option<String>,
    /// Reuse MuJoCo's stored answers; only replan answers again
    #[arg(long)]
    answered: bool,
    /// Write nothing; compare the stored report with what would be written
    #[arg(long)]
    check: bool,
}

const EXAMPLES: &str = "Examples:
  replan crosscheck fu2018
  replan crosscheck --statistics zhang";

/// Where models, questions and answers lie, below the root of outputs.
const FOLDER: &str = "target/replan/crosscheck";

/// What MuJoCo answers last of a case.
const ANSWERED: &str = "scene.touch.parquet";

impl Crosscheck {
    /// Runs the command.
    pub(super) fn run(self) -> Result<(), Failure> {
        let is_check = self.check;
        self.cross_checked().map_err(|failure| if is_check { failure.in_check() } else { failure })
    }

    fn cross_checked(&self) -> Result<(), Failure> {
        if self.statistics {
            return statistics::run(self.paper.as_deref(), self.out.as_deref(), self.python.as_deref());
        }
        let names = self.paper.clone().map_or_else(papers, |paper| vec![paper]);
        let mut specs = Vec::new();
        for name in &names {
            let places = Places::find(&Which { paper: name.clone(), out: None }, "")?;
            match Spec::open(&places.folder)? {
                Some(spec) => {
                    let shown = Places::find(&Which { paper: name.clone(), out: self.out.clone() }, "")?;
                    specs.push((spec, places, shown));
                }
                None if self.paper.is_some() => return Err(nothing_posed(&places)),
                None => {}
            }
        }
        if specs.is_empty() {
            return Err(Failure::input(
                "no paper here has a crosscheck.toml; run replan from the project's own folder",
            ));
        }
        let mut results = Vec::new();
        let mut posed = Vec::new();
        for (spec, places, shown) in &specs {
            match Posed::new(spec, places, shown) {
                Ok(paper) => posed.push(paper),
                Err(lack) if lack.code == MISSING && self.check => {
                    say!("{}: nothing is compared: {}", id(places), lack.message);
                }
                Err(failure) => results.push(Err(failure)),
            }
        }
        if self.answered {
            posed.iter().try_for_each(|posed| are_answered(posed.shown))?;
        }
        if !posed.is_empty() {
            let judge = Judge::ready(self.python.as_deref(), &home(None)?.join(FOLDER))?;
            results.extend(posed.iter().map(|posed| self.paper(posed, &judge)));
        }
        all(results, "papers differ")
    }

    /// Cross-checks one paper.
    fn paper(&self, posed: &Posed<'_>, judge: &Judge) -> Result<(), Failure> {
        let Posed { places, shown, cases, samples } = posed;
        let id = id(places);
        let folder = answers(shown);
        let words = words(places, &folder);
        let bar = Bar::default();
        if !self.answered {
            if folder.exists() {
                fs::remove_dir_all(&folder)?;
            }
            bar.begin(&format!("{id}: paths"), samples.len());
            samples.iter().try_for_each(|sample| sample.write(places, &folder).inspect(|()| bar.step()))?;
            bar.end();
            bar.begin(&format!("{id}: MuJoCo"), cases.len());
            let posed = judge.pose(&words, || bar.step());
            bar.end();
            posed?;
        }
        bar.begin(&format!("{id}: replan"), cases.len());
        let answered = cases.iter().try_for_each(|(name, subject)| {
            let answered = answers::answer(subject.as_ref(), &folder.join(name));
            bar.step();
            answered
        });
        bar.end();
        answered?;
        fs::create_dir_all(&shown.plots)?;
        judge.report(&words, &shown.plots, self.check)
    }
}

/// What is judged of a paper, read from `places` and shown in `shown`.
struct Posed<'a> {
    places: &'a Places,
    shown: &'a Places,
    cases: Vec<Case>,
    samples: Vec<Sample<'a>>,
}

impl<'a> Posed<'a> {
    fn new(spec: &'a Spec, places: &'a Places, shown: &'a Places) -> Result<Self, Failure> {
        let mut cases = spec.cases(&places.folder, &places.inputs)?;
        let samples = spec.sets().map(|set| Sample::draw(spec, set, places));
        let samples = samples.collect::<Result<Vec<_>, _>>()?;
        for sample in &samples {
            cases.extend(sample.cases()?);
        }
        Ok(Self { places, shown, cases, samples })
    }
}

/// Where the judge finds a paper, and where its answers lie.
fn words(places: &Places, folder: &Path) -> Vec<OsString> {
    let home = if places.home.as_os_str().is_empty() { Path::new(".") } else { &places.home };
    let named = [("--folder", places.folder.as_path()), ("--home", home), ("--runs", &places.runs)];
    let named = named.into_iter().flat_map(|(name, path)| [OsString::from(name), path.into()]);
    [folder.into()].into_iter().chain(named).collect()
}

/// Refuses to judge where nothing has been answered yet.
fn are_answered(shown: &Places) -> Result<(), Failure> {
    let folder = answers(shown);
    let mut cases = fs::read_dir(&folder).into_iter().flatten().flatten();
    if cases.any(|case| case.path().join(ANSWERED).is_file()) {
        return Ok(());
    }
    Err(Failure::input(format!(
        "{}: there are no answers to judge; run `replan crosscheck {}` without --answered, which asks for them",
        folder.display(),
        id(shown)
    )))
}

/// The paper's name.
fn id(places: &Places) -> String {
    places.runs.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

/// Where models, questions and answers of a paper lie.
fn answers(shown: &Places) -> PathBuf {
    let root = shown.report.parent().unwrap_or(Path::new(""));
    root.join(FOLDER).join(id(shown))
}

fn nothing_posed(places: &Places) -> Failure {
    Failure::input(format!(
        "{}: there is no such file; it says which robots, scenes and stored paths are judged",
        places.folder.join(SPEC).display()
    ))
}
