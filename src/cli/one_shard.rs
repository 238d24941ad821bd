//! The arguments of `explore` and `confirm`, and one shard of the current round.

use super::consent::Consent;
use super::explorer::Explorer;
use super::load::open;
use super::rounds::{Round, Rounds, at_work};
use super::sharded::Sharded;
use super::{Again, Failure, How, Which, command_line};
use clap::Args;
use std::path::Path;
use study::Interpretation;
use study::manifest::MadeBy;
use study::plan::{Plan, PlannedRound};
use study::shard;

/// What is explored or confirmed: a paper, or one shard of a round.
#[derive(Args)]
pub struct RoundArgs {
    #[command(flatten)]
    pub which: Which,
    /// Threads for the trials; all cores if absent
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1024))]
    threads: Option<u32>,
    #[command(flatten)]
    consent: Consent,
    /// Run only this shard of N of the current round and keep it below --out for `replan merge`
    #[arg(long, value_name = "K/N", value_parser = shard::parse, requires = "out")]
    shard: Option<(usize, usize)>,
}

/// What explores or confirms a whole paper.
type Whole = fn(&Which, Option<u32>, Option<Rounds>, (String, Consent)) -> Result<(), Failure>;

impl RoundArgs {
    /// Runs the `whole`. With `--shard` it runs that shard of the round that is at work, or of `first` under the points
    /// that it gives if none is planned yet.
    pub fn run(
        &self,
        first: Round,
        points: impl Fn(&Explorer<'_>) -> Result<Vec<Interpretation>, Failure>,
        whole: Whole,
    ) -> Result<(), Failure> {
        MadeBy::here();
        let Some((shard, parts)) = self.shard.zip(self.which.out.as_deref()) else {
            return whole(&self.which, self.threads, None, (command_line(), self.consent));
        };
        let sharded = sharded(&self.which.paper, self.threads, parts, first, points)?;
        let folder = sharded.folder(parts);
        sharded.run_shard(shard, &folder, (Again::default(), self.consent), false)
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
    let (places, paper) = open(&which, &How::plain(threads))?;
    let explorer = Explorer {
        paper: &paper,
        places: &places,
        threads,
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
