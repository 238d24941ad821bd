//! `replan crosscheck`: robots, scenes and stored paths before an independent judge.

mod python;
mod statistics;

use super::places::{Places, home, papers};
use super::progress::Bar;
use super::{Failure, Which};
use crate::crosscheck::{self, Case, CrosscheckError, Depicted, Outcome, Picture, Sources, Spec};
use crate::render::output::CROSSCHECK;
use base::settings::Document;
use clap::Args;
use python::{Judge, Snapshot};
use rayon::prelude::*;
use serde::Deserialize;
use std::fs;
use std::path::{Path, PathBuf};
use study::runner::Progress as _;
use study::store::write_whole;

/// Has independent programs judge ours: MuJoCo kinematics, contacts and paths; numpy and scipy the statistics.
///
/// Makes its own Python environment below target/replan/ at the first run, which needs Python 3.11 or later and
/// the network once. Exit code 3: something differs, or an error made on purpose was not noticed. Exit code 4:
/// Python or the network is missing; nothing else depends on them.
///
/// With --statistics every estimate, interval and class of verdicts.toml that rests on trials is computed again from
/// the Parquet files, by code of its own. A bootstrap interval agrees if both ends lie where Monte-Carlo error can put
/// them; a class that this error decides is listed as near. Example: replan crosscheck --statistics zhang
#[derive(Args)]
pub struct Crosscheck {
    /// A paper's name or folder; if absent all papers (without --statistics, those with a crosscheck.toml)
    paper: Option<String>,
    /// Compute the statistics of stored runs again with numpy and scipy, and list differences
    #[arg(long, conflicts_with = "answered")]
    statistics: bool,
    /// Write below this folder instead of the committed places; with --statistics read the runs below it
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// The Python for the environment; python3 or python3.11 if absent
    #[arg(long, value_name = "PROGRAM")]
    python: Option<String>,
    /// Judge stored answers of MuJoCo; compute no new ones
    #[arg(long)]
    answered: bool,
    /// Write nothing; compare the report's chapter with what would be written
    #[arg(long)]
    check: bool,
}

/// What a cross-check reads of a paper: nothing else of it is needed, or checked.
#[derive(Deserialize)]
struct Sourced {
    source: Option<Source>,
}

#[derive(Deserialize)]
struct Source {
    stand_ins: Option<String>,
}

/// What the paper in `folder` says of inputs that stand in for its own.
fn stand_ins(folder: &Path) -> Result<Option<String>, Failure> {
    let read: Sourced = Document::open(&folder.join("paper.toml"))
        .and_then(|document| document.read_stored())
        .map_err(CrosscheckError::from)?;
    Ok(read.source.and_then(|source| source.stand_ins))
}

/// Where models, questions and answers lie, below the root of outputs.
const FOLDER: &str = "target/replan/crosscheck";

/// The picture's name among a paper's figures.
const PICTURE: &str = "scene_mujoco.png";

impl Crosscheck {
    /// Runs the command.
    pub fn run(self) -> Result<(), Failure> {
        let is_check = self.check;
        self.cross_checked().map_err(|failure| if is_check { failure.in_check() } else { failure })
    }

    fn cross_checked(self) -> Result<(), Failure> {
        if self.statistics {
            return statistics::run(self.paper.as_deref(), self.out.as_deref(), self.python.as_deref());
        }
        let names = self.paper.clone().map_or_else(papers, |paper| vec![paper]);
        let mut posed = Vec::new();
        for name in &names {
            let places = Places::find(&Which { paper: name.clone(), out: None }, "")?;
            match Spec::open(&places.folder).map_err(CrosscheckError::from)? {
                Some(spec) => {
                    let shown = Places::find(&Which { paper: name.clone(), out: self.out.clone() }, "")?;
                    posed.push((places, shown, spec));
                }
                None if self.paper.is_some() => return Err(nothing_posed(&places)),
                None => {}
            }
        }
        if posed.is_empty() {
            return Err(Failure::input(
                "no paper here has a crosscheck.toml; run replan from the project's own folder",
            ));
        }
        if self.answered {
            posed.iter().try_for_each(|(_, shown, _)| are_answered(shown))?;
        }
        let home = home(None)?;
        let judge = if self.answered {
            None
        } else {
            Some(Judge::ready(self.python.as_deref(), &home.join(FOLDER))?)
        };
        let mut differences = 0;
        for (places, shown, spec) in &posed {
            differences += self.paper(places, shown, spec, judge.as_ref())?;
        }
        if differences > 0 {
            return Err(Failure::stale(format!("{differences} answers differ or controls went unnoticed")));
        }
        Ok(())
    }

    /// Cross-checks one paper, read from `places` and shown in `shown`, and gives the number of differences.
    fn paper(
        &self,
        places: &Places,
        shown: &Places,
        spec: &Spec,
        judge: Option<&Judge>,
    ) -> Result<usize, Failure> {
        let id = id(places);
        let folder = answers(shown);
        let bar = Bar::default();
        bar.begin(&format!("{id}: posing the questions"), spec.count());
        let sources = Sources { folder: &places.folder, inputs: &places.inputs, runs: &places.runs };
        let cases = spec.cases(sources, &|| bar.step());
        bar.end();
        let cases = cases?;
        let picture = spec.picture();
        let drawn = match judge {
            Some(judge) => self.ask(judge, &cases, shown, &picture)?,
            None => Drawing::Unasked,
        };
        let outcomes = compare(&id, &cases, &folder)?;
        say!("{}", crosscheck::verdict_table(&outcomes).trim_end());
        let all = crosscheck::list(&outcomes);
        let listed = if all.is_empty() { String::new() } else { all.join("\n") + "\n" };
        write_whole(&folder.join("disagreements.txt"), listed.as_bytes())?;
        eprint!("{listed}");
        let stand_ins = stand_ins(&places.folder)?;
        self.report(shown, &outcomes, &picture.case, drawn, stand_ins.as_deref())?;
        Ok(all.len())
    }

