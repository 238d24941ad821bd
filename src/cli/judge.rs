//! `replan judge`: verdicts from stored runs.

use super::places::Places;
use super::progress::doing;
use super::stamp::{Stamp, hash_of};
use super::{Again, Failure, How, Which, command_line, verdicts};
use crate::analysis::across::{self, Stored};
use crate::analysis::claims;
use crate::analysis::compare::stored_studies;
use crate::analysis::difference::differences;
use crate::analysis::estimates::Estimates;
use crate::analysis::evidence::{Evidence, default_point};
use crate::analysis::history::History;
use crate::analysis::verdict::Verdicts;
use clap::Args;
use std::collections::BTreeSet;
use std::fs;
use study::Interpretation;
use study::lock::Lock;
use study::manifest::Manifest;
use study::paper::Paper;

/// Judges a paper's claims again.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Judge {
    #[command(flatten)]
    which: Which,
    /// Judge under these options, which must have been run: `corner_cutting=forbid_any,ties=lifo`
    #[arg(long, value_name = "OPTIONS")]
    with: Option<String>,
    /// Write nothing; compare the stored verdicts with those of the stored run
    #[arg(long)]
    check: bool,
}

const EXAMPLES: &str = "Examples:
  replan judge zhang
  replan judge zhang --check          are the stored verdicts those of the stored run?";

impl Judge {
    /// Runs the command.
    pub fn run(self) -> Result<(), Failure> {
        let how = How { quick: false, seed: None, with: self.with, threads: None };
        let (places, paper) = super::load::open(&self.which, &how)?;
        let point = how.interpretation(&paper.choices)?;
        if self.check {
            return check(&paper, point, &places);
        }
        let _lock = if places.runs.is_dir() { Some(Lock::take(&places.runs)?) } else { None };
        let judged = judge(&paper, point, &places)?;
        verdicts::print(Some(&paper), &judged, &self.which);
        must_hold(&judged)
    }
}

/// Judges again and refuses stored verdicts that are not what comes out, to the byte.
pub(super) fn check(paper: &Paper, point: Interpretation, places: &Places) -> Result<(), Failure> {
    compare(paper, point, places).map_err(Failure::in_check)
}

fn compare(paper: &Paper, point: Interpretation, places: &Places) -> Result<(), Failure> {
    let stored = Verdicts::read_as_they_stand(&places.runs)?;
    let path = Verdicts::path(&places.runs);
    check_explorations(paper, &stored, places)?;
    let evidence = read(paper, point, places)?;
    check_manifests(&evidence, places)?;
    let history = History::read(&places.runs)?;
    let now = judged(&evidence, places, &history)?;
    let mut found = differences(&stored, &now);
    if history.lacks(paper, &places.runs) {
        found.push(format!(
            "{}: has no entry for what is stored and claimed now",
            History::path(&places.runs).display()
        ));
    }
    if found.is_empty() && fs::read(&path)? != now.text().as_bytes() {
        found.push("the same verdicts in other words than `replan judge` writes".to_owned());
    }
    if found.is_empty() {
        say!("{}: {} verdicts are what the stored run gives", paper.id, now.claims.len());
        return must_hold(&now);
    }
    let message = format!("{}: not what the stored run gives:\n  {}", path.display(), found.join("\n  "));
    Err(Failure::stale(message))
}

/// Refuses verdicts in which a claim fails that must hold whatever was drawn.
pub fn must_hold(verdicts: &Verdicts) -> Result<(), Failure> {
    let violated = verdicts.violated();
    if violated.is_empty() {
        return Ok(());
    }
    let paper = &verdicts.paper;
    let claims = violated.join("`, `");
    let message = format!(
        "{paper}: `{claims}` must hold whatever was drawn, and does not: the program is wrong, or the theorem; \
         `replan show {paper} {}` has what was found",
        violated[0]
    );
    Err(Failure::stale(message))
}

/// Refuses verdicts that rest on an exploration that is gone.
fn check_explorations(paper: &Paper, stored: &Verdicts, places: &Places) -> Result<(), Failure> {
    let Some(explored) = &stored.explored else { return Ok(()) };
    let found = Estimates::read(paper, &places.runs)?;
    for (is_used, is_there, command) in [
        (explored.interpretations > 0, found.first.is_some(), "explore"),
        (explored.second_seed, found.second.is_some(), "confirm"),
    ] {
        if is_used && !is_there {
            let path = Estimates::path(&places.runs);
            let message = format!(
                "{}: what `{command}` found is gone, and the stored verdicts rest on it; `replan {command} {}` makes it again",
                path.display(),
                stored.paper
            );
            return Err(Failure::stale(message));
        }
    }
    Ok(())
}

