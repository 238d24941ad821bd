//! Where a paper is read from and where its outputs go.
//!
//! Only a full run with the studies' own seed and default interpretation may write the committed places; everything else
//! goes below `target/replan/` or where `--out` says.

use super::{Failure, How, Which};
use crate::analysis::compare::stored_studies;
use base::settings::{did_you_mean, none_called};
use base::text::shell_word;
use std::collections::BTreeMap;
use std::fs;
use std::iter;
use std::path::{Component, Path, PathBuf};
use study::manifest::Manifest;
use study::paper::Paper;
use study::store::check_records;
use study::{Inputs, Interpretation, Study};

/// Where the papers of the project lie.
const EXPERIMENTS: &str = "experiments";
/// Where everything goes that is not committed.
const TARGET: &str = "target/replan";

/// The folder below `--out` for what saves time alone. It is not called as that of a project is, so that `--out` names none.
const SCRATCH: &str = "scratch";

/// Where stored runs lie below a root, a folder a paper.
const RUNS: &str = "data/runs";

/// Where things are.
#[derive(Debug, Clone)]
pub struct Places {
    /// The folder that outputs and shared inputs lie in.
    pub home: PathBuf,
    /// The paper's folder.
    pub folder: PathBuf,
    /// Where its records and verdicts are.
    pub runs: PathBuf,
    /// Where its figures and tables are.
    pub plots: PathBuf,
    /// The report that holds its chapter.
    pub report: PathBuf,
    /// Where what saves time alone is kept: below `--out`, if that is given.
    pub scratch: PathBuf,
    /// Where input files are looked for.
    pub inputs: Inputs,
}

impl Places {
    /// The places of the paper that `which` names. `variant` distinguishes a run from a full default one.
    ///
    /// # Errors
    /// If there is no such paper; the message lists those that exist. If `--out` names a committed place for a run that is not a
    /// full default one.
    pub fn find(which: &Which, variant: &str) -> Result<Self, Failure> {
        let (folder, home, is_own) = folder(&which.paper)?;
        let id = paper_id(&folder)?;
        let committed = if is_own { home.join(TARGET).join(&id) } else { home.clone() };
        let root = match (&which.out, variant) {
            (Some(out), "") => out.clone(),
            (Some(out), variant) if is_committed(out, [&committed, &home]) => {
                return Err(Failure::input(format!(
                    "--out {} is where full runs are kept, and this is not one ({variant}); another folder is accepted",
                    out.display()
                )));
            }
            (Some(out), _) => out.clone(),
            (None, "") => committed,
            (None, variant) => home.join(TARGET).join(format!("{id}-{variant}")),
        };
        let scratch = match &which.out {
            Some(out) if resolved(out) != resolved(&home) => out.join(SCRATCH),
            _ => home.join(TARGET),
        };
        let root = if root == Path::new(".") { PathBuf::new() } else { root };
        Ok(Self {
            runs: root.join(RUNS).join(&id),
            plots: root.join("plots").join(&id),
            report: root.join("paper_repro.md"),
            scratch,
            inputs: Inputs::below(vec![folder.clone(), home.clone()]),
            home,
            folder,
        })
    }
}

impl Places {
    /// The lock file by which runs take turns to change the report.
    pub fn report_lock(&self) -> PathBuf {
        self.runs.parent().unwrap_or(Path::new("")).join(".lock")
    }

    /// As [`find`](Self::find), where `which` may also name a stored run of a paper of the project.
    ///
    /// # Errors
    /// If it names neither.
    pub fn stored(which: &Which) -> Result<Self, Failure> {
        Self::find(which, "").or_else(|unknown| {
            let runs = match &which.out {
                None => stored_run(&which.paper).ok(),
                Some(_) => None,
            };
            let Some(runs) = runs else { return Err(unknown) };
            let paper = paper_id(&runs)?;
            let root = runs.ancestors().nth(3).filter(|root| root.join(RUNS).join(&paper) == runs);
            let Some(root) = root else { return Err(unknown) };
            Self::find(&Which { paper, out: Some(root.to_owned()) }, "")
        })
    }

    /// The records of a paper, or a stored run, that `which` names.
    ///
    /// # Errors
    /// If it names neither.
    pub fn runs(which: &Which) -> Result<PathBuf, Failure> {
        Self::find(which, "").map(|places| places.runs).or_else(|unknown| match &which.out {
            None => stored_run(&which.paper).map_err(|_| unknown),
            Some(_) => Err(unknown),
        })
    }
}

