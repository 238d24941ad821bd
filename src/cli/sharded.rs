//! Work that is cut into shards: the studies of a run, or of one round of an exploration.

use super::consent::Consent;
use super::load::open;
use super::places::Places;
use super::progress::{Bar, doing, stop_flag};
use super::summary::summary;
use super::{Again, Failure, How, Which, command_line, counted};
use crate::analysis::history::History;
use crate::analysis::meaning::meanings;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use study::lock::Lock;
use study::manifest::Manifest;
use study::merge::Parts;
use study::plan::{Plan, PlannedRound, Wanted};
use study::runner::BuiltStudy;
use study::session::{self, Options};
use study::{Interpretation, Study};

/// Studies, how they are run, and the interpretations of each.
pub struct Sharded {
    /// Where they are read from.
    pub places: Places,
    /// How they are run.
    pub how: How,
    /// The studies with their interpretations.
    pub runs: Vec<(Study, Vec<Interpretation>)>,
    /// What each claim means.
    claims: BTreeMap<String, Vec<String>>,
    named: String,
    round: Option<PlannedRound>,
}

impl Sharded {
    /// The paper called `paper`, to be run as `how` says.
    ///
    /// # Errors
    /// Those of loading the paper.
    pub fn load(paper: &str, how: &How) -> Result<Self, Failure> {
        let which = Which { paper: paper.to_owned(), out: None };
        Self::at(&which, how)
    }

    /// It, as `plan` has it, with its outputs where a run of that kind with `--out` at `out` has them.
    ///
    /// # Errors
    /// Those of loading the paper.
    pub fn of_plan(plan: &Plan, out: PathBuf) -> Result<Self, Failure> {
        let how = How { quick: plan.quick, seed: plan.seed, with: plan.with.clone(), threads: None };
        let which = Which { paper: plan.paper.clone(), out: Some(out) };
        Self::at(&which, &how)
    }

    fn at(which: &Which, how: &How) -> Result<Self, Failure> {
        let (places, paper) = open(which, how)?;
        let run = |study: &Study| Ok((study.clone(), how.interpretations(study)?));
        let runs = paper.studies.iter().map(run).collect::<Result<_, Failure>>()?;
        let claims = meanings(&paper);
        Ok(Self { places, how: how.clone(), runs, claims, named: which.paper.clone(), round: None })
    }

    /// One round of an exploration of the paper that the command line called `named`.
    pub fn of_round(
        named: &str,
        places: &Places,
        threads: Option<u32>,
        round: PlannedRound,
        runs: Vec<(Study, Vec<Interpretation>)>,
    ) -> Self {
        let how = How::plain(threads);
        let claims = BTreeMap::new();
        Self { places: places.clone(), how, runs, claims, named: named.to_owned(), round: Some(round) }
    }

    /// The options of a plan that cuts it into `shards` shards.
    pub fn wanted(&self, shards: usize) -> Wanted {
        let How { quick, seed, with, .. } = self.how.clone();
        let paper = self.named.clone();
        let round = self.round.clone();
        let claims = self.claims.clone();
        Wanted { paper, shards, quick, seed, with, round, claims }
    }

    /// Where its plan and its parts lie within `parts`.
    pub fn folder(&self, parts: &Path) -> PathBuf {
        self.round.as_ref().map_or_else(|| parts.to_owned(), |round| parts.join(&round.name))
    }

    /// Every study with everything built, and what its records would depend on.
    ///
    /// # Errors
    /// Those of families, pipelines and input files.
    pub fn studies(&self) -> Result<Vec<(BuiltStudy<'_>, Manifest)>, Failure> {
        let mut studies = Vec::new();
        doing(&format!("{}: building its problems", self.named));
        for (study, points) in &self.runs {
            let built = BuiltStudy::new(study, points, &self.places.inputs)?;
            let manifest = Manifest::new(study, points, &built, command_line(), self.how.quick)?;
            studies.push((built, manifest));
        }
        Ok(studies)
    }

    /// The studies.
    pub fn studies_alone(&self) -> impl Iterator<Item = &Study> + Clone {
        self.runs.iter().map(|(study, _)| study)
    }

    /// Runs the shard `number` of `of` into its own part of `folder`.
    ///
    /// # Errors
    /// Parts of another run; those of running.
    pub fn run_shard(
        &self,
        (number, of): (usize, usize),
        folder: &Path,
        (again, consent): (Again, Consent),
        why: bool,
    ) -> Result<(), Failure> {
        consent.check(self.studies_alone(), &self.places)?;
        let plan = Plan::agreed(folder, &self.wanted(of), &self.studies()?)?;
        let portions = plan.portions(number);
        let lock = Lock::take(&plan.part(folder, number))?;
        for ((study, points), portion) in self.runs.iter().zip(&portions) {
            let bar = Bar::default();
            let whole = options((points, &bar), &self.places, &self.how, &lock);
            let options = Options { portion: Some(portion), again: again.into(), ..whole };
            say!("{}", summary(&session::run(study, &options)?, why));
        }
        say!("shard {number}/{of} is in {}", lock.folder().display());
        Ok(())
    }

    /// Puts the parts of `plan` in `folder` together below `runs`.
    ///
    /// # Errors
    /// Parts that are missing, double or of another run; those of the file system.
    pub fn put_together(&self, plan: &Plan, folder: &Path, runs: &Path) -> Result<(), Failure> {
        let studies = self.studies()?;
        let parts = Parts::checked(plan, folder, &studies)?;
        let lock = Lock::take(runs)?;
        if plan.round.is_none() {
            History::note_planned(&plan.claims, runs, &command_line())?;
        }
        for ((place, (study, _)), (built, manifest)) in self.runs.iter().enumerate().zip(&studies) {
            let trials = parts.merge((place, study), built, manifest.clone(), lock.folder())?;
            let trials = counted(trials, ["trial", "trials"]);
            say!("{}: {trials} of {}", study.name, counted(plan.shards, ["part", "parts"]));
        }
        say!("records are in {}", runs.display());
        Ok(())
    }
}

/// How a whole run of a study is to be done, reusing what is stored.
pub fn options<'a>(
    (points, bar): (&'a [Interpretation], &'a Bar),
    places: &'a Places,
    how: &How,
    lock: &'a Lock,
) -> Options<'a> {
    Options {
        lock,
        points,
        inputs: &places.inputs,
        command: command_line(),
        portion: None,
        quick: how.quick,
        again: session::Again::default(),
        threads: how.threads.map(|threads| threads as usize),
        stop: stop_flag(),
        progress: bar,
    }
}
