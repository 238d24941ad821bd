//! One shard of the round of an exploration or a confirmation that is at work.

use super::consent::Consent;
use super::explorer::Explorer;
use super::load::load;
use super::places::Places;
use super::rounds::{Round, Rounds, at_work};
use super::sharded::Sharded;
use super::{Again, Failure, How, Which};
use std::path::Path;
use study::Interpretation;
use study::plan::{Plan, PlannedRound};

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
    /// What people allow.
    pub consent: Consent,
}

impl<'a> OneShard<'a> {
    /// The shard that the command line asks for, if it asks for one: it then names the folder of all parts, too.
    pub fn new(
        which: &'a Which,
        shard: Option<(usize, usize)>,
        (threads, consent): (Option<u32>, Consent),
    ) -> Option<Self> {
        let (shard, parts) = shard.zip(which.out.as_deref())?;
        Some(Self { paper: &which.paper, shard, parts, threads, consent })
    }

    /// Runs it in the round that is at work; in `first` under the points that it gives if none is planned yet.
    pub fn run(
        &self,
        first: Round,
        points: impl Fn(&Explorer<'_>) -> Result<Vec<Interpretation>, Failure>,
    ) -> Result<(), Failure> {
        let sharded = sharded(self.paper, self.threads, self.parts, first, points)?;
        let folder = sharded.folder(self.parts);
        sharded.run_shard(self.shard, &folder, (Again::default(), self.consent), false)
    }
}

/// The round that is at work in `parts`, of the paper called `named`; `first` under what `points` gives if none is planned yet.
pub fn sharded(
    named: &str,
    threads: Option<u32>,
    parts: &Path,
    first: Round,
    points: impl Fn(&Explorer<'_>) -> Result<Vec<Interpretation>, Failure>,
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
    let choices = &paper.choices;
    let point = |options| Interpretation::new(choices, options).map_err(Failure::input);
    let points: Vec<Interpretation> = planned.interpretations.iter().map(point).collect::<Result<_, _>>()?;
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
