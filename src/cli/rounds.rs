//! The rounds of an exploration or a confirmation, where they are cut into shards.
//!
//! What runs in a round hangs on what was judged after the one before it. Shards run trials and decide nothing: whoever merges
//! a round judges it, as one machine would, and plans the next one. So the budget is spent alike, and the findings are equal to
//! the byte.

use super::explorer::Explorer;
use super::load::load;
use super::places::Places;
use super::sharded::Sharded;
use super::{Again, Failure, How, Which};
use crate::analysis::across::stored::differing;
use crate::study::paper::Paper;
use crate::study::plan::{Plan, PlannedRound};
use crate::study::{ReadingChoice, StudyError};
use std::path::{Path, PathBuf};

/// A round.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Round {
    /// Everything that is explored, with few draws; but for what runs where readings are compatible.
    First,
    /// What runs where readings are compatible.
    Compatible,
    /// Everything that is explored, with more draws, where a class is near a flip.
    Again,
    /// Every study on its second seed, under the defaults.
    Default,
    /// What is explored on its second seed, under readings that turn a claim.
    Turned,
}

impl Round {
    /// Every round, those of a command in the order in which they run.
    const ALL: [Self; 5] = [Self::First, Self::Compatible, Self::Again, Self::Default, Self::Turned];

    /// Its name, which is that of the folder of its records.
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
    fn command(self) -> &'static str {
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
    pub fn planned(self, paper: &Paper, points: &[ReadingChoice]) -> PlannedRound {
        let readings = points.iter().map(|point| differing(paper, point)).collect();
        PlannedRound { command: self.command().to_owned(), name: self.name().to_owned(), readings }
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

/// What was found; none, and a word about it, if the shards of another round have to run first.
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
    /// How many shards.
    pub shards: usize,
}

impl Rounds {
    /// Those of `plan`, the plan of some round, in `parts`.
    pub fn of(plan: &Plan, parts: &Path) -> Self {
        Self { parts: parts.to_owned(), paper: plan.paper.clone(), shards: plan.shards }
    }

    /// Where records of merged rounds are.
    pub fn merged(parts: &Path) -> PathBuf {
        parts.join("merged")
    }

    /// Puts the parts of `round` under `points` together below the explorer's folder; a round that has no plan is planned.
    pub fn put_together(
        &self,
        explorer: &Explorer<'_>,
        round: Round,
        points: &[ReadingChoice],
    ) -> Result<(), Halt> {
        let sharded = explorer.sharded(&self.paper, round, points);
        let folder = self.parts.join(round.name());
        let is_new = !Plan::path(&folder).exists();
        let plan = Plan::agreed(&folder, &sharded.wanted(self.shards), &sharded.studies()?)?;
        if is_new {
            let shard = format!("K/{}", self.shards);
            return Err(Halt::Planned(format!(
                "round `{}`: {} units under {} readings are left to run, and then to merge: replan {}",
                round.name(),
                plan.units.iter().sum::<usize>(),
                points.len(),
                plan.arguments(&folder, &shard).join(" ")
            )));
        }
        Ok(sharded.put_together(&plan, &folder, &explorer.folder.join(round.name()))?)
    }
}

/// The folder of the parts that are at work within `parts`: itself for a run, that of the last planned round otherwise.
pub fn at_work(parts: &Path) -> PathBuf {
    let rounds = Round::ALL.iter().rev().map(|round| parts.join(round.name()));
    let is_planned = |folder: &PathBuf| Plan::path(folder).exists();
    std::iter::once(parts.to_owned()).chain(rounds).find(is_planned).unwrap_or(parts.to_owned())
}

/// A shard of an exploration or a confirmation, as the command line asks for it.
pub struct OneShard<'a> {
    /// The paper, as the command line named it.
    pub paper: &'a str,
    /// Its number and how many there are.
    pub shard: (usize, usize),
    /// The folder of all parts.
    pub parts: &'a Path,
    /// Threads for the trials.
    pub threads: Option<u32>,
}

impl OneShard<'_> {
    /// Runs it in the round that is at work; in `first` under the points that it gives if none is planned yet.
    pub fn run(
        &self,
        first: Round,
        points: impl Fn(&Explorer<'_>) -> Result<Vec<ReadingChoice>, Failure>,
    ) -> Result<(), Failure> {
        let sharded = sharded(self.paper, self.threads, self.parts, first, points)?;
        let folder = sharded.folder(self.parts);
        sharded.run_shard(self.shard, &folder, Again { fresh: false, record: false }, false)
    }
}

/// The round that is at work in `parts`, of the paper called `named`; `first` under what `points` gives if none is planned yet.
pub fn sharded(
    named: &str,
    threads: Option<u32>,
    parts: &Path,
    first: Round,
    points: impl Fn(&Explorer<'_>) -> Result<Vec<ReadingChoice>, Failure>,
) -> Result<Sharded, Failure> {
    let which = Which { paper: named.to_owned(), out: None };
    let places = Places::find(&which, "")?;
    let paper = load(&places, &How::plain(threads))?;
    let explorer = Explorer {
        paper: &paper,
        places: &places,
        threads: threads.map(|threads| threads as usize),
        folder: Rounds::merged(parts),
        second_seed: first.has_second_seed(),
        rounds: None,
    };
    let folder = at_work(parts);
    if !Plan::path(&folder).exists() {
        return Ok(explorer.sharded(named, first, &points(&explorer)?));
    }
    let (round, planned) = planned(&folder, first)?;
    let readings = paper.readings();
    let point = |options| ReadingChoice::new(&readings, options).map_err(Failure::input);
    let points: Vec<ReadingChoice> = planned.readings.iter().map(point).collect::<Result<_, _>>()?;
    Ok(explorer.sharded(named, round, &points))
}

/// The round that is planned in `folder`, which must be of the command that `first` begins.
fn planned(folder: &Path, first: Round) -> Result<(Round, PlannedRound), Failure> {
    let planned = Plan::read(folder)?.round;
    let is_of = |round: &Round, planned: &PlannedRound| {
        (round.command(), round.name()) == (first.command(), &*planned.name)
    };
    let found = planned.and_then(|planned| {
        let round = Round::ALL.into_iter().find(|round| is_of(round, &planned))?;
        Some((round, planned))
    });
    found.ok_or_else(|| {
        Failure::input(format!(
            "{}: the parts here are of another command than `{}`; another folder is accepted",
            Plan::path(folder).display(),
            first.command()
        ))
    })
}
