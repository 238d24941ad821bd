//! `replan merge`: the parts of a run, or of a round of an exploration, that was cut into shards, put together.

use super::confirm::confirm;
use super::consent::Consent;
use super::explore::explore;
use super::load::load;
use super::rounds::{Rounds, at_work};
use super::sharded::Sharded;
use super::{Failure, Which, command_line};
use crate::analysis::history::History;
use clap::Args;
use std::path::PathBuf;
use study::lock::Lock;
use study::manifest::MadeBy;
use study::plan::Plan;

/// Puts parts together; those of an exploration or a confirmation are judged as well, and the next round is planned.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Merge {
    /// The folder that holds the shards
    parts: PathBuf,
    /// Write below this folder; an exploration or confirmation needs the folder of its default run
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    consent: Consent,
}

const EXAMPLES: &str = "Examples:
  replan shard fu2018 --engine parallel --out parts --merge merged
  replan merge parts --out merged     when all shards are done";

impl Merge {
    /// Runs the command.
    pub fn run(self) -> Result<(), Failure> {
        MadeBy::here();
        let plan = Plan::read(&at_work(&self.parts))?;
        let Some(round) = &plan.round else { return self.merge_run(&plan) };
        let which = Which { paper: plan.paper.clone(), out: self.out.clone() };
        // The findings bear the command that would have made them on one machine.
        let command = base::text::command(&plan.unsharded(self.out.as_deref()));
        let rounds = Some(Rounds::new(&plan, &self.parts));
        match round.command.as_str() {
            "explore" => explore(&which, None, rounds, (command, self.consent)),
            _ => confirm(&which, None, rounds, (command, self.consent)),
        }
    }

    /// Puts a run together.
    fn merge_run(&self, plan: &Plan) -> Result<(), Failure> {
        let Some(out) = &self.out else {
            return Err(Failure::input("--out <DIR> is missing: where `replan run --out` would write"));
        };
        let sharded = Sharded::of_plan(plan, out.clone())?;
        let runs = &sharded.places.runs;
        sharded.put_together(plan, &self.parts, runs)?;
        let paper = load(&sharded.places, &sharded.how)?;
        let lock = Lock::take(runs)?;
        History::note(&paper, lock.folder(), &command_line())?;
        if sharded.runs.iter().any(|(study, _)| study.timing.is_some()) {
            let command = base::text::command(&plan.unsharded(Some(out)));
            say!("no clock was read; one machine reads it: {command}");
        }
        Ok(())
    }
}
