//! `replan check`: everything that can be wrong with a paper, without running it.

use super::consent::AllowLarge;
use super::crosscheck::Spec;
use super::load::gather;
use super::places::{Places, papers};
use super::progress::doing;
use super::verdicts::refused_paths;
use super::{Failure, Which, all, counted, pack};
use crate::analysis::compare::stored_studies;
use crate::analysis::evidence::default_point;
use crate::analysis::history::History;
use crate::analysis::verdict::Verdicts;
use base::settings::Faults;
use clap::Args;
use std::collections::BTreeSet;
use std::path::Path;
use study::StudyError;
use study::paper::Paper;
use study::rerun;

/// Checks papers and specs.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Check {
    /// Papers, folders or packs to check; all papers if absent
    #[arg(value_name = "PAPER")]
    specs: Vec<String>,
    /// Also run this many stored trials of each study again, chosen by seed, and compare their rows
    #[arg(long, value_name = "N", default_value_t = 0)]
    rerun: usize,
    /// Threads for the trials that are run again
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=1024))]
    threads: u32,
    #[command(flatten)]
    large: AllowLarge,
}

const EXAMPLES: &str = "Examples:
  replan check                        every paper of the project
  replan check ./my/paper
  replan check zhang --rerun 20       run 20 trials of each study again";

impl Check {
    /// Runs the command.
    pub fn run(self) -> Result<(), Failure> {
        let specs = if self.specs.is_empty() { papers() } else { self.specs.clone() };
        if specs.is_empty() {
            return Err(Failure::input(
                "there is no paper here to check; run replan from the project's own folder",
            ));
        }
        let results = specs.iter().map(|spec| self.check(spec)).collect();
        all(results, "papers are not in order")
    }

    /// Checks one paper.
    fn check(&self, spec: &str) -> Result<(), Failure> {
        if pack::is_pack(Path::new(spec)) {
            return pack::check(Path::new(spec));
        }
        let which = Which { paper: folder_of(spec), out: None };
        let places = Places::find(&which, "")?;
        let mut faults = Faults::default();
        let paper = gather(&places, &mut faults)?;
        if let (Some(crosscheck), Some(paper)) = (faults.keep(Spec::open(&places.folder)).flatten(), &paper) {
            crosscheck.check(paper, &places.inputs, &mut faults);
        }
        let Some(paper) = paper.filter(|_| faults.is_empty()) else { return Err(faults.error().into()) };
        self.large.check(&paper.studies, &places)?;
        say!(
            "{}: {}, {}, {} are in order",
            paper.id,
            counted(paper.studies.len(), ["study", "studies"]),
            counted(paper.claims.len(), ["claim", "claims"]),
            counted(paper.inventory.len(), ["inventory row", "inventory rows"])
        );
        // Verdicts that are missing or damaged are for `judge` to report.
        let refused = Verdicts::read(&places.runs).ok().and_then(|verdicts| refused_paths(&verdicts));
        for note in notes(&paper, &places).into_iter().chain(refused) {
            say!("  {note}");
        }
        history(&places).map_err(Failure::in_check)?;
        for (path, kind) in &paper.others {
            say!("  {} is taken for a {kind}, not for a study", path.display());
        }
        if self.rerun > 0 {
            rerun(&paper, &places, self.rerun, self.threads as usize).map_err(Failure::in_check)?;
        }
        Ok(())
    }
}

/// Says if there is no history of the claims of runs that are stored.
fn history(places: &Places) -> Result<(), Failure> {
    History::read(&places.runs)?;
    let path = History::path(&places.runs);
    if !path.exists() && !stored_studies(&places.runs).is_empty() {
        say!(
            "  {}: there is no history of claims for the stored runs; `replan judge` begins one",
            path.display()
        );
    }
    Ok(())
}

/// How input files were taken, each sentence once.
fn notes(paper: &Paper, places: &Places) -> BTreeSet<String> {
    let mut notes = BTreeSet::new();
    for study in &paper.studies {
        let point = default_point(paper).for_trials(&study.choices);
        // A family that cannot be built was reported before.
        let families = study.posed().filter_map(|(group, at)| group.family(at, &point, &places.inputs).ok());
        notes.extend(families.flat_map(|family| family.notes()));
    }
    notes
}

/// Runs a sample of each study's stored trials again.
fn rerun(paper: &Paper, places: &Places, count: usize, threads: usize) -> Result<(), Failure> {
    for study in &paper.studies {
        doing(&format!("{}/{}: running stored trials again", paper.id, study.name));
        let done = match rerun::rerun(study, &places.inputs, &places.runs, count, threads) {
            Err(StudyError::LacksFiles { lacks, .. }) => {
                say!("  {}: no trial is run again: {lacks}", study.name);
                continue;
            }
            done => done?,
        };
        if let Some(first) = done.differ.first() {
            return Err(Failure::stale(format!(
                "{} of {} of study `{}` are not what is stored; the first is {}/{first}",
                done.differ.len(),
                counted(done.trials, ["trial", "trials"]),
                study.name,
                study.name
            )));
        }
        let equal = if done.trials == 1 { "equals its row" } else { "equal their rows" };
        let trials = counted(done.trials, ["trial", "trials"]);
        let threads = counted(threads, ["thread", "threads"]);
        say!("  {}: {trials} run again on {threads} {equal}", study.name);
    }
    Ok(())
}

/// A study's file stands for its paper: claims and studies are only right together.
fn folder_of(spec: &str) -> String {
    let path = std::path::Path::new(spec);
    match path.parent() {
        Some(folder) if path.extension().is_some_and(|e| e == "toml") && path.is_file() => {
            let folder = if folder.as_os_str().is_empty() { std::path::Path::new(".") } else { folder };
            folder.display().to_string()
        }
        _ => spec.to_owned(),
    }
}