/// The folder of records that `given` means: itself, the folder of the one paper below it, or the folder of the paper
/// so named.
///
/// # Errors
/// If there is none, or there are several.
pub fn stored_run(given: &str) -> Result<PathBuf, Failure> {
    let folder = Path::new(given);
    let is_run = |folder: &Path| !stored_studies(folder).is_empty();
    let below: Vec<PathBuf> = fs::read_dir(folder.join(RUNS))
        .into_iter()
        .flatten()
        .flatten()
        .map(|entry| entry.path())
        .filter(|path| is_run(path))
        .collect();
    match &below[..] {
        _ if is_run(folder) => Ok(folder.to_owned()),
        [one] => Ok(one.clone()),
        [] => match Places::find(&Which { paper: given.to_owned(), out: None }, "") {
            Ok(places) if is_run(&places.runs) => Ok(places.runs),
            Ok(places) => Err(Failure::input(format!(
                "{}: no stored run; `replan repro {}` makes it",
                places.runs.display(),
                shell_word(given)
            ))),
            Err(_) => Err(no_run(given)),
        },
        several => Err(Failure::input(format!(
            "`{given}` holds the runs of {} papers; name one of their folders, as {}",
            several.len(),
            several[0].display()
        ))),
    }
}

fn no_run(given: &str) -> Failure {
    let known = papers();
    let hint = did_you_mean(given, known.iter().map(String::as_str));
    Failure::input(format!(
        "`{given}` holds no stored run{hint}; a folder with *.manifest.toml, what `--out` was given, or the name of a paper that \
         has run is accepted"
    ))
}

/// The folder that outputs and shared inputs lie in, as a path from here: the nearest one from here upwards with papers or
/// earlier outputs, and this one if there is none. It is never in `paper`, the folder of one, so that a command means the
/// same there.
pub fn home(paper: Option<&Path>) -> Result<PathBuf, Failure> {
    let here = fs::canonicalize(".")?;
    let paper = paper.map(fs::canonicalize).transpose()?;
    let outside: Vec<(usize, &Path)> = here
        .ancestors()
        .enumerate()
        .filter(|(_, at)| paper.as_ref().is_none_or(|paper| !at.starts_with(paper)))
        .collect();
    let is_kept = |at: &Path| at.join(EXPERIMENTS).is_dir() || at.join(TARGET).is_dir();
    let found = outside.iter().find(|(_, at)| is_kept(at)).or(outside.first());
    Ok(iter::repeat_n("..", found.map_or(0, |(up, _)| *up)).collect())
}

/// The folder of the paper called `paper`, the home that goes with it, and whether it is a user's own: one that does not lie
/// in the project.
fn folder(paper: &str) -> Result<(PathBuf, PathBuf, bool), Failure> {
    let given = Path::new(paper);
    let is_name = matches!(given.components().collect::<Vec<_>>()[..], [Component::Normal(_)]);
    let project = home(None)?;
    let named = project.join(EXPERIMENTS).join(given);
    if is_name && named.join("paper.toml").is_file() {
        return Ok((named, project, false));
    }
    let file = given.join("paper.toml");
    if !file.is_file() {
        // A pipe or a device is there, and is no paper.
        let is_special = fs::metadata(&file).is_ok_and(|found| !found.is_dir());
        return Err(if is_special { irregular(&file) } else { unknown(paper) });
    }
    let home = home(Some(given))?;
    let absolute = fs::canonicalize(given)?;
    let papers = home.join(EXPERIMENTS);
    match (fs::canonicalize(&papers), absolute.file_name()) {
        (Ok(project), Some(name)) if absolute.parent() == Some(&project) => {
            Ok((papers.join(name), home, false))
        }
        _ => Ok((given.to_owned(), home, true)),
    }
}

/// Whether writing below `out` writes a committed place: this paper's own or the project's.
fn is_committed(out: &Path, [own, home]: [&Path; 2]) -> bool {
    let is_project = home.join(EXPERIMENTS).is_dir();
    let kept = [Some(own), is_project.then_some(home)];
    kept.into_iter().flatten().any(|kept| resolved(out) == resolved(kept))
}

/// The absolute path of a folder that may not exist yet.
fn resolved(folder: &Path) -> PathBuf {
    let mut found = PathBuf::from(".");
    for part in folder.components() {
        found.push(part);
        found = fs::canonicalize(&found).unwrap_or_else(|_| match part {
            Component::ParentDir => found.parent().and_then(Path::parent).unwrap_or(&found).to_owned(),
            _ => found.clone(),
        });
    }
    fs::canonicalize(&found).unwrap_or(found)
}

/// Where the papers of the project lie, as a path from here.
pub fn experiments() -> PathBuf {
    home(None).unwrap_or_default().join(EXPERIMENTS)
}

