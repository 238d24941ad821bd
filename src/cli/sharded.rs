//! A paper whose run is cut into shards: its studies as they would run.

use super::load::load;
use super::places::Places;
use super::{Failure, How, Which, command_line};
use crate::analysis::claims::claims_hash;
use crate::study::ReadingChoice;
use crate::study::manifest::Manifest;
use crate::study::paper::Paper;
use crate::study::plan::{Plan, Wanted};
use crate::study::runner::BuiltStudy;

/// A paper, how it is run, and the readings of each of its studies.
pub struct Sharded {
    /// The paper.
    pub paper: Paper,
    /// Where it is read from.
    pub places: Places,
    /// How it is run.
    pub how: How,
    named: String,
    points: Vec<Vec<ReadingChoice>>,
}

impl Sharded {
    /// The paper called `paper`, to be run as `how` says.
    ///
    /// # Errors
    /// Those of loading the paper.
    pub fn load(paper: &str, how: &How) -> Result<Self, Failure> {
        let which = Which { paper: paper.to_owned(), out: None };
        let places = Places::find(&which, &how.variant())?;
        Self::at(paper, how, places)
    }

    /// It, as `plan` has it, with its outputs where a run of that kind with `--out` at `out` has them.
    ///
    /// # Errors
    /// Those of loading the paper.
    pub fn of_plan(plan: &Plan, out: std::path::PathBuf) -> Result<Self, Failure> {
        let how = How { quick: plan.quick, seed: plan.seed, readings: plan.readings.clone(), threads: None };
        let which = Which { paper: plan.paper.clone(), out: Some(out) };
        let places = Places::find(&which, &how.variant())?;
        Self::at(&plan.paper, &how, places)
    }

    fn at(named: &str, how: &How, places: Places) -> Result<Self, Failure> {
        let paper = load(&places, how)?;
        let points = paper.studies.iter().map(|study| how.points(study)).collect::<Result<_, _>>()?;
        Ok(Self { paper, places, how: how.clone(), named: named.to_owned(), points })
    }

    /// What is asked of a plan that cuts it into so many shards.
    pub fn wanted(&self, shards: usize) -> Wanted {
        let How { quick, seed, readings, .. } = self.how.clone();
        Wanted { paper: self.named.clone(), shards, quick, seed, readings }
    }

    /// Every study with everything built, and what its records would depend on.
    ///
    /// # Errors
    /// Those of families, pipelines and input files.
    pub fn studies(&self) -> Result<Vec<(BuiltStudy<'_>, Manifest)>, Failure> {
        let claims = claims_hash(&self.paper);
        let mut studies = Vec::new();
        for (study, points) in self.paper.studies.iter().zip(&self.points) {
            let built = BuiltStudy::new(study, points, &self.places.inputs)?;
            let manifest =
                Manifest::new(study, points, &built, claims.clone(), command_line(), self.how.quick)?;
            studies.push((built, manifest));
        }
        Ok(studies)
    }
}