    /// Writes the cases, has them answered, and draws the picture.
    fn ask(
        &self,
        judge: &Judge,
        cases: &[Case],
        shown: &Places,
        picture: &Picture,
    ) -> Result<Drawing, Failure> {
        let id = id(shown);
        let folder = answers(shown);
        if folder.exists() {
            fs::remove_dir_all(&folder)?;
        }
        cases.par_iter().try_for_each(|case| case.write(&folder))?;
        let bar = Bar::default();
        bar.begin(&format!("{id}: MuJoCo"), python::models(&folder)?);
        let answered = judge.answer(&folder, || bar.step());
        bar.end();
        answered?;
        let to = if self.check { folder.join(PICTURE) } else { shown.plots.join(PICTURE) };
        let snapshot = Snapshot {
            model: folder.join(&picture.case).join("scene.xml"),
            key: picture.key.clone(),
            camera_deg: picture.camera_deg,
            zoom: picture.zoom,
            to,
        };
        fs::create_dir_all(snapshot.to.parent().unwrap_or(Path::new("")))?;
        Ok(match judge.draw(&snapshot) {
            Ok(()) => Drawing::Done,
            Err(why) => {
                eprintln!("{id}: no picture: {why}");
                Drawing::Failed
            }
        })
    }

    /// Writes or checks the chapter. `scene` is the case to look around in.
    fn report(
        &self,
        shown: &Places,
        outcomes: &[Outcome],
        scene: &str,
        drawn: Drawing,
        stand_ins: Option<&str>,
    ) -> Result<(), Failure> {
        let id = id(shown);
        let place = answers(shown).join(scene).join("scene.xml");
        let view = format!("{FOLDER}/venv/bin/python -m mujoco.viewer --mjcf={}", place.display());
        let command = format!("replan crosscheck {id}");
        let chapter = |picture| crosscheck::chapter(&id, outcomes, &command, &view, picture, stand_ins);
        let (now, next) = depicted(drawn, PICTURE, shown.plots.join(PICTURE).is_file());
        let path = shown.plots.join(CROSSCHECK);
        if !self.check {
            write_whole(&path, chapter(now).as_bytes())?;
            say!("what MuJoCo says is in {}; to look around the scene: {view}", path.display());
            return Ok(());
        }
        let before = fs::read_to_string(&path).unwrap_or_default();
        if [Some(now), next].into_iter().flatten().any(|picture| chapter(picture) == before) {
            say!("{} is current", path.display());
            return Ok(());
        }
        Err(Failure::stale(format!("not current: {}", path.display())))
    }
}

/// What became of the picture.
#[derive(Clone, Copy)]
enum Drawing {
    Done,
    Unasked,
    Failed,
}

/// How the chapter shows the picture; and how else, if a check that draws none itself cannot say which of the two is right:
/// the machine that wrote the chapter may have drawn it.
fn depicted(drawn: Drawing, link: &str, is_there: bool) -> (Depicted<'_>, Option<Depicted<'_>>) {
    let why = match drawn {
        Drawing::Done => return (Depicted::Now(link), None),
        Drawing::Unasked => "none was asked for when this was written, since the answers were there already",
        Drawing::Failed => {
            "it could not be drawn when this was written; most often no renderer works without a screen (Debian or \
             Ubuntu: apt install libosmesa6)"
        }
    };
    if is_there {
        (Depicted::Before(link, why), Some(Depicted::Now(link)))
    } else {
        (Depicted::Not(why), None)
    }
}

/// Refuses to judge where nothing has been answered yet.
fn are_answered(shown: &Places) -> Result<(), Failure> {
    let folder = answers(shown);
    let cases = fs::read_dir(&folder).into_iter().flatten().flatten();
    let mut files = cases.flat_map(|case| fs::read_dir(case.path()).into_iter().flatten().flatten());
    if files.any(|file| file.file_name().to_string_lossy().ends_with(crosscheck::ANSWERED)) {
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

/// Our answers beside those in `folder`.
fn compare(id: &str, cases: &[Case], folder: &Path) -> Result<Vec<Outcome>, CrosscheckError> {
    let bar = Bar::default();
    bar.begin(&format!("{id}: comparing"), cases.len());
    let outcomes = cases.par_iter().map(|case| {
        let outcome = case.compare(folder);
        bar.step();
        outcome
    });
    let outcomes: Result<_, _> = outcomes.collect();
    bar.end();
    outcomes
}

fn nothing_posed(places: &Places) -> Failure {
    Failure::input(format!(
        "{}: there is no such file; it says which robots, scenes and stored paths are judged",
        places.folder.join(crosscheck::SPEC).display()
    ))
}

impl From<CrosscheckError> for Failure {
    fn from(error: CrosscheckError) -> Self {
        match error {
            CrosscheckError::Study(error) => error.into(),
            CrosscheckError::Io { .. } => Self::new(1, error.to_string()),
            CrosscheckError::Settings(_) => Self::input(error.to_string()),
            CrosscheckError::Answer { .. } => Self::stale(error.to_string()),
        }
    }
}
