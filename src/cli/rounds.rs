//! The rounds of an exploration or a confirmation that is cut into shards.
//!
//! Each round depends on the judgement of the one before it. Shards run trials and decide nothing: `merge` judges a
//! round, as one machine would, and plans the next one. So the budget is spent alike, and the findings are equal to the
//! byte.

use super::Failure;
use super::sharded::Sharded;
use crate::analysis::across::stored::differing;
use std::path::{Path, PathBuf};
use study::paper::Paper;
use study::plan::{Plan, PlannedRound};
use study::{Interpretation, StudyError};

/// A round.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Round {
    /// Everything that is explored, with few instances; but for what runs where interpretations are compatible.
    First,
    /// What runs where interpretations are compatible.
    Compatible,
    /// Everything that is explored, with more instances, where an outcome is near a flip.
    Again,
    /// Every study on its second seed, under the defaults.
    Default,
    /// What is explored on its second seed, under interpretations that turn a claim.
    Turned,
}

impl Round {
    /// Every round, in the order in which a command runs them.
    pub const ALL: [Self; 5] = [Self::First, Self::Compatible, Self::Again, Self::Default, Self::Turned];

    /// Its name, which is also the name of the folder of its records.
    pub fn name(self) -> &'static str {
        match self {
            Self::First => "round-1",
            Self::Compatible => "compatible",
            Self::Again => "round-2",
            Self::Default => "default",
            Self::Turned => "turned",
        }
    }

    /// The command that it is a round of.
    pub fn command(self) -> &'static str {
        match self {
            Self::First | Self::Compatible | Self::Again => "explore",
            Self::Default | Self::Turned => "confirm",
        }
    }

    /// Whether studies run on their second seed.
    pub fn has_second_seed(self) -> bool {
        self.command() == "confirm"
    }

    /// It under `points`, as a plan has it.
    pub fn planned(self, paper: &Paper, points: &[Interpretation]) -> PlannedRound {
        let interpretations = points.iter().map(|point| differing(paper, point)).collect();
        PlannedRound { command: self.command().to_owned(), name: self.name().to_owned(), interpretations }
    }
}

/// Why an exploration goes on no further.
pub enum Halt {
    /// Something is wrong.
    Failed(Failure),
    /// The next round was planned, and its shards have to run.
    Planned(String),
}

impl From<Failure> for Halt {
    fn from(failure: Failure) -> Self {
        Self::Failed(failure)
    }
}

impl From<StudyError> for Halt {
    fn from(error: StudyError) -> Self {
        Self::Failed(error.into())
    }
}

/// The result, or none with a message if the shards of another round have to run first.
pub fn unless_planned<T>(found: Result<T, Halt>) -> Result<Option<T>, Failure> {
    match found {
        Ok(found) => Ok(Some(found)),
        Err(Halt::Failed(failure)) => Err(failure),
        Err(Halt::Planned(what)) => {
            say!("{what}");
            Ok(None)
        }
    }
}

/// The parts of an exploration or a confirmation whose rounds are merged.
pub struct Rounds {
    /// The folder of all parts.
    pub parts: PathBuf,
    /// The paper, as the command line named it.
    pub paper: String,
    /// Number of shards.
    pub shards: usize,
}

impl Rounds {
    /// Those of `plan`, the plan of some round, in `parts`.
    pub fn new(plan: &Plan, parts: &Path) -> Self {
        Self { parts: parts.to_owned(), paper: plan.paper.clone(), shards: plan.shards }
    }

    /// Where records of merged rounds are.
    pub fn merged(parts: &Path) -> PathBuf {
        parts.join("merged")
    }

    /// Puts the parts of `round` together below `to`; `sharded` under `interpretations` interpretations is cut into
    /// them. A round without a plan is planned.
    pub fn put_together(
        &self,
        sharded: &Sharded,
        round: Round,
        interpretations: usize,
        to: &Path,
    ) -> Result<(), Halt> {
        let folder = self.parts.join(round.name());
        let is_new = !Plan::path(&folder).exists();
        let plan = Plan::agreed(&folder, &sharded.wanted(self.shards), &sharded.studies()?)?;
        if is_new {
            let shard = format!("K/{}", self.shards);
            return Err(Halt::Planned(format!(
                "round `{}`: {} units under {} interpretations are left to run, and then to merge: {}",
                round.name(),
                plan.units(),
                interpretations,
                base::text::command(&plan.arguments(&folder, &shard))
            )));
        }
        Ok(sharded.put_together(&plan, &folder, &to.join(round.name()))?)
    }
}

/// The folder of the parts that are at work within `parts`: itself for a run, the folder of the last planned round
/// otherwise.
pub fn at_work(parts: &Path) -> PathBuf {
    let rounds = Round::ALL.iter().rev().map(|round| parts.join(round.name()));
    let is_planned = |folder: &PathBuf| Plan::path(folder).exists();
    std::iter::once(parts.to_owned()).chain(rounds).find(is_planned).unwrap_or(parts.to_owned())
}