/// Refuses manifests that say what the studies, their inputs and the records do not bear out.
fn check_manifests(evidence: &Evidence<'_>, places: &Places) -> Result<(), Failure> {
    let mut found = Vec::new();
    for run in evidence.runs() {
        let mut untrue = run.manifest.untrue(run.study, &places.inputs)?;
        if run.sessions() > run.manifest.sessions.len() {
            untrue.push(format!("the clock was read in {} sessions, and fewer are listed", run.sessions()));
        }
        let path = Manifest::path(&places.runs, &run.study.name);
        found.extend(untrue.iter().map(|what| format!("{}: {what}", path.display())));
    }
    let names: BTreeSet<&str> = evidence.paper.studies.iter().map(|study| study.name.as_str()).collect();
    let left = stored_studies(&places.runs).into_iter().filter(|name| !names.contains(name.as_str()));
    let left: Vec<String> = left.map(|name| format!("{}/{name}.*", places.runs.display())).collect();
    if !left.is_empty() {
        let message = format!("left over from a study that is no more; remove: {}", left.join(", "));
        return Err(Failure::stale(message));
    }
    if found.is_empty() {
        return Ok(());
    }
    let message = format!("{}; edited, or of an older program: run the studies again", found.join("\n"));
    Err(Failure::stale(message))
}

/// Judges `paper` under `point` by its stored run and writes the verdicts beside it.
pub fn judge(paper: &Paper, point: Interpretation, places: &Places) -> Result<Verdicts, Failure> {
    let evidence = read(paper, point, places)?.remembering(&polylines(places));
    let history = History::note(paper, &places.runs, &command_line())?;
    let verdicts = judged(&evidence, places, &history)?;
    evidence.keep_polylines();
    verdicts.write(&places.runs)?;
    Ok(verdicts)
}

/// As [`judge`], or the stored verdicts if nothing that they rest on has changed. The caller has just compared the
/// records with their manifests.
pub fn judge_changes(
    paper: &Paper,
    point: &Interpretation,
    places: &Places,
    again: Again,
) -> Result<Verdicts, Failure> {
    let runs = &places.runs;
    let beside = [Estimates::path(runs), History::path(runs)];
    let stamp = || {
        let hashes = beside.iter().map(|path| hash_of(path).unwrap_or_default());
        let more: Vec<String> = hashes.chain([point.name().to_owned()]).collect();
        Stamp::new("judged", paper, places, &more)
    };
    if !again.fresh && stamp()?.is_current() {
        return Ok(Verdicts::read(runs)?);
    }
    let verdicts = judge(paper, point.clone(), places)?;
    // The history may have an entry more.
    stamp()?.keep([Verdicts::path(runs)]);
    Ok(verdicts)
}

/// The verdicts by `evidence` with the history of their claims; across interpretations if it is a full run under the defaults and
/// interpretations were explored.
fn judged(evidence: &Evidence<'_>, places: &Places, history: &History) -> Result<Verdicts, Failure> {
    let is_other =
        evidence.point != default_point(evidence.paper) || evidence.runs().any(|run| run.manifest.quick);
    let stored = || {
        if is_other {
            return Ok(Stored::default());
        }
        Stored::read(evidence.paper, &places.runs, evidence.polylines())
    };
    let (verdicts, stored) = rayon::join(|| claims::judge(evidence), stored);
    let mut verdicts = verdicts?;
    across::apply(evidence.paper, &mut verdicts, &stored?);
    history.apply(&mut verdicts, evidence.paper);
    Ok(verdicts)
}

/// Where polylines that were searched for are kept; a check searches for its own.
pub fn polylines(places: &Places) -> std::path::PathBuf {
    places.scratch.join("cache/polylines.json")
}

/// The stored run of `paper`, to be judged under `point`.
pub fn read<'a>(paper: &'a Paper, point: Interpretation, places: &Places) -> Result<Evidence<'a>, Failure> {
    doing(&format!("{}: judging {} claims and parts of claims", paper.id, paper.claims.len()));
    Ok(Evidence::read(paper, point, &places.runs)?)
}