/// Every paper of the project, by name.
pub fn papers() -> Vec<String> {
    let entries = fs::read_dir(experiments()).into_iter().flatten().flatten();
    let mut names: Vec<String> = entries
        .filter(|entry| entry.path().join("paper.toml").is_file())
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

fn paper_id(folder: &Path) -> Result<String, Failure> {
    let absolute = fs::canonicalize(folder)?;
    Ok(absolute.file_name().unwrap_or_default().to_string_lossy().into_owned())
}

fn irregular(file: &Path) -> Failure {
    let cause = base::file::read(file).err().map_or_else(String::new, |error| error.to_string());
    Failure::input(format!("{}: {cause}", file.display()))
}

fn unknown(name: &str) -> Failure {
    let known = papers();
    let hint = did_you_mean(name, known.iter().map(String::as_str));
    let known = if known.is_empty() {
        format!(
            "there is no folder `{EXPERIMENTS}` with papers here; run replan from the project's own folder"
        )
    } else {
        format!("the papers are {}", known.join(", "))
    };
    Failure::input(format!("`{name}` is neither a paper nor a folder with a paper.toml{hint}; {known}"))
}

impl How {
    /// What sets this run apart from a full default one; empty if nothing does.
    pub fn variant(&self) -> String {
        let mut parts = Vec::new();
        if self.quick {
            parts.push("quick".to_owned());
        }
        parts.extend(self.seed.map(|seed| format!("seed-{seed}")));
        parts.extend(self.with.as_deref().map(|with| format!("with-{}", study::slug(with))));
        parts.join("-")
    }

    /// The paper with its studies cut down and reseeded as requested.
    pub fn apply(&self, mut paper: Paper) -> Paper {
        let change = |mut study: Study| {
            study.seed = self.seed.unwrap_or(study.seed);
            if self.quick { study.quick() } else { study }
        };
        paper.studies = paper.studies.into_iter().map(change).collect();
        paper
    }

    /// The interpretations to run; the first is the one that claims are judged under.
    ///
    /// # Errors
    /// An unknown option, or one that cannot be run.
    pub fn interpretations(&self, study: &Study) -> Result<Vec<Interpretation>, Failure> {
        match self.with.as_deref() {
            None => Ok(vec![self.interpretation(&study.choices)?]),
            Some("all") => Ok(study.trial_interpretations()?),
            Some(_) => Ok(vec![self.interpretation(&study.choices)?.for_trials(&study.choices)]),
        }
    }

    /// That every study has the requested options: before anything is written.
    ///
    /// # Errors
    /// Those of [`interpretations`](Self::interpretations).
    pub fn check_interpretations(&self, paper: &Paper) -> Result<(), Failure> {
        paper.studies.iter().try_for_each(|study| self.interpretations(study).map(|_| ()))
    }

    /// The interpretation that claims are judged under, over `choices`.
    ///
    /// # Errors
    /// An option that a choice does not have. Choices that a study does not inherit are left to others.
    pub fn interpretation(&self, choices: &[study::Choice]) -> Result<Interpretation, Failure> {
        let mut chosen = BTreeMap::new();
        for part in self.with.as_deref().filter(|text| *text != "all").iter().flat_map(|text| text.split(','))
        {
            let Some((id, option)) = part.split_once('=') else {
                return Err(Failure::input(format!(
                    "--with: `{part}` is not `choice=option`; `all` or `a=x,b=y` is accepted"
                )));
            };
            if choices.iter().any(|choice| choice.id == id)
                && let Some(other) = chosen.insert(id.to_owned(), option.to_owned())
            {
                return Err(Failure::input(format!(
                    "--with: `{id}` is given twice, as `{other}` and as `{option}`; one option is accepted"
                )));
            }
        }
        Interpretation::new(choices, &chosen).map_err(|message| Failure::input(format!("--with: {message}")))
    }

    /// Refuses choices that the paper does not have.
    ///
    /// # Errors
    /// The first unknown choice, with those that exist.
    pub fn check_with(&self, paper: &Paper) -> Result<(), Failure> {
        let known = &paper.choices;
        for part in self.with.as_deref().filter(|text| *text != "all").iter().flat_map(|text| text.split(','))
        {
            let id = part.split('=').next().unwrap_or(part);
            if !known.iter().any(|choice| choice.id == id) {
                let ids: Vec<&str> = known.iter().map(|choice| choice.id.as_str()).collect();
                return Err(Failure::input(format!("--with: {}", none_called("choice", id, ids))));
            }
        }
        Ok(())
    }
}

/// Refuses a folder in which some record is gone or is not what its manifest names.
pub(super) fn check_stored(folder: &Path) -> Result<(), Failure> {
    for study in stored_studies(folder) {
        check_records(folder, &study, &Manifest::read(folder, &study)?.files)?;
    }
    Ok(())
}
